//! The solvers of a redundant arm with each joint given, which are printed in one file: [`Parts`].

use serde::Serialize;

use super::samples::Table;
use super::six_axes;
use crate::solver::eigenvalue::SixAxes;
use crate::solver::redundant::arm;
use crate::solver::{Program, RedundantPart};
use groebot_runtime::redundant::{Arm, Given, MOST_JOINTS};

/// The programs of one file, with the constants that they share.
pub(super) struct Parts<'a> {
    pub main: &'a Program,
    /// The programs of a redundant arm in addition to the main one, each with the number of its given joint, from 1.
    pub others: Vec<(usize, &'a Program)>,
    /// The tables of sample values of free joints, without duplicates.
    pub tables: Vec<Table>,
    /// The steps that solve six joints together.
    pub six_axes: Vec<&'a SixAxes>,
}

impl<'a> Parts<'a> {
    /// The programs of a redundancy's parts, and the program itself.
    pub fn new(main: &'a Program) -> Self {
        let parts = main.curves().into_iter().flat_map(|redundancy| redundancy.parts.iter().enumerate());
        let other = |(joint, part): (usize, &'a RedundantPart)| match part {
            RedundantPart::Program(program) => Some((joint + 1, program.as_ref())),
            _ => None,
        };
        let others: Vec<(usize, &Program)> = parts.filter_map(other).collect();
        let all = || std::iter::once(main).chain(others.iter().map(|(_, program)| *program));
        let (tables, six_axes) = (Table::all(all()), all().flat_map(six_axes::steps).collect());
        Parts { main, others, tables, six_axes }
    }
}

/// The values of a redundant arm for the skeleton.
#[derive(Serialize)]
pub(super) struct RedundantText {
    /// The number of the given joint of the main program, from 1.
    given: usize,
    /// By joint of the run time's arm, its number if it has a solver, else 0.
    solved: Vec<usize>,
    /// The data of the arm.
    arm: String,
    parts: Vec<PartText>,
}

/// The printed program with another joint given.
#[derive(Serialize)]
pub(super) struct PartText {
    /// The number of the joint, from 1.
    pub number: usize,
    /// In C: its facts.
    pub facts: String,
    /// Its code.
    pub program: String,
}

impl RedundantText {
    /// The values of the main program's redundancy, if it has one. `data` prints the arm, and `part` a program.
    pub fn new(
        parts: &Parts<'_>,
        data: fn(&Arm) -> String,
        part: impl Fn(usize, &Program) -> PartText,
    ) -> Option<Self> {
        let redundancy = parts.main.curves()?;
        let arm = arm(parts.main, redundancy);
        let solved = |joint: usize| if arm.given[joint] == Given::Solved { joint + 1 } else { 0 };
        Some(RedundantText {
            given: arm.scanned + 1,
            solved: (0..MOST_JOINTS).map(solved).collect(),
            arm: data(&arm),
            parts: parts.others.iter().map(|(number, program)| part(*number, program)).collect(),
        })
    }
}
