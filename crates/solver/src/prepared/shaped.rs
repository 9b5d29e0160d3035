//! A prepared program with its numbers in rows of one kind. Main type: [`Shaped`].

use std::marker::PhantomData;

use groebot_runtime as runtime;
use groebot_runtime::derivatives::of_affine;
use groebot_runtime::mechanism::{Inputs, Places};
use groebot_runtime::storage::{Array, Storage};
use groebot_runtime::trigonometry::{cosine, sine};
use groebot_runtime::{Mechanism, Solve};

use super::Nearest;
use super::blocks::Blocks;
use super::equations::Equations;
use super::ordinary::Ordinary;
use super::parameters::Parameters;
use super::spare::with_spare;
use super::storage::SixJoints;
use crate::condition::conform;
use crate::program::{Case, Condition, Input};
use crate::target::TargetInputs;
use crate::{Error, ErrorKind, Result};
use crate::{Facts, Layout, Operand, Pairs};
use groebot_robot::kinematics::Solution;

/// A prepared program.
#[derive(Clone, Debug)]
pub(super) struct Shaped<S> {
    pub inputs: Vec<Input>,
    /// The inputs by their meaning.
    pub target: TargetInputs,
    conditions: Vec<Condition>,
    /// The labels of the strata that could not be derived.
    open: Vec<String>,
    pub facts: Facts,
    pub(super) kinds: Kinds,
    pub(super) parameters: Parameters,
    pub(super) blocks: Blocks,
    /// Separate code for ordinary targets.
    pub(super) ordinary: Option<Ordinary>,
    pub(super) tip: Equations,
    pub(super) values: Equations,
    /// The values as described, if the equations are those of the ideal mechanism.
    pub(super) described: Equations,
    pub(super) sizes: Equations,
    /// The derivatives, unless the run time computes them from the values.
    pub(super) jacobian: Option<Equations>,
    /// The values of the equations for fast polishing, then their sizes, then their derivatives, joint by joint.
    pub(super) short: Equations,
    /// The values alone.
    pub(super) short_value: Equations,
    storage: PhantomData<fn() -> S>,
}

/// Lists of facts in the run time's types.
#[derive(Clone, Debug)]
pub(super) struct Kinds {
    pub joints: Vec<runtime::Joint>,
    pub conditions: Vec<runtime::Condition>,
    pub reached: Vec<runtime::Reached>,
}

impl Kinds {
    fn new(facts: &Facts) -> Self {
        let joint = |places: &Vec<usize>| match places[..] {
            [cosine, sine] => runtime::Joint::Angle([cosine, sine]),
            _ => runtime::Joint::Length(places[0]),
        };
        let condition = |&(kind, first): &(&str, usize)| match kind {
            "Rotation" => runtime::Condition::Rotation(first),
            _ => runtime::Condition::Unit(first),
        };
        let reached = |(kind, numbers): &(&str, Vec<usize>)| match *kind {
            "Value" => runtime::Reached::Value(numbers[0]),
            "Angle" => runtime::Reached::Angle([numbers[0], numbers[1]]),
            _ => runtime::Reached::Joint(numbers[0]),
        };
        Kinds {
            joints: facts.joints.iter().map(joint).collect(),
            conditions: facts.conditions.iter().map(condition).collect(),
            reached: facts.reached.iter().map(reached).collect(),
        }
    }
}

impl Shaped<SixJoints> {
    /// Whether a program's numbers have this storage.
    pub fn are_of_six_joints(layout: &Layout<'_>, facts: &Facts) -> bool {
        let lengths = [facts.inputs, layout.program.parameters.len(), facts.places, facts.equations];
        let rows = [facts.joints.len(), facts.sizes.len(), facts.candidates];
        // Only programs of a nearby mechanism have short equations.
        let are_short = !facts.nearby || facts.shorts == 6;
        rows == [6, 2, 8] && lengths == [12; 4] && tip(layout).len() == 12 && are_short
    }
}

/// The operands of forward kinematics of the tip.
fn tip(layout: &Layout<'_>) -> Vec<Operand> {
    let forward = layout.program.forward().filter(|forward| !forward.inputs.is_empty());
    let equations = forward.iter().flat_map(|forward| &forward.equations);
    equations.map(|equation| equation.map_or(Operand::Constant(0.0), |(value, _)| value)).collect()
}

impl<S: Storage + 'static> Shaped<S> {
    /// Prepares a valid program with these facts.
    pub fn new(layout: &Layout<'_>, facts: Facts) -> Self {
        let (program, checks) = (layout.program, &layout.program.checks);
        let mut short: Vec<_> = checks.short.iter().map(|short| short.residual).collect();
        let short_value = Equations::new(layout, &short);
        short.extend(checks.short.iter().map(|short| short.scale));
        let joints = 0..program.joints.len();
        short.extend(joints.flat_map(|joint| checks.short.iter().map(move |short| short.derivatives[joint])));
        Shaped {
            inputs: program.inputs.clone(),
            target: TargetInputs::of(program),
            conditions: program.conditions.clone(),
            open: program.cases().filter(|case| case.open).map(|case: &Case| case.label.clone()).collect(),
            kinds: Kinds::new(&facts),
            parameters: Parameters::new(program),
            blocks: Blocks::new(layout),
            ordinary: Ordinary::new(layout, &facts),
            tip: Equations::new(layout, &tip(layout)),
            values: Equations::new(layout, &checks.residuals),
            described: program.described.as_ref().map_or_else(Equations::default, |described| {
                Equations::of_code(layout, &described.code, &described.residuals)
            }),
            sizes: Equations::new(layout, &facts.sizes),
            jacobian: (!facts.are_affine).then(|| Equations::new(layout, checks.jacobian.iter().flatten())),
            short: Equations::new(layout, &short),
            short_value,
            facts,
            storage: PhantomData,
        }
    }

    /// Same as [`super::Solver::solve_numbers`].
    pub fn solve(&self, target: &[f64]) -> Result<Vec<Solution>> {
        let row = self.row(target)?;
        self.with_room(self.facts.capacity, |out| {
            let count = Solve::solve(self, &row, out).map_err(|error| self.refused(target, error))?;
            Ok(out[..count].iter().map(solution).collect())
        })
    }

    /// Same as [`super::Solver::solve_within`].
    pub fn solve_within(&self, target: &[f64], limits: &[[f64; 2]]) -> Result<Vec<Solution>> {
        let (row, joints) = (self.row(target)?, self.facts.joints.len());
        if limits.len() != joints {
            let text = format!("{} pairs of limits given; give one for each of {joints} joints", limits.len());
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let limits = Array::by(joints, |i| limits[i]);
        self.with_room(self.facts.capacity, |out| {
            let count = Solve::solve_within(self, &row, &limits, out).map_err(|error| self.refused(target, error))?;
            Ok(out[..count].iter().map(solution).collect())
        })
    }

    /// Same as [`super::Solver::nearest_to`].
    pub fn nearest_to(
        &self,
        target: &[f64],
        q0: &[f64],
        weights: Option<&[f64]>,
        limits: Option<&[[f64; 2]]>,
    ) -> Result<Option<Solution>> {
        let (row, joints) = (self.row(target)?, self.facts.joints.len());
        check_reference(joints, q0, weights, limits)?;
        let reference = Array::by(joints, |i| q0[i]);
        let weights = Array::by(joints, |i| weights.map_or(1.0, |weights| weights[i]));
        let limits = Array::by(joints, |i| limits.map_or([f64::NEG_INFINITY, f64::INFINITY], |limits| limits[i]));
        self.with_room(self.facts.capacity, |out| {
            let found = Solve::nearest_to(self, &row, &reference, &weights, &limits, out);
            Ok(found.map_err(|error| self.refused(target, error))?.map(|(nearest, _)| solution(&nearest)))
        })
    }

    /// Same as [`super::Solver::solve_pairs`].
    pub fn solve_pairs(&self, target: &[f64]) -> Result<Vec<Pairs>> {
        let mut out = vec![runtime::Pairs::empty(self); self.facts.capacity];
        let found = Solve::solve_pairs(self, &self.row(target)?, &mut out);
        let count = found.map_err(|error| self.refused(target, error))?;
        let pairs = |pairs: &runtime::Pairs<Self>| Pairs {
            joints: pairs.joints.as_ref().to_vec(),
            residual: pairs.residual,
            branch: pairs.branch,
            free: joints_of(pairs.free),
        };
        Ok(out[..count].iter().map(pairs).collect())
    }

    /// Same as [`super::Solver::nearest`].
    pub fn nearest(&self, target: &[f64]) -> Result<Option<Nearest>> {
        let row = self.row(target)?;
        let found = self.with_room(self.facts.capacity, |out| Solve::solve_or_nearest(self, &row, out));
        let (_, nearest) = found.map_err(|error| self.refused(target, error))?;
        Ok(nearest.map(|nearest| Nearest {
            q: nearest.q.as_ref().to_vec(),
            residual: nearest.residual,
            relative: nearest.relative,
        }))
    }

    /// Same as [`super::Solver::reached`].
    pub fn reached(&self, q: &[f64]) -> Option<Vec<f64>> {
        let q = (q.len() == self.facts.joints.len()).then(|| Array::by(q.len(), |i| q[i]))?;
        self.forward(&q).map(|target| target.as_ref().to_vec())
    }

    /// Same as [`super::Solver::residual`].
    pub fn residual_at(&self, target: &[f64], q: &[f64]) -> f64 {
        match self.row(target) {
            Ok(row) if q.len() == self.facts.joints.len() => Solve::residual(self, &row, &Array::by(q.len(), |i| q[i])),
            _ => f64::NAN,
        }
    }

    /// Same as [`super::Solver::parameters`].
    pub fn parameters_of(&self, target: &[f64]) -> Result<Vec<f64>> {
        Ok(Mechanism::parameters(self, &self.row(target)?).as_ref().to_vec())
    }

    /// Same as [`super::Solver::derivatives`].
    pub fn derivatives(&self, target: &[f64], q: &[f64]) -> Result<Option<Vec<Vec<f64>>>> {
        let p = Mechanism::parameters(self, &self.row(target)?);
        if q.len() != self.kinds.joints.len() || self.facts.has_extras {
            return Ok(None);
        }
        let mut at: Places<Self> = Array::by(self.facts.places, |_| 0.0);
        for (joint, &value) in self.kinds.joints.iter().zip(q) {
            match *joint {
                runtime::Joint::Angle([c, s]) => (at.as_mut()[c], at.as_mut()[s]) = (cosine(value), sine(value)),
                runtime::Joint::Length(place) => at.as_mut()[place] = value,
            }
        }
        let rows = self.jacobian(&p, &at).unwrap_or_else(|| of_affine(self, &p, &at));
        Ok(Some(rows.as_ref().iter().map(|row| row.as_ref().to_vec()).collect()))
    }

    /// Lends memory for this number of solutions.
    pub fn with_room<R>(&self, solutions: usize, solve: impl FnOnce(&mut [runtime::Solution<Self>]) -> R) -> R {
        with_spare(|room: &mut Vec<runtime::Solution<Self>>| {
            if room.len() < solutions {
                room.resize(solutions, runtime::Solution::empty(self));
            }
            solve(&mut room[..solutions])
        })
    }

    /// A target of the right length.
    fn row(&self, target: &[f64]) -> Result<Inputs<Self>> {
        if target.len() != self.inputs.len() {
            let names: Vec<&str> = self.inputs.iter().map(|input| input.name.as_str()).collect();
            let text = format!("{} numbers given, {} expected: {}", target.len(), self.inputs.len(), names.join(", "));
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        Ok(Array::by(target.len(), |i| target[i]))
    }

    /// The reason why a target of the right length is refused.
    pub fn refused(&self, target: &[f64], error: runtime::Error) -> Error {
        if let runtime::Error::OpenStratum(number) = error {
            let label = self.open.get(number.wrapping_sub(1)).map_or("", String::as_str);
            let text = format!("the target is on `{label}`, a stratum that could not be derived");
            return Error::new(ErrorKind::Unsupported, text);
        }
        if error == runtime::Error::Unsettled {
            return Error::new(ErrorKind::Budget, error.to_string());
        }
        let not_finite = self.inputs.iter().zip(target).find(|(_, value)| !value.is_finite());
        let text = match not_finite {
            Some((input, value)) => format!("`{}` is {value}; give a finite number", input.name),
            None => conform(&self.conditions, &self.inputs, target).unwrap_or_else(|| error.to_string()),
        };
        Error::new(ErrorKind::BadValue, text)
    }
}

/// Checks reference joint values, their weights and limits.
fn check_reference(joints: usize, q0: &[f64], weights: Option<&[f64]>, limits: Option<&[[f64; 2]]>) -> Result<()> {
    let bad = |text: String| Err(Error::new(ErrorKind::BadValue, text));
    let lengths = [
        (q0.len(), "reference values"),
        (weights.map_or(joints, <[f64]>::len), "weights"),
        (limits.map_or(joints, <[_]>::len), "pairs of limits"),
    ];
    if let Some((length, what)) = lengths.into_iter().find(|(length, _)| *length != joints) {
        return bad(format!("{length} {what} given; give one for each of {joints} joints"));
    }
    if let Some(value) = q0.iter().find(|value| !value.is_finite()) {
        return bad(format!("a reference value is {value}; give finite numbers"));
    }
    if let Some(weight) = weights.unwrap_or(&[]).iter().find(|weight| !(weight.is_finite() && **weight >= 0.0)) {
        return bad(format!("a weight is {weight}; give finite numbers that are not negative"));
    }
    match limits.unwrap_or(&[]).iter().find(|[low, high]| low > high || low.is_nan() || high.is_nan()) {
        Some([low, high]) => bad(format!("limits are {low} and {high}; give the least value first")),
        None => Ok(()),
    }
}

/// A solution in the common type of all solvers.
fn solution<S: Storage + 'static>(found: &runtime::Solution<Shaped<S>>) -> Solution {
    Solution {
        q: found.q.as_ref().to_vec(),
        residual: found.residual,
        branch: found.branch,
        free: joints_of(found.free),
        chosen: found.chosen,
        settled: found.settled,
    }
}

/// The joints whose bits are set.
#[inline]
fn joints_of(bits: u32) -> Vec<usize> {
    if bits == 0 {
        return Vec::new();
    }
    (0..u32::BITS as usize).filter(|joint| bits >> joint & 1 == 1).collect()
}
