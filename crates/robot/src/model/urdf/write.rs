//! Writing of robots as URDF: [`Robot::to_urdf`].

use std::fmt::{self, Write};

use crate::model::attributes::{decimal, decimals, escaped, floats, frame_numbers};
use crate::model::{Actuator, Joint, Link, Mass, Mimic, Origin, Robot, Shape, Solid};

impl Robot {
    /// Writes the robot as URDF. Reading the result gives an equal robot: decimal numbers keep all their digits, and
    /// other numbers are written as doubles. Symbols are omitted, since URDF cannot express them. [`Robot::check`]
    /// reports the faults of the robot.
    pub fn to_urdf(&self) -> String {
        let mut text = String::from("<?xml version=\"1.0\"?>\n");
        // Writing to a string cannot fail.
        let _ = write_robot(&mut text, self);
        text
    }
}

fn write_robot(out: &mut String, robot: &Robot) -> fmt::Result {
    if let Some(source) = &robot.parts().source {
        // Two hyphens would end the comment.
        writeln!(out, "<!-- {} -->", source.replace("--", "- -"))?;
    }
    writeln!(out, "<robot name=\"{}\">", escaped(robot.name()))?;
    robot.links().iter().try_for_each(|link| write_link(out, link))?;
    robot.joints().iter().try_for_each(|joint| write_joint(out, joint))?;
    robot.actuators().iter().try_for_each(|actuator| write_actuator(out, actuator))?;
    writeln!(out, "</robot>")
}

fn write_link(out: &mut String, link: &Link) -> fmt::Result {
    let name = escaped(&link.name);
    if link.mass.is_none() && link.visuals.is_empty() && link.collisions.is_empty() {
        return writeln!(out, "  <link name=\"{name}\"/>");
    }
    writeln!(out, "  <link name=\"{name}\">")?;
    if let Some(mass) = &link.mass {
        write_mass(out, mass)?;
    }
    link.visuals.iter().try_for_each(|shape| write_shape(out, "visual", shape))?;
    link.collisions.iter().try_for_each(|shape| write_shape(out, "collision", shape))?;
    writeln!(out, "  </link>")
}

fn write_mass(out: &mut String, mass: &Mass) -> fmt::Result {
    let [xx, xy, xz, yy, yz, zz] = mass.moments.each_ref().map(decimal);
    writeln!(out, "    <inertial>")?;
    if let Some(origin) = origin(&mass.origin) {
        writeln!(out, "      {origin}")?;
    }
    writeln!(out, "      <mass value=\"{}\"/>", decimal(&mass.mass))?;
    let moments = format!("ixx=\"{xx}\" ixy=\"{xy}\" ixz=\"{xz}\" iyy=\"{yy}\" iyz=\"{yz}\" izz=\"{zz}\"");
    writeln!(out, "      <inertia {moments}/>\n    </inertial>")
}

fn write_shape(out: &mut String, kind: &str, shape: &Shape) -> fmt::Result {
    let name = shape.name.as_ref().map(|name| format!(" name=\"{}\"", escaped(name))).unwrap_or_default();
    writeln!(out, "    <{kind}{name}>")?;
    if shape.xyz != [0.0; 3] || shape.rpy != [0.0; 3] {
        writeln!(out, "      <origin xyz=\"{}\" rpy=\"{}\"/>", floats(&shape.xyz), floats(&shape.rpy))?;
    }
    writeln!(out, "      <geometry>{}</geometry>", solid(&shape.solid))?;
    if let Some(colour) = &shape.colour {
        writeln!(out, "      <material name=\"\"><color rgba=\"{}\"/></material>", floats(colour))?;
    }
    writeln!(out, "    </{kind}>")
}

fn solid(solid: &Solid) -> String {
    match solid {
        Solid::Box { size } => format!("<box size=\"{}\"/>", floats(size)),
        Solid::Cylinder { radius, length } => format!("<cylinder radius=\"{radius}\" length=\"{length}\"/>"),
        Solid::Capsule { radius, length } => format!("<capsule radius=\"{radius}\" length=\"{length}\"/>"),
        Solid::Sphere { radius } => format!("<sphere radius=\"{radius}\"/>"),
        Solid::Mesh { path, scale } => {
            let scale = if *scale == [1.0; 3] { String::new() } else { format!(" scale=\"{}\"", floats(scale)) };
            format!("<mesh filename=\"{}\"{scale}/>", escaped(path))
        }
    }
}

fn write_joint(out: &mut String, joint: &Joint) -> fmt::Result {
    writeln!(out, "  <joint name=\"{}\" type=\"{}\">", escaped(&joint.name), joint.kind.name())?;
    writeln!(out, "    <parent link=\"{}\"/>", escaped(&joint.parent))?;
    writeln!(out, "    <child link=\"{}\"/>", escaped(&joint.child))?;
    if let Some(origin) = origin(&joint.origin) {
        writeln!(out, "    {origin}")?;
    }
    if joint.kind.has_axis() {
        writeln!(out, "    <axis xyz=\"{}\"/>", decimals(&joint.axis))?;
    }
    if joint.limits.is_some() || joint.effort.is_some() || joint.speed.is_some() {
        let range = joint.limits.map(|(lower, upper)| format!(" lower=\"{lower}\" upper=\"{upper}\""));
        // Other parsers refuse a limit without these attributes; zero means unknown.
        let [effort, velocity] = [joint.effort, joint.speed].map(Option::unwrap_or_default);
        writeln!(out, "    <limit{} effort=\"{effort}\" velocity=\"{velocity}\"/>", range.unwrap_or_default())?;
    }
    let dynamics = [("damping", joint.damping), ("friction", joint.friction), ("armature", joint.armature)];
    let dynamics: Vec<String> =
        dynamics.iter().filter(|(_, value)| *value != 0.0).map(|(key, value)| format!(" {key}=\"{value}\"")).collect();
    if !dynamics.is_empty() {
        writeln!(out, "    <dynamics{}/>", dynamics.concat())?;
    }
    if let Some(Mimic { leader, multiplier, offset }) = &joint.mimic {
        let (leader, multiplier, offset) = (escaped(leader), decimal(multiplier), decimal(offset));
        writeln!(out, "    <mimic joint=\"{leader}\" multiplier=\"{multiplier}\" offset=\"{offset}\"/>")?;
    }
    writeln!(out, "  </joint>")
}

fn write_actuator(out: &mut String, actuator: &Actuator) -> fmt::Result {
    let name = escaped(&actuator.name);
    writeln!(out, "  <transmission name=\"{name}\">\n    <type>transmission_interface/SimpleTransmission</type>")?;
    for (joint, ratio) in &actuator.joints {
        let reduction = format!("<mechanicalReduction>{ratio}</mechanicalReduction>");
        writeln!(out, "    <joint name=\"{}\">{reduction}</joint>", escaped(joint))?;
    }
    writeln!(out, "    <actuator name=\"{name}\"/>\n  </transmission>")
}

/// An `<origin>`; `None` for the identity.
fn origin(origin: &Origin) -> Option<String> {
    let [xyz, rpy] = frame_numbers(origin);
    let is_outer = *origin == Origin::identity() || (xyz == "0 0 0" && rpy == "0 0 0" && origin.rpy.is_none());
    (!is_outer).then(|| format!("<origin xyz=\"{xyz}\" rpy=\"{rpy}\"/>"))
}
