//! The check of a solver of coupled chains, by the witnesses of a chain: forward kinematics of every chain, the joint values that made the targets, the exact
//! number of solutions of all equations together, the screw solver and the numeric oracle.
//!
//! The screw solver and the oracle solve chain by chain, each with the shared actuators at the values from earlier chains. If shared joints are found from both
//! chains together, no chain can be solved first, and these two witnesses are not used.

use crate::tolerances::WITNESS;
use nalgebra::DMatrix;

use super::Moving;
use super::count::Counter;
use super::model::{Configuration, Joints, Model};
use super::rational::Rationals;
use super::targets::Targets;
use crate::derive::coupled::{ChainStage, CoupledView};
use crate::witness::check::{Check, Solver, Target};
use crate::witness::screws::Screws;
use crate::witness::{Options, Report};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_robot::kinematics::{Chain, Solution};

/// Checks the solver of `derived`. One chain at a time gets targets of all kinds.
///
/// # Errors
/// As [`super::check_chain`].
pub(crate) fn check<'w>(
    derived: CoupledView<'_>,
    options: &Options,
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Report> {
    let watch = Watch::or_none(watch);
    let model = CoupledModel::new(derived);
    let leading = derived.method.stages.iter().map(|stage| leading(derived, stage)).collect::<Result<Vec<Chain>>>()?;
    let leading: Vec<Model<'_>> = leading.iter().map(Model::new).collect();
    let mut targets = Sources::new(&model, &leading, options);
    // With two shared joints more than a chain determines, the equations of both chains are too large for the exact count.
    let counts = derived.method.simultaneous.as_ref().is_none_or(|simultaneous| simultaneous.steps.len() < 2);
    let counter = if counts { model.counter() } else { None };
    let mut rationals = counter.map(|counter| Rationals::new(counter, options.seed));
    let subject = Moving { model: &model, bound: Some(derived.method.dimension()), tolerance: WITNESS.residual };
    let check = Check {
        subject: &subject,
        solver: derived.program,
        screws: ByScrews::new(&model).map(|screws| Box::new(screws) as Box<dyn Solver>),
        options: Options { oracle: if derived.method.simultaneous.is_some() { 0 } else { options.oracle }, ..*options },
        watch,
    };
    let inputs = derived.program.inputs.iter().map(|input| input.name.clone()).collect();
    let joints = derived.program.joints.iter().map(|joint| joint.name.clone()).collect();
    check.report(inputs, joints, &mut |number| match &mut rationals {
        Some(rationals) => rationals.in_place_of(&model, targets.draw(number), options.exact, watch),
        None => Ok((targets.draw(number), None)),
    })
}

/// The chain of a stage with joints given such that its task determines the others. These are the joints that earlier chains find. If both chains find them
/// together, as few as necessary.
fn leading(derived: CoupledView<'_>, stage: &ChainStage) -> Result<Chain> {
    let chain = &stage.problem.chain;
    let mut given = chain.parts().given.clone();
    let least = chain.joints().len().saturating_sub(chain.task().freedoms());
    if derived.method.simultaneous.is_some() {
        given.truncate(least.max(derived.problem.chains()[stage.member].chain.given().len()));
    }
    chain.with_task(chain.task(), chain.direction().clone(), given)
}

/// A function that returns the joint vectors of a chain that reach its target.
type Solve<'a, 'b> = dyn Fn(&Member<'a>, &[f64]) -> Result<Vec<Solution>> + 'b;

/// A chain in floating point.
struct Member<'a> {
    stage: &'a ChainStage,
    /// The chain with all joints unknown except those that the user gives.
    whole: Model<'a>,
    /// The chain with the joints given that earlier chains find.
    own: Model<'a>,
}

/// Coupled chains in floating point. The joints are those of their solver.
struct CoupledModel<'a> {
    derived: CoupledView<'a>,
    members: Vec<Member<'a>>,
    unknown: Vec<usize>,
    count: usize,
}

impl<'a> CoupledModel<'a> {
    fn new(derived: CoupledView<'a>) -> Self {
        let member = |stage: &'a ChainStage| Member {
            stage,
            whole: Model::new(&derived.problem.chains()[stage.member].chain),
            own: Model::new(&stage.problem.chain),
        };
        let members: Vec<Member<'a>> = derived.method.stages.iter().map(member).collect();
        let count = derived.program.joints.len();
        let is_given = |actuator: &usize| members.iter().any(|member| member.is_given(*actuator));
        let unknown = (0..count).filter(|actuator| !is_given(actuator)).collect();
        CoupledModel { derived, members, unknown, count }
    }

    /// The counter of all equations together.
    fn counter(&self) -> Option<Counter> {
        let given: Vec<usize> = (0..self.count).filter(|actuator| !self.unknown.contains(actuator)).collect();
        let parts: Vec<_> =
            self.members.iter().map(|member| (member.whole.chain, member.stage.joints.as_slice())).collect();
        Counter::of_coupled(&parts, &given)
    }

    /// One of the chains that an actuator moves, and its joint.
    fn joint(&self, actuator: usize) -> Option<(&Member<'a>, usize)> {
        self.members.iter().find_map(|member| Some((member, member.joint(actuator)?)))
    }

    /// All joint vectors that `solve` finds chain by chain. It takes the target of a chain.
    fn continued(&self, target: &[f64], solve: &Solve<'a, '_>) -> Result<Vec<Solution>> {
        let start = Solution { q: vec![0.0; self.count], ..Solution::default() };
        let mut solutions = vec![start];
        for member in &self.members {
            let mut next = Vec::new();
            for solution in &solutions {
                for answer in solve(member, &member.stage.target(target, &solution.q))? {
                    next.push(member.put(solution, &answer));
                }
            }
            solutions = next;
        }
        Ok(solutions)
    }
}

impl Member<'_> {
    fn joint(&self, actuator: usize) -> Option<usize> {
        self.stage.joints.iter().position(|place| *place == actuator)
    }

    fn is_given(&self, actuator: usize) -> bool {
        self.joint(actuator).is_some_and(|joint| self.whole.given.contains(&joint))
    }

    /// `solution` with the chain's joints as in `answer`.
    fn put(&self, solution: &Solution, answer: &Solution) -> Solution {
        let mut solution = solution.clone();
        for (&place, &value) in self.stage.joints.iter().zip(&answer.q) {
            solution.q[place] = value;
        }
        solution.free.extend(answer.free.iter().map(|&joint| self.stage.joints[joint]));
        solution.residual = solution.residual.max(answer.residual);
        solution
    }
}

impl Joints for CoupledModel<'_> {
    fn count(&self) -> usize {
        self.count
    }

    fn turns(&self, joint: usize) -> bool {
        self.joint(joint).is_some_and(|(member, joint)| member.whole.turns(joint))
    }
}

impl Configuration for CoupledModel<'_> {
    fn unknown(&self) -> &[usize] {
        &self.unknown
    }

    fn length(&self) -> f64 {
        self.members.iter().map(|member| member.whole.length).fold(0.0, f64::max)
    }

    fn target(&self, q: &[f64]) -> Vec<f64> {
        let mut target = vec![0.0; self.derived.program.inputs.len()];
        for member in &self.members {
            member.stage.write(&member.own.target(&member.stage.own(q)), &mut target);
        }
        self.derived.write_given(q, &mut target);
        target
    }

    fn misses(&self, target: &[f64], q: &[f64]) -> Vec<f64> {
        let misses = |member: &Member<'_>| member.whole.misses(&member.stage.target(target, q), &member.stage.own(q));
        self.members.iter().flat_map(misses).collect()
    }

    fn residual(&self, target: &[f64], q: &[f64]) -> f64 {
        let residual = |member: &Member<'_>| member.own.residual(&member.stage.target(target, q), &member.stage.own(q));
        self.members.iter().map(residual).fold(0.0, f64::max)
    }

    fn jacobian(&self, q: &[f64]) -> DMatrix<f64> {
        let blocks: Vec<DMatrix<f64>> =
            self.members.iter().map(|member| member.whole.jacobian(&member.stage.own(q))).collect();
        let mut whole = DMatrix::zeros(blocks.iter().map(DMatrix::nrows).sum(), self.unknown.len());
        let mut first = 0;
        for (member, block) in self.members.iter().zip(&blocks) {
            for (column, &joint) in member.whole.unknown.iter().enumerate() {
                let actuator = self.unknown.iter().position(|actuator| *actuator == member.stage.joints[joint]);
                for (place, row) in
                    actuator.into_iter().flat_map(|actuator| (0..block.nrows()).map(move |row| (actuator, row)))
                {
                    whole[(first + row, place)] = block[(row, column)];
                }
            }
            first += block.nrows();
        }
        whole
    }

    fn search(&self, target: &[f64], seeds: usize) -> Result<Vec<Vec<f64>>> {
        let solve = |member: &Member<'_>, target: &[f64]| {
            let found = member.own.search(target, seeds)?;
            let answer = |q| Solution { q, ..Solution::default() };
            Ok(found.into_iter().map(answer).collect())
        };
        Ok(self.continued(target, &solve)?.into_iter().map(|answer| answer.q).collect())
    }

    fn completed(&self, _: &[f64], answer: Solution) -> Solution {
        answer
    }
}

/// The screw solvers of chains, one after the other.
struct ByScrews<'a> {
    coupled: &'a CoupledModel<'a>,
    /// The screw solver of each chain.
    screws: Vec<Screws>,
}

impl<'a> ByScrews<'a> {
    /// `None` if screw theory does not solve each chain, one after the other.
    fn new(coupled: &'a CoupledModel<'a>) -> Option<Self> {
        if coupled.derived.method.simultaneous.is_some() {
            return None;
        }
        let screws: Option<Vec<Screws>> = coupled.members.iter().map(|member| Screws::new(member.own.chain)).collect();
        screws.map(|screws| ByScrews { coupled, screws })
    }

    fn of(&self, member: &Member<'_>, target: &[f64]) -> Result<Vec<Solution>> {
        let index = self.coupled.members.iter().position(|other| other.stage.member == member.stage.member);
        index.map_or_else(|| Ok(Vec::new()), |index| self.screws[index].solve(target))
    }
}

impl Solver for ByScrews<'_> {
    /// A free joint of a chain has only one sample here, which later chains may not fit. No solution is returned then.
    fn solve(&self, inputs: &[f64]) -> Result<Vec<Solution>> {
        let found = self.coupled.continued(inputs, &|member, target| self.of(member, target))?;
        let shared = |actuator: &usize| {
            self.coupled.members.iter().filter(|member| member.joint(*actuator).is_some()).count() > 1
        };
        if found.iter().any(|answer| answer.free.iter().any(shared)) {
            return Err(Error::new(ErrorKind::Unsupported, "a shared actuator is free"));
        }
        Ok(found)
    }
}

/// The source of targets: those of one chain at a time, with random joints of the others.
struct Sources<'a> {
    coupled: &'a CoupledModel<'a>,
    leading: &'a [Model<'a>],
    /// The source of each chain.
    sources: Vec<Targets<'a>>,
}

impl<'a> Sources<'a> {
    fn new(coupled: &'a CoupledModel<'a>, leading: &'a [Model<'a>], options: &Options) -> Self {
        let source =
            |(index, model): (usize, &'a Model<'a>)| Targets::new(model, options.draws, options.seed + index as u64);
        Sources { coupled, leading, sources: leading.iter().enumerate().map(source).collect() }
    }

    fn draw(&mut self, number: usize) -> Target {
        let count = self.sources.len();
        let turn = number % count;
        let Target { kind, inputs, joints } = self.sources[turn].draw(number / count);
        let mut actuators: Vec<Option<f64>> = vec![None; self.coupled.count];
        let (leading, given) = (&self.coupled.members[turn], &self.leading[turn].given);
        match &joints {
            Some(values) => {
                leading.stage.joints.iter().zip(values).for_each(|(&actuator, &q)| actuators[actuator] = Some(q))
            }
            None => {
                let values = &inputs[inputs.len() - given.len()..];
                let given = given.iter().map(|&joint| leading.stage.joints[joint]);
                given.zip(values).for_each(|(actuator, &q)| actuators[actuator] = Some(q));
            }
        }
        for (member, source) in self.coupled.members.iter().zip(&mut self.sources) {
            for (&actuator, q) in member.stage.joints.iter().zip(source.joints()) {
                actuators[actuator].get_or_insert(q);
            }
        }
        let q: Vec<f64> = actuators.into_iter().flatten().collect();
        let mut target = self.coupled.target(&q);
        leading.stage.write(&inputs, &mut target);
        Target { kind, inputs: target, joints: joints.map(|_| q) }
    }
}
