//! Output of commands: never replaces an input, and replaces a user's own file only with `--force`.

use std::borrow::Cow;
use std::io;
use std::path::{Path, PathBuf};

use super::moving::ends;
use super::progress::begin_output;
use super::{Halt, Outcome};
use crate::{Error, ErrorKind, Result};
use groebot_ik::derive::report::stages::STAGES;
use groebot_robot::document::is_stdin;
use groebot_robot::files::{MARK, Target, is_marked, refuse_foreign, write_atomically, write_into};

/// Whether files that groebot did not write may be replaced.
#[derive(Clone, Copy, clap::Args)]
pub struct Force {
    /// Replace files that groebot did not write
    #[arg(long)]
    pub force: bool,
}

/// The form of the mark in a file.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A comment of XML, after the declaration if there is one: SVG, URDF, MJCF, X3D, HTML, Markdown.
    Markup,
    /// A line of comment after the first line: VRML.
    Vrml,
    /// A member of the object.
    Json,
    /// A line of comment at the start with this prefix: LaTeX, systems of polynomials.
    Lines(&'static str),
    /// None: it has its own, or its format does not permit one, as for tables.
    Plain,
}

/// The output of a command: its inputs, and whether foreign files may be replaced.
pub struct Output {
    inputs: Vec<PathBuf>,
    force: bool,
}

impl Force {
    /// The output of a command that reads `inputs`, files or folders.
    pub fn output<'a>(self, inputs: impl IntoIterator<Item = &'a Path>) -> Output {
        let all = inputs.into_iter().filter(|path| !is_stdin(path)).flat_map(within).collect();
        Output { inputs: all, force: self.force }
    }
}

/// The file itself, or those of a folder that commands read.
fn within(path: &Path) -> Vec<PathBuf> {
    let is_read = |file: &PathBuf| {
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        name.starts_with("0_") || STAGES.contains(&&*name) || name == "7_dynamics.json"
    };
    match path.read_dir() {
        Ok(entries) => entries.flatten().map(|entry| entry.path()).filter(is_read).collect(),
        Err(_) => vec![path.to_owned()],
    }
}

impl Output {
    /// Checks before the work: outputs that are inputs, directories or links, and two that are one file.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] with the file; as [`Target::of`].
    pub fn expects<'a>(self, files: impl IntoIterator<Item = Option<&'a PathBuf>>) -> Result<Self> {
        let files: Vec<&PathBuf> = files.into_iter().flatten().collect();
        for (place, file) in files.iter().enumerate() {
            let target = self.target(file)?;
            let twice = |other: &&&PathBuf| target == Target::File && (other == &file || is_same_file(other, file));
            if files[..place].iter().any(|other| twice(&other)) {
                let text = "two results have this one output file; give each its own name";
                return Err(Error::new(ErrorKind::BadValue, text).in_file(file));
            }
        }
        Ok(self)
    }

    /// Writes a file completely. It replaces no file or one of groebot's own; devices and pipes are written directly.
    pub fn write(&self, path: &Path, kind: Kind, content: impl AsRef<[u8]>) -> Outcome {
        begin_output()?;
        let content = kind.marked(content.as_ref());
        if self.target(path)? == Target::Stream {
            return write_into(path, &content).map_err(|error| match error.kind() {
                io::ErrorKind::BrokenPipe => Halt::PipeClosed,
                _ => Halt::Error(Error::io(path, &error)),
            });
        }
        self.accepts(path, &content)?;
        Ok(write_atomically(path, &content)?)
    }

    /// Checks whether `content` may replace the file at `path`.
    ///
    /// # Errors
    /// As [`refuse_foreign`].
    pub fn accepts(&self, path: &Path, content: &[u8]) -> Result<()> {
        self.target(path)?;
        if self.force { Ok(()) } else { refuse_foreign(path, content) }
    }

    fn target(&self, path: &Path) -> Result<Target> {
        let target = Target::of(path)?;
        if target != Target::Stream && self.inputs.iter().any(|input| is_same_file(input, path)) {
            let text = "this is an input of the command, which is never replaced; give another output file";
            return Err(Error::new(ErrorKind::BadValue, text).in_file(path));
        }
        if target == Target::Link && !self.force {
            refuse_foreign(path, &[])?;
        }
        Ok(target)
    }
}

impl Kind {
    /// The kind of a motion or a map: JSON by its name, else a table.
    pub fn of_motion(file: &Path) -> Self {
        if ends(file, "json") { Kind::Json } else { Kind::Plain }
    }

    /// The content with the mark that [`refuse_foreign`] recognises.
    fn marked(self, content: &[u8]) -> Cow<'_, [u8]> {
        let (place, mark) = match self {
            _ if is_marked(content) => return Cow::Borrowed(content),
            Kind::Plain => return Cow::Borrowed(content),
            Kind::Json => (content.iter().position(|byte| *byte == b'{').map_or(0, |at| at + 1), json_mark(content)),
            Kind::Vrml => (first_line(content), format!("# {MARK}\n")),
            Kind::Lines(comment) => (0, format!("{comment} {MARK}\n")),
            Kind::Markup => {
                let head = [&b"<?xml"[..], b"<!doctype"].iter().any(|head| content.starts_with(head));
                (if head { first_line(content) } else { 0 }, format!("<!-- {MARK} -->\n"))
            }
        };
        Cow::Owned([&content[..place], mark.as_bytes(), &content[place..]].concat())
    }
}

/// An empty object or array cannot have the mark as a member.
fn json_mark(content: &[u8]) -> String {
    let is_object = content.first() == Some(&b'{') && !content.starts_with(b"{}");
    if is_object { "\"generator\":\"groebot\",".to_owned() } else { String::new() }
}

fn first_line(content: &[u8]) -> usize {
    content.iter().position(|byte| *byte == b'\n').map_or(content.len(), |at| at + 1)
}

/// Whether two paths refer to one file, also through links.
#[cfg(unix)]
pub fn is_same_file(a: &Path, b: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    let id = |path: &Path| std::fs::metadata(path).map(|found| (found.dev(), found.ino()));
    matches!((id(a), id(b)), (Ok(a), Ok(b)) if a == b)
}

/// Whether two paths refer to one file, also through links.
#[cfg(not(unix))]
pub fn is_same_file(a: &Path, b: &Path) -> bool {
    matches!((std::fs::canonicalize(a), std::fs::canonicalize(b)), (Ok(a), Ok(b)) if a == b)
}
