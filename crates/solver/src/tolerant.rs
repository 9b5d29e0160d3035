//! Programs for targets that their joints reach only approximately: [`Program::tolerant`].

use super::program::{Checks, Described, Program};

impl Program {
    /// The program for targets whose numbers are rounded by up to `within`, relative to the size of each equation.
    ///
    /// If the task has more numbers than the joints can reach, a rounded target has no exact solution. The solutions are then those of the nearest target that
    /// the mechanism reaches. `None` if the equations do not permit that.
    #[doc(hidden)]
    pub fn tolerant(&self, within: f64) -> Option<Program> {
        if self.isolated.is_some() || self.nearby {
            return Some(self.clone());
        }
        let described = self.described.clone().or_else(|| self.as_described())?;
        let described = Described { within: described.within.max(within), ..described };
        Some(Program { described: Some(described), ..self.clone() })
    }

    /// The mechanism of the program itself as a described one.
    fn as_described(&self) -> Option<Described> {
        let Checks { code, residuals, .. } =
            Checks { scales: Vec::new(), jacobian: Vec::new(), short: Vec::new(), ..self.checks.clone() }.pruned();
        let described = Described { code, residuals, within: 0.0 };
        let is_compared = self.forward().is_some_and(|forward| !forward.inputs.is_empty());
        (is_compared && described.is_affine(self)).then_some(described)
    }
}
