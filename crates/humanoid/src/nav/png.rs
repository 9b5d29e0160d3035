//! Maps from PNG images.

use std::io::Cursor;

use nalgebra::Point2;
use png::{ColorType, Decoder, DecodingError, Limits, Transformations};

use super::map::Map;
use super::meaning::Meaning;
use crate::{Error, ErrorKind, Result};

/// The greatest memory of an image in bytes.
const MEMORY: usize = groebot_algebra::limits::IMAGE_MEMORY;

impl Map {
    /// Reads a map from a PNG image by the mean of red, green and blue. The meaning of alpha depends on the
    /// [mode](super::Mode).
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] for an invalid image; [`ErrorKind::BadValue`] beyond a gigabyte; those of
    /// [`Map::of_cells`] and [`Map::placed`].
    pub fn from_png(bytes: &[u8], meaning: &Meaning) -> Result<Self> {
        let mut decoder = Decoder::new_with_limits(Cursor::new(bytes), Limits { bytes: MEMORY });
        decoder.set_transformations(Transformations::EXPAND | Transformations::STRIP_16);
        let mut reader = decoder.read_info().map_err(no_png)?;
        let size = reader.output_buffer_size().filter(|size| *size <= MEMORY);
        let mut pixels = vec![0; size.ok_or_else(too_large)?];
        let info = reader.next_frame(&mut pixels).map_err(no_png)?;
        let (columns, rows) = (info.width as usize, info.height as usize);
        let (colours, has_alpha) = match info.color_type {
            ColorType::Grayscale | ColorType::Indexed => (1, false),
            ColorType::GrayscaleAlpha => (1, true),
            ColorType::Rgb => (3, false),
            ColorType::Rgba => (3, true),
        };
        let cell = |pixel: &[u8]| {
            let (colour, alpha) = pixel.split_at(colours);
            let sum: u32 = colour.iter().map(|value| u32::from(*value)).sum();
            let alpha = alpha.first().map(|alpha| f64::from(*alpha) / 255.0);
            meaning.cell(f64::from(sum) / (255 * colours) as f64, alpha)
        };
        let line = |line: &[u8]| line.chunks_exact(colours + usize::from(has_alpha)).take(columns).map(cell).collect();
        // The first row of an image is the uppermost one.
        let lines: Vec<Vec<_>> = pixels.chunks_exact(info.line_size.max(1)).take(rows).map(line).collect();
        let cells = lines.into_iter().rev().flatten().collect();
        let [x, y, yaw] = meaning.origin;
        Map::of_cells(columns, rows, meaning.resolution, cells)?.placed(Point2::new(x, y), yaw)
    }
}

fn no_png(error: DecodingError) -> Error {
    match error {
        DecodingError::LimitsExceeded => too_large(),
        error => Error::new(ErrorKind::Syntax, format!("this is no PNG: {error}")),
    }
}

fn too_large() -> Error {
    Error::new(ErrorKind::BadValue, format!("the image takes more than {MEMORY} bytes"))
}
