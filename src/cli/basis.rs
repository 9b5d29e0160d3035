//! `groebot basis`: Groebner bases of systems of polynomials in files.

use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::builder::{PossibleValuesParser, TypedValueParser};

use super::basis_question::{Question, Required};
use super::console;
use super::output::{Force, Kind, Output};
use super::progress::{Budget, Session};
use super::{Outcome, basis_cover, json};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::poly::Order;
use groebot_algebra::poly::system::{Format, MAX_SYSTEM_LENGTH, PolynomialSystem, parse_order};
use groebot_robot::document::read_bytes;

const EXAMPLES: &str = "Examples:
  groebot basis cyclic5.txt                                  the reduced basis, in the order of the file
  groebot basis cyclic5.ms --order lex --output-format singular
  groebot basis surface.txt --eliminate s,t -o surface.basis
  groebot basis circles.sing --characteristic 32003 --time 60 --memory 2000
  groebot basis circles.txt --certificate=circles.json       with a proof by cofactors
  groebot basis leg.txt --cover                              a basis for every value of the parameters

docs/basis_files.md describes the three formats and the certificate.";

/// Computes the reduced Groebner basis of a system of polynomials (Buchberger, F4, FGLM)
///
/// The basis is written to standard output (or to OUT), and a summary to standard error. Ctrl-C stops the work and
/// writes nothing.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// Plain text, a Singular ring and ideal, or an msolve file; `-` for standard input
    file: PathBuf,
    /// The term order: grevlex, lex, block:2,3 or blocks such as grevlex(2),lex(3) (default: that of the file, else
    /// grevlex)
    #[arg(long, value_parser = order)]
    order: Option<Order>,
    /// Compute modulo this prime (default: the field of the file)
    #[arg(long, value_name = "P")]
    characteristic: Option<u64>,
    /// Eliminate these variables: computes the basis of the elimination ideal in the others
    #[arg(long, value_name = "NAMES", value_delimiter = ',')]
    eliminate: Vec<String>,
    /// Prove the basis and write the proof, by default to NAME.certificate.json in the folder of FILE
    #[arg(long, value_name = "OUT", num_args = 0..=1, require_equals = true)]
    certificate: Option<Option<PathBuf>>,
    /// Compute a basis for every value of the parameters: a list of strata of the parameter space, with a proof
    #[arg(long, conflicts_with_all = ["certificate", "eliminate", "output_format", "prove"])]
    cover: bool,
    /// Exclude errors by unlucky primes: prove the basis, or use exact computation only
    #[arg(long)]
    prove: bool,
    /// The format of FILE (default: detected from its content)
    #[arg(long, default_value = "auto", value_parser = formats(&["auto", "plain", "singular", "msolve"]))]
    format: Choice,
    /// The format of the basis (default: that of FILE)
    #[arg(long, value_parser = formats(&["plain", "singular", "msolve"]))]
    output_format: Option<Choice>,
    /// Write the basis to this file
    #[arg(short, long, value_name = "OUT")]
    out: Option<PathBuf>,
    /// Print the basis and properties of the ideal as JSON instead of the basis and the summary
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    budget: Budget,
    #[command(flatten)]
    force: Force,
}

/// A format, or automatic detection.
#[derive(Clone, Copy)]
struct Choice(Option<Format>);

fn formats(names: &'static [&'static str]) -> impl TypedValueParser<Value = Choice> {
    PossibleValuesParser::new(names).map(|name| {
        let known = [Format::Plain, Format::Singular, Format::Msolve];
        Choice(known.into_iter().find(|format| format.to_string() == name))
    })
}

fn order(text: &str) -> std::result::Result<Order, String> {
    parse_order(text).map_err(|error| error.message().to_owned())
}

/// Reads the system, computes, and writes the result.
pub fn run(arguments: &Arguments) -> Outcome {
    let session = Session::start(arguments.budget.limits())?;
    let start = Instant::now();
    let proof_file = arguments.proof_file()?;
    let output = arguments.force.output([arguments.file.as_path()]);
    let output = output.expects([arguments.out.as_ref(), proof_file.as_ref()])?;
    if arguments.cover {
        return write_cover(arguments, &output, &session, start);
    }
    let question = arguments.question().map_err(|error| error.in_file(&arguments.file))?;
    let answer = question.answer(&session.watch).map_err(|error| in_file(error, &arguments.file))?;
    let text = answer.text.clone();
    let basis = match question.format {
        Format::Plain => Kind::Lines("#"),
        Format::Singular => Kind::Lines("//"),
        Format::Msolve => Kind::Plain,
    };
    // An interruption is checked before the first file.
    session.watch.check()?;
    if let (Some(file), Some(proof)) = (&proof_file, &answer.certificate) {
        output.write(file, Kind::Json, proof)?;
    }
    if let Some(file) = &arguments.out {
        output.write(file, basis, &text)?;
    }
    drop(session);
    if arguments.json {
        return console::print(&json::text(&answer.json()));
    }
    if arguments.out.is_none() {
        console::print(&text)?;
    }
    if !arguments.budget.quiet {
        // A closed standard error cannot be reported.
        let _ = writeln!(io::stderr(), "{}; {:.2} s", answer.summary(), start.elapsed().as_secs_f64());
    }
    Ok(())
}

/// Computes the cover and writes the result.
fn write_cover(arguments: &Arguments, output: &Output, session: &Session, start: Instant) -> Outcome {
    let compute = || {
        let (system, _) = arguments.system()?;
        let order = arguments.order.clone().unwrap_or_else(|| system.heading.order.clone());
        let heading = system.heading.clone().with_order(order).map_err(|error| error.with_context("--order"))?;
        basis_cover::compute(&system, &heading, &session.watch)
    };
    let basis_cover::Covered { text, summary, json } = compute().map_err(|error| in_file(error, &arguments.file))?;
    match &arguments.out {
        Some(path) => {
            session.watch.check()?;
            output.write(path, Kind::Lines("#"), text)?;
        }
        None if arguments.json => {}
        None => console::print(&text)?,
    }
    if arguments.json {
        return console::print(&json::text(&json));
    }
    if !arguments.budget.quiet {
        // A closed standard error cannot be reported.
        let _ = writeln!(io::stderr(), "{summary}; {:.2} s", start.elapsed().as_secs_f64());
    }
    Ok(())
}

impl Arguments {
    /// The system in the file, over the requested field, and the format of the file.
    fn system(&self) -> Result<(PolynomialSystem, Format)> {
        let bytes = read_bytes(&self.file, MAX_SYSTEM_LENGTH as u64)?;
        let given = self.format.0.unwrap_or_else(|| PolynomialSystem::format_of(&String::from_utf8_lossy(&bytes)));
        let mut system = PolynomialSystem::read_bytes(&bytes, Some(given))?;
        if let Some(p) = self.characteristic {
            system.heading = system.heading.modulo(p).map_err(|error| error.with_context("--characteristic"))?;
        }
        Ok((system, given))
    }

    fn question(&self) -> Result<Question> {
        let (system, given) = self.system()?;
        let format = self.output_format.and_then(|choice| choice.0).unwrap_or(given);
        let required = Required {
            order: self.order.clone(),
            eliminated: &self.eliminate,
            format,
            certificate: self.certificate.is_some(),
            prove: self.prove,
        };
        Question::new(system, required)
    }

    /// The file of the certificate, if one is requested.
    fn proof_file(&self) -> Result<Option<PathBuf>> {
        let path = match &self.certificate {
            None => return Ok(None),
            Some(Some(path)) => path.clone(),
            Some(None) if self.file == Path::new("-") => {
                let text = "standard input has no name for the certificate; give one, as in --certificate=proof.json";
                return Err(Error::new(ErrorKind::MissingKey, text));
            }
            Some(None) => self.file.with_extension("certificate.json"),
        };
        if self.out.as_ref() == Some(&path) {
            let text = "the basis and its certificate need two files; give another name to one of them";
            return Err(Error::new(ErrorKind::BadValue, text).in_file(&path));
        }
        Ok(Some(path))
    }
}

fn in_file(error: Error, path: &Path) -> Error {
    match error.kind() {
        ErrorKind::Cancelled => error,
        _ => error.in_file(path),
    }
}
