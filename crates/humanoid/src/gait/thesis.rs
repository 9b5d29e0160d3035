//! A walk in the columns of the thesis' tables, RH0 Fig. 5-16: degrees, and the axes x to the left, y up, z forward.

use std::fmt::Write;

use nalgebra::Point3;

use super::biped::Biped;
use super::footprint::Side;
use super::plan::Walk;
use crate::{Error, ErrorKind, Result};
use groebot_robot::motion::table::decimal;

/// The joints in the thesis' order: the right leg from the foot up, then the left one.
const JOINTS: [&str; 12] = ["1", "2", "3", "4", "5", "6", "12", "11", "10", "9", "8", "7"];
/// The columns after the joints. `ZMP` in the thesis' tables is the centre of mass, at its height.
const PLACES: [&str; 12] = [
    "X_right_foot",
    "Y_right_foot",
    "Z_right_foot",
    "X_left_foot",
    "Y_left_foot",
    "Z_left_foot",
    "X_CM",
    "Y_CM",
    "Z_CM",
    "X_ZMP",
    "Y_ZMP",
    "Z_ZMP",
];

impl Walk {
    /// The walk as CSV in the columns of RH0 Fig. 5-16. They are `t` \[s\]; `q1`..`q6`, `q12`..`q7` \[degrees\]; the
    /// ankles' points of both feet, the centre of mass and the zero moment point in the thesis' axes \[m\]. Heights are
    /// relative to the ankles of supporting feet.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] when the robot's joints do not have the thesis' numbers.
    pub fn to_thesis_csv(&self, biped: &Biped) -> Result<String> {
        let joint = |symbol: &&str| {
            let missing = || {
                let text = format!("{} has no joint {symbol} of the thesis; its tables are for rh0", biped.name);
                Error::new(ErrorKind::UnknownName, text)
            };
            let named = |joint: &usize| biped.joints[*joint].symbol == **symbol;
            let mut found = (0..biped.joints.len()).filter(named);
            let first = found.next().ok_or_else(missing)?;
            if found.next().is_none() { Ok(first) } else { Err(missing()) }
        };
        let joints = JOINTS.iter().map(joint).collect::<Result<Vec<_>>>()?;
        let names = JOINTS.iter().map(|symbol| format!("q{symbol}"));
        let places = PLACES.iter().map(|name| (*name).to_owned());
        let mut text = ["t".to_owned()].into_iter().chain(names).chain(places).collect::<Vec<_>>().join(",");
        text.push('\n');
        for sample in 0..self.balances.len() {
            // Writing to a string cannot fail.
            let _ = write!(text, "{}", self.time(sample));
            let values = joints.iter().map(|joint| self.motion.postures[sample].q[*joint].to_degrees());
            for value in values.chain(self.places(biped, sample)) {
                let _ = write!(text, ",{}", decimal(value));
            }
            text.push('\n');
        }
        Ok(text)
    }

    /// The values of the columns [`PLACES`].
    fn places(&self, biped: &Biped, sample: usize) -> Vec<f64> {
        let height = biped.feet[0].ankle_height;
        let turned = |point: Point3<f64>| [point.y, point.z - height, point.x];
        let ankle = |side: Side| {
            let sole = self.references[sample].world_from_soles[side as usize];
            turned(sole * Point3::new(0.0, 0.0, height))
        };
        let zmp = self.balances[sample].zmp;
        let places = [
            ankle(Side::Right),
            ankle(Side::Left),
            turned(self.motion.centres[sample]),
            turned(Point3::new(zmp.x, zmp.y, height)),
        ];
        places.concat()
    }
}
