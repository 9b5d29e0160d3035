//! Reading targets: from an argument, or as CSV with or without a line of names.

use std::io::{self, BufRead, Lines};
use std::iter::Enumerate;
use std::path::Path;

use csv::{ReaderBuilder, StringRecord, Trim};

use super::columns::{Columns, Found};
use crate::document::is_stdin;
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
    let name = |index: usize| names.get(index).copied().unwrap_or_default();
    cells.enumerate().map(|(index, cell)| number(name(index), index, cell)).collect()
}

/// The number of a cell: that of `name`, where it has one.
fn number(name: &str, index: usize, cell: &str) -> Result<f64> {
    cell.parse().map_err(|_| {
        let name = if name.is_empty() { String::new() } else { format!(" (`{name}`)") };
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

/// Fails where standard input, from which a table would be read, already holds `description`; `option` is what gives values instead.
///
/// # Errors
/// [`ErrorKind::BadValue`].
pub fn is_free(description: &Path, option: &str) -> Result<()> {
    if !is_stdin(description) {
        return Ok(());
    }
    let text = format!("standard input holds the description, and can hold no table as well; give values by {option}");
    Err(Error::new(ErrorKind::BadValue, text))
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
    columns: Columns,
    lines: Enumerate<Lines<R>>,
    /// Once the first row is read: where the numbers are, when it has names.
    found: Option<Found>,
    is_first: bool,
    /// How errors call the input.
    file: &'a Path,
}

impl<'a, R: BufRead> Reader<'a, R> {
    /// Reads the numbers of `columns` from `input`, which is `file`.
    pub fn new(columns: Columns, input: R, file: &'a Path) -> Self {
        Reader { columns, lines: input.lines().enumerate(), found: None, is_first: true, file }
    }

    /// The next target; a first row of names is taken note of.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`], [`ErrorKind::UnknownName`] for a row of names that lacks an input or has one that is not known,
    /// [`ErrorKind::Io`], [`ErrorKind::Syntax`]: all with file and line.
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

    /// The target of a row; none for the row of names, and for one that is passed over.
    fn row(&mut self, record: &StringRecord) -> Result<Option<Vec<f64>>> {
        let is_first = std::mem::replace(&mut self.is_first, false);
        if is_first && record.iter().all(|cell| cell.parse::<f64>().is_err()) {
            self.found = Some(self.columns.find(record)?);
            return Ok(None);
        }
        let Some(found) = &self.found else {
            let names = self.columns.names(self.columns.form_of(record.len()));
            return numbers(&names, record.iter()).map(Some);
        };
        if found.is_unsolved(record) {
            return Ok(None);
        }
        let names = self.columns.names(found.form);
        let cells = found.cells(record).zip(&names).map(|((column, cell), name)| number(name, column, cell));
        Ok(Some(found.scaled(cells.collect::<Result<_>>()?)))
    }
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
