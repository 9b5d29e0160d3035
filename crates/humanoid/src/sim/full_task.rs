//! The full task of RH0 5.5: a robot gets through a furnished room, goal and furniture change on the way, and all of it is checked. Main function: [`perform`].

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

/// What becomes another one on the way.
#[derive(Clone, Debug, PartialEq)]
pub enum What {
    /// The goal.
    Goal(Destination),
    /// A piece of furniture, by its name: it stands elsewhere \[m\], turned anticlockwise \[rad\], or nowhere.
    Furniture(String, Option<Footprint>),
}

/// A change on the way.
#[derive(Clone, Debug, PartialEq)]
pub struct Change {
    /// It comes behind so many steps.
    pub after: usize,
    /// What changes.
    pub what: What,
}

/// A way that was found, and what it holds for.
#[derive(Clone, Debug, PartialEq)]
pub struct Stage {
    /// The first sample of the walk that it holds for.
    pub first: usize,
    /// How many steps had been taken.
    pub steps: usize,
    /// The room.
    pub room: Room,
    /// The way.
    pub course: Course,
    /// How long it took to find the way, with the map where the room is another one \[ms\].
    pub milliseconds: f64,
}

/// A task that was done.
#[derive(Clone, Debug)]
pub struct Performed {
    /// The walk.
    pub walk: Walk,
    /// The ways, in turn.
    pub stages: Vec<Stage>,
}

/// Lets a run that stands at its start get to its goal, with changes in the order of their steps; where a change leaves no way, why. A robot that was upright rises in the end.
///
/// # Errors
/// [`ErrorKind::BadValue`] for a change that comes behind the last step; as [`Run::step`] and [`Run::change`].
pub fn perform(mut run: Run, changes: &[Change], watch: &Watch) -> Result<std::result::Result<Performed, Blocked>> {
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
        let text =
            format!("it arrives behind step {steps}; what is to change behind step {} never comes", change.after);
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

/// Finds the way through a room to a goal, and notes it; or why there is none.
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
    /// Its room and its ways, as they are written.
    pub fn record(&self) -> TaskRecord {
        let stage = |own: &Stage| RecordedStage {
            from: self.walk.time(own.first),
            steps: own.steps,
            goal: own.course.goal.numbers(),
            way: own.course.way.points.iter().map(|point| [point.x, point.y]).collect(),
            pieces: Interior::of(&own.room).pieces,
            milliseconds: own.milliseconds,
        };
        TaskRecord { scene: Interior::of(&self.stages[0].room), stages: self.stages.iter().map(stage).collect() }
    }
}

/// What a task that was done is asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct Checks {
    /// How near each link comes to each thing, nearest first.
    pub clearances: Vec<Clearance>,
    /// How far corners of soles that stand are off the floor at most, by forward kinematics \[m\].
    pub soles_off: f64,
    /// How deep corners of soles that swing are under the floor at most, by forward kinematics \[m\].
    pub soles_under: f64,
    /// The least margin of the zero moment point \[m\].
    pub margin: f64,
    /// The joint that turns fastest \[rad/s\].
    pub fastest: (String, f64),
    /// Joints beyond limits or speeds, and margins below zero.
    pub findings: Vec<Finding>,
    /// The least and the greatest number of samples of a step.
    pub samples_per_step: (usize, usize),
}

/// Soles that stand may be so far off the floor \[m\]: near a stretched knee the closed form has half of the digits, 6e-9 m in 200 rooms.
const OFF: f64 = 1e-6;

impl Checks {
    /// Those of a task of `robot`, at all its samples.
    ///
    /// # Errors
    /// As [`Links::of`] and [`Links::clearances`].
    pub fn of(robot: &Robot, meshes: &Meshes, biped: &Biped, performed: &Performed, watch: &Watch) -> Result<Self> {
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

    /// Whether nothing meets, soles that stand are on the floor, and balance, limits and speeds are kept.
    pub fn hold(&self) -> bool {
        self.clearances.iter().all(|own| own.distance > 0.0)
            && self.soles_off <= OFF
            && self.soles_under <= OFF
            && self.margin > 0.0
            && self.findings.is_empty()
    }
}

/// How far soles are off the floor where they stand, and under it where they swing.
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

/// The joint that turns fastest, and how fast.
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
