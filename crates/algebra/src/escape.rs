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

/// A message in which each quotation and each word has at most [`MOST_ECHOED`] characters and none is hidden. A quotation begins after a space or a bracket
/// with one of the signs `` ` ``, `"` and `'`, and ends with the same one.
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

/// How long the quotation is that `text` begins with, in bytes, if it does. One that does not end is as long as the text.
fn quotation(text: &str, before: char) -> Option<usize> {
    let sign = text.chars().next().filter(|sign| SIGNS.contains(sign) && !before.is_alphanumeric())?;
    let end = text[1..].find(sign).map(|at| at + 2);
    // An apostrophe ends what it does not begin.
    end.or((sign != '\'').then_some(text.len()))
}

/// How long the word or the blank is that `text` begins with, in bytes.
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

/// `text` as words of Markdown on one line: neither HTML nor a link, a list, a heading or a command of a shell.
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
