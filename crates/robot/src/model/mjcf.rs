//! Writing of robots as MJCF, the format of MuJoCo: [`Robot::to_mjcf`].
//!
//! Every link is a body, every joint that turns or slides a joint with a position servo, and what collides a geom that touches the floor and no other
//! part of the robot. Joints that follow others are tied to them by equations. The root moves freely over a floor.

use std::path::Path;

use nalgebra::Matrix3;

use super::attributes::{escaped, floats};
use super::mesh::is_text;
use super::{Joint, JointType, Link, Meshes, Robot, Shape, Solid, finite};
use crate::Result;
use crate::document::shown;
use crate::spatial::Pose;

/// The deepest level whose lines begin further to the right than those above.
const MOST_STEMS: usize = 60;
/// The least half of a solid's side \[m\]: MuJoCo takes no solid of size zero, such as a sphere that stands for a point.
const LEAST_SIZE: f64 = 1e-6;
/// The least range of a joint, as a share of its size or of one \[rad or m\]: MuJoCo takes none of equal ends.
const LEAST_RANGE: f64 = 1e-9;
/// How thick a mesh is at least, as a share of its length: MuJoCo takes the hull of its points.
const LEAST_THICKNESS: f64 = 1e-6;
/// The most triangles of a binary file in STL that MuJoCo reads; it reads no text.
const MOST_TRIANGLES: usize = 200_000;
/// By this share of its trace an inertia is raised that is singular to rounding.
const RAISED: f64 = 1e-12;

impl Robot {
    /// The robot as MJCF, with its meshes: the names of their files, or the triangles of texts, which MuJoCo does not read. Meshes that `meshes` does not
    /// find, that are damaged or flat, or in other formats than STL and OBJ are left out; `notes` says so of each. Masses that no body has are made
    /// possible here, with a note, and by MuJoCo's compiler. [`Robot::check`] reports whether all of the robot was understood.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`](crate::ErrorKind::BadValue) for a link or a joint with a number that no double holds.
    pub fn to_mjcf(&self, meshes: &Meshes, notes: &mut Vec<String>) -> Result<String> {
        self.check_doubles()?;
        let root = unlike("root", |name| self.joints().iter().any(|joint| joint.name == name));
        let world = unlike("world_", |name| self.links().iter().any(|link| link.name == name));
        let mut writer = Writer { robot: self, meshes, assets: Vec::new(), notes, root, world };
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

    /// Fails for a number that no double holds, and for one that follows from such.
    fn check_doubles(&self) -> Result<()> {
        for link in self.links() {
            finite::check_link(link).and_then(|()| finite::check_inertia(link))?;
        }
        for joint in self.joints() {
            finite::check_joint(joint).and_then(|()| finite::check_law(joint, &self.law(joint)))?;
        }
        Ok(())
    }

    /// The joints that lead themselves.
    fn leaders(&self) -> impl Iterator<Item = &Joint> {
        self.joints().iter().filter(|joint| joint.kind.is_single() && self.law(joint).leader == joint.name)
    }

    fn servos(&self) -> String {
        let servo = |joint: &Joint| {
            let name = escaped(&joint.name);
            let force = joint.effort.filter(|effort| *effort > 0.0);
            let force = force.map(|effort| format!(" forcerange=\"-{effort} {effort}\"")).unwrap_or_default();
            format!("    <position name=\"{name}\" joint=\"{name}\" kp=\"100\"{force}/>\n")
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

/// What is written on the way through the tree.
struct Writer<'r> {
    robot: &'r Robot,
    meshes: &'r Meshes,
    assets: Vec<String>,
    notes: &'r mut Vec<String>,
    /// The names of the joint by which the root moves, and of a link whose name MuJoCo keeps for the world.
    root: String,
    world: String,
}

impl Writer<'_> {
    /// All bodies, each within the one that carries it.
    fn bodies(&mut self) -> String {
        let (robot, children) = (self.robot, self.robot.children());
        let (mut text, mut depth) = (String::new(), 2);
        // What is still to be written, the next one last: a link and the joint above it, or the end of a body.
        let mut open = vec![Some((robot.root_place(), None))];
        while let Some(next) = open.pop() {
            let Some((link, joint)) = next else {
                depth -= 1;
                text += &format!("{}</body>\n", stem(depth));
                continue;
            };
            text += &self.opened(&robot.links()[link], joint, &stem(depth));
            depth += 1;
            open.push(None);
            let below = children[link].iter().rev();
            open.extend(below.map(|&joint| Some((robot.ends(joint).1, Some(&robot.joints()[joint])))));
        }
        text
    }

    /// The body of a link below `joint`, but for what hangs on it and its end.
    fn opened(&mut self, link: &Link, joint: Option<&Joint>, stem: &str) -> String {
        let at = joint.map(|joint| placed(&joint.origin.pose())).unwrap_or_default();
        let free = || format!("{stem}  <freejoint name=\"{}\"/>\n", self.root);
        let moves = joint.map_or_else(free, |joint| moving(joint, stem));
        let name = if link.name == "world" { &self.world } else { &link.name };
        let weighs = inertial(link, stem, self.notes);
        let mut text = format!("{stem}<body name=\"{}\"{at}>\n{moves}{weighs}", escaped(name));
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

    /// The solid and the colour of a geom; none for a mesh that MuJoCo cannot read.
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

    /// The mesh as attributes: its file, or its triangles where MuJoCo does not read the file; none, with a note, where it takes no such mesh.
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
            self.notes.push(format!("the mesh `{}` is flat; MuJoCo takes no such mesh", shown(path)));
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

/// Whether a mesh is in a format that MuJoCo reads and groebot does not.
fn is_obj(file: &Path) -> bool {
    file.extension().is_some_and(|end| end.eq_ignore_ascii_case("obj"))
}

/// The blanks before what is `depth` levels deep; beyond [`MOST_STEMS`] they grow no further, so that a very deep tree stays of linear size.
fn stem(depth: usize) -> String {
    "  ".repeat(depth.min(MOST_STEMS))
}

/// The joint of a body; nothing where it is fixed.
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
    let told = [("damping", joint.damping), ("frictionloss", joint.friction), ("armature", joint.armature)];
    let told: String =
        told.iter().filter(|(_, value)| *value != 0.0).map(|(key, value)| format!(" {key}=\"{value}\"")).collect();
    let name = escaped(&joint.name);
    format!("{stem}  <joint name=\"{name}\" type=\"{kind}\" axis=\"{x} {y} {z}\"{range}{told}/>\n")
}

fn inertial(link: &Link, stem: &str, notes: &mut Vec<String>) -> String {
    let Some(mass) = &link.mass else { return String::new() };
    let inertia = mass.inertia();
    let at: [f64; 3] = inertia.centre_of_mass().into();
    let tensor = inertia.rotational();
    let raised = raised(&tensor);
    if (raised - tensor).amax() > 2.0 * RAISED * tensor.trace().abs() {
        notes
            .push(format!("link `{}`: no body has its moments of inertia; in MJCF they are raised", shown(&link.name)));
    }
    let moments = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)].map(|at| raised[at]);
    format!(
        "{stem}  <inertial pos=\"{}\" mass=\"{}\" fullinertia=\"{}\"/>\n",
        floats(&at),
        inertia.mass(),
        floats(&moments)
    )
}

/// The tensor with the same added to all principal moments where one of them is below zero, so that none is.
fn raised(tensor: &Matrix3<f64>) -> Matrix3<f64> {
    let by = |amount: f64| tensor + Matrix3::from_diagonal_element(amount);
    let without =
        |row: usize| (0..3).filter(|column| *column != row).map(|column| tensor[(row, column)].abs()).sum::<f64>();
    // Gershgorin's circles: no principal moment is further below zero.
    let below = (0..3).map(|row| without(row) - tensor[(row, row)]).fold(0.0, f64::max);
    let slight = RAISED * tensor.trace();
    if below == 0.0 || tensor.cholesky().is_some() {
        return *tensor;
    }
    if by(slight).cholesky().is_some() { by(slight) } else { by(below) }
}

/// A name that none is: `wanted`, or with `_` behind it.
fn unlike(wanted: &str, is_taken: impl Fn(&str) -> bool) -> String {
    let mut name = wanted.to_owned();
    while is_taken(&name) {
        name.push('_');
    }
    name
}

/// Position and rotation as attributes; those that are zero are left out.
fn placed(pose: &Pose) -> String {
    let (p, q) = (pose.translation.vector, pose.rotation);
    let at = if p.norm() == 0.0 { String::new() } else { format!(" pos=\"{}\"", floats(p.as_slice())) };
    let turn = [q.w, q.i, q.j, q.k];
    let turned = if q.angle() == 0.0 { String::new() } else { format!(" quat=\"{}\"", floats(&turn)) };
    at + &turned
}
