//! Readers of maps: pairs of YAML and image of ROS' `map_server`, images, and text.

use std::path::Path;

use nalgebra::Point2;

use super::map::{Cell, Map};
use super::meaning::{Meaning, Mode};
use super::room::Room;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::limits;
use groebot_robot::document::{TEXT_LIMIT, read_bytes, read_text, shown};

/// The greatest length of the description of an image, in bytes.
const DESCRIPTION_LIMIT: u64 = limits::MAP_BYTES;
/// The greatest length of an image or text, in bytes.
const IMAGE_LIMIT: u64 = limits::IMAGE_BYTES;

impl Map {
    /// Reads a map from a file. It is a `.yaml` or `.yml` with its image, a `.pgm` or `.png` with pixels of this side
    /// \[m\], text (`.txt`, `.map`) with such cells, or a [`Room`] (`.toml`).
    ///
    /// # Errors
    /// [`ErrorKind::Io`], [`ErrorKind::Unsupported`] for another extension, and those of [`Map::from_pgm`],
    /// [`Map::from_png`], [`Map::from_text`], [`Room::from_toml`] and [`Room::map`]; all with the file.
    pub fn read(path: &Path, resolution: f64) -> Result<Self> {
        let map = match ending(path).as_str() {
            "yaml" | "yml" => {
                let text = read_text(path, DESCRIPTION_LIMIT)?;
                let (image, meaning) = Meaning::from_yaml(&text).map_err(|error| error.in_file(path))?;
                let image = path.parent().unwrap_or(Path::new("")).join(image);
                return Map::from_image(&image, &meaning).map_err(|e| e.in_file(&image));
            }
            "txt" | "map" => Map::from_text(&read_text(path, IMAGE_LIMIT)?, resolution),
            "toml" => Room::from_toml(&read_text(path, TEXT_LIMIT)?).and_then(|room| room.map()),
            // Without a YAML, alpha is not a colour as in the mode `trinary`.
            _ => Map::from_image(path, &Meaning { mode: Mode::Scale, ..Meaning::new(resolution) }),
        };
        map.map_err(|error| error.in_file(path))
    }

    fn from_image(path: &Path, meaning: &Meaning) -> Result<Self> {
        match ending(path).as_str() {
            "pgm" => Map::from_pgm(&read_bytes(path, IMAGE_LIMIT)?, meaning),
            "png" => Map::from_png(&read_bytes(path, IMAGE_LIMIT)?, meaning),
            _ => {
                let text = "an image of a map is a .pgm or .png; other maps are .yaml, .txt, .map and .toml";
                Err(Error::new(ErrorKind::Unsupported, text))
            }
        }
    }

    /// Reads a map from a PGM image, plain (P2) or binary (P5).
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] for an invalid image, and those of [`Map::of_cells`] and [`Map::placed`].
    pub fn from_pgm(bytes: &[u8], meaning: &Meaning) -> Result<Self> {
        let mut words = Words { bytes, at: 0 };
        let bad = |text: String| Error::new(ErrorKind::Syntax, text);
        let magic = words.word().unwrap_or_default();
        let is_plain = match magic {
            b"P2" => true,
            b"P5" => false,
            _ => return Err(bad(format!("the image begins with `{}`; a PGM begins with P2 or P5", text(magic)))),
        };
        let mut head = |name: &str, most: u32| words.number(name, most).map_err(bad);
        let (columns, rows) = (head("width", 1 << 28)? as usize, head("height", 1 << 28)? as usize);
        let most = head("greatest value", 65_535)?.max(1);
        let count = columns.saturating_mul(rows);
        let mut cells = Vec::new();
        if is_plain {
            for pixel in 0..count {
                let value = words.number("value", most).map_err(|text| bad(format!("pixel {pixel}: {text}")))?;
                cells.push(meaning.cell(f64::from(value) / f64::from(most), None));
            }
        } else {
            let wide = if most > 255 { 2 } else { 1 };
            let pixels = bytes.get(words.at + 1..).unwrap_or_default();
            if pixels.len() < count.saturating_mul(wide) {
                let text =
                    format!("{} bytes of pixels; {columns} x {rows} take {}", pixels.len(), count.saturating_mul(wide));
                return Err(bad(text));
            }
            let value = |pixel: &[u8]| pixel.iter().fold(0, |value, byte| value << 8 | u32::from(*byte));
            for (pixel, value) in pixels.chunks_exact(wide).take(count).map(value).enumerate() {
                if value > most {
                    return Err(bad(format!("pixel {pixel}: the value is {value}; give a number up to {most}")));
                }
                cells.push(meaning.cell(f64::from(value) / f64::from(most), None));
            }
        }
        // The first row of an image is the uppermost one.
        let cells = cells.chunks(columns.max(1)).rev().flatten().copied().collect();
        let [x, y, yaw] = meaning.origin;
        Map::of_cells(columns, rows, meaning.resolution, cells)?.placed(Point2::new(x, y), yaw)
    }

    /// Reads a map from rows of characters, the uppermost one first. `.`, `G`, `S` and blanks are free, `?` is unknown,
    /// `#`, `@`, `O`, `T` and `W` are occupied. A `.map` header of the Moving AI lab may precede them.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] for another character, rows of different lengths and a header with other dimensions, with
    /// the line; those of [`Map::of_cells`].
    pub fn from_text(text: &str, resolution: f64) -> Result<Self> {
        let mut lines: Vec<(usize, &str)> = text.lines().enumerate().map(|(place, line)| (place + 1, line)).collect();
        let has_head = lines.first().is_some_and(|(_, line)| line.starts_with("type "));
        let head: Vec<(usize, &str)> = lines.drain(..if has_head { lines.len().min(4) } else { 0 }).collect();
        while lines.last().is_some_and(|(_, line)| line.is_empty()) {
            lines.pop();
        }
        let columns = lines.first().map_or(0, |(_, line)| line.chars().count());
        for (place, line) in head {
            let count = match line.split_once(' ') {
                Some(("height", value)) if value.trim() != lines.len().to_string() => lines.len(),
                Some(("width", value)) if value.trim() != columns.to_string() => columns,
                _ => continue,
            };
            let text = format!("the header gives `{}`; the rows give {count}", shown(line));
            return Err(Error::new(ErrorKind::Syntax, text).at_line(place));
        }
        let mut cells = Vec::new();
        for (place, line) in lines.iter().rev() {
            let bad = |text: String| Error::new(ErrorKind::Syntax, text).at_line(*place);
            let before = cells.len();
            for character in line.chars() {
                cells.push(match character {
                    '.' | ' ' | 'G' | 'S' => Cell::Free,
                    '?' => Cell::Unknown,
                    '#' | '@' | 'O' | 'T' | 'W' => Cell::Occupied,
                    _ => {
                        let text = format!(
                            "`{}` is not a cell; give . or G or S, ?, or # or @ or O or T or W",
                            shown(&character.to_string())
                        );
                        return Err(bad(text));
                    }
                });
            }
            if cells.len() - before != columns {
                return Err(bad(format!("{} cells in a row; the first one has {columns}", cells.len() - before)));
            }
        }
        Map::of_cells(columns, lines.len(), resolution, cells)
    }
}

/// The extension of a file name.
fn ending(path: &Path) -> String {
    path.extension().and_then(|ending| ending.to_str()).unwrap_or_default().to_ascii_lowercase()
}

/// The words of an image's header, with comments between them.
struct Words<'a> {
    bytes: &'a [u8],
    at: usize,
}

impl<'a> Words<'a> {
    fn word(&mut self) -> Option<&'a [u8]> {
        loop {
            match self.bytes.get(self.at)? {
                b'#' => {
                    let rest = &self.bytes[self.at..];
                    self.at += rest.iter().position(|byte| *byte == b'\n').unwrap_or(rest.len());
                }
                byte if byte.is_ascii_whitespace() => self.at += 1,
                _ => break,
            }
        }
        let rest = &self.bytes[self.at..];
        let length = rest.iter().position(u8::is_ascii_whitespace).unwrap_or(rest.len());
        self.at += length;
        Some(&rest[..length])
    }

    fn number(&mut self, name: &str, most: u32) -> std::result::Result<u32, String> {
        let word = self.word().unwrap_or_default();
        let number = std::str::from_utf8(word).ok().and_then(|word| word.parse().ok());
        number
            .filter(|number| *number <= most)
            .ok_or_else(|| format!("the {name} is `{}`; give a number up to {most}", text(word)))
    }
}

fn text(bytes: &[u8]) -> String {
    shown(&String::from_utf8_lossy(&bytes[..bytes.len().min(40)])).to_string()
}
