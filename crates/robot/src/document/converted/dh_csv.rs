//! Denavit-Hartenberg tables as CSV. Main function: [`to_toml`].
//!
#![doc = include_str!("../../../docs/dh_csv.md")]

use std::f64::consts::PI;
use std::fmt::Write;

use crate::document::{one_among, shown, unix_lines};
use crate::{Error, ErrorKind, Result};

/// The columns, each with other names of it.
const COLUMNS: [(&str, &[&str]); 9] = [
    ("name", &["joint", "link", "i"]),
    ("type", &["kind"]),
    ("theta", &["θ"]),
    ("d", &[]),
    ("a", &["r"]),
    ("alpha", &["α"]),
    ("offset", &[]),
    ("lower", &["min", "qmin"]),
    ("upper", &["max", "qmax"]),
];
/// The columns with lengths, with angles, and with values in the unit of the joint.
const LENGTHS: [&str; 2] = ["d", "a"];
const ANGLES: [&str; 2] = ["theta", "alpha"];
/// The words for the types of joints.
const TYPES: [(&str, &str); 6] = [
    ("revolute", "revolute"),
    ("r", "revolute"),
    ("rotational", "revolute"),
    ("prismatic", "prismatic"),
    ("p", "prismatic"),
    ("linear", "prismatic"),
];
const KEYS: [&str; 4] = ["convention", "name", "source", "task"];

/// The columns of the parameters.
const PARAMETERS: [&str; 4] = ["theta", "d", "a", "alpha"];
/// The separators of cells. A table with the second or the third one may have decimal commas.
const SEPARATORS: [char; 3] = [',', ';', '\t'];

/// Whether `text` is a table with the columns `a` and `alpha`, or with three of the four parameters. Units and other columns are not checked.
pub fn is_dh_csv(text: &str) -> bool {
    let header = text.lines().find(|line| !is_blank(line) && remark(line).is_none());
    let Some(header) = header.filter(|line| line.contains(SEPARATORS) && !line.contains('=')) else { return false };
    let names: Vec<&str> = cells(header, separator(header)).filter_map(|cell| known(&words(&cell)).ok()).collect();
    let has = |name: &&&str| names.contains(*name);
    PARAMETERS.iter().filter(has).count() > 2 || ["a", "alpha"].iter().filter(has).count() == 2
}

/// Whether a character is a separator, a blank or a quotation mark.
fn is_filling(c: char) -> bool {
    SEPARATORS.contains(&c) || c == '"' || c.is_whitespace()
}

/// Whether a row has no cell with a value.
fn is_blank(line: &str) -> bool {
    line.chars().all(is_filling)
}

/// The text of a line with a remark. A spreadsheet may quote it.
fn remark(line: &str) -> Option<&str> {
    line.trim_start_matches(is_filling).strip_prefix('#')
}

/// The separator of a table with this first row.
fn separator(header: &str) -> char {
    let count = |separator: &char| header.matches(*separator).count();
    SEPARATORS.into_iter().rev().max_by_key(count).unwrap_or(',')
}

/// The table as TOML in the format of [`crate::kinematics::dh_toml`]. A row has the same line number in both.
///
/// # Errors
/// With the line: [`ErrorKind::MissingKey`] without `# convention:` or a needed column; [`ErrorKind::UnknownKey`] for another column; [`ErrorKind::BadValue`] for
/// rows with another number of cells, mixed units, and values that are not allowed.
pub fn to_toml(text: &str) -> Result<String> {
    let text = unix_lines(text);
    let mut written = String::new();
    let mut table: Option<Header> = None;
    let mut about = About::default();
    for (number, line) in (1..).zip(text.lines()) {
        let line = line.trim();
        let at_line = |error: Error| error.at_line(number);
        match (&table, remark(line)) {
            (_, Some(remark)) => {
                about.read(remark);
                written += "#";
                written += remark;
            }
            (_, None) if is_blank(line) => {}
            (None, None) => {
                table = Some(Header::read(line).map_err(at_line)?);
                written += "joint = [";
            }
            (Some(header), None) => written += &header.row(line).map_err(at_line)?,
        }
        written.push('\n');
    }
    let header = table.ok_or_else(|| Error::new(ErrorKind::Syntax, "there is no row with the names of columns"))?;
    Ok(written + "]\n" + &about.to_toml(&header)?)
}

/// What the remarks say of the whole table.
#[derive(Default)]
struct About {
    values: [Option<String>; KEYS.len()],
}

impl About {
    /// Reads `key: value`, if the key is one of a table.
    fn read(&mut self, remark: &str) {
        let Some((key, value)) = remark.split_once([':', '=']) else { return };
        if let Some(place) = KEYS.iter().position(|own| own.eq_ignore_ascii_case(key.trim())) {
            // Spreadsheets write the separators of empty cells.
            self.values[place] = Some(value.trim_matches(is_filling).to_owned());
        }
    }

    fn to_toml(&self, header: &Header) -> Result<String> {
        let [convention, name, source, task] = &self.values;
        let convention = convention.as_ref().ok_or_else(|| {
            let text = "add the line `# convention: standard` (Rz Tz Tx Rx; Paul) or `# convention: modified` (Rx Tx Rz Tz; Craig)";
            Error::new(ErrorKind::MissingKey, text)
        })?;
        let mut text = format!("name = {}\n", quoted(name.as_deref().unwrap_or("dh_table")));
        if let Some(source) = source {
            let _ = writeln!(text, "source = {}", quoted(source));
        }
        if let Some(task) = task {
            let _ = writeln!(text, "task = {{ kind = {} }}", quoted(task));
        }
        let _ = writeln!(text, "length_unit = {}\nangle_unit = {}", quoted(header.length), quoted(header.angle));
        let _ = writeln!(text, "dh = {{ convention = {} }}", quoted(&convention.to_lowercase()));
        Ok(text)
    }
}

/// A column with its unit.
struct Column {
    name: &'static str,
    unit: Option<&'static str>,
}

impl Column {
    /// Reads a name such as `theta`, `theta_deg`, `theta [deg]` or `d (mm)`.
    fn read(cell: &str) -> Result<Self> {
        let words = words(cell);
        let names: Vec<&str> = COLUMNS.iter().map(|(name, _)| *name).collect();
        let name = known(&words).map_err(|word| {
            Error::new(ErrorKind::UnknownKey, format!("unknown column `{}`{}", shown(cell), one_among(word, &names)))
        })?;
        let unit = words.get(1).map(|unit| ["m", "mm", "rad", "deg"].into_iter().find(|own| own == unit));
        let wrong = || {
            let text = format!("column `{}` has an unknown unit; give m, mm, rad or deg", shown(cell));
            Error::new(ErrorKind::BadValue, text)
        };
        Ok(Column { name, unit: unit.map(|unit| unit.ok_or_else(wrong)).transpose()? })
    }
}

/// The words of a column's name, in lower case: the name, and the unit.
fn words(cell: &str) -> Vec<String> {
    let plain = cell.to_lowercase().replace(['[', ']', '(', ')', '_', ' '], " ");
    plain.split_whitespace().map(str::to_owned).collect()
}

/// The column with the first of these words; otherwise this word.
fn known(words: &[String]) -> std::result::Result<&'static str, &str> {
    let word = words.first().map_or("", String::as_str);
    let found = COLUMNS.iter().find(|(name, others)| *name == word || others.contains(&word));
    found.map(|(name, _)| *name).ok_or(word)
}

/// The columns of a table, and its units.
struct Header {
    separator: char,
    columns: Vec<Column>,
    length: &'static str,
    angle: &'static str,
}

impl Header {
    fn read(line: &str) -> Result<Self> {
        let separator = separator(line);
        let columns = cells(line, separator).map(|cell| Column::read(&cell)).collect::<Result<Vec<_>>>()?;
        for (place, column) in columns.iter().enumerate() {
            if columns[..place].iter().any(|other| other.name == column.name) {
                return Err(Error::new(ErrorKind::DuplicateName, format!("the column `{}` occurs twice", column.name)));
            }
        }
        let length = unit(&columns, &LENGTHS, ["m", "mm"])?;
        let angle = unit(&columns, &ANGLES, ["rad", "deg"])?;
        Ok(Header { separator, columns, length, angle })
    }

    /// A row as an inline table of TOML.
    fn row(&self, line: &str) -> Result<String> {
        let values: Vec<String> = cells(line, self.separator).collect();
        if values.len() != self.columns.len() {
            let text = format!("this row has {} cells; the table has {} columns", values.len(), self.columns.len());
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let value = |name: &str| {
            let place = self.columns.iter().position(|column| column.name == name)?;
            Some(values[place].as_str()).filter(|value| !value.is_empty())
        };
        let kind = value("type").unwrap_or("revolute");
        let known = TYPES.iter().find(|(word, _)| word.eq_ignore_ascii_case(kind));
        let wrong = || {
            let text = format!("type `{}`; give revolute or prismatic", shown(kind));
            Error::new(ErrorKind::BadValue, text)
        };
        let (_, kind) = known.ok_or_else(wrong)?;
        let moving = if *kind == "revolute" { "theta" } else { "d" };
        let name = value("name")
            .ok_or_else(|| Error::new(ErrorKind::MissingKey, "the joint has no name; give a column `name`"))?;
        let mut text = format!("{{ name = {}, type = \"{kind}\"", quoted(name));
        for (key, cell) in ["theta", "d", "a", "alpha"].into_iter().filter_map(|key| Some((key, value(key)?))) {
            if key != moving {
                let _ = write!(text, ", {key} = {}", self.number(cell)?);
            }
        }
        // The variable's own cell is its value at zero, unless it is a symbol.
        let own = value(moving).filter(|cell| !is_symbol(cell));
        if let Some(offset) = value("offset").or(own) {
            let _ = write!(text, ", offset = {}", self.number(offset)?);
        }
        match (value("lower"), value("upper")) {
            (Some(lower), Some(upper)) => {
                let _ = write!(text, ", limits = [{}, {}]", self.number(lower)?, self.number(upper)?);
            }
            (None, None) => {}
            _ => return Err(Error::new(ErrorKind::MissingKey, "a joint has both `lower` and `upper`, or neither")),
        }
        Ok(text + " },")
    }

    /// A cell as a number of TOML. `pi`, `-pi/2` and `3*pi/4` are angles in the unit of the table.
    fn number(&self, cell: &str) -> Result<String> {
        let Some((factor, divisor)) = cell.split_once("pi") else { return Ok(quoted(cell)) };
        let wrong = || {
            let text = format!("`{}` is not a number; give one such as 1.5708, pi/2 or -3*pi/4", shown(cell));
            Error::new(ErrorKind::BadValue, text)
        };
        let factor = match factor.trim().trim_end_matches('*') {
            "" | "+" => 1.0,
            "-" => -1.0,
            number => number.trim().parse::<f64>().map_err(|_| wrong())?,
        };
        let divisor = match divisor.trim().strip_prefix('/') {
            None if divisor.trim().is_empty() => 1.0,
            number => number.and_then(|number| number.trim().parse::<f64>().ok()).ok_or_else(wrong)?,
        };
        let half_turn = if self.angle == "deg" { 180.0 } else { PI };
        let value = factor * half_turn / divisor;
        if value.is_finite() { Ok(format!("\"{value}\"")) } else { Err(wrong()) }
    }
}

/// The common unit of columns: one of `allowed`, of which the first is the default.
fn unit(columns: &[Column], names: &[&str], allowed: [&'static str; 2]) -> Result<&'static str> {
    let own: Vec<&str> =
        columns.iter().filter(|column| names.contains(&column.name)).filter_map(|column| column.unit).collect();
    if let Some(wrong) = own.iter().find(|unit| !allowed.contains(unit)) {
        let text = format!("a column of {} is in `{wrong}`; give {} or {}", names.join(", "), allowed[0], allowed[1]);
        return Err(Error::new(ErrorKind::BadValue, text));
    }
    let is_mixed = own.windows(2).any(|pair| pair[0] != pair[1]);
    if is_mixed {
        let text = format!("the columns {} have different units; use one", names.join(", "));
        return Err(Error::new(ErrorKind::BadValue, text));
    }
    Ok(allowed.into_iter().find(|unit| own.contains(unit)).unwrap_or(allowed[0]))
}

/// The cells of a line, without spaces and quotation marks around them, and with decimal points.
fn cells(line: &str, separator: char) -> impl Iterator<Item = String> {
    let plain = move |cell: &str| {
        let cell = cell.trim().trim_matches('"').trim();
        if separator == ',' { cell.to_owned() } else { cell.replace(',', ".") }
    };
    line.split(separator).map(plain)
}

/// Whether a cell is the name of a variable, such as `q1`, `theta_1` or `θ1*`. A sum such as `q1+90` and a product such as `q1*2` are not: their numbers must not
/// be lost.
fn is_symbol(cell: &str) -> bool {
    let name = cell.strip_suffix('*').unwrap_or(cell);
    let is_part = |c: char| c.is_alphanumeric() || matches!(c, '_' | '[' | ']');
    name.starts_with(char::is_alphabetic) && name.chars().all(is_part) && name != "pi" && name.parse::<f64>().is_err()
}

/// A string of TOML.
fn quoted(text: &str) -> String {
    let escaped: String =
        text.chars().flat_map(|c| if matches!(c, '"' | '\\') { vec!['\\', c] } else { vec![c] }).collect();
    format!("\"{escaped}\"")
}
