//! The tables of properties and macros. Main type: [`Tables`].

use std::collections::HashMap;
use std::rc::Rc;

use super::expression::{Value, parse_float, parse_int};
use super::node::Element;

/// The value of a property.
#[derive(Clone, Debug)]
pub enum Symbol {
    /// A text that is evaluated at its first use, in the scope of its definition.
    Lazy(Rc<str>),
    /// A text whose evaluation has begun.
    Evaluating,
    Value(Value),
    /// The elements of a block.
    Block(Rc<Element>),
}

/// A macro, or the macros of an include with `ns`.
#[derive(Clone, Debug)]
pub enum Named {
    Macro(Rc<Macro>),
    Namespace(usize),
}

/// A macro: its parameters and its element.
#[derive(Debug)]
pub struct Macro {
    pub name: String,
    pub parameters: Vec<Parameter>,
    pub body: Rc<Element>,
}

/// A parameter of a macro.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Parameter {
    /// The name, with `*` or `**` for a block.
    pub name: String,
    /// Whether the default is the caller's property of the same name.
    pub is_forwarded: bool,
    pub default: Option<String>,
}

/// The scope of an element: the tables of its macros and of its properties.
#[derive(Clone, Copy, Debug)]
pub struct Scope {
    pub macros: usize,
    pub symbols: usize,
}

/// A table with the names of one scope.
struct Table<T> {
    parent: Option<usize>,
    is_namespace: bool,
    entries: HashMap<String, T>,
}

/// All tables of one kind.
pub struct Tables<T> {
    tables: Vec<Table<T>>,
}

impl<T> Tables<T> {
    /// The table of the whole description, with the index zero.
    pub fn new() -> Self {
        let mut tables = Tables { tables: Vec::new() };
        tables.add(None, false);
        tables
    }

    /// Adds an empty table and returns its index.
    pub fn add(&mut self, parent: Option<usize>, is_namespace: bool) -> usize {
        self.tables.push(Table { parent, is_namespace, entries: HashMap::new() });
        self.tables.len() - 1
    }

    /// The table with `name`: `from`, or the nearest one above it.
    pub fn holder(&self, from: usize, name: &str) -> Option<usize> {
        let mut next = Some(from);
        while let Some(table) = next {
            if self.tables[table].entries.contains_key(name) {
                return Some(table);
            }
            next = self.tables[table].parent;
        }
        None
    }

    /// The entry of `name` in `from` or above it.
    pub fn find(&self, from: usize, name: &str) -> Option<&T> {
        self.tables[self.holder(from, name)?].entries.get(name)
    }

    /// Sets the entry of `name` in `table`.
    pub fn set(&mut self, table: usize, name: &str, value: T) {
        self.tables[table].entries.insert(name.to_owned(), value);
    }

    /// Removes `name` from `table` and from all above it.
    pub fn remove(&mut self, table: usize, name: &str) {
        let mut next = Some(table);
        while let Some(table) = next {
            self.tables[table].entries.remove(name);
            next = self.tables[table].parent;
        }
    }

    /// The table above `table`. Above a macro's table, namespaces are skipped.
    pub fn caller(&self, table: usize) -> Option<usize> {
        let mut next = self.tables[table].parent?;
        while !self.tables[table].is_namespace && self.tables[next].is_namespace {
            next = self.tables[next].parent?;
        }
        Some(next)
    }

    /// The outermost table above `table`.
    pub fn top(&self, table: usize) -> usize {
        let mut top = table;
        while let Some(parent) = self.tables[top].parent {
            top = parent;
        }
        top
    }
}

/// The value of the text of a property: the text in single quotes, else a number or a truth value, else a text.
pub fn literal(text: &str) -> Value {
    if text.len() >= 2 && text.starts_with('\'') && text.ends_with('\'') {
        return Value::text(&text[1..text.len() - 1]);
    }
    if text.contains('_') {
        return Value::text(text);
    }
    if let Some(value) = parse_int(text) {
        return Value::Int(value);
    }
    if let Some(value) = parse_float(text) {
        return Value::Float(value);
    }
    match text {
        "true" | "True" => Value::Bool(true),
        "false" | "False" => Value::Bool(false),
        _ => Value::text(text),
    }
}

/// The parameters in the attribute `params` of a macro: names, each with a default after `:=` or `=`.
pub fn parameters(text: &str) -> Vec<Parameter> {
    let mut rest = text.trim_start();
    let mut parameters = Vec::new();
    while !rest.is_empty() {
        let end = rest.find(|c: char| c.is_whitespace() || c == '=' || c == ':').unwrap_or(rest.len()).max(1);
        let end = (end..=rest.len()).find(|end| rest.is_char_boundary(*end)).unwrap_or(rest.len());
        let name = rest[..end].to_owned();
        let after = rest[end..].trim_start();
        let assigned = after.strip_prefix(":=").or_else(|| after.strip_prefix('='));
        let Some(value) = assigned else {
            parameters.push(Parameter { name, is_forwarded: false, default: None });
            rest = after;
            continue;
        };
        let value = value.trim_start();
        let forwarded = value.strip_prefix('^').map(|value| value.strip_prefix('|').unwrap_or(value));
        let value = forwarded.unwrap_or(value);
        let length = default_length(value);
        let default = Some(value[..length].to_owned()).filter(|default| !default.is_empty());
        parameters.push(Parameter { name, is_forwarded: forwarded.is_some(), default });
        rest = value[length..].trim_start();
    }
    parameters
}

/// The length of a default value: to the next blank outside of quotes, `${...}` and `$(...)`.
fn default_length(text: &str) -> usize {
    let mut close = None;
    let mut last = ' ';
    for (at, c) in text.char_indices() {
        match close {
            Some(end) if c == end => close = None,
            Some(_) => {}
            None if c.is_whitespace() => return at,
            None => {
                close = match c {
                    '\'' | '"' => Some(c),
                    '{' if last == '$' => Some('}'),
                    '(' if last == '$' => Some(')'),
                    _ => None,
                }
            }
        }
        last = c;
    }
    text.len()
}
