//! Common parts of the readers of all formats: lookahead, names and numbers, one polynomial.

use std::collections::HashSet;
use std::fmt;

use super::words::{At, Words};
use super::{Format, Given, MAX_NAMES, MAX_WORDS};
use crate::limits::check_name;
use crate::poly::grammar::{Dialect, Parser};
use crate::poly::parse::equation_of;
use crate::poly::token::{Kind, Token};
use crate::poly::{Expression, is_identifier};
use crate::{Error, ErrorKind, Result};

/// Appends the meaning of a token to the tokens of a polynomial.
pub(super) type Resolve<'r, 'a> = dyn FnMut(&mut Reader<'a>, Token<'a>, &mut Vec<Token<'a>>) -> Result<()> + 'r;

/// Reads a text token by token.
pub(super) struct Reader<'a> {
    words: Words<'a>,
    next: Token<'a>,
}

impl<'a> Reader<'a> {
    pub(super) fn new(text: &'a str, format: Format) -> Result<Self> {
        let mut words = Words::new(text, format);
        let next = words.next()?;
        Ok(Reader { words, next })
    }

    pub(super) fn peek(&self) -> &Kind<'a> {
        &self.next.kind
    }

    /// The token after the next one.
    pub(super) fn second(&self) -> Result<Kind<'a>> {
        Ok(self.words.clone().next()?.kind)
    }

    /// The location of the next token.
    pub(super) fn at(&self) -> At {
        place(&self.next)
    }

    pub(super) fn advance(&mut self) -> Result<Token<'a>> {
        let following = self.words.next()?;
        Ok(std::mem::replace(&mut self.next, following))
    }

    pub(super) fn take(&mut self, symbol: char) -> Result<bool> {
        let found = *self.peek() == Kind::Symbol(symbol);
        if found {
            self.advance()?;
        }
        Ok(found)
    }

    pub(super) fn expect(&mut self, symbol: char) -> Result<()> {
        if self.take(symbol)? { Ok(()) } else { Err(self.unexpected(format!("`{symbol}`"))) }
    }

    /// The error for an unexpected token, where `wanted` was required.
    pub(super) fn unexpected(&self, wanted: impl fmt::Display) -> Error {
        self.error(format!("{wanted} expected, found `{}`", self.peek()))
    }

    pub(super) fn error(&self, message: impl fmt::Display) -> Error {
        self.at().error(ErrorKind::Syntax, message)
    }

    /// Reads a name. `what` describes it in the error message.
    pub(super) fn name(&mut self, what: &str) -> Result<(String, At)> {
        let at = self.at();
        let name = match self.peek() {
            Kind::Name(name) => name.clone(),
            Kind::Word(word) if is_identifier(word) => (*word).to_owned(),
            _ => return Err(self.unexpected(what)),
        };
        self.advance()?;
        Ok((name, at))
    }

    /// Reads a number made of digits only. `what` describes it in the error message.
    pub(super) fn integer(&mut self, what: &str) -> Result<(u64, At)> {
        let at = self.at();
        let value = match self.peek() {
            Kind::Number(text) if text.bytes().all(|b| b.is_ascii_digit()) => text.parse().ok(),
            _ => None,
        };
        let value = value.ok_or_else(|| self.unexpected(what))?;
        self.advance()?;
        Ok((value, at))
    }

    /// Reads the number of variables of a block of an order.
    pub(super) fn size(&mut self) -> Result<usize> {
        let wanted = format!("a number of variables from 1 to {MAX_NAMES}");
        match self.integer(&wanted)? {
            (size @ 1.., _) if size <= MAX_NAMES as u64 => Ok(size as usize),
            (_, at) => Err(at.error(ErrorKind::BadValue, format!("{wanted} expected"))),
        }
    }

    /// Reads the tokens up to the next of `ends`, the end of a line or of the text, which is not consumed. Names pass
    /// through `resolve`.
    fn words_until(&mut self, ends: &[char], resolve: &mut Resolve<'_, 'a>) -> Result<Vec<Token<'a>>> {
        let mut tokens = Vec::new();
        loop {
            let stop = match self.peek() {
                Kind::End => Some(Kind::End),
                Kind::Delimiter(text) => Some(Kind::Delimiter(text)),
                Kind::Symbol(',') if ends.contains(&',') => Some(Kind::Delimiter(",")),
                Kind::Symbol(';') if ends.contains(&';') => Some(Kind::Delimiter(";")),
                _ => None,
            };
            if let Some(kind) = stop {
                tokens.push(Token { line: self.next.line, column: self.next.column, kind });
                return Ok(tokens);
            }
            if tokens.len() >= MAX_WORDS {
                return Err(self.error(format!("this polynomial has more than {MAX_WORDS} words; split it")));
            }
            let token = self.advance()?;
            match token.kind {
                Kind::Name(_) | Kind::Word(_) => resolve(self, token, &mut tokens)?,
                _ => tokens.push(token),
            }
        }
    }

    /// Reads the polynomial up to the next of `ends`, which is not consumed.
    pub(super) fn polynomial(&mut self, ends: &[char], resolve: &mut Resolve<'_, 'a>) -> Result<Given> {
        let at = self.at();
        let tokens = self.words_until(ends, resolve)?;
        Ok(given(at, Parser::new(tokens, Dialect::Text).whole()?))
    }

    /// Reads the polynomial or equation up to the end of the line.
    pub(super) fn equation(&mut self, resolve: &mut Resolve<'_, 'a>) -> Result<Given> {
        let at = self.at();
        let tokens = self.words_until(&[], resolve)?;
        Ok(given(at, equation_of(tokens)?))
    }
}

fn given(at: At, expression: Expression) -> Given {
    Given { expression, line: at.line, column: at.column }
}

/// The location of `token`.
pub(super) fn place(token: &Token<'_>) -> At {
    At { line: token.line.unwrap_or(1), column: token.column }
}

/// The declared names, each once.
#[derive(Clone, Debug, Default)]
pub(super) struct Names {
    known: HashSet<String>,
}

impl Names {
    /// Adds `name`.
    ///
    /// # Errors
    /// [`ErrorKind::DuplicateName`]; [`ErrorKind::BadValue`] for more than [`MAX_NAMES`].
    pub(super) fn declare(&mut self, name: &str, at: At) -> Result<()> {
        if self.known.len() >= MAX_NAMES {
            let text = format!("more than {MAX_NAMES} variables and parameters; omit some");
            return Err(at.error(ErrorKind::BadValue, text));
        }
        check_name("variable", name).map_err(|error| at.error(error.kind(), error.message()))?;
        if !self.known.insert(name.to_owned()) {
            let text = format!("`{}` is already declared; give each name once", shown(name));
            return Err(at.error(ErrorKind::DuplicateName, text));
        }
        Ok(())
    }

    pub(super) fn contains(&self, name: &str) -> bool {
        self.known.contains(name)
    }

    /// The error that `name` is not declared.
    pub(super) fn unknown(&self, name: &str, at: At) -> Error {
        let mut names: Vec<&str> = self.known.iter().map(String::as_str).collect();
        names.sort_unstable();
        let more = if names.len() > 20 { ", ..." } else { "" };
        names.truncate(20);
        let text = format!("`{}` is not declared; declared are {}{more}", shown(name), names.join(", "));
        at.error(ErrorKind::UnknownName, text)
    }

    /// Accepts declared names only.
    pub(super) fn resolve<'a>(&self, token: Token<'a>, tokens: &mut Vec<Token<'a>>) -> Result<()> {
        if let Kind::Name(name) = &token.kind
            && !self.contains(name)
        {
            return Err(self.unknown(name, place(&token)));
        }
        tokens.push(token);
        Ok(())
    }
}

/// At most forty characters of `text`.
pub(super) fn shown(text: &str) -> String {
    text.chars().take(40).collect()
}
