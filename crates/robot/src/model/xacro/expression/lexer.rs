//! The tokens of an expression. Main function: [`tokens`].

use super::value::{parse_float, parse_int};
use crate::document::shown;
use crate::{Error, ErrorKind, Result};

/// A token.
#[derive(Clone, Debug, PartialEq)]
pub enum Token {
    Int(i128),
    Float(f64),
    Text(String),
    Name(String),
    /// An operator or a bracket.
    Sign(&'static str),
}

/// The operators and brackets. A longer one is before its parts.
const SIGNS: [&str; 33] = [
    "**", "//", "==", "!=", "<=", ">=", "<<", ">>", ":=", "+", "-", "*", "/", "%", "<", ">", "(", ")", "[", "]", "{",
    "}", ",", ":", ".", "=", "&", "|", "^", "~", "!", ";", "@",
];

/// Splits an expression into tokens.
///
/// # Errors
/// [`ErrorKind::Syntax`] for other characters, a text without its closing quote, and a number that is too large.
pub fn tokens(text: &str) -> Result<Vec<Token>> {
    let mut rest = text.trim_start();
    let mut tokens = Vec::new();
    while let Some(first) = rest.chars().next() {
        let after = rest.get(first.len_utf8()..).unwrap_or("");
        let is_number = first.is_ascii_digit() || first == '.' && after.starts_with(|c: char| c.is_ascii_digit());
        let length = if is_number {
            number(rest, &mut tokens)?
        } else if first == '\'' || first == '"' {
            quoted(rest, first, &mut tokens)?
        } else if first.is_alphabetic() || first == '_' {
            let length = rest.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(rest.len());
            tokens.push(Token::Name(rest[..length].to_owned()));
            length
        } else {
            let sign = SIGNS.iter().find(|sign| rest.starts_with(**sign));
            let sign = sign.ok_or_else(|| syntax(format!("`{}` is not allowed", shown(&first.to_string()))))?;
            tokens.push(Token::Sign(sign));
            sign.len()
        };
        rest = rest[length..].trim_start();
    }
    Ok(tokens)
}

/// Reads the number at the start of `text`, and returns its length.
fn number(text: &str, tokens: &mut Vec<Token>) -> Result<usize> {
    let bytes = text.as_bytes();
    let run = |from: usize| {
        from + bytes[from..].iter().take_while(|byte| byte.is_ascii_alphanumeric() || **byte == b'_').count()
    };
    let radix = match bytes.get(..2) {
        Some(b"0x" | b"0X") => Some(16),
        Some(b"0o" | b"0O") => Some(8),
        Some(b"0b" | b"0B") => Some(2),
        _ => None,
    };
    let bad = |word: &str| syntax(format!("`{}` is not a number, or too large", shown(word)));
    if let Some(radix) = radix {
        let end = run(2);
        let value = i128::from_str_radix(&text[2..end].replace('_', ""), radix);
        tokens.push(Token::Int(value.map_err(|_| bad(&text[..end]))?));
        return Ok(end);
    }
    let mut end = run(0);
    if bytes.get(end) == Some(&b'.') && !text[..end].contains(['e', 'E']) {
        end = run(end + 1);
    }
    let is_signed = text[..end].ends_with(['e', 'E']) && matches!(bytes.get(end), Some(b'+' | b'-'));
    if is_signed {
        end = run(end + 1);
    }
    let word = &text[..end];
    let is_int = word.bytes().all(|byte| byte.is_ascii_digit() || byte == b'_');
    let is_octal =
        is_int && word.len() > 1 && word.starts_with('0') && word.bytes().any(|byte| (b'1'..=b'9').contains(&byte));
    let value = if is_int { parse_int(word).map(Token::Int) } else { parse_float(word).map(Token::Float) };
    tokens.push(value.filter(|_| !is_octal).ok_or_else(|| bad(word))?);
    Ok(end)
}

/// Reads the text in quotes at the start of `text`, and returns its length with the quotes.
fn quoted(text: &str, quote: char, tokens: &mut Vec<Token>) -> Result<usize> {
    let mut value = String::new();
    let mut characters = text.char_indices().skip(1);
    while let Some((at, c)) = characters.next() {
        match c {
            c if c == quote => {
                tokens.push(Token::Text(value));
                return Ok(at + c.len_utf8());
            }
            '\\' => match characters.next() {
                Some((_, 'n')) => value.push('\n'),
                Some((_, 't')) => value.push('\t'),
                Some((_, 'r')) => value.push('\r'),
                Some((_, c @ ('\\' | '\'' | '"'))) => value.push(c),
                Some((_, c)) => value.extend(['\\', c]),
                None => break,
            },
            c => value.push(c),
        }
    }
    Err(syntax(format!("a text has no closing quote {quote}")))
}

/// An error in the grammar of an expression.
pub fn syntax(text: String) -> Error {
    Error::new(ErrorKind::Syntax, text)
}
