//! `groebot check`: the stored certificate proves the derivation again, and the stored stages are what it proves.

use std::path::{Path, PathBuf};

use super::console::{self, Paint};
use super::derive::refuse_failures;
use super::ends::EndArguments;
use super::files::{CERTIFICATE, CHECKS, DYNAMICS, is_ours, printed_solvers};
use super::{Halt, Outcome, dynamics, json};
use crate::derive::coupled::ChainStage;
use crate::derive::sequential::Derived;
use crate::derive::{Derivation, Proved, Source, stages};
use crate::document::read_text;
use crate::solver::Program;
use crate::{Error, ErrorKind, Result, Watch, witness};

/// The longest stage file that is read, in bytes.
const LIMIT: u64 = crate::limits::STAGE_BYTES;
const PROGRAM: &str = "5_program.json";

/// Proves a stored derivation again, without the Groebner engine
///
/// Ends with a non-zero status and says where when a proof is forged or damaged, or a stage file is not what is proved.
#[derive(clap::Args)]
#[command(after_help = "Example:\n  groebot check derivations/nao_leg_sagittal")]
pub struct Arguments {
    /// A folder that `groebot derive` wrote
    derivation: PathBuf,
    #[command(flatten)]
    ends: EndArguments,
    /// JSON instead of text
    #[arg(long)]
    json: bool,
}

/// One thing that was checked: what, and what was found or what is wrong.
struct Finding {
    what: String,
    verdict: Result<String>,
}

/// Checks all there is to check.
pub fn run(arguments: &Arguments) -> Outcome {
    let folder = arguments.derivation.as_path();
    let source = Source::read_between(folder, &arguments.ends.ends()?)?;
    let mut findings = vec![read(&source)];
    let motion = dynamics::reprove(folder, &source.ends).transpose();
    // A folder may hold equations of motion alone.
    let proved_again =
        if motion.is_some() && !folder.join(CERTIFICATE).exists() { None } else { Some(reprove(folder, &source)) };
    match proved_again {
        None => {}
        Some(Ok(derivation)) => {
            findings.push(Finding { what: CERTIFICATE.to_owned(), verdict: Ok(proved(&derivation)) });
            findings.extend(stored_stages(folder, &source, &derivation)?);
            findings.push(numeric_checks(folder, &source, &derivation)?);
        }
        Some(Err(error)) => findings.push(Finding { what: CERTIFICATE.to_owned(), verdict: Err(error) }),
    }
    let motion = motion.map(|verdict| verdict.map(|proof| proof.to_string()));
    findings.extend(motion.map(|verdict| Finding { what: DYNAMICS.to_owned(), verdict }));
    if arguments.json {
        console::print(&json::text(&told(&findings, &source.notes)))?;
    } else {
        console::tell(&source.notes);
        console::print(&page(&findings, Paint::of(&std::io::stdout())))?;
    }
    match findings.iter().find_map(|finding| finding.verdict.as_ref().err()) {
        None => Ok(()),
        Some(first) => Err(Halt::Error(first.clone())),
    }
}

/// The derivation that the stored certificate proves.
///
/// # Errors
/// As [`Proved::again`], and when the certificate cannot be read.
pub fn reprove(folder: &Path, source: &Source) -> Result<Proved> {
    let path = folder.join(CERTIFICATE);
    let text = read_text(&path, LIMIT)?;
    let proved = Proved::again(source, &text).map_err(|error| error.in_file(&path))?;
    Ok(proved.about(source))
}

fn read(source: &Source) -> Finding {
    let text = match (source.chain_by_steps(), &source.system, &source.coupled) {
        (None, Some(system), _) => format!("{} equations in {}", system.equations.len(), system.order.join(", ")),
        (None, None, Some(coupled)) => {
            format!("{} chains on {} actuators", coupled.chains().len(), coupled.actuators().len())
        }
        (chain, ..) => format!("a chain of {} joints", chain.map_or(0, |chain| chain.joints().len())),
    };
    Finding { what: source.name.to_owned(), verdict: Ok(text) }
}

fn proved(proved: &Proved) -> String {
    match proved {
        Proved::Equations(derivation) => proved_equations(derivation),
        Proved::Chain(derived) => proved_chain(derived),
        Proved::SixAxes(derived) => {
            format!("{} eigenvalue problems proved regular again", derived.formulations.len())
        }
        Proved::Coupled(derived) => {
            let member = |stage: &ChainStage| {
                format!("{}: {}", derived.coupled.chains()[stage.member].name, proved_chain(&stage.derived))
            };
            let shared = derived.simultaneous.iter().map(|_| {
                format!("{}: an equation of each chain proved again", derived.simultaneous_names().join(", "))
            });
            shared.chain(derived.stages.iter().map(member)).collect::<Vec<_>>().join("; ")
        }
    }
}

fn proved_chain(derived: &Derived) -> String {
    let relations: usize = derived.steps.iter().map(|step| step.relations.len()).sum();
    let bases: usize =
        derived.form_bases.iter().flat_map(|form_basis| form_basis.tree.walk()).map(|node| node.proofs().len()).sum();
    format!(
        "{} steps proved again: {relations} equations follow from the loop, {bases} bases of {} forms",
        derived.steps.len(),
        derived.form_bases.len()
    )
}

fn proved_equations(derivation: &Derivation) -> String {
    let trees = derivation.trees();
    let nodes: Vec<_> = trees.iter().flat_map(|(_, node)| node.walk()).collect();
    let proofs: Vec<_> = nodes.iter().flat_map(|node| node.proofs()).map(|(_, certified)| certified.proof).collect();
    let rows: usize = proofs.iter().map(|proof| proof.cofactor_rows).sum();
    let pairs: usize = proofs.iter().map(|proof| proof.pairs).sum();
    format!(
        "{} bases proved again: {rows} combinations of the equations multiplied out, {pairs} S-polynomials reduced to zero",
        proofs.len()
    )
}

/// Compares every stage file with what the proved derivation says.
fn stored_stages(folder: &Path, source: &Source, derivation: &Proved) -> Result<Vec<Finding>> {
    let mut findings = Vec::new();
    let stages = derivation.stage_files()?;
    for (name, bytes) in stages.into_iter().chain(printed_solvers(derivation.program(), source)) {
        if name == CERTIFICATE || !is_ours(folder, &name) {
            continue;
        }
        let path = folder.join(&name);
        let verdict = read_text(&path, LIMIT).and_then(|stored| match name.as_str() {
            PROGRAM => same_program(&stored, derivation.program()),
            // What was measured stands behind what is proved.
            stages::PAGE if stored.starts_with(&*String::from_utf8_lossy(&bytes)) => {
                Ok("follows from the proof".to_owned())
            }
            _ => same_text(&stored, &String::from_utf8_lossy(&bytes)),
        });
        findings.push(Finding { what: name, verdict: verdict.map_err(|error| error.in_file(&path)) });
    }
    Ok(findings)
}

/// Runs the numeric checks again and looks at what the stored ones say.
fn numeric_checks(folder: &Path, source: &Source, derivation: &Proved) -> Result<Finding> {
    let checked = witness::check(source, derivation, &Watch::none())?;
    let path = folder.join(CHECKS);
    let stored = read_text(&path, LIMIT).and_then(|stored| same_table(&stored, &checked.to_csv()));
    let verdict =
        refuse_failures(source, derivation, &checked, false).and(stored.map_err(|error| error.in_file(&path)));
    let summary = checked.summary();
    let verdict = verdict.map(|()| match summary.failed {
        0 => format!("{} targets solved again and right", summary.rows),
        lost => format!(
            "{} targets solved again; at {lost} of them, singular or next to such, answers are lost",
            summary.rows
        ),
    });
    Ok(Finding { what: CHECKS.to_owned(), verdict })
}

/// Columns that rounding decides, which differs from one mathematical library to another.
const ROUNDED: [&str; 2] = ["worst_residual", "nearest"];

/// Whether two tables say the same: words to the letter, numbers up to the last digits of another library's sine.
fn same_table(stored: &str, derived: &str) -> Result<()> {
    let read = |text: &str| -> Vec<csv::StringRecord> {
        let reader = csv::ReaderBuilder::new().has_headers(false).flexible(true).from_reader(text.as_bytes());
        reader.into_records().filter_map(std::result::Result::ok).collect()
    };
    let (stored, derived) = (read(stored), read(derived));
    let names = derived.first().cloned().unwrap_or_default();
    let same = |a: &str, b: &str, name: &str| match (a.parse::<f64>(), b.parse::<f64>()) {
        (Ok(x), Ok(y)) => (x - y).abs() <= 1e-6 * (1.0 + y.abs()),
        _ => a == b || ROUNDED.contains(&name),
    };
    let same_line = |a: &csv::StringRecord, b: &csv::StringRecord| {
        let cells = a.iter().zip(b).zip(&names);
        a.len() == b.len() && cells.into_iter().all(|((a, b), name)| same(a, b, name))
    };
    let common = stored.iter().zip(&derived).take_while(|(a, b)| same_line(a, b)).count();
    if common == derived.len() && common == stored.len() {
        return Ok(());
    }
    Err(differs("this line").at_line(common + 1))
}

/// Whether the stored program is the derived one.
fn same_program(stored: &str, derived: &Program) -> Result<String> {
    if Program::from_json(stored)? == *derived {
        Ok("follows from the proof".to_owned())
    } else {
        Err(differs("the program"))
    }
}

fn same_text(stored: &str, derived: &str) -> Result<String> {
    if stored == derived {
        return Ok("follows from the proof".to_owned());
    }
    let common = stored.lines().zip(derived.lines()).take_while(|(a, b)| a == b).count();
    Err(differs("this line").at_line(common + 1))
}

fn differs(what: &str) -> Error {
    let text = format!("{what} is not what the certificate proves; `groebot derive` writes the right one");
    Error::new(ErrorKind::Certificate, text)
}

fn told(findings: &[Finding], notes: &[String]) -> serde_json::Value {
    let one = |Finding { what, verdict }: &Finding| {
        let text = verdict.as_ref().map_or_else(ToString::to_string, Clone::clone);
        serde_json::json!({ "what": what, "holds": verdict.is_ok(), "text": text })
    };
    let holds = findings.iter().all(|finding| finding.verdict.is_ok());
    let findings: Vec<_> = findings.iter().map(one).collect();
    serde_json::json!({ "format": json::FORMAT, "holds": holds, "findings": findings, "notes": notes })
}

fn page(findings: &[Finding], paint: Paint) -> String {
    let width = findings.iter().map(|finding| finding.what.chars().count()).max().unwrap_or(0);
    let line = |Finding { what, verdict }: &Finding| match verdict {
        Ok(text) => format!("{} {what:<width$}  {text}\n", paint.green("\u{2713}")),
        Err(error) => {
            let line = error.place().line.map(|line| format!("line {line}: ")).unwrap_or_default();
            format!("{} {what:<width$}  {line}{}\n", paint.red("\u{2717}"), error.message())
        }
    };
    findings.iter().map(line).collect()
}
