//! Limits of all readers and options, in one table. A larger input is refused before any work is done on it.
//!
//! | of | limit |
//! | --- | --- |
//! | a description in TOML, a task file | [`DESCRIPTION_BYTES`], [`TOML_DEPTH`] levels |
//! | a URDF or other XML | [`XML_BYTES`], [`XML_DEPTH`] levels, [`XML_ATTRIBUTES`] attributes and [`XML_TEXT`] bytes of text an element |
//! | an expansion of xacro | [`XACRO_FILES`] files with [`XACRO_BYTES`], [`XACRO_STEPS`] steps, [`XACRO_DEPTH`] levels, texts and lists of [`XACRO_LENGTH`]; [`XML_BYTES`] of output |
//! | the included files of an MJCF or SDF | [`XML_INCLUDES`], [`XML_INCLUDED_BYTES`], [`XML_ELEMENTS`] elements with them |
//! | a robot | chains of [`FOLLOWERS`] mimic joints |
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
//! | entries of the regressor in parameter identification, and the numbers of its log | [`LOG_ENTRIES`], [`LOG_LARGEST`] |
//! | a time budget | [`BUDGET_SECONDS`] |
//! | a name, a description of some lines, the symbol of a joint | [`NAME_CHARACTERS`], [`TEXT_CHARACTERS`], [`SYMBOL_CHARACTERS`] |
//! | a number of a description | [`DIGITS`] digits, [`EXPONENT`] as exponent |
//! | a number of a table, a target or an option | [`LARGEST`] |
//! | an expression | [`EXPRESSION_CHARACTERS`], [`EXPRESSION_DEPTH`], [`EXPRESSION_EXPONENT`] |
//! | the expansion of a polynomial | [`EXPANSION_TERMS`], [`EXPANSION_BITS`], [`EXPANSION_DEGREE`], [`EXPANSION_PARAMETER_DEGREE`], [`EXPANSION_DENOMINATOR_DEGREE`] |
//! | a system of polynomials | [`SYSTEM_NAMES`] names, [`POLYNOMIAL_WORDS`] words a polynomial, [`SYSTEM_ROOTS`] square roots |
//! | a constant of a derivation, an equation with its constants | [`CONSTANT_BITS`], [`CONSTANT_PARTS`]; [`EQUATION_PARTS`] |
//! | joints of a path including fixed ones, of a chain, of a solver; coordinates of an axis | [`PATH_JOINTS`], [`CHAIN_JOINTS`], [`SOLVER_JOINTS`]; [`COORDINATE`] |
//! | a solver's program | [`PROGRAM_ANSWERS`], [`PROGRAM_BLOCKS`], [`PROGRAM_UNKNOWNS`] |
//! | bodies of a robot whose equations of motion are printed | [`PRINTED_BODIES`] |
//! | equations of motion as polynomials | [`SYMBOLIC_JOINTS`], [`SYMBOLIC_TERMS`] |

use crate::escape::{is_hidden, shown};
use crate::{Error, ErrorKind, Result};

/// Bytes of a TOML description or a task file.
pub const DESCRIPTION_BYTES: u64 = 1_000_000;
/// Nesting depth of TOML: parts of keys with dots, lists and inline tables.
pub const TOML_DEPTH: usize = 80;
/// Bytes of a URDF.
pub const XML_BYTES: u64 = 4_000_000;
/// Nesting depth of XML elements.
pub const XML_DEPTH: usize = 100;
/// Attributes of an XML element.
pub const XML_ATTRIBUTES: usize = 200;
/// Bytes of text in an XML element.
pub const XML_TEXT: usize = 200;
/// Files that an expansion of xacro reads: includes and YAML.
pub const XACRO_FILES: usize = 1000;
/// Bytes of the files that an expansion of xacro reads.
pub const XACRO_BYTES: u64 = 16_000_000;
/// Steps of an expansion of xacro: elements, parts of expressions, and each 16 bytes of texts.
pub const XACRO_STEPS: usize = 5_000_000;
/// Nesting depth of elements, macros, properties and expressions in an expansion of xacro.
pub const XACRO_DEPTH: usize = 500;
/// Characters of a text and entries of a list in an expansion of xacro.
pub const XACRO_LENGTH: usize = 1_000_000;
/// Elements of an MJCF or SDF with its included files.
pub const XML_ELEMENTS: usize = 200_000;
/// Included files of an MJCF or SDF.
pub const XML_INCLUDES: usize = 200;
/// Bytes of all included files of an MJCF or SDF.
pub const XML_INCLUDED_BYTES: u64 = 16_000_000;
/// Length of a chain of mimic joints, each of which follows the next.
pub const FOLLOWERS: usize = 100;
/// Bytes of a mesh.
pub const MESH_BYTES: u64 = 100_000_000;
/// Bytes of an image.
pub const IMAGE_BYTES: u64 = 1 << 30;
/// Bytes of a decoded image in memory.
pub const IMAGE_MEMORY: usize = 1 << 30;
/// Bytes of the YAML description of a map.
pub const MAP_BYTES: u64 = 100_000;
/// Cells of a map.
pub const MAP_CELLS: usize = 1 << 28;
/// The smallest and the largest side of a map cell \[m\].
pub const CELL_METRES: [f64; 2] = [1e-6, 1e6];
/// Nesting depth of YAML.
pub const YAML_DEPTH: usize = 20;
/// Nesting depth of VRML nodes.
pub const VRML_DEPTH: usize = 64;
/// Bytes of a solver's program, or of equations of motion.
pub const PROGRAM_BYTES: u64 = 64_000_000;
/// Bytes of a certificate or a stage file.
pub const STAGE_BYTES: u64 = 256_000_000;
/// Bytes of a polynomial system.
pub const SYSTEM_BYTES: usize = 16_000_000;
/// Bytes of a trajectory, a reachability map, a walk or a task.
pub const TABLE_BYTES: u64 = 1_000_000_000;
/// Bytes of a table of states.
pub const STATES_BYTES: u64 = 1 << 30;
/// Bytes of a footstep file.
pub const FOOTSTEPS_BYTES: u64 = 4_000_000;
/// Columns of a table, and tracks of a trajectory. Names are compared in pairs.
pub const COLUMNS: usize = 10_000;
/// Bytes of a line of a table that is streamed row by row.
pub const LINE_BYTES: usize = 1_000_000;
/// Rows of a streamed table that is held in memory.
pub const ROWS: usize = 10_000_000;

/// Poses of a path to follow. The graph of their solutions is held in memory.
pub const POSES: usize = 200_000;
/// Combinations of whole turns of the solution's joint values, at each pose of a path to follow. Those furthest from
/// zero are left out.
pub const POSE_STATES: usize = 4096;
/// Samples of a trajectory.
pub const SAMPLES: usize = 10_000_000;
/// Footsteps of a walk.
pub const FOOTSTEPS: usize = 10_000;
/// The largest coordinate of a footstep \[m\].
pub const FOOTPRINT_METRES: f64 = 1e4;
/// Samples of a walk: half an hour at 100 Hz.
pub const WALK_SAMPLES: usize = 180_000;
/// Samples of a phase of a footstep.
pub const PHASE_SAMPLES: usize = 1 << 30;
/// Cells of a reachability grid. The counters of each take up to 28 bytes.
pub const GRID_PLACES: usize = 100_000_000;
/// Orientations at each cell of a reachability grid.
pub const ORIENTATIONS: usize = 1_000_000;
/// Targets of a reachability map: cells times orientations. This many take hours.
pub const REACH_TARGETS: usize = 4_000_000_000;
/// Steps of a simulation with constant torques in each step.
pub const CONTROL_STEPS: usize = 1_000_000;
/// Entries of the regressor of a log: rows times joints times ten parameters for each joint.
pub const LOG_ENTRIES: usize = 100_000_000;
/// The largest number in a log. Squares of such numbers, and sums of squares, stay far below the largest `f64`.
pub const LOG_LARGEST: f64 = 1e12;
/// Seconds of a time budget: about thirty years.
pub const BUDGET_SECONDS: f64 = 1e9;

/// Characters of a name.
pub const NAME_CHARACTERS: usize = 200;
/// Characters of a text with several lines.
pub const TEXT_CHARACTERS: usize = 2000;
/// Characters of a joint's symbol in equations.
pub const SYMBOL_CHARACTERS: usize = 16;
/// Digits of a number in a description.
pub const DIGITS: usize = 4096;
/// The largest decimal exponent of a number in a description. The smallest is its negative.
pub const EXPONENT: i64 = 4096;
/// The largest number in a table, a target or an option, in any unit. Its square and its cube stay far below the
/// largest `f64`.
pub const LARGEST: f64 = 1e15;

/// Characters of an expression.
pub const EXPRESSION_CHARACTERS: usize = 400_000;
/// Nesting depth of parentheses in an expression.
pub const EXPRESSION_DEPTH: usize = 200;
/// The largest exponent in an expression.
pub const EXPRESSION_EXPONENT: u32 = 1000;
/// Maximum number of terms of an expanded polynomial.
pub const EXPANSION_TERMS: f64 = 1e6;
/// Bits of a coefficient in an expanded polynomial.
pub const EXPANSION_BITS: f64 = 1e6;
/// Degree of an expanded polynomial.
pub const EXPANSION_DEGREE: u64 = 30_000;
/// Degree of a summand in the parameters: numerator and denominator together.
pub const EXPANSION_PARAMETER_DEGREE: u64 = 100;
/// Sum of the degrees of all denominators of a polynomial.
pub const EXPANSION_DENOMINATOR_DEGREE: u64 = 1000;
/// Variables and parameters of a polynomial system.
pub const SYSTEM_NAMES: usize = 1000;
/// Tokens of a polynomial: numbers, names and signs.
pub const POLYNOMIAL_WORDS: usize = 1_000_000;
/// Square roots of rational numbers in a system.
pub const SYSTEM_ROOTS: usize = 8;
/// Bits of a rational constant of a derivation, and of the square of a square root.
pub const CONSTANT_BITS: u64 = 10_000;
/// Summands of a constant with square roots.
pub const CONSTANT_PARTS: usize = 1_000;
/// Summands of an equation after its constants are substituted.
pub const EQUATION_PARTS: usize = 400_000;

/// Joints of a path through a robot, including fixed joints.
pub const PATH_JOINTS: usize = 64;
/// The largest coordinate of a chain's axis, in the chain's unit. Sums of such numbers are far below the largest `f64`.
pub const COORDINATE: u64 = 1_000_000_000_000;
/// Joints of a chain.
pub const CHAIN_JOINTS: usize = 12;
/// Joints of a solver.
pub const SOLVER_JOINTS: usize = 16;
/// Solutions that a program can return for one target.
pub const PROGRAM_ANSWERS: usize = 4096;
/// Blocks of a solver's program.
pub const PROGRAM_BLOCKS: usize = 64;
/// Unknowns of a solver's program.
pub const PROGRAM_UNKNOWNS: usize = 1024;
/// Bodies of a robot whose equations of motion are generated as code.
pub const PRINTED_BODIES: usize = 500;
/// Joints of a chain whose equations of motion are written as polynomials.
pub const SYMBOLIC_JOINTS: usize = 7;
/// Terms of the polynomials M, C and N together.
pub const SYMBOLIC_TERMS: usize = 100_000;

/// File stems of the C run time. No generated solver may have one of these names.
pub const RUN_TIME_FILES: [&str; 4] = ["groebot", "groebot_six_axes", "groebot_redundant", "groebot_dynamics"];

/// Whether `name` can be a name in any input: 1 to [`NAME_CHARACTERS`] characters, not all of them blanks, none of them
/// hidden ([`crate::escape::is_hidden`]).
pub fn is_name(name: &str) -> bool {
    !name.trim().is_empty() && name.chars().count() <= NAME_CHARACTERS && !name.chars().any(is_hidden)
}

/// Checks a name with [`is_name`]. `what` describes the named item in the message.
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

/// Parses the number in a table cell or an option.
///
/// # Errors
/// A message: not a number, not finite, or beyond [`LARGEST`].
pub fn number(cell: &str) -> std::result::Result<f64, String> {
    match cell.trim().parse::<f64>() {
        Ok(number) if number.abs() <= LARGEST => Ok(number),
        Ok(number) if number.is_nan() => Err(format!("`{}` is not a number", shown(cell))),
        Ok(_) => Err(format!("`{}` is too large; give at most {LARGEST:e}", shown(cell))),
        Err(_) => Err(format!("`{}` is not a number", shown(cell))),
    }
}

/// Checks that `count` is at most `most`.
///
/// # Errors
/// [`ErrorKind::BadValue`] with both numbers.
pub fn check_count(what: &str, count: usize, most: usize) -> Result<()> {
    if count <= most {
        return Ok(());
    }
    Err(Error::new(ErrorKind::BadValue, format!("{count} {what} are too many; give at most {most}")))
}
