//! Reading of robots from files of any format: [`Robot::read`].

use std::path::Path;

use super::Robot;
use super::urdf::URDF_LIMIT;
use crate::Result;
use crate::document::{TEXT_LIMIT, decode_xml, explained, is_xml, read_description, refuse_binary, text_of};

impl Robot {
    /// The robot that the file at `path` describes: XML where the file's name ends in `.urdf`, `.xml`, `.sdf` or `.mjcf`, or where its text starts with `<`; otherwise TOML. The root element of XML gives the format: `<mujoco>` for MJCF, `<sdf>` for SDF, otherwise URDF.
    ///
    /// # Errors
    /// As [`read_description`], with a limit of four megabytes for these names and of one megabyte for others; as [`decode_xml`] and
    /// [`Robot::from_xml`], or [`Robot::from_toml`]; [`crate::ErrorKind::Unsupported`] for archives, JSON, YAML and tables. All have the file.
    pub fn read(path: impl AsRef<Path>) -> Result<Robot> {
        let path = path.as_ref();
        let named = path
            .extension()
            .is_some_and(|end| ["urdf", "xml", "sdf", "mjcf"].iter().any(|xml| end.eq_ignore_ascii_case(xml)));
        let bytes = read_description(path, if named { URDF_LIMIT } else { TEXT_LIMIT })?;
        Robot::from_bytes(bytes, named, path).map_err(|error| error.in_file(path))
    }

    fn from_bytes(bytes: Vec<u8>, named: bool, path: &Path) -> Result<Robot> {
        refuse_binary(&bytes)?;
        if named || is_xml(&bytes) {
            let xml = decode_xml(&bytes)?;
            let robot = Robot::from_xml(&xml.text, Some(path)).map_err(|error| explained(error, &xml.text))?;
            return Ok(robot.with_notes(xml.notes));
        }
        let text = text_of(bytes)?;
        Robot::from_toml(&text).map_err(|error| explained(error, &text))
    }
}
