//! Reading targets: from an argument, or as CSV with or without a line of names.

use std::io::{self, BufRead, Lines};
use std::iter::Enumerate;
use std::path::Path;

use csv::{ReaderBuilder, StringRecord, Trim};

use crate::solver::Program;
use crate::{Error, ErrorKind, Result};

/// How errors call standard input.
pub const STDIN: &str = "<stdin>";
/// The longest piece of a cell that an error shows.
const SHOWN: usize = 40;

/// The numbers of `60,150`; how many there must be is left to [`Program::solve`].
///
/// # Errors
/// [`ErrorKind::BadValue`] naming the cell that is no number.
pub fn parse(program: &Program, text: &str) -> Result<Vec<f64>> {
    numbers(program, text.split(',').map(str::trim))
}

fn numbers<'t>(program: &Program, cells: impl Iterator<Item = &'t str>) -> Result<Vec<f64>> {
    cells.enumerate().map(|(index, cell)| number(program, index, cell)).collect()
}

fn number(program: &Program, index: usize, cell: &str) -> Result<f64> {
    cell.parse().map_err(|_| {
        let name = program.inputs.get(index).map(|input| format!(" (`{}`)", input.name)).unwrap_or_default();
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
    /// Its numbers, in the order of the program's inputs.
    pub target: Vec<f64>,
}

/// The rows of a CSV: one a line, empty lines left out.
pub struct Reader<'a, R> {
    program: &'a Program,
    lines: Enumerate<Lines<R>>,
    /// Once the first row is read: which column each input is in, when it has names.
    columns: Option<Vec<usize>>,
    is_first: bool,
}

impl<'a, R: BufRead> Reader<'a, R> {
    /// Reads from `input`.
    pub fn new(program: &'a Program, input: R) -> Self {
        Reader { program, lines: input.lines().enumerate(), columns: None, is_first: true }
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
            let read = text.map_err(|error| unreadable(&error)).and_then(|text| match text.trim() {
                "" => Ok(None),
                text => self.row(&record(text)?),
            });
            match read {
                Ok(None) => {}
                Ok(Some(target)) => return Some(Ok(Row { line, target })),
                Err(error) => return Some(Err(error.at_line(line).in_file(Path::new(STDIN)))),
            }
        }
    }

    /// The target of a row; none for the row of names.
    fn row(&mut self, record: &StringRecord) -> Result<Option<Vec<f64>>> {
        let is_first = std::mem::replace(&mut self.is_first, false);
        if is_first && record.iter().all(|cell| cell.parse::<f64>().is_err()) {
            self.columns = Some(columns(self.program, record)?);
            return Ok(None);
        }
        let Some(columns) = &self.columns else { return numbers(self.program, record.iter()).map(Some) };
        let cells = columns.iter().map(|&column| record.get(column).unwrap_or(""));
        numbers(self.program, cells).map(Some)
    }
}

/// The column of each input in a row of names.
fn columns(program: &Program, record: &StringRecord) -> Result<Vec<usize>> {
    let column = |input: &crate::solver::Input| {
        record.iter().position(|cell| cell == input.name).ok_or_else(|| {
            let names: Vec<&str> = program.inputs.iter().map(|input| input.name.as_str()).collect();
            let found: Vec<String> = record.iter().take(8).map(shown).collect();
            let text = format!(
                "the first row (`{}`) is neither numbers nor names of the inputs: `{}` is missing; {} are allowed",
                found.join(","),
                input.name,
                names.join(", ")
            );
            Error::new(ErrorKind::UnknownName, text)
        })
    };
    program.inputs.iter().map(column).collect()
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

fn unreadable(error: &io::Error) -> Error {
    match error.kind() {
        io::ErrorKind::InvalidData => Error::new(ErrorKind::Syntax, "the text is not UTF-8; give UTF-8"),
        _ => Error::io(Path::new(STDIN), error),
    }
}
