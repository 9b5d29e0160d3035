//! Numbers and texts as XML attributes.

use num_traits::ToPrimitive;

use super::Origin;
use crate::spatial::exact::ExactVector;
use groebot_algebra::number::BigRational;

/// Numbers separated by blanks, without negative zeros.
pub fn floats(numbers: &[f64]) -> String {
    numbers.iter().map(|number| (number + 0.0).to_string()).collect::<Vec<_>>().join(" ")
}

/// Exact numbers separated by blanks.
pub fn decimals(numbers: &ExactVector) -> String {
    numbers.each_ref().map(decimal).join(" ")
}

/// All digits of a decimal number; the nearest double of any other number.
pub fn decimal(number: &BigRational) -> String {
    groebot_algebra::number::decimal_text(number).unwrap_or_else(|| number.to_f64().unwrap_or(f64::NAN).to_string())
}

/// The position, and roll, pitch and yaw of a frame: as given, or as doubles.
pub fn frame_numbers(origin: &Origin) -> [String; 2] {
    let rpy = origin.rpy.as_ref().map_or_else(|| floats(&origin.angles()), decimals);
    [decimals(&origin.placement.origin), rpy]
}

/// `text` with XML's special characters escaped.
pub fn escaped(text: &str) -> String {
    quick_xml::escape::escape(text).into_owned()
}
