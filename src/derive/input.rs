//! Reading what a derivation starts from: a chain, a robot or a system of equations, from a file or a mechanism's folder.

use std::path::{Path, PathBuf};

use super::{System, formulate};
use crate::document::{Document, TEXT_LIMIT, read_text};
use crate::kinematics::urdf::URDF_LIMIT;
use crate::kinematics::{Chain, Tree};
use crate::{Error, ErrorKind, Result};

/// The names that an input may have in a mechanism's folder: a chain (also as a DH table), a system, a robot.
pub const INPUT_NAMES: [&str; 3] = ["0_chain.toml", "0_system.toml", "0_robot.urdf"];

/// The links of a robot between which a chain is wanted.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Ends {
    /// Where it starts; by default the root.
    pub base: Option<String>,
    /// Where it ends; by default the only leaf.
    pub tip: Option<String>,
}

/// What a file describes.
#[derive(Clone, Debug, PartialEq)]
pub enum Description {
    /// One chain: `chain.toml` or a DH table.
    Chain(Box<Chain>),
    /// Equations.
    System(System),
    /// A robot with any number of limbs: URDF.
    Tree(Tree),
}

/// A file as it was read.
#[derive(Clone, Debug, PartialEq)]
pub struct InputFile {
    /// Where it was read from.
    pub path: PathBuf,
    /// The file's name in a mechanism's folder: one of [`INPUT_NAMES`].
    pub name: &'static str,
    /// Its text.
    pub text: String,
    /// What it describes.
    pub description: Description,
}

impl InputFile {
    /// Reads a mechanism's folder or an input file. A file `.urdf` or `.xml`, or one that starts with `<`, is a robot; one with a
    /// `[dh]` a DH table, one with a `[tip]` or `[task]` a chain, any other a system.
    ///
    /// # Errors
    /// [`ErrorKind::Io`] for what cannot be read; [`ErrorKind::BadValue`] for a folder without exactly one input; as
    /// [`Tree::from_urdf`], [`Chain::from_dh_toml`], [`Chain::from_toml`] and [`System::from_toml`], with file and line.
    pub fn read(path: &Path) -> Result<InputFile> {
        let file = if path.is_dir() { input_in(path)? } else { path.to_owned() };
        let is_xml =
            file.extension().is_some_and(|end| end.eq_ignore_ascii_case("urdf") || end.eq_ignore_ascii_case("xml"));
        let text = read_text(&file, if is_xml { URDF_LIMIT } else { TEXT_LIMIT })?;
        let is_xml = is_xml || text.trim_start_matches('\u{feff}').trim_start().starts_with('<');
        let described = if is_xml { Tree::from_urdf(&text).map(Description::Tree) } else { from_toml(&text) };
        let description = described.map_err(|error| error.in_file(&file))?;
        let name = match description {
            Description::Chain(_) => INPUT_NAMES[0],
            Description::System(_) => INPUT_NAMES[1],
            Description::Tree(_) => INPUT_NAMES[2],
        };
        Ok(InputFile { path: file, name, text, description })
    }

    /// The chain of this input, between `ends` when it is a robot; none when it is a system.
    ///
    /// # Errors
    /// As [`Tree::chain`]; [`ErrorKind::BadValue`] for ends of an input that has no links. All name the file.
    pub fn chain(&self, ends: &Ends) -> Result<Option<Chain>> {
        let chain = match &self.description {
            Description::Tree(tree) => tree.chain(ends.base.as_deref(), ends.tip.as_deref()).map(Some),
            _ if *ends != Ends::default() => {
                let text = "base and tip are chosen, but only a URDF has links to choose from; leave them out";
                Err(Error::new(ErrorKind::BadValue, text))
            }
            Description::Chain(chain) => Ok(Some((**chain).clone())),
            Description::System(_) => Ok(None),
        };
        chain.map_err(|error| error.in_file(&self.path))
    }
}

fn from_toml(text: &str) -> Result<Description> {
    let has = {
        let document = Document::parse(text)?;
        ["dh", "tip", "task"].map(|key| document.root().optional(key).is_some())
    };
    let boxed = |chain| Description::Chain(Box::new(chain));
    match has {
        [true, ..] => Chain::from_dh_toml(text).map(boxed),
        [false, false, false] => System::from_toml(text).map(Description::System),
        _ => Chain::from_toml(text).map(boxed),
    }
}

/// An input as it was read, and the equations that it amounts to.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    /// Where it was read from.
    pub path: PathBuf,
    /// The file's name in a mechanism's folder: one of [`INPUT_NAMES`].
    pub name: &'static str,
    /// Its text.
    pub text: String,
    /// The chain, when it describes one.
    pub chain: Option<Chain>,
    /// The equations; none for a chain whose task is only solved joint by joint.
    pub system: Option<System>,
}

impl Source {
    /// Reads a mechanism's folder or an input file, as [`InputFile::read`] does; of a robot, the chain from its root to its only leaf.
    ///
    /// # Errors
    /// As [`InputFile::read`], [`InputFile::chain`] and [`mod@formulate`], with file and line.
    pub fn read(path: &Path) -> Result<Source> {
        Source::read_between(path, &Ends::default())
    }

    /// The same, of a robot the chain between `ends`.
    ///
    /// # Errors
    /// As [`InputFile::read`], [`InputFile::chain`] and [`mod@formulate`], with file and line.
    pub fn read_between(path: &Path, ends: &Ends) -> Result<Source> {
        let input = InputFile::read(path)?;
        let chain = input.chain(ends)?;
        let InputFile { path, name, text, description } = input;
        let system = match (&chain, description) {
            (Some(chain), _) => formulated(chain).map_err(|error| error.in_file(&path))?,
            (None, Description::System(system)) => Some(system),
            (None, _) => return Err(Error::new(ErrorKind::BadValue, "there is no chain and no system").in_file(&path)),
        };
        Ok(Source { path, name, text, chain, system })
    }

    /// The chain, when it is to be solved joint by joint: it asks for no order of unknowns and no choice of root, which belong to
    /// equations that are solved together.
    pub fn chain_by_steps(&self) -> Option<&Chain> {
        self.chain.as_ref().filter(|chain| chain.order().is_none() && chain.choice().is_none())
    }
}

/// The equations of `chain`, where its task has any that are solved together.
fn formulated(chain: &Chain) -> Result<Option<System>> {
    match formulate(chain) {
        Ok(system) => Ok(Some(system)),
        Err(error) if error.kind() == ErrorKind::Unsupported => Ok(None),
        Err(error) => Err(error),
    }
}

/// The one input of a folder.
fn input_in(folder: &Path) -> Result<PathBuf> {
    let present: Vec<&str> = INPUT_NAMES.into_iter().filter(|name| folder.join(name).is_file()).collect();
    match present.as_slice() {
        [file] => Ok(folder.join(file)),
        [] => {
            let text = "this folder has no input; put a `0_chain.toml`, a `0_system.toml` or a `0_robot.urdf` in it";
            Err(Error::new(ErrorKind::BadValue, text).in_file(folder))
        }
        [first, second, ..] => {
            let text = format!("this folder has both `{first}` and `{second}`; keep one of them");
            Err(Error::new(ErrorKind::BadValue, text).in_file(folder))
        }
    }
}
