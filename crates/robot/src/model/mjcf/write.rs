//! Writing of robots as MJCF, the format of MuJoCo: [`Robot::to_mjcf`].
//!
//! Every link becomes a body, and every revolute or prismatic joint a joint with a position servo. Collision shapes
//! become geoms that touch the floor but no other part of the robot. Mimic joints become equality constraints. The root
//! is floating above a floor.

use std::path::Path;

use nalgebra::Matrix3;

use crate::Result;
use crate::document::shown;
use crate::model::attributes::{escaped, floats};
use crate::model::mesh::is_text;
use crate::model::{Joint, JointType, Link, Meshes, Robot, Servo, Shape, Solid, finite};
use crate::spatial::Pose;

/// Maximum depth with increasing indentation.
const MOST_STEMS: usize = 60;
/// Minimum half side of a solid \[m\]. MuJoCo refuses solids of size zero, such as a sphere that represents a point.
const LEAST_SIZE: f64 = 1e-6;
/// Minimum range of a joint, relative to its magnitude or to one \[rad or m\]. MuJoCo refuses an empty range.
const LEAST_RANGE: f64 = 1e-9;
/// Minimum thickness of a mesh relative to its length. MuJoCo computes the convex hull of its points.
const LEAST_THICKNESS: f64 = 1e-6;
/// Maximum number of triangles of a binary STL file in MuJoCo. It does not read text STL.
const MOST_TRIANGLES: usize = 200_000;
/// Relative increase, by the trace, of an inertia that is singular up to rounding.
const RAISED: f64 = 1e-12;

impl Robot {
    /// Writes the robot as MJCF. Meshes are referenced by file name, or embedded as triangles for text STL, which
    /// MuJoCo does not read. Meshes that are missing, damaged, flat, or in a format other than STL and OBJ are omitted
    /// with a note. Physically impossible masses are corrected here, with a note, and by MuJoCo's compiler.
    /// [`Robot::check`] reports the faults of the robot.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`](crate::ErrorKind::BadValue) for a link or a joint with a number outside the range of
    /// doubles.
    pub fn to_mjcf(&self, meshes: &Meshes, notes: &mut Vec<String>) -> Result<String> {
        self.mjcf(meshes, notes, false)
    }

    /// Same as [`Robot::to_mjcf`], but with the root fixed in the world. A root with the name `world` is MuJoCo's world itself; its mass is omitted.
    ///
    /// # Errors
    /// Those of [`Robot::to_mjcf`].
    pub fn to_mjcf_fixed(&self, meshes: &Meshes, notes: &mut Vec<String>) -> Result<String> {
        self.mjcf(meshes, notes, true)
    }

    fn mjcf(&self, meshes: &Meshes, notes: &mut Vec<String>, is_fixed: bool) -> Result<String> {
        self.check_doubles()?;
        let root = unlike("root", |name| self.joints().iter().any(|joint| joint.name == name));
        let world = unlike("world_", |name| self.links().iter().any(|link| link.name == name));
        let mut writer = Writer { robot: self, meshes, assets: Vec::new(), notes, root, world, is_fixed };
        let bodies = writer.bodies();
        let assets: String = writer.assets.iter().map(|asset| format!("    {asset}\n")).collect();
        Ok(format!(
            "<mujoco model=\"{name}\">\n  <compiler angle=\"radian\" inertiafromgeom=\"false\" balanceinertia=\"true\" boundmass=\"1e-4\" \
             boundinertia=\"1e-7\"/>\n  <option timestep=\"0.002\" integrator=\"implicitfast\"/>\n  <default>\n    <geom contype=\"1\" \
             conaffinity=\"2\" mass=\"0\"/>\n    <default class=\"visual\"><geom contype=\"0\" conaffinity=\"0\" group=\"2\"/></default>\n  \
             </default>\n  <asset>\n{assets}  </asset>\n  <worldbody>\n    <light pos=\"0 -2 4\" dir=\"0 0.4 -1\"/>\n    <geom name=\"floor\" \
             type=\"plane\" size=\"20 20 0.1\" contype=\"2\" conaffinity=\"1\" rgba=\"0.6 0.65 0.6 1\"/>\n{bodies}  </worldbody>\n  \
             <equality>\n{equations}  </equality>\n  <actuator>\n{servos}  </actuator>\n</mujoco>\n",
            name = escaped(self.name()),
            equations = self.equations(),
            servos = self.servos(),
        ))
    }

    /// Checks that all numbers, and numbers computed from them, are in the range of doubles.
    fn check_doubles(&self) -> Result<()> {
        for link in self.links() {
            finite::check_link(link).and_then(|()| finite::check_inertia(link))?;
        }
        for joint in self.joints() {
            finite::check_joint(joint).and_then(|()| finite::check_law(joint, &self.law(joint)))?;
        }
        Ok(())
    }

    /// The independent joints.
    fn leaders(&self) -> impl Iterator<Item = &Joint> {
        self.joints().iter().filter(|joint| joint.kind.is_single() && self.law(joint).leader == joint.name)
    }

    fn servos(&self) -> String {
        let servo = |joint: &Joint| {
            let name = escaped(&joint.name);
            let force = joint.effort.filter(|effort| *effort > 0.0);
            let force = force.map(|effort| format!(" forcerange=\"-{effort} {effort}\"")).unwrap_or_default();
            // MJCF has no velocity limits; `user` is for such data: the limit, or 0, and whether the gains are those of a description.
            let speed = joint.speed.filter(|speed| *speed > 0.0).unwrap_or(0.0);
            let gains = joint.servo.map_or_else(
                || "kp=\"100\"".to_owned(),
                |Servo { stiffness, damping }| format!("kp=\"{stiffness}\" kv=\"{damping}\""),
            );
            let described = u8::from(joint.servo.is_some());
            format!("    <position name=\"{name}\" joint=\"{name}\" {gains}{force} user=\"{speed} {described}\"/>\n")
        };
        self.leaders().map(servo).collect()
    }

    fn equations(&self) -> String {
        let follows = |joint: &&Joint| joint.kind.is_single() && self.law(joint).leader != joint.name;
        let equation = |joint: &Joint| {
            let law = self.law(joint);
            let [factor, summand] = law.law();
            let (one, other) = (escaped(&joint.name), escaped(&law.leader));
            format!("    <joint joint1=\"{one}\" joint2=\"{other}\" polycoef=\"{summand} {factor} 0 0 0\"/>\n")
        };
        self.joints().iter().filter(follows).map(equation).collect()
    }
}

/// State of the writer during the traversal of the tree.
struct Writer<'r> {
    robot: &'r Robot,
    meshes: &'r Meshes,
    assets: Vec<String>,
    notes: &'r mut Vec<String>,
    /// The names of the root's joint, and of a link whose name MuJoCo reserves for the world.
    root: String,
    world: String,
    /// Whether the root is fixed in the world.
    is_fixed: bool,
}

impl Writer<'_> {
    /// All bodies, each inside its parent.
    fn bodies(&mut self) -> String {
        let (robot, children) = (self.robot, self.robot.children());
        let (mut text, mut depth) = (String::new(), 2);
        // Stack of pending items: a link with its parent joint, or the end of a body.
        let mut open = vec![Some((robot.root_place(), None))];
        while let Some(next) = open.pop() {
            let Some((link, joint)) = next else {
                depth -= 1;
                text += &format!("{}</body>\n", stem(depth));
                continue;
            };
            let link_here = &robot.links()[link];
            if joint.is_none() && self.is_fixed && link_here.name == "world" {
                text += &self.geoms(link_here, &stem(depth - 1));
            } else {
                text += &self.opened(link_here, joint, &stem(depth));
                depth += 1;
                open.push(None);
            }
            let below = children[link].iter().rev();
            open.extend(below.map(|&joint| Some((robot.ends(joint).1, Some(&robot.joints()[joint])))));
        }
        text
    }

    /// Writes the body of a link with the parent joint `joint`, without its children and its end.
    fn opened(&mut self, link: &Link, joint: Option<&Joint>, stem: &str) -> String {
        let at = joint.map(|joint| placed(&joint.origin.pose())).unwrap_or_default();
        let root = || {
            if self.is_fixed { String::new() } else { format!("{stem}  <freejoint name=\"{}\"/>\n", self.root) }
        };
        let moves = joint.map_or_else(root, |joint| moving(joint, stem));
        let name = if link.name == "world" { &self.world } else { &link.name };
        let weighs = inertial(link, stem, self.notes);
        let body = format!("{stem}<body name=\"{}\"{at}>\n{moves}{weighs}", escaped(name));
        body + &self.geoms(link, stem)
    }

    /// The shapes of a link as geoms.
    fn geoms(&mut self, link: &Link, stem: &str) -> String {
        let mut text = String::new();
        let shapes = link
            .collisions
            .iter()
            .map(|shape| (shape, ""))
            .chain(link.visuals.iter().map(|shape| (shape, " class=\"visual\"")));
        for (shape, class) in shapes {
            if let Some(geom) = self.geom(shape) {
                text += &format!("{stem}  <geom{class} {geom}{}/>\n", placed(&shape.pose()));
            }
        }
        text
    }

    /// The solid and the colour of a geom; `None` for a mesh that MuJoCo cannot read.
    fn geom(&mut self, shape: &Shape) -> Option<String> {
        let sizes = |kind: &str, all: &[f64]| {
            let all: Vec<f64> = all.iter().map(|size| size.max(LEAST_SIZE)).collect();
            format!("type=\"{kind}\" size=\"{}\"", floats(&all))
        };
        let solid = match &shape.solid {
            Solid::Box { size } => sizes("box", &size.map(|side| side / 2.0)),
            Solid::Cylinder { radius, length } => sizes("cylinder", &[*radius, length / 2.0]),
            Solid::Capsule { radius, length } => sizes("capsule", &[*radius, length / 2.0]),
            Solid::Sphere { radius } => sizes("sphere", &[*radius]),
            Solid::Mesh { path, scale } => {
                let asset = self.asset(&shape.solid, path, scale)?;
                let name = format!("mesh{}", self.assets.len());
                self.assets.push(format!("<mesh name=\"{name}\" inertia=\"shell\" {asset}/>"));
                format!("type=\"mesh\" mesh=\"{name}\"")
            }
        };
        let colour = shape.colour.map(|[r, g, b, a]| format!(" rgba=\"{r} {g} {b} {a}\"")).unwrap_or_default();
        Some(solid + &colour)
    }

    /// The mesh as attributes: its file, or its triangles if MuJoCo does not read the file; `None`, with a note, for an
    /// unsupported mesh.
    fn asset(&mut self, solid: &Solid, path: &str, scale: &[f64; 3]) -> Option<String> {
        let of_file = |file: &Path| {
            let file = escaped(&file.to_string_lossy());
            format!("file=\"{file}\" scale=\"{}\"", floats(scale))
        };
        if let Some(file) = self.meshes.find(path).filter(|file| is_obj(file)) {
            return Some(of_file(&file));
        }
        let surface = self.meshes.triangles_or_note(solid, self.notes)?;
        if surface.is_flat(LEAST_THICKNESS) {
            self.notes.push(format!("the mesh `{}` is flat; MuJoCo does not support flat meshes", shown(path)));
            return None;
        }
        let file = self.meshes.find(path)?;
        if surface.triangles.len() <= MOST_TRIANGLES && !is_text(&file) {
            return Some(of_file(&file));
        }
        let points: Vec<f64> = surface.points.iter().flat_map(|point| point.coords.iter().copied()).collect();
        let corners: Vec<String> = surface.triangles.iter().flatten().map(u32::to_string).collect();
        Some(format!("vertex=\"{}\" face=\"{}\"", floats(&points), corners.join(" ")))
    }
}

/// Whether a mesh has a format that MuJoCo reads but groebot does not.
fn is_obj(file: &Path) -> bool {
    file.extension().is_some_and(|end| end.eq_ignore_ascii_case("obj"))
}

/// The indentation at a depth. Beyond [`MOST_STEMS`] it is constant, so that the text of a very deep tree has linear
/// size.
fn stem(depth: usize) -> String {
    "  ".repeat(depth.min(MOST_STEMS))
}

/// The joint of a body; empty for a fixed joint.
fn moving(joint: &Joint, stem: &str) -> String {
    let kind = match joint.kind {
        JointType::Revolute | JointType::Continuous => "hinge",
        JointType::Prismatic => "slide",
        _ => return String::new(),
    };
    let [x, y, z] = crate::spatial::exact::normalized(&joint.axis).into_inner().into();
    let range = joint.limits.filter(|_| joint.kind != JointType::Continuous);
    let range = range.map(|(low, high)| (low, high.max(low + LEAST_RANGE * low.abs().max(1.0))));
    let range = range.map(|(low, high)| format!(" limited=\"true\" range=\"{low} {high}\"")).unwrap_or_default();
    let dynamics = [("damping", joint.damping), ("frictionloss", joint.friction), ("armature", joint.armature)];
    let dynamics: String =
        dynamics.iter().filter(|(_, value)| *value != 0.0).map(|(key, value)| format!(" {key}=\"{value}\"")).collect();
    let name = escaped(&joint.name);
    format!("{stem}  <joint name=\"{name}\" type=\"{kind}\" axis=\"{x} {y} {z}\"{range}{dynamics}/>\n")
}

fn inertial(link: &Link, stem: &str, notes: &mut Vec<String>) -> String {
    let Some(mass) = &link.mass else { return String::new() };
    let inertia = mass.inertia();
    let at: [f64; 3] = inertia.centre_of_mass().into();
    let tensor = inertia.rotational();
    let raised = raised(&tensor);
    if (raised - tensor).amax() > 2.0 * RAISED * tensor.trace().abs() {
        notes.push(format!(
            "link `{}`: its moments of inertia are physically impossible; they are increased in MJCF",
            shown(&link.name)
        ));
    }
    let moments = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|at| raised[at]);
    format!(
        "{stem}  <inertial pos=\"{}\" mass=\"{}\" fullinertia=\"{}\"/>\n",
        floats(&at),
        inertia.mass(),
        floats(&moments)
    )
}

/// Adds a constant to all principal moments of a tensor if one of them is negative, so that none is.
fn raised(tensor: &Matrix3<f64>) -> Matrix3<f64> {
    let by = |amount: f64| tensor + Matrix3::from_diagonal_element(amount);
    let without =
        |row: usize| (0..3).filter(|column| *column != row).map(|column| tensor[(row, column)].abs()).sum::<f64>();
    // Gershgorin's circles bound the most negative principal moment.
    let below = (0..3).map(|row| without(row) - tensor[(row, row)]).fold(0.0, f64::max);
    let slight = RAISED * tensor.trace();
    if below == 0.0 || tensor.cholesky().is_some() {
        return *tensor;
    }
    if by(slight).cholesky().is_some() { by(slight) } else { by(below) }
}

/// An unused name: `wanted`, or `wanted` followed by `_`.
fn unlike(wanted: &str, is_taken: impl Fn(&str) -> bool) -> String {
    let mut name = wanted.to_owned();
    while is_taken(&name) {
        name.push('_');
    }
    name
}

/// Position and rotation as attributes. Zeros are omitted.
fn placed(pose: &Pose) -> String {
    let (p, q) = (pose.translation.vector, pose.rotation);
    let at = if p.norm() == 0.0 { String::new() } else { format!(" pos=\"{}\"", floats(p.as_slice())) };
    let turn = [q.w, q.i, q.j, q.k];
    let turned = if q.angle() == 0.0 { String::new() } else { format!(" quat=\"{}\"", floats(&turn)) };
    at + &turned
}
