//! The solver: formulations in turn until one can be trusted ([`EigenvalueSolver`]).

use super::answers::{ACCEPT, Answer, Answers, wrapped};
use super::candidates::{BLURRED, Candidates, DEEPEST};
use super::curve::Walk;
use super::formulation::{Equations, Formulation};
use super::polish::{Links, Rigid};
use super::profile::Frame;
use super::scalar::{Vector, cross, dot, scale};
use super::screw::{Axis, Figure, Line};

/// The share of a pivot below which another formulation is asked too.
pub(super) const SOUND: f64 = 1e-11;

/// The share of a pivot at which a target without real eigenvalues is out of reach.
pub(super) const CLEAR: f64 = 1e-6;
/// A candidate that misses the target by more before polishing shows that the eigenvalues are not accurate.
pub(super) const ACCURATE: f64 = 1e-6;
/// What stands in for the accuracy of the eigenvalues when it is better than that.
pub(super) const UNKNOWN: f64 = 1e-11;
/// The square of a complex eigenvalue's depth as a multiple of the eigenvalues' accuracy: below it, it may be a double root.
pub(super) const OFF: f64 = 1e3;
/// Below it, it is tried.
pub(super) const FAR_OFF: f64 = 1e7;
/// Formulations, or origins of one, that are run at most.
const MOST_RUNS: usize = 8;
/// How far aside the target is put for each of them: where solutions share a hidden angle, or a self-motion stands at the same
/// target, the eigenvectors of isolated ones are only found next to it.
pub(super) const DISTURBANCES: [f64; MOST_RUNS] = [0.0, 0.0, 0.0, 0.0, 1e-4, 1e-4, 1e-3, 1e-3];
/// A way of so many length scales stands for an infinite one.
pub(super) const LONG: f64 = 1e4;
/// Stages in which a candidate next to the target is led to it.
pub(super) const STAGES: usize = 20;
/// The axis of these small turns.
pub(super) const DIRECTION: [f64; 3] = [0.48, 0.6, 0.64];

/// The axes of six joints at zero, from base to tip.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layout {
    /// Directions of length one, and points; of a joint that slides any point.
    pub lines: [Line<f64>; 6],
    /// By joint: whether it slides along its axis.
    pub slides: [bool; 6],
    /// A typical length of the chain, in the same unit.
    pub length: f64,
}

/// The solver of one chain of six joints.
#[derive(Clone, Debug, PartialEq)]
pub struct EigenvalueSolver {
    pub(crate) axes: [Axis<f64>; 6],
    figures: [Figure<f64>; 6],
    pub(crate) frames: [Frame<f64>; 6],
    pub(crate) links: Links,
    pub(crate) last: Rigid,
    pub(crate) scale: f64,
    formulations: Vec<Formulation>,
}

impl EigenvalueSolver {
    /// The solver of the chain with these axes; the formulations are taken in this order.
    ///
    /// # Panics
    /// Without a formulation.
    pub fn new(layout: &Layout, formulations: Vec<Formulation>) -> Self {
        assert!(!formulations.is_empty(), "a solver has a formulation at least");
        let Layout { lines, slides, length } = *layout;
        let short = |line: Line<f64>| Line { point: scale(&line.point, 1.0 / length), ..line };
        let axes: [_; 6] = std::array::from_fn(|joint| Axis::along(short(lines[joint]), slides[joint]));
        let frames = axes.map(|axis| frame(&axis.line));
        let figures = std::array::from_fn(|joint: usize| Figure::of(&axes[joint], frames[joint].across[0]));
        let poses = frames.map(|frame| pose(&frame));
        let step = |joint: usize| match joint {
            0 => poses[0],
            _ => poses[joint - 1].inverse().after(&poses[joint]),
        };
        let links = Links { steps: std::array::from_fn(step), slides };
        EigenvalueSolver { axes, figures, frames, links, last: poses[5], scale: length, formulations }
    }

    /// The displacement `E1 ... E6` for joint angles \[rad\] and ways `q`, in the unit of length that the lines were given in.
    pub fn forward(&self, q: &[f64; 6]) -> Rigid {
        let end = self.links.end(&self.scaled(q, 1.0 / self.scale)).after(&self.last.inverse());
        Rigid { translation: scale(&end.translation, self.scale), ..end }
    }

    /// The joints with ways times a factor.
    fn scaled(&self, q: &[f64; 6], factor: f64) -> [f64; 6] {
        std::array::from_fn(|joint| if self.links.slides[joint] { q[joint] * factor } else { q[joint] })
    }

    /// The formulations, in the order in which they are taken.
    pub fn formulations(&self) -> &[Formulation] {
        &self.formulations
    }

    /// All real solutions of `E1 ... E6 = displacement`, which takes the chain's tip from its place at zero to the target.
    pub fn solve(&self, displacement: &Rigid) -> Answers {
        self.attempts(displacement, MOST_RUNS)
    }

    /// What the first formulation alone finds.
    pub fn attempt(&self, displacement: &Rigid) -> Answers {
        self.attempts(displacement, 1)
    }

    fn attempts(&self, displacement: &Rigid, most: usize) -> Answers {
        let translation = scale(&displacement.translation, 1.0 / self.scale);
        let displacement = Rigid { translation, ..*displacement };
        let target = displacement.after(&self.last);
        let mut answers = Answers::none();
        for (attempt, size) in DISTURBANCES.into_iter().enumerate().take(most) {
            answers.runs += 1;
            // One run aside shows too little of what may be beside it.
            let is_first_aside = size > 0.0 && DISTURBANCES[attempt - 1] == 0.0;
            answers.lost_count = if is_first_aside { 0 } else { answers.lost_count };
            if self.run(attempt, size, &displacement, &target, &mut answers) && !is_first_aside {
                answers.is_trusted = true;
                break;
            }
        }
        if answers.runs > 1 {
            self.walk(&target, &mut answers);
        }
        for answer in &mut answers.list[..answers.count] {
            // A run that can be trusted at once has seen no self-motion.
            answer.free = if answers.runs > 1 { self.links.free(&answer.q) } else { [false; 6] };
            answer.q = self.scaled(&answer.q, self.scale);
        }
        for q in &mut answers.lost[..answers.lost_count] {
            *q = self.scaled(q, self.scale);
        }
        answers
    }

    /// Walks along the curves next to answers, and to candidates that led to none.
    fn walk(&self, target: &Rigid, answers: &mut Answers) {
        let mut walk = Walk::new(&self.links, target);
        for answer in answers.as_slice() {
            if walk.is_curve(&answer.q) {
                walk.begin(answer.q);
            }
        }
        answers.far[..answers.far_count].iter().chain(answers.lost()).for_each(|q| walk.begin(*q));
        walk.run(answers);
    }

    /// Adds the answers of one formulation, solved for a displacement that may be a little aside from the target and then led to it;
    /// whether it can be trusted to have found all.
    fn run(&self, attempt: usize, size: f64, goal: &Rigid, target: &Rigid, answers: &mut Answers) -> bool {
        let displacement = &aside(size, attempt).after(goal);
        let formulation = self.formulations[attempt % self.formulations.len()];
        let back = displacement.inverse();
        let carried = |motion: &Rigid| self.figures.map(|figure| carried(motion, &figure));
        let (frame, slides) = (&self.frames[formulation.hidden], &self.links.slides);
        let figures = [&self.figures, &carried(displacement), &carried(&back)];
        let equations = Equations::new(formulation, frame, &self.axes, figures);
        let deepest = if size > 0.0 { DEEPEST } else { BLURRED };
        let candidates = Candidates::new(&equations, formulation, slides, attempt, deepest);
        let Some(candidates) = candidates else { return false };
        let (near, mut lost, mut worst) = (displacement.after(&self.last), 0, 0.0_f64);
        let (known, mut own) = (answers.count, Answers::none());
        for candidate in &candidates.list[..candidates.count] {
            let is_far = candidate.depth * candidate.depth > FAR_OFF * worst.max(UNKNOWN);
            if (is_far && size <= 0.0) || self.is_infinite(&candidate.q) {
                continue;
            }
            let mut q = candidate.q;
            let missing = formulation.joint(3);
            q[missing] = self.links.closing(&q, missing, &near);
            let first = q;
            if is_far {
                answers.remember(first);
                continue;
            }
            let (start, mut residual) = self.links.polish(&mut q, &near);
            let mut last = q;
            if size > 0.0 {
                residual = self.links.polish(&mut q, target).1;
                if residual > ACCEPT {
                    q = last;
                    (last, residual) = self.led(attempt, size, goal, &mut q);
                }
            }
            if size > 0.0 && (residual > ACCEPT || candidate.depth > 0.0) {
                answers.remember(first);
            }
            if residual <= ACCEPT {
                worst = if candidate.depth == 0.0 { worst.max(start) } else { worst };
                let answer = Answer { q: wrapped(&q, slides), free: [false; 6], residual };
                answers.keep(answer, slides);
                own.keep(answer, slides);
            } else if candidate.depth * candidate.depth <= OFF * worst.max(UNKNOWN) {
                lost += 1;
                answers.lose(last);
            }
        }
        answers.start = answers.start.max(worst);
        let is_unreachable = candidates.count == 0 && candidates.conditioning >= CLEAR;
        let is_clear = lost == 0 && answers.count.is_multiple_of(2) && !candidates.is_crowded;
        let is_clear = is_clear && (answers.count > 0 || is_unreachable);
        let is_confirmed =
            attempt > 0 && known == answers.count && own.count == answers.count && answers.lost_count == 0;
        let is_sound = worst <= ACCURATE && candidates.conditioning >= SOUND;
        is_clear && (is_confirmed || is_sound && (size == 0.0 || answers.lost_count == 0))
    }

    /// Whether a way is so long that it stands for an infinite one, which chains with two sliding joints have among their eigenvalues.
    fn is_infinite(&self, q: &[f64; 6]) -> bool {
        q.iter().zip(&self.links.slides).any(|(way, slides)| *slides && (way.is_nan() || way.abs() > LONG))
    }

    /// Leads joints that reach a displacement aside from the goal to it in stages, each a quarter of the way from the goal that the one
    /// before was: next to a self-motion it is as flat as the target is near, and a step must be no longer. The joints of the last
    /// stage that succeeded, and the residual at the goal.
    fn led(&self, attempt: usize, mut size: f64, goal: &Rigid, q: &mut [f64; 6]) -> ([f64; 6], f64) {
        let (mut last, mut residual) = (*q, 1.0);
        for stage in 0..STAGES {
            size = if stage + 1 < STAGES { 0.25 * size } else { 0.0 };
            let target = aside(size, attempt).after(goal).after(&self.last);
            residual = self.links.polish(q, &target).1;
            if residual > ACCEPT {
                break;
            }
            last = *q;
        }
        (last, residual)
    }
}

/// A small motion by `size` (rad, and shares of the length scale), another for each attempt.
fn aside(size: f64, attempt: usize) -> Rigid {
    let sign = if attempt.is_multiple_of(2) { size } else { -size };
    let (s, c) = (sign.sin(), sign.cos());
    let about = |v: [f64; 3]| {
        let (w, along) = (DIRECTION, dot(&DIRECTION, &v) * (1.0 - c));
        let third = cross(&w, &v);
        std::array::from_fn(|k| c * v[k] + s * third[k] + along * w[k])
    };
    let columns: [[f64; 3]; 3] = [about([1.0, 0.0, 0.0]), about([0.0, 1.0, 0.0]), about([0.0, 0.0, 1.0])];
    let rotation = std::array::from_fn(|i| std::array::from_fn(|j| columns[j][i]));
    Rigid { rotation, translation: [-0.7 * sign, 0.5 * sign, 0.3 * sign] }
}

fn carried(motion: &Rigid, Figure { line, side }: &Figure<f64>) -> Figure<f64> {
    let line = Line { direction: motion.turned(&line.direction), point: motion.moved(&line.point) };
    Figure { line, side: side.map(|side| motion.turned(&side)) }
}

/// A frame on the line.
fn frame(line: &Line<f64>) -> Frame<f64> {
    let w = line.direction;
    let mut least = 0;
    for k in 1..3 {
        least = if w[k].abs() < w[least].abs() { k } else { least };
    }
    let mut unit: Vector<f64> = [0.0; 3];
    unit[least] = 1.0;
    let across = cross(&w, &unit);
    let e = scale(&across, 1.0 / dot(&across, &across).sqrt());
    Frame { origin: line.point, axis: w, across: [e, cross(&w, &e)] }
}

/// The frame as a motion of the base frame.
fn pose(frame: &Frame<f64>) -> Rigid {
    let [x, y, z] = [frame.across[0], frame.across[1], frame.axis];
    Rigid { rotation: [0, 1, 2].map(|k| [x[k], y[k], z[k]]), translation: frame.origin }
}
