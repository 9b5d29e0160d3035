//! Why a target of several limbs has no solution: [`Explanation`].

use std::fmt;

use super::derived::DerivedLimbs;
use crate::Result;
use crate::solver::Nearest;

/// The limb at which a target fails.
#[derive(Clone, Debug, PartialEq)]
pub struct Explanation {
    /// Its name.
    pub limb: String,
    /// In how many ways the limbs before it reach their targets.
    pub before: usize,
    /// What comes nearest among the limb's own joints, with the shared joints near where one of these ways has them; none when its
    /// equations have no real candidate at all, far out of reach.
    pub nearest: Option<Nearest>,
}

impl DerivedLimbs {
    /// The first limb that does not reach its part of `target` together with those before it; none when there is a solution.
    ///
    /// # Errors
    /// As [`crate::solver::Program::solve`].
    pub fn explain(&self, target: &[f64]) -> Result<Option<Explanation>> {
        if !self.program.solve(target)?.is_empty() {
            return Ok(None);
        }
        let mut before = vec![Vec::new()];
        for stage in &self.stages {
            let answers = stage.program.solve(&target[..stage.program.inputs.len()])?;
            if answers.is_empty() {
                let nearest = before.iter().map(|q| stage.derived.program.nearest(&stage.target(target, q)));
                let nearest: Vec<Option<Nearest>> = nearest.collect::<Result<_>>()?;
                let nearest = nearest.into_iter().flatten().min_by(|a, b| a.relative.total_cmp(&b.relative));
                let ways = if stage == &self.stages[0] { 0 } else { before.len() };
                let limb = self.limbs.limbs()[stage.limb].name.clone();
                return Ok(Some(Explanation { limb, before: ways, nearest }));
            }
            before = answers.into_iter().map(|answer| answer.q).collect();
        }
        Ok(None)
    }
}

impl fmt::Display for Explanation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "the equations of limb `{}` fail", self.limb)?;
        match self.before {
            0 => {}
            ways => write!(f, " in each of the {ways} ways in which the limbs before it reach their targets")?,
        }
        match &self.nearest {
            Some(nearest) => write!(f, "; the nearest joints found leave a residual of {:.1e}", nearest.residual),
            None => f.write_str("; no real joints come near"),
        }
    }
}
