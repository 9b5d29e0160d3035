//! Writing of robots as SDF: [`Robot::to_sdf`].

use std::collections::HashSet;
use std::fmt::{self, Write};

use crate::model::attributes::{decimal, decimals, escaped, floats, frame_numbers};
use crate::model::{Joint, JointType, Link, Mass, Robot, Shape, Solid};
use crate::{ErrorKind, Result};

/// The mass \[kg\] and the moments \[kg m^2\] of a link without mass that cannot be a frame. Gazebo needs positive ones.
const LEAST: [&str; 2] = ["0.000001", "0.000000001"];
/// The name of the world in SDF.
const WORLD: &str = "world";

impl Robot {
    /// Writes the robot as SDF 1.11. Decimal numbers keep all their digits. A link without mass and shapes at a fixed joint
    /// becomes a frame; other links without mass get a very small one, with a note. Actuators are omitted.
    /// [`Robot::check`] reports the faults of the robot.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for a floating or planar joint.
    pub fn to_sdf(&self, notes: &mut Vec<String>) -> Result<String> {
        let is_loose = |joint: &&Joint| matches!(joint.kind, JointType::Floating | JointType::Planar);
        if let Some(joint) = self.joints().iter().find(is_loose) {
            let text = format!("it is {}, which SDF does not have; use a fixed joint, or remove it", joint.kind.name());
            return Err(joint.error(ErrorKind::Unsupported, &text));
        }
        if !self.actuators().is_empty() {
            notes.push(format!("{} actuators of several joints are omitted: SDF has none", self.actuators().len()));
        }
        let mut text = String::from("<?xml version=\"1.0\"?>\n");
        // Writing to a string cannot fail.
        let _ = Writer::new(self, notes).write(&mut text);
        Ok(text)
    }
}

struct Writer<'r> {
    robot: &'r Robot,
    notes: &'r mut Vec<String>,
    /// The names in SDF of links and joints, by index. All are different, and none has `::`.
    links: Vec<String>,
    joints: Vec<String>,
    /// The links that are frames, by index.
    frames: Vec<bool>,
}

impl<'r> Writer<'r> {
    fn new(robot: &'r Robot, notes: &'r mut Vec<String>) -> Self {
        let mut taken = HashSet::new();
        let is_bare = |link: &Link| link.mass.is_none() && link.visuals.is_empty() && link.collisions.is_empty();
        let root = robot.root_place();
        let links: Vec<String> = (robot.links().iter().enumerate())
            .map(|(place, link)| {
                if place == root && link.name == WORLD && is_bare(link) {
                    return WORLD.to_owned();
                }
                unused(&mut taken, &link.name)
            })
            .collect();
        let joints = robot.joints().iter().map(|joint| unused(&mut taken, &joint.name)).collect();
        // A frame is fixed to a link of the model; the world is none.
        let is_held = |place: usize| {
            let above = robot.ancestry(place).first().copied();
            above.is_some_and(|joint| {
                robot.joints()[joint].kind == JointType::Fixed && links[robot.ends(joint).0] != WORLD
            })
        };
        let is_frame = |(place, link)| is_bare(link) && is_held(place);
        let frames = robot.links().iter().enumerate().map(is_frame).collect();
        Writer { robot, notes, links, joints, frames }
    }

    fn write(&mut self, out: &mut String) -> fmt::Result {
        let robot = self.robot;
        if let Some(source) = &robot.parts().source {
            // Two hyphens would end the comment.
            writeln!(out, "<!-- {} -->", source.replace("--", "- -"))?;
        }
        writeln!(out, "<sdf version=\"1.11\">\n  <model name=\"{}\">", escaped(&robot.name().replace("::", "_")))?;
        let above: Vec<Option<usize>> =
            (0..robot.links().len()).map(|link| robot.ancestry(link).first().copied()).collect();
        for (place, link) in robot.links().iter().enumerate() {
            match above[place] {
                _ if self.links[place] == WORLD => {}
                Some(joint) if self.frames[place] => self.write_frame(out, joint)?,
                joint => self.write_link(out, (place, link), joint)?,
            }
        }
        for (place, joint) in robot.joints().iter().enumerate() {
            if !self.frames[robot.ends(place).1] {
                self.write_joint(out, place, joint)?;
            }
        }
        writeln!(out, "  </model>\n</sdf>")
    }

    /// Writes the link below a fixed joint as a frame.
    fn write_frame(&self, out: &mut String, joint: usize) -> fmt::Result {
        let (parent, child) = self.robot.ends(joint);
        let (parent, child) = (escaped(&self.links[parent]), escaped(&self.links[child]));
        let pose = self.pose(joint);
        writeln!(out, "    <frame name=\"{child}\" attached_to=\"{parent}\"><pose>{pose}</pose></frame>")
    }

    fn pose(&self, joint: usize) -> String {
        frame_numbers(&self.robot.joints()[joint].origin).join(" ")
    }

    fn write_link(&mut self, out: &mut String, (place, link): (usize, &Link), joint: Option<usize>) -> fmt::Result {
        writeln!(out, "    <link name=\"{}\">", escaped(&self.links[place]))?;
        if let Some(joint) = joint {
            writeln!(out, "      <pose relative_to=\"{}\">0 0 0 0 0 0</pose>", escaped(&self.joints[joint]))?;
        }
        match &link.mass {
            Some(mass) => write_mass(out, mass)?,
            None => {
                let [mass, moment] = LEAST;
                self.notes.push(format!(
                    "link `{}` has no mass; {mass} kg are written, because SDF needs a positive mass",
                    crate::document::shown(&link.name)
                ));
                let moments = ["xx", "yy", "zz"].map(|axis| format!("<i{axis}>{moment}</i{axis}>")).concat();
                writeln!(out, "      <inertial><mass>{mass}</mass><inertia>{moments}</inertia></inertial>")?;
            }
        }
        let shapes = link.visuals.iter().map(|shape| ("visual", shape));
        let shapes = shapes.chain(link.collisions.iter().map(|shape| ("collision", shape)));
        let mut taken = HashSet::new();
        for (kind, shape) in shapes {
            let name = unused(&mut taken, shape.name.as_deref().unwrap_or(kind));
            write_shape(out, kind, &name, shape)?;
        }
        writeln!(out, "    </link>")
    }

    fn write_joint(&self, out: &mut String, place: usize, joint: &Joint) -> fmt::Result {
        let (parent, child) = self.robot.ends(place);
        let name = escaped(&self.joints[place]);
        let (parent, child) = (escaped(&self.links[parent]), escaped(&self.links[child]));
        writeln!(out, "    <joint name=\"{name}\" type=\"{}\">", joint.kind.name())?;
        let pose = self.pose(place);
        // A joint with the world is in the model's frame.
        let reference = if parent == WORLD { "__model__" } else { &parent };
        writeln!(out, "      <pose relative_to=\"{reference}\">{pose}</pose>")?;
        writeln!(out, "      <parent>{parent}</parent>\n      <child>{child}</child>")?;
        if joint.kind.is_single() {
            self.write_axis(out, joint)?;
        }
        writeln!(out, "    </joint>")
    }

    fn write_axis(&self, out: &mut String, joint: &Joint) -> fmt::Result {
        writeln!(out, "      <axis>\n        <xyz>{}</xyz>", decimals(&joint.axis))?;
        let limits = joint.limits.filter(|_| joint.kind != JointType::Continuous);
        let limits = limits.map(|(low, high)| format!("<lower>{low}</lower><upper>{high}</upper>")).unwrap_or_default();
        let motor = [("effort", joint.effort), ("velocity", joint.speed)];
        let motor = motor.iter().filter_map(|(key, value)| Some(format!("<{key}>{}</{key}>", (*value)?)));
        let limits = limits + &motor.collect::<String>();
        if !limits.is_empty() {
            writeln!(out, "        <limit>{limits}</limit>")?;
        }
        if joint.damping != 0.0 || joint.friction != 0.0 {
            let (damping, friction) = (joint.damping, joint.friction);
            writeln!(out, "        <dynamics><damping>{damping}</damping><friction>{friction}</friction></dynamics>")?;
        }
        if let Some(mimic) = &joint.mimic {
            let leader = self.robot.joints().iter().position(|other| other.name == mimic.leader);
            let leader = leader.map_or(mimic.leader.as_str(), |leader| &self.joints[leader]);
            let (multiplier, offset) = (decimal(&mimic.multiplier), decimal(&mimic.offset));
            writeln!(
                out,
                "        <mimic joint=\"{}\"><multiplier>{multiplier}</multiplier><offset>{offset}</offset><reference>0</reference></mimic>",
                escaped(leader)
            )?;
        }
        writeln!(out, "      </axis>")
    }
}

/// A name that is not in use, without `::`, and not one that SDF reserves.
fn unused(taken: &mut HashSet<String>, wanted: &str) -> String {
    let mut name = wanted.replace("::", "_");
    while name == WORLD || name.starts_with("__") || taken.contains(&name) {
        name = if name.starts_with("__") { format!("frame{name}") } else { format!("{name}_") };
    }
    taken.insert(name.clone());
    name
}

fn write_mass(out: &mut String, mass: &Mass) -> fmt::Result {
    let pose = frame_numbers(&mass.origin).join(" ");
    writeln!(out, "      <inertial>\n        <pose>{pose}</pose>\n        <mass>{}</mass>", decimal(&mass.mass))?;
    let names = ["xx", "xy", "xz", "yy", "yz", "zz"];
    let moments =
        names.iter().zip(&mass.moments).map(|(name, moment)| format!("<i{name}>{}</i{name}>", decimal(moment)));
    writeln!(out, "        <inertia>{}</inertia>\n      </inertial>", moments.collect::<String>())
}

fn write_shape(out: &mut String, kind: &str, name: &str, shape: &Shape) -> fmt::Result {
    writeln!(out, "      <{kind} name=\"{}\">", escaped(name))?;
    if shape.xyz != [0.0; 3] || shape.rpy != [0.0; 3] {
        writeln!(out, "        <pose>{} {}</pose>", floats(&shape.xyz), floats(&shape.rpy))?;
    }
    writeln!(out, "        <geometry>{}</geometry>", solid(&shape.solid))?;
    if let (Some(colour), "visual") = (&shape.colour, kind) {
        let colour = floats(colour);
        writeln!(out, "        <material><ambient>{colour}</ambient><diffuse>{colour}</diffuse></material>")?;
    }
    writeln!(out, "      </{kind}>")
}

fn solid(solid: &Solid) -> String {
    let round = |kind: &str, radius: f64, length: f64| {
        format!("<{kind}><radius>{radius}</radius><length>{length}</length></{kind}>")
    };
    match solid {
        Solid::Box { size } => format!("<box><size>{}</size></box>", floats(size)),
        Solid::Cylinder { radius, length } => round("cylinder", *radius, *length),
        Solid::Capsule { radius, length } => round("capsule", *radius, *length),
        Solid::Sphere { radius } => format!("<sphere><radius>{radius}</radius></sphere>"),
        Solid::Mesh { path, scale } => {
            format!("<mesh><uri>{}</uri><scale>{}</scale></mesh>", escaped(path), floats(scale))
        }
    }
}
