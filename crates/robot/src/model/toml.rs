//! Reading of robots from TOML: [`Robot::read`], [`Robot::from_toml`].
//!
#![doc = include_str!("../../docs/robot_toml.md")]

use nalgebra::{Unit, UnitQuaternion, Vector3};
use num_traits::One;

use super::{Actuator, Joint, JointType, LengthUnit, Link, Mass, Mimic, Origin, Robot, RobotParts, Shape, Solid};
use crate::document::{Document, Node, Table, shown};
use crate::spatial::exact::{ExactVector, Placement, Turn};
use crate::spatial::rotation;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::BigRational;

const KEYS: [&str; 9] =
    ["name", "description", "source", "length_unit", "angle_unit", "link", "joint", "frame", "actuator"];
const LINK_KEYS: [&str; 6] = ["name", "mass", "centre", "inertia", "visual", "collision"];
const JOINT_KEYS: [&str; 14] = [
    "name", "type", "parent", "child", "origin", "axis", "symbol", "limits", "speed", "effort", "damping", "friction",
    "armature", "mimic",
];

impl Robot {
    /// The robot that `text` describes in the format of [`crate::model::toml`].
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] for text that is not TOML; [`ErrorKind::UnknownKey`], [`ErrorKind::MissingKey`];
    /// [`ErrorKind::BadValue`] for a wrong type or value; those of [`Robot::new`]. All have a line.
    pub fn from_toml(text: &str) -> Result<Robot> {
        let document = Document::parse(text)?;
        let root = document.root();
        if let Some(node) = ["dh", "tip", "chain"].into_iter().find_map(|key| root.optional(key)) {
            let text = "this describes a chain, whose solver can be derived; it has no links, and a robot has `link` and `joint`";
            return Err(node.error(ErrorKind::UnknownKey, text));
        }
        root.deny_unknown(&KEYS)?;
        let reader = Reader { units: read_units(root)? };
        let tables = |key| root.optional(key).map_or(Ok(Vec::new()), |node| node.tables());
        let mut links = tables("link")?.into_iter().map(|link| reader.link(link)).collect::<Result<Vec<_>>>()?;
        let mut joints = tables("joint")?.into_iter().map(|joint| reader.joint(joint)).collect::<Result<Vec<_>>>()?;
        for frame in tables("frame")? {
            let (link, joint) = reader.frame(frame)?;
            links.push(link);
            joints.push(joint);
        }
        Robot::new(RobotParts {
            name: root.required("name")?.text()?.to_owned(),
            source: root.optional("source").map(|node| node.text().map(str::to_owned)).transpose()?,
            links,
            joints,
            actuators: tables("actuator")?.into_iter().map(read_actuator).collect::<Result<_>>()?,
            ..RobotParts::default()
        })
    }
}

/// The units of a file.
#[derive(Clone, Copy)]
pub(crate) struct Units {
    pub(crate) length: LengthUnit,
    pub(crate) degrees: bool,
}

pub(crate) fn read_units(root: Table<'_>) -> Result<Units> {
    let length = root.optional("length_unit").map(|node| {
        let known = [("m", LengthUnit::Metre), ("mm", LengthUnit::Millimetre)];
        node.one_of(&known)
    });
    let degrees = root.optional("angle_unit").map(|node| node.one_of(&[("rad", false), ("deg", true)]));
    Ok(Units { length: length.transpose()?.unwrap_or_default(), degrees: degrees.transpose()?.unwrap_or(false) })
}

/// Reads the mimic law; multiplier 1 and offset 0 by default.
pub(crate) fn read_mimic(table: Table<'_>) -> Result<Mimic> {
    table.deny_unknown(&["joint", "multiplier", "offset"])?;
    let number = |key| table.optional(key).map(|node| node.exact()).transpose();
    Ok(Mimic {
        leader: table.required("joint")?.text()?.to_owned(),
        multiplier: number("multiplier")?.unwrap_or_else(BigRational::one),
        offset: number("offset")?.unwrap_or_default(),
    })
}

/// The rotation of `rpy_deg`, multiples of 30 and 45 degrees.
fn read_rpy(table: Table<'_>) -> Result<Placement> {
    let Some(node) = table.optional("rpy_deg") else { return Ok(Placement::identity()) };
    let degrees: ExactVector = node.exact_vector()?;
    let turns: Vec<Turn> = degrees
        .iter()
        .map(|angle| Turn::from_degrees(angle).map_err(|error| node.place(error)))
        .collect::<Result<_>>()?;
    Ok(Placement::turned(std::array::from_fn(|i| turns[i])))
}

/// The rotation of `rpy` \[rad\], any angles, and these angles: read as those of a URDF.
fn read_radians(table: Table<'_>, node: Node<'_>) -> Result<(Placement, Option<ExactVector>)> {
    if table.optional("rpy_deg").is_some() {
        return Err(node.error(ErrorKind::BadValue, "`rpy` and `rpy_deg` are given; give one"));
    }
    let rpy: ExactVector = node.exact_vector()?;
    let turns: Vec<Turn> =
        rpy.iter().map(|angle| Turn::from_radians(angle).map_err(|error| node.place(error))).collect::<Result<_>>()?;
    Ok((Placement::turned(std::array::from_fn(|i| turns[i])), Some(rpy)))
}

fn read_actuator(table: Table<'_>) -> Result<Actuator> {
    table.deny_unknown(&["name", "joints", "ratios"])?;
    let joints = table.required("joints")?.texts()?;
    let ratios = match table.optional("ratios") {
        Some(node) => {
            let ratios = node.array()?.iter().map(Node::float).collect::<Result<Vec<_>>>()?;
            if ratios.len() != joints.len() {
                let text = format!("{} ratios are given for {} joints; give one each", ratios.len(), joints.len());
                return Err(node.error(ErrorKind::BadValue, text));
            }
            ratios
        }
        None => vec![1.0; joints.len()],
    };
    let joints = joints.into_iter().map(str::to_owned).zip(ratios).collect();
    Ok(Actuator { name: table.required("name")?.text()?.to_owned(), joints })
}

/// Data common to all parts of a file.
struct Reader {
    units: Units,
}

impl Reader {
    fn link(&self, table: Table<'_>) -> Result<Link> {
        table.deny_unknown(&LINK_KEYS)?;
        let name = table.required("name")?.text()?;
        let shapes = |key| {
            let tables = table.optional(key).map_or(Ok(Vec::new()), |node| node.tables());
            tables?.into_iter().map(|shape| self.shape(shape)).collect::<Result<Vec<_>>>()
        };
        let read = || {
            Ok(Link {
                mass: table.optional("mass").map(|node| self.mass(table, node)).transpose()?,
                visuals: shapes("visual")?,
                collisions: shapes("collision")?,
                line: Some(table.line()),
                ..Link::new(name)
            })
        };
        read().map_err(|error: Error| error.with_context(format_args!("link `{}`", shown(name))))
    }

    /// Mass, `centre` and `inertia` = \[ixx, iyy, izz, ixy, ixz, iyz\] about it.
    fn mass(&self, table: Table<'_>, mass: Node<'_>) -> Result<Mass> {
        let centre = table.optional("centre").map_or(Ok(ExactVector::default()), |node| self.lengths(node))?;
        let [xx, yy, zz, xy, xz, yz] =
            table.optional("inertia").map_or(Ok(Default::default()), |node| node.exact_vector::<6>())?;
        let origin = Placement { origin: centre, ..Placement::identity() }.into();
        Ok(Mass { mass: mass.exact()?, origin, moments: [xx, xy, xz, yy, yz, zz] })
    }

    fn joint(&self, table: Table<'_>) -> Result<Joint> {
        table.deny_unknown(&JOINT_KEYS)?;
        let name = table.required("name")?.text()?;
        let read = || -> Result<Joint> {
            let kinds = JointType::ALL.map(|kind| (kind.name(), kind));
            let kind = table.required("type")?.one_of(&kinds)?;
            let text = |key| table.required(key).and_then(|node| node.text());
            let number = |key| table.optional(key).map(|node| node.float()).transpose();
            let mut joint = Joint {
                origin: table.optional("origin").map_or(Ok(Origin::identity()), |node| self.origin(node.table()?))?,
                symbol: table.optional("symbol").map(|node| node.text().map(str::to_owned)).transpose()?,
                limits: table.optional("limits").map(|node| self.limits(node, kind)).transpose()?,
                speed: number("speed")?,
                effort: number("effort")?,
                damping: number("damping")?.unwrap_or_default(),
                friction: number("friction")?.unwrap_or_default(),
                armature: number("armature")?.unwrap_or_default(),
                mimic: table.optional("mimic").map(|node| read_mimic(node.table()?)).transpose()?,
                line: Some(table.line()),
                ..Joint::new(name, kind, text("parent")?, text("child")?)
            };
            if kind.has_axis() {
                joint.axis = table.required("axis")?.exact_vector()?;
            }
            Ok(joint)
        };
        read().map_err(|error| error.with_context(format_args!("joint `{}`", shown(name))))
    }

    fn limits(&self, node: Node<'_>, kind: JointType) -> Result<(f64, f64)> {
        let [low, high] = node.float_vector()?;
        let turns = self.units.degrees && kind != JointType::Prismatic;
        let metres = if kind == JointType::Prismatic { self.units.length.metres() } else { 1.0 };
        Ok(if turns { (low.to_radians(), high.to_radians()) } else { (low * metres, high * metres) })
    }

    /// A link without mass, fixed to the link given by `on`.
    fn frame(&self, table: Table<'_>) -> Result<(Link, Joint)> {
        table.deny_unknown(&["name", "on", "origin", "collision"])?;
        let name = table.required("name")?.text()?;
        let collisions = table.optional("collision").map_or(Ok(Vec::new()), |node| node.tables())?;
        let collisions = collisions.into_iter().map(|shape| self.shape(shape)).collect::<Result<_>>()?;
        let origin = table.optional("origin").map_or(Ok(Origin::identity()), |node| self.origin(node.table()?))?;
        let joint = Joint {
            origin,
            line: Some(table.line()),
            ..Joint::new(&format!("{name}_fixed"), JointType::Fixed, table.required("on")?.text()?, name)
        };
        Ok((Link { collisions, line: Some(table.line()), ..Link::new(name) }, joint))
    }

    fn origin(&self, table: Table<'_>) -> Result<Origin> {
        table.deny_unknown(&["xyz", "rpy_deg", "rpy"])?;
        let xyz = table.optional("xyz").map_or(Ok(ExactVector::default()), |node| self.lengths(node))?;
        let (turned, rpy) = match table.optional("rpy") {
            Some(node) => read_radians(table, node)?,
            None => (read_rpy(table)?, None),
        };
        Ok(Origin { placement: Placement { origin: xyz, ..turned }, rpy })
    }

    /// Lengths in metres, exactly.
    fn lengths(&self, node: Node<'_>) -> Result<ExactVector> {
        let thousand = BigRational::from_integer(1000.into());
        let lengths = node.exact_vector()?;
        Ok(match self.units.length {
            LengthUnit::Metre => lengths,
            LengthUnit::Millimetre => lengths.map(|length| length / &thousand),
        })
    }

    fn shape(&self, table: Table<'_>) -> Result<Shape> {
        let kinds = ["box", "cylinder", "sphere", "capsule", "mesh"];
        table.deny_unknown(&[&kinds[..], &["name", "xyz", "rpy_deg", "colour"]].concat())?;
        let given: Vec<Node<'_>> = kinds.iter().filter_map(|kind| table.optional(kind)).collect();
        let [solid] = given[..] else {
            let text =
                format!("{} solids are given; give one of {}", given.len(), kinds.map(|k| format!("`{k}`")).join(", "));
            return Err(table.error(ErrorKind::BadValue, text));
        };
        let metres = self.units.length.metres();
        let mut shape = match solid.name() {
            "box" => Shape::new(Solid::Box { size: solid.float_vector::<3>()?.map(|side| side * metres) }),
            "sphere" => Shape::new(Solid::Sphere { radius: solid.float()? * metres }),
            "mesh" => Shape::new(Solid::Mesh { path: solid.text()?.to_owned(), scale: [1.0; 3] }),
            name => self.round(solid.table()?, name == "capsule")?,
        };
        if let Some(node) = table.optional("xyz") {
            shape.xyz = node.float_vector::<3>()?.map(|length| length * metres);
        }
        if let Some(node) = table.optional("rpy_deg") {
            shape.rpy = node.float_vector::<3>()?.map(f64::to_radians);
        }
        shape.name = table.optional("name").map(|node| node.text().map(str::to_owned)).transpose()?;
        shape.colour = table.optional("colour").map(|node| node.float_vector::<4>()).transpose()?;
        Ok(shape)
    }

    /// A cylinder or capsule: `radius` and `length` along z, or `radius` and the ends `from` and `to` of its axis.
    fn round(&self, table: Table<'_>, is_capsule: bool) -> Result<Shape> {
        table.deny_unknown(&["radius", "length", "from", "to"])?;
        let metres = self.units.length.metres();
        let radius = table.required("radius")?.float()? * metres;
        let solid = |length| {
            Shape::new(if is_capsule { Solid::Capsule { radius, length } } else { Solid::Cylinder { radius, length } })
        };
        let Some(from) = table.optional("from") else {
            return Ok(solid(table.required("length")?.float()? * metres));
        };
        let [from, to] = [from, table.required("to")?].map(|node| node.float_vector::<3>());
        let (from, to) = (Vector3::from(from?) * metres, Vector3::from(to?) * metres);
        let along = Unit::try_new(to - from, 0.0).unwrap_or(Vector3::z_axis());
        let turn = UnitQuaternion::rotation_between_axis(&Vector3::z_axis(), &along)
            .unwrap_or(UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI));
        let middle = (from + to) / 2.0;
        Ok(Shape { xyz: middle.into(), rpy: rotation::rpy(&turn), ..solid((to - from).norm()) })
    }
}
