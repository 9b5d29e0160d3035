//! Geoms and meshes of an MJCF.

use std::collections::HashMap;
use std::path::Path;

use super::compiler::{Compiler, double, flag};
use super::defaults::{Classes, MAIN, Styled};
use super::frame::{from_z, placement};
use super::inertia::{MeshVolume, Uniform, of_mesh};
use crate::document::shown;
use crate::model::urdf::xml::Element;
use crate::model::{Meshes, Shape, Solid, some_among};
use crate::spatial::exact::{Placement, vector};
use crate::spatial::{Inertia, Pose, rotation};
use crate::{ErrorKind, Result};
use groebot_algebra::number::BigRational;

/// MuJoCo's density of geoms \[kg/m^3\].
const DENSITY: f64 = 1000.0;
/// The types of geoms.
const TYPES: [&str; 9] = ["sphere", "capsule", "cylinder", "box", "ellipsoid", "mesh", "plane", "hfield", "sdf"];

/// The meshes and colours of an MJCF's `<asset>`.
pub struct Assets<'e> {
    meshes: HashMap<String, Styled<'e>>,
    colours: HashMap<&'e str, [f64; 4]>,
}

impl<'e> Assets<'e> {
    /// Reads all `<asset>` elements of the model.
    ///
    /// # Errors
    /// Those of [`Classes::styled`] and [`Element::floats`].
    pub fn read(root: &'e Element, classes: &Classes<'e>) -> Result<Self> {
        let mut assets = Assets { meshes: HashMap::new(), colours: HashMap::new() };
        let sections = root.children.iter().filter(|child| child.name == "asset");
        for asset in sections.flat_map(|section| &section.children) {
            match asset.name.as_str() {
                "mesh" => {
                    let mesh = classes.styled(asset, MAIN, &["mesh"])?;
                    let file = mesh.attribute("file").unwrap_or("");
                    let stem = || Path::new(file).file_stem().map(|stem| stem.to_string_lossy().into_owned());
                    let name = asset.attribute("name").map(str::to_owned).or_else(stem).unwrap_or_default();
                    assets.meshes.insert(name, mesh);
                }
                "material" => {
                    let material = classes.styled(asset, MAIN, &["material"])?;
                    if let (Some(name), Some(colour)) = (asset.attribute("name"), material.floats("rgba")?) {
                        assets.colours.insert(name, colour);
                    }
                }
                _ => {}
            }
        }
        Ok(assets)
    }

    /// The mesh that a geom names.
    fn mesh(&self, geom: &Styled<'e>, name: &str) -> Result<&Styled<'e>> {
        self.meshes.get(name).ok_or_else(|| {
            let names = some_among(name, self.meshes.keys().map(String::as_str));
            geom.error(
                ErrorKind::UnknownName,
                &format!("names the mesh `{}`, which is not an asset{names}", shown(name)),
            )
        })
    }
}

/// A geom in the frame of its body.
pub struct Geom {
    /// The shape; `None` for a type that links do not have.
    pub shape: Option<Shape>,
    /// Whether it collides.
    pub collides: bool,
    /// Its mass; `None` without.
    pub inertia: Option<Inertia>,
    /// What is ignored.
    pub note: Option<String>,
}

/// The settings for reading geoms.
pub struct Context<'r, 'e> {
    pub compiler: &'r Compiler,
    pub assets: &'r Assets<'e>,
    pub files: &'r Meshes,
    /// Whether masses of geoms are needed.
    pub weighs: bool,
}

/// Reads a `<geom>`. `outer` is the frame of its `<frame>` in the body.
///
/// # Errors
/// [`ErrorKind::BadValue`] for wrong types, sizes and numbers; [`ErrorKind::UnknownName`] for an unknown mesh.
pub fn read<'e>(geom: &Styled<'e>, outer: &Placement, context: &Context<'_, 'e>) -> Result<Geom> {
    let kind = geom.choice("type", &TYPES)?.unwrap_or("sphere");
    let mut read = Geom { shape: None, collides: collides(geom)?, inertia: None, note: None };
    let named = || geom.own.attribute("name").map(|name| format!(" `{}`", shown(name))).unwrap_or_default();
    let ignored = |what: &str| Some(format!("line {}: geom{}: {what}", geom.own.line, named()));
    if ["plane", "hfield", "sdf"].contains(&kind) {
        read.note = ignored(&format!("a {kind} is not a shape of a link; it is ignored"));
        return Ok(read);
    }
    let (own, half) = own_frame(geom, context.compiler)?;
    let pose = outer.then(&own).pose();
    if let Some(name) = geom.attribute("mesh").filter(|_| kind != "mesh") {
        // MuJoCo fits the primitive to the mesh; the mesh itself is shown.
        read.note = ignored(&format!("the mass of a {kind} that is fitted to the mesh `{}` is ignored", shown(name)));
        let solid = mesh_solid(context.assets.mesh(geom, name)?, context.compiler)?;
        read.shape = solid.map(|solid| placed(solid, &pose));
    } else if kind == "mesh" {
        read_mesh(geom, &pose, context, &mut read)?;
    } else {
        let uniform = uniform(geom, kind, half)?;
        if context.weighs {
            let mass = weight(geom, uniform.volume(), context.compiler)?;
            read.inertia = (mass > 0.0).then(|| uniform.inertia(mass).placed(&pose));
        }
        if flag(geom.own, "shellinertia")? == Some(true) {
            read.note = ignored("its inertia is that of a solid, not of a shell");
        }
        read.shape = solid(uniform).map(|solid| placed(solid, &pose));
        if read.shape.is_none() {
            read.note = ignored("an ellipsoid is not a shape of a link; only its mass is taken");
        }
    }
    if let Some(shape) = &mut read.shape {
        shape.name = geom.own.attribute("name").map(str::to_owned);
        let of_material = geom.attribute("material").and_then(|name| context.assets.colours.get(name));
        shape.colour = geom.floats("rgba")?.or(of_material.copied());
    }
    Ok(read)
}

/// Whether a geom takes part in collisions: one of its masks is not zero.
fn collides(geom: &Styled<'_>) -> Result<bool> {
    let mask = |name: &str| Ok::<f64, crate::Error>(geom.float(name)?.unwrap_or(1.0));
    Ok(mask("contype")? != 0.0 || mask("conaffinity")? != 0.0)
}

/// The frame of a geom in its parent, and half its length if `fromto` gives it.
fn own_frame(geom: &Styled<'_>, compiler: &Compiler) -> Result<(Placement, Option<f64>)> {
    let Some(holder) = geom.holder("fromto") else { return Ok((placement(geom, compiler)?, None)) };
    let Some([a, b, c, d, e, f]) = holder.numbers("fromto")? else { return Ok((Placement::identity(), None)) };
    let (start, end) = ([a, b, c], [d, e, f]);
    let half = BigRational::new(1.into(), 2.into());
    let along = vector::sub(&start, &end);
    let Some(turned) = from_z(&along) else {
        return Err(holder.error(ErrorKind::BadValue, "has `fromto` with two equal points; give two points"));
    };
    let origin = vector::scale(&vector::add(&start, &end), &half);
    Ok((Placement { origin, ..turned }, Some(vector::length(&along) / 2.0)))
}

/// The solid of a primitive geom, by `size` and by half its length if `fromto` gives it.
fn uniform(geom: &Styled<'_>, kind: &str, half: Option<f64>) -> Result<Uniform> {
    let sizes: Vec<f64> = geom.list("size", 1..=3)?.unwrap_or_default().iter().map(double).collect();
    let needed = match kind {
        "sphere" => 1,
        "capsule" | "cylinder" if half.is_some() => 1,
        "capsule" | "cylinder" => 2,
        "box" | "ellipsoid" if half.is_some() => 2,
        _ => 3,
    };
    let sizes = if sizes.len() == 1 && half.is_some() { vec![sizes[0]; 2] } else { sizes };
    if sizes.len() < needed || sizes.iter().take(needed).any(|size| !(size.is_finite() && *size > 0.0)) {
        let text =
            format!("is a {kind} and needs {needed} positive number{} in `size`", if needed > 1 { "s" } else { "" });
        return Err(geom.error(ErrorKind::BadValue, &text));
    }
    let third = || half.unwrap_or_else(|| sizes[2]);
    Ok(match kind {
        "sphere" => Uniform::Sphere(sizes[0]),
        "capsule" => Uniform::Capsule(sizes[0], half.unwrap_or_else(|| sizes[1])),
        "cylinder" => Uniform::Cylinder(sizes[0], half.unwrap_or_else(|| sizes[1])),
        "box" => Uniform::Box([sizes[0], sizes[1], third()]),
        _ => Uniform::Ellipsoid([sizes[0], sizes[1], third()]),
    })
}

/// The solid of a link; `None` for an ellipsoid.
fn solid(uniform: Uniform) -> Option<Solid> {
    Some(match uniform {
        Uniform::Sphere(radius) => Solid::Sphere { radius },
        Uniform::Capsule(radius, half) => Solid::Capsule { radius, length: 2.0 * half },
        Uniform::Cylinder(radius, half) => Solid::Cylinder { radius, length: 2.0 * half },
        Uniform::Box(halves) => Solid::Box { size: halves.map(|half| 2.0 * half) },
        Uniform::Ellipsoid(_) => return None,
    })
}

fn placed(solid: Solid, pose: &Pose) -> Shape {
    Shape { xyz: pose.translation.vector.into(), rpy: rotation::rpy(&pose.rotation), ..Shape::new(solid) }
}

/// The mass of a geom \[kg\]: `mass`, or `density` times the volume.
fn weight(geom: &Styled<'_>, volume: f64, compiler: &Compiler) -> Result<f64> {
    if !compiler.weighs(geom.float("group")?.unwrap_or(0.0)) {
        return Ok(0.0);
    }
    let mass = geom.float("mass")?;
    let density = geom.float("density")?.unwrap_or(DENSITY);
    Ok(mass.unwrap_or(density * volume))
}

fn read_mesh<'e>(geom: &Styled<'e>, pose: &Pose, context: &Context<'_, 'e>, read: &mut Geom) -> Result<()> {
    let Some(name) = geom.attribute("mesh") else {
        return Err(geom.error(ErrorKind::MissingKey, "is a mesh and names none; give `mesh`"));
    };
    let mesh = context.assets.mesh(geom, name)?;
    let note = |what: &str| Some(format!("line {}: mesh `{}`: {what}", geom.own.line, shown(name)));
    let Some(solid) = mesh_solid(mesh, context.compiler)? else {
        read.note = note("its triangles are in the model; they are ignored");
        return Ok(());
    };
    if mesh.holder_of(&["refpos", "refquat"]).is_some() {
        read.note = note("`refpos` and `refquat` are ignored");
    }
    if mesh.attribute("inertia").is_some_and(|word| word == "convex" || word == "shell") {
        read.note = note("its inertia is computed from its exact volume, not from its hull or surface");
    }
    // A mass or a density of zero needs no triangles.
    if context.weighs && weight(geom, 1.0, context.compiler)? > 0.0 {
        match context.files.triangles(&solid) {
            Ok(surface) => {
                let (volume, unit) = of_mesh(&surface, volume_rule(mesh)?);
                let mass = weight(geom, volume, context.compiler)?;
                let share = if volume > 0.0 { mass / volume } else { 0.0 };
                let own = Inertia::unchecked(mass, unit.centre_of_mass(), unit.rotational() * share);
                read.inertia = (share > 0.0).then(|| own.placed(pose));
            }
            Err(error) => read.note = note(&format!("its mass is ignored: {}", error.message())),
        }
    }
    read.shape = Some(placed(solid, pose));
    Ok(())
}

/// How the volume of a mesh asset is computed. For `convex` and `shell` it is exact.
fn volume_rule(mesh: &Styled<'_>) -> Result<MeshVolume> {
    let word = mesh.choice("inertia", &["convex", "exact", "legacy", "shell"])?.unwrap_or("legacy");
    Ok(if word == "legacy" { MeshVolume::Absolute } else { MeshVolume::Exact })
}

/// The solid of a mesh asset; `None` for a mesh without a file.
fn mesh_solid(mesh: &Styled<'_>, compiler: &Compiler) -> Result<Option<Solid>> {
    let Some(file) = mesh.attribute("file") else { return Ok(None) };
    let scale = mesh.floats("scale")?.unwrap_or([1.0; 3]);
    let name = Path::new(file).file_name().filter(|_| compiler.strips);
    let file = name.map_or_else(|| file.to_owned(), |name| name.to_string_lossy().into_owned());
    let path = Path::new(&compiler.mesh_folder).join(file).to_string_lossy().into_owned();
    Ok(Some(Solid::Mesh { path, scale }))
}
