//! Search of packages by their names in folders. Main function: [`inside`].

use std::fs;
use std::path::{Path, PathBuf};

use quick_xml::Reader;
use quick_xml::events::Event;

/// Levels of folders that are searched for packages.
const LEVELS: usize = 4;
/// Maximum number of folders that are searched for a package.
const FOLDERS: usize = 20_000;
/// Maximum size of a `package.xml` in bytes.
const MANIFEST: u64 = 100_000;

/// The package `name` in `folder` or at most four levels below.
pub fn inside(folder: &Path, name: &str) -> Option<PathBuf> {
    if !is_package_name(name) {
        return None;
    }
    let direct = folder.join(name);
    if direct.is_dir() {
        return Some(direct);
    }
    search(folder, name, LEVELS, &mut { FOLDERS })
}

fn search(folder: &Path, name: &str, levels: usize, left: &mut usize) -> Option<PathBuf> {
    *left = left.checked_sub(1)?;
    let manifest = folder.join("package.xml");
    if manifest.is_file() {
        return (package_name(&manifest).as_deref() == Some(name)).then(|| folder.to_owned());
    }
    let levels = levels.checked_sub(1)?;
    let mut below: Vec<PathBuf> = fs::read_dir(folder).ok()?.flatten().map(|entry| entry.path()).collect();
    below.sort();
    below.into_iter().filter(|path| path.is_dir()).find_map(|path| search(&path, name, levels, left))
}

/// Whether `name` is a single name of a folder.
pub fn is_package_name(name: &str) -> bool {
    !name.is_empty() && ![".", ".."].contains(&name) && !name.contains(['/', '\\', '\0', ':'])
}

/// The name in a `package.xml`.
pub fn package_name(manifest: &Path) -> Option<String> {
    if fs::metadata(manifest).ok()?.len() > MANIFEST {
        return None;
    }
    let text = fs::read_to_string(manifest).ok()?;
    let mut reader = Reader::from_str(&text);
    let mut in_name = false;
    loop {
        match reader.read_event().ok()? {
            Event::Start(start) => in_name = start.name().as_ref() == b"name",
            Event::Text(text) if in_name => return Some(text.decode().ok()?.trim().to_owned()),
            Event::Eof => return None,
            _ => {}
        }
    }
}
