//! Triangles of a binary or text STL file. Each error has its line or its triangle. Main function: [`corners`].

use std::io::{self, Cursor, Read, Seek, SeekFrom};

use stl_io::{Triangle, create_stl_reader};

use crate::{Error, ErrorKind, Result};

/// Size of the header of a binary file, whose last four bytes are the number of triangles, and size of a triangle.
const HEAD: usize = 84;
const TRIANGLE: usize = 50;
/// Keyword at the beginning of a text and of each of its solids.
const SOLID: &[u8] = b"solid";

/// Reads the corners of all triangles of a file, in its unit. A text may have several solids.
///
/// # Errors
/// [`ErrorKind::Syntax`] for a file that is not STL, with the line of a text. A binary file must have the length given
/// in its header.
pub fn corners(bytes: Vec<u8>) -> Result<Vec<[[f32; 3]; 3]>> {
    let triangles = if is_text(&bytes) { text(&bytes)? } else { binary(bytes)? };
    Ok(triangles.into_iter().map(|triangle| triangle.vertices.map(|corner| corner.0)).collect())
}

/// Whether a file is a text. A binary file, whose length agrees with its header, may begin like a text.
pub fn is_text(bytes: &[u8]) -> bool {
    begins_solid(bytes.trim_ascii_start()) && expected_length(bytes) != Some(bytes.len())
}

fn wrong(text: &str) -> Error {
    Error::new(ErrorKind::Syntax, format!("this is not an STL file: {text}"))
}

fn begins_solid(bytes: &[u8]) -> bool {
    bytes.get(..SOLID.len()).is_some_and(|word| word.eq_ignore_ascii_case(SOLID))
}

/// The number of triangles in the header of a binary file.
fn count(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(HEAD - 4..HEAD)?.try_into().ok()?;
    usize::try_from(u32::from_le_bytes(count)).ok()
}

/// The length of a binary file with this number of triangles.
fn expected_length(bytes: &[u8]) -> Option<usize> {
    count(bytes)?.checked_mul(TRIANGLE)?.checked_add(HEAD)
}

fn binary(mut bytes: Vec<u8>) -> Result<Vec<Triangle>> {
    let length = bytes.len();
    let (Some(count), Some(expected)) = (count(&bytes), expected_length(&bytes)) else {
        let text =
            format!("a text begins with `solid`, a binary file has a header of {HEAD} bytes; this file has {length}");
        return Err(wrong(&text));
    };
    if length != expected {
        let place = match length < expected {
            true => format!("in triangle {}", (length - HEAD) / TRIANGLE + 1),
            false => "after the last triangle".to_owned(),
        };
        let text = format!("its header has the number {count} of triangles, which end at byte {expected}");
        return Err(wrong(&format!("{text}; the file ends at byte {length}, {place}")));
    }
    // The header must not look like a text.
    bytes[0] = 0;
    let mut bytes = Cursor::new(bytes);
    let triangles = create_stl_reader(&mut bytes).and_then(Iterator::collect);
    triangles.map_err(|error| wrong(&error.to_string()))
}

fn text(bytes: &[u8]) -> Result<Vec<Triangle>> {
    let (mut lines, mut all) = (Lines::new(bytes), Vec::new());
    while lines.skip_blank() {
        let solid = create_stl_reader(&mut lines).and_then(|solid| solid.collect::<io::Result<Vec<_>>>());
        all.extend(solid.map_err(|error| wrong(&error.to_string()).at_line(lines.number))?);
        if !lines.goes_on() {
            return Err(wrong("only a solid may follow a solid").at_line(lines.number + 1));
        }
    }
    Ok(all)
}

/// Passes the solids of a text to a reader line by line, so that the line of an error is known. The reader receives the
/// first line of a solid without its name, lower-case letters, and `?` for characters outside ASCII.
struct Lines<'b> {
    rest: &'b [u8],
    /// The number of the last line, counted from 1.
    number: usize,
    /// The values of `rest` and `number` before the first line of the solid.
    start: (&'b [u8], usize),
    is_within: bool,
}

impl<'b> Lines<'b> {
    fn new(bytes: &'b [u8]) -> Self {
        Lines { rest: bytes, number: 0, start: (bytes, 0), is_within: false }
    }

    /// The next line with its end.
    fn next(&self) -> &'b [u8] {
        let end = self.rest.iter().position(|byte| *byte == b'\n').map_or(self.rest.len(), |end| end + 1);
        &self.rest[..end]
    }

    fn pass(&mut self, length: usize) {
        self.number += usize::from(!self.is_within);
        self.is_within = self.rest[..length].last().is_some_and(|byte| *byte != b'\n');
        self.rest = &self.rest[length..];
    }

    /// Skips to the next solid. Returns whether there is more text.
    fn skip_blank(&mut self) -> bool {
        while !self.rest.is_empty() && self.next().trim_ascii().is_empty() {
            self.pass(self.next().len());
        }
        self.start = (self.rest, self.number);
        !self.rest.is_empty()
    }

    /// Whether the text ends here or another solid follows.
    fn goes_on(&mut self) -> bool {
        !self.skip_blank() || begins_solid(self.next().trim_ascii_start())
    }
}

impl Read for Lines<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let line = self.next();
        if line.is_empty() {
            return Ok(0);
        }
        if self.rest.len() == self.start.0.len() {
            let first = b"solid \n";
            self.pass(line.len());
            self.is_within = false;
            buffer[..first.len()].copy_from_slice(first);
            return Ok(first.len());
        }
        let length = line.len().min(buffer.len());
        for (byte, own) in buffer.iter_mut().zip(&line[..length]) {
            *byte = if own.is_ascii() { own.to_ascii_lowercase() } else { b'?' };
        }
        self.pass(length);
        Ok(length)
    }
}

impl Seek for Lines<'_> {
    /// Returns to the first line of the solid. The reader needs no other position.
    fn seek(&mut self, _: SeekFrom) -> io::Result<u64> {
        (self.rest, self.number) = self.start;
        self.is_within = false;
        Ok(0)
    }
}
