//! From coupled chains to one solver: [`Coupled`].

use super::model::{CoupledChain, CoupledChains, JointPlace};
use super::origin::{Origin, origins};
use crate::derive::closure::Mechanism;
use crate::derive::planner::{self, Plan, PlanStep, StepMethod};
use crate::derive::problem::ChainProblem;
use crate::derive::sequential::{Sequential, SequentialView, Side, Simultaneous};
use crate::derive::view::View;
use crate::solver::{MAX_JOINTS, Program, TipTask};
use crate::{Error, ErrorKind, Result, Watch};

/// The solution of one chain, and its part of the common solver.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ChainStage {
    /// Index of the chain.
    pub member: usize,
    /// The chain. Joints that earlier chains have found are given.
    pub problem: ChainProblem,
    /// The solution of the chain.
    pub method: Sequential,
    /// The solver of this chain alone.
    pub solver: Program,
    /// The solver of this chain and all earlier ones.
    pub program: Program,
    /// By joint of the chain: its index among the joints of the solver.
    pub joints: Vec<usize>,
    /// By input of the chain's own solver: the source of its value.
    pub(super) inputs: Vec<Origin>,
}

/// A function that returns the solution of one of the chains, and its solver.
pub(super) type Derive<'a> = dyn FnMut(usize, &ChainProblem) -> Result<(Sequential, Program)> + 'a;

/// The solution of several chains that share actuators, one chain after the other.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Coupled {
    /// The derivation of joints that two chains share and that neither determines alone. They are found first.
    pub simultaneous: Option<Simultaneous>,
    /// The chains' solutions, in the order of solution.
    pub stages: Vec<ChainStage>,
}

/// The view of coupled chains, solved one after the other.
pub type CoupledView<'a> = View<'a, CoupledChains, Coupled>;

impl Coupled {
    /// Orders the chains, derives each alone with the joints given that are found before it, and composes their solvers.
    ///
    /// Of the chains that can be solved next, the first is used. If none can, the joints that two chains share are found first.
    ///
    /// # Errors
    /// [`ErrorKind::PositiveDimensional`] if the tasks do not determine all joints of the remaining chains. [`ErrorKind::BadValue`] for a given joint that
    /// another chain finds. As [`Sequential::derive`], with the chain; as [`Simultaneous::derive`].
    pub(in crate::derive) fn derive(coupled: &CoupledChains, watch: &Watch) -> Result<(Self, Program)> {
        let simultaneous = match coupling(coupled)? {
            Some((sides, shared)) => found_together(Simultaneous::derive(sides, shared, watch), coupled)?,
            None => None,
        };
        Coupled::assemble(coupled, simultaneous, &mut |member, problem| {
            derived(problem, coupled.chains()[member].chain.given().len(), watch)
        })
    }

    /// Composes the chains' solvers, which `derive` returns for each index in the order of solution.
    pub(super) fn assemble(
        coupled: &CoupledChains,
        simultaneous: Option<Simultaneous>,
        derive: &mut Derive<'_>,
    ) -> Result<(Self, Program)> {
        let mut found = Found { coupled, simultaneous: simultaneous.as_ref(), stages: Vec::new() };
        while found.stages.len() < coupled.chains().len() {
            let member = found.next_member()?;
            let named = |error: Error| error.with_context(format_args!("chain `{}`", coupled.chains()[member].name));
            let stage = ChainStage::derive(&found, member, derive).map_err(named)?;
            found.stages.push(stage);
        }
        let stages = found.stages;
        let last = stages.last().map(|stage| stage.program.clone());
        let mut program = last.ok_or_else(|| Error::new(ErrorKind::BadValue, "there are no chains"))?;
        let all = Coupled { simultaneous, stages };
        let most = 2 * all.dimension() + program.blocks.len();
        program.capacity = most.min(program.capacity);
        all.name_actuators(coupled, &mut program);
        all.name_tasks(coupled, &mut program);
        Ok((all, program))
    }

    /// The number of complex solutions at a generic target that the chains can reach: the product of the chains' numbers of solutions, each with the earlier
    /// joints given.
    pub fn dimension(&self) -> usize {
        let shared = self.simultaneous.as_ref().map_or(1, Simultaneous::dimension);
        self.stages.iter().map(|stage| stage.method.plan.dimension).fold(shared, usize::saturating_mul)
    }

    /// Replaces the joints' names by the actuators' names.
    fn name_actuators(&self, coupled: &CoupledChains, program: &mut Program) {
        program.name.clone_from(&coupled.parts().name);
        for stage in &self.stages {
            for (joint, &place) in stage.joints.iter().enumerate() {
                let actuator = coupled.actuator_of(JointPlace { member: stage.member, joint });
                program.joints[place].name =
                    actuator.map(|actuator| coupled.actuators()[actuator].name.clone()).unwrap_or_default();
            }
        }
    }

    /// Sets the tasks of the solver: one for each chain, with its name.
    fn name_tasks(&self, coupled: &CoupledChains, program: &mut Program) {
        let task = |(member, chain): (usize, &CoupledChain)| {
            let stage = self.stages.iter().find(|stage| stage.member == member)?;
            let tip = stage.solver.tip()?;
            let Origin::Target(first_input) = *stage.inputs.get(tip.first_input)? else { return None };
            Some(TipTask { chain: Some(chain.name.clone()), first_input, ..tip.clone() })
        };
        program.tasks = coupled.chains().iter().enumerate().filter_map(task).collect();
    }
}

impl CoupledView<'_> {
    /// Whether joints that two chains share can be found from both together, but this solution does not do so.
    ///
    /// # Errors
    /// As [`Simultaneous::derive`].
    pub(in crate::derive) fn leaves_shared_joints_out(&self, watch: &Watch) -> Result<bool> {
        if self.method.simultaneous.is_some() {
            return Ok(false);
        }
        let Some((sides, shared)) = coupling(self.problem)? else { return Ok(false) };
        Ok(found_together(Simultaneous::derive(sides, shared, watch), self.problem)?.is_some())
    }

    /// The values of the joints of chain `member` in a solution `q` of the solver.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a chain that does not exist or another number of joints.
    pub fn joints_of(&self, member: usize, q: &[f64]) -> Result<Vec<f64>> {
        let stage = self.method.stages.iter().find(|stage| stage.member == member);
        match stage {
            Some(stage) if q.len() == self.program.joints.len() => Ok(stage.own(q)),
            _ => {
                let (chains, joints) = (self.method.stages.len(), self.program.joints.len());
                Err(Error::new(
                    ErrorKind::BadValue,
                    format!("chain {member} of {chains}, {} joint values of {joints}", q.len()),
                ))
            }
        }
    }

    /// The target, in the order of the solver's inputs, that the chains reach with the solver's joints at `q`.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for another number of joints.
    pub(crate) fn reached(&self, q: &[f64]) -> Result<Vec<f64>> {
        let mut target = vec![0.0; self.program.inputs.len()];
        for stage in &self.method.stages {
            stage.write(&stage.problem.reached(&self.joints_of(stage.member, q)?)?, &mut target);
        }
        self.write_given(q, &mut target);
        Ok(target)
    }

    /// Writes the values of the joints that the user gives into a target of the solver.
    pub(crate) fn write_given(&self, q: &[f64], target: &mut [f64]) {
        self.program.given_joints.iter().for_each(|given| target[given.input] = q[given.joint]);
    }
}

impl ChainStage {
    /// The chain's solution after those of `before`.
    fn derive(before: &Found<'_>, member: usize, derive: &mut Derive<'_>) -> Result<Self> {
        let CoupledChain { prefix, chain, .. } = &before.coupled.chains()[member];
        let found: Vec<Option<usize>> = (0..chain.joints().len()).map(|joint| before.place(member, joint)).collect();
        let mut given = chain.parts().given.clone();
        for (joint, _) in chain.joints().iter().zip(&found).filter(|(_, found)| found.is_some()) {
            match (given.contains(&joint.name), before.simultaneous) {
                (false, _) => given.push(joint.name.clone()),
                // The user gives one value for both chains.
                (true, Some(_)) => {}
                (true, None) => {
                    let text = format!("`{}` is given, but an earlier chain finds its actuator; omit it", joint.name);
                    return Err(Error::new(ErrorKind::BadValue, text));
                }
            }
        }
        let chain = chain.with_task(chain.task(), chain.direction().clone(), given)?;
        let problem = ChainProblem::from(&chain);
        let (method, solver) = derive(member, &problem)?;
        let own = solver.prefixed(prefix);
        let shared: Vec<(usize, usize)> =
            found.iter().enumerate().filter_map(|(joint, &found)| found.map(|place| (place, joint))).collect();
        let last = before.program();
        let (program, places) = match last {
            Some(last) => last.joined(&own, &shared)?,
            None => (own.clone(), (0..own.inputs.len()).map(Some).collect()),
        };
        let mut fresh = last.map_or(0, |last| last.joints.len())..MAX_JOINTS;
        let joints: Vec<usize> = found.iter().filter_map(|found| found.or_else(|| fresh.next())).collect();
        let inputs = origins(&own, &places, &found);
        Ok(ChainStage { member, problem, method, solver, program, joints, inputs })
    }

    /// The view of the chain alone.
    pub fn view(&self) -> SequentialView<'_> {
        View { problem: &self.problem, method: &self.method, program: &self.solver }
    }

    /// The values `own` of the chain's joints among `count` joints of the solver. Other joints are zero.
    pub(super) fn put(&self, own: &[f64], count: usize) -> Vec<f64> {
        let mut q = vec![0.0; count];
        self.joints.iter().zip(own).for_each(|(&place, &value)| q[place] = value);
        q
    }

    /// The values of the chain's joints, selected from those of the solver.
    pub fn own(&self, q: &[f64]) -> Vec<f64> {
        self.joints.iter().map(|&place| q[place]).collect()
    }

    /// Writes the chain's own target into a target of the solver. Values that other chains find are not part of it.
    pub fn write(&self, own: &[f64], target: &mut [f64]) {
        for (&value, origin) in own.iter().zip(&self.inputs) {
            if let Origin::Target(index) = *origin {
                target[index] = value;
            }
        }
    }

    /// The joints of the solver that earlier chains find and this chain uses.
    pub fn found(&self) -> impl Iterator<Item = usize> {
        self.inputs.iter().filter_map(|origin| match *origin {
            Origin::Joint(index) => Some(index),
            Origin::Target(_) => None,
        })
    }

    /// The chain's own target in a target of the solver, without the joints that earlier chains find.
    pub fn own_target(&self, target: &[f64]) -> Vec<f64> {
        let own = |origin: &Origin| match *origin {
            Origin::Target(index) => Some(target[index]),
            Origin::Joint(_) => None,
        };
        self.inputs.iter().filter_map(own).collect()
    }

    /// The inputs of the chain's own solver, from a target of the solver and its joints.
    pub fn target(&self, target: &[f64], q: &[f64]) -> Vec<f64> {
        let value = |origin: &Origin| match *origin {
            Origin::Target(index) => target[index],
            Origin::Joint(index) => q[index],
        };
        self.inputs.iter().map(value).collect()
    }
}

/// The part that is derived so far.
struct Found<'a> {
    coupled: &'a CoupledChains,
    simultaneous: Option<&'a Simultaneous>,
    stages: Vec<ChainStage>,
}

impl Found<'_> {
    /// The solver of that part.
    fn program(&self) -> Option<&Program> {
        self.stages.last().map(|stage| &stage.program).or(self.simultaneous.map(|simultaneous| &simultaneous.program))
    }

    /// The index among the solver's joints of a joint whose actuator is already found.
    fn place(&self, member: usize, joint: usize) -> Option<usize> {
        if let Some(simultaneous) = self.simultaneous.filter(|simultaneous| joint < simultaneous.shared) {
            debug_assert!(simultaneous.program.joints.len() == simultaneous.shared);
            return Some(joint);
        }
        let actuator = &self.coupled.actuators()[self.coupled.actuator_of(JointPlace { member, joint })?];
        let place = |stage: &ChainStage| {
            let twin = actuator.joints.iter().find(|place| place.member == stage.member)?;
            Some(stage.joints[twin.joint])
        };
        self.stages.iter().find_map(place)
    }

    /// The number of a chain's joints that are neither given nor found.
    fn open(&self, member: usize) -> usize {
        let chain = &self.coupled.chains()[member].chain;
        let given = chain.given();
        (0..chain.joints().len()).filter(|joint| !given.contains(joint) && self.place(member, *joint).is_none()).count()
    }

    /// The first chain whose task can determine its remaining joints.
    fn next_member(&self) -> Result<usize> {
        let left = |member: &usize| self.stages.iter().all(|stage| stage.member != *member);
        let freedoms = |member: usize| self.coupled.chains()[member].chain.task().freedoms();
        let remaining: Vec<usize> = (0..self.coupled.chains().len()).filter(left).collect();
        remaining.iter().copied().find(|&member| self.open(member) <= freedoms(member)).ok_or_else(|| {
            let description = |&member: &usize| {
                let CoupledChain { name, chain, .. } = &self.coupled.chains()[member];
                let (open, task) = (self.open(member), chain.task().name());
                format!("`{name}` has {open} joints to find, its task `{task}` determines {}", freedoms(member))
            };
            let list: Vec<String> = remaining.iter().map(description).collect();
            let text = format!(
                "no chain can be solved next: {}; choose a task that determines more joints, or give a joint",
                list.join("; ")
            );
            Error::new(ErrorKind::PositiveDimensional, text)
        })
    }
}

/// The solution of one of the chains. The first `least` of its given joints are given by the user, the others by earlier chains.
///
/// If more joints are given than necessary, the plan is the one that finds the additional joints, without their steps. The relations of these steps are added
/// to steps of joints that both determine; if one relation is singular, the other determines the joint.
///
/// # Errors
/// As [`Sequential::derive`].
fn derived(problem: &ChainProblem, least: usize, watch: &Watch) -> Result<(Sequential, Program)> {
    let chain = &problem.chain;
    let mut given = chain.parts().given.clone();
    let open = chain.joints().len().saturating_sub(chain.task().freedoms()).max(least);
    if given.len() <= open {
        return Sequential::derive(problem, watch);
    }
    given.truncate(open);
    let wider = chain.with_task(chain.task(), chain.direction().clone(), given)?;
    let steps = match planner::plan(&Mechanism::new(&wider)?, watch) {
        Ok(plan) => plan.steps,
        Err(error) if matches!(error.kind(), ErrorKind::Unsupported | ErrorKind::PositiveDimensional) => {
            return Sequential::derive(problem, watch);
        }
        Err(error) => return Err(error),
    };
    let mechanism = Mechanism::new(chain)?;
    let own = planner::plan(&mechanism, watch)?;
    let steps = without(&own.given, steps);
    Sequential::of_plan(&mechanism, Plan { steps, ..own }, watch)?.compiled(problem, &mechanism)
}

/// The steps without those of known joints. Relations of the removed steps are added to steps with a single relation for the same joint.
fn without(known: &[usize], steps: Vec<PlanStep>) -> Vec<PlanStep> {
    let (gone, mut kept): (Vec<PlanStep>, Vec<PlanStep>) =
        steps.into_iter().partition(|step| known.contains(&step.joint));
    for other in gone.iter().flat_map(|step| step.method.relations()) {
        let left: Vec<usize> = other.joints().into_iter().filter(|joint| !known.contains(joint)).collect();
        for step in &mut kept {
            if let StepMethod::Single(own) = &step.method
                && left == [step.joint]
            {
                step.method = StepMethod::Pair([own.clone(), other.clone()]);
                step.degree = 1;
            }
        }
    }
    kept
}

/// The derivation of shared joints. `None` if no relations fit, but a chain determines its joints alone.
///
/// # Errors
/// Those of the derivation.
fn found_together(simultaneous: Result<Simultaneous>, coupled: &CoupledChains) -> Result<Option<Simultaneous>> {
    match simultaneous {
        Err(error) if error.kind() == ErrorKind::Unsupported => {
            let alone = Found { coupled, simultaneous: None, stages: Vec::new() }.next_member();
            alone.map(|_| None).map_err(|_| error)
        }
        simultaneous => simultaneous.map(Some),
    }
}

/// Two chains and the number of common joints at the base that both share, if these joints are found from both chains together. This applies to two joints that
/// neither chain determines alone, or to one on which both must agree.
///
/// # Errors
/// [`ErrorKind::PositiveDimensional`] if both together do not determine their joints.
pub(super) fn coupling(coupled: &CoupledChains) -> Result<Option<([Side<'_>; 2], usize)>> {
    let found = Found { coupled, simultaneous: None, stages: Vec::new() };
    let [first, second] = coupled.chains() else { return Ok(None) };
    let is_shared = |joint: &usize| {
        let actuator =
            coupled.actuator_of(JointPlace { member: 0, joint: *joint }).map(|actuator| &coupled.actuators()[actuator]);
        actuator.is_some_and(|actuator| actuator.joints.contains(&JointPlace { member: 1, joint: *joint }))
    };
    let shared = (0..first.chain.joints().len()).take_while(is_shared).count();
    let given = first.chain.given();
    let common = (0..shared).filter(|joint| !given.contains(joint)).count();
    let excess =
        |member: usize| found.open(member) as isize - coupled.chains()[member].chain.task().freedoms() as isize;
    let sides = Some(([first, second].map(|member| Side { chain: &member.chain, prefix: &member.prefix }), shared));
    match (common, excess(0), excess(1)) {
        (1, ..=0, ..=0) | (2, 1, 1) => Ok(sides),
        (_, 1.., 1..) => found.next_member().map(|_| None),
        _ => Ok(None),
    }
}
