//! The parts of a report, independent of the output format. Main type: [`Document`].
//!
//! A formula is plain text in the notation of the stage files, `A*c1 + B*s1 = 0`. [`super::latex`] typesets it.

/// A stage of a derivation: a part of its report with a separate file.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// The equations.
    Equations,
    /// The order of the unknowns or of the joints.
    Plan,
    /// The Groebner bases on all strata, with their proofs.
    Basis,
    /// The formulas, one unknown after the other.
    Triangular,
}

impl Stage {
    /// Whether the report of `requested`, or of all stages, contains this one.
    pub(in crate::derive) fn is_in(self, requested: Option<Stage>) -> bool {
        requested.is_none_or(|requested| requested == self)
    }
}

/// A report.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// The title.
    pub title: String,
    /// The parts, in order.
    pub parts: Vec<Part>,
}

/// A part of a report.
#[derive(Clone, Debug, PartialEq)]
pub enum Part {
    /// A heading.
    Section(Line),
    /// A paragraph.
    Paragraph(Line),
    /// A formula on a separate line, with its number, such as `3.1`.
    Equation {
        /// The number without parentheses; empty for no number.
        number: String,
        /// The formula.
        formula: String,
    },
    /// A list.
    Items(Vec<Line>),
    /// A table: cells by rows, the header first.
    Table(Vec<Vec<Line>>),
}

/// A part of a line.
#[derive(Clone, Debug, PartialEq)]
pub enum Span {
    /// Plain text.
    Words(String),
    /// A name as the user wrote it, or a command.
    Name(String),
    /// A formula.
    Formula(String),
}

/// Text without a paragraph break.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Line(pub Vec<Span>);

impl Line {
    /// A line of report text, whose formulas are between dollar signs: `where $A = B = 0$`.
    #[doc(hidden)]
    pub fn of(prose: &str) -> Self {
        Line::default().and(prose)
    }

    /// A line of text from the input, used unchanged.
    #[doc(hidden)]
    pub fn plain(text: &str) -> Self {
        Line::default().words(text)
    }

    /// Appends text from the input, unchanged.
    #[must_use]
    pub fn words(mut self, text: &str) -> Self {
        self.0.push(Span::Words(text.to_owned()));
        self
    }

    /// Appends report text, as in [`Line::of`].
    #[must_use]
    #[doc(hidden)]
    pub fn and(mut self, prose: &str) -> Self {
        for (index, piece) in prose.split('$').enumerate().filter(|(_, piece)| !piece.is_empty()) {
            let piece = piece.to_owned();
            self.0.push(if index % 2 == 0 { Span::Words(piece) } else { Span::Formula(piece) });
        }
        self
    }

    /// Appends a name.
    #[must_use]
    #[doc(hidden)]
    pub fn name(mut self, name: &str) -> Self {
        self.0.push(Span::Name(name.to_owned()));
        self
    }

    /// Appends a formula.
    #[must_use]
    #[doc(hidden)]
    pub fn formula(mut self, text: &str) -> Self {
        self.0.push(Span::Formula(text.to_owned()));
        self
    }
}

impl Line {
    /// The text without marks of names and formulas.
    pub(in crate::derive) fn to_plain(&self) -> String {
        let text = |span: &Span| match span {
            Span::Words(text) | Span::Name(text) | Span::Formula(text) => text.clone(),
        };
        self.0.iter().map(text).collect()
    }
}

impl Part {
    /// Whether the part is a formula on a separate line.
    fn is_equation(&self) -> bool {
        matches!(self, Part::Equation { .. })
    }
}

impl Document {
    /// The parts, with consecutive formulas grouped.
    pub(super) fn groups(&self) -> impl Iterator<Item = &[Part]> {
        self.parts.chunk_by(|a, b| a.is_equation() && b.is_equation())
    }

    /// An empty report.
    #[doc(hidden)]
    pub fn new(title: &str) -> Self {
        Document { title: title.to_owned(), parts: Vec::new() }
    }

    /// The empty report of a stage, or of all stages, of the derivation for the mechanism `name`.
    pub(in crate::derive) fn of(name: &str, stage: Option<Stage>) -> Self {
        let about = match stage {
            None => "its inverse kinematics, explained",
            Some(Stage::Equations) => "equations",
            Some(Stage::Plan) => "plan",
            Some(Stage::Basis) => "Groebner bases with proofs",
            Some(Stage::Triangular) => "one unknown at a time",
        };
        Document::new(&format!("{name}: {about}"))
    }

    /// Adds a heading.
    pub(crate) fn section(&mut self, line: Line) {
        self.parts.push(Part::Section(line));
    }

    /// Adds a paragraph of report text, as in [`Line::of`].
    pub(crate) fn text(&mut self, prose: &str) {
        self.paragraph(Line::of(prose));
    }

    /// Adds a paragraph.
    #[doc(hidden)]
    pub fn paragraph(&mut self, line: Line) {
        self.parts.push(Part::Paragraph(line));
    }

    /// Adds a formula without a number.
    pub(crate) fn display(&mut self, formula: impl Into<String>) {
        self.equation("", formula);
    }

    /// Adds a numbered formula.
    #[doc(hidden)]
    pub fn equation(&mut self, number: &str, formula: impl Into<String>) {
        self.parts.push(Part::Equation { number: number.to_owned(), formula: formula.into() });
    }

    /// Adds a list.
    #[doc(hidden)]
    pub fn items(&mut self, lines: Vec<Line>) {
        if !lines.is_empty() {
            self.parts.push(Part::Items(lines));
        }
    }

    /// Adds a table, the header first.
    #[doc(hidden)]
    pub fn table(&mut self, rows: Vec<Vec<Line>>) {
        self.parts.push(Part::Table(rows));
    }
}

/// `formula` split into lines of at most about `width`, as measured by `measure`. Lines start at ` + `, ` - ` and ` = ` outside of roots.
pub fn broken(formula: &str, width: usize, measure: impl Fn(&str) -> usize) -> Vec<&str> {
    let (mut lines, mut start, mut last) = (Vec::new(), 0, None);
    let mut roots: Vec<bool> = Vec::new();
    for (at, c) in formula.char_indices() {
        match c {
            '(' => roots.push(formula[..at].ends_with("sqrt")),
            ')' => drop(roots.pop()),
            '+' | '-' | '=' if formula[..at].ends_with(' ') && formula[at + 1..].starts_with(' ') => {
                if let Some(cut) = last.filter(|_| measure(&formula[start..at]) > width) {
                    lines.push(formula[start..cut].trim());
                    start = cut;
                }
                last = (!roots.contains(&true) && at > start).then_some(at).or(last);
            }
            _ => {}
        }
    }
    if let Some(cut) = last.filter(|cut| *cut > start && measure(&formula[start..]) > width) {
        lines.push(formula[start..cut].trim());
        start = cut;
    }
    lines.push(formula[start..].trim());
    lines
}
