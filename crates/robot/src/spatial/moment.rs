//! Axis, pitch and magnitude of a line vector with a moment: of twists, RH0 (2-11) to (2-13), and of wrenches, RH0 (2-17) to (2-19).
//!
//! Both are a line vector (`w` of a twist, `f` of a wrench) with a moment (`v`, `tau`): one set of formulas serves both.

use nalgebra::{Point3, Vector3};

use super::Axis;
use super::rotation::length;
use crate::{Error, ErrorKind, Result};

/// The line, by its point nearest to the origin; that of the moment through the origin where there is no line part.
pub(super) fn axis(line: &Vector3<f64>, moment: &Vector3<f64>) -> Result<Axis> {
    let size = length(line);
    if size == 0.0 {
        return Axis::new(*moment, Point3::origin());
    }
    if !pitch(line, moment).is_finite() {
        let text = format!("pitch {}: give a line part that is not so small", pitch(line, moment));
        return Err(Error::new(ErrorKind::BadValue, text));
    }
    Axis::new(*line, Point3::from((line / size).cross(&(moment / size))))
}

/// What the moment has along the line per line part; infinite where there is none.
pub(super) fn pitch(line: &Vector3<f64>, moment: &Vector3<f64>) -> f64 {
    let size = length(line);
    if size == 0.0 { f64::INFINITY } else { (line / size).dot(&(moment / size)) }
}

/// The length of the line part, of the moment where there is none.
pub(super) fn magnitude(line: &Vector3<f64>, moment: &Vector3<f64>) -> f64 {
    let size = length(line);
    if size == 0.0 { length(moment) } else { size }
}
