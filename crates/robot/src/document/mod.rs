//! TOML with line numbers: cursors that read numbers exactly and refuse unknown keys.
//!
//! [`Document`] is the parsed text. [`Table`] and [`Node`] are cheap cursors into it. Numbers are read from their text,
//! so `0.1029` is 1029/10000. Every error has a line and the allowed values.
//!
//! ```
//! # use groebot_robot::document::Document;
//! let document = Document::parse("name = \"leg\"\nlength = 0.1029")?;
//! document.root().deny_unknown(&["name", "length"])?;
//! assert_eq!(document.root().required("length")?.exact()?.to_string(), "1029/10000");
//! # Ok::<(), groebot_robot::Error>(())
//! ```

mod certificate;
mod content;
pub mod converted;
mod description;
mod encoding;
mod json;
mod nesting;
mod text;

use num_traits::ToPrimitive;
use toml::Spanned;
use toml::de::{DeInteger, DeTable, DeValue};

use crate::{Error, ErrorKind, Result};
use groebot_algebra::limits;
use groebot_algebra::number::{BigInt, BigRational, parse_rational};

pub use certificate::{Certificate, Proves, head_of};
pub(crate) use content::refuse_binary;
pub use converted::as_toml;
pub use description::DescriptionText;
pub use encoding::{XmlText, as_utf8, decode_xml};
pub use groebot_algebra::escape::shown;
pub use json::{JsonFormat, json_text};
pub use text::open;
pub use text::read_bytes;
pub(crate) use text::text_of;
pub use text::{is_stdin, read_text, read_xml, unix_lines};

/// The size limit of groebot's readers for [`read_text`]: one megabyte.
pub const TEXT_LIMIT: u64 = limits::DESCRIPTION_BYTES;

/// A parsed TOML document, borrowing its text.
#[derive(Clone, Debug)]
pub struct Document<'t> {
    entries: DeTable<'t>,
    lines: Vec<usize>,
}

impl<'t> Document<'t> {
    /// Parses TOML 1.x text.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] with its line. Keys given twice and nesting deeper than [`limits::TOML_DEPTH`] are also
    /// refused.
    pub fn parse(text: &'t str) -> Result<Self> {
        let lines: Vec<usize> = text.match_indices('\n').map(|(at, _)| at).collect();
        if let Some(at) = nesting::too_deep(text) {
            let levels = limits::TOML_DEPTH;
            let message =
                format!("this is nested too deep; {levels} levels of keys with dots, tables and lists are read");
            return Err(Error::new(ErrorKind::Syntax, message).at_line(line_of(&lines, at)));
        }
        match DeTable::parse(text) {
            Ok(table) => Ok(Document { entries: table.into_inner(), lines }),
            Err(error) => {
                let line = line_of(&lines, error.span().map_or(text.len(), |span| span.start));
                let message = format!("this is not TOML: {}", error.message());
                Err(Error::new(ErrorKind::Syntax, message).at_line(line))
            }
        }
    }

    /// The table of all top-level keys.
    pub fn root(&self) -> Table<'_> {
        Table { entries: &self.entries, lines: &self.lines, name: "", line: 1 }
    }
}

fn line_of(newlines: &[usize], offset: usize) -> usize {
    1 + newlines.partition_point(|&newline| newline < offset)
}

/// A cursor at one table of a [`Document`].
#[derive(Clone, Copy, Debug)]
pub struct Table<'d> {
    entries: &'d DeTable<'d>,
    lines: &'d [usize],
    name: &'d str,
    line: usize,
}

impl<'d> Table<'d> {
    /// The line of the table's header (1 for the root).
    pub fn line(&self) -> usize {
        self.line
    }

    /// The key of this table; empty for the root.
    pub fn name(&self) -> &'d str {
        self.name
    }

    /// Builds an error of `kind` at this table's line.
    pub fn error(&self, kind: ErrorKind, message: impl Into<String>) -> Error {
        Error::new(kind, message).at_line(self.line)
    }

    /// The value of `key`, if present.
    pub fn optional(&self, key: &str) -> Option<Node<'d>> {
        let (key, value) = self.entries.get_key_value(key)?;
        Some(self.node(key, value))
    }

    /// The value of `key`.
    ///
    /// # Errors
    /// [`ErrorKind::MissingKey`] at the table's line.
    pub fn required(&self, key: &str) -> Result<Node<'d>> {
        self.optional(key).ok_or_else(|| {
            let place = if self.name.is_empty() { "the file".into() } else { format!("`{}`", shown(self.name)) };
            self.error(ErrorKind::MissingKey, format!("{place} has no `{key}`; it is required"))
        })
    }

    /// All entries, in the order of the file.
    pub fn entries(&self) -> Vec<Node<'d>> {
        let mut entries: Vec<_> = self.entries.iter().collect();
        entries.sort_by_key(|(key, _)| key.span().start);
        entries.into_iter().map(|(key, value)| self.node(key, value)).collect()
    }

    /// Checks that all keys of the table are among `allowed`.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownKey`] at the line of the first unknown key, with the nearest allowed name.
    pub fn deny_unknown(&self, allowed: &[&str]) -> Result<()> {
        match self.entries().iter().find(|node| !allowed.contains(&node.name)) {
            None => Ok(()),
            Some(node) => {
                let message = format!("unknown key `{}`{}", shown(node.name), one_among(node.name, allowed));
                Err(Error::new(ErrorKind::UnknownKey, message).at_line(node.line))
            }
        }
    }

    fn node(&self, key: &'d Spanned<std::borrow::Cow<'d, str>>, value: &'d Spanned<DeValue<'d>>) -> Node<'d> {
        let line = line_of(self.lines, key.span().start);
        Node { value: value.get_ref(), lines: self.lines, name: key.get_ref(), line }
    }
}

/// A cursor at one value of a [`Document`].
#[derive(Clone, Copy, Debug)]
pub struct Node<'d> {
    value: &'d DeValue<'d>,
    lines: &'d [usize],
    name: &'d str,
    line: usize,
}

impl<'d> Node<'d> {
    /// The line of the value's key, or of the array element.
    pub fn line(&self) -> usize {
        self.line
    }

    /// The key of this value; array elements have the key of their array.
    pub fn name(&self) -> &'d str {
        self.name
    }

    /// Builds an error of `kind` at this line, with the key before `message`.
    pub fn error(&self, kind: ErrorKind, message: impl Into<String>) -> Error {
        self.place(Error::new(kind, message))
    }

    /// Adds this line to `error`, and the key before its message.
    pub fn place(&self, error: Error) -> Error {
        error.with_context(format_args!("`{}`", shown(self.name))).at_line(self.line)
    }

    /// The text of a string.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for another type.
    pub fn text(&self) -> Result<&'d str> {
        self.value.as_str().ok_or_else(|| self.wrong("a string such as \"name\""))
    }

    /// The value in `choices` for the text of this string.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`], listing the choices, for another text or another type.
    pub fn one_of<T: Clone>(&self, choices: &[(&str, T)]) -> Result<T> {
        let names: Vec<&str> = choices.iter().map(|(name, _)| *name).collect();
        let text = self.value.as_str().ok_or_else(|| self.wrong(&format!("one of {}", quoted(&names))))?;
        let found = choices.iter().find(|(name, _)| *name == text).map(|(_, value)| value.clone());
        found.ok_or_else(|| {
            let message = format!("`{}` is not known{}", shown(text), one_among(text, &names));
            self.error(ErrorKind::BadValue, message)
        })
    }

    /// The exact value of an integer, a float (by its text) or a string such as `"1029/10000"` or `"0.1029"`.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for nan, infinities and other types; [`ErrorKind::Syntax`] for a string that is not a
    /// number and for more than 4096 digits.
    pub fn exact(&self) -> Result<BigRational> {
        let text = match self.value {
            DeValue::Integer(integer) if integer.radix() != 10 => return self.radix_integer(integer),
            DeValue::Integer(integer) => integer.as_str(),
            DeValue::Float(float) if float.as_str().ends_with(['n', 'f']) => {
                let message = format!("{} is not a finite number; give one", float.as_str());
                return Err(self.error(ErrorKind::BadValue, message));
            }
            DeValue::Float(float) => float.as_str(),
            DeValue::String(text) => text,
            _ => return Err(self.wrong("a number such as 0.1029, or a string such as \"1029/10000\"")),
        };
        parse_rational(text).map_err(|error| self.place(error))
    }

    fn radix_integer(&self, integer: &DeInteger<'_>) -> Result<BigRational> {
        let value = BigInt::parse_bytes(integer.as_str().as_bytes(), integer.radix());
        let short = value.filter(|_| integer.as_str().len() <= limits::DIGITS);
        short
            .map(BigRational::from_integer)
            .ok_or_else(|| self.wrong(&format!("an integer of at most {} digits", limits::DIGITS)))
    }

    /// The double that is nearest to [`Node::exact`].
    ///
    /// # Errors
    /// Those of [`Node::exact`]; [`ErrorKind::BadValue`] outside the range of doubles.
    pub fn float(&self) -> Result<f64> {
        let value = self.exact()?.to_f64().filter(|value| value.is_finite());
        value.ok_or_else(|| self.error(ErrorKind::BadValue, "the number is too large; give at most 1.7e308"))
    }

    /// The value of a non-negative integer.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for another type, a negative integer or one that is too large.
    pub fn count(&self) -> Result<usize> {
        let integer = matches!(self.value, DeValue::Integer(_)).then(|| self.exact()).transpose()?;
        integer.and_then(|n| n.to_integer().to_usize()).ok_or_else(|| self.wrong("a non-negative integer"))
    }

    /// The value of a boolean.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for another type.
    pub fn boolean(&self) -> Result<bool> {
        self.value.as_bool().ok_or_else(|| self.wrong("true or false"))
    }

    /// The elements of an array.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for another type.
    pub fn array(&self) -> Result<Vec<Node<'d>>> {
        let array = self.value.as_array().ok_or_else(|| self.wrong("an array such as [1, 2]"))?;
        let node = |element: &'d Spanned<DeValue<'d>>| Node {
            value: element.get_ref(),
            line: line_of(self.lines, element.span().start),
            ..*self
        };
        Ok(array.iter().map(node).collect())
    }

    /// The strings of an array of strings.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for another type.
    pub fn texts(&self) -> Result<Vec<&'d str>> {
        self.array()?.iter().map(Node::text).collect()
    }

    /// The exact values of an array of exactly `N` numbers.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for another type or length; those of [`Node::exact`].
    pub fn exact_vector<const N: usize>(&self) -> Result<[BigRational; N]> {
        let values: Vec<_> = self.numbers(N)?.iter().map(Node::exact).collect::<Result<_>>()?;
        values.try_into().map_err(|_| self.wrong(&format!("an array of {N} numbers")))
    }

    /// The doubles of an array of exactly `N` numbers.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for another type or length; those of [`Node::float`].
    pub fn float_vector<const N: usize>(&self) -> Result<[f64; N]> {
        let values: Vec<_> = self.numbers(N)?.iter().map(Node::float).collect::<Result<_>>()?;
        values.try_into().map_err(|_| self.wrong(&format!("an array of {N} numbers")))
    }

    fn numbers(&self, length: usize) -> Result<Vec<Node<'d>>> {
        let wanted = format!("an array of {length} numbers");
        let elements = self.array().map_err(|_| self.wrong(&wanted))?;
        if elements.len() == length {
            return Ok(elements);
        }
        Err(self.error(ErrorKind::BadValue, format!("{} elements are given; give {wanted}", elements.len())))
    }

    /// The table at this key.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for another type.
    pub fn table(&self) -> Result<Table<'d>> {
        let entries = self.value.as_table().ok_or_else(|| self.wrong("a table"))?;
        Ok(Table { entries, lines: self.lines, name: self.name, line: self.line })
    }

    /// The tables of an array of tables, `[[name]]`.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for another type.
    pub fn tables(&self) -> Result<Vec<Table<'d>>> {
        let wanted = || self.wrong(&format!("an array of tables, each under a [[{}]] header", shown(self.name)));
        self.array().map_err(|_| wanted())?.iter().map(|node| node.table().map_err(|_| wanted())).collect()
    }

    fn wrong(&self, wanted: &str) -> Error {
        let found = match self.value {
            DeValue::String(_) => "a string",
            DeValue::Integer(_) => "an integer",
            DeValue::Float(_) => "a float",
            DeValue::Boolean(_) => "a boolean",
            DeValue::Datetime(_) => "a date or time",
            DeValue::Array(_) => "an array",
            DeValue::Table(_) => "a table",
        };
        self.error(ErrorKind::BadValue, format!("{found} is not allowed here; give {wanted}"))
    }
}

/// The end of a message about an unknown `name`: the nearest of `allowed`, if near, and all of them.
pub fn one_among(name: &str, allowed: &[&str]) -> String {
    format!("{}; allowed: {}", did_you_mean(name, allowed), quoted(allowed))
}

/// Converts the text to an identifier of every target language: letters, digits and `_`, with a letter first. Other
/// characters become `_`.
pub fn word(text: &str) -> String {
    let body: String = text.chars().map(|c| if c.is_ascii_alphanumeric() { c } else { '_' }).collect();
    if body.starts_with(|c: char| c.is_ascii_alphabetic()) { body } else { format!("x{body}") }
}

/// ` (did you mean ...?)` with the nearest of `allowed`; empty when none is near.
pub fn did_you_mean(name: &str, allowed: &[&str]) -> String {
    match allowed.iter().map(|&word| (edits(name, word), word)).min() {
        Some((distance, word)) if distance <= 1 + word.len() / 4 => format!(" (did you mean `{}`?)", shown(word)),
        _ => String::new(),
    }
}

fn quoted(names: &[&str]) -> String {
    names.iter().map(|name| format!("`{name}`")).collect::<Vec<_>>().join(", ")
}

/// The edit distance (Levenshtein 1966) of the first 40 characters.
fn edits(a: &str, b: &str) -> usize {
    let b: Vec<char> = b.chars().take(40).collect();
    let mut row: Vec<usize> = (0..=b.len()).collect();
    for (i, x) in a.chars().take(40).enumerate() {
        let mut diagonal = std::mem::replace(&mut row[0], i + 1);
        for (j, &y) in b.iter().enumerate() {
            let cost = (diagonal + usize::from(x != y)).min(row[j] + 1).min(row[j + 1] + 1);
            diagonal = std::mem::replace(&mut row[j + 1], cost);
        }
    }
    row[b.len()]
}
