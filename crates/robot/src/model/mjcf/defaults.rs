//! Default classes of an MJCF. Main types: [`Classes`], [`Styled`].

use std::collections::HashMap;
use std::ops::RangeInclusive;

use super::compiler;
use crate::document::shown;
use crate::model::some_among;
use crate::model::urdf::xml::Element;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::BigRational;

/// The index of the class `main`.
pub const MAIN: usize = 0;

/// The tree of default classes.
pub struct Classes<'e> {
    classes: Vec<Class<'e>>,
    places: HashMap<&'e str, usize>,
}

struct Class<'e> {
    parent: Option<usize>,
    /// The elements with default attributes, in the order of the file.
    elements: Vec<&'e Element>,
}

impl<'e> Classes<'e> {
    /// Reads all `<default>` elements of the model. Those without a class at the top level are the class `main`.
    ///
    /// # Errors
    /// [`ErrorKind::MissingKey`] for a nested class without a name; [`ErrorKind::DuplicateName`] for two classes of one
    /// name.
    pub fn read(root: &'e Element) -> Result<Self> {
        let main = Class { parent: None, elements: Vec::new() };
        let mut classes = Classes { classes: vec![main], places: HashMap::from([("main", MAIN)]) };
        for element in root.children.iter().filter(|child| child.name == "default") {
            if let Some(name) = element.attribute("class") {
                // Older versions of MuJoCo allow another name of the class `main`.
                classes.places.insert(name, MAIN);
            }
            classes.fill(element, MAIN)?;
        }
        Ok(classes)
    }

    fn fill(&mut self, element: &'e Element, class: usize) -> Result<()> {
        for child in &element.children {
            if child.name != "default" {
                self.classes[class].elements.push(child);
                continue;
            }
            let name = child.required("class")?;
            let place = self.classes.len();
            if self.places.insert(name, place).is_some() {
                let text = format!("has the class `{}` a second time; give each class one name", shown(name));
                return Err(child.error(ErrorKind::DuplicateName, &text));
            }
            self.classes.push(Class { parent: Some(class), elements: Vec::new() });
            self.fill(child, place)?;
        }
        Ok(())
    }

    /// The class that the attribute `key` of `element` names; `None` without the attribute.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] with the nearest name.
    pub fn named(&self, element: &Element, key: &str) -> Result<Option<usize>> {
        let Some(name) = element.attribute(key) else { return Ok(None) };
        self.places.get(name).copied().map(Some).ok_or_else(|| {
            let names = some_among(name, self.places.keys().copied());
            let text = format!("has `{key}` = `{}`, which is not a class{names}", shown(name));
            element.error(ErrorKind::UnknownName, &text)
        })
    }

    /// An element with the defaults of its own class, or else of the class `inherited`. `kinds` are the names of the
    /// elements with its defaults.
    ///
    /// # Errors
    /// Those of [`Classes::named`].
    pub fn styled(&self, element: &'e Element, inherited: usize, kinds: &[&str]) -> Result<Styled<'e>> {
        let mut class = Some(self.named(element, "class")?.unwrap_or(inherited));
        let mut defaults = Vec::new();
        while let Some(place) = class {
            let own = self.classes[place].elements.iter().rev();
            defaults.extend(own.filter(|default| kinds.contains(&default.name.as_str())));
            class = self.classes[place].parent;
        }
        Ok(Styled { own: element, defaults })
    }
}

/// An element with its defaults.
pub struct Styled<'e> {
    /// The element.
    pub own: &'e Element,
    /// The elements with its defaults, the most specific class first.
    defaults: Vec<&'e Element>,
}

impl<'e> Styled<'e> {
    /// An element without defaults.
    pub fn plain(own: &'e Element) -> Self {
        Styled { own, defaults: Vec::new() }
    }

    /// The element that has the value of the attribute `name`: itself, or that of a class.
    pub fn holder(&self, name: &str) -> Option<&'e Element> {
        self.holder_of(&[name])
    }

    /// The element that has one of the attributes `names`.
    pub fn holder_of(&self, names: &[&str]) -> Option<&'e Element> {
        let has = |element: &&&Element| names.iter().any(|name| element.attribute(name).is_some());
        std::iter::once(&self.own).chain(&self.defaults).find(has).copied()
    }

    /// The text of an attribute.
    pub fn attribute(&self, name: &str) -> Option<&'e str> {
        self.holder(name).and_then(|holder| holder.attribute(name))
    }

    /// The exact numbers of an attribute.
    ///
    /// # Errors
    /// Those of [`Element::numbers`].
    pub fn numbers<const N: usize>(&self, name: &str) -> Result<Option<[BigRational; N]>> {
        self.holder(name).map_or(Ok(None), |holder| holder.numbers(name))
    }

    /// The exact numbers of an attribute, as many as are allowed.
    ///
    /// # Errors
    /// Those of [`Element::list`].
    pub fn list(&self, name: &str, allowed: RangeInclusive<usize>) -> Result<Option<Vec<BigRational>>> {
        self.holder(name).map_or(Ok(None), |holder| holder.list(name, allowed))
    }

    /// The doubles of an attribute.
    ///
    /// # Errors
    /// Those of [`Element::floats`].
    pub fn floats<const N: usize>(&self, name: &str) -> Result<Option<[f64; N]>> {
        self.holder(name).map_or(Ok(None), |holder| holder.floats(name))
    }

    /// The double of an attribute.
    ///
    /// # Errors
    /// Those of [`Element::float`].
    pub fn float(&self, name: &str) -> Result<Option<f64>> {
        self.holder(name).map_or(Ok(None), |holder| holder.float(name))
    }

    /// The word of an attribute with a few allowed words.
    ///
    /// # Errors
    /// Those of [`compiler::choice`].
    pub fn choice(&self, name: &str, allowed: &[&str]) -> Result<Option<&'e str>> {
        self.holder(name).map_or(Ok(None), |holder| compiler::choice(holder, name, allowed))
    }

    /// An error about the element.
    pub fn error(&self, kind: ErrorKind, message: &str) -> Error {
        self.own.error(kind, message)
    }
}
