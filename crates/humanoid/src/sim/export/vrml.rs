//! Reader of the VRML nodes in RH0 Fig. 5-4: [`Scene::from_vrml`].
//!
//! | node | fields |
//! | --- | --- |
//! | `Transform` | `translation`, `rotation`, `scale`, `children` |
//! | `Shape` | `appearance`, `geometry` |
//! | `Appearance` | `material` |
//! | `Material` | `ambientIntensity`, `diffuseColor`, `emissiveColor`, `specularColor` |
//! | `Box` | `size` |
//!
//! Each may have a name by `DEF`. Children are in brackets; a single child may be without them, as in the figure.

use nalgebra::{Unit, UnitQuaternion, Vector3};

use super::{Body, Material, Node, Part, Scene};
use crate::{Error, ErrorKind, Result};
use groebot_robot::document::{TEXT_LIMIT, one_among, shown};
use groebot_robot::model::Solid;
use groebot_robot::spatial::Pose;

/// The greatest depth of nested nodes.
const DEEPEST: usize = groebot_algebra::limits::VRML_DEPTH;
/// The first line of a complete file; the figure is a fragment.
const HEAD: &str = "#VRML V2.0 utf8";
/// Characters that are always words of their own.
const BRACKETS: [char; 4] = ['{', '}', '[', ']'];

impl Scene {
    /// Reads a scene from VRML97 with the nodes of RH0 Fig. 5-4. Names of shapes, materials and boxes are not kept; a
    /// node without a name gets that of its type.
    ///
    /// # Errors
    /// With the line: [`ErrorKind::Unsupported`] for another node, another version of VRML, or nodes deeper than 64;
    /// [`ErrorKind::UnknownKey`] and [`ErrorKind::DuplicateName`] for a field; [`ErrorKind::Syntax`] for unexpected
    /// words; [`ErrorKind::BadValue`] for a number that is out of its range, and for more than a megabyte.
    pub fn from_vrml(text: &str) -> Result<Self> {
        if text.len() as u64 > TEXT_LIMIT {
            let text = format!("the text is too long; at most {TEXT_LIMIT} bytes are read");
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let first = text.lines().next().unwrap_or("").trim_end();
        if first.starts_with("#VRML") && first != HEAD {
            let text = format!("the file begins with `{}`; only `{HEAD}` is read", shown(first));
            return Err(Error::new(ErrorKind::Unsupported, text).at_line(1));
        }
        let mut reader = Reader { words: words(text), next: 0, nodes: Vec::new() };
        while reader.next < reader.words.len() {
            reader.child(None, 0)?;
        }
        if reader.nodes.is_empty() {
            return Err(Error::new(ErrorKind::Syntax, "there is no node; give a Transform"));
        }
        Ok(Scene { title: reader.nodes[0].name.clone(), nodes: reader.nodes, ..Scene::default() })
    }
}

/// The words with their lines. Comments go from `#` to the end of a line; commas are blanks.
fn words(text: &str) -> Vec<(usize, &str)> {
    let mut words = Vec::new();
    for (place, line) in text.lines().enumerate() {
        let code = line.split('#').next().unwrap_or("");
        for piece in code.split(|letter: char| letter.is_whitespace() || letter == ',') {
            let mut rest = piece;
            while let Some(at) = rest.find(BRACKETS) {
                words.extend([(place + 1, &rest[..at]), (place + 1, &rest[at..=at])]);
                rest = &rest[at + 1..];
            }
            words.push((place + 1, rest));
        }
    }
    words.retain(|(_, word)| !word.is_empty());
    words
}

/// The words, the reading position, and the nodes found.
struct Reader<'t> {
    words: Vec<(usize, &'t str)>,
    next: usize,
    nodes: Vec<Node>,
}

impl<'t> Reader<'t> {
    fn word(&mut self, wanted: &str) -> Result<&'t str> {
        let word = self.words.get(self.next).map(|(_, word)| *word);
        self.next += 1;
        word.ok_or_else(|| self.error(ErrorKind::Syntax, format!("the text ends here; {wanted} is missing")))
    }

    /// An error at the last word read.
    fn error(&self, kind: ErrorKind, text: String) -> Error {
        let last = self.words.len().saturating_sub(1).min(self.next.saturating_sub(1));
        Error::new(kind, text).at_line(self.words.get(last).map_or(1, |(line, _)| *line))
    }

    /// Reads the head of a node up to its bracket: its type, and its name or else its type again.
    fn head(&mut self, allowed: &[&str]) -> Result<[&'t str; 2]> {
        let (mut kind, mut name) = (self.word("a node")?, None);
        if kind == "DEF" {
            name = Some(self.word("a name")?).filter(|name| !name.contains(BRACKETS));
            if name.is_none() {
                return Err(self.error(ErrorKind::Syntax, "DEF is followed by a bracket; give a name".to_owned()));
            }
            kind = self.word("a node")?;
        }
        if !allowed.contains(&kind) {
            let text = format!(
                "`{}` is not supported here; only the nodes of RH0 Fig. 5-4 are{}",
                shown(kind),
                one_among(kind, allowed)
            );
            return Err(self.error(ErrorKind::Unsupported, text));
        }
        match self.word("`{`")? {
            "{" => Ok([kind, name.unwrap_or(kind)]),
            other => {
                let text = format!("`{}` follows {kind}; give `{{`", shown(other));
                Err(self.error(ErrorKind::Syntax, text))
            }
        }
    }

    /// The fields of a node up to its end, each read by `read`.
    fn fields(
        &mut self,
        kind: &str,
        allowed: &[&str],
        mut read: impl FnMut(&mut Self, &'t str) -> Result<()>,
    ) -> Result<()> {
        let mut seen = Vec::new();
        loop {
            let field = self.word("`}`")?;
            if field == "}" {
                return Ok(());
            }
            if !allowed.contains(&field) {
                let text = format!("{kind} has no field `{}` here{}", shown(field), one_among(field, allowed));
                return Err(self.error(ErrorKind::UnknownKey, text));
            }
            if seen.contains(&field) {
                return Err(self.error(ErrorKind::DuplicateName, format!("`{field}` is given twice; give it once")));
            }
            seen.push(field);
            read(self, field)?;
        }
    }

    /// Reads numbers, each of which must satisfy `good`.
    fn numbers<const N: usize>(&mut self, good: fn(f64) -> bool, wanted: &str) -> Result<[f64; N]> {
        let mut numbers = [0.0; N];
        for number in &mut numbers {
            let word = self.word("a number")?;
            let read = word.parse().map_err(|_| {
                let text = format!("`{}` is not a number; give {N} here", shown(word));
                self.error(ErrorKind::Syntax, text)
            })?;
            if !f64::is_finite(read) || !good(read) {
                return Err(
                    self.error(ErrorKind::BadValue, format!("`{}` is not allowed here; give {wanted}", shown(word)))
                );
            }
            *number = read;
        }
        Ok(numbers)
    }

    fn any<const N: usize>(&mut self) -> Result<[f64; N]> {
        self.numbers(|_| true, "a finite number")
    }

    fn positive(&mut self) -> Result<[f64; 3]> {
        self.numbers(|x| x > 0.0, "a positive number")
    }

    fn share<const N: usize>(&mut self) -> Result<[f64; N]> {
        self.numbers(|x| (0.0..=1.0).contains(&x), "a number from 0 to 1")
    }

    /// Reads a node with a parent or none.
    fn child(&mut self, parent: Option<usize>, depth: usize) -> Result<()> {
        match self.head(&["Transform", "Shape"])? {
            ["Transform", name] if depth < DEEPEST => self.transform(name, parent, depth),
            ["Transform", _] => {
                Err(self.error(ErrorKind::Unsupported, format!("nodes are nested deeper than {DEEPEST}")))
            }
            [_, name] => self.shape(name, parent),
        }
    }

    fn children(&mut self, parent: usize, depth: usize) -> Result<()> {
        let peek = |reader: &Self| reader.words.get(reader.next).map(|(_, word)| *word);
        if peek(self) != Some("[") {
            return self.child(Some(parent), depth);
        }
        self.next += 1;
        while peek(self) != Some("]") {
            self.child(Some(parent), depth)?;
        }
        self.next += 1;
        Ok(())
    }

    fn transform(&mut self, name: &str, parent: Option<usize>, depth: usize) -> Result<()> {
        let place = self.nodes.len();
        self.nodes.push(Node::at(name, parent, Pose::identity()));
        self.fields("Transform", &["translation", "rotation", "scale", "children"], |reader, field| {
            match field {
                "translation" => reader.nodes[place].pose.translation = reader.any::<3>()?.into(),
                "rotation" => reader.nodes[place].pose.rotation = reader.rotation()?,
                "scale" => reader.nodes[place].scale = reader.positive()?,
                _ => reader.children(place, depth + 1)?,
            }
            Ok(())
        })
    }

    fn rotation(&mut self) -> Result<UnitQuaternion<f64>> {
        let [x, y, z, angle] = self.any()?;
        let axis = Vector3::new(x, y, z);
        // Divided by its greatest component first: the square of a large number would be infinite.
        match Unit::try_new(axis / axis.amax(), 0.0).filter(|axis| axis.iter().all(|x| x.is_finite())) {
            Some(axis) => Ok(UnitQuaternion::from_axis_angle(&axis, angle)),
            None => {
                let text = "the axis of a rotation has no direction; give x, y, z and an angle".to_owned();
                Err(self.error(ErrorKind::BadValue, text))
            }
        }
    }

    fn shape(&mut self, name: &str, parent: Option<usize>) -> Result<()> {
        // Without a material there is no shading: white.
        let mut material = Material { diffuse: [0.0; 3], emissive: [1.0; 3], ..Material::default() };
        let mut body = None;
        self.fields("Shape", &["appearance", "geometry"], |reader, field| {
            if field == "appearance" {
                reader.head(&["Appearance"])?;
                return reader.fields("Appearance", &["material"], |reader, _| {
                    material = reader.material()?;
                    Ok(())
                });
            }
            reader.head(&["Box"])?;
            let mut size = [2.0; 3];
            reader.fields("Box", &["size"], |reader, _| {
                size = reader.positive()?;
                Ok(())
            })?;
            body = Some(Body::Solid(Solid::Box { size }));
            Ok(())
        })?;
        let place = parent.unwrap_or_else(|| {
            self.nodes.push(Node::at(name, None, Pose::identity()));
            self.nodes.len() - 1
        });
        self.nodes[place].parts.extend(body.map(|body| Part { pose: Pose::identity(), body, material }));
        Ok(())
    }

    fn material(&mut self) -> Result<Material> {
        let mut own = Material::default();
        self.head(&["Material"])?;
        let fields = ["ambientIntensity", "diffuseColor", "emissiveColor", "specularColor"];
        self.fields("Material", &fields, |reader, field| {
            match field {
                "ambientIntensity" => [own.ambient] = reader.share()?,
                "diffuseColor" => own.diffuse = reader.share()?,
                "emissiveColor" => own.emissive = reader.share()?,
                _ => own.specular = reader.share()?,
            }
            Ok(())
        })?;
        Ok(own)
    }
}
