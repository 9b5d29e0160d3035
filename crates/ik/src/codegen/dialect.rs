//! The statements of a printed file that differ between the languages ([`Dialect`]).

use super::language::Expressions;
use crate::solver::eigenvalue::SixAxes;

/// The statements that differ between the languages. Roots, loops and results have numbers, which are appended to their
/// names.
pub(super) trait Dialect: Expressions {
    /// Finds the roots of `x^2 + constant`; `typical` is the unknown's typical size. With `grazing` the constant is
    /// computed from less exact values.
    fn find_square_roots(&self, number: usize, constant: &str, typical: &str, grazing: bool) -> String;
    /// Finds the roots of the first polynomial whose leading coefficient is not negligible, each a list of
    /// coefficients, of a degree of at most `degree`. A polynomial in a half angle has its spread as typical size.
    fn find_roots(
        &self,
        number: usize,
        degree: usize,
        polynomials: &[Vec<String>],
        typical: &str,
        half_angle: bool,
    ) -> Vec<String>;
    /// The loop over roots, and over their values if they have a name; over the first only if it represents a pair.
    fn open_roots(&self, number: usize, name: Option<&str>, is_pair: bool) -> Vec<String>;
    /// The loop over the `rows` rows of a table of samples.
    fn open_samples(&self, number: usize, names: &[Option<&str>], table: usize, rows: usize) -> Vec<String>;
    /// The loop over the solutions of a six-axes chain at a target, which is followed by the values of `given` joints between the six.
    fn open_six_axes(&self, number: usize, chain: usize, target: &[String], given: usize) -> Vec<String>;
    /// The tables of a chain, as a constant.
    fn chain(&self, six: &SixAxes) -> String;
    /// The given joints between the six of a chain, as a constant.
    fn given_axes(&self, six: &SixAxes) -> String;
    /// The value of a joint in that loop, typed.
    fn six_axes_joint(&self, number: usize, joint: usize) -> String;
    /// The condition that all guards hold.
    fn guard(&self, guards: &[GuardText]) -> String;
    /// The head of the block in which a case applies.
    fn open_case(&self, applies: &Applies) -> String;
    /// Reports a stratum for which no derivation exists.
    fn is_open(&self, number: usize, condition: &str) -> String;
    /// Computes a case's claim in its pivot group: the magnitude of its pivot.
    fn claim(&self, number: usize, lines: Vec<String>, pivot: &str, condition: Option<&str>) -> Vec<String>;
    /// Runs the case with the greatest of these claims: one body per claim.
    fn elect(&self, claims: &[usize], bodies: Vec<Vec<String>>) -> Vec<String>;
    /// Lines that declare `magnitude`, the greatest of a positive number and the magnitudes of names.
    fn magnitude(&self, least: f64, names: &[String]) -> Vec<String>;
    /// A row of a table.
    fn row(&self, numbers: &[f64]) -> String;
    /// The number of candidates so far.
    fn count(&self, number: usize) -> String;
    /// Declares the record of the choices so far, under a number, combined with an earlier one.
    fn found(&self, before: usize, number: usize, how: &[How]) -> String;
    /// Calls the function of a block, with the record of the choices so far and the known values.
    fn go_on(&self, block: usize, found: usize, is_rare: bool, known: &[String]) -> Vec<String>;
    /// Reports a candidate with the record of its choices.
    fn finish(&self, found: usize, at: &[String]) -> Vec<String>;
    /// Whether the names of one case must not be visible in another.
    fn needs_scopes(&self) -> bool {
        false
    }
    /// A comment.
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

/// The condition under which a case applies.
pub(super) enum Applies {
    /// The case applies at almost all targets.
    Usually(String),
    /// The case applies only at singular targets.
    Rarely(String),
    /// The case applies near a stratum. Elsewhere it applies if the candidates since the count with this number lost a solution.
    Near { count: usize, guard: String },
}

/// A part of the record of a choice.
pub(super) enum How {
    /// A choice of the first block's case whose branch numbers end at `last`.
    First { branch: String, last: usize },
    /// A choice of a later block.
    Next { radix: usize, branch: String },
    /// One of these roots.
    Root(usize),
    /// Both roots of a pair.
    Pair(usize),
    /// Free joints: bit `j` for joint `j`.
    Free(u32),
    /// A solution for six axes, whose joints have these indices.
    SixAxes { number: usize, joints: Vec<Option<usize>> },
}
