//! The content of a folder on disk. Main type: [`Stored`].

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use super::names::{CODE, is_printed_solver, is_written_name};
use crate::derive::report::stages::{MARK, PAGE};
use crate::{Error, ErrorKind, Result};
use groebot_robot::document::read_bytes;

/// The largest file that is read, in bytes.
const LIMIT: u64 = groebot_algebra::limits::STAGE_BYTES;

/// The entries of a folder: files that a check reads, with their content, and the names of the others.
#[derive(Clone, Debug, PartialEq)]
pub struct Stored {
    /// The path of the folder.
    pub folder: PathBuf,
    /// Files that groebot writes or may have written, with their bytes.
    pub files: BTreeMap<String, Vec<u8>>,
    /// All other entries: folders, and files with other names.
    pub others: BTreeSet<String>,
}

impl Stored {
    /// Reads a folder. Files with names that groebot never gives are not opened. Entries that are not regular files are not opened either.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] if the path is not a folder. [`ErrorKind::Io`] if a file cannot be read or is larger than 256 MB.
    pub fn read(folder: &Path) -> Result<Self> {
        if !folder.is_dir() {
            let text = "this is not a folder; give a folder that `groebot derive` wrote";
            return Err(Error::new(ErrorKind::BadValue, text).in_file(folder));
        }
        let io = |error: std::io::Error| Error::io(folder, &error);
        let mut stored = Stored { folder: folder.to_owned(), files: BTreeMap::new(), others: BTreeSet::new() };
        for entry in fs::read_dir(folder).map_err(io)? {
            let path = entry.map_err(io)?.path();
            let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
            if may_be_ours(&name) && path.is_file() {
                stored.files.insert(name, read_bytes(&path, LIMIT)?);
            } else {
                stored.others.insert(name);
            }
        }
        Ok(stored)
    }

    /// The bytes of a file.
    pub fn get(&self, name: &str) -> Option<&[u8]> {
        self.files.get(name).map(Vec::as_slice)
    }

    /// The files that a derivation has written, recognised by their names or their content.
    pub fn written(&self) -> impl Iterator<Item = &str> {
        let is_written = |(name, bytes): &(&String, &Vec<u8>)| {
            is_written_name(name) || is_printed_solver(bytes) || name.as_str() == PAGE && has_mark(bytes)
        };
        self.files.iter().filter(is_written).map(|(name, _)| name.as_str())
    }
}

/// Whether a file with this name is opened.
fn may_be_ours(name: &str) -> bool {
    let end = name.rsplit_once('.').map(|(_, end)| end);
    is_written_name(name) || name == PAGE || end.is_some_and(|end| CODE.contains(&end))
}

/// Whether a page has the mark of pages that groebot writes.
pub(super) fn has_mark(bytes: &[u8]) -> bool {
    String::from_utf8_lossy(bytes).contains(MARK)
}
