//! Positions of the axes and of the tip ([`Links`]).

use super::arm::{Arm, MOST_JOINTS, Q};
use super::goal::across;
use crate::angles::angle;
use crate::arithmetic::Arithmetic;
use crate::six_axes::vector::{add, cosines_and_sines, cross, dot, scale, sub};
use crate::six_axes::{Rigid, Vector};

/// An entry for each joint. With an even number of them, the processor computes all entries with pairs.
type Angles = [f64; MOST_JOINTS + 1];

/// From one joint to the next. The frame of a joint has z along its axis and x orthogonal to the next axis, too. The frame is turned about z by the joint's
/// angle, moved, and then turned about x, so that z is along the next axis.
#[derive(Clone, Copy)]
struct Link {
    /// The next point in the turned frame.
    shift: Vector,
    /// The cosine and the sine of the angle about x.
    twist: [f64; 2],
}

/// An arm by links. Lengths are relative to [`Arm::length`].
pub(super) struct Links {
    /// The first joint's frame at zero: x, y, z, and the origin.
    base: [Vector; 4],
    list: [Link; MOST_JOINTS],
    /// The angles at zero \[rad\], and 1 for a joint that turns, 0 for a prismatic one.
    offsets: Angles,
    turns: Angles,
    /// The columns of the tip's rotation in the last frame.
    tip: [Vector; 3],
}

/// Axes, points on them, and the tip at joint values, in the base frame.
pub(super) struct Axes {
    pub directions: [Vector; MOST_JOINTS],
    pub points: [Vector; MOST_JOINTS],
    pub tip: Rigid,
}

/// `a x + b y`.
#[inline(always)]
fn mixed(a: f64, x: &Vector, b: f64, y: &Vector) -> Vector {
    [a * x[0] + b * y[0], a * x[1] + b * y[1], a * x[2] + b * y[2]]
}

/// A unit vector orthogonal to two axes; to the first one if they are parallel.
fn normal(first: &Vector, second: &Vector) -> Vector {
    let product = cross(first, second);
    let square = dot(&product, &product);
    if square < f64::MIN_POSITIVE { across(first)[0] } else { scale(&product, 1.0 / Arithmetic::sqrt(square)) }
}

impl Links {
    pub fn of(arm: &Arm) -> Links {
        let shrink = 1.0 / arm.length;
        let none = Link { shift: [0.0; 3], twist: [1.0, 0.0] };
        let mut links = Links {
            base: [[0.0; 3]; 4],
            list: [none; MOST_JOINTS],
            offsets: [0.0; MOST_JOINTS + 1],
            turns: [0.0; MOST_JOINTS + 1],
            tip: [[0.0; 3]; 3],
        };
        let end = scale(&arm.tip.translation, shrink);
        let point = |i: usize| if arm.slides[i] { end } else { scale(&arm.points[i], shrink) };
        let mut before = [0.0; 3];
        for i in 0..arm.count {
            let z = arm.directions[i];
            let is_last = i + 1 == arm.count;
            let next = if is_last { z } else { arm.directions[i + 1] };
            let x = normal(&z, &next);
            let y = cross(&z, &x);
            if i == 0 {
                links.base = [x, y, z, point(0)];
                before = x;
            }
            let r = sub(&if is_last { end } else { point(i + 1) }, &point(i));
            links.offsets[i] = angle(dot(&before, &x), dot(&z, &cross(&before, &x)));
            links.turns[i] = if arm.slides[i] { 0.0 } else { 1.0 };
            links.list[i] = Link {
                shift: [dot(&x, &r), dot(&y, &r), dot(&z, &r)],
                twist: [dot(&z, &next), dot(&x, &cross(&z, &next))],
            };
            if is_last {
                for k in 0..3 {
                    let column = arm.tip.column(k);
                    links.tip[k] = [dot(&x, &column), dot(&y, &column), dot(&z, &column)];
                }
            }
            before = x;
        }
        links
    }

    /// The cosines and the sines of the angles between the frames.
    #[inline(always)]
    fn turned(&self, x: &Q) -> [Angles; 2] {
        let mut angles = self.offsets;
        for i in 0..MOST_JOINTS {
            angles[i] += self.turns[i] * x[i];
        }
        cosines_and_sines(&angles)
    }

    /// The frame after a joint whose angle has this cosine and sine. A prismatic joint moves by `slide`.
    #[inline(always)]
    fn after(&self, [x, y, z, mut p]: [Vector; 4], i: usize, [c, s]: [f64; 2], slide: Option<f64>) -> [Vector; 4] {
        let link = &self.list[i];
        if let Some(value) = slide {
            p = add(&p, &scale(&z, value));
        }
        let (x, y) = (mixed(c, &x, s, &y), mixed(c, &y, -s, &x));
        let [a, b, d] = link.shift;
        p = add(&add(&p, &scale(&z, d)), &mixed(a, &x, b, &y));
        let [c, s] = link.twist;
        [x, mixed(c, &y, s, &z), mixed(c, &z, -s, &y), p]
    }

    /// The tip of the last frame.
    #[inline(always)]
    fn last(&self, [x, y, z, p]: [Vector; 4]) -> Rigid {
        let mut tip = Rigid { translation: p, ..Rigid::NONE };
        for k in 0..3 {
            let [a, b, d] = self.tip[k];
            let column = add(&mixed(a, &x, b, &y), &scale(&z, d));
            for i in 0..3 {
                tip.rotation[i][k] = column[i];
            }
        }
        tip
    }

    /// Axes and tip at joint values.
    pub fn axes(&self, arm: &Arm, x: &Q) -> Axes {
        let mut axes = Axes { directions: [[0.0; 3]; MOST_JOINTS], points: [[0.0; 3]; MOST_JOINTS], tip: Rigid::NONE };
        let [cosines, sines] = self.turned(x);
        let mut at = self.base;
        for i in 0..arm.count {
            axes.directions[i] = at[2];
            axes.points[i] = at[3];
            let slide = if arm.slides[i] { Some(x[i]) } else { None };
            at = self.after(at, i, [cosines[i], sines[i]], slide);
        }
        axes.tip = self.last(at);
        axes
    }
}
