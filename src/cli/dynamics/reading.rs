//! The assignment of a table's columns to joints. Main type: [`Reading`].

use crate::{Error, ErrorKind, Result};
use groebot_robot::document::shown;
use groebot_robot::dynamics::Base;
use groebot_robot::model::Robot;
use groebot_robot::motion::{StateRow, StateTable};

/// The numbers of positions and of velocities of a free root.
const ROOT: (usize, usize) = (7, 6);

/// The joints of a table's columns, and whether the root moves freely.
pub struct Reading {
    pub joints: Vec<String>,
    /// The mimic joints of the robot, if each joint is independent here.
    pub followers: Vec<String>,
    pub base: Base,
}

impl Reading {
    /// The only assignment that the columns permit; `floating` requests a free root.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] where none or several are possible, with the joints.
    pub fn choose(robot: &Robot, table: &StateTable, floating: bool) -> Result<Self> {
        let all = Reading::all(robot);
        let independent = all[0].joints.clone();
        let mut fitting: Vec<Reading> = all
            .into_iter()
            .filter(|reading| (!floating || reading.base == Base::Floating) && reading.places(table))
            .collect();
        if fitting.len() > 1 && fitting.iter().any(|reading| reading.moves(&table.rows[0])) {
            fitting.retain(|reading| reading.moves(&table.rows[0]));
        }
        let text = match fitting.len() {
            1 => return Ok(fitting.remove(0)),
            0 => {
                let free = if floating {
                    "7 numbers of its free root come first"
                } else {
                    "7 more come first where its root moves freely"
                };
                let (count, names) = (independent.len(), listed(&independent));
                format!(
                    "{} columns q0.. are given; the robot has {count} independent joints ({names}), and {free}",
                    table.coordinates
                )
            }
            _ => {
                let readings: Vec<String> = fitting.iter().map(Reading::in_words).collect();
                format!(
                    "{} columns q0.. are given, which may be {}; give --floating, or name the joints: q:NAME",
                    table.coordinates,
                    readings.join(", or ")
                )
            }
        };
        Err(Error::new(ErrorKind::BadValue, text))
    }

    /// The independent joints, and all joints as independent ones, each with a fixed root and a floating one.
    fn all(robot: &Robot) -> Vec<Reading> {
        let moving = || robot.moving().into_iter().map(|place| &robot.joints()[place]);
        let follows = |name: &String| moving().any(|joint| joint.name == *name && robot.law(joint).leader != *name);
        let (followers, leaders): (Vec<String>, Vec<String>) =
            moving().map(|joint| joint.name.clone()).partition(follows);
        let own = || moving().map(|joint| joint.name.clone()).collect();
        let mut all = Vec::new();
        for base in [Base::Fixed, Base::Floating] {
            all.push(Reading { joints: leaders.clone(), followers: Vec::new(), base });
            if !followers.is_empty() {
                all.push(Reading { joints: own(), followers: followers.clone(), base });
            }
        }
        all
    }

    /// Whether the table's configurations fit this assignment.
    fn places(&self, table: &StateTable) -> bool {
        let root = if self.base == Base::Floating { ROOT.0 } else { 0 };
        let is_own = |name: &String| self.joints.contains(name);
        let are_named = table.numbered == root && table.joints.iter().all(is_own);
        table.coordinates == root + self.joints.len() && (table.joints.is_empty() || are_named)
    }

    /// Whether the other lists of a state fit it.
    fn moves(&self, row: &StateRow) -> bool {
        let root = if self.base == Base::Floating { ROOT.1 } else { 0 };
        let lists = [&row.velocity, &row.acceleration, &row.torques];
        lists.into_iter().flatten().all(|list| list.len() == root + self.joints.len())
    }

    fn in_words(&self) -> String {
        let joints = match self.followers.as_slice() {
            [] => format!("{} independent joints", self.joints.len()),
            _ => format!("{} joints, all independent", self.joints.len()),
        };
        if self.base == Base::Floating { format!("{joints} of a free root") } else { joints }
    }

    /// A note that mimic joints are independent here.
    pub fn note(&self) -> Option<String> {
        let text = || {
            format!(
                "the table has columns for joints that follow others; they are taken as independent: {}",
                listed(&self.followers)
            )
        };
        (!self.followers.is_empty()).then(text)
    }
}

fn listed(names: &[String]) -> String {
    names.iter().map(|name| shown(name)).collect::<Vec<_>>().join(", ")
}
