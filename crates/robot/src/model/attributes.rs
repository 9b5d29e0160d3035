//! Numbers and texts as attributes of XML.

/// Numbers with blanks between them, without negative zeros.
pub fn floats(numbers: &[f64]) -> String {
    numbers.iter().map(|number| (number + 0.0).to_string()).collect::<Vec<_>>().join(" ")
}

/// `text` with what XML takes for its own written in another way.
pub fn escaped(text: &str) -> String {
    quick_xml::escape::escape(text).into_owned()
}
