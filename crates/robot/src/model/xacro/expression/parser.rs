//! The grammar of expressions: that of Python without statements, functions and f-strings. Main function: [`parse`].

use super::lexer::{Token, syntax, tokens};
use super::syntax::{COMPARISONS, Comparison, Comprehension, Expression, OPERATORS, Operator, Unary};
use super::value::Value;
use crate::Result;
use crate::document::shown;
use groebot_algebra::limits;

/// Maximum length of an expression in bytes.
const LENGTH: usize = 20_000;
/// Maximum depth of an expression.
const DEEPEST: usize = limits::EXPRESSION_DEPTH;

/// The words that are not names.
const WORDS: [&str; 11] = ["and", "or", "not", "in", "is", "if", "else", "for", "lambda", "True", "False"];

/// Parses an expression.
///
/// # Errors
/// [`crate::ErrorKind::Syntax`] for text that does not follow the grammar, is too long or nested too deeply.
pub fn parse(text: &str) -> Result<Expression> {
    if text.len() > LENGTH {
        return Err(syntax(format!("an expression has {} bytes; give at most {LENGTH}", text.len())));
    }
    let mut parser = Parser { tokens: tokens(text)?, at: 0, depth: 0 };
    let value = parser.listed()?;
    match parser.tokens.get(parser.at) {
        None => Ok(value),
        Some(token) => Err(syntax(format!("{} is not expected here", named(token)))),
    }
}

fn named(token: &Token) -> String {
    match token {
        Token::Int(value) => format!("`{value}`"),
        Token::Float(value) => format!("`{value}`"),
        Token::Text(text) => format!("the text `{}`", shown(text)),
        Token::Name(name) => format!("`{}`", shown(name)),
        Token::Sign(sign) => format!("`{sign}`"),
    }
}

struct Parser {
    tokens: Vec<Token>,
    at: usize,
    depth: usize,
}

impl Parser {
    fn deepen(&mut self) -> Result<()> {
        self.depth += 1;
        if self.depth <= DEEPEST {
            return Ok(());
        }
        Err(syntax(format!("an expression is nested deeper than {DEEPEST}")))
    }

    fn sign(&self) -> &'static str {
        if let Some(Token::Sign(sign)) = self.tokens.get(self.at) { sign } else { "" }
    }

    fn is_word(&self, at: usize, word: &str) -> bool {
        matches!(self.tokens.get(at), Some(Token::Name(name)) if name == word)
    }

    /// Skips the sign or word, if it is next.
    fn skips(&mut self, text: &str) -> bool {
        let skips = self.sign() == text || self.is_word(self.at, text);
        self.at += usize::from(skips);
        skips
    }

    fn expect(&mut self, text: &str) -> Result<()> {
        if self.skips(text) {
            return Ok(());
        }
        let found = self.tokens.get(self.at).map_or("the end".to_owned(), named);
        Err(syntax(format!("{found} is not expected here; give `{text}`")))
    }

    /// Expressions with commas between them: a tuple, if there is a comma.
    fn listed(&mut self) -> Result<Expression> {
        let first = self.expression()?;
        if self.sign() != "," {
            return Ok(first);
        }
        let mut values = vec![first];
        while self.skips(",") && self.starts_value() {
            values.push(self.expression()?);
        }
        Ok(Expression::Tuple(values))
    }

    /// Whether the next token can start an expression.
    fn starts_value(&self) -> bool {
        match self.tokens.get(self.at) {
            None => false,
            Some(Token::Sign(sign)) => ["(", "[", "{", "-", "+", "~"].contains(sign),
            Some(_) => true,
        }
    }

    /// A value, with its condition: `a if b else c`.
    fn expression(&mut self) -> Result<Expression> {
        let before = self.depth;
        self.deepen()?;
        let value = self.disjunction()?;
        if !self.skips("if") {
            self.depth = before;
            return Ok(value);
        }
        let condition = self.disjunction()?;
        self.expect("else")?;
        let other = self.expression()?;
        self.depth = before;
        Ok(Expression::If(Box::new([condition, value, other])))
    }

    fn disjunction(&mut self) -> Result<Expression> {
        let before = self.depth;
        let mut value = self.conjunction()?;
        while self.skips("or") {
            self.deepen()?;
            value = Expression::Or(Box::new(value), Box::new(self.conjunction()?));
        }
        self.depth = before;
        Ok(value)
    }

    fn conjunction(&mut self) -> Result<Expression> {
        let before = self.depth;
        let mut value = self.negation()?;
        while self.skips("and") {
            self.deepen()?;
            value = Expression::And(Box::new(value), Box::new(self.negation()?));
        }
        self.depth = before;
        Ok(value)
    }

    fn negation(&mut self) -> Result<Expression> {
        if !self.skips("not") {
            return self.comparison();
        }
        self.deepen()?;
        let value = self.negation()?;
        self.depth -= 1;
        Ok(Expression::Unary(Unary::Not, Box::new(value)))
    }

    fn comparison(&mut self) -> Result<Expression> {
        let first = self.operation(1)?;
        let mut others = Vec::new();
        while let Some(comparison) = self.comparison_sign() {
            others.push((comparison, self.operation(1)?));
        }
        Ok(if others.is_empty() { first } else { Expression::Compare(Box::new(first), others) })
    }

    fn comparison_sign(&mut self) -> Option<Comparison> {
        let sign = self.sign();
        if let Some((_, comparison)) = COMPARISONS.iter().find(|(text, _)| *text == sign) {
            self.at += 1;
            return Some(*comparison);
        }
        if self.skips("in") {
            return Some(Comparison::In);
        }
        if self.is_word(self.at, "not") && self.is_word(self.at + 1, "in") {
            self.at += 2;
            return Some(Comparison::NotIn);
        }
        let is = self.skips("is");
        is.then(|| if self.skips("not") { Comparison::IsNot } else { Comparison::Is })
    }

    /// Operations of at least `level`.
    fn operation(&mut self, level: u8) -> Result<Expression> {
        let before = self.depth;
        let mut value = self.signed()?;
        loop {
            let sign = self.sign();
            let operator = OPERATORS.iter().find(|(text, own, _)| *text == sign && *own >= level);
            let Some((_, own, operator)) = operator else {
                self.depth = before;
                return Ok(value);
            };
            self.at += 1;
            self.deepen()?;
            value = Expression::Binary(*operator, Box::new(value), Box::new(self.operation(own + 1)?));
        }
    }

    /// A value with signs before it, and its power.
    fn signed(&mut self) -> Result<Expression> {
        let unary = match self.sign() {
            "-" => Unary::Minus,
            "+" => Unary::Plus,
            "~" => Unary::Invert,
            _ => return self.power(),
        };
        self.at += 1;
        self.deepen()?;
        let value = self.signed()?;
        self.depth -= 1;
        Ok(Expression::Unary(unary, Box::new(value)))
    }

    fn power(&mut self) -> Result<Expression> {
        let base = self.postfix()?;
        if !self.skips("**") {
            return Ok(base);
        }
        self.deepen()?;
        let exponent = self.signed()?;
        self.depth -= 1;
        Ok(Expression::Binary(Operator::Power, Box::new(base), Box::new(exponent)))
    }

    /// A value with attributes, indices and calls.
    fn postfix(&mut self) -> Result<Expression> {
        let before = self.depth;
        let mut value = self.atom()?;
        loop {
            self.deepen()?;
            value = if self.skips(".") {
                match self.tokens.get(self.at) {
                    Some(Token::Name(name)) if !name.starts_with("__") => {
                        let name = name.clone();
                        self.at += 1;
                        Expression::Attribute(Box::new(value), name)
                    }
                    _ => return Err(syntax("a name is expected after `.`".to_owned())),
                }
            } else if self.skips("[") {
                self.index(value)?
            } else if self.skips("(") {
                self.call(value)?
            } else {
                self.depth = before;
                return Ok(value);
            };
        }
    }

    /// The index or slice after `[`.
    fn index(&mut self, value: Expression) -> Result<Expression> {
        let start = if self.sign() == ":" { None } else { Some(self.listed()?) };
        if let Some(index) = start {
            if self.skips("]") {
                return Ok(Expression::Index(Box::new(value), Box::new(index)));
            }
            return self.slice(value, Some(index));
        }
        self.slice(value, None)
    }

    fn slice(&mut self, value: Expression, start: Option<Expression>) -> Result<Expression> {
        self.expect(":")?;
        let end = if self.starts_value() { Some(self.expression()?) } else { None };
        let step = if self.skips(":") && self.starts_value() { Some(self.expression()?) } else { None };
        self.expect("]")?;
        Ok(Expression::Slice(Box::new(value), Box::new([start, end, step])))
    }

    /// The arguments after `(`.
    fn call(&mut self, function: Expression) -> Result<Expression> {
        let (mut values, mut named) = (Vec::new(), Vec::new());
        while !self.skips(")") {
            let is_named = matches!(self.tokens.get(self.at + 1), Some(Token::Sign("=")));
            match self.tokens.get(self.at) {
                Some(Token::Name(name)) if is_named => {
                    let name = name.clone();
                    self.at += 2;
                    named.push((name, self.expression()?));
                }
                _ => {
                    let value = self.expression()?;
                    values.push(if self.is_word(self.at, "for") { self.comprehension(value)? } else { value });
                }
            }
            if self.sign() != ")" {
                self.expect(",")?;
            }
        }
        Ok(Expression::Call(Box::new(function), values, named))
    }

    /// The part of a comprehension after its element.
    fn comprehension(&mut self, element: Expression) -> Result<Expression> {
        self.expect("for")?;
        let mut names = Vec::new();
        loop {
            match self.tokens.get(self.at) {
                Some(Token::Name(name)) if !WORDS.contains(&name.as_str()) => names.push(name.clone()),
                _ => return Err(syntax("a name is expected after `for`".to_owned())),
            }
            self.at += 1;
            if !self.skips(",") {
                break;
            }
        }
        self.expect("in")?;
        let source = self.disjunction()?;
        let condition = if self.skips("if") { Some(self.disjunction()?) } else { None };
        Ok(Expression::Comprehension(Box::new(Comprehension { element, names, source, condition })))
    }

    fn atom(&mut self) -> Result<Expression> {
        let Some(token) = self.tokens.get(self.at).cloned() else {
            return Err(syntax("the expression ends where a value is expected".to_owned()));
        };
        self.at += 1;
        match token {
            Token::Int(value) => Ok(Expression::Literal(Value::Int(value))),
            Token::Float(value) => Ok(Expression::Literal(Value::Float(value))),
            Token::Text(mut text) => {
                while let Some(Token::Text(next)) = self.tokens.get(self.at) {
                    text += next;
                    self.at += 1;
                }
                Ok(Expression::Literal(Value::text(text)))
            }
            Token::Name(name) => self.name(name),
            Token::Sign("(") => self.parenthesis(),
            Token::Sign("[") => self.list(),
            Token::Sign("{") => self.dict(),
            Token::Sign(sign) => Err(syntax(format!("`{sign}` is not expected here; give a value"))),
        }
    }

    fn name(&self, name: String) -> Result<Expression> {
        match name.as_str() {
            "True" => Ok(Expression::Literal(Value::Bool(true))),
            "False" => Ok(Expression::Literal(Value::Bool(false))),
            "None" => Ok(Expression::Literal(Value::None)),
            word if WORDS.contains(&word) => Err(syntax(format!("`{word}` is not expected here; give a value"))),
            _ if name.starts_with("__") => Err(syntax(format!("`{}` is not allowed as a name", shown(&name)))),
            _ => Ok(Expression::Name(name)),
        }
    }

    fn parenthesis(&mut self) -> Result<Expression> {
        if self.skips(")") {
            return Ok(Expression::Tuple(Vec::new()));
        }
        let mut value = self.listed()?;
        if self.is_word(self.at, "for") {
            value = self.comprehension(value)?;
        }
        self.expect(")")?;
        Ok(value)
    }

    fn list(&mut self) -> Result<Expression> {
        let mut values = Vec::new();
        while !self.skips("]") {
            let value = self.expression()?;
            if values.is_empty() && self.is_word(self.at, "for") {
                let list = self.comprehension(value)?;
                self.expect("]")?;
                return Ok(list);
            }
            values.push(value);
            if self.sign() != "]" {
                self.expect(",")?;
            }
        }
        Ok(Expression::List(values))
    }

    fn dict(&mut self) -> Result<Expression> {
        let mut entries = Vec::new();
        while !self.skips("}") {
            let key = self.expression()?;
            self.expect(":")?;
            entries.push((key, self.expression()?));
            if self.sign() != "}" {
                self.expect(",")?;
            }
        }
        Ok(Expression::Dict(entries))
    }
}
