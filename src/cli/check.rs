//! `groebot check`: proves the derivation again from the stored certificate, and compares every file of the folder.

use std::path::PathBuf;

use super::console::{self, Paint};
use super::derive::refuse_failures;
use super::ends::EndArguments;
use super::{Halt, Outcome, json};
use crate::Watch;
use groebot_ik::derive::Source;
use groebot_ik::folder::{self, CHECKS, Checked, Finding, Stored, Verdict};
use groebot_robot::document::shown;

/// Proves a stored derivation again, without the Groebner engine, and compares every file of its folder with the proved
/// result
///
/// Ends with status 1 and names the file if a proof is forged, damaged or weaker than that of `groebot derive`. The
/// same holds for a file that differs from the proved result. Files that groebot did not write are listed as not
/// checked. In a thin folder (`derive --thin`) each output is generated again and compared by its hash.
#[derive(clap::Args)]
#[command(after_help = "Example:\n  groebot check derivations/nao_leg_sagittal")]
pub struct Arguments {
    /// A folder that `groebot derive` or `groebot dynamics --symbolic` wrote
    derivation: PathBuf,
    #[command(flatten)]
    ends: EndArguments,
    /// Print JSON instead of text
    #[arg(long)]
    json: bool,
}

/// Runs all checks.
pub fn run(arguments: &Arguments) -> Outcome {
    let folder = arguments.derivation.as_path();
    let source = Source::read_with(folder, &arguments.ends.ends()?, &arguments.ends.options())?;
    let stored = Stored::read(folder)?;
    let Checked { mut findings, derivation, .. } = folder::check(&source, &stored, &Watch::none())?;
    if let Some((derivation, checked)) = &derivation
        && let Err(error) = refuse_failures(&source, derivation, checked, false)
    {
        findings.retain(|finding| finding.what != CHECKS);
        findings.push(Finding::fails(folder, CHECKS, error));
    }
    if arguments.json {
        console::print(&json::text(&findings_json(&findings, &source.notes)))?;
    } else {
        console::print_notes(&source.notes);
        console::print(&page(&findings, Paint::of(&std::io::stdout())))?;
    }
    match findings.iter().find_map(Finding::error) {
        None => Ok(()),
        Some(first) => Err(Halt::Error(first.clone())),
    }
}

/// All findings as JSON; files that groebot did not write have `null` for the result.
fn findings_json(findings: &[Finding], notes: &[String]) -> serde_json::Value {
    let one = |Finding { what, verdict, .. }: &Finding| {
        let (holds, text) = match verdict {
            Verdict::Holds(text) => (Some(true), text.clone()),
            Verdict::Fails(error) => (Some(false), error.to_string()),
            Verdict::NotChecked(text) => (None, text.clone()),
        };
        serde_json::json!({ "item": what, "passed": holds, "text": text })
    };
    let holds = findings.iter().all(|finding| finding.error().is_none());
    let findings: Vec<_> = findings.iter().map(one).collect();
    serde_json::json!({ "format": json::FORMAT, "passed": holds, "findings": findings, "notes": notes })
}

fn page(findings: &[Finding], paint: Paint) -> String {
    let width = findings.iter().map(|finding| finding.what.chars().count()).max().unwrap_or(0);
    let line = |Finding { what, verdict, .. }: &Finding| match verdict {
        Verdict::Holds(text) => format!("{} {what:<width$}  {text}\n", paint.green("\u{2713}")),
        Verdict::NotChecked(text) => format!("- {:<width$}  not checked: {text}\n", shown(what)),
        Verdict::Fails(error) => {
            let line = error.place().line.map(|line| format!("line {line}: ")).unwrap_or_default();
            format!("{} {what:<width$}  {line}{}\n", paint.red("\u{2717}"), error.message())
        }
    };
    findings.iter().map(line).collect()
}
