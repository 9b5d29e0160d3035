//! The format of a robot in XML by its root element: [`Robot::from_xml`].

use std::path::Path;

use quick_xml::Reader;
use quick_xml::events::Event;

use super::Robot;
use crate::Result;
use crate::document::is_stdin;

/// A format of robots in XML.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum XmlFormat {
    /// URDF, also for an unknown root element.
    Urdf,
    /// MJCF, with the root element `<mujoco>`.
    Mjcf,
    /// SDF, with the root element `<sdf>`.
    Sdf,
}

impl XmlFormat {
    /// The format of `text` by its root element.
    pub fn of(text: &str) -> XmlFormat {
        let mut reader = Reader::from_str(text);
        loop {
            match reader.read_event() {
                Ok(Event::Start(root) | Event::Empty(root)) => {
                    return match root.name().as_ref() {
                        b"mujoco" => XmlFormat::Mjcf,
                        b"sdf" => XmlFormat::Sdf,
                        _ => XmlFormat::Urdf,
                    };
                }
                Err(_) | Ok(Event::Eof) => return XmlFormat::Urdf,
                Ok(_) => {}
            }
        }
    }
}

impl Robot {
    /// The robot that the XML `text` describes, in the format of its root element. `file` is its path, for the files
    /// that it includes.
    ///
    /// # Errors
    /// Those of [`Robot::from_urdf`], [`Robot::from_mjcf`] and [`Robot::from_sdf`].
    pub fn from_xml(text: &str, file: Option<&Path>) -> Result<Robot> {
        let file = file.filter(|file| !is_stdin(file));
        match XmlFormat::of(text) {
            XmlFormat::Urdf => Robot::from_urdf(text),
            XmlFormat::Mjcf => Robot::from_mjcf(text, file),
            XmlFormat::Sdf => Robot::from_sdf(text, file),
        }
    }
}
