//! Decoding of XML: byte-order marks, declared encodings, and comments that are not UTF-8.

use std::borrow::Cow;
use std::ops::Range;

use encoding_rs::{Encoding, UTF_8, UTF_16BE, UTF_16LE};

use super::shown;
use crate::{Error, ErrorKind, Result};

/// Maximum length of an XML declaration in bytes.
const DECLARATION: usize = 400;
/// Number of bytes that are inspected to recognise UTF-16 or UTF-32 without a byte-order mark.
const HEAD: usize = 64;

/// The text of an XML file.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct XmlText {
    /// The text. A declaration of another encoding is replaced by UTF-8, the encoding of the text.
    pub text: String,
    /// Notes about ignored contents.
    pub notes: Vec<String>,
}

/// Decodes XML `bytes`. The encoding is that of the byte-order mark (UTF-8, UTF-16), else the declared one (any of the
/// WHATWG's Encoding Standard), else UTF-8. Bytes in comments that are not UTF-8 are replaced by U+FFFD, with a note.
///
/// # Errors
/// [`ErrorKind::Syntax`] for an empty text, an unknown encoding, UTF-16 and UTF-32 without a byte-order mark, and bytes
/// that are invalid in the encoding.
pub fn decode_xml(bytes: &[u8]) -> Result<XmlText> {
    refuse_unmarked(bytes)?;
    let decoded = match (Encoding::for_bom(bytes), declared(bytes)?) {
        (Some((encoding, mark)), _) if encoding != UTF_8 => decode(encoding, &bytes[mark..])?,
        (Some((_, mark)), _) => decode_utf8(&bytes[mark..])?,
        // A declaration that is readable byte by byte is not in UTF-16, even if it declares that.
        (None, Some(encoding)) if ![UTF_8, UTF_16LE, UTF_16BE].contains(&encoding) => decode(encoding, bytes)?,
        (None, _) => decode_utf8(bytes)?,
    };
    if decoded.text.trim().is_empty() { Err(empty()) } else { Ok(decoded) }
}

/// XML text whose declaration, if there is one, names UTF-8. For text that is already decoded.
pub fn as_utf8(text: &str) -> Cow<'_, str> {
    let place = encoding_value(text.as_bytes());
    match place.filter(|place| !text[place.clone()].eq_ignore_ascii_case("utf-8")) {
        Some(place) => Cow::Owned(format!("{}UTF-8{}", &text[..place.start], &text[place.end..])),
        None => Cow::Borrowed(text),
    }
}

/// Refuses UTF-32, and UTF-16 without a byte-order mark.
fn refuse_unmarked(bytes: &[u8]) -> Result<()> {
    let head = &bytes[..bytes.len().min(HEAD)];
    let all = |size: usize, zeros: &[usize]| {
        let mut words = head.chunks_exact(size).peekable();
        words.peek().is_some() && words.all(|word| (0..size).all(|place| (word[place] == 0) == zeros.contains(&place)))
    };
    let is_wide = head.starts_with(&[0xff, 0xfe, 0, 0]) || head.starts_with(&[0, 0, 0xfe, 0xff]);
    let (name, other) = match () {
        () if is_wide || all(4, &[0, 1, 2]) || all(4, &[1, 2, 3]) => ("UTF-32", ""),
        () if all(2, &[0]) => {
            ("UTF-16 (big-endian) without a byte-order mark", ", or as UTF-16 with a byte-order mark")
        }
        () if all(2, &[1]) => {
            ("UTF-16 (little-endian) without a byte-order mark", ", or as UTF-16 with a byte-order mark")
        }
        () => return Ok(()),
    };
    Err(Error::new(ErrorKind::Syntax, format!("the text is {name}; save the file as UTF-8{other}")))
}

/// The encoding in the XML declaration.
fn declared(bytes: &[u8]) -> Result<Option<&'static Encoding>> {
    let Some(place) = encoding_value(bytes) else { return Ok(None) };
    let label = &bytes[place.clone()];
    Encoding::for_label(label).map(Some).ok_or_else(|| {
        let text = format!(
            "the declared encoding `{}` is unknown; allowed are UTF-8, ISO-8859-1, windows-1252 and the others of the Encoding Standard",
            shown(&String::from_utf8_lossy(label))
        );
        Error::new(ErrorKind::Syntax, text).at_line(line_at(bytes, place.start))
    })
}

/// The range of the value of `encoding` in the XML declaration at the start of `bytes`.
fn encoding_value(bytes: &[u8]) -> Option<Range<usize>> {
    let mark = if bytes.starts_with(b"\xef\xbb\xbf") { 3 } else { 0 };
    let start = mark + bytes[mark..].iter().take(DECLARATION).position(|byte| !byte.is_ascii_whitespace())?;
    let head = &bytes[..bytes.len().min(start + DECLARATION)];
    let end = start + find(&head[start..], b"?>").filter(|_| head[start..].starts_with(b"<?xml"))?;
    let name = start + find(&head[start..end], b"encoding")?;
    let quote = name + head[name..end].iter().position(|byte| matches!(byte, b'"' | b'\''))?;
    let length = head[quote + 1..end].iter().position(|byte| *byte == head[quote])?;
    Some(quote + 1..quote + 1 + length)
}

fn decode(encoding: &'static Encoding, bytes: &[u8]) -> Result<XmlText> {
    let text = encoding.decode_without_bom_handling_and_without_replacement(bytes).ok_or_else(|| {
        let text =
            format!("the text is not {}, the encoding that it declares; save the file as UTF-8", encoding.name());
        Error::new(ErrorKind::Syntax, text)
    })?;
    Ok(XmlText { text: as_utf8(&text).into_owned(), notes: Vec::new() })
}

/// Decodes UTF-8 text with any bytes in comments.
fn decode_utf8(bytes: &[u8]) -> Result<XmlText> {
    let comments = comments(bytes);
    let (mut text, mut at, mut lines) = (String::with_capacity(bytes.len()), 0, Vec::new());
    for chunk in bytes.utf8_chunks() {
        text.push_str(chunk.valid());
        at += chunk.valid().len();
        if chunk.invalid().is_empty() {
            continue;
        }
        let line = line_at(bytes, at);
        if !comments.iter().any(|comment| comment.contains(&at)) {
            let text = "the text is not UTF-8; save the file as UTF-8, or declare its encoding, such as \
                        <?xml version=\"1.0\" encoding=\"ISO-8859-1\"?>";
            return Err(Error::new(ErrorKind::Syntax, text).at_line(line));
        }
        text.push(char::REPLACEMENT_CHARACTER);
        at += chunk.invalid().len();
        lines.push(line);
    }
    let note = lines.first().map(|line| format!("line {line}: bytes of a comment are not UTF-8; they are ignored"));
    Ok(XmlText { text: as_utf8(&text).into_owned(), notes: note.into_iter().collect() })
}

/// The ranges of comments.
fn comments(bytes: &[u8]) -> Vec<Range<usize>> {
    let (mut found, mut at) = (Vec::new(), 0);
    while let Some(open) = find(&bytes[at..], b"<!").map(|open| at + open) {
        let rest = &bytes[open..];
        let close: &[u8] = match rest {
            [b'<', b'!', b'-', b'-', ..] => b"-->",
            [b'<', b'!', b'[', ..] => b"]]>",
            _ => b">",
        };
        at = open + find(rest, close).map_or(rest.len(), |length| length + close.len());
        if close == b"-->" {
            found.push(open..at);
        }
    }
    found
}

/// The error for an empty file.
pub(super) fn empty() -> Error {
    Error::new(ErrorKind::Syntax, "the file is empty; give a description")
}

/// The line, counted from 1, of the byte at `offset`.
pub(super) fn line_at(bytes: &[u8], offset: usize) -> usize {
    1 + bytes[..offset].iter().filter(|&&byte| byte == b'\n').count()
}

/// The position of the first occurrence of `wanted` in `bytes`.
fn find(bytes: &[u8], wanted: &[u8]) -> Option<usize> {
    bytes.windows(wanted.len()).position(|window| window == wanted)
}
