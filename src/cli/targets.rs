//! Reading targets: from an argument, or as CSV with or without a line of names.

use std::io::{self, BufRead};
use std::path::Path;

use csv::{ReaderBuilder, StringRecord, Trim};

use crate::{Error, ErrorKind, Result};

/// How errors call standard input.
pub const STDIN: &str = "<stdin>";
/// The longest piece of a cell that an error shows.
const SHOWN: usize = 40;
/// The longest line, in bytes.
const LONGEST: usize = 1_000_000;
/// How many columns an error names.
const NAMED: usize = 8;

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

/// What a row of names says.
struct Named {
    /// The form whose names it has.
    form: usize,
    /// The column of each of them.
    places: Vec<usize>,
    /// How many columns there are.
    count: usize,
}

/// The rows of a CSV: one a line, empty lines left out. Lines end in `\n`, `\r\n` or `\r`.
pub struct Reader<'a, R> {
    /// The names of each form that a row may have.
    forms: Vec<Vec<&'a str>>,
    lines: Lines<R>,
    /// Names of columns that are passed over; none where all others are.
    passed: Option<Vec<String>>,
    /// Once the first row is read, when it has names.
    columns: Option<Named>,
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
        Reader {
            forms,
            lines: Lines { input, count: 0, follows_return: false },
            passed: Some(Vec::new()),
            columns: None,
            is_first: true,
            file,
        }
    }

    /// Passes over columns of these names, too.
    pub fn passing_over(mut self, names: Vec<String>) -> Self {
        self.passed = Some(names);
        self
    }

    /// Passes over all other columns.
    pub fn passing_over_others(mut self) -> Self {
        self.passed = None;
        self
    }

    /// The next target; a first row of names is taken note of.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`], [`ErrorKind::UnknownName`] for a row of names that lacks an input or has another column, [`ErrorKind::Io`],
    /// [`ErrorKind::Syntax`]: all with file and line.
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

    /// The target of a row; none for the row of names.
    fn row(&mut self, record: &StringRecord) -> Result<Option<Vec<f64>>> {
        let is_first = std::mem::replace(&mut self.is_first, false);
        if is_first && record.iter().all(|cell| cell.parse::<f64>().is_err()) {
            self.columns = Some(self.named(record)?);
            return Ok(None);
        }
        let Some(Named { form, places, count }) = &self.columns else {
            let form = self.forms.iter().find(|names| names.len() == record.len()).unwrap_or(&self.forms[0]);
            return numbers(form, record.iter()).map(Some);
        };
        if record.len() > *count {
            let text = format!("{} cells stand in the row; the first one has {count} names", record.len());
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let cells = places.iter().map(|&column| record.get(column).unwrap_or(""));
        numbers(&self.forms[*form], cells).map(Some)
    }

    /// The form whose names a row has; of the others the one that lacks the least tells what is wrong.
    fn named(&self, record: &StringRecord) -> Result<Named> {
        let has = |name: &&&str| record.iter().any(|cell| cell == **name);
        let missing = |form: &usize| self.forms[*form].len() - self.forms[*form].iter().filter(has).count();
        let nearest =
            (0..self.forms.len()).min_by_key(|form| (missing(form), std::cmp::Reverse(self.forms[*form].len())));
        let form = nearest.unwrap_or(0);
        let places = self.places(&self.forms[form], record)?;
        Ok(Named { form, places, count: record.len() })
    }

    /// The column of each name in a row of names, which must hold no other.
    fn places(&self, names: &[&str], record: &StringRecord) -> Result<Vec<usize>> {
        let refused =
            |text: String| Error::new(ErrorKind::UnknownName, format!("{text}; {} are allowed", names.join(", ")));
        let place = |name: &&str| {
            record.iter().position(|cell| cell == *name).ok_or_else(|| {
                let found: Vec<String> = record.iter().take(NAMED).map(shown).collect();
                let row = found.join(",");
                refused(format!(
                    "the first row (`{row}`) is neither numbers nor names of the inputs: `{name}` is missing"
                ))
            })
        };
        let places: Vec<usize> = names.iter().map(place).collect::<Result<_>>()?;
        let is_strange = |(place, cell): &(usize, &str)| {
            let passed = self.passed.as_ref().is_none_or(|names| names.iter().any(|name| name == cell));
            !places.contains(place) && !passed
        };
        match record.iter().enumerate().find(is_strange) {
            None => Ok(places),
            Some((place, cell)) => {
                let what = if names.contains(&cell) { "stands twice" } else { "is unknown" };
                Err(refused(format!("column {} of the first row, `{}`, {what}", place + 1, shown(cell))))
            }
        }
    }
}

/// Lines as they come: each is there as soon as its end is.
struct Lines<R> {
    input: R,
    /// How many lines were read.
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
        Err(_) => Err(Error::new(ErrorKind::Syntax, "this is no CSV; give numbers with commas between them")),
    }
}
