//! LaTeX of names, and a parser of the LaTeX that our printers write.
//!
//! The grammar is that of plain text, with these differences: a product is implied (`2 x y`) or a `\cdot`; a fraction
//! is `\frac{a}{b}`, not `/`; an exponent has braces unless it is one digit; parentheses may be `\left( \right)`; `\,`
//! is space; numbers have no `e` exponent. Each letter is a separate name, as LaTeX prints it: `xy` is `x*y`.
//!
//! A name is written by its form ([`latex_name`]), and read back as the same name:
//!
//! | name            | LaTeX                 | form                              |
//! |-----------------|-----------------------|-----------------------------------|
//! | `x`             | `x`                   | one letter                        |
//! | `c4`, `L12`     | `c_{4}`, `L_{12}`     | one letter and digits             |
//! | `py`            | `\mathit{py}`         | letters                           |
//! | `phi2`          | `\mathit{phi}_{2}`    | letters and digits                |
//! | `x_1`, `a1b`    | `\mathrm{x\_1}`, `\mathrm{a1b}` | anything else           |

use super::grammar::{Dialect, Parser};
use super::token::{Cursor, Kind, Token, syntax};
use super::{Expression, is_identifier};
use crate::Result;

const COMMANDS: &str = "`\\frac`, `\\cdot`, `\\left(`, `\\right)`, `\\mathit{...}`, `\\mathrm{...}` and `\\,`";

/// The LaTeX of an identifier, as `letters_{digits}` or `\mathit{name}`: [`parse_latex`] reads it back as the same name.
pub fn latex_name(name: &str) -> String {
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    let digits = &name[stem.len()..];
    if stem.is_empty() || !stem.bytes().all(|b| b.is_ascii_alphabetic()) {
        return format!("\\mathrm{{{}}}", name.replace('_', "\\_"));
    }
    let stem = if stem.len() == 1 { stem.to_owned() } else { format!("\\mathit{{{stem}}}") };
    if digits.is_empty() { stem } else { format!("{stem}_{{{digits}}}") }
}

/// Parses the LaTeX of an expression, as our printers write it.
///
/// # Errors
/// [`ErrorKind::Syntax`](crate::ErrorKind::Syntax) with the column (in characters, from 1) and what is allowed there.
pub fn parse_latex(text: &str) -> Result<Expression> {
    Parser::new(tokens(text)?, Dialect::Latex).whole()
}

fn tokens(text: &str) -> Result<Vec<Token<'_>>> {
    let mut cursor = Cursor::new(text)?;
    let mut tokens = Vec::new();
    while let Some(c) = cursor.peek_after_space() {
        let column = cursor.column();
        let kind = match c {
            '0'..='9' | '.' => Some(Kind::Number(cursor.take_while(|c| c.is_ascii_digit() || c == '.'))),
            'a'..='z' | 'A'..='Z' => {
                let stem = cursor.take_one().to_string();
                Some(Kind::Name(stem + subscript(&mut cursor)?))
            }
            '\\' => command(&mut cursor)?,
            '+' | '-' | '^' | '(' | ')' | '{' | '}' => Some(Kind::Symbol(cursor.take_one())),
            _ => return Err(cursor.unknown_character(&format!("numbers, letters, `+ - ^ ( ) {{ }}`, {COMMANDS}"))),
        };
        tokens.extend(kind.map(|kind| Token { line: None, column, kind }));
    }
    tokens.push(Token { line: None, column: cursor.column(), kind: Kind::End });
    Ok(tokens)
}

/// The meaning of the command at the cursor; `None` for a space.
fn command<'a>(cursor: &mut Cursor<'a>) -> Result<Option<Kind<'a>>> {
    let column = cursor.column();
    cursor.take_one();
    if cursor.take_if(|c| c == ',') {
        return Ok(None);
    }
    match cursor.take_while(|c| c.is_ascii_alphabetic()) {
        "frac" => Ok(Some(Kind::Fraction)),
        "cdot" => Ok(Some(Kind::Symbol('*'))),
        "left" => delimiter(cursor, '(').map(Some),
        "right" => delimiter(cursor, ')').map(Some),
        "mathit" => {
            let stem = braced(cursor, |c| c.is_ascii_alphabetic(), "letters")?;
            Ok(Some(Kind::Name(stem.to_owned() + subscript(cursor)?)))
        }
        "mathrm" => {
            let text = braced(cursor, |c| c.is_ascii_alphanumeric() || "\\_".contains(c), "a name")?;
            upright_name(text, column).map(|name| Some(Kind::Name(name)))
        }
        _ => Err(syntax(column, format!("an unknown command; allowed are {COMMANDS}"))),
    }
}

fn delimiter<'a>(cursor: &mut Cursor<'a>, wanted: char) -> Result<Kind<'a>> {
    if cursor.peek_after_space() == Some(wanted) {
        return Ok(Kind::Symbol(cursor.take_one()));
    }
    Err(cursor.unknown_character(&format!("`{wanted}` after `\\left` or `\\right`")))
}

fn upright_name(text: &str, column: usize) -> Result<String> {
    let name = text.replace("\\_", "_");
    let escaped = name.replace('_', "\\_") == text;
    if escaped && is_identifier(&name) {
        return Ok(name);
    }
    Err(syntax(
        column,
        "`\\mathrm{...}` must contain a name of letters, digits and `\\_` that does not start with a digit",
    ))
}

/// Parses `_{digits}` or `_digit` at the cursor. Returns the digits; empty when there is no subscript.
fn subscript<'a>(cursor: &mut Cursor<'a>) -> Result<&'a str> {
    if !cursor.take_if(|c| c == '_') {
        return Ok("");
    }
    if cursor.peek() == Some('{') {
        return braced(cursor, |c| c.is_ascii_digit(), "digits");
    }
    let start = cursor.mark();
    if cursor.take_if(|c| c.is_ascii_digit()) && !cursor.peek().is_some_and(|c| c.is_ascii_digit()) {
        return Ok(cursor.since(start));
    }
    Err(syntax(start.column(), "a subscript is one digit, or digits in braces such as `c_{12}`"))
}

fn braced<'a>(cursor: &mut Cursor<'a>, test: impl Fn(char) -> bool, what: &str) -> Result<&'a str> {
    let column = cursor.column();
    let open = cursor.take_if(|c| c == '{');
    let text = if open { cursor.take_while(test) } else { "" };
    if text.is_empty() || !cursor.take_if(|c| c == '}') {
        return Err(syntax(column, format!("{what} in braces expected, such as `{{...}}`")));
    }
    Ok(text)
}
