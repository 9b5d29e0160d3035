//! Reader of the subset of YAML that `map_server` uses: texts and lists of texts by key.
//!
//! `saphyr-parser` gives the events of the text one by one. Aliases share their values, and lists contain only texts,
//! so that nothing grows exponentially.

use std::collections::{HashMap, HashSet};
use std::fmt;
use std::rc::Rc;

use saphyr_parser::{Event, Parser, ScanError, Span, StrInput};

use crate::{Error, ErrorKind, Result};
use groebot_robot::document::shown;

/// The greatest depth of nesting.
const DEEPEST: usize = groebot_algebra::limits::YAML_DEPTH;

/// A value.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A scalar, without its quotes.
    Text(Rc<str>),
    /// A list.
    List(Rc<[Value]>),
    /// A mapping, or a value that is nested too deeply to be used.
    Other,
}

/// Prints a list as `[1, 2]`.
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

/// Reads the entries of the first document of `text`, which must be a mapping.
///
/// # Errors
/// With the line: [`ErrorKind::Syntax`] for invalid YAML, another kind of document, or more than 20 levels;
/// [`ErrorKind::DuplicateName`] for a key that is given twice.
pub fn entries(text: &str) -> Result<Vec<Entry>> {
    let mut reader =
        Reader { parser: Parser::new_from_str(text.trim_start_matches('\u{feff}')), anchors: HashMap::new() };
    loop {
        match reader.next()? {
            (Event::StreamStart | Event::DocumentStart(_), _) => {}
            (Event::MappingStart(..), _) => return reader.mapping(),
            (Event::StreamEnd, _) => return Ok(Vec::new()),
            (_, line) => {
                let text = "this is not a mapping; give `image: FILE` and `resolution: METRES`, one per line";
                return Err(Error::new(ErrorKind::Syntax, text).at_line(line));
            }
        }
    }
}

/// Converts events to values.
struct Reader<'t> {
    parser: Parser<'t, StrInput<'t>>,
    /// The values with anchors: texts and lists of texts.
    anchors: HashMap<usize, Value>,
}

impl<'t> Reader<'t> {
    /// The next event, and its line.
    fn next(&mut self) -> Result<(Event<'t>, usize)> {
        let (event, span): (Event<'t>, Span) =
            self.parser.next_event().unwrap_or_else(ended).map_err(|error| broken(&error))?;
        Ok((event, span.start.line()))
    }

    /// Reads the entries of a mapping after its start.
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

    /// Reads the value that begins with `event`.
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

    /// Reads a list after its start. A list in a list is skipped, so that no alias makes another one longer.
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

    /// Skips all events to the `end` of the current value.
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

/// The event after the last one.
fn ended<'t>() -> std::result::Result<(Event<'t>, Span), ScanError> {
    Ok((Event::StreamEnd, Span::default()))
}

fn broken(error: &ScanError) -> Error {
    let text = format!("this is no YAML: {}", shown(error.info()));
    Error::new(ErrorKind::Syntax, text).at_line(error.marker().line())
}
