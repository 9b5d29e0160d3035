//! Reading of robots from files of any format: [`Robot::read`], [`Robot::read_with`].

use std::path::Path;

use super::urdf::URDF_LIMIT;
use super::{ReadOptions, Robot, xacro};
use crate::Result;
use crate::document::{
    TEXT_LIMIT, as_toml, decode_xml, explained, has_xml_name, is_xml, read_description, refuse_binary, text_of,
};

impl Robot {
    /// The robot that the file at `path` describes, with [`ReadOptions::from_environment`].
    ///
    /// # Errors
    /// Those of [`Robot::read_with`].
    pub fn read(path: impl AsRef<Path>) -> Result<Robot> {
        Robot::read_with(path, &ReadOptions::from_environment())
    }

    /// The robot that the file at `path` describes: XML where the file's name ends in `.urdf`, `.xml`, `.xacro`, `.sdf` or `.mjcf`, or where its text
    /// starts with `<`; otherwise TOML. A description in [xacro] is expanded. The root element of other XML gives the format: `<mujoco>` for MJCF, `<sdf>` for
    /// SDF, otherwise URDF. Errors have the file and the line of the description before the expansion.
    ///
    /// # Errors
    /// As [`read_description`], with a limit of four megabytes for these names and of one megabyte for others; as
    /// [`decode_xml`], [`xacro::expand`] and [`Robot::from_xml`], or [`Robot::from_toml`]; [`crate::ErrorKind::Unsupported`] for archives, JSON, YAML and
    /// tables. All have the file.
    pub fn read_with(path: impl AsRef<Path>, options: &ReadOptions) -> Result<Robot> {
        let path = path.as_ref();
        let named = has_xml_name(path);
        let bytes = read_description(path, if named { URDF_LIMIT } else { TEXT_LIMIT })?;
        Robot::from_bytes(bytes, named, path, options).map_err(|error| error.in_file(path))
    }

    fn from_bytes(bytes: Vec<u8>, named: bool, path: &Path, options: &ReadOptions) -> Result<Robot> {
        refuse_binary(&bytes)?;
        if named || is_xml(&bytes) {
            let xml = decode_xml(&bytes)?;
            if xacro::is_xacro(path, &xml.text) {
                return Ok(xacro::expand_text(&xml.text, path, options)?.robot()?.with_notes(xml.notes));
            }
            let robot = Robot::from_xml(&xml.text, Some(path)).map_err(|error| explained(error, &xml.text))?;
            return Ok(robot.with_notes(xml.notes));
        }
        let text = as_toml(text_of(bytes)?)?;
        Robot::from_toml(&text).map_err(|error| explained(error, &text))
    }
}
