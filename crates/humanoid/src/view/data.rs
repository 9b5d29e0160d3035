//! What a page shows, as its script reads it: `viewer/src/data.ts` says the same in TypeScript. Metres, radians, seconds.

use serde::Serialize;

use crate::sim::{Interior, TaskRecord};

/// The version of the format.
pub const FORMAT: u32 = 1;

/// A frame in another one: the rows of its 3x4 matrix.
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
    /// What solves for them, packed: WebAssembly.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub wasm: Option<String>,
}

/// A limb whose solutions are shown: the pose of its tip in its base is the target.
#[derive(Clone, Debug, Serialize)]
pub struct Limb {
    pub name: String,
    /// Links, by their places.
    pub base: usize,
    pub tip: usize,
    /// Joints in the solver's order, by their places.
    pub joints: Vec<usize>,
    /// The solver's unit of length.
    pub metres: f64,
    /// The text of its `5_program.json`.
    pub program: String,
    /// The SHA-256 of its certificate.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub certificate: Option<String>,
}

/// What a limb reaches: places of a grid, by x, y and z in the frame of a link, of which z changes first.
#[derive(Clone, Debug, Serialize)]
pub struct Reach {
    /// A link, by its place.
    pub base: usize,
    /// The solver and what is asked of its tip, in words.
    pub of: String,
    /// By x, y and z: from, to, and how many.
    pub axes: [(f64, f64, usize); 3],
    /// How many orientations each place has.
    pub orientations: usize,
    /// Whether only answers within limits were counted.
    pub limited: bool,
    /// By place, how many orientations have an answer, how many answers there are, and the mean manipulability.
    pub reached: Column,
    pub answers: Column,
    #[serde(skip_serializing_if = "Option::is_none")]
    pub manipulability: Option<Column>,
}

/// A run of the simulator: what it is asked for, and the room as it is drawn.
#[derive(Clone, Debug, Serialize)]
pub struct Run {
    /// A robot of this crate that walks, by its name.
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
    /// The link whose pose is the motion's base.
    pub base: usize,
    pub links: Vec<Link>,
    /// Parents before children.
    pub joints: Vec<Joint>,
    /// What could not be shown, and why.
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
    /// The joint that leads in the end, by its place.
    pub joint: usize,
    pub factor: f64,
    pub offset: f64,
}

/// A number for each sample: the same for all, or doubles packed.
#[derive(Clone, Debug, Serialize)]
#[serde(untagged)]
pub enum Column {
    Constant(f64),
    Varying(String),
}

#[derive(Clone, Debug, Serialize)]
pub struct Motion {
    pub times: Column,
    /// The joint of each column of `q`, by its place.
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
    /// `1` where it stands, else `0`: a letter a sample.
    pub stands: String,
    /// What of it touches the floor, in its frame.
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

/// Polygons on the floor. Doubles, packed.
#[derive(Clone, Debug, Serialize)]
pub struct Support {
    /// The sample from which on each holds, until the next one does.
    pub starts: String,
    /// How many corners each has.
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
    /// The step that it belongs to, from 1.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub step: Option<usize>,
    pub from: f64,
    pub to: f64,
}
