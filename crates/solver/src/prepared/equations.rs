//! The equations of a program as prepared code. Main type: [`Equations`].

use groebot_runtime::storage::Array;
use groebot_runtime::{Number, With};

use super::code::{Assembler, Code, Line, Memory};
use crate::{Demand, Instruction, Layout, Operand};

/// Values that code computes from parameters and from the joints' numbers that the equations read.
#[derive(Clone, Debug, Default)]
pub(super) struct Equations {
    memory: Memory,
    code: Code,
    results: Vec<u32>,
}

impl Equations {
    /// The equations of the checks' code with these results.
    pub fn new<'a>(layout: &Layout<'_>, results: impl IntoIterator<Item = &'a Operand> + Clone) -> Self {
        Equations::of_code(layout, &layout.program.checks.code, results)
    }

    /// The equations of this code.
    pub fn of_code<'a>(
        layout: &Layout<'_>,
        code: &[Instruction],
        results: impl IntoIterator<Item = &'a Operand> + Clone,
    ) -> Self {
        let program = layout.program;
        let places = layout.places();
        let place_of = |unknown| places.iter().position(|&other| other == unknown).unwrap_or(0);
        let place_of = (0..program.unknowns.len()).map(place_of).collect();
        let mut assembler = Assembler::new(program.parameters.len(), place_of);
        let demand = Demand::of_code(code, results.clone());
        let code = assembler.code(code, &demand);
        let results = results.into_iter().map(|&result| assembler.place(result)).collect();
        Equations { memory: assembler.memory(), code, results }
    }

    /// Runs the code and passes the results to `make`.
    #[inline]
    pub fn with<N: Number, R>(&self, parameters: &[N], at: &[N], make: impl FnOnce(Results<'_, N>) -> R) -> R
    where
        f64: With<N>,
    {
        self.memory.with(parameters, at, |memory| {
            self.code.run(memory);
            make(Results { memory, places: &self.results })
        })
    }

    /// All results as a row.
    #[inline]
    pub fn row<N: Number, A: Array<N>>(&self, parameters: &[N], at: &[N]) -> A
    where
        f64: With<N>,
    {
        self.with(parameters, at, |results| A::by(self.results.len(), |index| results.at(index)))
    }
}

/// The results of code in memory.
pub(super) struct Results<'a, N> {
    memory: &'a [Line<N>],
    places: &'a [u32],
}

impl<N: Number> Results<'_, N> {
    /// The result with this index.
    #[inline(always)]
    pub fn at(&self, index: usize) -> N {
        self.memory[self.places[index] as usize].0
    }
}
