//! The values of a YAML file, as `load_yaml` reads them: YAML 1.1 with tags of units. Main function: [`parse`].

use std::collections::HashMap;
use std::f64::consts::PI;
use std::rc::Rc;

use saphyr_parser::{Event, Parser, ScalarStyle, ScanError, Span, StrInput, Tag};

use super::budget::Budget;
use super::expression::{Context, Value, evaluate, insert};
use crate::document::shown;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::limits;

/// The tags of units, each with its value in radians or metres.
const UNITS: [(&str, f64); 6] = [
    ("radians", 1.0),
    ("degrees", PI / 180.0),
    ("meters", 1.0),
    ("millimeters", 0.001),
    ("foot", 0.3048),
    ("inches", 0.0254),
];

/// The value of the first document of `text`; `None` for an empty one.
///
/// # Errors
/// With the line: [`ErrorKind::Syntax`] for invalid YAML and for more than 20 levels; [`ErrorKind::Unsupported`] for
/// an unknown tag; [`ErrorKind::BadValue`] above the limits of the budget.
pub fn parse(text: &str, budget: &mut Budget) -> Result<Value> {
    let parser = Parser::new_from_str(text.trim_start_matches('\u{feff}'));
    let mut reader = Reader { parser, anchors: HashMap::new(), budget };
    loop {
        match reader.next()? {
            (Event::StreamStart | Event::DocumentStart(_), _) => {}
            (Event::StreamEnd | Event::DocumentEnd, _) => return Ok(Value::None),
            (event, line) => return reader.value(event, line, 1),
        }
    }
}

struct Reader<'t, 'b> {
    parser: Parser<'t, StrInput<'t>>,
    anchors: HashMap<usize, Value>,
    budget: &'b mut Budget,
}

impl<'t> Reader<'t, '_> {
    /// The next event, and its line.
    fn next(&mut self) -> Result<(Event<'t>, usize)> {
        let end: std::result::Result<(Event<'t>, Span), ScanError> = Ok((Event::StreamEnd, Span::default()));
        let event = self.parser.next_event().unwrap_or(end);
        let (event, span) = event.map_err(|error| {
            let text = format!("this is no YAML: {}", shown(error.info()));
            Error::new(ErrorKind::Syntax, text).at_line(error.marker().line())
        })?;
        Ok((event, span.start.line()))
    }

    /// Reads the value that begins with `event`.
    fn value(&mut self, event: Event<'t>, line: usize, depth: usize) -> Result<Value> {
        self.budget.spend(0).map_err(|error| error.at_line(line))?;
        if depth > limits::YAML_DEPTH {
            let text = format!("lists and mappings are nested deeper than {}", limits::YAML_DEPTH);
            return Err(Error::new(ErrorKind::Syntax, text).at_line(line));
        }
        let (value, anchor) = match event {
            Event::Scalar(text, style, anchor, tag) => {
                let value = self.scalar(&text, style, tag.as_deref());
                (value.map_err(|error| error.at_line(line))?, anchor)
            }
            Event::Alias(anchor) => (self.anchors.get(&anchor).cloned().unwrap_or(Value::None), 0),
            Event::SequenceStart(anchor, _) => (self.list(depth)?, anchor),
            Event::MappingStart(anchor, _) => (self.mapping(depth)?, anchor),
            _ => return Err(Error::new(ErrorKind::Syntax, "a value is missing here").at_line(line)),
        };
        // The parser counts anchors from one.
        if anchor > 0 {
            self.anchors.insert(anchor, value.clone());
        }
        Ok(value)
    }

    fn list(&mut self, depth: usize) -> Result<Value> {
        let mut list = Vec::new();
        loop {
            let (event, line) = self.next()?;
            if event == Event::SequenceEnd {
                return Ok(Value::list(list));
            }
            list.push(self.value(event, line, depth + 1)?);
        }
    }

    fn mapping(&mut self, depth: usize) -> Result<Value> {
        let (mut own, mut merged) = (Vec::new(), Vec::new());
        loop {
            let (event, line) = self.next()?;
            if event == Event::MappingEnd {
                break;
            }
            let key = self.value(event, line, depth + 1)?;
            let (event, place) = self.next()?;
            let value = self.value(event, place, depth + 1)?;
            if matches!(&key, Value::Text(text) if &**text == "<<") {
                merged.push(value);
            } else {
                insert(&mut own, key, value, self.budget).map_err(|error| error.at_line(line))?;
            }
        }
        let mut entries = Vec::new();
        for value in merged {
            self.merge(&value, &mut entries)?;
        }
        for (key, value) in own {
            insert(&mut entries, key, value, self.budget)?;
        }
        Ok(Value::Dict(Rc::new(entries)))
    }

    /// Adds the entries of a mapping after `<<`, or of a list of mappings, of which the first one counts.
    fn merge(&mut self, value: &Value, entries: &mut Vec<(Value, Value)>) -> Result<()> {
        match value {
            Value::Dict(given) => {
                for (key, value) in given.iter() {
                    insert(entries, key.clone(), value.clone(), self.budget)?;
                }
            }
            Value::List(list) => {
                for value in list.iter().rev().filter(|value| matches!(value, Value::Dict(_))) {
                    self.merge(value, entries)?;
                }
            }
            _ => {}
        }
        Ok(())
    }

    fn scalar(&mut self, text: &str, style: ScalarStyle, tag: Option<&Tag>) -> Result<Value> {
        self.budget.spend_length(text.len())?;
        let Some(tag) = tag else {
            return Ok(if style == ScalarStyle::Plain { plain(text) } else { Value::text(text) });
        };
        let unit = UNITS.iter().find(|(name, _)| tag.handle == "!" && tag.suffix == *name);
        if let Some((_, unit)) = unit {
            let value = evaluate(text.trim(), &mut Unit { budget: self.budget })?;
            let value = match &value {
                Value::Text(text) => super::expression::parse_float(text),
                value => value.number(),
            };
            let bad = || Error::new(ErrorKind::BadValue, format!("`{}` is not a number", shown(text)));
            return value.map(|value| Value::Float(value * unit)).ok_or_else(bad);
        }
        let number = || plain(text).number();
        match tag.suffix.as_str() {
            "str" => Ok(Value::text(text)),
            "float" if number().is_some() => Ok(Value::Float(number().unwrap_or(0.0))),
            "int" | "bool" | "null" => Ok(plain(text)),
            _ => {
                let units: Vec<String> = UNITS.iter().map(|(name, _)| format!("!{name}")).collect();
                let text = format!("the tag `!{}` is not known; allowed: {}", shown(&tag.suffix), units.join(", "));
                Err(Error::new(ErrorKind::Unsupported, text))
            }
        }
    }
}

/// The value of a scalar without quotes, by the rules of YAML 1.1.
fn plain(text: &str) -> Value {
    match text {
        "" | "~" | "null" | "Null" | "NULL" => return Value::None,
        "yes" | "Yes" | "YES" | "true" | "True" | "TRUE" | "on" | "On" | "ON" => return Value::Bool(true),
        "no" | "No" | "NO" | "false" | "False" | "FALSE" | "off" | "Off" | "OFF" => return Value::Bool(false),
        ".nan" | ".NaN" | ".NAN" => return Value::Float(f64::NAN),
        _ => {}
    }
    let (sign, digits) = match text.strip_prefix('-') {
        Some(digits) => (-1, digits),
        None => (1, text.strip_prefix('+').unwrap_or(text)),
    };
    let number = integer(digits).and_then(|value| value.checked_mul(sign)).map(Value::Int);
    let float = || float(digits).map(|value| Value::Float(value * sign as f64));
    number.or_else(float).unwrap_or_else(|| Value::text(text))
}

/// An integer of YAML 1.1: decimal, octal after `0`, hexadecimal after `0x`, binary after `0b`, or with base 60.
fn integer(digits: &str) -> Option<i128> {
    if !digits.starts_with(|c: char| c.is_ascii_digit()) {
        return None;
    }
    let plain = digits.replace('_', "");
    if plain.contains(':') {
        let mut parts = plain.split(':').map(|part| part.parse::<i128>().ok());
        let first = parts.next()??;
        return parts.try_fold(first, |sum, part| sum.checked_mul(60)?.checked_add(part.filter(|part| *part < 60)?));
    }
    let (radix, plain) = match (plain.get(..2), plain.get(..1)) {
        (Some("0x"), _) => (16, &plain[2..]),
        (Some("0b"), _) => (2, &plain[2..]),
        (Some(_), Some("0")) => (8, &plain[1..]),
        _ => (10, &plain[..]),
    };
    i128::from_str_radix(plain, radix).ok()
}

/// A float of YAML 1.1: it has a point, and a sign after `e`.
fn float(digits: &str) -> Option<f64> {
    if [".inf", ".Inf", ".INF"].contains(&digits) {
        return Some(f64::INFINITY);
    }
    let (mantissa, exponent) = digits.split_once(['e', 'E']).map_or((digits, None), |(m, e)| (m, Some(e)));
    let (whole, part) = mantissa.split_once('.')?;
    let is_digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit() || byte == b'_');
    let is_exponent = |text: &str| text.len() > 1 && text.starts_with(['+', '-']) && is_digits(&text[1..]);
    let is_number = is_digits(whole) && is_digits(part) && !(whole.is_empty() && part.is_empty());
    let is_float = is_number && !whole.starts_with('_') && exponent.is_none_or(is_exponent);
    if is_float { digits.replace('_', "").parse().ok() } else { None }
}

/// The names of an expression after the tag of a unit: the built-in ones.
struct Unit<'b> {
    budget: &'b mut Budget,
}

impl Context for Unit<'_> {
    fn budget(&mut self) -> &mut Budget {
        self.budget
    }

    fn name(&mut self, _: &str) -> Result<Option<Value>> {
        Ok(None)
    }

    fn member(&mut self, _: usize, _: &str) -> Result<Option<Value>> {
        Ok(None)
    }

    fn call(&mut self, function: &'static str, _: &[Value]) -> Result<Value> {
        let text = format!("`{function}` is not available in YAML");
        Err(Error::new(ErrorKind::Unsupported, text))
    }
}
