//! C in single precision: the text of a C file with `float` in place of `double`, and its literals and functions to match.

/// Functions of `<math.h>` that the skeleton and the printed code call.
const FUNCTIONS: &str = "sqrt sin cos atan2 fabs fmax fmin copysign round floor ceil";

/// The text of a C file in single precision; comments and texts in quotation marks stay.
pub(super) fn single(text: &str) -> String {
    let mut rest = text;
    let mut out = String::with_capacity(text.len());
    while let Some(first) = rest.chars().next() {
        let length = match first {
            '/' if rest.starts_with("/*") => rest.find("*/").map_or(rest.len(), |end| end + 2),
            '"' => quoted(rest),
            '0'..='9' => number(rest),
            'A'..='Z' | 'a'..='z' | '_' => prefix(rest, is_part),
            _ => first.len_utf8(),
        };
        let (token, tail) = rest.split_at(length);
        out += &replaced(token, first);
        rest = tail;
    }
    out
}

fn is_part(c: char) -> bool {
    c.is_ascii_alphanumeric() || c == '_'
}

fn prefix(text: &str, belongs: impl Fn(char) -> bool) -> usize {
    text.find(|c| !belongs(c)).unwrap_or(text.len())
}

/// The length of a text in quotation marks, of which none stands inside.
fn quoted(text: &str) -> usize {
    text[1..].find('"').map_or(text.len(), |end| end + 2)
}

/// The length of a number at the start of a text.
fn number(text: &str) -> usize {
    let mut length = prefix(text, |c| c.is_ascii_alphanumeric() || c == '.');
    let more = &text[length..];
    if text[..length].ends_with('e') && more.starts_with(['-', '+']) {
        length += 1 + prefix(&more[1..], |c| c.is_ascii_digit());
    }
    length
}

fn replaced(token: &str, first: char) -> String {
    match token {
        "double" => "float".to_owned(),
        "DBL_MIN" => "FLT_MIN".to_owned(),
        "DBL_EPSILON" => "FLT_EPSILON".to_owned(),
        _ if first.is_ascii_digit() && token.contains(['.', 'e']) => format!("{token}f"),
        _ if FUNCTIONS.split(' ').any(|function| function == token) => format!("{token}f"),
        _ => token.to_owned(),
    }
}
