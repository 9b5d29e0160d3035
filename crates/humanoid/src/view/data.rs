//! The data of a page, as its script reads them; `viewer/src/data.ts` has the TypeScript types. Metres, radians,
//! seconds.

use serde::Serialize;

use crate::sim::{Interior, TaskRecord};

/// The version of the format.
pub const FORMAT: u32 = 1;

/// A frame relative to another one: the rows of its 3x4 matrix.
pub type Frame = [f64; 12];

#[derive(Clone, Debug, Serialize)]
pub struct Data {
    pub format: u32,
    pub title: String,
    pub robot: Robot,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub motion: Option<Motion>,
    /// Limbs with their solvers.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub limbs: Vec<Limb>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub run: Option<Run>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub task: Option<TaskRecord>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub reach: Option<Reach>,
    /// The WebAssembly of their solver, packed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wasm: Option<String>,
}

/// A limb whose solutions are shown: the pose of its tip in its base is the target.
#[derive(Clone, Debug, Serialize)]
pub struct Limb {
    pub name: String,
    /// Indices of links.
    pub base: usize,
    pub tip: usize,
    /// Indices of joints in the solver's order.
    pub joints: Vec<usize>,
    /// The solver's unit of length.
    pub metres: f64,
    /// The text of its `5_program.json`, packed.
    pub program: String,
    /// The SHA-256 of its certificate.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub certificate: Option<String>,
}

/// The reachability of a limb: the points of a grid in x, y and z in the frame of a link, with z varying fastest.
#[derive(Clone, Debug, Serialize)]
pub struct Reach {
    /// The index of a link.
    pub base: usize,
    /// The solver and its task, as text.
    pub of: String,
    /// For x, y and z: the first value, the last value, and the number of values.
    pub axes: [(f64, f64, usize); 3],
    /// The number of orientations per point.
    pub orientations: usize,
    /// Whether only solutions within limits were counted.
    pub limited: bool,
    /// By point, the number of orientations with a solution, the number of solutions, and the mean manipulability.
    pub reached: Column,
    pub answers: Column,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub manipulability: Option<Column>,
}

/// A run of the simulator: its parameters, and the room as drawn.
#[derive(Clone, Debug, Serialize)]
pub struct Run {
    /// The name of a walking robot of this crate.
    pub robot: String,
    /// TOML.
    pub room: String,
    pub start: [f64; 3],
    pub goal: Vec<f64>,
    pub apart: f64,
    pub scene: Interior,
}

#[derive(Clone, Debug, Serialize)]
pub struct Robot {
    pub name: String,
    /// The index of the link whose pose is the motion's base.
    pub base: usize,
    pub links: Vec<Link>,
    /// Parents before children.
    pub joints: Vec<Joint>,
    /// The objects that could not be shown, with the reasons.
    pub notes: Vec<String>,
}

#[derive(Clone, Debug, Serialize)]
pub struct Link {
    pub name: String,
    pub shapes: Vec<Shape>,
    /// Whether it has a shape that is not shown.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    pub hidden: bool,
}

#[derive(Clone, Debug, Serialize)]
pub struct Shape {
    pub pose: Frame,
    #[serde(flatten)]
    pub solid: Solid,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub colour: Option<[f64; 4]>,
}

#[derive(Clone, Debug, Serialize)]
#[serde(tag = "kind", rename_all = "lowercase")]
pub enum Solid {
    Box { size: [f64; 3] },
    Cylinder { radius: f64, length: f64 },
    Sphere { radius: f64 },
    Capsule { radius: f64, length: f64 },
    Mesh { positions: String, triangles: String },
}

#[derive(Clone, Debug, Serialize)]
pub struct Joint {
    pub name: String,
    pub kind: &'static str,
    pub parent: usize,
    pub child: usize,
    pub origin: Frame,
    pub axis: [f64; 3],
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limits: Option<(f64, f64)>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub speed: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub follows: Option<Follows>,
}

#[derive(Clone, Debug, Serialize)]
pub struct Follows {
    /// The index of the leading joint.
    pub joint: usize,
    pub factor: f64,
    pub offset: f64,
}

/// A number for each sample: one for all, or 64-bit floats, packed.
#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
pub enum Column {
    Constant(f64),
    Varying(String),
}

#[derive(Clone, Debug, Serialize)]
pub struct Motion {
    pub times: Column,
    /// The index of the joint of each column of `q`.
    pub joints: Vec<usize>,
    pub q: Vec<Column>,
    /// Position and quaternion xyzw.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub base: Option<Vec<Column>>,
    pub contacts: Vec<Contact>,
    pub points: Vec<Point>,
    pub figures: Vec<Figure>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub support: Option<Support>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub steps: Vec<Step>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub phases: Vec<Phase>,
}

#[derive(Clone, Debug, Serialize)]
pub struct Contact {
    pub name: String,
    /// Position and quaternion xyzw.
    pub poses: Vec<Column>,
    /// `1` in contact, else `0`: one character per sample.
    pub stands: String,
    /// Its contact area, in its frame.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub outline: Vec<[f64; 2]>,
}

#[derive(Clone, Debug, Serialize)]
pub struct Point {
    pub name: String,
    pub at: Vec<Column>,
}

#[derive(Clone, Debug, Serialize)]
pub struct Figure {
    pub name: String,
    pub unit: String,
    pub values: Column,
}

/// Polygons on the floor; 64-bit floats, packed.
#[derive(Clone, Debug, Serialize)]
pub struct Support {
    /// The first sample of each; it is valid until the next one.
    pub starts: String,
    /// The number of corners of each.
    pub counts: String,
    /// The corners of all of them: x and y.
    pub corners: String,
}

#[derive(Clone, Debug, Serialize)]
pub struct Step {
    pub foot: String,
    pub x: f64,
    pub y: f64,
    pub yaw: f64,
}

#[derive(Clone, Debug, Serialize)]
pub struct Phase {
    pub action: String,
    /// The number of its step, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub step: Option<usize>,
    pub from: f64,
    pub to: f64,
}
