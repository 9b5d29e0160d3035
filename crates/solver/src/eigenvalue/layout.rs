//! The axes of six joints ([`Layout`]), and their frames.

use groebot_runtime::six_axes::{Chain, Formulations, Given, Rigid};
use groebot_runtime::tolerances::ACCEPTANCE;
use nalgebra::Vector3;
use serde::{Deserialize, Serialize};

use super::formulation::Formulation;

/// A line with a direction, and a point on it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Line {
    /// The direction, of length one.
    pub direction: [f64; 3],
    /// Any point of the line.
    pub point: [f64; 3],
}

impl Line {
    /// Whether the direction has length one and the point is finite.
    pub(super) fn is_valid(&self) -> bool {
        let length: f64 = self.direction.iter().map(|x| x * x).sum();
        (length - 1.0).abs() <= ACCEPTANCE.input && self.point.iter().all(|entry| entry.is_finite())
    }
}

/// The axis of a joint with a given value between the six, at zero joint values.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct GivenLine {
    /// The number of joints of the six before it, 1 to 5.
    pub before: usize,
    /// Its axis. The point of a prismatic joint is arbitrary.
    pub line: Line,
    /// Whether it is prismatic.
    pub slides: bool,
}

impl GivenLine {
    /// The axis in the types of the run time, for a chain with this typical length.
    pub fn scaled(&self, length: f64) -> Given {
        let share = 1.0 / length;
        let GivenLine { before, line: Line { direction, point }, slides } = *self;
        Given { before, direction, point: point.map(|entry| entry * share), slides }
    }

    /// Whether it is between the six, and its line is one.
    pub(super) fn is_valid(&self) -> bool {
        (1..6).contains(&self.before) && self.line.is_valid()
    }
}

/// The axes of six joints at zero joint values, from base to tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layout {
    /// Directions of length one, and points. The point of a prismatic joint is arbitrary.
    pub lines: [Line; 6],
    /// By joint, whether it is prismatic.
    pub slides: [bool; 6],
    /// A typical length of the chain, in the same unit.
    pub length: f64,
}

impl Layout {
    /// The solver of the chain, in the unit of the lines. `tip` is the pose of the tip at zero joint values. The formulations are tried in this order.
    ///
    /// # Panics
    /// As [`Formulations::new`].
    pub fn chain(&self, tip: &Rigid, formulations: &[Formulation]) -> Chain {
        let formulations: Vec<_> = formulations.iter().map(|&formulation| formulation.into()).collect();
        let share = 1.0 / self.length;
        let lines = self.lines.map(|line| Line { point: line.point.map(|entry| entry * share), ..line });
        let across = lines.each_ref().map(across);
        let frames: [Rigid; 6] = std::array::from_fn(|joint| frame(&lines[joint], &across[joint]));
        let step = |joint: usize| match joint {
            0 => frames[0],
            _ => frames[joint - 1].inverse().after(&frames[joint]),
        };
        Chain {
            directions: lines.map(|line| line.direction),
            points: lines.map(|line| line.point),
            across,
            slides: self.slides,
            steps: std::array::from_fn(step),
            last: frames[5],
            back: tip.inverse(),
            length: self.length,
            formulations: Formulations::new(&formulations),
            within: 0.0,
        }
    }
}

/// Two unit vectors that are perpendicular to the line and to each other.
fn across(line: &Line) -> [[f64; 3]; 2] {
    let w = Vector3::from(line.direction);
    let e = w.cross(&Vector3::ith(w.iamin(), 1.0));
    let e = e * (1.0 / e.dot(&e).sqrt());
    [e.into(), w.cross(&e).into()]
}

/// The motion from the base frame to a frame whose z axis is the line.
fn frame(line: &Line, [x, y]: &[[f64; 3]; 2]) -> Rigid {
    Rigid { rotation: [0, 1, 2].map(|k| [x[k], y[k], line.direction[k]]), translation: line.point }
}
