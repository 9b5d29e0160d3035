//! Included models of an SDF. Main type: [`Includes`].

use std::path::{Component, Path, PathBuf};

use super::values::{required_text, text};
use crate::document::{read_xml, shown};
use crate::model::include_budget::IncludeBudget;
use crate::model::urdf::xml::Element;
use crate::{ErrorKind, Result};
use groebot_algebra::limits;

/// The names of the file in a model's folder.
const MODEL: &str = "model.sdf";
const CONFIG: &str = "model.config";

/// The folder and the budget of included files.
pub struct Includes {
    folder: Option<PathBuf>,
    budget: IncludeBudget,
    elements: usize,
    /// The files that include each other, from the main file.
    open: Vec<PathBuf>,
}

impl Includes {
    /// The includes of the SDF `file`.
    pub fn new(file: Option<&Path>) -> Self {
        let folder = file.map(|file| file.parent().unwrap_or(Path::new("")).to_owned());
        let open = file.and_then(|file| file.canonicalize().ok()).into_iter().collect();
        Includes { folder, budget: IncludeBudget::default(), elements: 0, open }
    }

    /// Counts the elements of a file.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for too many.
    pub fn count(&mut self, root: &Element) -> Result<()> {
        self.elements += size(root);
        if self.elements <= limits::XML_ELEMENTS {
            return Ok(());
        }
        let text = format!("and the included files have more than {} elements", limits::XML_ELEMENTS);
        Err(root.error(ErrorKind::BadValue, &text))
    }

    /// The model that an `<include>` names, with the include's name and pose.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for a model on a server, outside of the main file's folder, or merged;
    /// [`ErrorKind::BadValue`] beyond the limits and for a file without exactly one model; [`ErrorKind::Io`] for a missing
    /// file.
    pub fn load(&mut self, include: &Element) -> Result<Element> {
        if include.attribute("merge").is_some_and(super::values::is_true) {
            return Err(
                include.error(ErrorKind::Unsupported, "merges a model, which is not read; include it without `merge`")
            );
        }
        let file = self.find(include)?;
        let root = self.budget.read(include, &file)?;
        self.count(&root)?;
        let mut models = root.children.iter().filter(|child| child.name == "model");
        let (Some(model), None, "sdf") = (models.next(), models.next(), root.name.as_str()) else {
            return Err(root.error(ErrorKind::BadValue, "is included and must be an <sdf> with one <model>"));
        };
        placed(model, include)
    }

    /// Marks the file of an included model as open until [`Includes::close`].
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] if the file is open: it includes itself.
    pub fn open(&mut self, model: &Element) -> Result<()> {
        let Some(file) = &model.file else { return Ok(()) };
        let full = file.canonicalize().unwrap_or_else(|_| file.to_path_buf());
        if self.open.contains(&full) {
            return Err(model.error(ErrorKind::BadValue, "includes itself; remove one of the includes"));
        }
        self.open.push(full);
        Ok(())
    }

    /// Ends [`Includes::open`].
    pub fn close(&mut self, model: &Element) {
        if model.file.is_some() {
            self.open.pop();
        }
    }

    /// The file that the `<uri>` of an include names.
    fn find(&self, include: &Element) -> Result<PathBuf> {
        let uri = required_text(include, "uri")?;
        let refused = |why: &str| Err(include.error(ErrorKind::Unsupported, &format!("names `{}`; {why}", shown(uri))));
        let Some(folder) = &self.folder else {
            return refused("this text has no folder; read the model from its file");
        };
        let name = uri.strip_prefix("model://").or(uri.strip_prefix("file://")).unwrap_or(uri);
        if name.contains("://") {
            return refused("models on servers are not read; give a file in the folder of this file");
        }
        let path = Path::new(name);
        if !path.components().all(|part| matches!(part, Component::Normal(_) | Component::CurDir)) {
            return refused("included files must be inside the folder of this file, by a relative path");
        }
        let own = include.file.as_deref().and_then(Path::parent).map(|own| own.join(path));
        let found = own.into_iter().chain([folder.join(path)]).find(|path| path.exists());
        let Some(found) = found else {
            let text = format!("names `{}`, which is not in the folder of this file", shown(uri));
            return Err(include.error(ErrorKind::Io, &text));
        };
        Ok(if found.is_dir() { found.join(file_in(&found).unwrap_or_else(|| MODEL.to_owned())) } else { found })
    }
}

/// The newest SDF that the `model.config` of a folder names, without folders.
fn file_in(folder: &Path) -> Option<String> {
    let config = read_xml(&folder.join(CONFIG), limits::XML_BYTES).ok()?;
    let root = Element::parse_whole(&config.text).ok()?;
    let version = |sdf: &&Element| -> Option<(u32, u32)> {
        let (major, minor) = sdf.attribute("version")?.trim().split_once('.')?;
        Some((major.parse().ok()?, minor.parse().ok()?))
    };
    let newest = root.children.iter().filter(|child| child.name == "sdf").max_by_key(version)?;
    Path::new(newest.text.trim()).file_name().map(|name| name.to_string_lossy().into_owned())
}

/// The number of an element and those in it.
fn size(element: &Element) -> usize {
    1 + element.children.iter().map(size).sum::<usize>()
}

/// An included model with the name, the pose and the placement frame of its include.
fn placed(model: &Element, include: &Element) -> Result<Element> {
    let mut model = model.clone();
    if let Some(name) = text(include, "name")? {
        model.set("name", name);
    }
    if let Some(frame) = text(include, "placement_frame")? {
        model.set("placement_frame", frame);
    }
    if let Some(pose) = include.child("pose")? {
        model.children.retain(|child| child.name != "pose");
        model.children.push(pose.clone());
    }
    Ok(model)
}
