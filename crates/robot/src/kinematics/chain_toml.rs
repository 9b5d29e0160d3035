//! Reading of chains from TOML: [`Chain::read`], [`Chain::from_toml`].
//!
#![doc = include_str!("../../docs/chain_toml.md")]

use std::path::Path;

use super::validate::{Fault, Part, check_count};
use super::{
    BaseAxis, Chain, ChainParts, Choice, ExactVector, Joint, JointKind, Placement, Plane, Root, Task, Tip, Turn,
};
use crate::document::{Document, Node, TEXT_LIMIT, Table, read_text, shown};
use crate::model::toml::{Units, read_mimic, read_units};
use crate::spatial::exact::vector::show;
use crate::{Error, ErrorKind, Result};

const ROOT_KEYS: [&str; 11] =
    ["name", "description", "source", "length_unit", "angle_unit", "order", "given", "choice", "task", "joint", "tip"];
const JOINT_KEYS: [&str; 8] = ["name", "symbol", "type", "axis", "point", "origin", "limits", "mimic"];
const PLANES: [(&str, Plane); 3] = [("xy", Plane::Xy), ("xz", Plane::Xz), ("yz", Plane::Yz)];
/// The axes of the base.
const AXES: [(&str, BaseAxis); 3] = [("x", BaseAxis::X), ("y", BaseAxis::Y), ("z", BaseAxis::Z)];

impl Chain {
    /// Reads a chain from the file at `path`.
    ///
    /// # Errors
    /// Those of [`read_text`] and [`Chain::from_toml`], with the file.
    pub fn read(path: &Path) -> Result<Chain> {
        Chain::from_toml(&read_text(path, TEXT_LIMIT)?).map_err(|error| error.in_file(path))
    }

    /// Reads a chain from `text` in the format of [`crate::kinematics::chain_toml`].
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] for text that is not TOML or a string that is not a number; [`ErrorKind::UnknownKey`],
    /// [`ErrorKind::MissingKey`]; [`ErrorKind::BadValue`] for a wrong type or value; those of [`Chain::new`]. All have
    /// a line.
    pub fn from_toml(text: &str) -> Result<Chain> {
        Chain::from_table(Document::parse(text)?.root())
    }

    /// Reads a chain from a TOML table with the keys of a whole file.
    ///
    /// # Errors
    /// Those of [`Chain::from_toml`].
    #[doc(hidden)]
    pub fn from_table(root: Table<'_>) -> Result<Chain> {
        root.deny_unknown(&ROOT_KEYS)?;
        let joints = root.required("joint")?.tables()?;
        let tip = root.required("tip")?.table()?;
        let place = |fault: Fault| {
            let line = line_of(&fault, root, &joints);
            fault.error.at_line(line)
        };
        check_count(joints.len()).map_err(place)?;
        Chain::assemble(read_parts(root, &joints, tip)?).map_err(place)
    }
}

/// Form in which a file specifies its joints.
#[derive(Clone, Copy, PartialEq)]
enum Form {
    /// Form A: points in the base frame.
    Point,
    /// Form B: frames relative to the previous joint.
    Origin,
}

impl Form {
    fn key(self) -> &'static str {
        match self {
            Form::Point => "point",
            Form::Origin => "origin",
        }
    }
}

fn read_parts(root: Table<'_>, joints: &[Table<'_>], tip: Table<'_>) -> Result<ChainParts> {
    let text = |key| root.optional(key).map(|node| node.text().map(str::to_owned)).transpose();
    let units = read_units(root)?;
    let form =
        if joints.iter().take(1).any(|joint| joint.optional("origin").is_some()) { Form::Origin } else { Form::Point };
    let (joints, last) = read_joints(joints, form, units)?;
    let (task, direction) = read_task(root.required("task")?.table()?)?;
    Ok(ChainParts {
        name: root.required("name")?.text()?.to_owned(),
        description: text("description")?,
        source: text("source")?,
        length_unit: units.length,
        joints,
        tip: read_tip(tip, form, &last)?,
        meant: None,
        task,
        direction,
        given: read_given(root)?,
        order: root.optional("order").map(read_names).transpose()?,
        choice: root.optional("choice").map(|node| read_choice(node.table()?)).transpose()?,
    })
}

/// The joints, and the frame of the last one.
fn read_joints(tables: &[Table<'_>], form: Form, units: Units) -> Result<(Vec<Joint>, Placement)> {
    let (mut joints, mut frame) = (Vec::new(), Placement::identity());
    for (index, table) in tables.iter().enumerate() {
        let name = table.optional("name").and_then(|node| node.text().ok()).map_or(String::new(), shown);
        let named = |error: Error| match name.as_str() {
            "" => error.with_context(format_args!("joint {}", index + 1)),
            name => error.with_context(format_args!("joint `{name}`")),
        };
        let joint = read_joint(*table, index, form, units, &frame).map_err(named)?;
        frame = joint.1;
        joints.push(joint.0);
    }
    Ok((joints, frame))
}

/// Reads a joint and its frame, given the frame of the previous joint.
fn read_joint(
    table: Table<'_>,
    index: usize,
    form: Form,
    units: Units,
    before: &Placement,
) -> Result<(Joint, Placement)> {
    table.deny_unknown(&JOINT_KEYS)?;
    check_form(table, form)?;
    let kind = [("revolute", JointKind::Revolute), ("prismatic", JointKind::Prismatic)];
    let kind = table.required("type")?.one_of(&kind)?;
    let symbol = table.optional("symbol").map(|node| node.text().map(str::to_owned)).transpose()?;
    let axis = table.required("axis")?.exact_vector()?;
    let place = table.required(form.key())?;
    let frame = match form {
        Form::Point => Placement { origin: place.exact_vector()?, ..Placement::identity() },
        Form::Origin => before.then(&read_origin(place)?),
    };
    let joint = Joint {
        name: table.required("name")?.text()?.to_owned(),
        symbol: symbol.unwrap_or_else(|| (index + 1).to_string()),
        kind,
        axis: frame.rotation.turn(&axis),
        point: frame.origin.clone(),
        limits: table.optional("limits").map(|node| read_limits(node, kind, units)).transpose()?,
        mimic: table.optional("mimic").map(|node| read_mimic(node.table()?)).transpose()?,
    };
    Ok((joint, frame))
}

fn form_of(table: Table<'_>) -> Result<Form> {
    let message = match (table.optional("point"), table.optional("origin")) {
        (Some(_), None) => return Ok(Form::Point),
        (None, Some(_)) => return Ok(Form::Origin),
        (None, None) => {
            "`point` (in the base frame) or `origin` (in the frame of the previous joint) is missing; give one"
        }
        (Some(_), Some(_)) => return Err(table.error(ErrorKind::BadValue, "`point` and `origin` are given; give one")),
    };
    Err(table.error(ErrorKind::MissingKey, message))
}

/// Points and origins may not be mixed in one file.
fn check_form(table: Table<'_>, form: Form) -> Result<()> {
    let own = form_of(table)?;
    if own == form {
        return Ok(());
    }
    let (own, form) = (own.key(), form.key());
    let message =
        format!("`{own}` is given here, but the first joint has `{form}`; give all joints and the tip a `{form}`");
    Err(table.required(own)?.error(ErrorKind::BadValue, message))
}

fn read_origin(node: Node<'_>) -> Result<Placement> {
    let table = node.table()?;
    table.deny_unknown(&["xyz", "rpy_deg"])?;
    let origin = table.optional("xyz").map(|xyz| xyz.exact_vector()).transpose()?;
    Ok(Placement { origin: origin.unwrap_or_default(), ..read_rpy(table)? })
}

fn read_rpy(table: Table<'_>) -> Result<Placement> {
    let Some(node) = table.optional("rpy_deg") else { return Ok(Placement::identity()) };
    let degrees: ExactVector = node.exact_vector()?;
    let turns: Result<Vec<Turn>> = degrees.iter().map(Turn::from_degrees).collect();
    match turns.as_deref() {
        Ok([roll, pitch, yaw]) if [roll, pitch, yaw].iter().all(|turn| turn.is_quarter()) => {
            Ok(Placement::turned([*roll, *pitch, *yaw]))
        }
        _ => {
            let message = format!("{} has no exact rotation; give multiples of 90 degrees", shown(&show(&degrees)));
            Err(node.error(ErrorKind::BadValue, message))
        }
    }
}

pub(super) fn read_limits(node: Node<'_>, kind: JointKind, units: Units) -> Result<(f64, f64)> {
    let [low, high] = node.float_vector()?;
    let turns = units.degrees && kind == JointKind::Revolute;
    Ok(if turns { (low.to_radians(), high.to_radians()) } else { (low, high) })
}

fn read_tip(table: Table<'_>, form: Form, last: &Placement) -> Result<Tip> {
    table.deny_unknown(&["point", "rpy_deg", "origin"])?;
    check_form(table, form)?;
    let place = table.required(form.key())?;
    let placement = match form {
        Form::Point => Placement { origin: place.exact_vector()?, ..read_rpy(table)? },
        Form::Origin => {
            table.deny_unknown(&["origin"])?;
            last.then(&read_origin(place)?)
        }
    };
    Ok(Tip { point: placement.origin, rotation: placement.rotation.matrix() })
}

/// A complete task, or one that needs a plane or an axis of the base.
#[derive(Clone)]
enum TaskKind {
    Spatial(Task),
    Planar(fn(Plane) -> Task),
    About(fn(BaseAxis) -> Task),
}

/// Reads the task and its direction in the tip frame.
pub fn read_task(table: Table<'_>) -> Result<(Task, ExactVector)> {
    table.deny_unknown(&["kind", "plane", "axis", "direction"])?;
    let task = read_kind(table)?;
    match table.optional("direction") {
        None => Ok((task, task.usual_direction())),
        Some(node) if task.aims() => Ok((task, node.exact_vector()?)),
        Some(node) => {
            let message = format!("the task `{}` orients no direction; omit it or choose `ray`", task.name());
            Err(node.error(ErrorKind::BadValue, message))
        }
    }
}

fn read_kind(table: Table<'_>) -> Result<Task> {
    let kinds = [
        ("position", TaskKind::Spatial(Task::Position)),
        ("planar_position", TaskKind::Planar(|plane| Task::PlanarPosition { plane })),
        ("planar_pose", TaskKind::Planar(|plane| Task::PlanarPose { plane })),
        ("pose", TaskKind::Spatial(Task::Pose)),
        ("ray", TaskKind::Spatial(Task::Ray)),
        ("direction", TaskKind::Spatial(Task::Direction)),
        ("rotation", TaskKind::Spatial(Task::Rotation)),
        ("position_pitch_roll", TaskKind::Spatial(Task::PositionPitchRoll)),
        ("position_yaw", TaskKind::About(|axis| Task::PositionYaw { axis })),
    ];
    let (plane, axis) = (table.optional("plane"), table.optional("axis"));
    let task = match table.required("kind")?.one_of(&kinds)? {
        TaskKind::Spatial(task) => task,
        TaskKind::Planar(task) => task(table.required("plane")?.one_of(&PLANES)?),
        TaskKind::About(task) => task(axis.map_or(Ok(BaseAxis::Z), |node| node.one_of(&AXES))?),
    };
    if let Some(node) = plane.filter(|_| task.plane().is_none()) {
        let message = format!("the task `{}` has no plane; omit it or choose a planar task", task.name());
        return Err(node.error(ErrorKind::BadValue, message));
    }
    if let Some(node) = axis.filter(|_| task.axis().is_none()) {
        let message = format!("the task `{}` has no axis; omit it or choose `position_yaw`", task.name());
        return Err(node.error(ErrorKind::BadValue, message));
    }
    Ok(task)
}

/// Reads the names in the key `given`; empty without it.
pub fn read_given(root: Table<'_>) -> Result<Vec<String>> {
    root.optional("given").map_or_else(|| Ok(Vec::new()), read_names)
}

fn read_names(node: Node<'_>) -> Result<Vec<String>> {
    Ok(node.texts()?.into_iter().map(str::to_owned).collect())
}

fn read_choice(table: Table<'_>) -> Result<Choice> {
    table.deny_unknown(&["unknown", "root"])?;
    let unknown = table.required("unknown")?.text()?.to_owned();
    let root = table.required("root")?.one_of(&[("minus", Root::Minus), ("plus", Root::Plus)])?;
    Ok(Choice { unknown, root })
}

/// The line of the key that a fault belongs to, else of its table.
pub(super) fn line_of(fault: &Fault, root: Table<'_>, joints: &[Table<'_>]) -> usize {
    let inner = |key| root.optional(key).and_then(|node: Node<'_>| node.table().ok());
    let table = match fault.part {
        Part::Chain => Some(root),
        Part::Joint(index) => joints.get(index).copied(),
        Part::Tip => inner("tip"),
        Part::Choice => inner("choice"),
        Part::Task => inner("task"),
    };
    let table = table.unwrap_or(root);
    table.optional(fault.key).map_or(table.line(), |node| node.line())
}
