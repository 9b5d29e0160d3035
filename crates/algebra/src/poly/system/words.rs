//! Tokens of a system's text, each with its line and column.

use super::Format;
use crate::poly::parse::{continues_name, number, starts_name};
use crate::poly::token::{Cursor, Kind, Token};
use crate::{Error, ErrorKind, Result};

/// A location in the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct At {
    /// Line, counted from 1.
    pub(super) line: usize,
    /// Column in characters, counted from 1.
    pub(super) column: usize,
}

impl At {
    /// Builds an error of `kind` at this location.
    pub(super) fn error(self, kind: ErrorKind, message: impl std::fmt::Display) -> Error {
        Error::new(kind, format!("column {}: {message}", self.column)).at_line(self.line)
    }

    /// Adds this location to `error`, which has none.
    pub(super) fn place(self, error: &Error) -> Error {
        self.error(error.kind(), error.message())
    }
}

/// Splits a text into tokens, one at a time. In plain text the end of a line is a token. Elsewhere it is a separator,
/// like a space.
#[derive(Clone)]
pub(super) struct Words<'a> {
    format: Format,
    lines: std::str::Split<'a, char>,
    cursor: Cursor<'a>,
    line: usize,
}

impl<'a> Words<'a> {
    pub(super) fn new(text: &'a str, format: Format) -> Self {
        let mut lines = text.split('\n');
        let cursor = Cursor::at_start(lines.next().unwrap_or_default());
        Words { format, lines, cursor, line: 1 }
    }

    fn at(&self) -> At {
        At { line: self.line, column: self.cursor.column() }
    }

    /// The next token.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] for a character without meaning and for a comment that is not closed.
    pub(super) fn next(&mut self) -> Result<Token<'a>> {
        loop {
            self.skip_comments()?;
            let At { line, column } = self.at();
            let token = |kind| Ok(Token { line: Some(line), column, kind });
            match self.cursor.peek() {
                Some(c) => {
                    let kind = self.word(c)?;
                    return token(kind);
                }
                None if !self.next_line() => return token(Kind::End),
                None if self.format == Format::Plain => return token(Kind::Delimiter("the end of the line")),
                None => {}
            }
        }
    }

    fn next_line(&mut self) -> bool {
        let Some(line) = self.lines.next() else { return false };
        self.cursor = Cursor::at_start(line);
        self.line += 1;
        true
    }

    /// Skips blanks and comments. A comment up to the end of its line ends before the line end.
    fn skip_comments(&mut self) -> Result<()> {
        while let Some(c) = self.cursor.peek_after_space() {
            let singular = self.format == Format::Singular;
            let mut ahead = self.cursor;
            ahead.take_one();
            match (c, ahead.peek()) {
                ('#', _) if !singular => drop(self.cursor.take_while(|_| true)),
                ('/', Some('/')) if singular => drop(self.cursor.take_while(|_| true)),
                ('/', Some('*')) if singular => self.skip_block_comment()?,
                _ => return Ok(()),
            }
        }
        Ok(())
    }

    fn skip_block_comment(&mut self) -> Result<()> {
        let open = self.at();
        self.cursor.take_one();
        self.cursor.take_one();
        loop {
            self.cursor.take_while(|c| c != '*');
            if self.cursor.take_if(|c| c == '*') {
                if self.cursor.take_if(|c| c == '/') {
                    return Ok(());
                }
            } else if !self.next_line() {
                return Err(open.error(ErrorKind::Syntax, "this comment is not closed; end it with `*/`"));
            }
        }
    }

    fn word(&mut self, c: char) -> Result<Kind<'a>> {
        match c {
            '0'..='9' if self.format == Format::Plain => Ok(Kind::Number(number(&mut self.cursor))),
            '.' if self.format == Format::Plain => Ok(Kind::Number(number(&mut self.cursor))),
            '0'..='9' if self.format == Format::Singular => Ok(self.number_or_monomial()),
            c if self.format == Format::Singular && starts_name(c) => {
                Ok(Kind::Word(self.cursor.take_while(continues_name)))
            }
            '0'..='9' => Ok(Kind::Number(self.digits())),
            c if starts_name(c) => Ok(Kind::Name(self.cursor.take_while(continues_name).to_owned())),
            c if self.symbols().contains(c) => Ok(Kind::Symbol(self.cursor.take_one())),
            _ => {
                let allowed = format!("numbers, names and `{}`", self.symbols());
                Err(self.cursor.unknown_character(&allowed).at_line(self.line))
            }
        }
    }

    fn symbols(&self) -> &'static str {
        match self.format {
            Format::Plain => "+-*/^()=:,>",
            Format::Singular => "+-*/^()=,;.",
            Format::Msolve => "+-*/^(),",
        }
    }

    fn digits(&mut self) -> &'a str {
        self.cursor.take_while(|c| c.is_ascii_digit())
    }

    /// `12`, or a whole monomial such as `3x2y` or `1/3x2`, which Singular reads as one word.
    fn number_or_monomial(&mut self) -> Kind<'a> {
        let start = self.cursor.mark();
        let digits = self.digits();
        let end = self.cursor.mark();
        let fraction = self.cursor.take_if(|c| c == '/');
        if fraction && self.digits().is_empty() {
            self.cursor.reset(end);
            return Kind::Number(digits);
        }
        if self.cursor.take_while(continues_name).starts_with(|c: char| c.is_ascii_alphabetic()) {
            return Kind::Word(self.cursor.since(start));
        }
        self.cursor.reset(end);
        Kind::Number(digits)
    }
}
