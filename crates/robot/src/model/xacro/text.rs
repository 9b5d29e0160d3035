//! Texts with `${...}` and `$(...)`. Main function: [`pieces`].

use super::expression::syntax_error;
use crate::Result;
use crate::document::shown;

/// A piece of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Piece<'t> {
    Plain(&'t str),
    /// The expression of `${...}`.
    Expression(&'t str),
    /// The command of `$(...)`.
    Command(&'t str),
}

/// Splits a text into pieces. `$${` is a plain `${`, and `$$(` is a plain `$(`.
///
/// # Errors
/// [`crate::ErrorKind::Syntax`] for `${` without `}` and for `$(` without `)`.
pub fn pieces(text: &str) -> Result<Vec<Piece<'_>>> {
    let mut pieces = Vec::new();
    let mut rest = text;
    while !rest.is_empty() {
        let dollars = rest.bytes().take_while(|byte| *byte == b'$').count();
        let after = &rest[dollars..];
        let is_open = after.starts_with(['{', '(']);
        let (piece, length) = match dollars {
            0 => {
                let length = rest.find('$').unwrap_or(rest.len());
                (Piece::Plain(&rest[..length]), length)
            }
            1 if is_open => enclosed(rest)?,
            _ if is_open => (Piece::Plain(&rest[1..=dollars]), dollars + 1),
            _ => (Piece::Plain(&rest[..dollars]), dollars),
        };
        pieces.push(piece);
        rest = &rest[length..];
    }
    Ok(pieces)
}

/// The expression or command at the start of `text`, with its length.
fn enclosed(text: &str) -> Result<(Piece<'_>, usize)> {
    let inner = &text[2..];
    if text.starts_with("${") {
        let end = inner.find('}').ok_or_else(|| open(text, '}'))?;
        return Ok((Piece::Expression(&inner[..end]), end + 3));
    }
    let is_eval = inner.starts_with("eval ");
    let end = if is_eval { balanced(inner) } else { inner.find(')') };
    let end = end.ok_or_else(|| open(text, ')'))?;
    Ok((Piece::Command(&inner[..end]), end + 3))
}

/// The place of the `)` that closes a parenthesis before `text`.
fn balanced(text: &str) -> Option<usize> {
    let mut depth = 0usize;
    let mut quote = None;
    for (at, c) in text.char_indices() {
        match (quote, c) {
            (Some(end), c) if c == end => quote = None,
            (Some(_), _) => {}
            (None, '\'' | '"') => quote = Some(c),
            (None, '(') => depth += 1,
            (None, ')') if depth == 0 => return Some(at),
            (None, ')') => depth -= 1,
            _ => {}
        }
    }
    None
}

fn open(text: &str, close: char) -> crate::Error {
    syntax_error(format!("`{}` has no closing `{close}`", shown(text)))
}
