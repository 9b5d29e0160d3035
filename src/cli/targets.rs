//! Reading targets: from an argument, or as CSV with or without a line of names.

use std::io::{self, BufRead, Lines};
use std::iter::Enumerate;
use std::path::Path;

use csv::{ReaderBuilder, StringRecord, Trim};

use crate::{Error, ErrorKind, Result};

/// How errors call standard input.
pub const STDIN: &str = "<stdin>";
/// The longest piece of a cell that an error shows.
const SHOWN: usize = 40;

/// The numbers of `60,150`, which stand for `names`; how many there must be is left to who uses them.
///
/// # Errors
/// [`ErrorKind::BadValue`] naming the cell that is no number.
pub fn parse(names: &[&str], text: &str) -> Result<Vec<f64>> {
    numbers(names, text.split(',').map(str::trim))
}

fn numbers<'t>(names: &[&str], cells: impl Iterator<Item = &'t str>) -> Result<Vec<f64>> {
    cells.enumerate().map(|(index, cell)| number(names, index, cell)).collect()
}

fn number(names: &[&str], index: usize, cell: &str) -> Result<f64> {
    cell.parse().map_err(|_| {
        let name = names.get(index).map(|name| format!(" (`{name}`)")).unwrap_or_default();
        let text = format!(
            "cell {}{name} is `{}`, which is no number; give a decimal number such as 12.5 or -3e2",
            index + 1,
            shown(cell)
        );
        Error::new(ErrorKind::BadValue, text)
    })
}

/// The start of `text`, control characters escaped.
pub fn shown(text: &str) -> String {
    let escaped: String = text.chars().take(SHOWN).flat_map(char::escape_debug).collect();
    if text.chars().nth(SHOWN).is_some() { escaped + "..." } else { escaped }
}

/// One target with its line, counted from 1.
pub struct Row {
    /// The line where it stands.
    pub line: usize,
    /// Its numbers, in the order of the names.
    pub target: Vec<f64>,
}

/// The rows of a CSV: one a line, empty lines left out.
pub struct Reader<'a, R> {
    /// The names of each form that a row may have.
    forms: Vec<Vec<&'a str>>,
    lines: Enumerate<Lines<R>>,
    /// Once the first row is read: the form of its names and which column each is in, when the row has names.
    columns: Option<(usize, Vec<usize>)>,
    is_first: bool,
    /// How errors call the input.
    file: &'a Path,
}

impl<'a, R: BufRead> Reader<'a, R> {
    /// Reads values of `names` from `input`, which is `file`.
    pub fn new(names: Vec<&'a str>, input: R, file: &'a Path) -> Self {
        Reader::of_forms(vec![names], input, file)
    }

    /// Reads values of any of these lists of names from `input`, which is `file`.
    pub fn of_forms(forms: Vec<Vec<&'a str>>, input: R, file: &'a Path) -> Self {
        Reader { forms, lines: input.lines().enumerate(), columns: None, is_first: true, file }
    }

    /// The next target; a first row of names is taken note of.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`], [`ErrorKind::UnknownName`] for a row of names that lacks an input, [`ErrorKind::Io`],
    /// [`ErrorKind::Syntax`]: all with file and line.
    pub fn next(&mut self) -> Option<Result<Row>> {
        loop {
            let (index, text) = self.lines.next()?;
            let line = index + 1;
            let read = text.map_err(|error| unreadable(&error, self.file)).and_then(|text| match text.trim() {
                "" => Ok(None),
                text => self.row(&record(text)?),
            });
            match read {
                Ok(None) => {}
                Ok(Some(target)) => return Some(Ok(Row { line, target })),
                Err(error) => return Some(Err(error.at_line(line).in_file(self.file))),
            }
        }
    }

    /// The target of a row; none for the row of names.
    fn row(&mut self, record: &StringRecord) -> Result<Option<Vec<f64>>> {
        let is_first = std::mem::replace(&mut self.is_first, false);
        if is_first && record.iter().all(|cell| cell.parse::<f64>().is_err()) {
            self.columns = Some(self.named(record)?);
            return Ok(None);
        }
        let Some((form, columns)) = &self.columns else {
            let form = self.forms.iter().find(|names| names.len() == record.len()).unwrap_or(&self.forms[0]);
            return numbers(form, record.iter()).map(Some);
        };
        let cells = columns.iter().map(|&column| record.get(column).unwrap_or(""));
        numbers(&self.forms[*form], cells).map(Some)
    }

    /// The first form whose names a row has, and their columns.
    fn named(&self, record: &StringRecord) -> Result<(usize, Vec<usize>)> {
        let found = |(form, names): (usize, &Vec<&str>)| columns(names, record).ok().map(|columns| (form, columns));
        match self.forms.iter().enumerate().find_map(found) {
            Some(found) => Ok(found),
            None => {
                let fewest = (0..self.forms.len()).min_by_key(|form| self.forms[*form].len()).unwrap_or(0);
                columns(&self.forms[fewest], record).map(|columns| (fewest, columns))
            }
        }
    }
}

/// The column of each name in a row of names.
fn columns(names: &[&str], record: &StringRecord) -> Result<Vec<usize>> {
    let column = |name: &&str| {
        record.iter().position(|cell| cell == *name).ok_or_else(|| {
            let found: Vec<String> = record.iter().take(8).map(shown).collect();
            let text = format!(
                "the first row (`{}`) is neither numbers nor names of the inputs: `{name}` is missing; {} are allowed",
                found.join(","),
                names.join(", ")
            );
            Error::new(ErrorKind::UnknownName, text)
        })
    };
    names.iter().map(column).collect()
}

/// The cells of a line.
fn record(line: &str) -> Result<StringRecord> {
    let mut options = ReaderBuilder::new();
    options.has_headers(false).trim(Trim::All).buffer_capacity(line.len());
    let mut record = StringRecord::new();
    match options.from_reader(line.as_bytes()).read_record(&mut record) {
        Ok(_) => Ok(record),
        Err(_) => Err(Error::new(ErrorKind::Syntax, "this is no CSV; give numbers with commas between them")),
    }
}

fn unreadable(error: &io::Error, file: &Path) -> Error {
    match error.kind() {
        io::ErrorKind::InvalidData => Error::new(ErrorKind::Syntax, "the text is not UTF-8; give UTF-8"),
        _ => Error::io(file, error),
    }
}
