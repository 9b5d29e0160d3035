//! Scenes as X3D 4.0 in XML (ISO/IEC 19775-1, 19776-1) and as VRML97 (ISO/IEC 14772-1): one tree in two languages.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_8};

use nalgebra::{Translation3, UnitQuaternion, Vector3};

use super::markup::{Dialect, Field, Markup};
use super::names::Names;
use super::skin::Skin;
use super::{Body, Material, Part, Scene};
use crate::Result;
use groebot_robot::document::shown;
use groebot_robot::model::Solid;
use groebot_robot::spatial::Pose;

/// The direction of the viewpoint, with y up.
const FROM: [f64; 3] = [1.0, 0.5, 1.0];
/// The direction of the light, in addition to that of the viewer.
const LIGHT: [f64; 3] = [-0.3, -1.0, -0.4];
/// The colour of the sky.
const SKY: [f64; 3] = [0.93, 0.94, 0.96];
/// Faces that meet at a smaller angle are shaded smoothly \[rad\].
const CREASE: f64 = 1.0;

impl Scene {
    /// The scene as X3D: `.x3d`. The motion repeats. Between two samples rotations are interpolated along the shorter
    /// arc, and positions linearly.
    ///
    /// Names of nodes keep letters and digits; other characters become `_`, and a repeated name gets a number.
    ///
    /// # Errors
    /// As [`Scene::check`].
    pub fn to_x3d(&self) -> Result<String> {
        self.written(Dialect::X3d)
    }

    /// Same as [`Scene::to_x3d`], but as VRML97: `.wrl`.
    ///
    /// # Errors
    /// As [`Scene::check`].
    pub fn to_wrl(&self) -> Result<String> {
        self.written(Dialect::Vrml)
    }

    fn written(&self, dialect: Dialect) -> Result<String> {
        self.check()?;
        let mut out = Markup::begin(dialect);
        let mut names = Names::default();
        let defined: Vec<String> = self.nodes.iter().map(|node| names.legal(&node.name)).collect();
        out.leaf("", "WorldInfo", "", &[("title", Field::Text(&shown(&self.title)))]);
        out.leaf("", "NavigationInfo", "", &[("type", Field::Words(&["EXAMINE", "ANY"]))]);
        out.leaf("", "Background", "", &[("skyColor", Field::Rows(&[SKY.to_vec()]))]);
        out.leaf(
            "",
            "DirectionalLight",
            "",
            &[("direction", Field::Numbers(&LIGHT)), ("intensity", Field::Numbers(&[0.25]))],
        );
        self.view(&mut out);
        self.tree(&mut out, &defined);
        self.motion(&mut out, &defined, &mut names);
        Ok(out.end())
    }

    /// A viewpoint that shows the whole motion.
    fn view(&self, out: &mut Markup) {
        let Some([low, high]) = self.bounds() else { return };
        let back = Vector3::from(FROM).normalize();
        // The default field of view is a quarter of pi. A ball is visible from its radius over the sine of half of
        // that.
        let away = (high - low).norm() / 2.0 / FRAC_PI_8.sin();
        let turn = UnitQuaternion::face_towards(&back, &Vector3::y());
        let (place, turn) = ((low + high) / 2.0 + back * away, axis_angle(&turn));
        if !place.iter().all(|x| x.is_finite()) {
            return;
        }
        let fields = [
            ("description", Field::Text("all")),
            ("position", Field::Numbers(place.as_slice())),
            ("orientation", Field::Numbers(&turn)),
        ];
        out.leaf("", "Viewpoint", "", &fields);
    }

    fn tree(&self, out: &mut Markup, names: &[String]) {
        let mut open = Vec::new();
        for (place, node) in self.nodes.iter().enumerate() {
            while open.last().copied() != node.parent && open.pop().is_some() {
                out.close();
            }
            open.push(place);
            transform(out, &names[place], &node.pose, node.scale);
            node.parts.iter().for_each(|part| shape(out, part));
        }
        open.iter().for_each(|_| out.close());
    }

    /// The clock, and the interpolators of each moving node.
    fn motion(&self, out: &mut Markup, names: &[String], free: &mut Names) {
        let moving: Vec<_> = self.nodes.iter().zip(names).collect();
        let end = self.times.last().copied().unwrap_or(0.0);
        if moving.iter().all(|(node, _)| node.turns.is_empty() && node.slides.is_empty()) {
            return;
        }
        let clock = free.legal("Clock");
        out.leaf("", "TimeSensor", &clock, &[("cycleInterval", Field::Numbers(&[end])), ("loop", Field::Flag(true))]);
        let shares: Vec<Vec<f64>> = self.times.iter().map(|time| vec![time / end]).collect();
        let mut moves = |kind: &str, name: &str, field: &str, rows: &[Vec<f64>]| {
            if !rows.is_empty() {
                let own = free.legal(&format!("{name}_{field}"));
                out.leaf("", kind, &own, &[("key", Field::Rows(&shares)), ("keyValue", Field::Rows(rows))]);
                out.route([&clock, "fraction_changed"], [&own, "set_fraction"]);
                out.route([&own, "value_changed"], [name, &format!("set_{field}")]);
            }
        };
        for (node, name) in moving {
            let turns: Vec<Vec<f64>> = node.turns.iter().map(|turn| axis_angle(turn).to_vec()).collect();
            let slides: Vec<Vec<f64>> = node.slides.iter().map(|slide| slide.as_slice().to_vec()).collect();
            moves("OrientationInterpolator", name, "rotation", &turns);
            moves("PositionInterpolator", name, "translation", &slides);
        }
    }
}

/// Begins a `Transform` with the fields that differ from the defaults.
fn transform(out: &mut Markup, name: &str, pose: &Pose, scale: [f64; 3]) {
    let (turn, place) = (axis_angle(&pose.rotation), pose.translation.vector);
    let mut fields = Vec::new();
    if place != Vector3::zeros() {
        fields.push(("translation", Field::Numbers(place.as_slice())));
    }
    if turn[3] != 0.0 {
        fields.push(("rotation", Field::Numbers(&turn)));
    }
    if scale != [1.0; 3] {
        fields.push(("scale", Field::Numbers(&scale)));
    }
    out.open(name, &fields);
}

fn shape(out: &mut Markup, part: &Part) {
    // The axis of a cylinder is y in X3D.
    let upright = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), FRAC_PI_2);
    let pose = match part.body {
        Body::Solid(Solid::Cylinder { .. }) => part.pose * Pose::from_parts(Translation3::identity(), upright),
        _ => part.pose,
    };
    let is_placed = pose != Pose::identity();
    if is_placed {
        transform(out, "", &pose, [1.0; 3]);
    }
    out.node("", "Shape", &[], |out| {
        out.node("appearance", "Appearance", &[], |out| material(out, &part.material));
        geometry(out, &part.body);
    });
    if is_placed {
        out.close();
    }
}

fn material(out: &mut Markup, own: &Material) {
    let usual = Material::default();
    let (ambient, clear) = ([own.ambient], [1.0 - own.opacity]);
    let fields: [(&str, &[f64], &[f64]); 5] = [
        ("ambientIntensity", &ambient, &[usual.ambient]),
        ("diffuseColor", &own.diffuse, &usual.diffuse),
        ("emissiveColor", &own.emissive, &usual.emissive),
        ("specularColor", &own.specular, &usual.specular),
        ("transparency", &clear, &[0.0]),
    ];
    let fields = fields.into_iter().filter(|(_, value, usual)| value != usual);
    let fields: Vec<_> = fields.map(|(field, value, _)| (field, Field::Numbers(value))).collect();
    out.leaf("material", "Material", "", &fields);
}

fn geometry(out: &mut Markup, body: &Body) {
    match body {
        Body::Solid(Solid::Box { size }) => out.leaf("geometry", "Box", "", &[("size", Field::Numbers(size))]),
        Body::Solid(Solid::Sphere { radius }) => {
            out.leaf("geometry", "Sphere", "", &[("radius", Field::Numbers(&[*radius]))]);
        }
        Body::Solid(Solid::Cylinder { radius, length }) => {
            let fields =
                [("radius", Field::Numbers(std::slice::from_ref(radius))), ("height", Field::Numbers(&[*length]))];
            out.leaf("geometry", "Cylinder", "", &fields);
        }
        _ => {
            let skin = Skin::of(body);
            let crease = if skin.normals.is_empty() { 0.0 } else { CREASE };
            let points: Vec<Vec<f64>> = skin.points.iter().map(|point| point.coords.as_slice().to_vec()).collect();
            let fields = [
                ("solid", Field::Flag(false)),
                ("creaseAngle", Field::Numbers(&[crease])),
                ("coordIndex", Field::Triangles(&skin.triangles)),
            ];
            out.node("geometry", "IndexedFaceSet", &fields, |out| {
                out.leaf("coord", "Coordinate", "", &[("point", Field::Rows(&points))]);
            });
        }
    }
}

/// The axis and the angle of a rotation, from 0 to pi \[rad\].
fn axis_angle(turn: &UnitQuaternion<f64>) -> [f64; 4] {
    match turn.axis_angle() {
        Some((axis, angle)) => [axis.x, axis.y, axis.z, angle],
        None => [0.0, 0.0, 1.0, 0.0],
    }
}
