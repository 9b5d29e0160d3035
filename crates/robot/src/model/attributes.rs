//! Numbers and texts as XML attributes.

/// Numbers separated by blanks, without negative zeros.
pub fn floats(numbers: &[f64]) -> String {
    numbers.iter().map(|number| (number + 0.0).to_string()).collect::<Vec<_>>().join(" ")
}

/// `text` with XML's special characters escaped.
pub fn escaped(text: &str) -> String {
    quick_xml::escape::escape(text).into_owned()
}
