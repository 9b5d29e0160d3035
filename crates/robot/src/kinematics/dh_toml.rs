//! Reading of Denavit-Hartenberg tables from TOML: [`DhTable::read`], [`DhTable::from_toml`], [`Chain::from_dh_toml`].
//!
#![doc = include_str!("../../docs/dh_toml.md")]

use std::path::Path;

use super::chain_toml::{line_of, read_given, read_limits, read_task};
use super::parts::along_z;
use super::validate::Fault;
use super::{Chain, DhConvention, DhRow, DhTable, ExactVector, JointKind, Placement, Task, Turn};
use crate::document::{Document, Node, TEXT_LIMIT, Table, read_text, shown};
use crate::model::toml::{Units, read_units};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::BigRational;

const ROOT_KEYS: [&str; 11] =
    ["name", "description", "source", "length_unit", "angle_unit", "task", "given", "dh", "base", "joint", "tool"];
const JOINT_KEYS: [&str; 9] = ["name", "symbol", "type", "theta", "d", "a", "alpha", "offset", "limits"];
const CONVENTIONS: [(&str, DhConvention); 2] =
    [("standard", DhConvention::Standard), ("modified", DhConvention::Modified)];

impl DhTable {
    /// Reads a table from the file at `path`.
    ///
    /// # Errors
    /// Those of [`read_text`] and [`DhTable::from_toml`], with the file.
    pub fn read(path: &Path) -> Result<DhTable> {
        DhTable::from_toml(&read_text(path, TEXT_LIMIT)?).map_err(|error| error.in_file(path))
    }

    /// Reads a table from `text` in the format of [`crate::kinematics::dh_toml`].
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] for text that is not TOML or a string that is not a number; [`ErrorKind::UnknownKey`],
    /// [`ErrorKind::MissingKey`]; [`ErrorKind::BadValue`] for a wrong type or value. All have a line.
    pub fn from_toml(text: &str) -> Result<DhTable> {
        read_table(Document::parse(text)?.root())
    }
}

impl Chain {
    /// Reads a Denavit-Hartenberg table from `text` and converts it to a chain. The format is that of
    /// [`crate::kinematics::dh_toml`].
    ///
    /// # Errors
    /// Those of [`DhTable::from_toml`] and [`Chain::new`], with the line.
    pub fn from_dh_toml(text: &str) -> Result<Chain> {
        let document = Document::parse(text)?;
        let root = document.root();
        let table = read_table(root)?;
        let joints = root.required("joint")?.tables()?;
        let place = |fault: Fault| {
            let line = line_of(&fault, root, &joints);
            fault.error.at_line(line)
        };
        table.assemble().map_err(place)
    }
}

fn read_table(root: Table<'_>) -> Result<DhTable> {
    root.deny_unknown(&ROOT_KEYS)?;
    let dh = root.required("dh")?.table()?;
    dh.deny_unknown(&["convention"])?;
    let text = |key| root.optional(key).map(|node| node.text().map(str::to_owned)).transpose();
    let task = root.optional("task").map(|node| read_task(node.table()?)).transpose()?;
    let (task, direction) = task.unwrap_or_else(|| (Task::Pose, along_z()));
    let units = read_units(root)?;
    Ok(DhTable {
        name: root.required("name")?.text()?.to_owned(),
        description: text("description")?,
        source: text("source")?,
        length_unit: units.length,
        convention: dh.required("convention")?.one_of(&CONVENTIONS)?,
        base: read_placement(root, "base", units)?,
        rows: read_rows(&root.required("joint")?.tables()?, units)?,
        tool: read_placement(root, "tool", units)?,
        task,
        direction,
        given: read_given(root)?,
    })
}

/// Reads the frame in `key`; the identity without it.
fn read_placement(root: Table<'_>, key: &str, units: Units) -> Result<Placement> {
    let mut placement = Placement::identity();
    let Some(node) = root.optional(key) else { return Ok(placement) };
    let table = node.table()?;
    table.deny_unknown(&["xyz", "rpy"])?;
    if let Some(xyz) = table.optional("xyz") {
        placement.origin = xyz.exact_vector()?;
    }
    if let Some(rpy) = table.optional("rpy") {
        let angles: ExactVector = rpy.exact_vector()?;
        let turns = angles.iter().map(|angle| turn(rpy, angle, units)).collect::<Result<Vec<_>>>()?;
        let origin = placement.origin;
        placement = Placement { origin, ..Placement::turned(std::array::from_fn(|i| turns[i])) };
    }
    Ok(placement)
}

fn read_rows(tables: &[Table<'_>], units: Units) -> Result<Vec<DhRow>> {
    let row = |(index, table): (usize, &Table<'_>)| {
        let name = table.optional("name").and_then(|node| node.text().ok()).map_or(String::new(), shown);
        read_row(*table, index, units).map_err(|error| match name.as_str() {
            "" => error.with_context(format_args!("joint {}", index + 1)),
            name => error.with_context(format_args!("joint `{name}`")),
        })
    };
    tables.iter().enumerate().map(row).collect()
}

fn read_row(table: Table<'_>, index: usize, units: Units) -> Result<DhRow> {
    table.deny_unknown(&JOINT_KEYS)?;
    let kind =
        table.required("type")?.one_of(&[("revolute", JointKind::Revolute), ("prismatic", JointKind::Prismatic)])?;
    let moving = match kind {
        JointKind::Revolute => "theta",
        JointKind::Prismatic => "d",
    };
    if let Some(node) = table.optional(moving) {
        let message = format!(
            "it is the value of a {} joint; omit it, and give its value at the joint value zero as `offset`",
            if kind == JointKind::Revolute { "revolute" } else { "prismatic" }
        );
        return Err(node.error(ErrorKind::BadValue, message));
    }
    let key = |name| if name == moving { "offset" } else { name };
    let length = |name| table.optional(key(name)).map_or_else(|| Ok(BigRational::default()), |node| node.exact());
    let angle = |name| match table.optional(key(name)) {
        Some(node) => turn(node, &node.exact()?, units),
        None => Ok(Turn::default()),
    };
    let symbol = table.optional("symbol").map(|node| node.text().map(str::to_owned)).transpose()?;
    Ok(DhRow {
        name: table.required("name")?.text()?.to_owned(),
        symbol: symbol.unwrap_or_else(|| (index + 1).to_string()),
        kind,
        theta: angle("theta")?,
        d: length("d")?,
        a: length("a")?,
        alpha: angle("alpha")?,
        limits: table.optional("limits").map(|node| read_limits(node, kind, units)).transpose()?,
    })
}

fn turn(node: Node<'_>, angle: &BigRational, units: Units) -> Result<Turn> {
    let turn = if units.degrees { Turn::from_degrees(angle) } else { Turn::from_radians(angle) };
    turn.map_err(|error: Error| node.place(error))
}
