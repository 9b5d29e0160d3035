//! The joint values whose target has the least error. Main types: [`Closest`], [`ClosestOptions`].
//!
//! The error is `distance^2 + (2 length sin(angle / 2))^2`. It is smooth, and about `distance^2 + (length angle)^2` for small angles. Newton's method
//! minimises it from many starting points: a fixed quasirandom sequence, and the derived solutions of reachable targets near the best one found.

mod descent;
mod measure;
mod starts;

use groebot_robot::kinematics::{Target, Task};
use groebot_robot::spatial::angle;
use groebot_runtime::tolerances::ACCEPTANCE;

use self::descent::{Descent, End};
use self::measure::Measure;
use super::{PlacedSolver, Solver};
use crate::tolerances::CLOSEST;
use crate::{Error, ErrorKind, Result};

/// The joint values whose target has the least error.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Closest {
    /// The joint values in the program's joint order. Angles are in (-pi, pi] unless limits were given.
    pub q: Vec<f64>,
    /// The target that they reach.
    pub reached: Target,
    /// The distance of `reached` from the target, in the unit of the inputs; zero for a task without a position.
    pub distance: f64,
    /// The angle between `reached` and the target \[rad\]: of the rotation, of the direction, or about the axis; zero for a task without an orientation.
    pub angle: f64,
    /// Whether the target is reachable, within the limits if these were given. `q` is then one of its solutions. Of a redundant arm, false does not prove that
    /// the target is out of reach.
    pub reachable: bool,
    /// Whether `q` is a local minimum of the error: the gradient is zero and the Hessian has no negative eigenvalue, within rounding, in all directions that
    /// the limits permit.
    pub is_minimum: bool,
    /// The number of starting points of the search; zero for a reachable target.
    pub starts: usize,
    /// The number of starting points from which the search ended at this error. A small share means that another minimum may have been missed.
    pub agreeing: usize,
}

/// Options of [`Solver::closest_by`].
#[derive(Clone, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct ClosestOptions {
    /// The length that weighs rotation against translation, in the unit of the inputs: an angle of 1 rad counts as this distance. The default is
    /// [`super::Program::scale`], for a chain its reach.
    pub length: Option<f64>,
    /// By joint, the least and the greatest value. Without them joint limits are not respected.
    pub limits: Option<Vec<[f64; 2]>>,
    /// The values of given joints.
    pub given: Vec<f64>,
}

impl ClosestOptions {
    /// Sets the length that weighs rotation against translation.
    #[must_use]
    pub fn length(mut self, length: f64) -> Self {
        self.length = Some(length);
        self
    }

    /// Sets the limits of the joints: the least and the greatest value of each, infinite for none.
    #[must_use]
    pub fn limits(mut self, limits: &[[f64; 2]]) -> Self {
        self.limits = Some(limits.to_vec());
        self
    }

    /// Sets the values of given joints.
    #[must_use]
    pub fn given(mut self, values: &[f64]) -> Self {
        self.given = values.to_vec();
        self
    }

    fn check(&self, joints: usize) -> Result<()> {
        let bad = |text: String| Err(Error::new(ErrorKind::BadValue, text));
        check_length(self.length)?;
        let Some(limits) = &self.limits else { return Ok(()) };
        if limits.len() != joints {
            return bad(format!("{} pairs of limits given; give one for each of {joints} joints", limits.len()));
        }
        match limits.iter().find(|[low, high]| low.is_nan() || high.is_nan() || low > high) {
            Some(pair) => bad(format!("the limits of a joint are {pair:?}; give the least value, then the greatest")),
            None => Ok(()),
        }
    }
}

fn check_length(length: Option<f64>) -> Result<()> {
    match length.filter(|length| !(length.is_finite() && *length > 0.0)) {
        Some(length) => Err(Error::new(ErrorKind::BadValue, format!("the length is {length}; give a positive number"))),
        None => Ok(()),
    }
}

/// The weight of rotation in the error of a target, and the point whose distance counts.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
#[non_exhaustive]
pub struct ErrorWeights {
    /// The length that weighs rotation against translation, as [`ClosestOptions::length`].
    pub length: Option<f64>,
    /// The translation of a tool in the tip frame, in the unit of the inputs: for a pose, the distance is that of the tool.
    pub tool: [f64; 3],
}

impl ErrorWeights {
    /// Sets the length that weighs rotation against translation.
    #[must_use]
    pub fn length(mut self, length: f64) -> Self {
        self.length = Some(length);
        self
    }

    /// Sets the translation of a tool in the tip frame.
    #[must_use]
    pub fn tool(mut self, translation: [f64; 3]) -> Self {
        self.tool = translation;
        self
    }
}

/// Joints that a search moves.
pub(super) struct LimitedJoints<'a> {
    /// Their indices.
    pub unknown: &'a [usize],
    /// By joint of the program, its least and greatest value.
    pub limits: &'a [[f64; 2]],
}

impl Solver {
    /// The joint values whose target has the least error: a solution if the target is reachable, else a local minimum, the best that the search finds. The
    /// result is the same every time. Joint limits are not respected: see [`Solver::closest_by`].
    ///
    /// # Errors
    /// As [`Solver::closest_by`].
    pub fn closest(&self, target: impl Into<Target>) -> Result<Closest> {
        self.closest_by(target, &ClosestOptions::default())
    }

    /// Same as [`Solver::closest`], but with options.
    ///
    /// # Errors
    /// As [`Solver::solve_given`]; [`ErrorKind::BadValue`] for a length that is not positive or limits that are not pairs of the joints;
    /// [`ErrorKind::Unsupported`] for a program that is not of one tip, or whose equations do not compare each number of the target with the joints,
    /// as those of a position with pitch and roll.
    pub fn closest_by(&self, target: impl Into<Target>, options: &ClosestOptions) -> Result<Closest> {
        self.closest_numbers(&self.numbers_of(&target.into(), &options.given)?, options)
    }

    /// Same as [`Solver::closest_by`], but for a target as numbers, one per input, which include the values of given joints.
    ///
    /// # Errors
    /// As [`Solver::closest_by`] and [`Solver::solve_numbers`].
    pub fn closest_numbers(&self, target: &[f64], options: &ClosestOptions) -> Result<Closest> {
        self.closest_to(target, [0.0; 3], options)
    }

    /// The closest joint values with a tool that is translated by `lever` in the tip frame; `target` is base_from_tip.
    pub(super) fn closest_to(&self, target: &[f64], lever: [f64; 3], options: &ClosestOptions) -> Result<Closest> {
        options.check(self.outline.joints.len())?;
        let solutions = match &options.limits {
            None => self.solve_numbers(target)?,
            Some(limits) => self.solve_within(target, limits)?,
        };
        let weights = ErrorWeights { length: options.length, tool: lever };
        let measure = Measure::new(self, target, &weights, self.outline.independent())?;
        let errors = solutions.iter().filter_map(|solution| Some((measure.error(&solution.q)?, &solution.q)));
        if let Some((_, q)) = errors.min_by(|(a, _), (b, _)| a.total_cmp(b)) {
            return closest(&measure, q.clone(), true);
        }
        self.searched(target, measure, options.limits.as_deref())
    }

    /// The closest joint values within limits of some joints, which may be given ones. The others have the values in the target. A `solution` is the result.
    ///
    /// # Errors
    /// As [`Solver::closest_numbers`].
    pub(super) fn closest_over(
        &self,
        target: &[f64],
        joints: &LimitedJoints<'_>,
        weights: &ErrorWeights,
        solution: Option<Vec<f64>>,
    ) -> Result<Closest> {
        check_length(weights.length)?;
        let measure = Measure::new(self, target, weights, joints.unknown.to_vec())?;
        if let Some(q) = solution {
            return closest(&measure, q, true);
        }
        let found = self.searched(target, measure, Some(joints.limits))?;
        let most = [self.outline.scale, 1.0].map(|unit| ACCEPTANCE.residual * unit);
        Ok(Closest { reachable: found.distance <= most[0] && found.angle <= most[1], ..found })
    }

    /// The least local minimum of the error that is found from the starting points.
    fn searched(&self, target: &[f64], measure: Measure<'_>, limits: Option<&[[f64; 2]]>) -> Result<Closest> {
        let measures = measure.by_weight();
        let descent = Descent::new(&measures, limits).ok_or_else(measure::unsupported)?;
        let ends: Vec<End> = starts::search(self, target, &descent)?;
        let Some(best) = ends.iter().min_by(|a, b| a.error.total_cmp(&b.error)) else {
            return Err(Error::new(ErrorKind::BadValue, "no starting point has a finite error; give a smaller target"));
        };
        let is_same = |end: &&End| end.error - best.error <= CLOSEST.same * best.error;
        let q = if limits.is_none() { self.wrapped(&best.q) } else { best.q.clone() };
        let found = closest(descent.measure, q, false)?;
        Ok(Closest {
            is_minimum: best.is_minimum,
            starts: ends.len(),
            agreeing: ends.iter().filter(is_same).count(),
            ..found
        })
    }

    /// Angles in (-pi, pi]; given joints and those that follow others are unchanged.
    fn wrapped(&self, q: &[f64]) -> Vec<f64> {
        let moves = |joint: usize| {
            let own = &self.outline.joints[joint];
            own.is_angle && own.given.is_none() && own.follows.is_none() && !self.outline.leads(joint)
        };
        (0..q.len()).map(|joint| if moves(joint) { angle::wrap(q[joint]) } else { q[joint] }).collect()
    }
}

fn closest(measure: &Measure<'_>, q: Vec<f64>, reachable: bool) -> Result<Closest> {
    let [distance, angle] = measure.missed(&q).ok_or_else(measure::unsupported)?;
    let reached = measure.reached(&q).ok_or_else(measure::unsupported)?;
    Ok(Closest { q, reached, distance, angle, reachable, is_minimum: true, starts: 0, agreeing: 0 })
}

impl PlacedSolver<'_> {
    /// Same as [`Solver::closest`], but for a target of the tool in the world frame. The error is that of the tool.
    ///
    /// # Errors
    /// As [`Solver::closest`].
    pub fn closest(&self, target: impl Into<Target>) -> Result<Closest> {
        self.closest_by(target, &ClosestOptions::default())
    }

    /// Same as [`Solver::closest_by`], but for a target of the tool in the world frame. The error is that of the tool.
    ///
    /// # Errors
    /// As [`Solver::closest_by`].
    pub fn closest_by(&self, target: impl Into<Target>, options: &ClosestOptions) -> Result<Closest> {
        self.closest_numbers(&self.solver().numbers_of(&target.into(), &options.given)?, options)
    }

    /// Same as [`Solver::closest_numbers`], but for a target of the tool in the world frame. The error is that of the tool.
    ///
    /// # Errors
    /// As [`Solver::closest_numbers`].
    pub fn closest_numbers(&self, target: &[f64], options: &ClosestOptions) -> Result<Closest> {
        let solver = self.solver();
        let at = self.placement().tip_from_tool.translation.vector;
        let lever = if solver.outline.task == Some(Task::Pose) { [at.x, at.y, at.z] } else { [0.0; 3] };
        let mut found = solver.closest_to(&self.base_from_tip(target), lever, options)?;
        if let Some(task) = solver.outline.task {
            let mut numbers = solver.reached(&found.q).ok_or_else(measure::unsupported)?;
            self.task_placement().to_world(&mut numbers);
            found.reached = task.layout().target(&numbers[..solver.outline.own])?;
        }
        Ok(found)
    }
}
