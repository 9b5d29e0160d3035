//! Code generation for the equations of motion of a robot.

use std::path::Path;

use clap::ValueEnum;
use clap::builder::{PossibleValuesParser, TypedValueParser};
use serde_json::Value;

use super::{Arguments, massless};
use crate::cli::codegen::{refuse_run_time, write_pair};
use crate::cli::moving::described;
use crate::cli::output::{Kind, Output};
use crate::cli::{Outcome, console, json};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::limits;
use groebot_ik::codegen::dynamics::{Form, Function, Printed};
use groebot_robot::dynamics::Base;
use groebot_robot::model::Robot;

/// The language of the code.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Language {
    /// Rust, on the crate groebot-runtime
    Rust,
    /// C99, on groebot_dynamics.h
    C,
}

/// The form of the functions.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum FormName {
    /// Straight-line code, the fastest form
    Straight,
    /// Loops over tables of the bodies (RNEA, CRBA, ABA), the shortest form
    Recursive,
}

impl FormName {
    fn form(self) -> Form {
        match self {
            FormName::Straight => Form::Straight,
            FormName::Recursive => Form::Recursive,
        }
    }
}

/// Reads a function by its name.
pub fn functions() -> impl TypedValueParser<Value = Function> {
    let known = |name: String| Function::ALL.into_iter().find(|function| function.name() == name);
    let names = PossibleValuesParser::new(Function::ALL.map(Function::name));
    names.map(move |name| known(name).expect("one of the possible values"))
}

/// Prints the code, or writes it to files.
pub fn run(arguments: &Arguments, language: Language) -> Outcome {
    if arguments.json && arguments.out.is_none() {
        let text = "--json reports the files of code; give the file by -o";
        return Err(Error::new(ErrorKind::BadValue, text).into());
    }
    let output = arguments.output(None).expects([arguments.out.as_ref()])?;
    let (described, _) = described(&arguments.robot, &arguments.part.options())?;
    check(&described).map_err(|error| error.in_file(&arguments.robot))?;
    let meant = described.as_meant()?;
    let (robot, gravity) = arguments.part.of(&meant)?;
    let base = if arguments.floating { Base::Floating } else { Base::Fixed };
    let equations = arguments.equations(&robot, base)?.with_gravity(gravity);
    let mut remarks = vec![format!("Gravity: {}, {}, {} m/s^2. Friction is ignored.", gravity.x, gravity.y, gravity.z)];
    if meant != described {
        remarks.push("Rotations are idealised: 1.5708 is a quarter turn.".to_owned());
    }
    let functions = arguments.functions.clone();
    let mut printed = Printed {
        name: robot.name(),
        equations: &equations,
        remarks,
        functions,
        form: arguments.form.map_or(Form::Shorter, FormName::form),
    };
    let left_out = if arguments.functions.is_empty() { choose_functions(&mut printed) } else { None };
    let notes = [&robot.parts().notes[..], equations.notes(), left_out.as_slice()].concat();
    if !arguments.json {
        console::print_notes(&notes);
    }
    write(arguments, &output, language, &printed)?;
    match &arguments.out {
        Some(file) if arguments.json => console::print(&json::text(&report(&printed, language, file, &notes))),
        _ => Ok(()),
    }
}

/// The printed functions and their files.
fn report(printed: &Printed<'_>, language: Language, file: &Path, notes: &[String]) -> Value {
    let header = file.with_extension("h");
    let files: &[&Path] = if language == Language::C { &[&header, file] } else { &[file] };
    let mut value = json::written(files);
    value["name"] = printed.name.into();
    value["functions"] = printed.functions.iter().map(|function| function.name()).collect();
    value["notes"] = notes.into();
    value
}

/// Fails for a robot with too many joints or without mass, before any computation.
fn check(robot: &Robot) -> Result<()> {
    limits::check_count("joints", robot.joints().len(), limits::PRINTED_BODIES)?;
    if robot.links().iter().any(|link| link.mass.is_some()) {
        return Ok(());
    }
    Err(massless())
}

/// Selects all functions. Forward dynamics are excluded if bodies without mass would have to move. Returns a note for
/// the output and the code.
fn choose_functions(printed: &mut Printed<'_>) -> Option<String> {
    printed.functions = Function::ALL.to_vec();
    let error = printed.operations(Function::Forward).err()?;
    printed.functions.retain(|function| *function != Function::Forward);
    let note = format!("forward dynamics is omitted: {}", error.message());
    printed.remarks.push(note.clone());
    Some(note)
}

fn write(arguments: &Arguments, output: &Output, language: Language, printed: &Printed<'_>) -> Outcome {
    let fault = |error: Error| error.in_file(&arguments.robot);
    match (language, &arguments.out) {
        (Language::Rust, None) => console::print(&printed.rust().map_err(fault)?),
        (Language::Rust, Some(file)) => output.write(file, Kind::Plain, printed.rust().map_err(fault)?),
        (Language::C, Some(file)) if file.extension().is_some_and(|end| end == "c") => {
            refuse_run_time(file)?;
            let stem = file.file_stem().and_then(|stem| stem.to_str()).unwrap_or("dynamics");
            Ok(write_pair(output, file, printed.c99(stem).map_err(fault)?)?)
        }
        (Language::C, _) => {
            let text = "C has two files: give the name of the source file by -o NAME.c";
            Err(Error::new(ErrorKind::BadValue, text).into())
        }
    }
}
