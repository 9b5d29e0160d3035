//! The expansion of elements. Main type: [`Expander`].

use std::collections::HashMap;
use std::path::{Path, PathBuf};
use std::rc::Rc;

use super::budget::Budget;
use super::expression::{Context, Value, evaluate};
use super::node::{Element, Location, Node};
use super::packages::Packages;
use super::scope::{Named, Scope, Symbol, Tables, literal};
use super::text::{Piece, pieces};
use crate::document::shown;
use crate::model::ReadOptions;
use crate::{Error, ErrorKind, Result};

/// Maximum length of a message to which the call of a macro is added.
const MESSAGE: usize = 500;
/// Maximum number of notes.
const NOTES: usize = 100;

/// The state of one expansion.
pub struct Expander<'o> {
    pub packages: Packages<'o>,
    pub budget: Budget,
    /// All files that were read, in the order of [`Location::file`].
    pub files: Vec<PathBuf>,
    /// The current file, and the files that include it.
    pub stack: Vec<PathBuf>,
    pub macros: Tables<Named>,
    pub symbols: Tables<Symbol>,
    /// The values of `$(arg ...)`.
    pub arguments: HashMap<String, String>,
    pub notes: Vec<String>,
}

/// The expansion of a list of elements.
#[derive(Default)]
pub struct Output {
    pub nodes: Vec<Node>,
    /// The attributes that `xacro:attribute` adds to the parent.
    pub attributes: Vec<(String, String)>,
    /// Whether the parent is an element that has attributes.
    pub takes_attributes: bool,
}

impl<'o> Expander<'o> {
    /// The state before the first element of `file`.
    pub fn new(file: &Path, options: &'o ReadOptions) -> Self {
        let folder = folder_of(file);
        let arguments = options.arguments().map(|(name, value)| (name.to_owned(), value.to_owned())).collect();
        Expander {
            packages: Packages::new(&folder, options),
            budget: Budget::new(),
            files: vec![file.to_owned()],
            stack: vec![file.to_owned()],
            macros: Tables::new(),
            symbols: Tables::new(),
            arguments,
            notes: Vec::new(),
        }
    }

    /// The expansion of the root element.
    ///
    /// # Errors
    /// Those of [`super::expand`].
    pub fn root(&mut self, root: &Rc<Element>) -> Result<Element> {
        let scope = Scope { macros: 0, symbols: 0 };
        self.plain(root, scope).map_err(|error| self.located(error, root.location))
    }

    /// Adds the location to an error without one.
    pub fn located(&self, error: Error, location: Location) -> Error {
        error.at_line(location.line).in_file(&self.files[location.file])
    }

    /// The error of an element.
    pub fn error(&self, element: &Element, kind: ErrorKind, message: &str) -> Error {
        self.located(Error::new(kind, format!("<{}> {message}", shown(&element.name))), element.location)
    }

    /// The text of a required attribute.
    ///
    /// # Errors
    /// [`ErrorKind::MissingKey`].
    pub fn required<'e>(&self, element: &'e Element, name: &str) -> Result<&'e str> {
        let missing = || self.error(element, ErrorKind::MissingKey, &format!("has no `{name}`; it is required"));
        element.attribute(name).ok_or_else(missing)
    }

    /// Adds a note about an element, once.
    pub fn note(&mut self, location: Location, text: &str) {
        let file = self.files[location.file].file_name().map(|name| name.to_string_lossy().into_owned());
        let note = format!("{} line {}: {text}", shown(&file.unwrap_or_default()), location.line);
        if self.notes.len() < NOTES && !self.notes.contains(&note) {
            self.notes.push(note);
        }
    }

    /// The value of a text with `${...}` and `$(...)`. A text of one expression has the value of the expression.
    ///
    /// # Errors
    /// Those of [`super::expand`].
    pub fn text(&mut self, text: &str, symbols: usize) -> Result<Value> {
        self.budget.spend_length(text.len())?;
        if !text.contains('$') {
            return Ok(Value::text(text));
        }
        self.budget.enter()?;
        let pieces = pieces(text)?;
        let mut values = Vec::with_capacity(pieces.len());
        for piece in pieces {
            values.push(match piece {
                Piece::Plain(text) => Value::text(text),
                Piece::Expression(inner) => self.expression(inner, symbols)?,
                Piece::Command(inner) => self.command(inner, symbols)?,
            });
        }
        self.budget.leave();
        if let [value] = values.as_slice() {
            return Ok(value.clone());
        }
        let mut joined = String::new();
        for value in values {
            joined += &value.shown(&mut self.budget)?;
            self.budget.spend_length(joined.len())?;
        }
        Ok(Value::text(joined))
    }

    /// The text that [`Expander::text`] is printed as.
    ///
    /// # Errors
    /// Those of [`super::expand`].
    pub fn string(&mut self, text: &str, symbols: usize) -> Result<Rc<str>> {
        let value = self.text(text, symbols)?;
        value.shown(&mut self.budget)
    }

    fn expression(&mut self, inner: &str, symbols: usize) -> Result<Value> {
        let text = self.string(inner, symbols)?;
        let value = evaluate(text.trim(), &mut Names { expander: self, symbols });
        value.map_err(|error| expression_error(error, "${", inner, "}"))
    }

    /// The truth value of a condition.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a text that is neither true, false nor an integer.
    pub fn condition(&mut self, text: &str, symbols: usize) -> Result<bool> {
        match self.text(text, symbols)? {
            Value::Text(value) => truth(&value),
            value => Ok(value.is_true()),
        }
    }

    /// The value of a property; `None` if there is none.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a property that needs its own value; those of its text.
    pub fn symbol(&mut self, from: usize, name: &str) -> Result<Option<Value>> {
        self.budget.spend(0)?;
        let Some(table) = self.symbols.holder(from, name) else { return Ok(None) };
        match self.symbols.find(table, name).cloned() {
            Some(Symbol::Value(value)) => Ok(Some(value)),
            Some(Symbol::Lazy(text)) => {
                self.budget.enter()?;
                self.symbols.set(table, name, Symbol::Evaluating);
                let value = self.text(&text, table);
                let value = value.map_err(|error| limited(error, &format!("in the property `{}`", shown(name))))?;
                let value = if let Value::Text(text) = value { literal(&text) } else { value };
                self.symbols.set(table, name, Symbol::Value(value.clone()));
                self.budget.leave();
                Ok(Some(value))
            }
            Some(Symbol::Evaluating) => {
                let text = format!("the property `{}` needs its own value; give it another value", shown(name));
                Err(Error::new(ErrorKind::BadValue, text))
            }
            Some(Symbol::Block(_)) | None => Ok(None),
        }
    }

    /// Sets a property. A text is read as a number or a truth value; another text of a lazy one is evaluated at its
    /// first use.
    pub fn define(&mut self, table: usize, name: &str, value: Value, is_lazy: bool) {
        let value = if let Value::Text(text) = value { literal(&text) } else { value };
        let symbol = match value {
            Value::Text(text) if is_lazy => Symbol::Lazy(text),
            value => Symbol::Value(value),
        };
        self.symbols.set(table, name, symbol);
    }

    /// Expands children into `out`.
    ///
    /// # Errors
    /// Those of [`super::expand`].
    pub fn children(&mut self, nodes: &[Node], scope: Scope, out: &mut Output) -> Result<()> {
        for node in nodes {
            match node {
                Node::Element(element) => {
                    self.budget.enter()?;
                    self.budget.spend(0)?;
                    self.element(element, scope, out).map_err(|error| self.located(error, element.location))?;
                    self.budget.leave();
                }
                Node::Text(text) if text.trim().is_empty() => {}
                Node::Text(text) => {
                    let text = self.string(text, scope.symbols)?;
                    self.budget.spend_output(text.len())?;
                    out.nodes.push(Node::Text(text.to_string()));
                }
            }
        }
        Ok(())
    }

    /// Expands the content of an element that vanishes: a condition, a macro or an include.
    ///
    /// # Errors
    /// Those of [`super::expand`].
    pub fn content(&mut self, nodes: &[Node], scope: Scope, out: &mut Output) -> Result<()> {
        let takes_attributes = std::mem::replace(&mut out.takes_attributes, false);
        let result = self.children(nodes, scope, out);
        out.takes_attributes = takes_attributes;
        result
    }

    fn element(&mut self, element: &Rc<Element>, scope: Scope, out: &mut Output) -> Result<()> {
        let Some(name) = element.name.strip_prefix("xacro:") else {
            let expanded = self.plain(element, scope)?;
            out.nodes.push(Node::Element(Rc::new(expanded)));
            return Ok(());
        };
        match name {
            "insert_block" => self.insert_block(element, scope, out),
            "include" => self.include(element, scope, out),
            "property" => self.property(element, scope),
            "macro" => self.define_macro(element, scope),
            "arg" => self.argument(element, scope),
            "element" => self.named_element(element, scope, out),
            "attribute" => self.attribute(element, scope, out),
            "if" | "unless" => {
                let value = self.required(element, "value")?;
                if self.condition(value, scope.symbols)? == (name == "if") {
                    self.content(&element.children, scope, out)?;
                }
                Ok(())
            }
            _ => self.call(element, scope, out),
        }
    }

    /// The expansion of an element outside of xacro.
    pub fn plain(&mut self, element: &Element, scope: Scope) -> Result<Element> {
        let mut attributes = Vec::with_capacity(element.attributes.len());
        for (name, value) in &element.attributes {
            if !name.starts_with("xacro:") && name != "xmlns:xacro" {
                let value = self.string(value, scope.symbols)?;
                self.budget.spend_output(name.len() + value.len() + 4)?;
                attributes.push((name.clone(), value.to_string()));
            }
        }
        self.budget.spend_output(2 * element.name.len() + 5)?;
        let mut inner = Output { takes_attributes: true, ..Output::default() };
        self.children(&element.children, scope, &mut inner)?;
        for (name, value) in inner.attributes {
            match attributes.iter_mut().find(|(known, _)| *known == name) {
                Some((_, old)) => *old = value,
                None => attributes.push((name, value)),
            }
        }
        Ok(Element { name: element.name.clone(), attributes, children: inner.nodes, location: element.location })
    }

    /// `xacro:element`: an element whose name is evaluated.
    fn named_element(&mut self, element: &Element, scope: Scope, out: &mut Output) -> Result<()> {
        let name = self.string(self.required(element, "xacro:name")?, scope.symbols)?;
        self.check_xml_name(element, &name)?;
        let attributes = element.attributes.iter().filter(|(name, _)| name != "xacro:name").cloned().collect();
        let renamed = Element { name: name.to_string(), attributes, ..element.clone() };
        self.children(&[Node::Element(Rc::new(renamed))], scope, out)
    }

    /// `xacro:attribute`: an attribute of the parent.
    fn attribute(&mut self, element: &Element, scope: Scope, out: &mut Output) -> Result<()> {
        let name = self.string(self.required(element, "name")?, scope.symbols)?;
        let value = self.string(self.required(element, "value")?, scope.symbols)?;
        self.check_xml_name(element, &name)?;
        self.budget.spend_output(name.len() + value.len() + 4)?;
        if out.takes_attributes {
            out.attributes.push((name.to_string(), value.to_string()));
        } else {
            let text =
                "xacro:attribute has no effect in a condition, macro or include, as in ROS; use it in an element";
            self.note(element.location, text);
        }
        Ok(())
    }

    fn check_xml_name(&self, element: &Element, name: &str) -> Result<()> {
        let starts = name.starts_with(|c: char| c.is_alphabetic() || c == '_');
        if starts && name.chars().all(|c| c.is_alphanumeric() || "_-.:".contains(c)) {
            return Ok(());
        }
        let text = format!("has the name `{}`; give letters, digits, `_`, `-`, `.` and `:`", shown(name));
        Err(self.error(element, ErrorKind::BadValue, &text))
    }
}

/// The folder of a file; `.` for standard input.
pub fn folder_of(file: &Path) -> PathBuf {
    let folder = std::path::absolute(file).ok().and_then(|file| file.parent().map(Path::to_owned));
    folder.unwrap_or_else(|| PathBuf::from("."))
}

/// The error of an expression, with its text.
pub fn expression_error(error: Error, open: &str, inner: &str, close: &str) -> Error {
    limited(error, &format!("in `{open}{}{close}`", shown(inner)))
}

/// An error with `context` in front, unless its message is long already.
pub fn limited(error: Error, context: &str) -> Error {
    if error.message().len() > MESSAGE { error } else { error.with_context(context) }
}

/// The truth value of a text: true, false or an integer.
///
/// # Errors
/// [`ErrorKind::BadValue`] for another text.
pub fn truth(text: &str) -> Result<bool> {
    match text {
        "true" | "True" => Ok(true),
        "false" | "False" => Ok(false),
        _ => super::expression::parse_int(text).map(|value| value != 0).ok_or_else(|| {
            let text = format!("the condition is `{}`; give true, false or an integer", shown(text));
            Error::new(ErrorKind::BadValue, text)
        }),
    }
}

/// The names of an expression in a scope.
struct Names<'e, 'o> {
    expander: &'e mut Expander<'o>,
    symbols: usize,
}

impl Context for Names<'_, '_> {
    fn budget(&mut self) -> &mut Budget {
        &mut self.expander.budget
    }

    fn name(&mut self, name: &str) -> Result<Option<Value>> {
        self.expander.symbol(self.symbols, name)
    }

    fn member(&mut self, namespace: usize, name: &str) -> Result<Option<Value>> {
        self.expander.symbol(namespace, name)
    }

    fn call(&mut self, function: &'static str, arguments: &[Value]) -> Result<Value> {
        self.expander.function(function, arguments)
    }
}
