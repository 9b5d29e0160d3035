//! Programs that accept targets which their joints reach only nearly: [`Program::tolerant`].

use super::program::{Checks, Described, Program};

impl Program {
    /// The program for targets whose numbers are rounded by up to `within`, a share of the size of each equation. Where the task asks for more than the joints
    /// can do, a rounded target has no exact answer: the answers are then those of the nearest target that the mechanism reaches. None where
    /// the equations do not allow that.
    pub(crate) fn tolerant(&self, within: f64) -> Option<Program> {
        if self.isolated.is_some() || self.nearby {
            return Some(self.clone());
        }
        let described = self.described.clone().or_else(|| self.as_described())?;
        let described = Described { within: described.within.max(within), ..described };
        Some(Program { described: Some(described), ..self.clone() })
    }

    /// The mechanism of the program itself as one that is described.
    fn as_described(&self) -> Option<Described> {
        let Checks { code, residuals, .. } =
            Checks { scales: Vec::new(), jacobian: Vec::new(), short: Vec::new(), ..self.checks.clone() }.pruned();
        let described = Described { code, residuals, within: 0.0 };
        let is_compared = self.forward().is_some_and(|forward| !forward.inputs.is_empty());
        (is_compared && described.is_affine(self)).then_some(described)
    }
}
