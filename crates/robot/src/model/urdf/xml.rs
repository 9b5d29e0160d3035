//! The outer levels of an XML text as elements with line numbers. Deeper levels are only checked for well-formedness.

use std::ops::RangeInclusive;
use std::path::Path;
use std::sync::Arc;

use num_traits::ToPrimitive;
use quick_xml::events::attributes::AttrError;
use quick_xml::events::{BytesStart, Event};
use quick_xml::{Decoder, Reader};

use crate::document::shown;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::limits;
use groebot_algebra::number::{BigRational, parse_rational};

/// Number of stored levels: robot, link or joint, their parts, and two levels of these, such as a collision's geometry
/// and its box.
const STORED_LEVELS: usize = 5;
/// Maximum size of an element's text in bytes.
const MOST_TEXT: usize = limits::XML_TEXT;
/// Maximum nesting depth.
const DEEPEST: usize = limits::XML_DEPTH;

/// Advice about xacro in messages.
pub const EXPAND: &str = "a macro language for URDF; give its file, which is expanded when it is read";

/// An element with its attributes and children.
#[derive(Clone, Debug)]
pub struct Element {
    pub name: String,
    pub line: usize,
    /// The included file that has the element; `None` for the description's own file.
    pub file: Option<Arc<Path>>,
    attributes: Vec<(String, String)>,
    /// The text of the element, without blanks at both ends.
    pub text: String,
    pub children: Vec<Element>,
}

impl Element {
    /// Parses `text` and returns its root element with [`STORED_LEVELS`] levels.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] with its line for text that is not one well-formed XML element or is nested too deeply.
    pub fn parse(text: &str) -> Result<Element> {
        Element::parse_levels(text, STORED_LEVELS)
    }

    /// Same as [`Element::parse`], but with all levels.
    ///
    /// # Errors
    /// Those of [`Element::parse`].
    pub fn parse_whole(text: &str) -> Result<Element> {
        Element::parse_levels(text, DEEPEST)
    }

    fn parse_levels(text: &str, stored: usize) -> Result<Element> {
        let newlines: Vec<usize> = text.match_indices('\n').map(|(at, _)| at).collect();
        let line_of = |offset: usize| 1 + newlines.partition_point(|&newline| newline < offset);
        let mut reader = Reader::from_str(text);
        let mut builder = Builder { decoder: reader.decoder(), stored, open: Vec::new(), depth: 0, root: None };
        loop {
            let line = line_of(reader.buffer_position() as usize);
            let event = reader.read_event().map_err(|error| {
                let line = line_of(reader.error_position() as usize);
                syntax(&error.to_string()).at_line(line)
            })?;
            if matches!(event, Event::Eof) {
                return builder.finish().map_err(|error| error.at_line(line));
            }
            builder.take(&event, line).map_err(|error| error.at_line(line))?;
        }
    }

    /// The text of the attribute `name`.
    pub fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str())
    }

    /// All attributes, each with its name.
    pub fn attributes(&self) -> impl Iterator<Item = (&str, &str)> {
        self.attributes.iter().map(|(name, value)| (name.as_str(), value.as_str()))
    }

    /// Sets the text of an attribute.
    pub fn set(&mut self, name: &str, value: &str) {
        self.attributes.retain(|(key, _)| key != name);
        self.attributes.push((name.to_owned(), value.to_owned()));
    }

    /// Records the included file in this element and those in it, for error messages.
    pub fn mark(&mut self, file: &Arc<Path>) {
        self.file = Some(Arc::clone(file));
        self.children.iter_mut().for_each(|child| child.mark(file));
    }

    /// The line in the description's own file; `None` for an element of an included file.
    pub fn own_line(&self) -> Option<usize> {
        self.file.is_none().then_some(self.line)
    }

    /// The text of a required attribute.
    ///
    /// # Errors
    /// [`ErrorKind::MissingKey`] at the element's line.
    pub fn required(&self, name: &str) -> Result<&str> {
        self.attribute(name)
            .ok_or_else(|| self.error(ErrorKind::MissingKey, &format!("has no `{name}`; it is required")))
    }

    /// The child `name`.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] at the second one's line.
    pub fn child(&self, name: &str) -> Result<Option<&Element>> {
        let mut children = self.children.iter().filter(|child| child.name == name);
        match (children.next(), children.next()) {
            (_, Some(second)) => Err(second.error(ErrorKind::BadValue, "is given twice; give one")),
            (first, None) => Ok(first),
        }
    }

    /// The exact numbers of an attribute, separated by blanks.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a wrong number of entries, nan, infinities, and text that is not a decimal number.
    pub fn numbers<const N: usize>(&self, name: &str) -> Result<Option<[BigRational; N]>> {
        let Some(numbers) = self.list(name, N..=N)? else { return Ok(None) };
        Ok(numbers.try_into().ok())
    }

    /// Same as [`Element::numbers`], but with a range of allowed counts.
    ///
    /// # Errors
    /// Those of [`Element::numbers`].
    pub fn list(&self, name: &str, allowed: RangeInclusive<usize>) -> Result<Option<Vec<BigRational>>> {
        let Some(text) = self.attribute(name) else { return Ok(None) };
        let bad = |what: String| {
            let wanted = match (*allowed.start(), *allowed.end()) {
                (1, 1) => "one number".to_owned(),
                (least, most) if least == most => format!("{most} numbers with blanks between them"),
                (least, most) => format!("{least} to {most} numbers with blanks between them"),
            };
            self.error(ErrorKind::BadValue, &format!("has `{name}` = \"{}\": {what}; give {wanted}", shown(text)))
        };
        if text.contains("$(") {
            let text = format!("has `{name}` = \"{}\": `$(...)` is xacro, {EXPAND}", shown(text));
            return Err(self.error(ErrorKind::Unsupported, &text));
        }
        let words = text.split_whitespace();
        let numbers: Vec<BigRational> = words.map(|word| decimal(word).map_err(bad)).collect::<Result<_>>()?;
        if allowed.contains(&numbers.len()) { Ok(Some(numbers)) } else { Err(bad(format!("{} found", numbers.len()))) }
    }

    /// The exact number of an attribute.
    ///
    /// # Errors
    /// Those of [`Element::numbers`].
    pub fn number(&self, name: &str) -> Result<Option<BigRational>> {
        Ok(self.numbers::<1>(name)?.map(|[value]| value))
    }

    /// Same as [`Element::numbers`], but in doubles.
    ///
    /// # Errors
    /// Those of [`Element::numbers`]; also for numbers outside the range of doubles.
    pub fn floats<const N: usize>(&self, name: &str) -> Result<Option<[f64; N]>> {
        let Some(exact) = self.numbers::<N>(name)? else { return Ok(None) };
        let floats = exact.each_ref().map(|number| number.to_f64().unwrap_or(f64::INFINITY));
        if floats.iter().all(|number| number.is_finite()) {
            return Ok(Some(floats));
        }
        Err(self.error(ErrorKind::BadValue, &format!("has a number in `{name}` outside the range of doubles")))
    }

    /// The double of an attribute.
    ///
    /// # Errors
    /// Those of [`Element::floats`].
    pub fn float(&self, name: &str) -> Result<Option<f64>> {
        Ok(self.floats::<1>(name)?.map(|[value]| value))
    }

    /// An error about this element, at its line.
    pub fn error(&self, kind: ErrorKind, message: &str) -> Error {
        let error = Error::new(kind, format!("<{}> {message}", shown(&self.name))).at_line(self.line);
        if let Some(file) = &self.file { error.in_file(file) } else { error }
    }
}

/// Parses a decimal number. Fractions are refused, because XML parsers do not support them.
pub fn decimal(word: &str) -> std::result::Result<BigRational, String> {
    let is_plain = word.bytes().all(|b| b.is_ascii_digit() || b"+-.eE".contains(&b)) && word.len() <= 400;
    let value = if is_plain { parse_rational(word).ok() } else { None };
    value.ok_or_else(|| match word.parse::<f64>() {
        Ok(value) if !value.is_finite() => format!("{} is not finite", shown(word)),
        _ => format!("`{}` is not a number", shown(word)),
    })
}

fn syntax(message: &str) -> Error {
    Error::new(ErrorKind::Syntax, format!("this is not XML: {}", shown_long(message)))
}

/// `message` on one line.
fn shown_long(message: &str) -> String {
    message.chars().take(160).flat_map(|c| if c.is_control() { c.escape_debug().collect() } else { vec![c] }).collect()
}

/// Builds elements while they open and close.
struct Builder {
    decoder: Decoder,
    /// The number of stored levels.
    stored: usize,
    /// The open elements that are stored.
    open: Vec<Element>,
    depth: usize,
    root: Option<Element>,
}

impl Builder {
    fn take(&mut self, event: &Event<'_>, line: usize) -> Result<()> {
        match event {
            Event::Start(start) => self.start(start, line),
            Event::Empty(start) => {
                self.start(start, line)?;
                self.end();
                Ok(())
            }
            Event::End(_) => {
                self.end();
                Ok(())
            }
            Event::Text(text) if self.depth > 0 && self.depth <= self.stored && text.len() <= MOST_TEXT => {
                if let (Some(open), Ok(text)) = (self.open.last_mut(), text.decode()) {
                    open.text += text.trim();
                }
                Ok(())
            }
            Event::Text(text) if self.depth == 0 && !text.iter().all(u8::is_ascii_whitespace) && !is_mark(text) => {
                Err(syntax("there is text outside the root element"))
            }
            _ => Ok(()),
        }
    }

    fn start(&mut self, start: &BytesStart<'_>, line: usize) -> Result<()> {
        if self.depth == 0 && self.root.is_some() {
            return Err(syntax("a second root element"));
        }
        if self.depth >= DEEPEST {
            return Err(syntax(&format!("elements are nested deeper than {DEEPEST}")));
        }
        self.depth += 1;
        let attributes = attributes(start, self.decoder)?;
        if self.depth <= self.stored {
            let name = String::from_utf8_lossy(start.name().as_ref()).into_owned();
            self.open.push(Element { name, line, file: None, attributes, text: String::new(), children: Vec::new() });
        }
        Ok(())
    }

    fn end(&mut self) {
        let is_kept = self.depth <= self.stored;
        self.depth = self.depth.saturating_sub(1);
        if let Some(element) = is_kept.then(|| self.open.pop()).flatten() {
            match self.open.last_mut() {
                Some(parent) => parent.children.push(element),
                None => self.root = Some(element),
            }
        }
    }

    fn finish(self) -> Result<Element> {
        match (self.open.last(), self.root) {
            (Some(open), _) => Err(syntax(&format!("<{}> of line {} is not closed", shown(&open.name), open.line))),
            (None, None) => Err(syntax("there is no element; give a <robot>")),
            (None, Some(root)) => Ok(root),
        }
    }
}

/// Whether `text` is the byte order mark of UTF-8.
fn is_mark(text: &[u8]) -> bool {
    text.strip_prefix(b"\xef\xbb\xbf").is_some_and(|rest| rest.iter().all(u8::is_ascii_whitespace))
}

fn attributes(start: &BytesStart<'_>, decoder: Decoder) -> Result<Vec<(String, String)>> {
    let mut attributes = Vec::new();
    for attribute in start.attributes() {
        if attributes.len() >= limits::XML_ATTRIBUTES {
            return Err(syntax(&format!("an element has more than {} attributes", limits::XML_ATTRIBUTES)));
        }
        let attribute = attribute.map_err(|error: AttrError| syntax(&error.to_string()))?;
        let value = attribute.decode_and_unescape_value(decoder).map_err(|error| syntax(&error.to_string()))?;
        attributes.push((String::from_utf8_lossy(attribute.key.as_ref()).into_owned(), value.into_owned()));
    }
    Ok(attributes)
}
