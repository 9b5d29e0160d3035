//! Tokens of a text, and the cursor of the lexers.

use std::fmt;

use crate::limits;
use crate::{Error, ErrorKind, Result};

/// Maximum length of a text in bytes.
pub const MAX_LENGTH: usize = limits::EXPRESSION_CHARACTERS;

/// A token and its location.
pub(super) struct Token<'a> {
    /// Line, counted from 1, in a text that is read line by line.
    pub(super) line: Option<usize>,
    /// Column in characters, counted from 1.
    pub(super) column: usize,
    pub(super) kind: Kind<'a>,
}

/// Kind of a token.
#[derive(Clone, PartialEq)]
pub(super) enum Kind<'a> {
    Number(&'a str),
    Name(String),
    Symbol(char),
    /// A word that the parser interprets: a name, or a monomial written without signs.
    Word(&'a str),
    /// `\frac`.
    Fraction,
    /// The end of an expression inside a longer text: `,`, `;` or the end of a line.
    Delimiter(&'static str),
    End,
}

impl fmt::Display for Kind<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let short = |text: &str| text.chars().take(40).collect::<String>();
        match self {
            Kind::Number(text) | Kind::Word(text) => f.write_str(&short(text)),
            Kind::Name(name) => f.write_str(&short(name)),
            Kind::Symbol(symbol) => write!(f, "{symbol}"),
            Kind::Fraction => f.write_str("\\frac"),
            Kind::Delimiter(text) => f.write_str(text),
            Kind::End => f.write_str("end of text"),
        }
    }
}

/// A [`ErrorKind::Syntax`] error at `column`.
pub(super) fn syntax(column: usize, message: impl fmt::Display) -> Error {
    Error::new(ErrorKind::Syntax, format!("column {column}: {message}"))
}

/// A location in a text, counted in bytes and in characters.
#[derive(Clone, Copy)]
pub(super) struct Cursor<'a> {
    text: &'a str,
    byte: usize,
    column: usize,
}

impl<'a> Cursor<'a> {
    pub(super) fn new(text: &'a str) -> Result<Self> {
        if text.len() > MAX_LENGTH {
            let message = format!("the text is {} bytes long, at most {MAX_LENGTH} are read; split it", text.len());
            return Err(Error::new(ErrorKind::Syntax, message));
        }
        Ok(Cursor::at_start(text))
    }

    /// A cursor at the start of a text. The caller limits the length of the text.
    pub(super) fn at_start(text: &'a str) -> Self {
        Cursor { text, byte: 0, column: 1 }
    }

    pub(super) fn column(&self) -> usize {
        self.column
    }

    pub(super) fn mark(&self) -> Cursor<'a> {
        *self
    }

    pub(super) fn reset(&mut self, mark: Cursor<'a>) {
        *self = mark;
    }

    pub(super) fn since(&self, mark: Cursor<'a>) -> &'a str {
        &self.text[mark.byte..self.byte]
    }

    pub(super) fn peek(&self) -> Option<char> {
        self.text[self.byte..].chars().next()
    }

    pub(super) fn peek_after_space(&mut self) -> Option<char> {
        self.take_while(|c| matches!(c, ' ' | '\t' | '\r' | '\n'));
        self.peek()
    }

    /// Takes the next character, which the caller has already inspected.
    pub(super) fn take_one(&mut self) -> char {
        let c = self.peek().unwrap_or(' ');
        self.take_if(|_| true);
        c
    }

    pub(super) fn take_if(&mut self, test: impl Fn(char) -> bool) -> bool {
        match self.peek() {
            Some(c) if test(c) => {
                self.byte += c.len_utf8();
                self.column += 1;
                true
            }
            _ => false,
        }
    }

    pub(super) fn take_while(&mut self, test: impl Fn(char) -> bool) -> &'a str {
        let start = *self;
        while self.take_if(&test) {}
        self.since(start)
    }

    pub(super) fn unknown_character(&self, allowed: &str) -> Error {
        let shown = self.peek().map_or("end of text".to_owned(), |c| format!("`{}`", c.escape_debug()));
        syntax(self.column, format!("{shown} is not allowed here; allowed are {allowed}"))
    }
}
