//! Tables of sample values of free joints. Cases with equal values share one.

use crate::solver::{JointValue, Program, Step};

/// A table of numbers by rows.
#[derive(Clone, PartialEq)]
pub(super) struct Table {
    rows: Vec<Vec<f64>>,
}

impl Table {
    /// The cosines and sines of an angle's values, or the values of a length.
    pub fn new(joint: JointValue, values: &[f64]) -> Self {
        let row = |value: &f64| match joint {
            JointValue::Angle { .. } => vec![value.cos(), value.sin()],
            JointValue::Plain(_) => vec![*value],
        };
        Table { rows: values.iter().map(row).collect() }
    }

    /// The tables of programs without duplicates.
    pub fn all<'a>(programs: impl Iterator<Item = &'a Program>) -> Vec<Self> {
        let mut tables = Vec::new();
        for step in programs.flat_map(Program::cases).flat_map(|case| &case.steps) {
            if let Step::Sample { joint, values } = step {
                let table = Table::new(*joint, values);
                if !tables.contains(&table) {
                    tables.push(table);
                }
            }
        }
        tables
    }

    /// The numbers by rows.
    pub fn rows(&self) -> &[Vec<f64>] {
        &self.rows
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.rows.len()
    }
}
