//! The check of a stored folder. Main function: [`check`].

use std::collections::BTreeSet;

use super::finding::{Finding, Verdict};
use super::measured::{page_differs, table_differs};
use super::names::{CERTIFICATE, CHECKS, OUTPUTS, is_printed_solver};
use super::outputs::Hashes;
use super::proof_text::proof_text;
use super::stored::{Stored, has_mark};
use super::written::{Written, derived};
use super::{motion, names};
use crate::codegen::{c99::Pair, ikfast, rust, single_file};
use crate::derive::problem::ends::TASK_NAME;
use crate::derive::report::stages::{MARK, PAGE};
use crate::derive::{Derivation, Recount, Source};
use crate::solver::Program;
use crate::witness::{self, Report};
use crate::{Error, ErrorKind, Result, Watch};

/// The shortest line of a generated page by which it is recognised, in bytes.
const TELLING: usize = 40;

/// Result of a check, and the derivation that was proved again.
#[derive(Clone, Debug)]
pub struct Checked {
    /// One finding per file; those of the input and the certificate are first.
    pub findings: Vec<Finding>,
    /// The derivation with its numeric checks, if the certificate proves it.
    pub derivation: Option<(Derivation, Report)>,
}

/// Checks every file of a folder with the derivation of `source`, or equations of motion of its chain, or both. Each file that groebot writes must follow from
/// the certificate, byte by byte. The certificate must claim as much as the derivation of the input does. A file with a name that groebot writes must follow
/// from the certificate; other files are reported as not checked.
///
/// # Errors
/// Those of the numeric checks, and those of `watch`. Faults of a file are findings, not errors.
pub fn check<'w>(source: &Source, stored: &Stored, watch: impl Into<Option<&'w Watch>>) -> Result<Checked> {
    let watch = Watch::or_none(watch);
    check_by(source, stored, watch, |proved| witness::check(source, proved, watch))
}

/// Same as [`check`], but with the numeric checks that `measure` makes, for a caller that has already made those of this derivation.
///
/// # Errors
/// Same as [`check`], and those of `measure`.
pub fn check_by<'w>(
    source: &Source,
    stored: &Stored,
    watch: impl Into<Option<&'w Watch>>,
    measure: impl FnOnce(&Derivation) -> Result<Report>,
) -> Result<Checked> {
    let watch = Watch::or_none(watch);
    let mut findings = vec![Finding::holds(source.name, described(source))];
    let mut known: BTreeSet<String> = inputs(source).map(str::to_owned).collect();
    let moving = motion::check(source, stored);
    let is_derived = stored.written().any(|name| !names::MOTION.contains(&name));
    let mut derivation = None;
    // A folder may contain equations of motion alone.
    if is_derived || moving.is_empty() {
        match prove(source, stored, &mut Recount::new(watch)) {
            Ok(proved) => {
                let checked = measure(&proved)?;
                let written = derived(source, &proved, &checked)?;
                findings.extend(compare(stored, &written, &proof_text(&proved), &checked));
                derivation = Some((proved, checked));
            }
            Err(error) => findings.push(Finding { what: CERTIFICATE.to_owned(), verdict: Verdict::Fails(error) }),
        }
    }
    findings.extend(moving);
    known.extend(findings.iter().map(|finding| finding.what.clone()));
    findings.extend(unknown_files(stored, &known, derivation.as_ref().map(|(proved, _)| proved.program())));
    Ok(Checked { findings, derivation })
}

/// The derivation that the stored certificate proves. It must claim as much as that of the input.
///
/// # Errors
/// [`ErrorKind::Io`] if there is no certificate. Otherwise those of [`Derivation::prove_source`] and [`Recount::check`], with the name of the file.
pub fn prove(source: &Source, stored: &Stored, recount: &mut Recount) -> Result<Derivation> {
    let at_file = |error: Error| error.in_file(&stored.folder.join(CERTIFICATE));
    let missing = || {
        let text = "the certificate is missing, so the other files are unproved; `groebot derive` writes it";
        Error::new(ErrorKind::Io, text)
    };
    let bytes = stored.get(CERTIFICATE).ok_or_else(missing).map_err(at_file)?;
    prove_text(source, &String::from_utf8_lossy(bytes), recount).map_err(at_file)
}

/// The derivation that the text of a certificate proves. It must claim as much as that of the input.
///
/// # Errors
/// Same as [`Derivation::prove_source`] and [`Recount::check`].
pub fn prove_text(source: &Source, certificate: &str, recount: &mut Recount) -> Result<Derivation> {
    let proved = Derivation::prove_source(source, certificate)?;
    recount.check(&proved)?;
    Ok(proved.about(source))
}

/// Compares the stored files with those of a derivation, or in a thin folder with their hashes. `proof` describes what the certificate proves.
pub fn compare(stored: &Stored, written: &[Written], proof: &str, checked: &Report) -> Vec<Finding> {
    let first = written.iter().filter(|file| file.name == CERTIFICATE);
    let rest = written.iter().filter(|file| file.name != CERTIFICATE);
    let files = first.chain(rest);
    let Some(text) = stored.get(OUTPUTS) else {
        return files.map(|file| compared(stored, file, proof, checked)).collect();
    };
    let hashes = Hashes::of(&String::from_utf8_lossy(text), written);
    let mut findings: Vec<Finding> = files
        .map(|file| match (hashes.refusal(&file.name), stored.get(&file.name)) {
            (Some(refusal), _) => Finding::refused(&stored.folder, &file.name, refusal),
            (None, None) if hashes.has(&file.name) => Finding::holds(&file.name, hashed_text(&file.name, checked)),
            _ => compared(stored, file, proof, checked),
        })
        .collect();
    findings.push(hashes.finding(stored));
    findings
}

/// The finding for a file that was printed again and has the stored hash.
fn hashed_text(name: &str, checked: &Report) -> String {
    match name {
        CHECKS => check_text(checked) + "; its words and counts have the stored hash",
        _ => "printed again, and has the stored hash".to_owned(),
    }
}

fn compared(stored: &Stored, file: &Written, proof: &str, checked: &Report) -> Finding {
    let name = file.name.as_str();
    let refused = |text: &str| Finding::refused(&stored.folder, name, text);
    let Some(bytes) = stored.get(name) else {
        return Finding::fails(
            &stored.folder,
            name,
            Error::new(ErrorKind::Io, "this file is missing; `groebot derive` writes it"),
        );
    };
    if name == PAGE && !has_mark(bytes) {
        return match is_by_hand(bytes, &file.bytes) {
            true => Finding::not_checked(name, "a page that groebot did not write"),
            false => refused(&format!("the page has neither the proved text nor `{MARK}`; `groebot derive` writes it")),
        };
    }
    let equal = if bytes == file.bytes { "" } else { ", equal up to rounding" };
    match differing(bytes, file) {
        Some(line) => {
            let text = "this line does not follow from the certificate; `groebot derive` writes the correct one";
            let error = Error::new(ErrorKind::Certificate, text).at_line(line);
            Finding::fails(&stored.folder, name, error)
        }
        None if name == CERTIFICATE => Finding::holds(name, proof),
        None if name == CHECKS => Finding::holds(name, check_text(checked) + equal),
        None => Finding::holds(name, format!("follows from the proof{equal}")),
    }
}

/// The first line in which a stored file differs from the written one. `None` if it does not.
fn differing(stored: &[u8], file: &Written) -> Option<usize> {
    if stored == file.bytes {
        return None;
    }
    let (proved, measured) = file.bytes.split_at(file.proved);
    let same = stored.iter().zip(&file.bytes).take_while(|(a, b)| a == b).count();
    let lines = |bytes: &[u8]| bytes.iter().filter(|byte| **byte == b'\n').count();
    if same < proved.len() || measured.is_empty() {
        return Some(lines(&stored[..same]) + 1);
    }
    let Ok(own) = std::str::from_utf8(&stored[proved.len()..]) else { return Some(lines(proved) + 1) };
    let differs = if file.name == CHECKS { table_differs } else { page_differs };
    differs(own, &String::from_utf8_lossy(measured)).map(|line| lines(proved) + line)
}

/// Whether a page without groebot's mark was written by the user: it is not empty and has none of the longer lines of the generated page.
fn is_by_hand(stored: &[u8], ours: &[u8]) -> bool {
    let (stored, ours) = (String::from_utf8_lossy(stored), String::from_utf8_lossy(ours));
    let telling = |line: &&str| line.len() >= TELLING;
    let own: BTreeSet<&str> = ours.lines().filter(telling).collect();
    !stored.trim().is_empty() && !stored.lines().any(|line| own.contains(line))
}

/// Findings for files that are not `known`. Files with names that groebot gives fail. Printed solvers with other names must follow from the program. All others
/// are not checked.
fn unknown_files(stored: &Stored, known: &BTreeSet<String>, program: Option<&Program>) -> Vec<Finding> {
    let ours: BTreeSet<&str> = stored.written().collect();
    let names = stored.files.keys().chain(&stored.others).filter(|name| !known.contains(*name));
    let finding = |name: &String| {
        if !ours.contains(name.as_str()) {
            return Finding::not_checked(name, "not a file of groebot");
        }
        let bytes = stored.get(name).unwrap_or_default();
        match program {
            Some(program) if is_printed_solver(bytes) && prints(program, name, bytes) => {
                Finding::holds(name, "follows from the proof")
            }
            Some(_) => {
                let text = "this file is unproved: this derivation does not write it; move it to another folder";
                Finding::refused(&stored.folder, name, text)
            }
            None => Finding::refused(&stored.folder, name, "this file is unproved: no certificate holds"),
        }
    };
    names.map(finding).collect()
}

/// Whether `groebot derive` or `groebot codegen`, without further options, prints these bytes for `program` into a file `name`.
fn prints(program: &Program, name: &str, bytes: &[u8]) -> bool {
    let (stem, end) = name.rsplit_once('.').unwrap_or((name, ""));
    let is = |text: String| text.as_bytes() == bytes;
    match end {
        "h" => is(Pair::new(program, stem).header),
        "c" => is(Pair::new(program, stem).source) || is(single_file::c(program, name, false)),
        "rs" => is(rust::emit(program)) || is(single_file::rust(program)),
        _ => {
            let alone = ikfast::Options { file: Some(name.to_owned()), ..ikfast::Options::default() };
            let beside = stem.strip_suffix(names::IKFAST_END).unwrap_or(stem);
            let printed =
                [ikfast::emit(program, &alone), ikfast::emit_beside(program, &ikfast::Options::default(), beside)];
            printed.into_iter().flatten().any(is)
        }
    }
}

/// The input files of a derivation.
fn inputs(source: &Source) -> impl Iterator<Item = &str> {
    [source.name, TASK_NAME].into_iter().chain(source.referenced_files())
}

fn described(source: &Source) -> String {
    match (source.chain_by_steps(), &source.system, &source.coupled) {
        (None, Some(system), _) => format!("{} equations in {}", system.equations.len(), system.order.join(", ")),
        (None, None, Some(coupled)) => {
            format!("{} chains on {} actuators", coupled.chains().len(), coupled.actuators().len())
        }
        (chain, ..) => format!("a chain of {} joints", chain.map_or(0, |chain| chain.joints().len())),
    }
}

fn check_text(checked: &Report) -> String {
    let summary = checked.summary();
    match summary.failed {
        0 => format!("{} targets solved again, all correct", summary.rows),
        lost => format!(
            "{} targets solved again; {lost} of them, at or near singular poses, have missing solutions",
            summary.rows
        ),
    }
}
