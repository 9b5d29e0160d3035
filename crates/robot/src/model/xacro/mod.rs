//! Expansion of descriptions in xacro, the macro language of ROS for URDF. Main function: [`expand`].
//!
//! The language is that of the package `xacro` of ROS: macros with default, forwarded and block parameters, properties
//! that are evaluated at their first use, expressions in `${...}`, `$(arg)`, `$(find)`, `$(dirname)` and `$(eval)`,
//! includes, conditions, `load_yaml`. Differences, which all refuse something or limit it:
//!
//! * Files are read only in the folder of the description, in the package that contains it (the nearest folder above
//!   with a `package.xml`), and in the packages of [`ReadOptions`].
//! * Environment variables are not read. `$(optenv NAME VALUE)` is `VALUE`.
//! * An expansion has the limits of [`groebot_algebra::limits`]: bytes, files, steps, depth.
//!
//! ```
//! # use groebot_robot::model::{ReadOptions, xacro};
//! # let folder = tempfile::tempdir()?;
//! let file = folder.path().join("arm.urdf.xacro");
//! std::fs::write(&file, r#"<robot name="arm"><xacro:arg name="size" default="2"/><link name="l${1 + $(arg size)}"/></robot>"#)?;
//! let expanded = xacro::expand(&file, &ReadOptions::new().argument("size", "4"))?;
//! assert!(expanded.text.contains(r#"<link name="l5"/>"#));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod budget;
mod expand;
mod expression;
mod files;
mod macros;
mod node;
pub(super) mod packages;
mod scope;
mod text;
mod yaml;

use std::path::{Path, PathBuf};
use std::rc::Rc;

use super::{ReadOptions, Robot};
use crate::document::read_xml;
use crate::{Error, ErrorKind, Result};
use expand::Expander;
use groebot_algebra::limits;
use node::{Element, Location};

/// Bytes of the stack of an expansion. [`limits::XACRO_DEPTH`] levels need a few megabytes without optimisation, more than the stack of other threads has.
const STACK: usize = 64 << 20;
/// The definitions of xacro, which alone change nothing.
const DEFINITIONS: [&str; 2] = ["property", "arg"];

/// An expanded description.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub struct Expanded {
    /// The text without xacro, with one element per line.
    pub text: String,
    /// Notes, such as the warnings of the description.
    pub notes: Vec<String>,
    /// The files that were read.
    pub files: Vec<PathBuf>,
    /// The location of each line of the text: the index of its file, and its line there.
    locations: Vec<(usize, usize)>,
}

impl Expanded {
    /// The robot of the text, with these notes. Its errors and faults have the lines of the description.
    ///
    /// # Errors
    /// As [`Robot::from_urdf`].
    pub fn robot(&self) -> Result<Robot> {
        let robot = Robot::from_urdf(&self.text).map_err(|error| self.located(error))?;
        Ok(robot.with_fault_errors(|error| self.located(error)).with_notes(self.notes.clone()))
    }

    /// `error` with the file and line of the description for a line of the expanded text.
    #[must_use]
    pub fn located(&self, error: Error) -> Error {
        let line = error.place().line.filter(|_| error.place().file.is_none());
        let location = line.and_then(|line| self.locations.get(line.checked_sub(1)?));
        let Some((file, line)) = location else { return error };
        Error::new(error.kind(), error.message()).at_line(*line).in_file(&self.files[*file])
    }
}

/// Whether the XML `text` of the file `path` is expanded: its name ends in `.xacro`, or it has elements of xacro other
/// than definitions that nothing uses.
pub fn is_xacro(path: &Path, text: &str) -> bool {
    let is_named = path.extension().is_some_and(|end| end.eq_ignore_ascii_case("xacro"));
    let mut elements = text.split("<xacro:").skip(1).peekable();
    let is_used = elements.peek().is_some() && (text.contains("${") || text.contains("$("));
    let is_definition = |rest: &str| {
        DEFINITIONS.iter().any(|name| {
            rest.strip_prefix(name)
                .is_some_and(|rest| rest.starts_with(|c: char| c.is_whitespace() || "/>".contains(c)))
        })
    };
    is_named || is_used || !elements.all(is_definition)
}

/// Expands the description in the file `path`, or on standard input for `-`, whose includes are then in the current
/// folder.
///
/// # Errors
/// As [`read_xml`]. All other errors have the file and line of an element; in a macro, the message
/// has the place of the call. [`crate::ErrorKind::Syntax`] for text that is not XML and for invalid expressions;
/// [`crate::ErrorKind::MissingKey`] for missing attributes and parameters; [`crate::ErrorKind::UnknownKey`] for
/// parameters that a macro does not have; [`crate::ErrorKind::UnknownName`] for unknown macros, blocks, properties,
/// arguments and packages; [`crate::ErrorKind::BadValue`] for wrong values and above the limits;
/// [`crate::ErrorKind::Unsupported`] for files outside of the packages and for environment variables;
/// [`crate::ErrorKind::Io`] for missing files.
pub fn expand(path: &Path, options: &ReadOptions) -> Result<Expanded> {
    let xml = read_xml(path, limits::XML_BYTES)?;
    let mut expanded = expand_text(&xml.text, path, options)?;
    expanded.notes.extend(xml.notes);
    Ok(expanded)
}

/// Expands the `text` of the file `path`. The file itself is not read.
///
/// # Errors
/// Those of [`expand`].
pub fn expand_text(text: &str, path: &Path, options: &ReadOptions) -> Result<Expanded> {
    std::thread::scope(|scope| {
        let thread = std::thread::Builder::new().stack_size(STACK);
        let thread = thread.spawn_scoped(scope, || expand_on_this_stack(text, path, options));
        let thread = thread.map_err(|error| Error::io(path, &error))?;
        thread.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    })
}

fn expand_on_this_stack(text: &str, path: &Path, options: &ReadOptions) -> Result<Expanded> {
    let mut expander = Expander::new(path, options);
    let root = Element::parse(text, 0).map_err(|error| error.in_file(path))?;
    expander.budget.spend_file(text.len() as u64)?;
    let root = expander.root(&Rc::new(root))?;
    let (mut text, mut locations) = ("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n".to_owned(), Vec::new());
    locations.push(root.location);
    root.write(0, &mut text, &mut locations);
    if text.len() as u64 > limits::XML_BYTES {
        let message = format!("the expansion has {} bytes; at most {} are read", text.len(), limits::XML_BYTES);
        return Err(Error::new(ErrorKind::BadValue, message).in_file(path));
    }
    let locations = locations.into_iter().map(|Location { file, line }| (file, line)).collect();
    Ok(Expanded { text, notes: expander.notes, files: expander.files, locations })
}
