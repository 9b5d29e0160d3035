//! Settings of an MJCF's `<compiler>` elements. Main type: [`Compiler`].

use num_traits::ToPrimitive;

use crate::document::{one_among, shown};
use crate::model::urdf::xml::Element;
use crate::{ErrorKind, Result};

/// Source of the masses of bodies.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MassSource {
    /// `<inertial>` only.
    Inertial,
    /// `<inertial>`, and the geoms of a body without it.
    #[default]
    Auto,
    /// The geoms only.
    Geoms,
}

/// The settings that influence links and joints.
#[derive(Clone, Debug)]
pub struct Compiler {
    /// Whether angles are in degrees, the default.
    pub degrees: bool,
    /// The axes of `euler`, and whether each is an axis of the moving frame.
    pub euler: [(usize, bool); 3],
    /// Whether a range limits a joint without `limited`.
    pub auto_limits: bool,
    /// The source of masses.
    pub masses: MassSource,
    /// The groups of the geoms that have mass.
    pub groups: [f64; 2],
    /// The folder of meshes, relative to the model's folder.
    pub mesh_folder: String,
    /// Whether folders in the names of mesh files are ignored.
    pub strips: bool,
    /// The mass of the whole model, if the masses are scaled \[kg\].
    pub total_mass: Option<f64>,
    /// The smallest mass of a body \[kg\].
    pub least_mass: f64,
    /// The smallest principal moment of a body \[kg m^2\].
    pub least_inertia: f64,
    /// Whether principal moments that are physically impossible are replaced by their mean.
    pub balances: bool,
}

impl Compiler {
    /// Reads all `<compiler>` elements of the model; a later one overrides an earlier one.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a value that is not allowed; [`ErrorKind::Unsupported`] for global coordinates.
    pub fn read(root: &Element) -> Result<Compiler> {
        let mut compiler = Compiler {
            degrees: true,
            euler: [(0, true), (1, true), (2, true)],
            auto_limits: true,
            masses: MassSource::Auto,
            groups: [0.0, 5.0],
            mesh_folder: String::new(),
            strips: false,
            total_mass: None,
            least_mass: 0.0,
            least_inertia: 0.0,
            balances: false,
        };
        for element in root.children.iter().filter(|child| child.name == "compiler") {
            compiler.update(element)?;
        }
        Ok(compiler)
    }

    fn update(&mut self, element: &Element) -> Result<()> {
        if let Some(word) = choice(element, "coordinate", &["local", "global"])?
            && word == "global"
        {
            let text =
                "has coordinate=\"global\", which MuJoCo no longer supports; load and save the model in MuJoCo 2.3.3";
            return Err(element.error(ErrorKind::Unsupported, text));
        }
        if let Some(word) = choice(element, "angle", &["degree", "radian"])? {
            self.degrees = word == "degree";
        }
        if let Some(sequence) = element.attribute("eulerseq") {
            self.euler = euler_sequence(element, sequence)?;
        }
        if let Some(word) = choice(element, "inertiafromgeom", &["false", "true", "auto"])? {
            self.masses = match word {
                "false" => MassSource::Inertial,
                "true" => MassSource::Geoms,
                _ => MassSource::Auto,
            };
        }
        self.groups = element.floats("inertiagrouprange")?.unwrap_or(self.groups);
        for folder in ["assetdir", "meshdir"] {
            if let Some(folder) = element.attribute(folder) {
                folder.clone_into(&mut self.mesh_folder);
            }
        }
        let switch = |name: &str, own: bool| Ok(flag(element, name)?.unwrap_or(own));
        self.auto_limits = switch("autolimits", self.auto_limits)?;
        self.strips = switch("strippath", self.strips)?;
        self.balances = switch("balanceinertia", self.balances)?;
        self.least_mass = element.float("boundmass")?.unwrap_or(self.least_mass);
        self.least_inertia = element.float("boundinertia")?.unwrap_or(self.least_inertia);
        self.total_mass = element.float("settotalmass")?.filter(|mass| *mass > 0.0).or(self.total_mass);
        Ok(())
    }

    /// Radians of an angle of the model.
    pub fn radians(&self, angle: f64) -> f64 {
        if self.degrees { angle.to_radians() } else { angle }
    }

    /// Whether a geom of this group has mass.
    pub fn weighs(&self, group: f64) -> bool {
        (self.groups[0]..=self.groups[1]).contains(&group)
    }
}

/// The value of an attribute with a few allowed words.
///
/// # Errors
/// [`ErrorKind::BadValue`] for another word.
pub fn choice<'e>(element: &'e Element, name: &str, allowed: &[&str]) -> Result<Option<&'e str>> {
    let Some(text) = element.attribute(name).map(str::trim) else { return Ok(None) };
    if allowed.contains(&text) {
        return Ok(Some(text));
    }
    let text = format!("has `{name}` = `{}`{}", shown(text), one_among(text, allowed));
    Err(element.error(ErrorKind::BadValue, &text))
}

/// The value of an attribute that is true or false.
///
/// # Errors
/// Those of [`choice`].
pub fn flag(element: &Element, name: &str) -> Result<Option<bool>> {
    Ok(choice(element, name, &["true", "false"])?.map(|word| word == "true"))
}

/// The axes of an `eulerseq`: lower case for the moving frame, upper case for the fixed one.
fn euler_sequence(element: &Element, sequence: &str) -> Result<[(usize, bool); 3]> {
    let axis = |letter: char| {
        let index = "xyz".find(letter.to_ascii_lowercase())?;
        Some((index, letter.is_ascii_lowercase()))
    };
    let axes: Option<Vec<_>> = sequence.chars().take(4).map(axis).collect();
    axes.and_then(|axes| axes.try_into().ok()).ok_or_else(|| {
        let text = format!("has `eulerseq` = `{}`; give three of x, y, z, X, Y, Z", shown(sequence));
        element.error(ErrorKind::BadValue, &text)
    })
}

/// The nearest double of an exact number.
pub fn double(exact: &groebot_algebra::number::BigRational) -> f64 {
    exact.to_f64().unwrap_or(f64::NAN)
}
