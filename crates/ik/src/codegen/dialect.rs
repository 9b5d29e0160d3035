//! What differs between the languages in the statements of a thin file ([`Dialect`]).

use super::language::Expressions;
use crate::solver::eigenvalue::SixAxes;

/// What differs between the languages in statements. Roots, loops and what is found have numbers, which stand behind their names.
pub(super) trait Dialect: Expressions {
    /// Roots of `x^2 + constant`; `typical` is the unknown's typical size, and they are `grazing` where what the constant follows from is less exact.
    fn find_square_roots(&self, number: usize, constant: &str, typical: &str, grazing: bool) -> String;
    /// The roots of the first polynomial that leads, each a list of coefficients, of a degree of at most `degree`; of a half angle's
    /// polynomial with its spread as typical size.
    fn find_roots(
        &self,
        number: usize,
        degree: usize,
        polynomials: &[Vec<String>],
        typical: &str,
        half_angle: bool,
    ) -> Vec<String>;
    /// The loop over roots, and over their values if they have a name; over the first alone where it stands for a pair.
    fn open_roots(&self, number: usize, name: Option<&str>, is_pair: bool) -> Vec<String>;
    /// The loop over the rows of the table of samples with a number, of which there are `rows`.
    fn open_samples(&self, number: usize, names: &[Option<&str>], table: usize, rows: usize) -> Vec<String>;
    /// The loop over the answers of the chain with a number at a target.
    fn open_six_axes(&self, number: usize, chain: usize, target: &[String]) -> Vec<String>;
    /// The tables of a chain, a constant.
    fn chain(&self, six: &SixAxes) -> String;
    /// The value of a joint in that loop; typed.
    fn six_axes_joint(&self, number: usize, joint: usize) -> String;
    /// Where all of these hold.
    fn guard(&self, guards: &[GuardText]) -> String;
    /// What is done where a case applies.
    fn open_case(&self, applies: &Applies) -> String;
    /// A stratum that could not be derived.
    fn is_open(&self, number: usize, condition: &str) -> String;
    /// A case's claim to be the best conditioned of its group.
    fn claim(&self, number: usize, lines: Vec<String>, pivot: &str, condition: Option<&str>) -> Vec<String>;
    /// What is done with the case elected by these claims: as many bodies.
    fn elect(&self, claims: &[usize], bodies: Vec<Vec<String>>) -> Vec<String>;
    /// Lines that declare `magnitude`, the greatest among a positive number and the magnitudes of names.
    fn magnitude(&self, least: f64, names: &[String]) -> Vec<String>;
    /// A row of a table.
    fn row(&self, numbers: &[f64]) -> String;
    /// How many candidates there have been.
    fn count(&self, number: usize) -> String;
    /// How a choice has been found, under a number, after what has one already.
    fn found(&self, before: usize, number: usize, how: &[How]) -> String;
    /// Going on to a block that stands for itself, with how its choices so far have been found and what is known.
    fn go_on(&self, block: usize, found: usize, is_rare: bool, known: &[String]) -> Vec<String>;
    /// Handing over a candidate that has been found so.
    fn finish(&self, found: usize, at: &[String]) -> Vec<String>;
    /// Whether the names of one case must not stand in another.
    fn needs_scopes(&self) -> bool {
        false
    }
    /// A remark.
    fn comment(&self, text: &str) -> String {
        format!("// {text}")
    }
}

/// A guard's value and scale, as typed expressions.
pub(super) struct GuardText {
    pub value: String,
    pub scale: String,
    pub near: bool,
}

/// When a case applies.
pub(super) enum Applies {
    /// At hardly any target it does not.
    Usually(String),
    /// At hardly any target it does.
    Rarely(String),
    /// Near a stratum, or beside it where the candidates since a count with this number have sufficed.
    Near { count: usize, guard: String },
}

/// A part of how something has been found.
pub(super) enum How {
    /// By a choice of the first block's case whose numbers end at `last`.
    First { branch: String, last: usize },
    /// By a choice of a later block.
    Next { radix: usize, branch: String },
    /// By a root of these roots.
    Root(usize),
    /// By both.
    Pair(usize),
    /// With free joints: bit `j` for joint `j`.
    Free(u32),
    /// By an answer of six axes, whose joints have these indices.
    SixAxes { number: usize, joints: Vec<Option<usize>> },
}
