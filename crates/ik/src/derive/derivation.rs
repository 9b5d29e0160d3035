//! The derivation of a solver: [`Derivation`].

pub mod redundant;

use self::redundant::RedundantChain;
use crate::derive::Source;
use crate::derive::coupled::{Coupled, CoupledView};
use crate::derive::eigenvalue::{self, Eigenvalue, EigenvalueView, fits};
use crate::derive::equations::certificate::{self, refused};
use crate::derive::equations::{Equations, EquationsView};
use crate::derive::problem::{ChainProblem, Problem};
use crate::derive::sequential::{self, Sequential, SequentialView};
use crate::derive::view::View;
use crate::solver::{About, Program, Solver};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_robot::kinematics::Chain;

/// A proved derivation of a solver.
#[derive(Clone, Debug, PartialEq)]
pub struct Derivation {
    problem: Problem,
    method: Method,
    program: Program,
    redundancy: Option<Box<RedundantChain>>,
}

/// The method that solves a problem.
#[derive(Clone, Debug, PartialEq)]
pub enum Method {
    /// Equations solved as one block.
    Equations(Box<Equations>),
    /// A chain solved one joint at a time.
    Sequential(Box<Sequential>),
    /// A chain whose six joints are solved together.
    Eigenvalue(Box<Eigenvalue>),
    /// Coupled chains (they share actuators), solved one chain after the other.
    Coupled(Box<Coupled>),
}

/// A derivation with typed problem and method.
#[derive(Clone, Copy, Debug)]
pub enum AnyView<'a> {
    /// Equations solved as one block.
    Equations(EquationsView<'a>),
    /// A chain solved one joint at a time.
    Sequential(SequentialView<'a>),
    /// A chain whose six joints are solved together.
    Eigenvalue(EigenvalueView<'a>),
    /// Coupled chains, solved one chain after the other.
    Coupled(CoupledView<'a>),
}

impl Derivation {
    /// Derives and proves the solver of `source`.
    ///
    /// # Errors
    /// As [`Source::check_base`], [`Problem::of`] and [`Derivation::of_problem`].
    pub fn of<'w>(source: &Source, watch: impl Into<Option<&'w Watch>>) -> Result<Self> {
        let watch = Watch::or_none(watch);
        source.check_base()?;
        let derived = match Problem::of(source)? {
            Problem::Chain(problem) if source.ends.redundant => Derivation::redundant(*problem, watch),
            problem => Derivation::of_problem(problem, watch),
        };
        derived.map_err(|error| match error.kind() {
            ErrorKind::Unsupported | ErrorKind::PositiveDimensional => source.advised(error),
            _ => error,
        })
    }

    /// Derives and proves the solver of `problem`. A chain is solved one joint at a time if possible, otherwise by one eigenvalue problem of six joints.
    ///
    /// # Errors
    /// As [`Chain::check_base`] and [`Chain::check_task`]. [`ErrorKind::Inconsistent`] for equations without a solution. [`ErrorKind::PositiveDimensional`]
    /// with the names of the free joints. [`ErrorKind::Unsupported`] for a problem that no method solves. The error of `watch` if it stops the derivation.
    pub fn of_problem<'w>(problem: impl Into<Problem>, watch: impl Into<Option<&'w Watch>>) -> Result<Self> {
        let watch = Watch::or_none(watch);
        match problem.into() {
            Problem::System(system) => {
                let solved = Equations::derive(&system, watch)?;
                Ok(Derivation::assemble(Problem::System(system), solved, Method::Equations))
            }
            Problem::Chain(problem) => Derivation::of_either(*problem, watch),
            Problem::Coupled(coupled) => {
                let solved = Coupled::derive(&coupled, watch)?;
                Ok(Derivation::assemble(Problem::Coupled(coupled), solved, Method::Coupled))
            }
        }
    }

    /// Solves one joint at a time if possible, otherwise all six joints together.
    fn of_either(problem: ChainProblem, watch: &Watch) -> Result<Self> {
        let chain = problem.measured();
        chain.check_base(None)?;
        match Sequential::derive(&problem, watch) {
            Err(refusal) if refusal.kind() == ErrorKind::Unsupported && fits(chain).is_ok() => {
                Derivation::by_eigenvalues(problem, watch).map_err(|error| match error.kind() {
                    ErrorKind::Unsupported => refusal,
                    _ => error,
                })
            }
            solved => Ok(Derivation::sequential_of(problem, solved?)),
        }
    }

    /// Derives and proves the solvers of a chain with one joint more than its task determines: with the given joint of `problem`, and with each other joint given
    /// instead.
    ///
    /// # Errors
    /// As [`Derivation::of_problem`] for the given joint of `problem`. [`ErrorKind::Unsupported`] for another chain. Other joints without a solver are not errors.
    pub fn redundant<'w>(problem: impl Into<ChainProblem>, watch: impl Into<Option<&'w Watch>>) -> Result<Self> {
        let (watch, problem) = (Watch::or_none(watch), problem.into());
        redundant::check(&problem.chain)?;
        let main = Derivation::of_either(problem.clone(), watch)?;
        let redundancy = RedundantChain::derive(&problem, watch)?;
        Ok(main.with_redundancy(&problem, redundancy))
    }

    fn with_redundancy(mut self, problem: &ChainProblem, redundancy: RedundantChain) -> Self {
        self.program.redundancy = Some(Box::new(redundant::data(problem, &self, &redundancy)));
        self.redundancy = Some(Box::new(redundancy));
        self
    }

    /// Derives and proves a solver that finds one joint at a time.
    ///
    /// # Errors
    /// [`ErrorKind::PositiveDimensional`] if joints are free; [`ErrorKind::Unsupported`] for a chain without such an order of joints. The error of `watch` if
    /// it stops the derivation.
    pub fn sequentially<'w>(problem: impl Into<ChainProblem>, watch: impl Into<Option<&'w Watch>>) -> Result<Self> {
        let watch = Watch::or_none(watch);
        let problem = problem.into();
        let solved = Sequential::derive(&problem, watch)?;
        Ok(Derivation::sequential_of(problem, solved))
    }

    /// Derives and proves a solver that finds six joints together.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for a chain that does not fit the eigenvalue problem ([`fits`]), that has infinitely many solutions, or that has no regular
    /// and accurate formulation. The error of `watch` if it stops the derivation.
    #[doc(hidden)]
    pub fn by_eigenvalues<'w>(problem: impl Into<ChainProblem>, watch: impl Into<Option<&'w Watch>>) -> Result<Self> {
        let watch = Watch::or_none(watch);
        let problem = problem.into();
        let solved = Eigenvalue::derive(&problem, watch)?;
        Ok(Derivation::eigenvalue_of(problem, solved))
    }

    /// Proves the derivation of `source` again from the text of its certificate, without the Groebner engine.
    ///
    /// # Errors
    /// As [`Problem::of`] and [`Derivation::prove`]. [`ErrorKind::Certificate`] for a proof with one given joint if each joint is requested, and the converse.
    pub fn prove_source(source: &Source, text: &str) -> Result<Self> {
        let proved = Derivation::prove(Problem::of(source)?, text)?;
        match (source.ends.redundant, proved.redundancy.is_some()) {
            (true, false) => Err(refused("the proofs with the other joints given are missing".to_owned())),
            (false, true) => Err(refused("the proofs with the other joints given are superfluous".to_owned())),
            _ => Ok(proved),
        }
    }

    /// Proves the derivation of `problem` again from the text of its certificate, without searches and without the Groebner engine.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] with the line for text that is not a certificate. [`ErrorKind::Certificate`] for a claim that is false, missing or superfluous; it
    /// names the stratum, step, form or chain.
    pub fn prove(problem: impl Into<Problem>, text: &str) -> Result<Self> {
        let problem = problem.into();
        Ok(match &problem {
            Problem::System(system) => {
                let solved = certificate::prove(system, text)?;
                Derivation::assemble(problem, solved, Method::Equations)
            }
            Problem::Chain(chain) if redundant::is_certificate(text) => {
                let (main, redundancy) = redundant::prove(chain, text)?;
                main.with_redundancy(chain, redundancy)
            }
            Problem::Chain(chain) if eigenvalue::is_certificate(text) => {
                let solved = Eigenvalue::prove(chain, text)?;
                Derivation::assemble(problem, solved, Method::Eigenvalue)
            }
            Problem::Chain(chain) => {
                let solved = sequential::certificate::prove(chain, text)?;
                Derivation::assemble(problem, solved, Method::Sequential)
            }
            Problem::Coupled(coupled) => {
                let solved = Coupled::prove(coupled, text)?;
                Derivation::assemble(problem, solved, Method::Coupled)
            }
        })
    }

    fn assemble<M>(problem: Problem, (method, program): (M, Program), of: impl Fn(Box<M>) -> Method) -> Self {
        Derivation { problem, method: of(Box::new(method)), program, redundancy: None }
    }

    pub(in crate::derive) fn sequential_of(problem: ChainProblem, solved: (Sequential, Program)) -> Self {
        Derivation::assemble(problem.into(), solved, Method::Sequential)
    }

    pub(in crate::derive) fn eigenvalue_of(problem: ChainProblem, solved: (Eigenvalue, Program)) -> Self {
        Derivation::assemble(problem.into(), solved, Method::Eigenvalue)
    }

    /// The problem that is solved.
    #[doc(hidden)]
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// The method that solves the problem.
    pub fn method(&self) -> &Method {
        &self.method
    }

    /// The solvers with other joints given, of a chain with one joint more than its task determines.
    pub fn redundancy(&self) -> Option<&RedundantChain> {
        self.redundancy.as_deref()
    }

    /// The solver as data, which is stored and printed as source code.
    pub fn program(&self) -> &Program {
        &self.program
    }

    /// The solver, ready to run. It is prepared once and solves any number of targets.
    pub fn solver(&self) -> Solver {
        self.program.solver()
    }

    /// The problem and the method with their types.
    #[doc(hidden)]
    pub fn view(&self) -> AnyView<'_> {
        let program = &self.program;
        match (&self.problem, &self.method) {
            (Problem::System(problem), Method::Equations(method)) => {
                AnyView::Equations(View { problem, method, program })
            }
            (Problem::Chain(problem), Method::Sequential(method)) => {
                AnyView::Sequential(View { problem, method, program })
            }
            (Problem::Chain(problem), Method::Eigenvalue(method)) => {
                AnyView::Eigenvalue(View { problem, method, program })
            }
            (Problem::Coupled(problem), Method::Coupled(method)) => AnyView::Coupled(View { problem, method, program }),
            _ => unreachable!("each constructor joins a problem with a method for it"),
        }
    }

    /// The view of equations solved as one block; `None` for another method.
    pub fn equations(&self) -> Option<EquationsView<'_>> {
        if let AnyView::Equations(view) = self.view() { Some(view) } else { None }
    }

    /// The view of a chain solved one joint at a time; `None` for another method.
    #[doc(hidden)]
    pub fn sequential(&self) -> Option<SequentialView<'_>> {
        if let AnyView::Sequential(view) = self.view() { Some(view) } else { None }
    }

    /// The view of a chain whose six joints are solved together; `None` for another method.
    #[doc(hidden)]
    pub fn eigenvalue(&self) -> Option<EigenvalueView<'_>> {
        if let AnyView::Eigenvalue(view) = self.view() { Some(view) } else { None }
    }

    /// The view of coupled chains; `None` for another method.
    #[doc(hidden)]
    pub fn coupled(&self) -> Option<CoupledView<'_>> {
        if let AnyView::Coupled(view) = self.view() { Some(view) } else { None }
    }

    /// The target that the joint values `q` reach by forward kinematics, in the order of the program's inputs.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for another number of joints; [`ErrorKind::Unsupported`] for equations, which have no forward kinematics.
    pub fn reached(&self, q: &[f64]) -> Result<Vec<f64>> {
        match (&self.problem, self.coupled()) {
            (Problem::Chain(problem), _) => problem.reached(q),
            (_, Some(coupled)) => coupled.reached(q),
            _ => Err(Error::new(ErrorKind::Unsupported, "a system of equations has no forward kinematics")),
        }
    }

    /// The text of `certificate.json`.
    ///
    /// # Errors
    /// If a field cannot be built. This does not occur for a derivation that this crate made.
    pub fn certificate(&self) -> Result<String> {
        if let Some(redundancy) = &self.redundancy {
            return redundant::certificate(self, redundancy);
        }
        match self.view() {
            AnyView::Equations(view) => certificate::write(view),
            AnyView::Sequential(view) => sequential::certificate::write(view),
            AnyView::Eigenvalue(view) => Ok(view.certificate()),
            AnyView::Coupled(view) => view.certificate(),
        }
    }

    /// The number of complex solutions of a generic reachable target, if it was counted.
    pub fn dimension(&self) -> Option<usize> {
        match &self.method {
            Method::Equations(method) => method.dimension(),
            Method::Sequential(method) => Some(method.plan.dimension),
            Method::Eigenvalue(method) => Some(method.dimension()),
            Method::Coupled(method) => Some(method.dimension()),
        }
    }

    /// Same derivation, with metadata of `source` in its program: links, hash, limits and followers.
    #[must_use]
    pub fn about(mut self, source: &Source) -> Self {
        let solutions = self.dimension();
        self.program.about = Some(About { solutions, ..about(source, &self.program) });
        self
    }
}

/// Metadata of `source`, with limits and leaders of the program's joints.
fn about(source: &Source, program: &Program) -> About {
    let actuators = match (&source.chain, &source.coupled) {
        (Some(chain), _) => chain.joints().iter().map(|joint| (joint.name.as_str(), joint.limits)).collect(),
        (None, Some(coupled)) => {
            coupled.actuators().iter().map(|actuator| (actuator.name.as_str(), coupled.limits(actuator))).collect()
        }
        (None, None) => Vec::new(),
    };
    let limits = |name: &str| actuators.iter().find(|(actuator, _)| *actuator == name).and_then(|(_, limits)| *limits);
    let limits: Vec<_> = program.joints.iter().map(|joint| limits(&joint.name)).collect();
    let joints = source.chain.as_ref().map_or(&[][..], Chain::joints);
    let follows = |name: &str| joints.iter().find(|joint| joint.name == name).and_then(|joint| joint.mimic.clone());
    let follows: Vec<_> = program.joints.iter().map(|joint| follows(&joint.name)).collect();
    let request = source.task_file().map_or_else(Vec::new, |(_, text)| text);
    let [base, tip] = source.links.clone().map_or([None, None], |links| links.map(Some));
    About {
        base,
        tip,
        solutions: None,
        hash: format!("{:016x}", hash(source.text.bytes().chain(request))),
        limits: if limits.iter().all(Option::is_none) { Vec::new() } else { limits },
        follows: if follows.iter().all(Option::is_none) { Vec::new() } else { follows },
    }
}

/// The 64-bit FNV-1a hash of Fowler, Noll and Vo (draft-eastlake-fnv).
fn hash(bytes: impl Iterator<Item = u8>) -> u64 {
    bytes.fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}
