//! Code generation for equations of motion: Rust ([`Printed::rust`]) and C99 ([`Printed::c99`]).
//!
//! The recursive algorithms of [`groebot_robot::dynamics`] (RNEA, CRBA, ABA) run on numbers that record their
//! operations. Known values are computed at once, and common subexpressions once. Where such straight-line code would
//! be long, one step of the recursion is recorded instead, and printed in a loop over the bodies.

mod function;
mod language;
mod languages;
mod loops;
mod recursive;
mod tape;

use serde::Serialize;

pub use self::function::Function;
use self::language::{Language, results};
use self::languages::{C, Rust};
use self::recursive::Recursive;
use self::tape::{Recorded, Tape};
use super::names::remark;
use super::printer::Printer;
use super::reserved::prefix;
use crate::solver::{Demand, Instruction, Operand};
use crate::{Error, ErrorKind, Result};
use groebot_robot::dynamics::{Equations, FormalState, Freedom, Place, Value};

const RUST: &str = include_str!("../skeleton/dynamics.rs.txt");
const HEADER: &str = include_str!("../skeleton/dynamics.h.txt");
const SOURCE: &str = include_str!("../skeleton/dynamics.c.txt");

/// The form of a printed function.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub enum Form {
    /// Straight-line code if it has at most 100,000 characters in Rust, otherwise loops.
    #[default]
    Shorter,
    /// Straight-line code, the fastest form.
    Straight,
    /// Loops over the bodies, whose parameters are in tables. Forward dynamics (ABA) with joints that follow others is always straight-line code.
    Recursive,
}

/// The greatest length of a function's straight-line code in characters, unless that form is requested.
pub(crate) const LONGEST: usize = 100_000;

/// A request for printed code of a robot.
#[derive(Clone, Debug)]
pub struct Printed<'a> {
    /// The robot's name.
    pub name: &'a str,
    /// Its equations of motion; friction is ignored.
    pub equations: &'a Equations,
    /// Lines for the header comment of the file.
    pub remarks: Vec<String>,
    /// The functions, in order.
    pub functions: Vec<Function>,
    /// Their form.
    pub form: Form,
}

/// The code of one function.
struct Body {
    code: Vec<Instruction>,
    results: Vec<Operand>,
}

impl Printed<'_> {
    /// Prints a Rust file that needs the crate `groebot-runtime` (edition 2024).
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for forward dynamics if bodies without mass would move.
    pub fn rust(&self) -> Result<String> {
        Ok(super::fill(RUST, &self.outline(&Rust, "")?))
    }

    /// Prints a header and a source file in C99 that need `groebot_dynamics.h`, for files `stem.h` and `stem.c`. Names begin with the robot's.
    ///
    /// # Errors
    /// Same as [`Printed::rust`].
    pub fn c99(&self, stem: &str) -> Result<[String; 2]> {
        let outline = self.outline(&C, stem)?;
        Ok([HEADER, SOURCE].map(|skeleton| super::fill(skeleton, &outline)))
    }

    /// The number of operations of a function.
    ///
    /// # Errors
    /// Same as [`Printed::rust`].
    pub fn operations(&self, function: Function) -> Result<usize> {
        Ok(self.record(function)?.code.len())
    }

    fn outline(&self, language: &dyn Language, stem: &str) -> Result<Outline> {
        let values = self.equations.values();
        let angles = values.iter().filter(|value| value.freedom == Freedom::Turn);
        let recursive = Recursive::new(self.equations.formal(|x| x));
        let functions = self.functions.iter().map(|function| self.function(*function, &recursive, language));
        let functions: Vec<FunctionText> = functions.collect::<Result<_>>()?;
        let loops = functions.iter().any(|function| function.is_recursive);
        let displacements = values.iter().filter(|value| value.freedom == Freedom::Slide);
        let joints = self.equations.joints().iter().map(|name| format!("`{}`", remark(name)));
        let base = |coordinates: &str| -> Vec<String> {
            if self.equations.is_floating() { coordinates.split(' ').map(str::to_owned).collect() } else { Vec::new() }
        };
        let prefix = prefix(self.name);
        Ok(Outline {
            version: env!("CARGO_PKG_VERSION"),
            name: remark(self.name),
            guard: prefix.to_ascii_uppercase() + "_DYNAMICS",
            prefix,
            stem: stem.to_owned(),
            configuration: base("x y z qx qy qz qw").into_iter().chain(joints.clone()).collect(),
            freedoms: base("vx vy vz wx wy wz").into_iter().chain(joints).collect(),
            remarks: self.remarks.iter().map(|line| remark(line)).collect(),
            angles: angles.map(|value| joint_value(value, language)).collect(),
            displacements: displacements.map(|value| joint_value(value, language)).collect(),
            bodies: values.len() + 1,
            tables: if loops { language.tables(&recursive.tables()) } else { Vec::new() },
            functions,
        })
    }

    fn function(&self, function: Function, recursive: &Recursive, language: &dyn Language) -> Result<FunctionText> {
        let body = self.record(function)?;
        // The length in Rust determines the form in both languages, so that they round alike.
        let is_long = || self.straight(function, &body, &Rust).0.iter().map(String::len).sum::<usize>() > LONGEST;
        let has_loops = function != Function::Forward || recursive.is_plain();
        let is_recursive = has_loops && (self.form == Form::Recursive || self.form == Form::Shorter && is_long());
        let (code, answer) = if is_recursive {
            ([language.start(function), recursive.code(function, language)].concat(), language.finish(function))
        } else {
            self.straight(function, &body, language)
        };
        Ok(self.text(function, language, code, answer, is_recursive))
    }

    /// Straight-line code, and its result.
    fn straight(&self, function: Function, body: &Body, language: &dyn Language) -> (Vec<String>, String) {
        let names = self.names(function, language);
        let demand = Demand::of_code(&body.code, &body.results);
        let mut printer = Printer::of(language.expressions(), &names, demand);
        let mut lines = printer.code(&body.code);
        let results: Vec<String> = body.results.iter().map(|result| printer.operand(*result)).collect();
        let (more, answer) = language.answer(function, self.equations.freedoms(), results);
        lines.extend(more);
        (lines, answer)
    }

    fn text(
        &self,
        function: Function,
        language: &dyn Language,
        code: Vec<String>,
        answer: String,
        is_recursive: bool,
    ) -> FunctionText {
        FunctionText {
            name: function.name(),
            about: function.about(),
            inputs: std::iter::once("q").chain(function.inputs().iter().copied()).collect(),
            parameters: language.parameters(function, self.equations),
            result: match results(function) {
                (_, false) => "Row",
                ([_], true) => "Matrix",
                (_, true) => "[Matrix; 2]",
            },
            reads_displacements: code.iter().any(|line| line.contains("displacement[")),
            code,
            answer,
            is_recursive,
        }
    }

    /// The inputs of the recorded code, in order: cosines, sines, displacements, the root's quaternion, and the other
    /// inputs.
    fn names(&self, function: Function, language: &dyn Language) -> Vec<String> {
        let values = self.equations.values();
        let turning = values.iter().filter(|value| value.freedom == Freedom::Turn).count();
        let pairs = ["c", "s"].into_iter().flat_map(|name| (0..turning).map(move |i| format!("{name}[{i}]")));
        let displacements = values.iter().filter(|value| value.freedom == Freedom::Slide);
        let displacements = displacements.map(|value| format!("({})", joint_value(value, language)));
        let turn = (3..7).map(|i| format!("q[{i}]"));
        let lists = function.inputs().iter();
        let lists = lists.flat_map(|list| (0..self.equations.freedoms()).map(move |i| format!("{list}[{i}]")));
        pairs.chain(displacements).chain(turn).chain(lists).collect()
    }

    /// Runs the algorithm and records it.
    fn record(&self, function: Function) -> Result<Body> {
        let (tape, formal) = (Tape::default(), self.equations.formal(Recorded::constant));
        let values = self.equations.values();
        let turning = values.iter().filter(|value| value.freedom == Freedom::Turn).count();
        let sliding = values.len() - turning;
        let (mut turns, mut slides) = (0, 0);
        let place = |value: &Value| match value.freedom {
            Freedom::Turn => {
                turns += 1;
                Place::Turn([tape.input(turns - 1), tape.input(turning + turns - 1)])
            }
            Freedom::Slide => {
                slides += 1;
                Place::Slide(tape.input(2 * turning + slides - 1))
            }
        };
        let places = values.iter().map(place).collect();
        let first = 2 * turning + sliding;
        let turn = self.equations.is_floating().then(|| std::array::from_fn(|i| tape.input(first + i)));
        let count = self.equations.freedoms();
        let list = |number: usize| (0..count).map(|i| tape.input(first + 4 + number * count + i)).collect::<Vec<_>>();
        let state = FormalState { places, turn, velocity: list(0) };
        let results = match function {
            Function::Inverse => formal.inverse(&state, &list(1)),
            Function::Gravity => formal.gravity(&state),
            Function::Inertia => formal.inertia(&state),
            Function::Coriolis => formal.coriolis(&state),
            Function::Forward => formal.forward(&state, &list(1))?,
            Function::Derivatives => formal.derivatives(&state, &list(1)).concat(),
        };
        if results.iter().any(|result| !result.is_finite()) {
            let text = "a number exceeds the range of double precision; check that each moving body has mass";
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let (code, results) = tape.code(&results);
        Ok(Body { code, results })
    }
}

/// The value of a joint, as an expression of the configuration.
fn joint_value(value: &Value, language: &dyn Language) -> String {
    let Value { place, factor, offset, .. } = *value;
    let mut text = format!("q[{place}]");
    if factor != 1.0 {
        text = format!("{} * {text}", language.expressions().literal(factor));
    }
    if offset != 0.0 { format!("{text} + {}", language.expressions().literal(offset)) } else { text }
}

/// The values for a skeleton.
#[derive(Serialize)]
struct Outline {
    version: &'static str,
    name: String,
    prefix: String,
    guard: String,
    stem: String,
    configuration: Vec<String>,
    freedoms: Vec<String>,
    remarks: Vec<String>,
    angles: Vec<String>,
    displacements: Vec<String>,
    bodies: usize,
    tables: Vec<String>,
    functions: Vec<FunctionText>,
}

#[derive(Serialize)]
struct FunctionText {
    name: &'static str,
    about: &'static str,
    inputs: Vec<&'static str>,
    parameters: String,
    result: &'static str,
    code: Vec<String>,
    answer: String,
    reads_displacements: bool,
    is_recursive: bool,
}
