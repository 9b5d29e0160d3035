//! A [`Document`] as Markdown that is easy to read in a terminal: formulas are plain text. Also as plain text, without code spans and escapes.

use groebot_algebra::escape::{line, markdown};

use super::document::{Document, Line, Part, Span, broken};

/// The maximum length of a line of a displayed formula, in characters.
const WIDTH: usize = 100;

impl Document {
    /// The report as Markdown.
    pub fn to_markdown(&self) -> String {
        Printer { is_plain: false }.document(self)
    }

    /// The report as plain text, for a stage file.
    pub fn to_text(&self) -> String {
        Printer { is_plain: true }.document(self)
    }
}

/// A printer of text: unchanged, or escaped and with code spans.
struct Printer {
    is_plain: bool,
}

impl Printer {
    fn document(&self, document: &Document) -> String {
        let mut text = format!("# {}\n", self.words(&document.title));
        for group in document.groups() {
            let lines: Vec<String> = group.iter().map(|part| self.part(part)).collect();
            text += &format!("\n{}\n", lines.join("\n"));
        }
        text
    }

    fn part(&self, part: &Part) -> String {
        match part {
            Part::Section(text) => format!("## {}", self.line(text)),
            Part::Paragraph(text) => self.line(text),
            Part::Equation { number, formula } => equation(number, formula),
            Part::Items(items) => {
                items.iter().map(|item| format!("* {}", self.line(item))).collect::<Vec<_>>().join("\n")
            }
            Part::Table(rows) => self.table(rows),
        }
    }

    fn table(&self, rows: &[Vec<Line>]) -> String {
        let row = |cells: &Vec<Line>| {
            let cells: Vec<String> = cells.iter().map(|cell| self.line(cell).replace('|', "\\|")).collect();
            format!("| {} |", cells.join(" | "))
        };
        let mut lines: Vec<String> = rows.iter().map(row).collect();
        let columns = rows.first().map_or(0, Vec::len);
        lines.insert(lines.len().min(1), format!("|{}", " --- |".repeat(columns)));
        lines.join("\n")
    }

    fn line(&self, line: &Line) -> String {
        let span = |span: &Span| match span {
            Span::Words(text) => self.words(text),
            Span::Name(text) | Span::Formula(text) => self.code(text),
        };
        line.0.iter().map(span).collect()
    }

    fn code(&self, text: &str) -> String {
        match (self.is_plain, text.contains('`')) {
            (true, _) => line(text).into_owned(),
            (false, true) => format!("`` {text} ``"),
            (false, false) => format!("`{text}`"),
        }
    }

    /// The text, escaped in Markdown. Keeps spaces at both ends.
    fn words(&self, text: &str) -> String {
        if self.is_plain {
            return line(text).into_owned();
        }
        let trimmed = text.trim();
        text.replacen(trimmed, &markdown(trimmed), 1)
    }
}

/// An indented formula after its number.
fn equation(number: &str, formula: &str) -> String {
    let label = if number.is_empty() { String::new() } else { format!("({number})  ") };
    let lines = broken(formula, WIDTH, |text| text.chars().count());
    let indent = " ".repeat(label.chars().count() + 2);
    format!("    {label}{}", lines.join(&format!("\n    {indent}")))
}
