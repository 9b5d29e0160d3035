//! Why a target of several limbs has no solution: [`Explanation`].

use std::fmt;

use super::derived::{DerivedLimbs, LimbStage};
use crate::derive::lift::Derived;
use crate::solver::{Nearest, Solution, Unit};
use crate::spatial::angle;
use crate::{Result, Watch};

/// The limb at which a target fails.
#[derive(Clone, Debug, PartialEq)]
pub struct Explanation {
    /// Its name.
    pub limb: String,
    /// In how many ways the limbs before it reach their targets.
    pub before: usize,
    /// By how much the motors that it shares would have to differ, where it reaches its target alone.
    pub disagreement: Option<Disagreement>,
    /// What comes nearest among the limb's own joints, with the shared joints near where one of these ways has them; none when its
    /// equations have no real candidate at all, far out of reach.
    pub nearest: Option<Nearest>,
}

/// A shared motor that two limbs need at different values, of all their ways to reach their targets the two that differ least.
#[derive(Clone, Debug, PartialEq)]
pub struct Disagreement {
    /// The motor's name.
    pub motor: String,
    /// The unit of its values.
    pub unit: Unit,
    /// Where the limb needs it, to reach its target.
    pub needed: f64,
    /// Where the limbs before have it.
    pub found: f64,
}

impl Disagreement {
    /// `needed - found`, of angles the way round that is shorter.
    pub fn off(&self) -> f64 {
        match self.unit {
            Unit::Radian => angle::difference(self.needed, self.found),
            _ => self.needed - self.found,
        }
    }
}

impl DerivedLimbs {
    /// The first limb that does not reach its part of `target` together with those before it; none when there is a solution.
    ///
    /// # Errors
    /// As [`crate::solver::Program::solve`]; what `watch` stops with.
    pub fn explain(&self, target: &[f64], watch: &Watch) -> Result<Option<Explanation>> {
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
                let disagreement = self.disagreement(stage, target, &before, watch)?;
                return Ok(Some(Explanation { limb, before: ways, disagreement, nearest }));
            }
            before = answers.into_iter().map(|answer| answer.q).collect();
        }
        Ok(None)
    }

    /// How far a limb's ways to reach its target alone are from the ways `before` of the limbs before it, by the shared motors; none
    /// when it shares none with them, cannot be solved alone, or does not reach its target.
    fn disagreement(
        &self,
        stage: &LimbStage,
        target: &[f64],
        before: &[Vec<f64>],
        watch: &Watch,
    ) -> Result<Option<Disagreement>> {
        let shared: Vec<usize> = stage.found().collect();
        let chain = &self.limbs.limbs()[stage.limb].chain;
        if shared.is_empty() || chain.joints().len() - chain.given().len() > chain.task().freedoms() {
            return Ok(None);
        }
        let alone = Derived::of_chain(chain, watch)?;
        let answers = alone.program.solve(&stage.own_target(target))?;
        let one = |way: &Vec<f64>, answer: &Solution, motor: usize| Disagreement {
            motor: self.program.joints[motor].name.clone(),
            unit: self.program.joints[motor].unit,
            needed: stage.joints.iter().position(|place| *place == motor).map_or(f64::NAN, |joint| answer.q[joint]),
            found: way[motor],
        };
        let larger = |a: &Disagreement, b: &Disagreement| a.off().abs().total_cmp(&b.off().abs());
        let pairs = before.iter().flat_map(|way| answers.iter().map(move |answer| (way, answer)));
        let worst = pairs.filter_map(|(way, answer)| shared.iter().map(|&motor| one(way, answer, motor)).max_by(larger));
        Ok(worst.min_by(larger))
    }
}

impl fmt::Display for Explanation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(disagreement) = &self.disagreement {
            let Disagreement { motor, unit, needed, found } = disagreement;
            let unit = if *unit == Unit::Radian { "rad" } else { "in its length unit" };
            return write!(
                f,
                "the limbs' targets contradict each other: limb `{}` needs `{motor}` at {needed:.9}, {:.3e} {unit} off the nearest \
                 value {found:.9} at which the limbs before it reach theirs",
                self.limb,
                disagreement.off().abs()
            );
        }
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
