//! Files as text: [`read_text`], [`read_xml`], and normalised line ends, [`unix_lines`].

use std::borrow::Cow;
use std::fs::File;
use std::io::Read;
use std::path::Path;

use super::content::refuse_binary;
use super::encoding::{XmlText, decode_xml, empty, line_at};
use crate::files::refuse_unfinished;
use crate::{Error, ErrorKind, Result};

/// Whether `path` is `-`, which means standard input.
pub fn is_stdin(path: &Path) -> bool {
    path == Path::new("-")
}

/// Reads the text of `path`, or of standard input for `-`. It must be UTF-8, not empty and at most `limit` bytes long.
/// Standard input can be read only once.
///
/// # Errors
/// [`ErrorKind::Io`] for a missing file, a directory or a failed read; [`ErrorKind::BadValue`] for a file that is too
/// long; [`ErrorKind::Syntax`] for an empty file or one that is not UTF-8 (with its line). All name the file.
pub fn read_text(path: &Path, limit: u64) -> Result<String> {
    text_of(read_bytes(path, limit)?).map_err(|error| error.in_file(path))
}

/// Reads the text of the XML file `path`, at most `limit` bytes long, in the encoding of its byte-order mark or its
/// declaration.
///
/// # Errors
/// Those of [`read_text`] and [`decode_xml`]; [`ErrorKind::Unsupported`] for an archive or another binary file. All
/// name the file.
pub fn read_xml(path: &Path, limit: u64) -> Result<XmlText> {
    let bytes = read_bytes(path, limit)?;
    refuse_binary(&bytes).and_then(|()| decode_xml(&bytes)).map_err(|error| error.in_file(path))
}

/// Reads the bytes of `path`, or of standard input for `-`, at most `limit` of them.
///
/// # Errors
/// [`ErrorKind::Io`] and [`ErrorKind::BadValue`] as in [`read_text`]. All name the file.
pub fn read_bytes(path: &Path, limit: u64) -> Result<Vec<u8>> {
    let fail = |kind, message: String| Err(Error::new(kind, message).in_file(path));
    let io = |error: std::io::Error| Error::io(path, &error);
    let mut bytes = Vec::new();
    if is_stdin(path) {
        std::io::stdin().lock().take(limit.saturating_add(1)).read_to_end(&mut bytes).map_err(io)?;
        if bytes.is_empty() {
            return fail(
                ErrorKind::Syntax,
                "standard input is empty, or was read before; give a description, once".into(),
            );
        }
    } else {
        let file = open(path)?;
        file.take(limit.saturating_add(1)).read_to_end(&mut bytes).map_err(io)?;
    }
    if bytes.len() as u64 > limit {
        return fail(ErrorKind::BadValue, format!("the file is too long; at most {limit} bytes are read"));
    }
    Ok(bytes)
}

/// Same as [`read_bytes`], but for a description: a mesh or an archive beyond the limit is named as such.
///
/// # Errors
/// Those of [`read_bytes`]; [`ErrorKind::Unsupported`] for a file that is too long and begins like an archive, a mesh or
/// another file that is no description.
pub fn read_description(path: &Path, limit: u64) -> Result<Vec<u8>> {
    read_bytes(path, limit).map_err(|error| {
        if is_stdin(path) || error.kind() != ErrorKind::BadValue {
            return error;
        }
        let Ok(file) = open(path) else { return error };
        let mut bytes = Vec::new();
        // A binary STL is recognised by its length.
        let read = file.take(groebot_algebra::limits::MESH_BYTES).read_to_end(&mut bytes);
        let named = read.ok().and_then(|_| refuse_binary(&bytes).err());
        named.map_or(error, |named| named.in_file(path))
    })
}

/// Opens a file for reading. Every reader of files uses this function.
///
/// # Errors
/// [`ErrorKind::Io`] for a missing file, a directory, and a file of a set whose writing was interrupted. All name the
/// file.
pub fn open(path: &Path) -> Result<File> {
    refuse_unfinished(path)?;
    let io = |error: std::io::Error| Error::io(path, &error);
    let file = File::open(path).map_err(io)?;
    if file.metadata().map_err(io)?.is_dir() {
        return Err(Error::new(ErrorKind::Io, "this is a directory; give a file").in_file(path));
    }
    Ok(file)
}

/// Converts `bytes` to nonempty UTF-8 text.
///
/// # Errors
/// [`ErrorKind::Syntax`] as in [`read_text`].
pub fn text_of(bytes: Vec<u8>) -> Result<String> {
    let text = String::from_utf8(bytes).map_err(|error| {
        let line = line_at(error.as_bytes(), error.utf8_error().valid_up_to());
        Error::new(ErrorKind::Syntax, "the text is not UTF-8; save the file as UTF-8").at_line(line)
    })?;
    if text.trim().is_empty() { Err(empty()) } else { Ok(text) }
}

/// Replaces the line ends `\r\n` and `\r` by `\n`, for readers of tables.
pub fn unix_lines(text: &str) -> Cow<'_, str> {
    if text.contains('\r') { Cow::Owned(text.replace("\r\n", "\n").replace('\r', "\n")) } else { Cow::Borrowed(text) }
}
