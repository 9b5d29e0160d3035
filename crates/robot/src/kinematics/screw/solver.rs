//! The screw solver: all inverse-kinematics solutions of a chain, by an order of subproblems that it finds itself.

use std::ops::Range;

use nalgebra::UnitQuaternion;

use super::meeting::at_meeting_points;
use super::model::Model;
use super::order::{Order, Orders, samples};
use super::plan::Plan;
use super::reduced::{Goal, LOOSE, Reduced};
use super::refine::{MOST_JOINTS, Residual, moves_freely, refine};
use super::search::scale_of;
use super::values::Reach;
use super::{ACCEPT, MERGE, upright};
use crate::kinematics::ideal::TOLERANCE;
use crate::kinematics::upright::Upright;
use crate::kinematics::{Chain, Geometry, InverseKinematics, Solution, Target, Task};
use crate::spatial::{Half, Pose, Screw, angle};
use crate::{Error, ErrorKind, Result};

/// Factor between the tolerance of solutions and the tolerance of a step's target out of reach.
const LEVER: f64 = 30.0;
/// Solutions that differ by more than this are far from each other \[rad, or units of the reach\].
const APART: f64 = 5e-2;
/// If the Jacobian has a smaller singular value, a nearby pose may be at the boundary of the workspace.
const ORDINARY: f64 = 1e-3;
/// Residual above which solutions are refined.
const ENOUGH: f64 = 2e-14;

/// Inverse kinematics of a serial chain by screw theory. Lengths in the chain's unit, angles in radians.
///
/// The subproblems belong to the [ideal](Chain::ideal) robot. Solutions are refined and measured on the described
/// chain.
#[derive(Clone, Debug)]
pub struct ScrewSolver {
    chain: Chain,
    /// The ideal robot, whose axes intersect and are parallel exactly.
    ideal: Chain,
    model: Model,
    /// The described chain, if it differs.
    described: Option<Model>,
    orders: Orders,
    reach: f64,
    /// The loop equivalent to the task `position_pitch_roll`, and its solver.
    upright: Option<Box<(Upright, ScrewSolver)>>,
    /// The solver of the ideal robot, if the task has more numbers than the joints can control. It decides which
    /// solutions exist.
    ideal_solver: Option<Box<IdealSolver>>,
}

/// A partial solution during the steps.
struct PartialSolution {
    q: [Half; MOST_JOINTS],
    /// The motion of each joint's own screw at its value.
    motions: [Pose; MOST_JOINTS],
    free: [bool; MOST_JOINTS],
    /// Bit set of the steps that left a joint free.
    freeing: u32,
    branch: usize,
}

/// The solutions of one order for a goal.
struct Visit<'a> {
    order: &'a Order,
    /// Tolerance of a solution: fractions of the reach, and radians.
    accept: f64,
    /// The goal of the described chain, which solutions are measured by.
    goal: &'a Goal,
    found: &'a mut Vec<Solution>,
    /// Bit set of the steps that were not decisive: they left a joint free that the other steps determine, or have no
    /// object here.
    doubtful: u32,
}

impl ScrewSolver {
    /// Builds the solver of `chain` for its task, with the plan that has the fewest candidates.
    ///
    /// # Errors
    /// [`ErrorKind::PositiveDimensional`] when the task leaves joints undetermined; [`ErrorKind::Unsupported`] when no
    /// order of the known subproblems solves the chain; those of [`Chain::check_base`].
    pub fn new(chain: &Chain) -> Result<Self> {
        ScrewSolver::within(chain, TOLERANCE)
    }

    /// Same as [`ScrewSolver::new`], but with the ideal robot within `tolerance`, in radians and fractions of the
    /// reach. With zero, every digit is exact.
    ///
    /// # Errors
    /// Those of [`ScrewSolver::new`] and [`Chain::ideal_within`].
    pub fn within(chain: &Chain, tolerance: f64) -> Result<Self> {
        chain.check_base(None)?;
        let (ideal, report) = chain.ideal_within(tolerance)?;
        if chain.task() == Task::PositionPitchRoll {
            let upright = ideal.upright()?;
            let inner = ScrewSolver::within(&upright.chain, 0.0)?;
            let parts = Some(Box::new((upright, inner.clone())));
            return Ok(ScrewSolver { chain: chain.clone(), ideal, upright: parts, ideal_solver: None, ..inner });
        }
        let mut model = Model::of(&ideal)?;
        model.screws = at_meeting_points(&model.screws, 1e-9 * model.reach);
        let samples = samples(&ideal, &model)?;
        let scale = scale_of(&samples[0].start, model.reach);
        let Some(orders) = Orders::find(samples, scale) else { return Err(unsolved(&ideal)) };
        let (described, reach) = (if report.is_same() { None } else { Some(Model::of(chain)?) }, scale.length);
        let parts = (ideal.clone(), ideal.clone(), model.clone(), orders.clone());
        let solver = ScrewSolver {
            chain: chain.clone(),
            ideal,
            model,
            described,
            orders,
            reach,
            upright: None,
            ideal_solver: None,
        };
        Ok(if solver.described.is_some() && is_overdetermined(chain) {
            let (chain, ideal, model, orders) = parts;
            let inner =
                ScrewSolver { chain, ideal, model, described: None, orders, reach, upright: None, ideal_solver: None };
            ScrewSolver {
                ideal_solver: Some(Box::new(IdealSolver { solver: inner, within: 2.0 * report.bound() })),
                ..solver
            }
        } else {
            solver
        })
    }

    /// The order of subproblems. Other orders are also used, if one of its steps degenerates at a pose that is not
    /// singular or no solution is found.
    pub fn plan(&self) -> &Plan {
        &self.orders.first.plan
    }

    /// The chain that is solved.
    pub fn chain(&self) -> &Chain {
        &self.chain
    }

    /// Computes all solutions for `target`, each checked by forward kinematics to 2e-12 of the reach. The chain has no given
    /// joints.
    ///
    /// There are none for a target out of reach. Joint limits are not checked.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when the target is not of the task's kind, not finite, or its quaternion or direction
    /// not of norm one; when the chain has given joints.
    pub fn solve(&self, target: &Target) -> Result<Vec<Solution>> {
        self.solve_given(target, &[])
    }

    /// Same as [`ScrewSolver::solve`], but with the values `given` of the chain's given joints that are not mimic
    /// joints, from base to tip: radians or the chain's length unit. Solutions contain them unchanged.
    ///
    /// # Errors
    /// Those of [`ScrewSolver::solve`]; [`ErrorKind::BadValue`] unless there is one finite value for each of these.
    pub fn solve_given(&self, target: &Target, given: &[f64]) -> Result<Vec<Solution>> {
        self.chain.check_given(given)?;
        if let Some(parts) = &self.upright {
            let (upright, inner) = &**parts;
            target.check(&self.chain)?;
            let (closed, values) = upright.loop_target(target, given)?;
            let found = inner.solve_given(&closed, &values)?;
            return Ok(upright::on_chain(&self.chain, upright, target, found));
        }
        if let Some(ideal_solver) = &self.ideal_solver {
            target.check(&self.chain)?;
            let answers = ideal_solver.solve(target, given)?;
            return self.described_answers(target, answers);
        }
        self.solve_within(target, given, ACCEPT)
    }

    /// Same as [`ScrewSolver::solve_given`], but with the tolerance `accept`.
    pub(super) fn solve_within(&self, target: &Target, given: &[f64], accept: f64) -> Result<Vec<Solution>> {
        let given = &self.chain.given_values(given)[..];
        let mut start = self.model.start(target.goal(&self.ideal)?, given.iter().map(|&value| Half::new(value)));
        start.loose = Reach::Within(LOOSE.max(LEVER * accept));
        let goal = target.goal(if self.described.is_some() { &self.chain } else { &self.ideal })?;
        let mut found = Vec::with_capacity(self.plan().most_solutions());
        let doubtful = self.visit(&self.orders.first, &start, (&goal, accept), given, &mut found);
        let none = found.is_empty();
        let degenerate = (0..self.orders.first.steps.len()).filter(|at| none || doubtful >> at & 1 == 1);
        for order in degenerate.filter_map(|at| self.orders.without(at)) {
            self.visit(order, &start, (&goal, accept), given, &mut found);
        }
        found.retain(|answer| self.chain.strays(&answer.q) <= MERGE);
        Ok(found)
    }

    /// The solutions of the ideal robot, moved to where the described robot is nearest to the target, each once.
    fn described_answers(&self, target: &Target, answers: Vec<Solution>) -> Result<Vec<Solution>> {
        let Model { screws, tip, joints, .. } = self.described.as_ref().unwrap_or(&self.model);
        let (goal, mut found): (Goal, Vec<Solution>) = (target.goal(&self.chain)?, Vec::new());
        for answer in answers {
            let mut values: [f64; MOST_JOINTS] = std::array::from_fn(|i| answer.q.get(i).copied().unwrap_or(0.0));
            let mut motions: Vec<Pose> = screws.iter().zip(values).map(|(screw, q)| screw.exp(q)).collect();
            if let Some(ray) = screws.get(*joints) {
                values[*joints] = turn_about(ray, &motions[..*joints], &goal);
                motions[*joints] = ray.exp(values[*joints]);
            }
            let fixed = std::array::from_fn(|i| answer.free.contains(&i) || self.model.given.contains(&i));
            let start = (values, Residual::of(&motions, &goal, tip), &fixed);
            let (values, _) = refine(screws, &goal, tip, self.reach, start, ENOUGH);
            let wrapped = |(q, screw): (f64, &Screw)| if screw.axis().is_some() { angle::wrap(q) } else { q };
            let q: Vec<f64> = values.into_iter().zip(screws).take(*joints).map(wrapped).collect();
            if !found.iter().any(|other| self.chain.are_one(&q, &other.q)) {
                let [position, rotation] = target.missed(&self.chain, &q);
                found.push(Solution { q, residual: position.max(rotation), ..answer });
            }
        }
        Ok(found)
    }

    /// Solves with one order. Returns its steps that were not decisive.
    fn visit(
        &self,
        order: &Order,
        start: &Reduced,
        (goal, accept): (&Goal, f64),
        given: &[f64],
        found: &mut Vec<Solution>,
    ) -> u32 {
        let mut partial = PartialSolution {
            q: [Half::new(0.0); MOST_JOINTS],
            motions: [Pose::identity(); MOST_JOINTS],
            free: [false; MOST_JOINTS],
            freeing: 0,
            branch: 0,
        };
        for (&joint, &value) in self.model.given.iter().zip(given) {
            partial.q[joint] = Half::new(value);
            partial.motions[joint] = self.model.screws[joint].exp_half(partial.q[joint]);
        }
        let mut visit = Visit { order, accept, goal, found, doubtful: 0 };
        self.descend(0, start, &mut partial, &mut visit);
        visit.doubtful
    }

    /// Computes step `depth` with each of its solutions.
    fn descend(&self, depth: usize, reduced: &Reduced, partial: &mut PartialSolution, visit: &mut Visit) {
        let step = &visit.order.steps[depth];
        let joints = step.solved(reduced);
        let branches = partial.branch * visit.order.plan.steps[depth].answers;
        let freeing = partial.freeing;
        let answers = step.solve(reduced);
        if answers.is_none() {
            visit.doubtful |= 1 << depth;
        }
        let answers = answers.unwrap_or_default();
        if answers.is_empty() {
            visit.doubtful |= freeing;
        }
        for (branch, answer) in answers.into_iter().enumerate() {
            partial.branch = branches + branch;
            for (&joint, value) in joints.iter().zip(&answer) {
                (partial.q[joint], partial.free[joint]) = (Half::new(value.unwrap_or(0.0)), value.is_none());
                partial.motions[joint] = self.model.screws[joint].exp_half(partial.q[joint]);
            }
            partial.freeing = freeing | u32::from(joints.iter().any(|&joint| partial.free[joint])) << depth;
            if depth + 1 == visit.order.steps.len() {
                self.finish(partial, visit);
                continue;
            }
            let mut rest = reduced.clone();
            for &joint in &joints {
                if let Some(place) = rest.place(joint) {
                    rest.absorb(place, partial.q[joint]);
                }
            }
            self.descend(depth + 1, &rest, partial, visit);
        }
    }

    /// Refines and checks a complete solution, and stores it when it is new.
    fn finish(&self, partial: &PartialSolution, visit: &mut Visit) {
        let Model { screws, tip, given, joints, .. } = self.described.as_ref().unwrap_or(&self.model);
        let goal = visit.goal;
        let values = partial.q.map(|half| half.q);
        let mut motions = partial.motions;
        if self.described.is_some() {
            motions
                .iter_mut()
                .zip(screws)
                .zip(&partial.q)
                .for_each(|((motion, screw), q)| *motion = screw.exp_half(*q));
        }
        let residual = Residual::of(&motions[..screws.len()], goal, tip);
        let fixed = std::array::from_fn(|i| partial.free[i] || given.contains(&i));
        let (mut q, residual) = refine(screws, goal, tip, self.reach, (values, residual, &fixed), ENOUGH);
        let reaches = residual.size(self.reach) <= visit.accept;
        let free =
            partial.freeing != 0 && reaches && moves_freely(screws, &q, goal, tip, self.reach, (&partial.free, given));
        if !free {
            visit.doubtful |= partial.freeing;
        }
        if !reaches {
            return;
        }
        for (_, (q, screw)) in q.iter_mut().zip(screws).enumerate().filter(|(i, _)| !given.contains(i)) {
            if screw.axis().is_some() {
                *q = angle::wrap(*q);
            }
        }
        let same = |other: &Solution| self.chain.are_one(&q[..*joints], &other.q);
        if !visit.found.iter().any(same) {
            visit.found.push(Solution {
                q: q[..*joints].to_vec(),
                free: (0..*joints).filter(|&i| free && partial.free[i]).collect(),
                residual: residual.position.max(residual.rotation),
                branch: visit.order.first_branch + partial.branch,
                ..Solution::default()
            });
        }
    }
}

/// The ideal robot of a chain whose task has more numbers than its joints can control.
#[derive(Clone, Debug)]
struct IdealSolver {
    solver: ScrewSolver,
    /// Tolerance for targets that the ideal robot reaches: fractions of the reach, and radians.
    within: f64,
}

impl IdealSolver {
    /// The solutions of the nearest target that the ideal robot reaches.
    fn solve(&self, target: &Target, given: &[f64]) -> Result<Vec<Solution>> {
        let near = self.solver.solve_within(target, given, self.within.max(ACCEPT))?;
        let Some(best) = near.iter().min_by(|a, b| a.residual.total_cmp(&b.residual)) else { return Ok(Vec::new()) };
        let reached = Target::reached(&self.solver.chain, &best.q)?;
        let mut answers = self.solver.solve_within(&reached, given, ACCEPT)?;
        // Near a singular pose of the ideal robot, solutions separate by as much as the target differs.
        for other in near {
            let is_far = |answer: &Solution| !self.solver.chain.are_within(&answer.q, &other.q, APART);
            let held = self.solver.chain.given();
            let least = self.solver.chain.task_jacobian(&other.q, &held).singular_values().min();
            if other.free.is_empty() && least > ORDINARY && answers.iter().all(is_far) {
                answers.push(other);
            }
        }
        Ok(answers)
    }
}

/// The rotation about the axis `ray` that remains for a pose after these motions.
fn turn_about(ray: &Screw, motions: &[Pose], goal: &Goal) -> f64 {
    let (Some(axis), Goal::Pose(pose)) = (ray.axis(), goal) else { return 0.0 };
    let rotation = motions.iter().fold(UnitQuaternion::identity(), |turned, motion| turned * motion.rotation);
    let turn = rotation.inverse() * pose.rotation;
    2.0 * turn.imag().dot(&axis.direction()).atan2(turn.scalar())
}

/// Whether a task has more numbers than the joints of `chain` can control: a planar task if the chain stays in its
/// plane, an angle about an axis if the tip does not tilt.
fn is_overdetermined(chain: &Chain) -> bool {
    let is_held = chain.task().plane().is_some() || chain.task().axis().is_some();
    is_held || chain.joints().len() - chain.given().len() < chain.task().freedoms()
}

/// The error for a chain that cannot be solved: its joints, and what would be needed.
fn unsolved(chain: &Chain) -> Error {
    let geometry = Geometry::of(chain);
    let axes = |joints: &Range<usize>, how: &str| {
        let numbers: Vec<String> = joints.clone().map(|joint| (joint + 1).to_string()).collect();
        format!("axes {} {how}", numbers.join(", "))
    };
    let parallel = geometry.parallel.iter().map(|joints| axes(joints, "are parallel"));
    let meeting = geometry.meeting.iter().map(|meeting| axes(&meeting.joints, "meet"));
    let there: Vec<String> = parallel.chain(meeting).collect();
    let there =
        if there.is_empty() { "no neighbouring axes meet or are parallel".to_owned() } else { there.join(", ") };
    let text = format!(
        "`{}`: no order of the known subproblems solves its {} joints for the task `{}`: {there}; six joints need three consecutive axes that meet or are parallel, or three parallel pairs; `groebot derive` solves most other chains, also six general joints, and finds all solutions; a numeric search (`groebot ik --numeric`) may find some",
        chain.name(),
        chain.joints().len(),
        chain.task_text()
    );
    Error::new(ErrorKind::Unsupported, text)
}

impl InverseKinematics for ScrewSolver {
    fn solve(&self, target: &Target, given: &[f64], out: &mut Vec<Solution>) -> Result<()> {
        *out = self.solve_given(target, given)?;
        Ok(())
    }
}
