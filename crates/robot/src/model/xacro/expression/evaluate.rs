//! The evaluation of expressions. Main function: [`evaluate`].

use super::functions;
use super::methods;
use super::operators::{binary, compare, index_of, unary};
use super::parser::parse;
use super::syntax::{Comparison, Comprehension, Expression};
use super::value::{Value, bad};
use crate::document::shown;
use crate::model::xacro::budget::Budget;
use crate::{Error, ErrorKind, Result};

/// The names of an expression, and the functions that need more than their arguments.
pub trait Context {
    /// The budget of the expansion.
    fn budget(&mut self) -> &mut Budget;

    /// The value of a name that is not built in.
    ///
    /// # Errors
    /// Those of its definition.
    fn name(&mut self, name: &str) -> Result<Option<Value>>;

    /// The value of a name in a namespace.
    ///
    /// # Errors
    /// Those of its definition.
    fn member(&mut self, namespace: usize, name: &str) -> Result<Option<Value>>;

    /// The value of a function that reads files, arguments or packages.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for a function that the context does not have.
    fn call(&mut self, function: &'static str, arguments: &[Value]) -> Result<Value>;
}

/// The value of the expression `text`.
///
/// # Errors
/// [`ErrorKind::Syntax`] for an invalid expression; [`ErrorKind::UnknownName`] for an unknown name;
/// [`ErrorKind::BadValue`] for an operation that its values do not allow, and above the limits of the budget.
pub fn evaluate(text: &str, context: &mut dyn Context) -> Result<Value> {
    context.budget().spend(text.len())?;
    let expression = parse(text)?;
    Evaluator { context, locals: Vec::new() }.value(&expression)
}

struct Evaluator<'c> {
    context: &'c mut dyn Context,
    /// The names of the comprehensions around the current expression.
    locals: Vec<(String, Value)>,
}

impl Evaluator<'_> {
    fn value(&mut self, expression: &Expression) -> Result<Value> {
        let budget = self.context.budget();
        budget.spend(0)?;
        budget.enter()?;
        let value = self.inner(expression)?;
        self.context.budget().leave();
        Ok(value)
    }

    fn inner(&mut self, expression: &Expression) -> Result<Value> {
        match expression {
            Expression::Literal(value) => Ok(value.clone()),
            Expression::Name(name) => self.name(name),
            Expression::List(values) => self.values(values).map(Value::list),
            Expression::Tuple(values) => Ok(Value::Tuple(self.values(values)?.into())),
            Expression::Dict(entries) => self.dict(entries),
            Expression::Comprehension(comprehension) => self.comprehension(comprehension),
            Expression::Unary(sign, value) => unary(*sign, &self.value(value)?),
            Expression::Binary(operator, a, b) => {
                let (a, b) = (self.value(a)?, self.value(b)?);
                binary(*operator, &a, &b, self.context.budget())
            }
            Expression::Compare(first, others) => self.compared(first, others),
            Expression::And(a, b) => {
                let first = self.value(a)?;
                if first.is_true() { self.value(b) } else { Ok(first) }
            }
            Expression::Or(a, b) => {
                let first = self.value(a)?;
                if first.is_true() { Ok(first) } else { self.value(b) }
            }
            Expression::If(parts) => {
                let [condition, value, other] = &**parts;
                if self.value(condition)?.is_true() { self.value(value) } else { self.value(other) }
            }
            Expression::Attribute(owner, name) => {
                let owner = self.value(owner)?;
                self.attribute(&owner, name)
            }
            Expression::Index(owner, index) => {
                let (owner, index) = (self.value(owner)?, self.value(index)?);
                index_of(&owner, &index, self.context.budget())
            }
            Expression::Slice(owner, bounds) => self.slice(owner, bounds),
            Expression::Call(function, values, named) => self.call(function, values, named),
        }
    }

    fn values(&mut self, expressions: &[Expression]) -> Result<Vec<Value>> {
        expressions.iter().map(|expression| self.value(expression)).collect()
    }

    fn name(&mut self, name: &str) -> Result<Value> {
        if let Some((_, value)) = self.locals.iter().rev().find(|(local, _)| local == name) {
            return Ok(value.clone());
        }
        if let Some(value) = self.context.name(name)? {
            return Ok(value);
        }
        functions::global(name).ok_or_else(|| unknown(name))
    }

    fn dict(&mut self, entries: &[(Expression, Expression)]) -> Result<Value> {
        let mut values = Vec::new();
        for (key, value) in entries {
            let (key, value) = (self.value(key)?, self.value(value)?);
            methods::insert(&mut values, key, value, self.context.budget())?;
        }
        Ok(Value::Dict(values.into()))
    }

    fn comprehension(&mut self, comprehension: &Comprehension) -> Result<Value> {
        let source = self.value(&comprehension.source)?;
        let source = methods::items(&source, self.context.budget())?;
        let depth = self.locals.len();
        let mut values = Vec::new();
        for item in source {
            self.bind(&comprehension.names, item)?;
            let condition = comprehension.condition.as_ref();
            if condition.map_or(Ok(true), |condition| self.value(condition).map(|value| value.is_true()))? {
                values.push(self.value(&comprehension.element)?);
            }
            self.locals.truncate(depth);
        }
        self.context.budget().spend_length(values.len())?;
        Ok(Value::list(values))
    }

    fn bind(&mut self, names: &[String], item: Value) -> Result<()> {
        if let [name] = names {
            self.locals.push((name.clone(), item));
            return Ok(());
        }
        let items = methods::items(&item, self.context.budget())?;
        if items.len() != names.len() {
            return Err(bad(format!("{} values are given for {} names", items.len(), names.len())));
        }
        self.locals.extend(names.iter().cloned().zip(items));
        Ok(())
    }

    fn compared(&mut self, first: &Expression, others: &[(Comparison, Expression)]) -> Result<Value> {
        let mut left = self.value(first)?;
        for (comparison, other) in others {
            let right = self.value(other)?;
            if !compare(*comparison, &left, &right, self.context.budget())? {
                return Ok(Value::Bool(false));
            }
            left = right;
        }
        Ok(Value::Bool(true))
    }

    fn attribute(&mut self, owner: &Value, name: &str) -> Result<Value> {
        let found = match owner {
            Value::Dict(entries) => Value::entry(entries, &Value::text(name), self.context.budget())?,
            Value::Module(module) => functions::member(module, name),
            Value::Namespace(namespace) => self.context.member(*namespace, name)?,
            _ => None,
        };
        found.ok_or_else(|| {
            let text = format!("a {} has no `{}`; give one of its names", owner.kind(), shown(name));
            Error::new(ErrorKind::UnknownName, text)
        })
    }

    fn slice(&mut self, owner: &Expression, bounds: &[Option<Expression>; 3]) -> Result<Value> {
        let owner = self.value(owner)?;
        let mut values = [None, None, None];
        for (value, bound) in values.iter_mut().zip(bounds) {
            *value = bound
                .as_ref()
                .map(|bound| self.value(bound))
                .transpose()?
                .filter(|value| !matches!(value, Value::None));
        }
        methods::slice(&owner, &values, self.context.budget())
    }

    fn call(&mut self, function: &Expression, values: &[Expression], named: &[(String, Expression)]) -> Result<Value> {
        if let Expression::Attribute(owner, name) = function {
            let owner = self.value(owner)?;
            if methods::is_method(&owner, name) {
                let values = self.values(values)?;
                return methods::call(&owner, name, &values, self.context.budget());
            }
            let function = self.attribute(&owner, name)?;
            return self.called(&function, values, named);
        }
        let function = self.value(function)?;
        self.called(&function, values, named)
    }

    fn called(&mut self, function: &Value, values: &[Expression], named: &[(String, Expression)]) -> Result<Value> {
        let Value::Function(name) = function else {
            return Err(bad(format!("a {} is not a function; give a function", function.kind())));
        };
        let values = self.values(values)?;
        let mut options = Vec::new();
        for (name, value) in named {
            options.push((name.as_str(), self.value(value)?));
        }
        if functions::needs_context(name) {
            return self.context.call(name, &values);
        }
        functions::call(name, &values, &options, self.context.budget())
    }
}

fn unknown(name: &str) -> Error {
    let text = format!("`{}` is not defined; give a property, an argument or a function", shown(name));
    Error::new(ErrorKind::UnknownName, text)
}
