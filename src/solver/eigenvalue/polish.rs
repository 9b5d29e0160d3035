//! Forward kinematics of the chain, and Newton steps on it ([`Links`]).

use serde::{Deserialize, Serialize};

use super::candidates::turn;
use super::linear::solve;
use super::scalar::{Vector, add, cross, dot, scale, sub};

/// A rigid motion.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Rigid {
    /// The rotation matrix, by rows.
    pub rotation: [[f64; 3]; 3],
    /// The image of the origin.
    pub translation: Vector<f64>,
}

impl Rigid {
    /// The direction `v` turned.
    pub fn turned(&self, v: &Vector<f64>) -> Vector<f64> {
        self.rotation.each_ref().map(|row| dot(row, v))
    }

    /// The point `p` moved.
    pub fn moved(&self, p: &Vector<f64>) -> Vector<f64> {
        add(&self.turned(p), &self.translation)
    }

    /// The motion back.
    pub fn inverse(&self) -> Rigid {
        let rotation = std::array::from_fn(|i| std::array::from_fn(|j| self.rotation[j][i]));
        let back = Rigid { rotation, translation: [0.0; 3] };
        Rigid { translation: back.turned(&self.translation).map(|entry| -entry), ..back }
    }

    /// This motion after `other`.
    pub fn after(&self, other: &Rigid) -> Rigid {
        let columns = [0, 1, 2].map(|column| self.turned(&other.rotation.map(|row| row[column])));
        let rotation = std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i]));
        Rigid { rotation, translation: self.moved(&other.translation) }
    }

    fn column(&self, index: usize) -> Vector<f64> {
        self.rotation.map(|row| row[index])
    }

    /// Then a turn about the moved z axis, or a slide along it.
    fn then(&self, slides: bool, value: f64) -> Rigid {
        if slides {
            let translation = add(&self.translation, &scale(&self.column(2), value));
            return Rigid { translation, ..*self };
        }
        let (s, c) = (value.sin(), value.cos());
        let rotation = self.rotation.map(|[x, y, z]| [c * x + s * y, c * y - s * x, z]);
        Rigid { rotation, ..*self }
    }
}

/// The chain as frames of its joints, which turn about their z axes or slide along them.
#[derive(Clone, Debug, PartialEq)]
pub struct Links {
    /// Each joint's frame in that of the joint before, the first in the base, at zero.
    pub steps: [Rigid; 6],
    /// By joint: whether it slides.
    pub slides: [bool; 6],
}

/// What a joint vector reaches.
pub(super) struct Reach {
    axes: [Vector<f64>; 6],
    origins: [Vector<f64>; 6],
    end: Rigid,
}

/// Newton steps at most: at a singular pose each only halves the miss.
pub(super) const STEPS: usize = 40;
/// A miss below which no further step is tried.
pub(super) const EXACT: f64 = 2e-15;
/// A miss below which a single step that does not halve it is the last.
pub(super) const ROUNDING: f64 = 1e-13;
/// How often a step may be shortened, over all steps.
pub(super) const SHORTENED: usize = 12;
/// A column of the Jacobian of which no more than this share is across the columns behind it depends on them.
pub(super) const SINGULAR: f64 = 1e-6;
/// A step that moves a joint by more than this is shortened.
pub(super) const LONGEST: f64 = 0.5;

impl Links {
    pub(super) fn reach(&self, q: &[f64; 6]) -> Reach {
        let (mut axes, mut origins) = ([[0.0; 3]; 6], [[0.0; 3]; 6]);
        let mut frame = self.steps[0];
        for joint in 0..6 {
            frame = if joint == 0 { frame } else { frame.after(&self.steps[joint]) };
            (axes[joint], origins[joint]) = (frame.column(2), frame.translation);
            frame = frame.then(self.slides[joint], q[joint]);
        }
        Reach { axes, origins, end: frame }
    }

    /// The frame of the last joint at `q`, moved with it.
    pub fn end(&self, q: &[f64; 6]) -> Rigid {
        self.reach(q).end
    }

    /// The value of `joint` that brings the end nearest to `target`, the frame of the last joint, given all others.
    pub fn closing(&self, q: &[f64; 6], joint: usize, target: &Rigid) -> f64 {
        let mut before = self.steps[0];
        for (k, step) in self.steps[1..].iter().enumerate().take(joint) {
            before = before.then(self.slides[k], q[k]).after(step);
        }
        let mut behind = Rigid { rotation: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], translation: [0.0; 3] };
        for (k, step) in self.steps.iter().enumerate().skip(joint + 1) {
            behind = behind.after(step).then(self.slides[k], q[k]);
        }
        let motion = before.inverse().after(target).after(&behind.inverse());
        let r = motion.rotation;
        if self.slides[joint] { motion.translation[2] } else { turn(r[0][0] + r[1][1], r[1][0] - r[0][1]) }
    }

    /// How far the end is from `target`: the way, in the unit of lengths, and the turn (rad).
    pub(super) fn miss(reach: &Reach, target: &Rigid) -> [f64; 6] {
        let way = sub(&target.translation, &reach.end.translation);
        let turns = [0, 1, 2].map(|index| cross(&reach.end.column(index), &target.column(index)));
        let turn = [0, 1, 2].map(|k| 0.5 * (turns[0][k] + turns[1][k] + turns[2][k]));
        [way[0], way[1], way[2], turn[0], turn[1], turn[2]]
    }

    /// Newton steps from `q` to `target`, shortened where they lead away from it; the residual before and after them.
    pub fn polish(&self, q: &mut [f64; 6], target: &Rigid) -> (f64, f64) {
        let mut reach = self.reach(q);
        let mut miss = Links::miss(&reach, target);
        let start = size(&miss);
        let mut shortened = 0;
        for _ in 0..STEPS {
            let known = size(&miss);
            if known <= EXACT || !known.is_finite() {
                break;
            }
            let Some(step) = self.newton(&reach, &miss) else { break };
            let mut share = 1.0;
            let (next, next_reach, next_miss) = loop {
                let next: [f64; 6] = std::array::from_fn(|joint| q[joint] + share * step[joint]);
                let reach = self.reach(&next);
                let miss = Links::miss(&reach, target);
                if size(&miss) < known || known <= ROUNDING || shortened >= SHORTENED {
                    break (next, reach, miss);
                }
                (share, shortened) = (0.25 * share, shortened + 1);
            };
            let left = size(&next_miss);
            if left >= known {
                break;
            }
            (*q, reach, miss) = (next, next_reach, next_miss);
            if left > 0.5 * known && left <= ROUNDING {
                break;
            }
        }
        (start, size(&miss))
    }

    /// Joints that joints behind them make up for, to first order: their columns of the Jacobian depend on those of the joints behind.
    pub fn free(&self, q: &[f64; 6]) -> [bool; 6] {
        let matrix = self.jacobian(&self.reach(q));
        let (mut kept, mut count, mut free) = ([[0.0; 6]; 6], 0, [false; 6]);
        for joint in (0..6).rev() {
            let mut column = matrix.map(|row| row[joint]);
            let whole = length(&column);
            for _ in 0..2 {
                for direction in &kept[..count] {
                    let share = direction.iter().zip(&column).map(|(a, b)| a * b).sum::<f64>();
                    column.iter_mut().zip(direction).for_each(|(entry, over)| *entry -= share * over);
                }
            }
            let left = length(&column);
            free[joint] = left <= SINGULAR * whole;
            if !free[joint] {
                kept[count] = column.map(|entry| entry / left);
                count += 1;
            }
        }
        free
    }

    /// The derivatives of the end's place and turn by the joints, in columns.
    pub(super) fn jacobian(&self, reach: &Reach) -> [[f64; 6]; 6] {
        let mut matrix = [[0.0; 6]; 6];
        for (joint, (axis, origin)) in reach.axes.iter().zip(&reach.origins).enumerate() {
            let (way, turn) = if self.slides[joint] {
                (*axis, [0.0; 3])
            } else {
                (cross(axis, &sub(&reach.end.translation, origin)), *axis)
            };
            matrix.iter_mut().zip(way.iter().chain(&turn)).for_each(|(row, entry)| row[joint] = *entry);
        }
        matrix
    }

    /// A step that makes the miss vanish to first order, no longer than [`LONGEST`].
    fn newton(&self, reach: &Reach, miss: &[f64; 6]) -> Option<[f64; 6]> {
        let mut right = miss.map(|entry| [entry]);
        if solve(&mut self.jacobian(reach), &mut right) <= 0.0 {
            return None;
        }
        let step = right.map(|[entry]| entry);
        let longest = size(&step);
        let share = if longest > LONGEST { LONGEST / longest } else { 1.0 };
        longest.is_finite().then(|| step.map(|entry| share * entry))
    }
}

fn length(v: &[f64; 6]) -> f64 {
    v.iter().map(|entry| entry * entry).sum::<f64>().sqrt()
}

pub(super) fn size(miss: &[f64; 6]) -> f64 {
    miss.iter().fold(0.0, |most, entry| if entry.abs() > most || entry.is_nan() { entry.abs() } else { most })
}
