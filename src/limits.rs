//! The limits of all readers and options, in one table: what is larger is refused before work is spent on it.
//!
//! | of | limit |
//! | --- | --- |
//! | a description in TOML, a task file | [`DESCRIPTION_BYTES`] |
//! | a URDF, MJCF or other XML | [`XML_BYTES`], [`XML_DEPTH`] levels, [`XML_ATTRIBUTES`] attributes an element |
//! | a mesh, an image of a map | [`MESH_BYTES`], [`IMAGE_BYTES`] |
//! | a program, a certificate or stage, a system of polynomials | [`PROGRAM_BYTES`], [`STAGE_BYTES`], [`SYSTEM_BYTES`] |
//! | a trajectory, a table of states, footsteps | [`TABLE_BYTES`], [`STATES_BYTES`], [`FOOTSTEPS_BYTES`] |
//! | columns of a table, tracks of a trajectory | [`COLUMNS`] |
//! | a line of a table on standard input, and its rows | [`LINE_BYTES`], [`ROWS`] |
//! | poses to follow, samples of a trajectory, footsteps, steps of a control law | [`POSES`], [`SAMPLES`], [`FOOTSTEPS`], [`CONTROL_STEPS`] |
//! | entries of the regressor of a log to identify | [`LOG_ENTRIES`] |
//! | a name, a description of some lines | [`NAME_CHARACTERS`], [`TEXT_CHARACTERS`] |
//! | a number of a description | [`DIGITS`] digits, [`EXPONENT`] as exponent |
//! | a number of a table, a target or an option | [`LARGEST`] |
//! | an expression | [`EXPRESSION_CHARACTERS`], [`EXPRESSION_DEPTH`], [`EXPRESSION_EXPONENT`] |
//! | the expansion of a polynomial | [`EXPANSION_TERMS`], [`EXPANSION_BITS`], [`EXPANSION_DEGREE`] |
//! | joints of a chain, of a solver | [`CHAIN_JOINTS`], [`SOLVER_JOINTS`] |
//! | bodies of a robot whose equations of motion are printed | [`PRINTED_BODIES`] |

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
/// Bytes of a mesh.
pub const MESH_BYTES: u64 = 100_000_000;
/// Bytes of an image.
pub const IMAGE_BYTES: u64 = 1 << 30;
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
/// Samples of a trajectory.
pub const SAMPLES: usize = 10_000_000;
/// Footsteps of a walk.
pub const FOOTSTEPS: usize = 10_000;
/// Steps for which a control law holds its torques.
pub const CONTROL_STEPS: usize = 1_000_000;
/// Entries of the regressor of a log: rows times joints times ten parameters a joint.
pub const LOG_ENTRIES: usize = 100_000_000;

/// Characters of a name.
pub const NAME_CHARACTERS: usize = 200;
/// Characters of a text of some lines.
pub const TEXT_CHARACTERS: usize = 2000;
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

/// Joints of a chain.
pub const CHAIN_JOINTS: usize = 12;
/// Joints of a solver.
pub const SOLVER_JOINTS: usize = 16;
/// Bodies of a robot whose equations of motion are printed as code.
pub const PRINTED_BODIES: usize = 500;

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
