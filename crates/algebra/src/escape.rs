//! Escaping of untrusted text for terminals, messages and Markdown.

use std::borrow::Cow;

/// Maximum number of characters of an input that a message repeats.
pub const MOST_ECHOED: usize = 200;
/// Maximum number of characters of a name in a message.
const MOST_SHOWN: usize = 40;

/// Whether a character changes the text around it instead of being visible: control characters, bidirectional
/// formatting characters, line separators and paragraph separators.
pub fn is_hidden(c: char) -> bool {
    let is_direction =
        matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    c.is_control() || is_direction || matches!(c, '\u{2028}' | '\u{2029}' | '\u{feff}')
}

/// Replaces hidden characters, except line ends and tabs, by `\u001b` escapes. In JSON they keep their meaning.
pub fn page(text: &str) -> Cow<'_, str> {
    replaced(text, |c| is_hidden(c) && c != '\n' && c != '\t')
}

/// Replaces all hidden characters by escapes, also line ends and tabs. The result is one line.
pub fn line(text: &str) -> Cow<'_, str> {
    replaced(text, is_hidden)
}

/// Every hidden character is in the basic multilingual plane, so four digits are enough.
fn replaced(text: &str, is_bad: impl Fn(char) -> bool) -> Cow<'_, str> {
    if !text.contains(&is_bad) {
        return Cow::Borrowed(text);
    }
    let mut whole = String::with_capacity(text.len() + 16);
    for c in text.chars() {
        if is_bad(c) { whole += &format!("\\u{:04x}", u32::from(c)) } else { whole.push(c) }
    }
    Cow::Owned(whole)
}

/// Shortens `text` to 40 characters for a message and escapes control characters.
pub fn shown(text: &str) -> String {
    let dots = if text.chars().nth(MOST_SHOWN).is_some() { "..." } else { "" };
    let mut short = String::new();
    for c in text.chars().take(MOST_SHOWN) {
        if SIGNS.contains(&c) || c == '\\' { short.push(c) } else { short.extend(c.escape_debug()) }
    }
    short + dots
}

/// Limits each quotation and each word of a message to [`MOST_ECHOED`] characters and escapes hidden ones. A quotation
/// begins after a space or a bracket with one of the signs `` ` ``, `"` and `'`, and ends with the same sign.
pub fn message(text: &str) -> String {
    let mut whole = String::with_capacity(text.len().min(1 << 12));
    let (mut rest, mut before) = (&*page(text), ' ');
    while !rest.is_empty() {
        let (piece, behind) = rest.split_at(quotation(rest, before).unwrap_or_else(|| word(rest)));
        whole += &cut(piece);
        before = piece.chars().next_back().unwrap_or(before);
        rest = behind;
    }
    whole
}

const SIGNS: [char; 3] = ['`', '"', '\''];

/// Length in bytes of the quotation at the start of `text`, if there is one. A quotation without an end has the length
/// of the text.
fn quotation(text: &str, before: char) -> Option<usize> {
    let sign = text.chars().next().filter(|sign| SIGNS.contains(sign) && !before.is_alphanumeric())?;
    let end = text[1..].find(sign).map(|at| at + 2);
    // An apostrophe without a partner ends a quotation that it did not begin.
    end.or((sign != '\'').then_some(text.len()))
}

/// Length in bytes of the word or the blank at the start of `text`.
fn word(text: &str) -> usize {
    let mut before = ' ';
    let is_end = |c: char| {
        let ends = c.is_whitespace() || SIGNS.contains(&c) && !before.is_alphanumeric();
        before = c;
        ends
    };
    let first = text.chars().next().map_or(0, char::len_utf8);
    if text.starts_with(char::is_whitespace) {
        first
    } else {
        text[first..].find(is_end).map_or(text.len(), |at| at + first)
    }
}

fn cut(piece: &str) -> String {
    if piece.chars().nth(MOST_ECHOED + 2).is_none() {
        return piece.to_owned();
    }
    let end = piece
        .chars()
        .next_back()
        .filter(|c| SIGNS.contains(c) && piece.starts_with(*c))
        .map_or(String::new(), String::from);
    piece.chars().take(MOST_ECHOED + 1).chain("...".chars()).chain(end.chars()).collect()
}

/// Escapes `text` as words of Markdown on one line: no HTML, link, list, heading or shell command.
pub fn markdown(text: &str) -> String {
    let text = text.replace(['\n', '\t'], " ");
    let text = line(text.trim());
    let mut whole = String::with_capacity(text.len() + 8);
    let mut before = None;
    let mut letters = text.chars().peekable();
    while let Some(c) = letters.next() {
        if is_special(before, c, letters.peek().copied()) {
            whole.push('\\');
        }
        whole.push(c);
        before = Some(c);
    }
    whole
}

/// Whether a character has a meaning in Markdown between its two neighbours.
fn is_special(before: Option<char>, c: char, after: Option<char>) -> bool {
    let is_letter = |c: Option<char>| c.is_some_and(char::is_alphanumeric);
    match c {
        '_' => !(is_letter(before) && is_letter(after)),
        ']' => after.is_some_and(|c| "([:".contains(c)),
        '-' | '+' | '=' | '#' => before.is_none(),
        _ => "\\`*<>&$".contains(c),
    }
}
