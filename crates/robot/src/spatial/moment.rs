//! Axis, pitch and magnitude of a line vector with a moment: of twists, RH0 (2-11) to (2-13), and of wrenches, RH0
//! (2-17) to (2-19).
//!
//! Both are a line vector (`w` of a twist, `f` of a wrench) with a moment (`v`, `tau`), so both have the same formulas.

use nalgebra::{Point3, Vector3};

use super::Axis;
use super::rotation::length;
use crate::{Error, ErrorKind, Result};

/// The axis, by its point nearest to the origin. Without a line vector it is the line of the moment through the origin.
pub(super) fn axis(line: &Vector3<f64>, moment: &Vector3<f64>) -> Result<Axis> {
    let size = length(line);
    if size == 0.0 {
        return Axis::new(*moment, Point3::origin());
    }
    if !pitch(line, moment).is_finite() {
        let text = format!("pitch {}: give a larger line part", pitch(line, moment));
        return Err(Error::new(ErrorKind::BadValue, text));
    }
    Axis::new(*line, Point3::from((line / size).cross(&(moment / size))))
}

/// The pitch: the component of the moment along the line vector divided by its length; infinite without a line vector.
pub(super) fn pitch(line: &Vector3<f64>, moment: &Vector3<f64>) -> f64 {
    let size = length(line);
    if size == 0.0 { f64::INFINITY } else { (line / size).dot(&(moment / size)) }
}

/// The length of the line vector, or of the moment without a line vector.
pub(super) fn magnitude(line: &Vector3<f64>, moment: &Vector3<f64>) -> f64 {
    let size = length(line);
    if size == 0.0 { length(moment) } else { size }
}
