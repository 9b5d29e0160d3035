//! Text of others, fit to be shown: on a terminal, in messages and in Markdown.

use std::borrow::Cow;

/// The most characters of an input that a message repeats.
pub const MOST_ECHOED: usize = 200;
/// The most characters of a name in a message.
const MOST_SHOWN: usize = 40;

/// Whether a character acts on the text around it instead of being seen: control characters, those that change the direction of writing, and separators of
/// lines and paragraphs.
pub fn is_hidden(c: char) -> bool {
    let is_direction =
        matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    c.is_control() || is_direction || matches!(c, '\u{2028}' | '\u{2029}' | '\u{feff}')
}

/// `text` with its hidden characters, but line ends and tabs, as `\u001b`: in JSON they then mean the same.
pub fn page(text: &str) -> Cow<'_, str> {
    replaced(text, |c| is_hidden(c) && c != '\n' && c != '\t')
}

/// `text` on one line: also line ends and tabs are written as escapes.
pub fn line(text: &str) -> Cow<'_, str> {
    replaced(text, is_hidden)
}

/// All that is hidden is in the basic plane: four digits hold it.
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

/// `text` fit for a message: at most 40 characters, control characters escaped.
pub fn shown(text: &str) -> String {
    let dots = if text.chars().nth(MOST_SHOWN).is_some() { "..." } else { "" };
    text.chars().take(MOST_SHOWN).flat_map(char::escape_debug).chain(dots.chars()).collect()
}

/// A message in which each quotation has at most [`MOST_ECHOED`] characters and none is hidden. A quotation begins after a space or a bracket with one of
/// the signs `` ` ``, `"` and `'`, and ends with the same one.
pub fn message(text: &str) -> String {
    let mut whole = String::with_capacity(text.len());
    let (mut rest, mut before) = (&*page(text), ' ');
    while let Some(first) = rest.chars().next() {
        let length = if before.is_alphanumeric() { None } else { quotation(rest, first) };
        let (piece, behind) = rest.split_at(length.unwrap_or(first.len_utf8()));
        whole += &cut(piece);
        (rest, before) = (behind, piece.chars().next_back().unwrap_or(first));
    }
    whole
}

/// How long the quotation is that `text` begins with, in bytes, if it does. One that does not end is as long as the text.
fn quotation(text: &str, first: char) -> Option<usize> {
    if !matches!(first, '`' | '"' | '\'') {
        return None;
    }
    let end = text[1..].find(first).map(|at| at + 2);
    // An apostrophe ends what it does not begin.
    end.or((first != '\'').then_some(text.len()))
}

fn cut(piece: &str) -> String {
    let count = piece.chars().count();
    if count <= MOST_ECHOED + 2 {
        return piece.to_owned();
    }
    let end = piece.chars().next_back().filter(|c| piece.starts_with(*c)).map_or(String::new(), String::from);
    piece.chars().take(MOST_ECHOED + 1).chain("...".chars()).chain(end.chars()).collect()
}

/// `text` as words of Markdown on one line: neither HTML nor a link, a list, a heading or a command of a shell.
pub fn markdown(text: &str) -> String {
    let text = line(text);
    let text = text.trim();
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

/// Whether a character means something in Markdown between those before and after it.
fn is_special(before: Option<char>, c: char, after: Option<char>) -> bool {
    let is_letter = |c: Option<char>| c.is_some_and(char::is_alphanumeric);
    match c {
        '_' => !(is_letter(before) && is_letter(after)),
        ']' => after.is_some_and(|c| "([:".contains(c)),
        '-' | '+' | '=' | '#' => before.is_none(),
        _ => "\\`*<>&$".contains(c),
    }
}
