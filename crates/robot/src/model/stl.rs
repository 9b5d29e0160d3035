//! The triangles of an STL file, text or binary, each mistake with its line or its triangle. Main function: [`corners`].

use std::io::{self, Cursor, Read, Seek, SeekFrom};

use stl_io::{Triangle, create_stl_reader};

use crate::{Error, ErrorKind, Result};

/// The bytes before the triangles of a binary file, the last four of which count them, and those of a triangle.
const HEAD: usize = 84;
const TRIANGLE: usize = 50;
/// How a text, and each of its solids, begins.
const SOLID: &[u8] = b"solid";

/// The corners of all triangles of a file, in its unit. A text may have several solids.
///
/// # Errors
/// [`ErrorKind::Syntax`] for what is no STL, with the line of a text; a binary file has the length that its head says.
pub fn corners(bytes: Vec<u8>) -> Result<Vec<[[f32; 3]; 3]>> {
    let triangles = if is_text(&bytes) { text(&bytes)? } else { binary(bytes)? };
    Ok(triangles.into_iter().map(|triangle| triangle.vertices.map(|corner| corner.0)).collect())
}

/// Whether a file is a text; a binary file, which has the length that its head says, may begin like one.
pub fn is_text(bytes: &[u8]) -> bool {
    begins_solid(bytes.trim_ascii_start()) && expected_length(bytes) != Some(bytes.len())
}

fn wrong(text: &str) -> Error {
    Error::new(ErrorKind::Syntax, format!("this is no STL: {text}"))
}

fn begins_solid(bytes: &[u8]) -> bool {
    bytes.get(..SOLID.len()).is_some_and(|word| word.eq_ignore_ascii_case(SOLID))
}

/// The number of triangles that a binary file counts.
fn count(bytes: &[u8]) -> Option<usize> {
    let count = bytes.get(HEAD - 4..HEAD)?.try_into().ok()?;
    usize::try_from(u32::from_le_bytes(count)).ok()
}

/// The length of a binary file with so many triangles.
fn expected_length(bytes: &[u8]) -> Option<usize> {
    count(bytes)?.checked_mul(TRIANGLE)?.checked_add(HEAD)
}

fn binary(mut bytes: Vec<u8>) -> Result<Vec<Triangle>> {
    let length = bytes.len();
    let (Some(count), Some(expected)) = (count(&bytes), expected_length(&bytes)) else {
        let text = format!("a text begins with `solid`, a binary file has a head of {HEAD} bytes; this has {length}");
        return Err(wrong(&text));
    };
    if length != expected {
        let place = match length < expected {
            true => format!("in triangle {}", (length - HEAD) / TRIANGLE + 1),
            false => "behind the last one".to_owned(),
        };
        let text = format!("its head counts {count} triangles, which end at byte {expected}");
        return Err(wrong(&format!("{text}; the file ends at byte {length}, {place}")));
    }
    // What a head says must not look like a text.
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

/// Gives the solids of a text to a reader line by line, so that the line where it stops is known. The reader sees the first line of a solid without its
/// name, small letters, and `?` for what is not ASCII.
struct Lines<'b> {
    rest: &'b [u8],
    /// The line that was given last, counted from 1.
    number: usize,
    /// The first line of the solid, as `rest` and `number` were before it.
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

    /// Goes to the next solid; whether there is more.
    fn skip_blank(&mut self) -> bool {
        while !self.rest.is_empty() && self.next().trim_ascii().is_empty() {
            self.pass(self.next().len());
        }
        self.start = (self.rest, self.number);
        !self.rest.is_empty()
    }

    /// Whether nothing or a solid comes next.
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
    /// Goes back to the first line of the solid, which is all that the reader asks for.
    fn seek(&mut self, _: SeekFrom) -> io::Result<u64> {
        (self.rest, self.number) = self.start;
        self.is_within = false;
        Ok(0)
    }
}
