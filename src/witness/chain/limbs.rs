//! The check of a solver of limbs that share motors, by the witnesses of a chain: forward kinematics of every limb, the joint values
//! that made the targets, the exact number of solutions of all equations together, and the screw solver and the numeric oracle
//! limb by limb, each with the shared motors where the limbs before it have put them. Where shared joints are found from both limbs
//! at once, no limb can be solved first: these two are not asked then.

use nalgebra::DMatrix;

use super::count::Counter;
use super::model::{Configuration, Model};
use super::rational::Rationals;
use super::targets::{Target, Targets};
use super::{Check, Solver};
use crate::derive::limbs::{DerivedLimbs, LimbStage};
use crate::kinematics::{Chain, Solution};
use crate::witness::screws::Screws;
use crate::witness::{Options, Report};
use crate::{Error, ErrorKind, Result, Watch};

/// Checks the solver of `derived` at targets that are of all kinds for one limb in turn.
///
/// # Errors
/// As [`Check::run`].
pub fn check(derived: &DerivedLimbs, options: &Options, watch: &Watch) -> Result<Report> {
    let model = Limbs::new(derived);
    let leading = derived.stages.iter().map(|stage| leading(derived, stage)).collect::<Result<Vec<Chain>>>()?;
    let leading: Vec<Model<'_>> = leading.iter().map(Model::new).collect();
    let mut targets = Draws::new(&model, &leading, options.seed);
    // Two shared joints more than a limb determines make the equations of both limbs too large to be counted by.
    let counts = derived.coupled.as_ref().is_none_or(|coupled| coupled.steps.len() < 2);
    let counter = if counts { model.counter() } else { None };
    let mut rationals = counter.map(|counter| Rationals::new(counter, options.seed));
    let check = Check {
        model: &model,
        solver: &derived.program,
        bound: Some(derived.dimension()),
        screws: ByScrews::new(&model).map(|screws| Box::new(screws) as Box<dyn Solver>),
        options: Options { oracle: if derived.coupled.is_some() { 0 } else { options.oracle }, ..*options },
        watch,
    };
    let rows = check.rows(&mut |number| match &mut rationals {
        Some(rationals) => rationals.in_place_of(&model, targets.draw(number), options.exact, watch),
        None => Ok((targets.draw(number), None)),
    })?;
    let inputs = derived.program.inputs.iter().map(|input| input.name.clone());
    let joints = derived.program.joints.iter().map(|joint| joint.name.clone());
    Ok(Report { inputs: inputs.collect(), joints: joints.collect(), rows })
}

/// The limb's chain with joints given so that its task determines the others: those that limbs before it find, but where both limbs find
/// them together as few as that takes.
fn leading(derived: &DerivedLimbs, stage: &LimbStage) -> Result<Chain> {
    let chain = &stage.derived.chain;
    let mut given = chain.parts().given.clone();
    let least = chain.joints().len().saturating_sub(chain.task().freedoms());
    if derived.coupled.is_some() {
        given.truncate(least.max(derived.limbs.limbs()[stage.limb].chain.given().len()));
    }
    chain.with_task(chain.task(), chain.direction().clone(), given)
}

/// Gives the joint vectors of a limb that reach its target.
type Solve<'a, 'b> = dyn Fn(&Limb<'a>, &[f64]) -> Result<Vec<Solution>> + 'b;

/// A limb in floating point.
struct Limb<'a> {
    stage: &'a LimbStage,
    /// With all joints unknown but those that the user gives.
    whole: Model<'a>,
    /// With the joints given that limbs before it find.
    own: Model<'a>,
}

/// Limbs that share motors; the joints are those of their solver.
struct Limbs<'a> {
    derived: &'a DerivedLimbs,
    limbs: Vec<Limb<'a>>,
    unknown: Vec<usize>,
    count: usize,
}

impl<'a> Limbs<'a> {
    fn new(derived: &'a DerivedLimbs) -> Self {
        let limb = |stage: &'a LimbStage| Limb {
            stage,
            whole: Model::new(&derived.limbs.limbs()[stage.limb].chain),
            own: Model::new(&stage.derived.chain),
        };
        let limbs: Vec<Limb<'a>> = derived.stages.iter().map(limb).collect();
        let count = derived.program.joints.len();
        let is_given = |motor: &usize| limbs.iter().any(|limb| limb.is_given(*motor));
        let unknown = (0..count).filter(|motor| !is_given(motor)).collect();
        Limbs { derived, limbs, unknown, count }
    }

    /// The counter of all equations together.
    fn counter(&self) -> Option<Counter> {
        let given: Vec<usize> = (0..self.count).filter(|motor| !self.unknown.contains(motor)).collect();
        let parts: Vec<_> = self.limbs.iter().map(|limb| (limb.whole.chain, limb.stage.joints.as_slice())).collect();
        Counter::of_limbs(&parts, &given)
    }

    /// A limb that a motor moves, and its joint.
    fn joint(&self, motor: usize) -> Option<(&Limb<'a>, usize)> {
        self.limbs.iter().find_map(|limb| Some((limb, limb.joint(motor)?)))
    }

    /// All joint vectors that `solve` finds limb by limb, from a limb's target.
    fn continued(&self, target: &[f64], solve: &Solve<'a, '_>) -> Result<Vec<Solution>> {
        let start = Solution { q: vec![0.0; self.count], residual: 0.0, branch: 0, free: Vec::new(), chosen: false };
        let mut ways = vec![start];
        for limb in &self.limbs {
            let mut next = Vec::new();
            for way in &ways {
                for answer in solve(limb, &limb.stage.target(target, &way.q))? {
                    next.push(limb.put(way, &answer));
                }
            }
            ways = next;
        }
        Ok(ways)
    }
}

impl Limb<'_> {
    fn joint(&self, motor: usize) -> Option<usize> {
        self.stage.joints.iter().position(|place| *place == motor)
    }

    fn is_given(&self, motor: usize) -> bool {
        self.joint(motor).is_some_and(|joint| self.whole.given.contains(&joint))
    }

    /// `way` with the limb's joints as in `answer`.
    fn put(&self, way: &Solution, answer: &Solution) -> Solution {
        let mut way = way.clone();
        for (&place, &value) in self.stage.joints.iter().zip(&answer.q) {
            way.q[place] = value;
        }
        way.free.extend(answer.free.iter().map(|&joint| self.stage.joints[joint]));
        way.residual = way.residual.max(answer.residual);
        way
    }
}

impl Configuration for Limbs<'_> {
    fn count(&self) -> usize {
        self.count
    }

    fn unknown(&self) -> &[usize] {
        &self.unknown
    }

    fn turns(&self, joint: usize) -> bool {
        self.joint(joint).is_some_and(|(limb, joint)| limb.whole.turns(joint))
    }

    fn length(&self) -> f64 {
        self.limbs.iter().map(|limb| limb.whole.length).fold(0.0, f64::max)
    }

    fn target(&self, q: &[f64]) -> Vec<f64> {
        let mut target = vec![0.0; self.derived.program.inputs.len()];
        for limb in &self.limbs {
            limb.stage.write(&limb.own.target(&limb.stage.own(q)), &mut target);
        }
        self.derived.write_given(q, &mut target);
        target
    }

    fn misses(&self, target: &[f64], q: &[f64]) -> Vec<f64> {
        let misses = |limb: &Limb<'_>| limb.whole.misses(&limb.stage.target(target, q), &limb.stage.own(q));
        self.limbs.iter().flat_map(misses).collect()
    }

    fn residual(&self, target: &[f64], q: &[f64]) -> f64 {
        let residual = |limb: &Limb<'_>| limb.own.residual(&limb.stage.target(target, q), &limb.stage.own(q));
        self.limbs.iter().map(residual).fold(0.0, f64::max)
    }

    fn jacobian(&self, q: &[f64]) -> DMatrix<f64> {
        let blocks: Vec<DMatrix<f64>> = self.limbs.iter().map(|limb| limb.whole.jacobian(&limb.stage.own(q))).collect();
        let mut whole = DMatrix::zeros(blocks.iter().map(DMatrix::nrows).sum(), self.unknown.len());
        let mut first = 0;
        for (limb, block) in self.limbs.iter().zip(&blocks) {
            for (column, &joint) in limb.whole.unknown.iter().enumerate() {
                let motor = self.unknown.iter().position(|motor| *motor == limb.stage.joints[joint]);
                for (place, row) in motor.into_iter().flat_map(|motor| (0..block.nrows()).map(move |row| (motor, row)))
                {
                    whole[(first + row, place)] = block[(row, column)];
                }
            }
            first += block.nrows();
        }
        whole
    }

    fn search(&self, target: &[f64], seeds: usize) -> Result<Vec<Vec<f64>>> {
        let solve = |limb: &Limb<'_>, target: &[f64]| {
            let found = limb.own.search(target, seeds)?;
            let answer = |q| Solution { q, residual: 0.0, branch: 0, free: Vec::new(), chosen: false };
            Ok(found.into_iter().map(answer).collect())
        };
        Ok(self.continued(target, &solve)?.into_iter().map(|answer| answer.q).collect())
    }

    fn completed(&self, _: &[f64], answer: Solution) -> Solution {
        answer
    }
}

/// The screw solvers of limbs, one after the other.
struct ByScrews<'a> {
    limbs: &'a Limbs<'a>,
    /// One for each limb.
    screws: Vec<Screws>,
}

impl<'a> ByScrews<'a> {
    /// `None` when screw theory does not solve each limb, one after the other.
    fn new(limbs: &'a Limbs<'a>) -> Option<Self> {
        if limbs.derived.coupled.is_some() {
            return None;
        }
        let screws: Option<Vec<Screws>> = limbs.limbs.iter().map(|limb| Screws::new(limb.own.chain)).collect();
        screws.map(|screws| ByScrews { limbs, screws })
    }

    fn of(&self, limb: &Limb<'_>, target: &[f64]) -> Result<Vec<Solution>> {
        let index = self.limbs.limbs.iter().position(|other| other.stage.limb == limb.stage.limb);
        index.map_or_else(|| Ok(Vec::new()), |index| self.screws[index].solve(target))
    }
}

impl Solver for ByScrews<'_> {
    /// A limb's free joint stands at one value, with which the limbs behind it cannot be said to go on: no answer then.
    fn solve(&self, inputs: &[f64]) -> Result<Vec<Solution>> {
        let found = self.limbs.continued(inputs, &|limb, target| self.of(limb, target))?;
        let shared = |motor: &usize| self.limbs.limbs.iter().filter(|limb| limb.joint(*motor).is_some()).count() > 1;
        if found.iter().any(|answer| answer.free.iter().any(shared)) {
            return Err(Error::new(ErrorKind::Unsupported, "a shared motor is free"));
        }
        Ok(found)
    }
}

/// The source of targets: those of one limb in turn, with random joints of the others.
struct Draws<'a> {
    limbs: &'a Limbs<'a>,
    leading: &'a [Model<'a>],
    /// One for each limb.
    sources: Vec<Targets<'a>>,
}

impl<'a> Draws<'a> {
    fn new(limbs: &'a Limbs<'a>, leading: &'a [Model<'a>], seed: u64) -> Self {
        let source = |(index, model): (usize, &'a Model<'a>)| Targets::new(model, seed + index as u64);
        Draws { limbs, leading, sources: leading.iter().enumerate().map(source).collect() }
    }

    fn draw(&mut self, number: usize) -> Target {
        let count = self.sources.len();
        let turn = number % count;
        let Target { kind, inputs, joints } = self.sources[turn].draw(number / count);
        let mut motors: Vec<Option<f64>> = vec![None; self.limbs.count];
        let (leading, given) = (&self.limbs.limbs[turn], &self.leading[turn].given);
        match &joints {
            Some(values) => leading.stage.joints.iter().zip(values).for_each(|(&motor, &q)| motors[motor] = Some(q)),
            None => {
                let values = &inputs[inputs.len() - given.len()..];
                let given = given.iter().map(|&joint| leading.stage.joints[joint]);
                given.zip(values).for_each(|(motor, &q)| motors[motor] = Some(q));
            }
        }
        for (limb, source) in self.limbs.limbs.iter().zip(&mut self.sources) {
            for (&motor, q) in limb.stage.joints.iter().zip(source.joints()) {
                motors[motor].get_or_insert(q);
            }
        }
        let q: Vec<f64> = motors.into_iter().flatten().collect();
        let mut target = self.limbs.target(&q);
        leading.stage.write(&inputs, &mut target);
        Target { kind, inputs: target, joints: joints.map(|_| q) }
    }
}
