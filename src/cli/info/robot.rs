//! A robot with its links, as text and as JSON.

use nalgebra::Point3;
use serde_json::{Value, json};

use super::super::ends::TipLink;
use super::super::json::FORMAT;
use super::{Paint, joints};
use crate::Result;
use groebot_robot::dynamics::Model;
use groebot_robot::model::{JointType, Robot};
use groebot_robot::spatial::Pose;

/// The greatest number of doubts that a page lists.
const LISTED: usize = 8;

/// A robot with its mass and centre of mass.
pub struct Body<'r> {
    robot: &'r Robot,
    /// The mass; none for a robot with faults.
    mass: Option<f64>,
    /// The centre of mass in the frame of the root; none without a mass.
    centre: Option<Point3<f64>>,
}

impl<'r> Body<'r> {
    /// `robot` at the joint values `q`, all zero where there are none.
    ///
    /// # Errors
    /// As [`Model::new`] and [`Model::place`]; faults of the robot only where there are joint values.
    pub fn new(robot: &'r Robot, q: &[f64]) -> Result<Self> {
        if q.is_empty() && !robot.faults().is_empty() {
            return Ok(Body { robot, mass: None, centre: None });
        }
        let model = Model::new(robot)?;
        let zero = vec![0.0; model.joints().len()];
        let placed = model.place(&Pose::identity(), if q.is_empty() { &zero } else { q })?;
        let centre = (model.mass() > 0.0).then(|| placed.centre_of_mass());
        Ok(Body { robot, mass: Some(model.mass()), centre })
    }

    /// The robot as JSON: names, moving joints in the order of `--q`, mass, centre of mass, warnings, and faults of single
    /// parts.
    pub fn json(&self) -> Value {
        let robot = self.robot;
        let moving = robot.moving().into_iter().map(|place| {
            let joint = &robot.joints()[place];
            json!({
                "name": joint.name, "type": joint.kind.name(), "parent": joint.parent, "child": joint.child,
                "limits": joint.limits, "speed": joint.speed, "effort": joint.effort,
                "mimics": joint.mimic.as_ref().map(|mimic| &mimic.leader),
            })
        });
        json!({
            "format": FORMAT,
            "robot": robot.name(),
            "root": robot.root(),
            "tip_link": robot.path(None, None).ok().as_ref().map(TipLink::of_path),
            "links": robot.links().iter().map(|link| &link.name).collect::<Vec<_>>(),
            "joints": moving.collect::<Vec<_>>(),
            "mass": self.mass,
            "centre_of_mass": self.centre.map(|centre| [centre.x, centre.y, centre.z]),
            "warnings": robot.doubts(),
            "faults": robot.faults().iter().map(|fault| fault.error.to_string()).collect::<Vec<_>>(),
            "notes": robot.parts().notes,
        })
    }

    /// The robot as text.
    pub fn page(&self, paint: Paint) -> String {
        let robot = self.robot;
        let moving = robot.joints().iter().filter(|joint| joint.kind != JointType::Fixed).count();
        let (links, fixed) = (robot.links().len(), robot.joints().len() - moving);
        let name = paint.bold(robot.name());
        let mut page =
            format!("{name}: {links} links, {} that move, {fixed} fixed; root {}\n\n", joints(moving), robot.root());
        let lines = robot.outline();
        let width = lines.iter().map(|(branch, _)| branch.chars().count()).max().unwrap_or(0);
        for (branch, motion) in &lines {
            page += &format!("{}\n", format!("{branch:<width$}  {}", paint.dim(motion)).trim_end());
        }
        page += &format!("\n{}\n{}", paint.bold("ends of limbs"), wrapped(&robot.tips()));
        page += &format!("\n{}\n{}", paint.bold("leaves"), wrapped(&robot.leaves()));
        page += &format!("\n{}\n{}", paint.bold("mass"), self.weight());
        page += &listed(
            paint,
            "faults: chains without these parts are sound",
            robot.faults().iter().map(|fault| &fault.error),
        );
        page += &listed(paint, "notes", robot.parts().notes.iter());
        page += &format!("\nA chain runs from --base (default {}) to --tip{}\n", robot.root(), self.tip());
        page
    }

    /// The default tip, or a suggestion.
    fn tip(&self) -> String {
        let suggested = || {
            self.robot.suggested_tips(self.robot.root_place()).first().map(|tip| format!(", for instance --tip {tip}"))
        };
        match self.robot.path(None, None) {
            Ok(path) => format!(" (default {}, {})", path.tip, path.choice),
            Err(_) => suggested().unwrap_or_default(),
        }
    }

    fn weight(&self) -> String {
        let (Some(mass), Some(centre)) = (self.mass, self.centre) else {
            return "  not computed: see the faults\n".to_owned();
        };
        let shapes =
            |count: fn(&groebot_robot::model::Link) -> usize| self.robot.links().iter().map(count).sum::<usize>();
        let (seen, hard) = (shapes(|link| link.visuals.len()), shapes(|link| link.collisions.len()));
        let at = centre.coords.map(|x| format!("{x:.4}"));
        let mut text = format!(
            "  {:.4} kg, centre at ({}, {}, {}) m from the root; {seen} visual shapes, {hard} collision shapes\n",
            mass, at.x, at.y, at.z
        );
        let doubts = self.robot.doubts();
        text += &doubts.iter().take(LISTED).map(|doubt| format!("  {doubt}\n")).collect::<String>();
        if doubts.len() > LISTED {
            text += &format!("  and {} more\n", doubts.len() - LISTED);
        }
        text
    }
}

/// A heading and lines below it; empty without lines.
fn listed(paint: Paint, title: &str, lines: impl Iterator<Item = impl std::fmt::Display>) -> String {
    let lines: String = lines.map(|line| format!("  {line}\n")).collect();
    if lines.is_empty() { lines } else { format!("\n{}\n{lines}", paint.bold(title)) }
}

/// Names separated by commas, in lines of about a hundred characters.
fn wrapped(names: &[&str]) -> String {
    let mut lines = vec![String::new()];
    for (index, name) in names.iter().enumerate() {
        let comma = if index + 1 < names.len() { ", " } else { "" };
        if lines.last().is_some_and(|line| line.len() + name.len() > 100) {
            lines.push(String::new());
        }
        if let Some(line) = lines.last_mut() {
            *line += &format!("{name}{comma}");
        }
    }
    lines.iter().map(|line| format!("  {}\n", line.trim_end())).collect()
}
