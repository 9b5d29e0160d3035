//! The values of expressions, with the texts that Python prints for them. Main type: [`Value`].

use std::rc::Rc;

use crate::model::xacro::budget::{Budget, check_length};
use crate::{Error, ErrorKind, Result};

/// The value of an expression.
#[derive(Clone, Debug)]
pub enum Value {
    None,
    Bool(bool),
    Int(i128),
    Float(f64),
    Text(Rc<str>),
    List(Rc<Vec<Value>>),
    Tuple(Rc<Vec<Value>>),
    /// Keys and values in the order of insertion.
    Dict(Rc<Vec<(Value, Value)>>),
    /// A built-in function, by its name without a module.
    Function(&'static str),
    /// A module of functions: `math`, `xacro` or `python`.
    Module(&'static str),
    /// The table of an include with `ns`.
    Namespace(usize),
}

impl Value {
    /// A text.
    pub fn text(text: impl Into<Rc<str>>) -> Value {
        Value::Text(text.into())
    }

    /// A list.
    pub fn list(values: Vec<Value>) -> Value {
        Value::List(Rc::new(values))
    }

    /// The name of the type, as in Python.
    pub fn kind(&self) -> &'static str {
        match self {
            Value::None => "None",
            Value::Bool(_) => "bool",
            Value::Int(_) => "int",
            Value::Float(_) => "float",
            Value::Text(_) => "str",
            Value::List(_) => "list",
            Value::Tuple(_) => "tuple",
            Value::Dict(_) => "dict",
            Value::Function(_) => "function",
            Value::Module(_) | Value::Namespace(_) => "namespace",
        }
    }

    /// Whether the value counts as true.
    pub fn is_true(&self) -> bool {
        match self {
            Value::None => false,
            Value::Bool(value) => *value,
            Value::Int(value) => *value != 0,
            Value::Float(value) => *value != 0.0,
            Value::Text(text) => !text.is_empty(),
            Value::List(list) | Value::Tuple(list) => !list.is_empty(),
            Value::Dict(entries) => !entries.is_empty(),
            Value::Function(_) | Value::Module(_) | Value::Namespace(_) => true,
        }
    }

    /// The number, for a bool, an int or a float.
    pub fn number(&self) -> Option<f64> {
        match self {
            Value::Float(value) => Some(*value),
            _ => self.integer().map(|value| value as f64),
        }
    }

    /// The integer, for a bool or an int.
    pub fn integer(&self) -> Option<i128> {
        match self {
            Value::Bool(value) => Some(i128::from(*value)),
            Value::Int(value) => Some(*value),
            _ => None,
        }
    }

    /// The text that `str` makes of it.
    ///
    /// # Errors
    /// Those of [`Budget::spend_length`].
    pub fn shown(&self, budget: &mut Budget) -> Result<Rc<str>> {
        if let Value::Text(text) = self {
            budget.spend_length(text.len())?;
            return Ok(text.clone());
        }
        let mut out = String::new();
        self.write(&mut out, budget)?;
        Ok(out.into())
    }

    /// Appends the text that `repr` makes of it.
    ///
    /// # Errors
    /// Those of [`Budget::spend_length`] and [`Budget::enter`].
    pub fn write(&self, out: &mut String, budget: &mut Budget) -> Result<()> {
        let start = out.len();
        match self {
            Value::None => out.push_str("None"),
            Value::Bool(value) => out.push_str(if *value { "True" } else { "False" }),
            Value::Int(value) => *out += &value.to_string(),
            Value::Float(value) => *out += &float_text(*value),
            Value::Text(text) => quote(text, out),
            Value::List(list) => write_list(list, ["[", "]"], out, budget)?,
            Value::Tuple(list) if list.len() == 1 => write_list(list, ["(", ",)"], out, budget)?,
            Value::Tuple(list) => write_list(list, ["(", ")"], out, budget)?,
            Value::Dict(entries) => write_entries(entries, out, budget)?,
            Value::Function(_) | Value::Module(_) | Value::Namespace(_) => {
                let text = format!("a {} has no text; give a number or a text", self.kind());
                return Err(Error::new(ErrorKind::BadValue, text));
            }
        }
        check_length(out.len())?;
        budget.spend(out.len() - start)
    }

    /// Whether both are equal, as `==` in Python.
    ///
    /// # Errors
    /// Those of [`Budget::spend`] and [`Budget::enter`].
    pub fn equals(&self, other: &Value, budget: &mut Budget) -> Result<bool> {
        budget.spend(0)?;
        Ok(match (self, other) {
            (Value::None, Value::None) => true,
            (Value::Text(a), Value::Text(b)) => {
                budget.spend(a.len().min(b.len()))?;
                a == b
            }
            (Value::List(a), Value::List(b)) | (Value::Tuple(a), Value::Tuple(b)) => lists_equal(a, b, budget)?,
            (Value::Dict(a), Value::Dict(b)) => dicts_equal(a, b, budget)?,
            (Value::Function(a), Value::Function(b)) | (Value::Module(a), Value::Module(b)) => a == b,
            (Value::Namespace(a), Value::Namespace(b)) => a == b,
            _ => match (self.integer(), other.integer()) {
                (Some(a), Some(b)) => a == b,
                _ => self.number().zip(other.number()).is_some_and(|(a, b)| a == b),
            },
        })
    }

    /// The value of `key` in a dict.
    ///
    /// # Errors
    /// Those of [`Value::equals`].
    pub fn entry(entries: &[(Value, Value)], key: &Value, budget: &mut Budget) -> Result<Option<Value>> {
        for (name, value) in entries {
            if name.equals(key, budget)? {
                return Ok(Some(value.clone()));
            }
        }
        Ok(None)
    }
}

fn lists_equal(a: &[Value], b: &[Value], budget: &mut Budget) -> Result<bool> {
    if a.len() != b.len() {
        return Ok(false);
    }
    budget.enter()?;
    for (a, b) in a.iter().zip(b) {
        if !a.equals(b, budget)? {
            budget.leave();
            return Ok(false);
        }
    }
    budget.leave();
    Ok(true)
}

fn dicts_equal(a: &[(Value, Value)], b: &[(Value, Value)], budget: &mut Budget) -> Result<bool> {
    if a.len() != b.len() {
        return Ok(false);
    }
    budget.enter()?;
    for (key, value) in a {
        let other = Value::entry(b, key, budget)?;
        let is_equal = other.map_or(Ok(false), |other| other.equals(value, budget))?;
        if !is_equal {
            budget.leave();
            return Ok(false);
        }
    }
    budget.leave();
    Ok(true)
}

fn write_list(list: &[Value], [open, close]: [&str; 2], out: &mut String, budget: &mut Budget) -> Result<()> {
    budget.enter()?;
    out.push_str(open);
    for (index, value) in list.iter().enumerate() {
        out.push_str(if index > 0 { ", " } else { "" });
        value.write(out, budget)?;
    }
    out.push_str(close);
    budget.leave();
    Ok(())
}

fn write_entries(entries: &[(Value, Value)], out: &mut String, budget: &mut Budget) -> Result<()> {
    budget.enter()?;
    out.push('{');
    for (index, (key, value)) in entries.iter().enumerate() {
        out.push_str(if index > 0 { ", " } else { "" });
        key.write(out, budget)?;
        out.push_str(": ");
        value.write(out, budget)?;
    }
    out.push('}');
    budget.leave();
    Ok(())
}

/// Appends `text` in quotes: single ones, unless it has only single quotes.
fn quote(text: &str, out: &mut String) {
    let quote = if text.contains('\'') && !text.contains('"') { '"' } else { '\'' };
    out.push(quote);
    for c in text.chars() {
        match c {
            '\n' => out.push_str("\\n"),
            '\r' => out.push_str("\\r"),
            '\t' => out.push_str("\\t"),
            '\\' => out.push_str("\\\\"),
            c if c == quote => out.extend(['\\', c]),
            c => out.push(c),
        }
    }
    out.push(quote);
}

/// The shortest decimal text of a double, with an exponent below 1e-4 and from 1e16, as Python prints it.
pub fn float_text(value: f64) -> String {
    if !value.is_finite() {
        return if value.is_nan() {
            "nan"
        } else if value > 0.0 {
            "inf"
        } else {
            "-inf"
        }
        .to_owned();
    }
    let text = format!("{value:e}");
    let (digits, exponent) = text.split_once('e').unwrap_or((&text, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    if (-4..16).contains(&exponent) {
        let plain = format!("{value}");
        return if plain.contains('.') { plain } else { format!("{plain}.0") };
    }
    format!("{digits}e{}{:02}", if exponent < 0 { '-' } else { '+' }, exponent.abs())
}

/// The integer in `text`, as `int` of Python reads it: blanks around it and `_` between digits are allowed.
pub fn parse_int(text: &str) -> Option<i128> {
    let text = text.trim();
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    if !digits.starts_with(|c: char| c.is_ascii_digit()) || digits.ends_with('_') || digits.contains("__") {
        return None;
    }
    text.replace('_', "").parse().ok()
}

/// The double in `text`, as `float` of Python reads it.
pub fn parse_float(text: &str) -> Option<f64> {
    let text = text.trim();
    let is_bad = text.starts_with('_') || text.ends_with('_') || text.contains("__");
    if is_bad || text.contains("_.") || text.contains("._") { None } else { text.replace('_', "").parse().ok() }
}

/// An error about a value.
pub fn bad(text: String) -> Error {
    Error::new(ErrorKind::BadValue, text)
}
