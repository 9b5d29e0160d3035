//! A [`Document`] as Markdown that is also readable in a terminal: formulas are plain text.

use groebot_algebra::escape::markdown;

use super::document::{Document, Line, Part, Span, broken};

/// The maximum length of a line of a displayed formula, in characters.
const WIDTH: usize = 100;

impl Document {
    /// The report as Markdown.
    pub fn to_markdown(&self) -> String {
        let mut text = format!("# {}\n", escaped(&self.title));
        for group in self.groups() {
            let lines: Vec<String> = group.iter().map(part).collect();
            text += &format!("\n{}\n", lines.join("\n"));
        }
        text
    }
}

fn part(part: &Part) -> String {
    match part {
        Part::Section(text) => format!("## {}", line(text)),
        Part::Paragraph(text) => line(text),
        Part::Equation { number, formula } => equation(number, formula),
        Part::Items(items) => items.iter().map(|item| format!("* {}", line(item))).collect::<Vec<_>>().join("\n"),
        Part::Table(rows) => table(rows),
    }
}

/// An indented formula after its number.
fn equation(number: &str, formula: &str) -> String {
    let label = if number.is_empty() { String::new() } else { format!("({number})  ") };
    let lines = broken(formula, WIDTH, |text| text.chars().count());
    let indent = " ".repeat(label.chars().count() + 2);
    format!("    {label}{}", lines.join(&format!("\n    {indent}")))
}

fn table(rows: &[Vec<Line>]) -> String {
    let row = |cells: &Vec<Line>| {
        let cells: Vec<String> = cells.iter().map(|cell| line(cell).replace('|', "\\|")).collect();
        format!("| {} |", cells.join(" | "))
    };
    let mut lines: Vec<String> = rows.iter().map(row).collect();
    let columns = rows.first().map_or(0, Vec::len);
    lines.insert(lines.len().min(1), format!("|{}", " --- |".repeat(columns)));
    lines.join("\n")
}

fn line(line: &Line) -> String {
    let span = |span: &Span| match span {
        Span::Words(text) => escaped(text),
        Span::Name(text) | Span::Formula(text) => code(text),
    };
    line.0.iter().map(span).collect()
}

fn code(text: &str) -> String {
    if text.contains('`') { format!("`` {text} ``") } else { format!("`{text}`") }
}

/// Escapes the text, but keeps spaces at both ends.
fn escaped(text: &str) -> String {
    let trimmed = text.trim();
    text.replacen(trimmed, &markdown(trimmed), 1)
}
