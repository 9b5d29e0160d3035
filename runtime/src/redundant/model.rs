//! Kinematics of an arm, and the equations of a target ([`Model`]): their derivatives, the direction and the curvature of the curve of solutions.

use core::f64::consts::TAU;

use super::arm::{Arm, Given, Limits, MOST_JOINTS, Q, Target};
use super::elimination::{Elimination, MOST_ROWS, Rows};
use super::goal::{Goal, carried};
use super::links::{Axes, Links};
use crate::arithmetic::Arithmetic;
#[cfg(test)]
use crate::six_axes::Rigid;
use crate::six_axes::Vector;
use crate::six_axes::vector::{add, cross, scale, sub};
use crate::solution::Error;
use crate::tolerances::ACCEPTANCE;

/// An arm and a target. Joint values `x` are scaled: a length is relative to [`Arm::length`], which all lengths are.
pub(super) struct Model<'a> {
    pub arm: &'a Arm,
    pub count: usize,
    links: Links,
    goal: Goal,
    /// Limits of the scaled values, as given.
    pub limits: Limits,
    /// Whether a joint is revolute and its range is at least one turn: its limits are reached by no curve, and values are compared up to whole turns.
    pub turns: [bool; MOST_JOINTS],
    /// The unit of the scaled values: 1 for an angle.
    pub units: [f64; MOST_JOINTS],
    /// A joint that is constant along the curve, where the equations are singular along the whole curve with this joint, and regular without it.
    pub frozen: Option<usize>,
}

/// The equations at joint values.
#[derive(Clone, Copy)]
pub(super) struct Place {
    pub x: Q,
    pub values: Rows,
    pub linear: Elimination,
}

impl<'a> Model<'a> {
    /// # Errors
    ///
    /// [`Error::Limits`].
    pub fn new(arm: &'a Arm, target: &Target, limits: &Limits) -> Result<Model<'a>, Error> {
        let mut model = Model {
            arm,
            count: arm.count,
            links: Links::of(arm),
            goal: Goal::new(arm, target),
            limits: [[f64::NEG_INFINITY, f64::INFINITY]; MOST_JOINTS],
            turns: [false; MOST_JOINTS],
            units: [1.0; MOST_JOINTS],
            frozen: None,
        };
        for i in 0..arm.count {
            let [low, high] = limits[i];
            let is_ordered = low <= high;
            if !is_ordered {
                return Err(Error::Limits(i));
            }
            model.turns[i] = !arm.slides[i] && high - low >= TAU - ACCEPTANCE.input;
            model.units[i] = if arm.slides[i] { arm.length } else { 1.0 };
            model.limits[i] = [low / model.units[i], high / model.units[i]];
        }
        Ok(model)
    }

    /// The values of the equations.
    #[cfg(test)]
    pub fn values(&self, x: &Q) -> Rows {
        self.goal.values(&self.tip(x))
    }

    /// The tip in the base frame.
    #[cfg(test)]
    pub fn tip(&self, x: &Q) -> Rigid {
        self.links.axes(self.arm, x).tip
    }

    /// The number of equations.
    pub fn rows(&self) -> usize {
        self.goal.rows()
    }

    /// Whether joint values that fulfil the equations reach the target, and not an orientation that is turned by half a turn.
    pub fn is_toward(&self, x: &Q) -> bool {
        self.goal.is_toward(&self.links.axes(self.arm, x).tip)
    }

    /// The equations, their derivatives, and the curve's direction.
    pub fn place(&self, x: &Q) -> Place {
        let axes = self.links.axes(self.arm, x);
        let linear = self.factors(&axes);
        Place { x: *x, values: self.goal.values(&axes.tip), linear }
    }

    /// A place, and the second derivative of the curve by its length.
    pub fn bent(&self, x: &Q) -> (Place, Q) {
        let axes = self.links.axes(self.arm, x);
        let linear = self.factors(&axes);
        let images = self.goal.images(&axes.tip);
        let mut bend = linear.least(&self.second(&axes, &images, &linear.tangent));
        for value in &mut bend {
            *value = -*value;
        }
        (Place { x: *x, values: self.goal.values(&axes.tip), linear }, bend)
    }

    /// The factors of the equations' derivatives.
    #[inline(always)]
    fn factors(&self, axes: &Axes) -> Elimination {
        let images = self.goal.images(&axes.tip);
        let mut columns = [[0.0; MOST_ROWS]; MOST_JOINTS];
        for i in 0..self.count {
            let axis = &axes.directions[i];
            let [linear, angular] = if self.arm.slides[i] {
                [axis, &[0.0; 3]]
            } else {
                [&cross(axis, &sub(&axes.tip.translation, &axes.points[i])), axis]
            };
            columns[i] = self.goal.rates(&images, linear, angular);
        }
        let rows = self.goal.rows();
        match self.frozen {
            None => Elimination::of(&columns, rows),
            Some(joint) => Elimination::without(&columns, rows - 1, joint),
        }
    }

    /// The values of the equations, and their rates where the joints move with rates `t`.
    pub fn moving(&self, x: &Q, t: &Q) -> [Rows; 2] {
        let axes = self.links.axes(self.arm, x);
        let [mut linear, mut angular] = [[0.0; 3]; 2];
        for i in 0..self.count {
            let motion = scale(&axes.directions[i], t[i]);
            if self.arm.slides[i] {
                linear = add(&linear, &motion);
            } else {
                linear = add(&linear, &cross(&motion, &sub(&axes.tip.translation, &axes.points[i])));
                angular = add(&angular, &motion);
            }
        }
        [self.goal.values(&axes.tip), self.goal.rates(&self.goal.images(&axes.tip), &linear, &angular)]
    }

    /// The second derivatives of the equations where the joints move with constant rates `t`.
    fn second(&self, axes: &Axes, images: &[Vector; 2], t: &Q) -> Rows {
        let [mut velocity, mut angular, mut linear] = [[0.0; 3]; 3];
        for i in 0..self.count {
            let motion = scale(&axes.directions[i], t[i]);
            if self.arm.slides[i] {
                linear = add(&linear, &scale(&cross(&velocity, &motion), 2.0));
            } else {
                angular = add(&angular, &cross(&velocity, &motion));
                velocity = add(&velocity, &motion);
            }
            let next = if i + 1 < self.count { &axes.points[i + 1] } else { &axes.tip.translation };
            let r = sub(next, &axes.points[i]);
            linear = add(&linear, &carried(&r, &angular, &velocity));
        }
        self.goal.accelerations(images, &linear, &angular, &velocity)
    }

    /// Scaled joint values.
    pub fn scaled(&self, q: &Q) -> Q {
        let mut x = [0.0; MOST_JOINTS];
        for i in 0..self.count {
            x[i] = q[i] / self.units[i];
        }
        x
    }

    /// Joint values of scaled ones. An angle whose range is at least one turn is moved within its limits.
    pub fn unscaled(&self, x: &Q) -> Q {
        let mut q = [0.0; MOST_JOINTS];
        for i in 0..self.count {
            q[i] = x[i] * self.units[i];
            if self.turns[i] {
                q[i] = shifted(q[i], self.limits[i]);
            }
        }
        q
    }

    /// Whether limits of the joint are reached along curves.
    pub fn is_limited(&self, joint: usize) -> bool {
        !self.turns[joint] && self.arm.given[joint] != Given::Constant
    }

    /// Moves angles by whole turns within limits, or next to them. Returns the joints that are beyond their limits by more than the tolerance, as bits.
    pub fn lift(&self, x: &mut Q) -> u32 {
        let mut beyond = 0;
        for i in 0..self.count {
            if self.turns[i] {
                continue;
            }
            let [low, high] = self.limits[i];
            if !self.arm.slides[i] {
                x[i] = shifted(x[i], self.limits[i]);
            }
            if x[i] < low - ACCEPTANCE.input || x[i] > high + ACCEPTANCE.input {
                beyond |= 1 << i;
            }
        }
        beyond
    }

    /// Whether no joint differs by more than `most`; angles whose range is at least one turn are compared up to whole turns.
    pub fn are_close(&self, a: &Q, b: &Q, most: f64) -> bool {
        for i in 0..self.count {
            let mut d = a[i] - b[i];
            if self.turns[i] && d.abs() > most {
                d -= TAU * Arithmetic::round(d / TAU);
            }
            if d.abs() > most {
                return false;
            }
        }
        true
    }

    /// The difference `a - b`; angles whose range is at least one turn are compared up to whole turns.
    pub fn difference(&self, a: &Q, b: &Q) -> Q {
        let mut d = [0.0; MOST_JOINTS];
        for i in 0..self.count {
            d[i] = a[i] - b[i];
            if self.turns[i] {
                d[i] -= TAU * Arithmetic::round(d[i] / TAU);
            }
        }
        d
    }
}

/// The angle moved by as few turns as possible within limits. Where that is impossible, it is moved to where it exceeds them least.
fn shifted(angle: f64, [low, high]: [f64; 2]) -> f64 {
    if angle >= low && angle <= high {
        // Without the sign of a zero.
        return angle + 0.0;
    }
    let up = Arithmetic::ceil((low - ACCEPTANCE.input - angle) / TAU);
    let down = Arithmetic::floor((high + ACCEPTANCE.input - angle) / TAU);
    if up <= down {
        return angle + TAU * f64::min(f64::max(0.0, up), down);
    }
    // `up` is the first turn above the lower limit, and beyond the upper one; `down` is the last turn below.
    let (above, below) = (angle + TAU * up, angle + TAU * down);
    if above - high < low - below { above } else { below }
}

pub(super) fn dot(a: &Q, b: &Q) -> f64 {
    let mut sum = 0.0;
    for i in 0..MOST_JOINTS {
        sum += a[i] * b[i];
    }
    sum
}

pub(super) fn norm(a: &Q) -> f64 {
    Arithmetic::sqrt(dot(a, a))
}

/// `a + factor b`.
pub(super) fn plus(a: &Q, factor: f64, b: &Q) -> Q {
    let mut sum = *a;
    for i in 0..MOST_JOINTS {
        sum[i] += factor * b[i];
    }
    sum
}

/// The largest magnitude of an entry.
pub(super) fn farthest(d: &Q) -> f64 {
    let mut largest = 0.0;
    for value in d {
        largest = f64::max(largest, value.abs());
    }
    largest
}
