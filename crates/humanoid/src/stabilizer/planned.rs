//! The planned walk as a function of time. Main type: [`PlannedWalk`].

use nalgebra::{Point2, Point3, UnitQuaternion, Vector3};

use crate::gait::{Posture, Walker};
use crate::sim::soles;
use crate::{Error, ErrorKind, Result};
use groebot_robot::motion::Trajectory;
use groebot_robot::spatial::Pose;

/// The planned walk at one time.
#[derive(Clone, Debug)]
pub(super) struct Instant {
    /// The torso's pose and all joint values.
    pub posture: Posture,
    /// The poses of the soles in the world, left and right.
    pub soles: [Pose; 2],
    /// Whether the soles stand.
    pub stands: [bool; 2],
    /// The centre of mass \[m\].
    pub centre: Point3<f64>,
    /// Its velocity \[m/s\].
    pub velocity: Vector3<f64>,
    /// The zero moment point \[m\].
    pub zmp: Point2<f64>,
}

impl Instant {
    /// The height of the centre of mass above the lower sole \[m\].
    pub fn height(&self) -> f64 {
        self.centre.z - self.soles[0].translation.z.min(self.soles[1].translation.z)
    }
}

/// A planned walk. Its times start at zero.
#[derive(Clone, Debug)]
pub(super) struct PlannedWalk {
    times: Vec<f64>,
    rows: Vec<Instant>,
    /// The factor on the speed of the walk at which the fastest joint reaches its speed limit, at least 1.
    pub spare: f64,
}

impl PlannedWalk {
    /// The walk of a walker. Joints that the walk does not have are as in the walker's crouch.
    pub fn new(walker: &Walker, walk: &Trajectory) -> Result<Self> {
        let contacts = soles(walk)?;
        let zmp = walk.points.iter().find(|point| point.name == "zmp").ok_or_else(|| {
            Error::new(ErrorKind::MissingKey, "the walk has no `zmp_x` and `zmp_y`; feedback needs the planned ZMP")
        })?;
        let joints: Vec<(usize, usize)> = walk
            .joints
            .iter()
            .enumerate()
            .map(|(column, joint)| Ok((column, walker.biped.joint(&joint.name)?)))
            .collect::<Result<_>>()?;
        let crouch = walker.legs.crouch();
        let root_from_torso = walker.biped.torso_from_root.inverse();
        let row = |row: usize| {
            let mut posture = Posture { world_from_torso: walk.base[row] * root_from_torso, q: crouch.q.clone() };
            joints.iter().for_each(|(column, joint)| posture.q[*joint] = walk.q[row][*column]);
            let centre = walker.biped.model.place(&posture.world_from_torso, &posture.q)?.centre_of_mass();
            Ok(Instant {
                posture,
                soles: contacts.map(|contact| contact.poses[row]),
                stands: contacts.map(|contact| contact.stands[row]),
                centre,
                velocity: Vector3::zeros(),
                zmp: zmp.at[row].xy(),
            })
        };
        let mut rows = (0..walk.times.len()).map(row).collect::<Result<Vec<Instant>>>()?;
        if let Some(row) = rows.iter().position(|row| row.height().is_nan() || row.height() <= 0.0) {
            let text = format!(
                "the centre of mass is not above the soles at {} s; is this a walk of {}?",
                walk.times[row], walker.biped.name
            );
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        for at in 1..rows.len().saturating_sub(1) {
            let time = walk.times[at + 1] - walk.times[at - 1];
            rows[at].velocity = (rows[at + 1].centre - rows[at - 1].centre) / time;
        }
        let used = |(at, pair): (usize, &[Instant])| {
            let time = walk.times[at + 1] - walk.times[at];
            let moved = pair[0].posture.q.iter().zip(&pair[1].posture.q).map(|(from, to)| (to - from).abs() / time);
            moved.zip(&walker.biped.joints).map(|(rate, joint)| rate / joint.speed).fold(0.0, f64::max)
        };
        let fastest = rows.windows(2).enumerate().map(used).fold(0.0, f64::max);
        let times = walk.times.iter().map(|time| time - walk.times[0]).collect();
        Ok(PlannedWalk { times, rows, spare: fastest.recip().max(1.0) })
    }

    /// The walk at a time, by linear interpolation; before its start and after its end it stands.
    pub fn at(&self, time: f64) -> Instant {
        let after = self.times.partition_point(|own| *own <= time);
        if after == 0 || after == self.times.len() {
            let row = if after == 0 { &self.rows[0] } else { &self.rows[after - 1] };
            return Instant { velocity: Vector3::zeros(), ..row.clone() };
        }
        let (one, other) = (&self.rows[after - 1], &self.rows[after]);
        let share = (time - self.times[after - 1]) / (self.times[after] - self.times[after - 1]);
        let between = |one: &Pose, other: &Pose| {
            let at = one.translation.vector.lerp(&other.translation.vector, share);
            // Tables have quaternions with nine decimals.
            let turn = UnitQuaternion::new_normalize(one.rotation.slerp(&other.rotation, share).into_inner());
            Pose::from_parts(at.into(), turn)
        };
        let torso = between(&one.posture.world_from_torso, &other.posture.world_from_torso);
        let q = one.posture.q.iter().zip(&other.posture.q).map(|(from, to)| from + share * (to - from)).collect();
        Instant {
            posture: Posture { world_from_torso: torso, q },
            soles: [0, 1].map(|side| between(&one.soles[side], &other.soles[side])),
            stands: one.stands,
            centre: one.centre + share * (other.centre - one.centre),
            velocity: one.velocity.lerp(&other.velocity, share),
            zmp: one.zmp + share * (other.zmp - one.zmp),
        }
    }

    /// The time at which a foot that swings at `time` stands again.
    pub fn landing(&self, side: usize, time: f64) -> Option<f64> {
        let from = self.times.partition_point(|own| *own <= time);
        let row = (from..self.rows.len()).find(|row| self.rows[*row].stands[side])?;
        Some(self.times[row])
    }

    /// How long a foot that swings at `time` will swing \[s\], and the fraction of its whole swing.
    pub fn swing_left(&self, side: usize, time: f64) -> Option<(f64, f64)> {
        let landing = self.landing(side, time)?;
        let from = self.times.partition_point(|own| *own <= time);
        let lift = (0..from).rev().find(|row| self.rows[*row].stands[side]).map_or(0.0, |row| self.times[row]);
        Some((landing - time, (landing - time) / (landing - lift)))
    }

    /// The next time at which a foot leaves the floor, and its side.
    pub fn lift(&self, time: f64) -> Option<(f64, usize)> {
        let from = self.times.partition_point(|own| *own <= time);
        let row = (from..self.rows.len()).find(|row| self.rows[*row].stands.contains(&false))?;
        Some((self.times[row], usize::from(self.rows[row].stands[0])))
    }
}
