//! Detection of a text's format.

use super::Format;
use crate::poly::is_identifier;

/// Detects the format. It is Singular's when the first word is `ring`. It is msolve's when the first line is a list of
/// names and the second a number alone. Else it is plain text. Empty lines and comments of all formats are ignored.
pub(super) fn format_of(text: &str) -> Format {
    let mut lines = text.split('\n').map(str::trim).filter(|line| !line.is_empty() && !line.starts_with('#'));
    let first = lines.next().unwrap_or_default();
    let is_list = first.split(',').all(|name| is_identifier(name.trim()));
    if is_list && lines.next().is_some_and(|line| line.bytes().all(|b| b.is_ascii_digit())) {
        return Format::Msolve;
    }
    if starts_with_ring(text) { Format::Singular } else { Format::Plain }
}

/// Whether the first word after Singular's comments is `ring`, or there is such a comment.
fn starts_with_ring(text: &str) -> bool {
    let text = text.trim_start();
    let word = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').next();
    text.starts_with("//") || text.starts_with("/*") || word == Some("ring")
}
