//! Joint axes as lines in space, and their motions.

use nalgebra::{Point3, Quaternion, Translation3, Unit, UnitQuaternion, Vector3};

use super::{Pose, rotation};
use crate::{Error, ErrorKind, Result};

/// A directed line: the axis of a revolute joint. Coordinates in the base frame, metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Axis {
    direction: Unit<Vector3<f64>>,
    point: Point3<f64>,
}

/// A joint value with the sine and cosine of half of it, for a joint that is moved several times.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Half {
    pub q: f64,
    sine: f64,
    cosine: f64,
}

impl Half {
    /// Computes them for `q`.
    pub fn new(q: f64) -> Self {
        let (sine, cosine) = (q / 2.0).sin_cos();
        Half { q, sine, cosine }
    }
}

/// The motion of a joint, in the base frame at the zero configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Screw {
    /// A rotation \[rad\] about an axis: a screw of pitch 0.
    Revolute(Axis),
    /// A translation \[m\] along a direction: a screw of infinite pitch.
    Prismatic(Unit<Vector3<f64>>),
}

impl Axis {
    /// Builds the line through `point` along `direction`, which may have any length.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when `direction` is zero or a coordinate is not finite.
    pub fn new(direction: Vector3<f64>, point: Point3<f64>) -> Result<Self> {
        if !point.iter().all(|x| x.is_finite()) {
            let [x, y, z] = point.into();
            let text = format!("axis through [{x}, {y}, {z}]: give finite coordinates");
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        Ok(Axis { direction: unit(direction)?, point })
    }

    /// Builds the line from `a` to `b` \[m\].
    ///
    /// # Errors
    /// Those of [`Axis::new`]; two equal points have no line.
    pub fn through(a: &Point3<f64>, b: &Point3<f64>) -> Result<Self> {
        Axis::new(b - a, *a)
    }

    /// The unit direction.
    pub fn direction(&self) -> Unit<Vector3<f64>> {
        self.direction
    }

    /// A point of the axis \[m\].
    pub fn point(&self) -> Point3<f64> {
        self.point
    }

    /// The point of the axis nearest to `p` \[m\].
    pub fn foot(&self, p: &Point3<f64>) -> Point3<f64> {
        self.point + self.direction.scale(self.direction.dot(&(p - self.point)))
    }

    /// Same line, but given by its point nearest to `p`.
    #[must_use]
    pub fn level_with(&self, p: &Point3<f64>) -> Axis {
        Axis { point: self.foot(p), ..*self }
    }

    /// `p` \[m\] after a right-handed rotation by `angle` \[rad\] about this axis, RH0 (2-14), (2-15).
    pub fn rotate(&self, angle: f64, p: &Point3<f64>) -> Point3<f64> {
        p + rotation::displacement(&self.direction, angle, &(p - self.point))
    }

    /// The rotation by `angle` \[rad\] about this axis as a rigid transform, RH0 (2-7) with (2-25).
    pub fn rotation(&self, angle: f64) -> Pose {
        self.rotation_by_half((angle / 2.0).sin_cos())
    }

    /// Same as [`Axis::rotation`], but from the sine and cosine of half the angle.
    fn rotation_by_half(&self, half: (f64, f64)) -> Pose {
        let translation = -rotation::displacement_by_half(&self.direction, half, &self.point.coords);
        let quaternion = Quaternion::from_parts(half.1, self.direction.scale(half.0));
        Pose::from_parts(Translation3::from(translation), UnitQuaternion::new_unchecked(quaternion))
    }

    /// The axis through the origin along `direction`.
    pub fn central(direction: Unit<Vector3<f64>>) -> Axis {
        Axis { direction, point: Point3::origin() }
    }

    /// The axis translated by `shift` \[m\].
    #[must_use]
    pub fn shifted(&self, shift: &Vector3<f64>) -> Axis {
        Axis { point: self.point + shift, ..*self }
    }

    /// The parallel axis through the origin.
    #[must_use]
    pub(crate) fn through_origin(&self) -> Axis {
        Axis { point: Point3::origin(), ..*self }
    }

    /// The axis transformed by `motion`, including its point.
    #[must_use]
    pub fn moved(&self, motion: &Pose) -> Axis {
        Axis { direction: motion.rotation * self.direction, point: motion * self.point }
    }
}

impl Screw {
    /// Builds a revolute joint about the line through `point` \[m\] along `direction`.
    ///
    /// # Errors
    /// Those of [`Axis::new`].
    pub fn revolute(direction: Vector3<f64>, point: Point3<f64>) -> Result<Self> {
        Ok(Screw::Revolute(Axis::new(direction, point)?))
    }

    /// Builds a prismatic joint along `direction`, which may have any length.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when `direction` is zero or not finite.
    pub fn prismatic(direction: Vector3<f64>) -> Result<Self> {
        Ok(Screw::Prismatic(unit(direction)?))
    }

    /// The joint transformed by `motion`: `motion exp(q) motion^-1`.
    #[must_use]
    pub fn moved(&self, motion: &Pose) -> Screw {
        match self {
            Screw::Revolute(axis) => Screw::Revolute(axis.moved(motion)),
            Screw::Prismatic(direction) => Screw::Prismatic(motion.rotation * direction),
        }
    }

    /// The joint with the opposite direction of motion: `exp(-q)`.
    #[must_use]
    pub(crate) fn reversed(&self) -> Screw {
        match self {
            Screw::Revolute(axis) => Screw::Revolute(Axis { direction: -axis.direction, ..*axis }),
            Screw::Prismatic(direction) => Screw::Prismatic(-*direction),
        }
    }

    /// The axis of a revolute joint.
    pub fn axis(&self) -> Option<&Axis> {
        match self {
            Screw::Revolute(axis) => Some(axis),
            Screw::Prismatic(_) => None,
        }
    }

    /// `p` \[m\] moved by the joint at `q` (\[rad\] when revolute, \[m\] when prismatic).
    pub(crate) fn carry(&self, q: f64, p: &Point3<f64>) -> Point3<f64> {
        match self {
            Screw::Revolute(axis) => axis.rotate(q, p),
            Screw::Prismatic(direction) => p + direction.scale(q),
        }
    }

    /// Same as [`Screw::exp`], but with the known sine and cosine of half the value.
    pub(crate) fn exp_half(&self, value: Half) -> Pose {
        match self {
            Screw::Revolute(axis) => axis.rotation_by_half((value.sine, value.cosine)),
            Screw::Prismatic(_) => self.exp(value.q),
        }
    }

    /// The rigid transform of the joint at `q` (\[rad\] when revolute, \[m\] when prismatic), RH0 (2-7).
    pub fn exp(&self, q: f64) -> Pose {
        match self {
            Screw::Revolute(axis) => axis.rotation(q),
            Screw::Prismatic(direction) => Pose::translation(direction.x * q, direction.y * q, direction.z * q),
        }
    }
}

/// The unit vector of `direction`, of any magnitude.
fn unit(direction: Vector3<f64>) -> Result<Unit<Vector3<f64>>> {
    let size = direction.amax();
    if direction.iter().all(|x| x.is_finite()) && size > 0.0 {
        return Ok(Unit::new_normalize(direction / size));
    }
    let [x, y, z] = direction.into();
    let text = format!("axis [{x}, {y}, {z}] has no direction; give a finite, non-zero vector");
    Err(Error::new(ErrorKind::BadValue, text))
}
