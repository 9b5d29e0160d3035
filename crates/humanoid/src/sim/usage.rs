//! How close a simulated walk comes to falling and to the limits of the motors. Main type: [`Usage`].

use std::fmt;

use serde::Serialize;

use super::answer::soles;
use crate::Result;
use crate::gait::{Biped, Side};
use groebot_robot::motion::Trajectory;

/// A sole within this height of the lowest one carries weight \[m\].
const DEPTH: f64 = 0.005;

/// A joint, and the greatest fraction of a limit that it uses.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Greatest {
    /// Its name.
    pub joint: String,
    /// The fraction; 1 is the limit.
    pub fraction: f64,
    /// The time \[s\].
    pub time: f64,
}

/// What a simulated walk uses of its support and its motors.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Usage {
    /// The least signed distance of the zero moment point, by contact forces, from the border of the soles that stand \[m\], and its time \[s\].
    pub margin: Option<(f64, f64)>,
    /// The greatest fraction of an effort limit; only where the description has one.
    pub torque: Option<Greatest>,
    /// The greatest fraction of a velocity limit; only where the description has one.
    pub speed: Option<Greatest>,
}

impl Usage {
    /// What a simulation of `biped` uses. The soles of `answer` are its frames of soles; torques are its figures `tau:JOINT`.
    ///
    /// # Errors
    /// [`crate::ErrorKind::MissingKey`] for a trajectory that is not a walk.
    pub fn of(biped: &Biped, answer: &Trajectory) -> Result<Self> {
        let contacts = soles(answer)?;
        let zmp = answer.points.iter().find(|point| point.name == "zmp");
        let margin = |row: usize| {
            let standing: Vec<_> = [Side::Left, Side::Right]
                .into_iter()
                .filter(|side| contacts[*side as usize].stands[row])
                .map(|side| (side, contacts[side as usize].poses[row]))
                .collect();
            let at = zmp.filter(|_| !standing.is_empty())?.at[row].xy();
            Some((biped.support(&standing, DEPTH).signed_distance(&at), answer.times[row]))
        };
        let rates: Vec<Vec<f64>> = (0..answer.times.len()).map(|row| answer.rates(row)).collect();
        let torques = biped.joints.iter().filter_map(|joint| {
            let name = format!("tau:{}", joint.name);
            let figure = answer.figures.iter().find(|figure| figure.name == name)?;
            greatest(&joint.name, joint.effort?, &answer.times, |row| figure.values[row])
        });
        let speeds = biped.joints.iter().filter_map(|joint| {
            let column = answer.joints.iter().position(|own| own.name == joint.name)?;
            greatest(&joint.name, joint.speed, &answer.times, |row| rates[row][column])
        });
        Ok(Usage {
            // At the first row the robot touches the floor without forces.
            margin: (1..answer.times.len()).filter_map(margin).min_by(|a, b| a.0.total_cmp(&b.0)),
            torque: torques.max_by(|a, b| a.fraction.total_cmp(&b.fraction)),
            speed: speeds.max_by(|a, b| a.fraction.total_cmp(&b.fraction)),
        })
    }
}

/// The greatest magnitude of a value as a fraction of its limit, if it has one.
fn greatest(joint: &str, limit: f64, times: &[f64], value: impl Fn(usize) -> f64) -> Option<Greatest> {
    let row = (0..times.len()).max_by(|a, b| value(*a).abs().total_cmp(&value(*b).abs()))?;
    let fraction = value(row).abs() / limit;
    limit.is_finite().then(|| Greatest { joint: joint.to_owned(), fraction, time: times[row] })
}

impl fmt::Display for Usage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some((margin, time)) = self.margin {
            writeln!(
                f,
                "  least margin    {:.1} mm at {time:.2} s (ZMP by contact forces, border of the soles)",
                1e3 * margin
            )?;
        }
        for (name, of) in [("torques", &self.torque), ("speeds", &self.speed)] {
            if let Some(Greatest { joint, fraction, time }) = of {
                writeln!(f, "  {name:<14}  {joint} uses {:.0} % of its limit at {time:.2} s", 1e2 * fraction)?;
            }
        }
        Ok(())
    }
}
