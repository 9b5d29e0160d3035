//! A [`Document`] as a LaTeX article that needs no package beyond amsmath and geometry.

use super::document::{Document, Line, Part, Span, broken};
use groebot_algebra::poly::latex_name;

/// The maximum length of a line of a displayed formula, in typeset characters.
const WIDTH: usize = 74;
/// The maximum width of a table whose last column has no line breaks, in characters.
const TABLE_WIDTH: usize = 88;
/// The minimum width of the last column, in characters.
const COLUMN: usize = 20;
/// The space between two columns, in characters.
const GAP: usize = 2;

impl Document {
    /// The report as a complete LaTeX article.
    pub fn to_latex(&self) -> String {
        let mut text = String::from(
            "\\documentclass[11pt,a4paper]{article}\n\\usepackage[margin=25mm]{geometry}\n\\usepackage[T1]{fontenc}\n\
             \\usepackage[utf8]{inputenc}\n\\IfFileExists{lmodern.sty}{\\usepackage{lmodern}}{}\n\\usepackage{amsmath}\n\
             \\allowdisplaybreaks\n\\emergencystretch=3em\n\n",
        );
        text += &format!(
            "\\title{{{}}}\n\\author{{}}\n\\date{{}}\n\n\\begin{{document}}\n\\maketitle\n",
            escaped(&self.title)
        );
        self.groups().map(group).for_each(|group| text += &format!("\n{group}\n"));
        text + "\n\\end{document}\n"
    }
}

fn part(part: &Part) -> String {
    match part {
        Part::Section(text) => format!("\\section*{{{}}}", line(text)),
        Part::Paragraph(text) => line(text),
        Part::Equation { number, formula } => equation(number, formula),
        Part::Items(items) => {
            let items: Vec<String> = items.iter().map(|item| format!("\\item {}\n", line(item))).collect();
            format!("\\begin{{itemize}}\n{}\\end{{itemize}}", items.concat())
        }
        Part::Table(rows) => table(rows),
    }
}

/// One part, or consecutive formulas as one `gather*` environment.
fn group(parts: &[Part]) -> String {
    match parts {
        [part @ (Part::Section(_) | Part::Paragraph(_) | Part::Items(_) | Part::Table(_))] => self::part(part),
        [one] => format!("\\begin{{equation*}}\n{}\n\\end{{equation*}}", self::part(one)),
        _ => {
            let lines: Vec<String> = parts.iter().map(part).collect();
            format!("\\begin{{gather*}}\n{}\n\\end{{gather*}}", lines.join(" \\\\\n"))
        }
    }
}

/// A formula with its number as tag. A long formula is split into several lines.
fn equation(number: &str, formula: &str) -> String {
    let lines: Vec<String> = broken(formula, WIDTH, visible).into_iter().map(typeset).collect();
    let tag = if number.is_empty() { String::new() } else { format!(" \\tag{{{}}}", escaped(number)) };
    match lines.as_slice() {
        [one] => format!("{one}{tag}"),
        _ => format!("\\begin{{split}}\n& {}\n\\end{{split}}{tag}", lines.join(" \\\\\n& \\quad ")),
    }
}

/// A table with a rule below the header.
fn table(rows: &[Vec<Line>]) -> String {
    let row = |cells: &Vec<Line>| cells.iter().map(line).collect::<Vec<_>>().join(" & ") + " \\\\\n";
    let columns = columns(rows);
    let mut rows: Vec<String> = rows.iter().map(row).collect();
    rows.insert(rows.len().min(1), "\\hline\\noalign{\\smallskip}\n".to_owned());
    format!(
        "\\begin{{center}}\n\\small\n\\begin{{tabular}}{{{columns}}}\n{}\\end{{tabular}}\n\\end{{center}}",
        rows.concat()
    )
}

/// The column specification. If the table is too wide, the last column gets the remaining width and breaks its lines.
fn columns(rows: &[Vec<Line>]) -> String {
    let count = rows.first().map_or(0, Vec::len);
    let width = |column: usize| rows.iter().filter_map(|row| row.get(column)).map(seen).max().unwrap_or(0) + GAP;
    let others: usize = (0..count.saturating_sub(1)).map(width).sum();
    if count == 0 || others + width(count - 1) <= TABLE_WIDTH {
        return "l".repeat(count);
    }
    let share = TABLE_WIDTH.saturating_sub(others + 2 * GAP).max(COLUMN) as f64 / TABLE_WIDTH as f64;
    format!("{}p{{{share:.2}\\textwidth}}", "l".repeat(count - 1))
}

/// The approximate number of printed characters of a line.
fn seen(line: &Line) -> usize {
    let span = |span: &Span| match span {
        Span::Words(text) | Span::Name(text) => text.chars().count(),
        Span::Formula(text) => visible(text),
    };
    line.0.iter().map(span).sum()
}

fn line(line: &Line) -> String {
    let span = |span: &Span| match span {
        Span::Words(text) => escaped(text),
        Span::Name(text) => format!("\\texttt{{{}}}", escaped(text)),
        Span::Formula(text) => format!("${}$", typeset(text).replace(", ", ", \\allowbreak ")),
    };
    line.0.iter().map(span).collect()
}

/// Text with LaTeX's special characters escaped.
fn escaped(text: &str) -> String {
    let escape = |c: char| match c {
        '\\' => "\\textbackslash{}".to_owned(),
        '~' => "\\textasciitilde{}".to_owned(),
        '^' => "\\textasciicircum{}".to_owned(),
        '{' | '}' | '$' | '&' | '#' | '%' | '_' => format!("\\{c}"),
        _ => c.to_string(),
    };
    text.chars().map(escape).collect()
}

/// The approximate number of printed characters of a formula.
fn visible(formula: &str) -> usize {
    formula.chars().filter(|c| !"*^{}".contains(*c)).count()
}

/// A formula in the notation of the stage files, converted to LaTeX mathematics.
pub(super) fn typeset(formula: &str) -> String {
    let mut rest = formula;
    let mut text = String::new();
    while let Some(c) = rest.chars().next() {
        let (length, latex) = token(rest, c);
        text += &latex;
        rest = &rest[length..];
    }
    text
}

/// The length of the first token of a non-empty formula, and its LaTeX.
fn token(rest: &str, c: char) -> (usize, String) {
    let run = |test: fn(char) -> bool| rest.find(|c| !test(c)).unwrap_or(rest.len());
    if let Some(inner) = rest.strip_prefix("sqrt(").and_then(enclosed) {
        return ("sqrt()".len() + inner.len(), format!("\\sqrt{{{}}}", typeset(inner)));
    }
    for (plain, latex) in
        [(" . ", " \\cdot "), ("...", "\\cdots "), ("+-", "\\pm "), ("<=", "\\leq "), ("!=", "\\neq ")]
    {
        if rest.starts_with(plain) {
            return (plain.len(), latex.to_owned());
        }
    }
    match c {
        'a'..='z' | 'A'..='Z' => {
            let length = run(|c| c.is_ascii_alphanumeric() || c == '_');
            (length, name(&rest[..length]))
        }
        '^' => {
            let sign = usize::from(rest[1..].starts_with('-'));
            let digits = rest[1 + sign..].find(|c: char| !c.is_ascii_digit()).unwrap_or(rest.len() - 1 - sign);
            (1 + sign + digits, format!("^{{{}}}", &rest[1..1 + sign + digits]))
        }
        '*' if rest[1..].starts_with(|c: char| c.is_ascii_digit()) => (1, " \\cdot ".to_owned()),
        '*' => (1, "\\,".to_owned()),
        '{' | '}' | '_' | '%' | '&' | '#' | '$' => (1, format!("\\{c}")),
        '\\' => (1, "\\backslash ".to_owned()),
        '~' => (1, "\\sim ".to_owned()),
        _ => (c.len_utf8(), c.to_string()),
    }
}

/// The text before the closing parenthesis.
fn enclosed(text: &str) -> Option<&str> {
    let mut depth = 1;
    for (at, c) in text.char_indices() {
        match c {
            '(' => depth += 1,
            ')' => depth -= 1,
            _ => {}
        }
        if depth == 0 {
            return Some(&text[..at]);
        }
    }
    None
}

fn name(name: &str) -> String {
    match name {
        "cphi" => "c_{\\varphi}".to_owned(),
        "sphi" => "s_{\\varphi}".to_owned(),
        "atan2" | "cos" | "sin" | "moment" | "branch" => format!("\\operatorname{{{name}}}"),
        "Ei" | "En" => format!("E_{{{}}}", &name[1..]),
        "terms" => "\\ \\text{terms}".to_owned(),
        "px" | "py" | "pz" | "dx" | "dy" | "dz" => format!("{}_{{{}}}", &name[..1], &name[1..]),
        _ => latex_name(name),
    }
}
