//! Comparison of a simulated walk with its plan. Main type: [`Comparison`].

use std::fmt;

use nalgebra::Vector3;
use serde::Serialize;

use crate::gait::Footprint;
use crate::{Error, ErrorKind, Result};
use groebot_robot::motion::{Contact, Trajectory};
use groebot_robot::spatial::{Pose, angle};

/// A foot whose lowest point is at this height has left the floor \[m\].
const LIFTED: f64 = 0.005;
/// The names of the contacts of a walk.
pub const SIDES: [&str; 2] = ["left", "right"];

/// A joint: the deviation of its simulated value from its reference \[rad or m\], and the torque or force of its motor
/// \[N m or N\].
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct JointComparison {
    /// Its name.
    pub joint: String,
    /// The greatest deviation.
    pub greatest: f64,
    /// Its time \[s\].
    pub time: f64,
    /// The root mean square of the deviations.
    pub rms: f64,
    /// The greatest torque.
    pub torque: f64,
    /// The greatest deviation predicted from the motor's stiffness and the torques of the plan; only where the plan has
    /// torques.
    #[serde(rename = "predicted")]
    pub sag: Option<f64>,
    /// The root mean square of the deviation minus the predicted one.
    #[serde(rename = "unpredicted_rms")]
    pub unpredicted: Option<f64>,
}

/// The displacement of a walk, in the initial frame of the middle of the feet: forward and to the left \[m\],
/// anticlockwise \[rad\].
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Displacement {
    /// The displacement forward.
    #[serde(rename = "forward")]
    pub ahead: f64,
    /// To the left.
    pub left: f64,
    /// The rotation.
    pub turn: f64,
}

/// A simulated walk compared with its plan.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct Comparison {
    /// The joints that move, in the order of the plan.
    pub joints: Vec<JointComparison>,
    /// The distance between simulated and planned zero moment point, both relative to the supporting foot: the
    /// greatest, and the root mean square \[m\].
    pub zmp: [f64; 2],
    /// The greatest tilt of the base relative to the planned one \[rad\].
    pub tilt: f64,
    /// The planned displacement until the simulation ends.
    pub planned: Displacement,
    /// The simulated displacement.
    #[serde(rename = "simulated")]
    pub walked: Displacement,
    /// The numbers of landings, planned and simulated.
    pub landings: [usize; 2],
    /// The least height that a foot's lowest point reached in a swing \[m\]; 0 without a landing.
    pub lift: f64,
}

impl Comparison {
    /// Compares sample by sample until the simulation ends. `stiffness` is that of each joint's motor by its name \[N m/rad\],
    /// divided by the factor on the masses. The plan may have torques as `tau:JOINT`, the simulation must.
    ///
    /// # Errors
    /// [`ErrorKind::MissingKey`] for tracks that a walk or its simulation must have.
    pub fn of(plan: &Trajectory, answer: &Trajectory, stiffness: impl Fn(&str) -> f64) -> Result<Self> {
        let soles = soles(plan)?;
        let samples = answer.times.len().min(plan.times.len());
        let joints =
            (0..plan.joints.len()).filter(|joint| (1..samples).any(|row| plan.q[row][*joint] != plan.q[0][*joint]));
        let joints = joints.map(|joint| compared(plan, answer, joint, &stiffness)).collect::<Result<_>>()?;
        let own = self::soles(answer)?;
        let (landed, lift) = landings(answer, own)?;
        let planned =
            soles.iter().map(|sole| sole.stands[..samples].windows(2).filter(|pair| !pair[0] && pair[1]).count());
        Ok(Comparison {
            joints,
            zmp: zmp(plan, answer, samples)?,
            tilt: (0..samples).map(|row| tilt(&plan.base[row], &answer.base[row])).fold(0.0, f64::max),
            planned: displacement(soles, samples),
            walked: displacement(own, samples),
            landings: [planned.sum(), landed],
            lift,
        })
    }

    /// The distance of the robot's end from the planned one \[m\].
    pub fn off(&self) -> f64 {
        f64::hypot(self.walked.ahead - self.planned.ahead, self.walked.left - self.planned.left)
    }
}

/// The soles of a walk, left and right; checks that it has a base.
///
/// # Errors
/// [`ErrorKind::MissingKey`] for a trajectory that is not a walk.
pub fn soles(walk: &Trajectory) -> Result<[&Contact; 2]> {
    let sole = |name: &str| walk.contacts.iter().find(|contact| contact.name == name);
    match (sole(SIDES[0]), sole(SIDES[1]), walk.base.is_empty() || walk.times.len() < 2) {
        (Some(left), Some(right), false) => Ok([left, right]),
        _ => Err(Error::new(
            ErrorKind::MissingKey,
            "this is not a walk: a walk has two samples or more, a base, and the contacts `left` and `right`",
        )),
    }
}

fn figure<'t>(trajectory: &'t Trajectory, name: &str) -> Option<&'t [f64]> {
    trajectory.figures.iter().find(|figure| figure.name == name).map(|figure| &figure.values[..])
}

fn missing(name: &str) -> Error {
    Error::new(ErrorKind::MissingKey, format!("there is no `{name}`"))
}

fn compared(
    plan: &Trajectory,
    answer: &Trajectory,
    joint: usize,
    stiffness: &impl Fn(&str) -> f64,
) -> Result<JointComparison> {
    let name = &plan.joints[joint].name;
    let stiffness = stiffness(name);
    let own = answer.joints.iter().position(|own| own.name == *name).ok_or_else(|| missing(&format!("q:{name}")))?;
    let key = format!("tau:{name}");
    let torques = figure(answer, &key).ok_or_else(|| missing(&key))?;
    let deviations: Vec<f64> = answer.q.iter().zip(&plan.q).map(|(is, should)| is[own] - should[joint]).collect();
    // The torque of a servo is its stiffness times the joint's deviation.
    let sags: Option<Vec<f64>> =
        figure(plan, &key).map(|torques| torques.iter().map(|torque| -torque / stiffness).collect());
    let at = greatest(&deviations);
    let differences = |sags: &Vec<f64>| rms(deviations.iter().zip(sags).map(|(deviation, sag)| deviation - sag));
    Ok(JointComparison {
        joint: name.clone(),
        greatest: deviations[at],
        time: answer.times[at],
        rms: rms(deviations.iter().copied()),
        torque: torques[greatest(torques)],
        unpredicted: sags.as_ref().map(differences),
        sag: sags.map(|sags| sags[greatest(&sags[..deviations.len()])]),
    })
}

/// The index of the value with the greatest magnitude.
fn greatest(values: &[f64]) -> usize {
    (0..values.len()).max_by(|a, b| values[*a].abs().total_cmp(&values[*b].abs())).unwrap_or(0)
}

fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (count, sum) = values.fold((0.0, 0.0), |(count, sum), value| (count + 1.0, sum + value * value));
    if count > 0.0 { f64::sqrt(sum / count) } else { 0.0 }
}

/// The greatest distance between simulated and planned zero moment point, and the root mean square.
fn zmp(plan: &Trajectory, answer: &Trajectory, samples: usize) -> Result<[f64; 2]> {
    let point =
        |walk: &Trajectory| walk.points.iter().position(|point| point.name == "zmp").ok_or_else(|| missing("zmp_x"));
    let (should, is) = (point(plan)?, point(answer)?);
    let (soles, own) = (soles(plan)?, self::soles(answer)?);
    let distance = |row: usize| {
        let side = usize::from(!soles[0].stands[row]);
        let seen = |sole: &Contact, walk: &Trajectory, point: usize| {
            Footprint::below(&sole.poses[row]).seen(&walk.points[point].at[row].xy())
        };
        (seen(own[side], answer, is) - seen(soles[side], plan, should)).norm()
    };
    let distances: Vec<f64> = (0..samples).map(distance).collect();
    Ok([distances[greatest(&distances)], rms(distances.iter().copied())])
}

/// The middle of the feet at a sample.
fn middle(soles: [&Contact; 2], row: usize) -> Footprint {
    let [left, right] = soles.map(|sole| Footprint::below(&sole.poses[row]));
    left.middle(&right)
}

/// The displacement of the middle of the feet; the heading is tracked from sample to sample.
fn displacement(soles: [&Contact; 2], samples: usize) -> Displacement {
    let seen = middle(soles, 0).seen(&middle(soles, samples - 1).point());
    let turn = (1..samples).map(|row| angle::wrap(middle(soles, row).yaw - middle(soles, row - 1).yaw)).sum();
    Displacement { ahead: seen.x, left: seen.y, turn }
}

/// The angle between the up axes of two bases.
fn tilt(one: &Pose, other: &Pose) -> f64 {
    let [one, other] = [one, other].map(|pose| pose.rotation.inverse() * Vector3::z());
    one.dot(&other).clamp(-1.0, 1.0).acos()
}

/// The number of landings after a foot was in the air, and the least height that a foot reached in between \[m\].
fn landings(answer: &Trajectory, soles: [&Contact; 2]) -> Result<(usize, f64)> {
    let (mut count, mut least) = (0, f64::INFINITY);
    for (sole, side) in soles.into_iter().zip(SIDES) {
        let key = format!("{side}_clearance");
        let heights = figure(answer, &key).ok_or_else(|| missing(&key))?;
        let mut highest: f64 = 0.0;
        for (height, stands) in heights.iter().zip(&sole.stands) {
            highest = highest.max(*height);
            if *stands && highest > LIFTED {
                count += 1;
                least = least.min(highest);
            }
            if *stands {
                highest = 0.0;
            }
        }
    }
    Ok((count, if count > 0 { least } else { 0.0 }))
}

impl fmt::Display for Comparison {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let displacement = |displacement: &Displacement| {
            format!(
                "{:.3} m forward, {:.3} m to the left, turn {:.1} deg",
                displacement.ahead,
                displacement.left,
                displacement.turn.to_degrees()
            )
        };
        writeln!(f, "  planned         {}, {} landings", displacement(&self.planned), self.landings[0])?;
        writeln!(f, "  walked          {}, {} landings", displacement(&self.walked), self.landings[1])?;
        writeln!(f, "  tilt            {:.2} deg at most", self.tilt.to_degrees())?;
        writeln!(f, "  least lift      {:.1} mm", 1e3 * self.lift)?;
        let [greatest, rms] = self.zmp.map(|distance| 1e3 * distance);
        writeln!(
            f,
            "  ZMP             off by {rms:.1} mm rms, {greatest:.1} mm at most, by contact forces, relative to the supporting foot"
        )?;
        let width = self.joints.iter().map(|joint| joint.joint.chars().count()).max().unwrap_or(0).max(5);
        writeln!(
            f,
            "  {:<width$}  deviation [mrad]       rms   torque [N m]   predicted sag   rms of the rest",
            "joint"
        )?;
        for joint in &self.joints {
            let milli = |value: Option<f64>| value.map_or("-".to_owned(), |value| format!("{:.2}", 1e3 * value));
            writeln!(
                f,
                "  {:<width$}  {:>16.2}  {:>8.2}  {:>13.2}  {:>13}  {:>16}",
                joint.joint,
                1e3 * joint.greatest,
                1e3 * joint.rms,
                joint.torque,
                milli(joint.sag),
                milli(joint.unpredicted)
            )?;
        }
        Ok(())
    }
}
