//! The derivation of a chain's solver in one call: [`derive`](fn@derive), with [`Options`].

use crate::derive::planner::is_redundant;
use crate::derive::planner::joints_to_give;
use crate::derive::{ChainProblem, Derivation};
use crate::{Result, Watch};
use groebot_robot::kinematics::Chain;
use groebot_robot::kinematics::ideal::TOLERANCE;

/// Derives and proves the solver of `chain` for its task: the solver of the nearest ideal chain, with answers polished on `chain` itself.
///
/// ```
/// use groebot_robot::robots;
///
/// let derivation = groebot_ik::derive(&robots::puma())?;
/// assert_eq!(derivation.dimension(), Some(8));
/// # Ok::<(), groebot_ik::Error>(())
/// ```
///
/// # Errors
/// As [`Options::derive`].
pub fn derive(chain: &Chain) -> Result<Derivation> {
    Options::new().derive(chain)
}

/// Options of the derivation of a chain's solver.
///
/// ```
/// use std::time::Duration;
///
/// use groebot_ik::Watch;
/// use groebot_ik::derive::Options;
/// use groebot_robot::robots;
///
/// let watch = Watch::none().with_time(Duration::from_secs(600));
/// let derivation = Options::new().watch(watch).exact().derive(&robots::puma())?;
/// assert_eq!(derivation.dimension(), Some(8));
/// # Ok::<(), groebot_ik::Error>(())
/// ```
#[derive(Clone, Default)]
pub struct Options {
    watch: Watch,
    given: Option<Vec<String>>,
    tolerance: Option<f64>,
}

impl Options {
    /// The defaults: no budget, the given joints of the chain, the ideal chain within 1e-6.
    pub fn new() -> Self {
        Options::default()
    }

    /// Reports progress to `watch`, which may cancel the derivation or bound its time, terms and memory.
    #[must_use]
    pub fn watch(mut self, watch: Watch) -> Self {
        self.watch = watch;
        self
    }

    /// Sets the joints whose values are given with each target, by name. They replace those of the chain.
    #[must_use]
    pub fn given<Name: Into<String>>(mut self, joints: impl IntoIterator<Item = Name>) -> Self {
        self.given = Some(joints.into_iter().map(Into::into).collect());
        self
    }

    /// Sets the tolerance of the search for the nearest ideal chain: in radians, and as a fraction of the reach. The default is 1e-6.
    #[must_use]
    pub fn tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = Some(tolerance);
        self
    }

    /// Derives the solver of the chain exactly as described, with every digit.
    #[must_use]
    pub fn exact(self) -> Self {
        self.tolerance(0.0)
    }

    /// Derives and proves the solver of `chain`. For a chain without given joints and with one joint more than its task determines, it has one solver for each
    /// joint as the given one ([`Derivation::redundant`]).
    ///
    /// # Errors
    /// As [`Derivation::of_problem`] and [`joints_to_give`]; as [`Chain::with_task`] for given joints; as [`Chain::ideal_within`] for the tolerance.
    pub fn derive(&self, chain: &Chain) -> Result<Derivation> {
        if let Some(given) = &self.given {
            let chain = chain.with_task(chain.task(), chain.direction().clone(), given.clone())?;
            return Options { given: None, ..self.clone() }.derive(&chain);
        }
        let ideal = chain.ideal_within(self.tolerance.unwrap_or(TOLERANCE))?;
        if chain.given().is_empty()
            && is_redundant(chain)
            && let Some(choice) = joints_to_give(&ideal.0, &self.watch)?
        {
            let [ideal_chain, chain] = [&ideal.0, chain]
                .map(|chain| chain.with_task(chain.task(), chain.direction().clone(), choice.given.clone()));
            return Derivation::redundant(ChainProblem::ideal((ideal_chain?, ideal.1), &chain?), &self.watch);
        }
        Derivation::of_problem(ChainProblem::ideal(ideal, chain), &self.watch)
    }
}
