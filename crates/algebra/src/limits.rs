//! The limits of all readers and options, in one table: what is larger is refused before work is spent on it.
//!
//! | of | limit |
//! | --- | --- |
//! | a description in TOML, a task file | [`DESCRIPTION_BYTES`] |
//! | a URDF or other XML | [`XML_BYTES`], [`XML_DEPTH`] levels, [`XML_ATTRIBUTES`] attributes and [`XML_TEXT`] bytes of text an element |
//! | a robot | [`FOLLOWERS`] joints that follow in turn |
//! | a mesh | [`MESH_BYTES`] |
//! | a map | [`MAP_BYTES`] of YAML, [`YAML_DEPTH`] levels; [`IMAGE_BYTES`] of image, [`IMAGE_MEMORY`] in memory, [`MAP_CELLS`], [`CELL_METRES`] |
//! | a scene in VRML | [`VRML_DEPTH`] levels |
//! | a program, a certificate or stage, a system of polynomials | [`PROGRAM_BYTES`], [`STAGE_BYTES`], [`SYSTEM_BYTES`] |
//! | a trajectory, a table of states, footsteps | [`TABLE_BYTES`], [`STATES_BYTES`], [`FOOTSTEPS_BYTES`] |
//! | columns of a table, tracks of a trajectory | [`COLUMNS`] |
//! | a line of a table on standard input, and its rows | [`LINE_BYTES`], [`ROWS`] |
//! | poses to follow, and states at a pose | [`POSES`], [`POSE_STATES`] |
//! | samples of a trajectory, steps of a control law | [`SAMPLES`], [`CONTROL_STEPS`] |
//! | footsteps, their coordinates, samples of a walk and of a phase | [`FOOTSTEPS`], [`FOOTPRINT_METRES`], [`WALK_SAMPLES`], [`PHASE_SAMPLES`] |
//! | places of a grid, orientations at a place, both multiplied | [`GRID_PLACES`], [`ORIENTATIONS`], [`REACH_TARGETS`] |
//! | entries of the regressor of a log to identify, and its numbers | [`LOG_ENTRIES`], [`LOG_LARGEST`] |
//! | a budget of time | [`BUDGET_SECONDS`] |
//! | a name, a description of some lines, the symbol of a joint | [`NAME_CHARACTERS`], [`TEXT_CHARACTERS`], [`SYMBOL_CHARACTERS`] |
//! | a number of a description | [`DIGITS`] digits, [`EXPONENT`] as exponent |
//! | a number of a table, a target or an option | [`LARGEST`] |
//! | an expression | [`EXPRESSION_CHARACTERS`], [`EXPRESSION_DEPTH`], [`EXPRESSION_EXPONENT`] |
//! | the expansion of a polynomial | [`EXPANSION_TERMS`], [`EXPANSION_BITS`], [`EXPANSION_DEGREE`], [`EXPANSION_PARAMETER_DEGREE`], [`EXPANSION_DENOMINATOR_DEGREE`] |
//! | a system of polynomials | [`SYSTEM_NAMES`] names, [`POLYNOMIAL_WORDS`] words a polynomial, [`SYSTEM_ROOTS`] square roots |
//! | a constant of a derivation, an equation with its constants | [`CONSTANT_BITS`], [`CONSTANT_PARTS`]; [`EQUATION_PARTS`] |
//! | joints of a chain with those that are fixed and without, of a solver; coordinates of an axis | [`PATH_JOINTS`], [`CHAIN_JOINTS`], [`SOLVER_JOINTS`]; [`COORDINATE`] |
//! | a solver's program | [`PROGRAM_ANSWERS`], [`PROGRAM_BLOCKS`], [`PROGRAM_UNKNOWNS`] |
//! | bodies of a robot whose equations of motion are printed | [`PRINTED_BODIES`] |
//! | equations of motion as polynomials | [`SYMBOLIC_JOINTS`], [`SYMBOLIC_TERMS`] |

use crate::escape::{is_hidden, shown};
use crate::{Error, ErrorKind, Result};

/// Bytes of a description in TOML or a task file.
pub const DESCRIPTION_BYTES: u64 = 1_000_000;
/// Bytes of a URDF.
pub const XML_BYTES: u64 = 4_000_000;
/// Levels of elements in XML.
pub const XML_DEPTH: usize = 100;
/// Attributes of an element in XML.
pub const XML_ATTRIBUTES: usize = 200;
/// Bytes of text in an element of XML.
pub const XML_TEXT: usize = 200;
/// Joints of a robot that follow one another in turn.
pub const FOLLOWERS: usize = 100;
/// Bytes of a mesh.
pub const MESH_BYTES: u64 = 100_000_000;
/// Bytes of an image.
pub const IMAGE_BYTES: u64 = 1 << 30;
/// Bytes that an image takes in memory.
pub const IMAGE_MEMORY: usize = 1 << 30;
/// Bytes of the description of a map in YAML.
pub const MAP_BYTES: u64 = 100_000;
/// Cells of a map.
pub const MAP_CELLS: usize = 1 << 28;
/// The least and the greatest side of a cell \[m\].
pub const CELL_METRES: [f64; 2] = [1e-6, 1e6];
/// Levels of YAML.
pub const YAML_DEPTH: usize = 20;
/// Levels of nodes in VRML.
pub const VRML_DEPTH: usize = 64;
/// Bytes of a solver's program, and of equations of motion.
pub const PROGRAM_BYTES: u64 = 64_000_000;
/// Bytes of a certificate or a stage file.
pub const STAGE_BYTES: u64 = 256_000_000;
/// Bytes of a system of polynomials.
pub const SYSTEM_BYTES: usize = 16_000_000;
/// Bytes of a trajectory, a map of a reach, a walk or a task.
pub const TABLE_BYTES: u64 = 1_000_000_000;
/// Bytes of a table of states.
pub const STATES_BYTES: u64 = 1 << 30;
/// Bytes of footsteps.
pub const FOOTSTEPS_BYTES: u64 = 4_000_000;
/// Columns of a table, and tracks of a trajectory: names are compared in pairs.
pub const COLUMNS: usize = 10_000;
/// Bytes of a line of a table that is read row by row.
pub const LINE_BYTES: usize = 1_000_000;
/// Rows of such a table that is kept.
pub const ROWS: usize = 10_000_000;

/// Poses that are followed: the graph of their solutions is kept.
pub const POSES: usize = 200_000;
/// Combinations of the values of a solution that differ by whole turns, at a pose to follow; those furthest from zero are left out.
pub const POSE_STATES: usize = 4096;
/// Samples of a trajectory.
pub const SAMPLES: usize = 10_000_000;
/// Footsteps of a walk.
pub const FOOTSTEPS: usize = 10_000;
/// The farthest coordinate of a footstep \[m\].
pub const FOOTPRINT_METRES: f64 = 1e4;
/// Samples of a walk: half an hour at 100 Hz.
pub const WALK_SAMPLES: usize = 180_000;
/// Samples of a phase of a step.
pub const PHASE_SAMPLES: usize = 1 << 30;
/// Places of a grid of reach: what is counted at each takes up to 28 bytes.
pub const GRID_PLACES: usize = 100_000_000;
/// Orientations at each of these places.
pub const ORIENTATIONS: usize = 1_000_000;
/// Targets of a map of reach, places times orientations: hours of work.
pub const REACH_TARGETS: usize = 4_000_000_000;
/// Steps for which a control law holds its torques.
pub const CONTROL_STEPS: usize = 1_000_000;
/// Entries of the regressor of a log: rows times joints times ten parameters a joint.
pub const LOG_ENTRIES: usize = 100_000_000;
/// The greatest number of a log: squares of such numbers, and their sums, are far within doubles.
pub const LOG_LARGEST: f64 = 1e12;
/// Seconds of a budget: about thirty years.
pub const BUDGET_SECONDS: f64 = 1e9;

/// Characters of a name.
pub const NAME_CHARACTERS: usize = 200;
/// Characters of a text of some lines.
pub const TEXT_CHARACTERS: usize = 2000;
/// Characters of the symbol of a joint in equations.
pub const SYMBOL_CHARACTERS: usize = 16;
/// Digits of a number in a description.
pub const DIGITS: usize = 4096;
/// The greatest power of ten of such a number, and the least one's opposite.
pub const EXPONENT: i64 = 4096;
/// The greatest number of a table, a target or an option, in any unit: its square and its cube are far from the end of doubles.
pub const LARGEST: f64 = 1e15;

/// Characters of an expression.
pub const EXPRESSION_CHARACTERS: usize = 400_000;
/// Levels of parentheses in an expression.
pub const EXPRESSION_DEPTH: usize = 200;
/// The greatest exponent in an expression.
pub const EXPRESSION_EXPONENT: u32 = 1000;
/// Terms that the expansion of a polynomial may take.
pub const EXPANSION_TERMS: f64 = 1e6;
/// Bits of a coefficient in it.
pub const EXPANSION_BITS: f64 = 1e6;
/// Its degree.
pub const EXPANSION_DEGREE: u64 = 30_000;
/// The degree of a summand in the parameters, numerator and denominator together.
pub const EXPANSION_PARAMETER_DEGREE: u64 = 100;
/// The sum of the degrees of all denominators of a polynomial.
pub const EXPANSION_DENOMINATOR_DEGREE: u64 = 1000;
/// Variables and parameters of a system of polynomials.
pub const SYSTEM_NAMES: usize = 1000;
/// Words of a polynomial: numbers, names and signs.
pub const POLYNOMIAL_WORDS: usize = 1_000_000;
/// Square roots of rational numbers in a system.
pub const SYSTEM_ROOTS: usize = 8;
/// Bits of a rational constant of a derivation, and of the square of a root.
pub const CONSTANT_BITS: u64 = 10_000;
/// Parts of a constant with square roots.
pub const CONSTANT_PARTS: usize = 1_000;
/// Parts of an equation after its constants are put in.
pub const EQUATION_PARTS: usize = 400_000;

/// Joints of a path of a robot, with those that are fixed.
pub const PATH_JOINTS: usize = 64;
/// The greatest coordinate of an axis of a chain, in its unit: doubles hold every sum of such numbers.
pub const COORDINATE: u64 = 1_000_000_000_000;
/// Joints of a chain.
pub const CHAIN_JOINTS: usize = 12;
/// Joints of a solver.
pub const SOLVER_JOINTS: usize = 16;
/// Answers of a solver's program for a target.
pub const PROGRAM_ANSWERS: usize = 4096;
/// Blocks of it.
pub const PROGRAM_BLOCKS: usize = 64;
/// Unknowns of it.
pub const PROGRAM_UNKNOWNS: usize = 1024;
/// Bodies of a robot whose equations of motion are printed as code.
pub const PRINTED_BODIES: usize = 500;
/// Joints of a chain whose equations of motion are polynomials.
pub const SYMBOLIC_JOINTS: usize = 7;
/// Terms of M, C and N of these equations together.
pub const SYMBOLIC_TERMS: usize = 100_000;

/// The stems of the files of the run time in C: no printed solver is called so.
pub const RUN_TIME_FILES: [&str; 3] = ["groebot", "groebot_six_axes", "groebot_dynamics"];

/// Whether `name` can be a name in any input: 1 to [`NAME_CHARACTERS`] characters, not all of them blanks, none of which acts on the text around it.
pub fn is_name(name: &str) -> bool {
    !name.trim().is_empty() && name.chars().count() <= NAME_CHARACTERS && !name.chars().any(is_hidden)
}

/// Fails for what [`is_name`] refuses; `what` says whose name it is.
///
/// # Errors
/// [`ErrorKind::BadValue`] with the name.
pub fn check_name(what: &str, name: &str) -> Result<()> {
    if is_name(name) {
        return Ok(());
    }
    let text = format!(
        "the {what}'s name is `{}`; give 1 to {NAME_CHARACTERS} visible characters, none of which changes the direction of writing",
        shown(name)
    );
    Err(Error::new(ErrorKind::BadValue, text))
}

/// The number of a cell of a table or of an option.
///
/// # Errors
/// What is wrong, in words: no number, not finite, or beyond [`LARGEST`].
pub fn number(cell: &str) -> std::result::Result<f64, String> {
    match cell.trim().parse::<f64>() {
        Ok(number) if number.abs() <= LARGEST => Ok(number),
        Ok(number) if number.is_nan() => Err(format!("`{}` is not a number", shown(cell))),
        Ok(_) => Err(format!("`{}` is too large; give at most {LARGEST:e}", shown(cell))),
        Err(_) => Err(format!("`{}` is no number", shown(cell))),
    }
}

/// Fails for more than `most` of something.
///
/// # Errors
/// [`ErrorKind::BadValue`] with both numbers.
pub fn check_count(what: &str, count: usize, most: usize) -> Result<()> {
    if count <= most {
        return Ok(());
    }
    Err(Error::new(ErrorKind::BadValue, format!("{count} {what} are too many; give at most {most}")))
}
