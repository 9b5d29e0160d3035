//! What a report is made of, whatever it is printed as. Main type: [`Document`].
//!
//! A formula is plain text in the notation of the stage files, `A*c1 + B*s1 = 0`; [`super::latex`] typesets it.

/// A stage of a derivation: a part of its report with a file of its own.
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
    /// Its heading.
    pub title: String,
    /// Its text, in order.
    pub parts: Vec<Part>,
}

/// A piece of a report.
#[derive(Clone, Debug, PartialEq)]
pub enum Part {
    /// A heading.
    Section(Line),
    /// A paragraph.
    Paragraph(Line),
    /// A formula on a line of its own, with its number: `3.1`.
    Equation {
        /// The number, without parentheses; empty for none.
        number: String,
        /// What holds.
        formula: String,
    },
    /// A list.
    Items(Vec<Line>),
    /// Cells by rows, the head first.
    Table(Vec<Vec<Line>>),
}

/// A piece of a line.
#[derive(Clone, Debug, PartialEq)]
pub enum Span {
    /// Words.
    Words(String),
    /// A name as the user wrote it, or a command.
    Name(String),
    /// A formula.
    Formula(String),
}

/// Text without a break of paragraph.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Line(pub Vec<Span>);

impl Line {
    /// Our own prose, in which formulas are between dollars: `where $A = B = 0$`.
    pub fn of(prose: &str) -> Self {
        Line::default().and(prose)
    }

    /// Somebody else's words, taken as they are.
    pub fn plain(text: &str) -> Self {
        Line::default().words(text)
    }

    /// With somebody else's words, taken as they are.
    #[must_use]
    pub fn words(mut self, text: &str) -> Self {
        self.0.push(Span::Words(text.to_owned()));
        self
    }

    /// With more of our own prose.
    #[must_use]
    pub fn and(mut self, prose: &str) -> Self {
        for (index, piece) in prose.split('$').enumerate().filter(|(_, piece)| !piece.is_empty()) {
            let piece = piece.to_owned();
            self.0.push(if index % 2 == 0 { Span::Words(piece) } else { Span::Formula(piece) });
        }
        self
    }

    /// With a name.
    #[must_use]
    pub fn name(mut self, name: &str) -> Self {
        self.0.push(Span::Name(name.to_owned()));
        self
    }

    /// With a formula.
    #[must_use]
    pub fn formula(mut self, text: &str) -> Self {
        self.0.push(Span::Formula(text.to_owned()));
        self
    }
}

impl Part {
    /// Whether it is a formula that stands alone.
    fn is_equation(&self) -> bool {
        matches!(self, Part::Equation { .. })
    }
}

impl Document {
    /// The parts, formulas that follow one another together.
    pub(super) fn groups(&self) -> impl Iterator<Item = &[Part]> {
        self.parts.chunk_by(|a, b| a.is_equation() && b.is_equation())
    }

    /// An empty report.
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
    pub fn section(&mut self, line: Line) {
        self.parts.push(Part::Section(line));
    }

    /// Adds a paragraph of our own prose, see [`Line::of`].
    pub fn say(&mut self, prose: &str) {
        self.paragraph(Line::of(prose));
    }

    /// Adds a paragraph.
    pub fn paragraph(&mut self, line: Line) {
        self.parts.push(Part::Paragraph(line));
    }

    /// Adds a formula without a number.
    pub fn display(&mut self, formula: impl Into<String>) {
        self.equation("", formula);
    }

    /// Adds a numbered formula.
    pub fn equation(&mut self, number: &str, formula: impl Into<String>) {
        self.parts.push(Part::Equation { number: number.to_owned(), formula: formula.into() });
    }

    /// Adds a list.
    pub fn items(&mut self, lines: Vec<Line>) {
        if !lines.is_empty() {
            self.parts.push(Part::Items(lines));
        }
    }

    /// Adds a table, the head first.
    pub fn table(&mut self, rows: Vec<Vec<Line>>) {
        self.parts.push(Part::Table(rows));
    }
}

/// `formula` in lines of at most about `width`, as `measure` sees them: broken before ` + `, ` - ` and ` = ` that stand under no root.
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
