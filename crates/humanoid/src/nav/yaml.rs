//! The entries of a YAML document, as far as `map_server` uses them: texts and lists of texts by key.
//!
//! `saphyr-parser` tells the events of the text one by one. Aliases share what they name, and lists hold texts alone: nothing grows.

use std::collections::{HashMap, HashSet};
use std::fmt;
use std::rc::Rc;

use saphyr_parser::{Event, Parser, ScanError, Span, StrInput};

use crate::{Error, ErrorKind, Result};
use groebot_robot::document::shown;

/// The deepest nesting.
const DEEPEST: usize = groebot_algebra::limits::YAML_DEPTH;

/// A value.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A scalar, without its quotes.
    Text(Rc<str>),
    /// A list.
    List(Rc<[Value]>),
    /// A mapping, or what is nested too deeply to matter here.
    Other,
}

/// `[1, 2]`.
impl fmt::Display for Value {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Value::Text(text) => f.write_str(text),
            Value::List(list) => {
                let list: Vec<String> = list.iter().map(Value::to_string).collect();
                write!(f, "[{}]", list.join(", "))
            }
            Value::Other => f.write_str("{...}"),
        }
    }
}

/// A key of the document with its value.
#[derive(Clone, Debug, PartialEq)]
pub struct Entry {
    /// The key.
    pub key: Rc<str>,
    /// Its value.
    pub value: Value,
    /// The line of the key, from 1.
    pub line: usize,
}

/// The entries of the first document of `text`, which must be a mapping.
///
/// # Errors
/// [`ErrorKind::Syntax`] for what is no YAML, no mapping, or nested more than 20 levels; [`ErrorKind::DuplicateName`] for a key that is given twice. With the
/// line.
pub fn entries(text: &str) -> Result<Vec<Entry>> {
    let mut reader =
        Reader { parser: Parser::new_from_str(text.trim_start_matches('\u{feff}')), anchors: HashMap::new() };
    loop {
        match reader.next()? {
            (Event::StreamStart | Event::DocumentStart(_), _) => {}
            (Event::MappingStart(..), _) => return reader.mapping(),
            (Event::StreamEnd, _) => return Ok(Vec::new()),
            (_, line) => {
                let text = "this is no mapping; give `image: FILE` and `resolution: METRES`, a line each";
                return Err(Error::new(ErrorKind::Syntax, text).at_line(line));
            }
        }
    }
}

/// Events as they become values.
struct Reader<'t> {
    parser: Parser<'t, StrInput<'t>>,
    /// What has an anchor: texts and lists of texts.
    anchors: HashMap<usize, Value>,
}

impl<'t> Reader<'t> {
    /// The next event, and its line.
    fn next(&mut self) -> Result<(Event<'t>, usize)> {
        let (event, span): (Event<'t>, Span) =
            self.parser.next_event().unwrap_or_else(ended).map_err(|error| broken(&error))?;
        Ok((event, span.start.line()))
    }

    /// The entries of a mapping whose start was read.
    fn mapping(&mut self) -> Result<Vec<Entry>> {
        let (mut entries, mut keys) = (Vec::new(), HashSet::new());
        loop {
            let (event, line) = self.next()?;
            if event == Event::MappingEnd {
                return Ok(entries);
            }
            let key = self.value(event, line, 1)?;
            let (event, place) = self.next()?;
            let value = self.value(event, place, 1)?;
            let Value::Text(key) = key else { continue };
            if !keys.insert(key.clone()) {
                let text = format!("the key `{}` is given twice; give it once", shown(&key));
                return Err(Error::new(ErrorKind::DuplicateName, text).at_line(line));
            }
            entries.push(Entry { key, value, line });
        }
    }

    /// The value that begins with `event`.
    fn value(&mut self, event: Event<'t>, line: usize, depth: usize) -> Result<Value> {
        if depth > DEEPEST {
            let text = format!("lists and mappings are nested deeper than {DEEPEST}");
            return Err(Error::new(ErrorKind::Syntax, text).at_line(line));
        }
        let (value, anchor) = match event {
            Event::Scalar(text, _, anchor, _) => (Value::Text(text.into()), anchor),
            Event::Alias(anchor) => (self.anchors.get(&anchor).cloned().unwrap_or(Value::Other), 0),
            Event::SequenceStart(anchor, _) => (self.list(depth)?, anchor),
            Event::MappingStart(anchor, _) => {
                self.pass(Event::MappingEnd, depth)?;
                (Value::Other, anchor)
            }
            _ => return Err(Error::new(ErrorKind::Syntax, "a value is missing here").at_line(line)),
        };
        // The parser counts anchors from one.
        if anchor > 0 {
            self.anchors.insert(anchor, value.clone());
        }
        Ok(value)
    }

    /// A list whose start was read. A list in a list is skipped, so that no alias makes another one longer.
    fn list(&mut self, depth: usize) -> Result<Value> {
        let mut list = Vec::new();
        loop {
            let (event, line) = self.next()?;
            if event == Event::SequenceEnd {
                return Ok(Value::List(list.into()));
            }
            let value = self.value(event, line, depth + 1)?;
            list.push(if matches!(value, Value::Text(_)) { value } else { Value::Other });
        }
    }

    /// Skips all up to the `end` of what was begun.
    fn pass(&mut self, end: Event<'_>, depth: usize) -> Result<()> {
        loop {
            let (event, line) = self.next()?;
            if event == end {
                return Ok(());
            }
            self.value(event, line, depth + 1)?;
        }
    }
}

/// What there is after the last event.
fn ended<'t>() -> std::result::Result<(Event<'t>, Span), ScanError> {
    Ok((Event::StreamEnd, Span::default()))
}

fn broken(error: &ScanError) -> Error {
    let text = format!("this is no YAML: {}", shown(error.info()));
    Error::new(ErrorKind::Syntax, text).at_line(error.marker().line())
}
