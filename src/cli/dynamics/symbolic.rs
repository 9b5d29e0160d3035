//! The equations of motion of a chain as polynomials, with a certificate.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::Arguments;
use crate::cli::ends::TipLink;
use crate::cli::files::{refuse_input, source_files, write_set};
use crate::cli::{Outcome, console, json};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_algebra::limits::SYMBOLIC_TERMS;
use groebot_ik::derive::problem::input::InputFile;
use groebot_ik::derive::report::explain::{Document, Line, Part};
use groebot_ik::derive::{Ends, Source};
use groebot_ik::folder::motion::{self, Moving};
use groebot_robot::dynamics::exact::{ExactModel, Masses, Symbolic};
use groebot_robot::kinematics::Chain;
use groebot_robot::model::ReadOptions;
use groebot_robot::robots;

/// The greatest number of joints for equations as polynomials.
const MOST_JOINTS: usize = groebot_algebra::limits::SYMBOLIC_JOINTS;

/// Prints the polynomials, or writes them to a folder.
pub fn run(arguments: &Arguments) -> Outcome {
    let ends = Ends { base: arguments.part.base.clone(), tip: arguments.part.tip.clone(), ..Ends::default() };
    let input = Input::read(&arguments.robot, &ends, &arguments.part.options())?;
    let numbers = arguments.numbers.then(|| input.moving.numbers()).transpose()?;
    let masses = numbers.as_deref().map_or(Masses::Symbols, Masses::Numbers);
    let chain = &input.moving.chain;
    let gravity = &arguments.part.gravity.0;
    let symbolic = equations(chain, masses, arguments).map_err(|error| error.in_file(&arguments.robot))?;
    let tip = input.tip.as_ref();
    if !arguments.json {
        console::print_notes(input.notes());
    }
    let Some(folder) = &arguments.out else {
        let text = || TipLink::line(tip) + &symbolic.to_text();
        return console::print(&match (arguments.latex, arguments.json) {
            (true, _) => latex(chain, &symbolic, tip),
            (_, true) => json::text(&report(&input, &symbolic, &[])),
            _ => text(),
        });
    };
    let mut files = input.files(folder)?;
    files.extend(motion::files(chain, &symbolic, masses, gravity)?);
    let refuse = || match &input.source {
        Some(source) => refuse_input(source, folder, &files).map(|()| Vec::new()),
        None => Ok(Vec::new()),
    };
    write_set(folder, &files, refuse, arguments.force, &Watch::none())?;
    if arguments.json {
        let paths: Vec<PathBuf> = files.iter().map(|(name, _)| folder.join(name)).collect();
        return console::print(&json::text(&report(&input, &symbolic, &paths)));
    }
    let names: Vec<&str> = files.iter().map(|(name, _)| name.as_str()).collect();
    console::print(&format!(
        "{}{} joints, {} terms of M, C and N, proved; written to {}: {}\n",
        TipLink::line(tip),
        chain.joints().len(),
        symbolic.terms(),
        folder.display(),
        names.join(", ")
    ))
}

fn equations(chain: &Chain, masses: Masses<'_>, arguments: &Arguments) -> Result<Symbolic> {
    if chain.joints().len() > MOST_JOINTS {
        let text = format!(
            "{} joints; equations of motion are polynomials for up to {MOST_JOINTS}: choose --base and --tip, or use --states",
            chain.joints().len()
        );
        return Err(Error::new(ErrorKind::Unsupported, text));
    }
    let model = ExactModel::new(chain, masses, &arguments.part.gravity.0, SYMBOLIC_TERMS)?;
    Symbolic::new(model).map_err(|error| match (error.kind(), masses) {
        (ErrorKind::Overflow, Masses::Symbols) => {
            error.with_context("give --numbers, or fewer joints by --base and --tip")
        }
        _ => error,
    })
}

/// A chain and its source.
struct Input {
    moving: Moving,
    /// The last link, for a robot.
    tip: Option<TipLink>,
    source: Option<Source>,
}

impl Input {
    fn read(path: &Path, ends: &Ends, options: &ReadOptions) -> Result<Self> {
        if let Some(robot) = path.to_str().and_then(robots::robot) {
            let [base, tip] = [ends.base.as_deref(), ends.tip.as_deref()];
            let chain = robot.chain(base, tip)?.ideal().0;
            let tip = Some(TipLink::of_path(&robot.path(base, tip)?));
            return Ok(Input { moving: Moving { chain, robot: Some(robot), ends: ends.clone() }, tip, source: None });
        }
        let input = InputFile::read_with(path, options)?;
        let source = Source::of(input.clone(), ends)?;
        let (moving, tip) = (Moving::of(&input, &source)?, TipLink::of_source(&source));
        Ok(Input { moving, tip, source: Some(source) })
    }

    /// The ignored parts of a robot.
    fn notes(&self) -> &[String] {
        self.source.as_ref().map_or(&[], |source| &source.notes)
    }

    /// The input's own files that a folder does not contain yet.
    fn files(&self, folder: &Path) -> Result<Vec<(String, Vec<u8>)>> {
        let text =
            "a robot of groebot has no file for a later check; export it by `groebot export`, and give that file";
        let source = self.source.as_ref().ok_or_else(|| Error::new(ErrorKind::Unsupported, text))?;
        source_files(source, folder)
    }
}

/// The entries of the equations, the meaning of their symbols, and the written files.
fn report(input: &Input, symbolic: &Symbolic, files: &[PathBuf]) -> Value {
    let files: Vec<&Path> = files.iter().map(PathBuf::as_path).collect();
    let mut value = json::written(&files);
    let chain = &input.moving.chain;
    value["name"] = chain.name().into();
    value["joints"] = chain.joints().iter().map(|joint| joint.name.as_str()).collect();
    value["tip_link"] = serde_json::to_value(&input.tip).expect("names");
    value["terms"] = symbolic.terms().into();
    value["entries"] =
        symbolic.entries().into_iter().map(|(name, text)| json!({ "name": name, "polynomial": text })).collect();
    value["legend"] = symbolic.legend().into();
    value["notes"] = input.notes().into();
    value
}

/// A page of LaTeX.
fn latex(chain: &Chain, symbolic: &Symbolic, tip: Option<&TipLink>) -> String {
    let legend = symbolic.legend().into_iter().map(|line| Part::Paragraph(Line::of(&line)));
    let equation = |(name, entry): (String, String)| Part::Equation {
        number: String::new(),
        formula: format!("{name} = {entry}"),
    };
    let parts = tip.and_then(TipLink::paragraph).into_iter().chain(legend);
    let parts = parts.chain(symbolic.entries().into_iter().map(equation)).collect();
    Document { title: format!("Equations of motion of {}", chain.name()), parts }.to_latex()
}
