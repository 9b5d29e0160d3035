//! The screw solver of two revolute joints with parallel axes (hip and knee pitch, an elbow in a plane).
//!
//! The distance of the tip from the first axis depends on the second joint only, so Paden-Kahan 3 gives q2. Then
//! Paden-Kahan 1 gives q1. This is the reduction of RH0 (3-15)..(3-18).

use nalgebra::{Point3, Vector3};

use super::one_joint::{Circle, rotate_to_distance};
use super::values::{Reach, TOLERANCE, Values};
use crate::spatial::Axis;
use crate::{Error, ErrorKind, Result};

/// Two revolute joints with parallel, distinct axes, and a tip. Coordinates in the base frame at q = (0, 0), metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TwoLink {
    first: Axis,
    second: Axis,
    tip: Point3<f64>,
    reach: f64,
}

/// One inverse-kinematics solution.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Solution {
    /// q1 and q2 in (-pi, pi] \[rad\]; `None` for a free joint.
    pub q: [Option<f64>; 2],
    /// Distance of the tip from the target \[m\] by forward kinematics, with free joints at zero.
    pub residual: f64,
}

impl TwoLink {
    /// Builds the chain that rotates `tip` first about `second`, then about `first`.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when the axes are not parallel (to 1e-12 rad; the directions may be opposite) or
    /// coincide (to 1e-12 of the reach), or `tip` is not finite.
    pub fn new(first: Axis, second: Axis, tip: Point3<f64>) -> Result<Self> {
        check_finite("tip", &tip)?;
        if first.direction().cross(&second.direction()).norm() > TOLERANCE {
            return Err(Error::new(ErrorKind::BadValue, "the axes of a two-link chain must be parallel"));
        }
        let (first, second) = (first.level_with(&tip), second.level_with(&tip));
        let length = length(&(second.point() - first.point()));
        let reach = length + self::length(&(tip - second.point()));
        if length > TOLERANCE * reach && reach.is_finite() {
            return Ok(TwoLink { first, second, tip, reach });
        }
        let text = format!("the axes of a two-link chain are {length} m apart; give two distinct, finite ones");
        Err(Error::new(ErrorKind::BadValue, text))
    }

    /// The tip \[m\] at the joint angles `q` \[rad\].
    pub fn forward(&self, q: [f64; 2]) -> Point3<f64> {
        self.first.rotate(q[0], &self.second.rotate(q[1], &self.tip))
    }

    /// The greatest distance of the tip from the first axis \[m\]: the sum of the two link lengths.
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// Computes all solutions for `target` \[m\]: none, one or two.
    ///
    /// A target within 1e-12 of the reach of a reachable one counts as reached, with its residual. Two solutions merge
    /// where the arm is stretched or folded (the rounding rule of [`super::values`]). The first joint is free when
    /// target and folded tip are on its axis, the second when the tip is on the second axis.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when `target` is not finite.
    pub fn solve(&self, target: &Point3<f64>) -> Result<Vec<Solution>> {
        check_finite("target", target)?;
        let height = self.first.direction().dot(&(target - self.tip));
        if height.abs() > TOLERANCE * self.reach {
            return Ok(Vec::new());
        }
        let base = self.first.point();
        let distance = length(&(target - self.first.foot(target)));
        let answers: Vec<Solution> = match rotate_to_distance(&self.second, &self.tip, &base, distance, Reach::EXACT) {
            Values::Free => self.complete(None, target).into_iter().collect(),
            angles => angles.iter().filter_map(|q2| self.complete(Some(q2), target)).collect(),
        };
        match answers.iter().find(|answer| answer.q[0].is_none()) {
            Some(folded) => Ok(vec![*folded]),
            None => Ok(answers),
        }
    }

    /// The solution with the second joint at `q2`.
    fn complete(&self, q2: Option<f64>, target: &Point3<f64>) -> Option<Solution> {
        let elbow = q2.unwrap_or(0.0);
        let circle = Circle::new(&self.first, &self.second.rotate(elbow, &self.tip), target)?;
        let q1 = (circle.farthest() > TOLERANCE * self.reach).then_some(circle.bearing);
        let residual = length(&(self.forward([q1.unwrap_or(0.0), elbow]) - target));
        Some(Solution { q: [q1, q2], residual })
    }
}

/// The length of `x`, without overflow or underflow.
fn length(x: &Vector3<f64>) -> f64 {
    x.x.hypot(x.y).hypot(x.z)
}

/// Checks that the coordinates of the point `name` are finite.
fn check_finite(name: &str, p: &Point3<f64>) -> Result<()> {
    if p.iter().all(|x| x.is_finite()) {
        return Ok(());
    }
    let [x, y, z] = (*p).into();
    Err(Error::new(ErrorKind::BadValue, format!("{name} [{x}, {y}, {z}]: give finite coordinates")))
}
