//! Values in the text of an SDF's elements.

use num_traits::ToPrimitive;

use crate::document::shown;
use crate::model::urdf::xml::{Element, decimal};
use crate::spatial::exact::{ExactRotation, Placement, Turn};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::BigRational;

/// The exact numbers in the text of an element; `None` for an empty text.
///
/// # Errors
/// [`ErrorKind::BadValue`] for a wrong count, and text that is not a decimal number.
pub fn numbers<const N: usize>(element: &Element) -> Result<Option<[BigRational; N]>> {
    if element.text.trim().is_empty() {
        return Ok(None);
    }
    let bad = |what: String| {
        let wanted = if N == 1 { "one number".to_owned() } else { format!("{N} numbers with blanks between them") };
        element.error(ErrorKind::BadValue, &format!("has the text \"{}\": {what}; give {wanted}", shown(&element.text)))
    };
    let words = element.text.split_whitespace();
    let all: Vec<BigRational> = words.map(|word| decimal(word).map_err(bad)).collect::<Result<_>>()?;
    let count = all.len();
    all.try_into().map(Some).map_err(|_| bad(format!("{count} found")))
}

/// The number of a child element; `None` without it.
///
/// # Errors
/// Those of [`numbers`], and [`ErrorKind::BadValue`] for two such children.
pub fn number(element: &Element, name: &str) -> Result<Option<BigRational>> {
    let Some(child) = element.child(name)? else { return Ok(None) };
    Ok(numbers::<1>(child)?.map(|[value]| value))
}

/// The doubles in the text of an element.
///
/// # Errors
/// Those of [`numbers`], and [`ErrorKind::BadValue`] for numbers outside the range of doubles.
pub fn floats<const N: usize>(element: &Element) -> Result<Option<[f64; N]>> {
    let Some(exact) = numbers::<N>(element)? else { return Ok(None) };
    let all = exact.each_ref().map(|number| number.to_f64().unwrap_or(f64::INFINITY));
    if all.iter().all(|number| number.is_finite()) {
        return Ok(Some(all));
    }
    Err(element.error(ErrorKind::BadValue, "has a number outside the range of doubles"))
}

/// The double of a child element; infinities are allowed.
///
/// # Errors
/// Those of [`number`].
pub fn float(element: &Element, name: &str) -> Result<Option<f64>> {
    let Some(child) = element.child(name)? else { return Ok(None) };
    if let Some(infinite) = child.text.trim().parse().ok().filter(|value: &f64| value.is_infinite()) {
        return Ok(Some(infinite));
    }
    Ok(numbers::<1>(child)?.map(|[value]| value.to_f64().unwrap_or(f64::INFINITY)))
}

/// The frame in a `<pose>`, relative to the frame that `relative_to` names: x, y, z and roll, pitch, yaw, or a
/// quaternion x, y, z, w.
///
/// # Errors
/// Those of [`numbers`]; [`ErrorKind::BadValue`] for an unknown format, a zero quaternion and too large angles.
pub fn pose(element: &Element) -> Result<Placement> {
    match element.attribute("rotation_format").unwrap_or("euler_rpy") {
        "euler_rpy" => {
            let Some([x, y, z, roll, pitch, yaw]) = numbers(element)? else { return Ok(Placement::identity()) };
            let degrees = element.attribute("degrees").is_some_and(is_true);
            let turn = |angle: &BigRational| {
                let turn = if degrees { Turn::from_degrees(angle) } else { Turn::from_radians(angle) };
                turn.map_err(|error| element.error(error.kind(), error.message()))
            };
            let turned = Placement::turned([turn(&roll)?, turn(&pitch)?, turn(&yaw)?]);
            Ok(Placement { origin: [x, y, z], ..turned })
        }
        "quat_xyzw" => {
            let Some([x, y, z, a, b, c, w]) = numbers(element)? else { return Ok(Placement::identity()) };
            let zero = || element.error(ErrorKind::BadValue, "has a quaternion of zeros; give one that is not zero");
            let rotation = ExactRotation::from_quaternion(&[a, b, c, w]).ok_or_else(zero)?;
            Ok(Placement { rotation, origin: [x, y, z], meant: None })
        }
        other => {
            let text = format!("has rotation_format=\"{}\"; allowed: \"euler_rpy\", \"quat_xyzw\"", shown(other));
            Err(element.error(ErrorKind::BadValue, &text))
        }
    }
}

/// The pose of an element and the name of its reference frame, by its child `<pose>`.
///
/// # Errors
/// Those of [`pose`].
pub fn pose_of(element: &Element) -> Result<(Placement, Option<&str>)> {
    let Some(child) = element.child("pose")? else { return Ok((Placement::identity(), None)) };
    let reference = child.attribute("relative_to").filter(|name| !name.is_empty());
    Ok((pose(child)?, reference))
}

/// The text of a child element; `None` without it or when it is empty.
///
/// # Errors
/// [`ErrorKind::BadValue`] for two such children.
pub fn text<'e>(element: &'e Element, name: &str) -> Result<Option<&'e str>> {
    Ok(element.child(name)?.map(|child| child.text.trim()).filter(|text| !text.is_empty()))
}

/// The text of a required child element.
///
/// # Errors
/// [`ErrorKind::MissingKey`] without it.
pub fn required_text<'e>(element: &'e Element, name: &str) -> Result<&'e str> {
    let missing = || -> Error { element.error(ErrorKind::MissingKey, &format!("has no <{name}>; it is required")) };
    text(element, name)?.ok_or_else(missing)
}

/// Whether a word means true.
pub fn is_true(word: &str) -> bool {
    ["true", "1"].contains(&word.trim())
}
