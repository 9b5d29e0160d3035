//! The full task of RH0 5.5: a robot walks through a furnished room, goal and furniture change during the walk, and the
//! result is checked. Main function: [`perform`].

use std::time::Instant;

use nalgebra::Point3;

use super::clearance::{Clearance, Links};
use super::destination::Destination;
use super::interior::Interior;
use super::record::{RecordedStage, TaskRecord};
use super::run::{Next, Run};
use crate::gait::{Action, Biped, Footprint, Side, Walk};
use crate::nav::Room;
use crate::task::{Blocked, Course};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_robot::model::{Meshes, Robot};
use groebot_robot::motion::{Bounds, Finding, findings};

/// A change during the walk.
#[derive(Clone, Debug, PartialEq)]
pub enum What {
    /// The goal.
    Goal(Destination),
    /// A piece of furniture, by its name: its new position \[m\] with its anticlockwise rotation, or its removal.
    Furniture(String, Option<Footprint>),
}

/// A change at a step.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// The number of steps before it.
    pub after: usize,
    /// The change.
    pub what: What,
}

/// A path that was found, and the conditions that it holds for.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Stage {
    /// The first sample of the walk on this path.
    pub first: usize,
    /// The number of steps taken before.
    pub steps: usize,
    /// The room.
    pub room: Room,
    /// The path.
    pub course: Course,
    /// The time to find the path, including the map of a changed room \[ms\].
    pub milliseconds: f64,
}

/// A completed task.
#[derive(Clone, Debug)]
#[non_exhaustive]
pub struct Performed {
    /// The walk.
    pub walk: Walk,
    /// The paths in order.
    pub stages: Vec<Stage>,
}

/// Runs a task from its start to its goal, with changes in the order of their steps. Returns the proof where a change
/// leaves no path. A robot that was upright rises at the end.
///
/// # Errors
/// [`ErrorKind::BadValue`] for a change after the last step; as [`Run::step`] and [`Run::change`].
pub fn perform<'w>(
    mut run: Run,
    changes: &[Change],
    watch: impl Into<Option<&'w Watch>>,
) -> Result<std::result::Result<Performed, Blocked>> {
    let watch = Watch::or_none(watch);
    let mut stages = Vec::new();
    let mut left = changes.iter().peekable();
    loop {
        let steps = run.walk().schedule.route.steps.len();
        let (mut room, mut goal, mut is_new) = (run.room().clone(), run.goal().clone(), stages.is_empty());
        while let Some(change) = left.next_if(|change| change.after <= steps) {
            (room, goal) = change.made(room, goal)?;
            is_new = true;
        }
        if is_new && let Some(blocked) = plan(&mut run, &mut stages, room, goal, watch)? {
            return Ok(Err(blocked));
        }
        if run.step(watch)? == Next::Arrived {
            break;
        }
        watch.report("steps", run.walk().schedule.route.steps.len(), 0);
    }
    if let Some(change) = left.next() {
        let steps = run.walk().schedule.route.steps.len();
        let text = format!("it arrives after step {steps}; the change after step {} never happens", change.after);
        return Err(Error::new(ErrorKind::BadValue, text));
    }
    Ok(Ok(Performed { walk: run.finish(watch)?, stages }))
}

impl Change {
    fn made(&self, room: Room, goal: Destination) -> Result<(Room, Destination)> {
        match &self.what {
            What::Goal(goal) => Ok((room, goal.clone())),
            What::Furniture(name, Some(at)) => Ok((room.with_moved(name, at.point(), at.yaw)?, goal)),
            What::Furniture(name, None) => Ok((room.without(name)?, goal)),
        }
    }
}

/// Finds the path through a room to a goal and records it; or the proof that none exists.
fn plan(
    run: &mut Run,
    stages: &mut Vec<Stage>,
    room: Room,
    goal: Destination,
    watch: &Watch,
) -> Result<Option<Blocked>> {
    let begun = Instant::now();
    run.change(room, goal, watch)?;
    let milliseconds = 1e3 * begun.elapsed().as_secs_f64();
    let course = match run.course() {
        Ok(course) => course.clone(),
        Err(blocked) => return Ok(Some(blocked.clone())),
    };
    let walk = run.walk();
    stages.push(Stage {
        first: if stages.is_empty() { 0 } else { walk.references.len() - 1 },
        steps: walk.schedule.route.steps.len(),
        room: run.room().clone(),
        course,
        milliseconds,
    });
    Ok(None)
}

impl Performed {
    /// Its room and its paths, in the form of the JSON file.
    pub fn record(&self) -> TaskRecord {
        let stage = |own: &Stage| RecordedStage {
            from: self.walk.time(own.first),
            steps: own.steps,
            goal: own.course.goal.numbers(),
            path: own.course.path.points.iter().map(|point| [point.x, point.y]).collect(),
            pieces: Interior::of(&own.room).pieces,
            milliseconds: own.milliseconds,
        };
        TaskRecord { scene: Interior::of(&self.stages[0].room), stages: self.stages.iter().map(stage).collect() }
    }
}

/// The checks of a completed task.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Checks {
    /// The least distance of each link from each object, nearest first.
    pub clearances: Vec<Clearance>,
    /// The greatest distance of the corners of supporting soles from the floor, by forward kinematics \[m\].
    pub soles_off: f64,
    /// The greatest depth of the corners of swinging soles below the floor, by forward kinematics \[m\].
    pub soles_under: f64,
    /// The least margin of the zero moment point \[m\].
    pub margin: f64,
    /// The joint with the greatest rate \[rad/s\].
    pub fastest: (String, f64),
    /// Joints beyond limits or rates, and margins below zero.
    pub findings: Vec<Finding>,
    /// The least and the greatest number of samples of a step.
    pub samples_per_step: (usize, usize),
}

/// The permitted distance of supporting soles from the floor \[m\]. Near a stretched knee the closed form has half of
/// the digits: 6e-9 m in 200 rooms.
const OFF: f64 = 1e-6;

impl Checks {
    /// Checks a task of `robot` at all its samples.
    ///
    /// # Errors
    /// As [`Links::of`] and [`Links::clearances`].
    pub fn of<'w>(
        robot: &Robot,
        meshes: &Meshes,
        biped: &Biped,
        performed: &Performed,
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<Self> {
        let watch = Watch::or_none(watch);
        let Performed { walk, stages } = performed;
        let links = Links::of(robot, biped, meshes)?;
        let ends = stages.iter().skip(1).map(|stage| stage.first + 1).chain([walk.references.len()]);
        let mut clearances: Vec<Clearance> = Vec::new();
        for (stage, end) in stages.iter().zip(ends) {
            let postures = &walk.motion.postures[stage.first..end];
            clearances.extend(links.clearances(biped, postures, stage.first, &stage.room, watch)?);
        }
        clearances.sort_by(|a, b| a.distance.total_cmp(&b.distance));
        let mut known = std::collections::HashSet::new();
        clearances.retain(|own| known.insert((own.link.clone(), own.thing.clone())));
        let (soles_off, soles_under) = soles(biped, walk)?;
        let trajectory = walk.trajectory(biped);
        Ok(Checks {
            clearances,
            soles_off,
            soles_under,
            margin: walk.balances.iter().map(|balance| balance.margin).fold(f64::INFINITY, f64::min),
            fastest: fastest(biped, walk),
            findings: findings(&trajectory, &Bounds::default()),
            samples_per_step: samples_per_step(walk),
        })
    }

    /// Whether there is no collision, supporting soles are on the floor, and balance, limits and rates are kept.
    pub fn hold(&self) -> bool {
        self.clearances.iter().all(|own| own.distance > 0.0)
            && self.soles_off <= OFF
            && self.soles_under <= OFF
            && self.margin > 0.0
            && self.findings.is_empty()
    }
}

/// The greatest distance of supporting soles from the floor, and the greatest depth of swinging soles below it.
fn soles(biped: &Biped, walk: &Walk) -> Result<(f64, f64)> {
    let (mut off, mut under) = (0.0_f64, 0.0_f64);
    for (reference, posture) in walk.references.iter().zip(&walk.motion.postures) {
        let placed = biped.model.place(&posture.world_from_torso, &posture.q)?;
        for side in [Side::Left, Side::Right] {
            let foot = &biped.feet[side as usize];
            let world_from_sole = placed.motion(foot.body) * foot.torso_from_sole;
            let heights = foot.corners.iter().map(|at| (world_from_sole * Point3::new(at.x, at.y, 0.0)).z);
            for height in heights {
                if reference.stands[side as usize] {
                    off = off.max(height.abs());
                } else {
                    under = under.max(-height);
                }
            }
        }
    }
    Ok((off, under))
}

/// The joint with the greatest rate, and that rate.
fn fastest(biped: &Biped, walk: &Walk) -> (String, f64) {
    let rate = |joint: usize| {
        let pairs = walk.motion.postures.windows(2);
        pairs.map(|pair| (pair[1].q[joint] - pair[0].q[joint]).abs() / walk.schedule.tick).fold(0.0, f64::max)
    };
    let rates = (0..biped.joints.len()).map(|joint| (biped.joints[joint].name.clone(), rate(joint)));
    rates.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or_default()
}

fn samples_per_step(walk: &Walk) -> (usize, usize) {
    let mut counts = vec![0; walk.schedule.route.steps.len()];
    for phase in &walk.schedule.phases {
        if let Action::Shift(step) | Action::Swing(step) | Action::Balance(step) = phase.action {
            counts[step] += phase.samples;
        }
    }
    (counts.iter().copied().min().unwrap_or(0), counts.iter().copied().max().unwrap_or(0))
}
