//! The text of a description before its format is known. Main type: [`DescriptionText`].

use std::path::Path;

use super::content::{explained, has_xml_name, is_xml, refuse_binary};
use super::converted::as_toml;
use super::encoding::decode_xml;
use super::text::{is_stdin, read_description, text_of};
use crate::{Error, Result};
use groebot_algebra::limits;

/// The decoded text of a description.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct DescriptionText {
    /// The text. That of a table in CSV or of a calibration in YAML is converted to TOML.
    pub text: String,
    /// Whether it is XML: by its first character, or by the file's name.
    pub is_xml: bool,
    /// Notes on the encoding.
    pub notes: Vec<String>,
}

impl DescriptionText {
    /// Reads the file `path`, or standard input for `-`: XML where the file's name ends in `.urdf`, `.xml`, `.xacro`, `.sdf` or `.mjcf`, or where the text starts
    /// with `<`; otherwise TOML, or a format that [`as_toml`] converts.
    ///
    /// # Errors
    /// [`ErrorKind::Io`] for a file that cannot be read; [`ErrorKind::BadValue`] above four megabytes for XML names and standard input, and above one megabyte
    /// otherwise; [`ErrorKind::Unsupported`] for archives, meshes, scenes and images; those of [`decode_xml`] and [`as_toml`]; [`ErrorKind::Syntax`] for other
    /// text that is not UTF-8. All name the file.
    ///
    /// [`ErrorKind::Io`]: crate::ErrorKind::Io
    /// [`ErrorKind::BadValue`]: crate::ErrorKind::BadValue
    /// [`ErrorKind::Unsupported`]: crate::ErrorKind::Unsupported
    /// [`ErrorKind::Syntax`]: crate::ErrorKind::Syntax
    pub fn read(path: &Path) -> Result<DescriptionText> {
        let is_named = has_xml_name(path);
        let limit = if is_named || is_stdin(path) { limits::XML_BYTES } else { limits::DESCRIPTION_BYTES };
        let bytes = read_description(path, limit)?;
        DescriptionText::of(bytes, is_named).map_err(|error| error.in_file(path))
    }

    fn of(bytes: Vec<u8>, is_named: bool) -> Result<DescriptionText> {
        refuse_binary(&bytes)?;
        if is_named || is_xml(&bytes) {
            let decoded = decode_xml(&bytes)?;
            return Ok(DescriptionText { text: decoded.text, is_xml: true, notes: decoded.notes });
        }
        let text = as_toml(text_of(bytes)?)?;
        Ok(DescriptionText { text, is_xml: false, notes: Vec::new() })
    }

    /// The error of a reader of this text. If the text has another known format, such as JSON, the error names it instead.
    pub fn explain(&self, error: Error) -> Error {
        explained(error, &self.text)
    }
}
