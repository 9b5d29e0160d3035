//! Readers of targets: from an argument, or as CSV with or without a line of names.

use std::io::{self, BufRead};
use std::path::Path;

use csv::{ReaderBuilder, StringRecord, Trim};

use super::columns::{Columns, Found};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::limits::{self, LARGEST};
use groebot_robot::document::is_stdin;

/// The name of standard input in errors.
pub const STDIN: &str = "<stdin>";
/// The greatest length of a cell in an error.
const SHOWN: usize = 40;
/// The greatest length of a line in bytes.
const LONGEST: usize = limits::LINE_BYTES;

/// Reads the numbers of `60,150`, which are the values of `names`. The caller checks their number.
///
/// # Errors
/// [`ErrorKind::BadValue`] with the cell that is not a number.
pub fn parse(names: &[&str], text: &str) -> Result<Vec<f64>> {
    numbers(names, text.split(',').map(str::trim))
}

fn numbers<'t>(names: &[&str], cells: impl Iterator<Item = &'t str>) -> Result<Vec<f64>> {
    let name = |index: usize| names.get(index).copied().unwrap_or_default();
    cells.enumerate().map(|(index, cell)| number(name(index), index, cell)).collect()
}

/// The number of a cell: that of `name`, if it has one.
fn number(name: &str, index: usize, cell: &str) -> Result<f64> {
    let name = || if name.is_empty() { String::new() } else { format!(" (`{}`)", shown(name)) };
    let fail = |text: String| Error::new(ErrorKind::BadValue, format!("cell {}{} is {text}", index + 1, name()));
    match cell.parse::<f64>() {
        // The caller refuses numbers that are not finite, with their names.
        Ok(value) if value.is_finite() && value.abs() > LARGEST => {
            Err(fail(format!("`{}`, which is too large; give at most {LARGEST:e}", shown(cell))))
        }
        Ok(value) => Ok(value),
        Err(_) => {
            let text = format!("`{}`, which is not a number; give a decimal number such as 12.5 or -3e2", shown(cell));
            Err(fail(text))
        }
    }
}

/// The start of `text`, with control characters escaped.
pub fn shown(text: &str) -> String {
    let escaped: String = text.chars().take(SHOWN).flat_map(char::escape_debug).collect();
    if text.chars().nth(SHOWN).is_some() { escaped + "..." } else { escaped }
}

/// Fails if standard input already contains `description`, because a table would also be read from it. `option` is the
/// alternative for the values.
///
/// # Errors
/// [`ErrorKind::BadValue`].
pub fn is_free(description: &Path, option: &str) -> Result<()> {
    if !is_stdin(description) {
        return Ok(());
    }
    let text = format!("standard input has the description, so it cannot have a table too; give values by {option}");
    Err(Error::new(ErrorKind::BadValue, text))
}

/// One target with its line, counted from 1.
pub struct Row {
    /// The number of its line.
    pub line: usize,
    /// Its numbers, in the order of the names.
    pub target: Vec<f64>,
}

/// The rows of a CSV: one per line, empty lines ignored. Lines end in `\n`, `\r\n` or `\r`.
pub struct Reader<'a, R> {
    columns: Columns,
    lines: Lines<R>,
    /// After the first row is read: the columns of the numbers, if it has names.
    found: Option<Found>,
    is_first: bool,
    /// The name of the input in errors.
    file: &'a Path,
}

impl<'a, R: BufRead> Reader<'a, R> {
    /// Reads the numbers of `columns` from `input`, which is `file`.
    pub fn new(columns: Columns, input: R, file: &'a Path) -> Self {
        let lines = Lines { input, count: 0, follows_return: false };
        Reader { columns, lines, found: None, is_first: true, file }
    }

    /// The next target; a first row of names is used for the columns.
    ///
    /// # Errors
    /// All with file and line: [`ErrorKind::BadValue`], [`ErrorKind::UnknownName`] for a row of names that lacks an
    /// input or has an unknown one, [`ErrorKind::Io`], [`ErrorKind::Syntax`].
    pub fn next(&mut self) -> Option<Result<Row>> {
        loop {
            let text = self.lines.next(self.file)?;
            let line = self.lines.count;
            let read = text.and_then(|text| match text.trim_start_matches('\u{feff}').trim() {
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

    /// The target of a row; none for the row of names, and for an ignored one.
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
        if record.len() > found.count {
            let text = format!("the row has {} cells, and the first one {} names", record.len(), found.count);
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        if found.is_unsolved(record) {
            return Ok(None);
        }
        let names = self.columns.names(found.form);
        let cells = found.cells(record).zip(&names).map(|((column, cell), name)| number(name, column, cell));
        Ok(Some(found.scaled(cells.collect::<Result<_>>()?)))
    }
}

/// Lines of a stream, each available as soon as its end is read.
struct Lines<R> {
    input: R,
    /// The number of lines read.
    count: usize,
    /// Whether the last line ended in `\r`: a `\n` that follows belongs to that end.
    follows_return: bool,
}

impl<R: BufRead> Lines<R> {
    /// The next line of `file`, without its end.
    fn next(&mut self, file: &Path) -> Option<Result<String>> {
        let mut line = Vec::new();
        self.count += 1;
        loop {
            let room = match self.input.fill_buf() {
                Ok(room) => room,
                Err(error) if error.kind() == io::ErrorKind::Interrupted => continue,
                Err(error) => return Some(Err(Error::io(file, &error))),
            };
            if room.is_empty() {
                return (!line.is_empty()).then(|| text_of(line));
            }
            if std::mem::take(&mut self.follows_return) && room[0] == b'\n' {
                self.input.consume(1);
                continue;
            }
            let end = room.iter().position(|byte| matches!(byte, b'\n' | b'\r'));
            line.extend(&room[..end.unwrap_or(room.len())]);
            self.follows_return = end.is_some_and(|end| room[end] == b'\r');
            let used = end.map_or(room.len(), |end| end + 1);
            self.input.consume(used);
            if line.len() > LONGEST {
                let text = format!("the line is too long; at most {LONGEST} bytes are read");
                return Some(Err(Error::new(ErrorKind::BadValue, text)));
            }
            if end.is_some() {
                return Some(text_of(line));
            }
        }
    }
}

fn text_of(line: Vec<u8>) -> Result<String> {
    String::from_utf8(line).map_err(|_| Error::new(ErrorKind::Syntax, "the text is not UTF-8; give UTF-8"))
}

/// The cells of a line.
fn record(line: &str) -> Result<StringRecord> {
    let mut options = ReaderBuilder::new();
    options.has_headers(false).trim(Trim::All).buffer_capacity(line.len());
    let mut record = StringRecord::new();
    match options.from_reader(line.as_bytes()).read_record(&mut record) {
        Ok(_) => Ok(record),
        Err(_) => Err(Error::new(ErrorKind::Syntax, "this is not CSV; give numbers separated by commas")),
    }
}
