//! Reading what a derivation starts from: a chain or a system of equations, from a file or a mechanism's folder.

use std::path::{Path, PathBuf};

use super::{System, formulate};
use crate::document::{Document, TEXT_LIMIT, read_text};
use crate::kinematics::Chain;
use crate::{Error, ErrorKind, Result};

/// The names that an input may have in a mechanism's folder.
pub const INPUT_NAMES: [&str; 2] = ["0_chain.toml", "0_system.toml"];

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
    /// The equations.
    pub system: System,
}

impl Source {
    /// Reads a mechanism's folder or an input file. A file with a `[tip]` or `[task]` is a chain, any other a system.
    ///
    /// # Errors
    /// [`ErrorKind::Io`] for what cannot be read; [`ErrorKind::BadValue`] for a folder without exactly one input; as
    /// [`Chain::from_toml`], [`System::from_toml`] and [`mod@formulate`], with file and line.
    pub fn read(path: &Path) -> Result<Source> {
        let file = if path.is_dir() { input_in(path)? } else { path.to_owned() };
        let text = read_text(&file, TEXT_LIMIT)?;
        Source::from_text(&file, text).map_err(|error| error.in_file(&file))
    }

    fn from_text(file: &Path, text: String) -> Result<Source> {
        let is_chain = {
            let document = Document::parse(&text)?;
            let root = document.root();
            root.optional("tip").is_some() || root.optional("task").is_some()
        };
        let path = file.to_owned();
        if !is_chain {
            let system = System::from_toml(&text)?;
            return Ok(Source { path, name: INPUT_NAMES[1], text, chain: None, system });
        }
        let chain = Chain::from_toml(&text)?;
        let system = formulate(&chain)?;
        Ok(Source { path, name: INPUT_NAMES[0], text, chain: Some(chain), system })
    }
}

/// The one input of a folder.
fn input_in(folder: &Path) -> Result<PathBuf> {
    let present: Vec<PathBuf> =
        INPUT_NAMES.iter().map(|name| folder.join(name)).filter(|path| path.is_file()).collect();
    match present.as_slice() {
        [file] => Ok(file.clone()),
        [] => {
            let text = "this folder has no input; put a `0_chain.toml` or a `0_system.toml` in it";
            Err(Error::new(ErrorKind::BadValue, text).in_file(folder))
        }
        _ => {
            let text = "this folder has both `0_chain.toml` and `0_system.toml`; keep one of them";
            Err(Error::new(ErrorKind::BadValue, text).in_file(folder))
        }
    }
}
