//! Reading of robots from files of any format: [`Robot::read`], [`Robot::read_with`].

use std::path::Path;

use super::{ReadOptions, Robot, xacro};
use crate::Result;
use crate::document::DescriptionText;

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
    /// Those of [`DescriptionText::read`]; as [`xacro::expand`] and [`Robot::from_xml`], or [`Robot::from_toml`]; [`crate::ErrorKind::Unsupported`] for JSON, YAML
    /// and tables that describe no robot. All have the file.
    pub fn read_with(path: impl AsRef<Path>, options: &ReadOptions) -> Result<Robot> {
        let path = path.as_ref();
        let read = DescriptionText::read(path)?;
        Robot::from_description(&read, path, options).map_err(|error| error.in_file(path))
    }

    fn from_description(read: &DescriptionText, path: &Path, options: &ReadOptions) -> Result<Robot> {
        let DescriptionText { text, is_xml, notes } = read;
        let robot = match is_xml {
            true if xacro::is_xacro(path, text) => xacro::expand_text(text, path, options)?.robot(),
            true => Robot::from_xml(text, Some(path)).map_err(|error| read.explain(error)),
            false => Robot::from_toml(text).map_err(|error| read.explain(error)),
        };
        robot.map(|robot| robot.with_notes(notes.clone()))
    }
}
