//! `groebot explain`: an explanation of the derivation for students, as Markdown or LaTeX.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::ends::{EndArguments, TipLink};
use super::files::is_derived;
use super::json::FORMAT;
use super::named::CacheArguments;
use super::output::{Force, Kind};
use super::{Outcome, console, json};
use crate::Watch;
use groebot_ik::derive::report::explain::{Document, Line, Part, Span, explain};
use groebot_ik::derive::{Derivation, Ends, Source};
use groebot_ik::folder;
use groebot_robot::model::ReadOptions;

const EXAMPLES: &str = "Examples:
  groebot explain derivations/puma
  groebot explain derivations/puma --latex -o puma.tex && pdflatex puma.tex
  groebot explain arm.toml                      derives it first";

/// Explains a derivation step by step: its equations, cancellations, bases, branches and singularities
///
/// For a folder the stored proof is checked again, as by `groebot check`, and its derivation is explained; a file is
/// derived first.
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// A folder that `groebot derive` wrote, an input file, or a robot's name (`groebot robots`)
    #[arg(value_name = "DERIVATION")]
    input: PathBuf,
    #[command(flatten)]
    cache: CacheArguments,
    #[command(flatten)]
    ends: EndArguments,
    /// Print LaTeX instead of Markdown: an article that needs only amsmath and geometry
    #[arg(long, conflicts_with = "json")]
    latex: bool,
    /// Print JSON instead of Markdown: title, sections, paragraphs, formulas, lists and tables
    #[arg(long)]
    json: bool,
    /// The output file (default: standard output)
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
    #[command(flatten)]
    force: Force,
}

/// Proves, explains, prints.
pub fn run(arguments: &Arguments) -> Outcome {
    let output = arguments.force.output([arguments.input.as_path()]).expects([arguments.output.as_ref()])?;
    let derivation = arguments.cache.derivation(&arguments.input)?;
    let (source, mut document) =
        proved_document(derivation.path(), &arguments.ends.ends()?, &arguments.ends.options())?;
    if !arguments.json {
        console::print_notes(&source.notes);
    }
    // A stored proof has its own tip link.
    let tip = TipLink::of_source(&source).filter(|_| !is_derived(derivation.path()));
    document.parts.splice(..0, tip.as_ref().and_then(TipLink::paragraph));
    let (kind, text) = match (arguments.latex, arguments.json) {
        (true, _) => (Kind::Lines("%"), document.to_latex()),
        (_, true) => (Kind::Json, json::text(&page(&document, &source.notes))),
        _ => (Kind::Markup, document.to_markdown()),
    };
    match &arguments.output {
        None => console::print(&text),
        Some(path) => output.write(path, kind, text),
    }
}

/// The document as JSON; formulas in text are between dollar signs.
fn page(document: &Document, notes: &[String]) -> Value {
    let lines = |lines: &[Line]| lines.iter().map(line).collect::<Vec<_>>();
    let part = |part: &Part| match part {
        Part::Section(title) => json!({ "kind": "section", "text": line(title) }),
        Part::Paragraph(text) => json!({ "kind": "paragraph", "text": line(text) }),
        Part::Equation { number, formula } => {
            json!({ "kind": "formula", "number": Some(number).filter(|number| !number.is_empty()), "formula": formula })
        }
        Part::Items(items) => json!({ "kind": "list", "items": lines(items) }),
        Part::Table(rows) => {
            json!({ "kind": "table", "rows": rows.iter().map(|row| lines(row)).collect::<Vec<_>>() })
        }
    };
    json!({
        "format": FORMAT,
        "title": document.title,
        "parts": document.parts.iter().map(part).collect::<Vec<_>>(),
        "notes": notes,
    })
}

fn line(line: &Line) -> String {
    let text = |span: &Span| match span {
        Span::Words(text) | Span::Name(text) => text.clone(),
        Span::Formula(text) => format!("${text}$"),
    };
    line.0.iter().map(text).collect()
}

/// The report of the derivation in a folder or from a file.
///
/// # Errors
/// As [`Source::read`], [`folder::reprove`] and [`explain`].
pub(super) fn document(input: &Path) -> crate::Result<Document> {
    proved_document(input, &Ends::default(), &ReadOptions::from_environment()).map(|(_, document)| document)
}

fn proved_document(input: &Path, ends: &Ends, options: &ReadOptions) -> crate::Result<(Source, Document)> {
    let mut source = Source::read_with(input, ends, options)?;
    source.choose_given(&Watch::none())?;
    let document = explain(&prove(input, &source)?)?;
    Ok((source, document))
}

/// From the stored proof where there is one.
fn prove(input: &Path, source: &Source) -> crate::Result<Derivation> {
    match is_derived(input) {
        true => folder::reprove(input, source),
        false => Derivation::of(source, &Watch::none()).map_err(|error| error.in_file(&source.path)),
    }
}
