//! Included files of an MJCF: `<include file="..."/>` is replaced by the children of that file's root element.

use std::collections::HashSet;
use std::path::{Component, Path, PathBuf};

use crate::document::shown;
use crate::model::include_budget::IncludeBudget;
use crate::model::urdf::xml::Element;
use crate::{ErrorKind, Result};
use groebot_algebra::limits;

/// Replaces the included files in `root`, the content of `file`.
///
/// # Errors
/// [`ErrorKind::Unsupported`] for an include of a text without a file, and for a path outside of the folder above the
/// file's folder; [`ErrorKind::BadValue`] for a file that is included twice, and beyond the limits; those of
/// [`IncludeBudget::read`].
pub fn expand(root: Element, file: Option<&Path>) -> Result<Element> {
    let folder = file.map(|file| file.parent().unwrap_or(Path::new("")).to_owned());
    let mut included = Included { folder, seen: HashSet::new(), budget: IncludeBudget::default(), elements: 0 };
    included.seen.extend(file.and_then(|file| file.canonicalize().ok()));
    included.expand(root, 1)
}

/// The included files so far.
struct Included {
    /// The folder of the main file.
    folder: Option<PathBuf>,
    seen: HashSet<PathBuf>,
    budget: IncludeBudget,
    elements: usize,
}

impl Included {
    fn expand(&mut self, mut element: Element, depth: usize) -> Result<Element> {
        self.elements += 1;
        if self.elements > limits::XML_ELEMENTS {
            let text = format!("is one element too many; at most {} are read", limits::XML_ELEMENTS);
            return Err(element.error(ErrorKind::BadValue, &text));
        }
        if depth > limits::XML_DEPTH {
            let text = format!("is nested deeper than {} elements", limits::XML_DEPTH);
            return Err(element.error(ErrorKind::Syntax, &text));
        }
        let mut children = Vec::with_capacity(element.children.len());
        for child in std::mem::take(&mut element.children) {
            if child.name == "include" {
                // The children of an included file are in the place of the include.
                children.append(&mut self.load(&child, depth)?);
            } else {
                children.push(self.expand(child, depth + 1)?);
            }
        }
        element.children = children;
        Ok(element)
    }

    /// The expanded children of the file that `include` names.
    fn load(&mut self, include: &Element, depth: usize) -> Result<Vec<Element>> {
        let file = self.find(include)?;
        let full = file.canonicalize().unwrap_or_else(|_| file.clone());
        if !self.seen.insert(full) {
            let text = format!("includes `{}` a second time; a file can be included once", shown_path(&file));
            return Err(include.error(ErrorKind::BadValue, &text));
        }
        let root = self.budget.read(include, &file)?;
        Ok(self.expand(root, depth)?.children)
    }

    /// The file that `include` names: beside the main file, else beside the file with the include.
    fn find(&self, include: &Element) -> Result<PathBuf> {
        let name = include.required("file")?;
        let Some(folder) = &self.folder else {
            let text = format!("names `{}`, but this text has no folder; read the model from its file", shown(name));
            return Err(include.error(ErrorKind::Unsupported, &text));
        };
        let path = Path::new(name);
        if !stays_near(path) {
            let text = format!(
                "names `{}`; included files must be inside the folder above the model's folder, by a relative path",
                shown(name)
            );
            return Err(include.error(ErrorKind::Unsupported, &text));
        }
        let beside = include.file.as_deref().and_then(Path::parent).map(|own| own.join(path));
        let main = folder.join(path);
        match beside {
            Some(beside) if !main.is_file() && beside.is_file() && self.contains(&beside) => Ok(beside),
            _ => Ok(main),
        }
    }

    /// Whether a file is inside the folder above the main file's folder.
    fn contains(&self, file: &Path) -> bool {
        let Some(folder) = &self.folder else { return false };
        let above = folder.join("..").canonicalize();
        matches!((above, file.canonicalize()), (Ok(above), Ok(file)) if file.starts_with(&above))
    }
}

/// Whether a path is relative and leaves its folder by at most one level.
fn stays_near(path: &Path) -> bool {
    let mut level = 0_i32;
    path.components().all(|part| {
        match part {
            Component::Normal(_) => level += 1,
            Component::ParentDir => level -= 1,
            Component::CurDir => {}
            Component::RootDir | Component::Prefix(_) => return false,
        }
        level >= -1
    })
}

fn shown_path(path: &Path) -> String {
    shown(&path.to_string_lossy()).to_string()
}
