//! Definitions and calls of macros, blocks, properties and arguments.

use std::rc::Rc;

use super::expand::{Expander, Output, limited};
use super::expression::Value;
use super::node::{Element, Node};
use super::scope::{Macro, Named, Parameter, Scope, Symbol, parameters};
use crate::document::shown;
use crate::{Error, ErrorKind, Result};

/// Steps that a call of a macro takes, in 16ths: its tables need memory.
const CALL: usize = 16 * 10;
/// The words of Python that are not names of properties.
const KEYWORDS: [&str; 35] = [
    "False", "None", "True", "and", "as", "assert", "async", "await", "break", "class", "continue", "def", "del",
    "elif", "else", "except", "finally", "for", "from", "global", "if", "import", "in", "is", "lambda", "nonlocal",
    "not", "or", "pass", "raise", "return", "try", "while", "with", "yield",
];

impl Expander<'_> {
    /// `xacro:macro`: defines a macro.
    pub fn define_macro(&mut self, element: &Rc<Element>, scope: Scope) -> Result<()> {
        let name = self.required(element, "name")?;
        let name = name.strip_prefix("xacro:").unwrap_or(name);
        if name == "call" || name.is_empty() || name.contains('.') {
            let text = format!("defines the macro `{}`; give another name, without `.`", shown(name));
            return Err(self.error(element, ErrorKind::BadValue, &text));
        }
        let parameters = parameters(element.attribute("params").unwrap_or(""));
        self.budget.spend(CALL)?;
        let entry = Macro { name: name.to_owned(), parameters, body: element.clone() };
        self.macros.set(scope.macros, name, Named::Macro(Rc::new(entry)));
        Ok(())
    }

    /// `xacro:arg`: the default of an argument.
    pub fn argument(&mut self, element: &Element, scope: Scope) -> Result<()> {
        let (name, default) = (self.required(element, "name")?, self.required(element, "default")?);
        if !self.arguments.contains_key(name) {
            let value = self.string(default, scope.symbols)?;
            self.arguments.insert(name.to_owned(), value.to_string());
        }
        Ok(())
    }

    /// `xacro:property`: defines or removes a property.
    pub fn property(&mut self, element: &Rc<Element>, scope: Scope) -> Result<()> {
        let table = scope.symbols;
        let name = self.string(self.required(element, "name")?, table)?;
        let bad = |expander: &Self, text: String| expander.error(element, ErrorKind::BadValue, &text);
        let is_name = name.starts_with(|c: char| c.is_alphabetic() || c == '_')
            && name.chars().all(|c| c.is_alphanumeric() || c == '_');
        if !is_name || name.starts_with("__") || KEYWORDS.contains(&&*name) {
            let text = format!("has the name `{}`; give a letter or `_`, then letters, digits and `_`", shown(&name));
            return Err(bad(self, text));
        }
        let (value, default) = (element.attribute("value"), element.attribute("default"));
        let is_removed = self.option(element, "remove", false, scope)?;
        if usize::from(value.is_some()) + usize::from(default.is_some()) + usize::from(is_removed) > 1 {
            return Err(bad(self, "has more than one of `value`, `default` and `remove`; give one".to_owned()));
        }
        let is_known = self.symbols.holder(table, &name).is_some();
        if is_removed && is_known {
            self.symbols.remove(table, &name);
            return Ok(());
        }
        if default.is_some() && is_known {
            return Ok(());
        }
        let is_lazy = self.option(element, "lazy_eval", true, scope)?;
        let (target, is_greedy) = match element.attribute("scope") {
            Some("global") => (self.symbols.top(table), true),
            Some("parent") => match self.symbols.caller(table) {
                Some(parent) => (parent, true),
                None => return Err(bad(self, "has the scope `parent` outside of a macro; omit the scope".to_owned())),
            },
            _ => (table, false),
        };
        self.budget.spend(CALL)?;
        let Some(text) = value.or(default) else {
            self.symbols.set(target, &format!("**{name}"), Symbol::Block(element.clone()));
            return Ok(());
        };
        let is_lazy = is_lazy && !is_greedy;
        let value = if is_lazy { Value::text(text) } else { self.text(text, table)? };
        self.define(target, &name, value, is_lazy);
        Ok(())
    }

    /// The truth value of an optional attribute.
    fn option(&mut self, element: &Element, name: &str, absent: bool, scope: Scope) -> Result<bool> {
        match element.attribute(name).filter(|text| !text.is_empty()) {
            Some(text) => self.condition(text, scope.symbols),
            None => Ok(absent),
        }
    }

    /// `xacro:insert_block`: inserts a block, evaluated in this scope.
    pub fn insert_block(&mut self, element: &Element, scope: Scope, out: &mut Output) -> Result<()> {
        let name = self.string(self.required(element, "name")?, scope.symbols)?;
        let found = |expander: &Self, stars: &str| match expander.symbols.find(scope.symbols, &format!("{stars}{name}"))
        {
            Some(Symbol::Block(block)) => Some(block.clone()),
            _ => None,
        };
        if let Some(block) = found(self, "**") {
            return self.content(&block.children, scope, out);
        }
        let Some(block) = found(self, "*") else {
            let text = format!("inserts the block `{}`, which is not defined", shown(&name));
            return Err(self.error(element, ErrorKind::UnknownName, &text));
        };
        let expanded = self.plain(&block, scope)?;
        out.nodes.push(Node::Element(Rc::new(expanded)));
        Ok(())
    }

    /// The macro with the name of `element`, and its scope.
    fn resolve(&mut self, element: &Element, name: &str, scope: Scope) -> Result<(Rc<Macro>, Scope)> {
        if let Some(Named::Macro(found)) = self.macros.find(scope.macros, name) {
            return Ok((found.clone(), scope));
        }
        let mut inner = scope;
        let mut parts = name.split('.').peekable();
        while let Some(part) = parts.next() {
            match self.macros.find(inner.macros, part) {
                Some(Named::Macro(found)) if parts.peek().is_none() => return Ok((found.clone(), inner)),
                Some(Named::Namespace(macros)) => inner.macros = *macros,
                _ => break,
            }
            match self.symbol(inner.symbols, part)? {
                Some(Value::Namespace(symbols)) => inner.symbols = symbols,
                _ => break,
            }
        }
        let text = format!("is not a macro; `{}` is not defined", shown(name));
        Err(self.error(element, ErrorKind::UnknownName, &text))
    }

    /// A call of a macro, by its name or by `xacro:call`.
    pub fn call(&mut self, element: &Element, scope: Scope, out: &mut Output) -> Result<()> {
        let is_dynamic = element.name == "xacro:call";
        let name: Rc<str> = if is_dynamic {
            self.string(self.required(element, "macro")?, scope.symbols)?
        } else {
            element.name.trim_start_matches("xacro:").into()
        };
        let (called, outer) = self.resolve(element, &name, scope)?;
        self.budget.spend(CALL)?;
        let inner = Scope {
            macros: self.macros.add(Some(outer.macros), false),
            symbols: self.symbols.add(Some(outer.symbols), false),
        };
        self.bind(element, &called, scope, inner.symbols)?;
        let result = self.content(&called.body.children, inner, out);
        result.map_err(|error| self.in_macro(error, &called, element))
    }

    fn in_macro(&self, error: Error, called: &Macro, element: &Element) -> Error {
        let file = self.files[element.location.file].display().to_string();
        let place = format!("{} line {}", shown(&file), element.location.line);
        let error = self.located(error, called.body.location);
        if error.message().len() > 500 {
            return error;
        }
        error.with_advice(format!("in the macro `{}`, called at {place}", shown(&called.name)))
    }

    /// Sets the parameters of a call in the table `inner`.
    fn bind(&mut self, element: &Element, called: &Macro, scope: Scope, inner: usize) -> Result<()> {
        let mut open: Vec<&Parameter> = called.parameters.iter().collect();
        for (name, text) in &element.attributes {
            if name.starts_with("xmlns") || (element.name == "xacro:call" && name == "macro") {
                continue;
            }
            let Some(place) = open.iter().position(|parameter| parameter.name == *name) else {
                let text = format!("has `{}`, which is no parameter of the macro, or is given twice", shown(name));
                return Err(self.error(element, ErrorKind::UnknownKey, &text));
            };
            open.remove(place);
            let value = self.text(text, scope.symbols)?;
            self.define(inner, name, value, false);
        }
        let mut blocks = Output { takes_attributes: true, ..Output::default() };
        self.children(&element.children, scope, &mut blocks)?;
        let mut blocks = blocks.nodes.into_iter().filter_map(|node| match node {
            Node::Element(block) => Some(block),
            Node::Text(_) => None,
        });
        for parameter in open.extract_if(.., |parameter| parameter.name.starts_with('*')) {
            let Some(block) = blocks.next() else {
                let text = format!("has no element for the block `{}`; give one", shown(&parameter.name));
                return Err(self.error(element, ErrorKind::MissingKey, &text));
            };
            self.symbols.set(inner, &parameter.name, Symbol::Block(block));
        }
        if let Some(block) = blocks.next() {
            let text = format!("has <{}>, but the macro takes no other block", shown(&block.name));
            return Err(self.error(element, ErrorKind::UnknownKey, &text));
        }
        for parameter in open {
            let value = self.default(element, parameter, scope.symbols)?;
            self.define(inner, &parameter.name, value, false);
        }
        Ok(())
    }

    /// The default of a parameter, in the scope of the call.
    fn default(&mut self, element: &Element, parameter: &Parameter, symbols: usize) -> Result<Value> {
        if parameter.is_forwarded
            && let Some(value) = self.symbol(symbols, &parameter.name)?
        {
            return Ok(value);
        }
        let name = shown(&parameter.name);
        let Some(text) = &parameter.default else {
            let text = format!("has no `{name}`, and the macro has no default for it; give it");
            return Err(self.error(element, ErrorKind::MissingKey, &text));
        };
        let value = self.text(text, symbols);
        value.map_err(|error| limited(error, &format!("in the default of the parameter `{name}`")))
    }
}
