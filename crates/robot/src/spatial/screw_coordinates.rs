//! Twists and wrenches as screws: axis, pitch and magnitude. Main type: [`ScrewCoordinates`].

use nalgebra::Vector3;

use super::{Axis, Twist, Wrench};
use crate::{Error, ErrorKind, Result};

/// A screw: a line, the pitch (translation per rotation), and the magnitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ScrewCoordinates {
    axis: Axis,
    pitch: f64,
    magnitude: f64,
}

impl ScrewCoordinates {
    /// Builds the screw of any pitch about `axis`. An infinite `pitch` is a pure translation or a pure couple.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when `magnitude` is not finite, or `pitch` neither finite nor plus infinity.
    pub fn new(axis: Axis, pitch: f64, magnitude: f64) -> Result<Self> {
        if magnitude.is_finite() && (pitch.is_finite() || pitch == f64::INFINITY) {
            return Ok(ScrewCoordinates { axis, pitch, magnitude });
        }
        let text = format!(
            "screw of pitch {pitch} and magnitude {magnitude}: give a finite magnitude, and a pitch that is finite \
             or plus infinity"
        );
        Err(Error::new(ErrorKind::BadValue, text))
    }

    /// Axis, pitch \[m/rad\] and magnitude \[rad, or m when the pitch is infinite\] of a twist.
    ///
    /// # Errors
    /// Those of [`Twist::axis`].
    pub fn of_twist(twist: &Twist) -> Result<Self> {
        Ok(ScrewCoordinates { axis: twist.axis()?, pitch: twist.pitch(), magnitude: twist.magnitude() })
    }

    /// Axis, pitch \[m\] and magnitude \[N, or N m when the pitch is infinite\] of a wrench.
    ///
    /// # Errors
    /// Those of [`Wrench::axis`].
    pub fn of_wrench(wrench: &Wrench) -> Result<Self> {
        Ok(ScrewCoordinates { axis: wrench.axis()?, pitch: wrench.pitch(), magnitude: wrench.magnitude() })
    }

    /// The axis.
    pub fn axis(&self) -> Axis {
        self.axis
    }

    /// The pitch: translation per rotation, or torque per force; infinite for a pure translation or couple.
    pub fn pitch(&self) -> f64 {
        self.pitch
    }

    /// The magnitude.
    pub fn magnitude(&self) -> f64 {
        self.magnitude
    }

    /// The twist with these coordinates: `(-w x q + h w, w)` times the magnitude, or `(w, 0)` at infinite pitch;
    /// RobotMan f(29).
    pub fn twist(&self) -> Twist {
        let (w, v) = self.line_and_moment();
        Twist { v, w }
    }

    /// The wrench with these coordinates: `(w, -w x q + h w)` times the magnitude, or `(0, w)` at infinite pitch;
    /// RobotMan f(30).
    pub fn wrench(&self) -> Wrench {
        let (f, tau) = self.line_and_moment();
        Wrench { f, tau }
    }

    fn line_and_moment(&self) -> (Vector3<f64>, Vector3<f64>) {
        let line = self.axis.direction().into_inner() * self.magnitude;
        if self.pitch == f64::INFINITY {
            return (Vector3::zeros(), line);
        }
        (line, self.axis.point().coords.cross(&line) + line * self.pitch)
    }
}
