//! A motion as data. Main type: [`Trajectory`].

use nalgebra::Point3;
use serde::{Deserialize, Serialize};

use crate::spatial::Pose;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::limits::{COLUMNS, LARGEST, check_count, check_name};

/// Maximum number of samples of a trajectory.
pub const MOST_SAMPLES: usize = groebot_algebra::limits::SAMPLES;
/// Minimum time between two samples \[s\], since tables have nine decimals.
const LEAST_STEP: f64 = 1e-8;

/// A joint of a trajectory: its name, its type and its bounds.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct JointTrack {
    /// Its name in the robot.
    pub name: String,
    /// Whether it is prismatic; else it is revolute.
    #[serde(default)]
    pub slides: bool,
    /// Minimum and maximum value \[rad or m\].
    #[serde(default)]
    pub limits: Option<(f64, f64)>,
    /// Maximum velocity \[rad/s or m/s\].
    #[serde(default)]
    pub speed: Option<f64>,
}

impl JointTrack {
    /// `rad` or `m`.
    pub fn unit(&self) -> &'static str {
        if self.slides { "m" } else { "rad" }
    }
}

/// A body that may touch the ground: its pose and its contact flag at each sample.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// Its name, such as `left`.
    pub name: String,
    /// Its poses in the world frame.
    pub poses: Vec<Pose>,
    /// Whether it is in contact.
    pub stands: Vec<bool>,
}

/// A point in the world frame at each sample, for example the centre of mass or the zero moment point (ZMP).
#[derive(Clone, Debug, PartialEq)]
pub struct Track {
    /// Its name, such as `com`.
    pub name: String,
    /// Its positions \[m\].
    pub at: Vec<Point3<f64>>,
}

/// A number at each sample, for example a margin or a residual.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Its name, such as `margin`.
    pub name: String,
    /// Its unit, such as `m`.
    pub unit: String,
    /// Its values.
    pub values: Vec<f64>,
}

/// A motion: samples in time with the values of all joints and, if present, the pose of the base, contacts, points and
/// figures. Seconds, metres, radians.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trajectory {
    /// The robot.
    pub robot: String,
    /// The joints.
    pub joints: Vec<JointTrack>,
    /// The times of the samples, ascending.
    pub times: Vec<f64>,
    /// The joint values at each sample, in the order of the joints.
    pub q: Vec<Vec<f64>>,
    /// The pose of the base in the world frame at each sample; empty for a fixed base.
    pub base: Vec<Pose>,
    /// The contacts.
    pub contacts: Vec<Contact>,
    /// Points.
    pub points: Vec<Track>,
    /// The figures.
    pub figures: Vec<Figure>,
}

impl Trajectory {
    /// Checks that every track has a finite value for each sample, and that the times increase.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] with the sample and the track; [`ErrorKind::DuplicateName`] for two joints, or two other
    /// tracks, with one name.
    pub fn check(&self) -> Result<()> {
        let bad = |text: String| Err(Error::new(ErrorKind::BadValue, text));
        let count = self.times.len();
        if count > MOST_SAMPLES {
            return bad(format!("{count} samples; at most {MOST_SAMPLES} are allowed"));
        }
        let is_late = |pair: &[f64]| pair[1] - pair[0] >= LEAST_STEP;
        if let Some(at) = self.times.windows(2).position(|pair| !is_late(pair)) {
            let text = "its time is not at least 1e-8 s after the previous one; give increasing times";
            return bad(format!("sample {}: {text}", at + 2));
        }
        self.check_names()?;
        let lengths =
            [("joint values", self.q.len()), ("base", if self.base.is_empty() { count } else { self.base.len() })];
        let contacts =
            self.contacts.iter().flat_map(|own| [(&own.name[..], own.poses.len()), (&own.name, own.stands.len())]);
        let points = self.points.iter().map(|own| (&own.name[..], own.at.len()));
        let figures = self.figures.iter().map(|own| (&own.name[..], own.values.len()));
        for (name, length) in lengths.into_iter().chain(contacts).chain(points).chain(figures) {
            if length != count {
                return bad(format!("`{name}` has {length} values for {count} samples; give one each"));
            }
        }
        if let Some(at) = self.q.iter().position(|q| q.len() != self.joints.len()) {
            let text = format!("sample {}: {} values for {} joints", at + 1, self.q[at].len(), self.joints.len());
            return bad(text);
        }
        match (0..count).find(|sample| !self.is_in_range(*sample)) {
            Some(sample) => bad(format!("sample {}: a value is not finite, or beyond {LARGEST:e}", sample + 1)),
            None => Ok(()),
        }
    }

    fn check_names(&self) -> Result<()> {
        let tracks = self.joints.len() + self.contacts.len() + self.points.len() + self.figures.len();
        check_count("tracks", tracks, COLUMNS)?;
        let joints: Vec<&str> = self.joints.iter().map(|joint| joint.name.as_str()).collect();
        let others = self.contacts.iter().map(|own| &own.name);
        let others =
            others.chain(self.points.iter().map(|own| &own.name)).chain(self.figures.iter().map(|own| &own.name));
        let others: Vec<&str> = others.map(String::as_str).collect();
        check_name("trajectory", &self.robot)
            .or_else(|error| if self.robot.is_empty() { Ok(()) } else { Err(error) })?;
        for names in [joints, others] {
            names.iter().try_for_each(|name| check_name("track", name))?;
            let twice = names.iter().enumerate().find(|(place, name)| names[..*place].contains(name));
            if let Some((_, name)) = twice {
                let text = format!("`{}` is given twice; give each a different name", crate::document::shown(name));
                return Err(Error::new(ErrorKind::DuplicateName, text));
            }
        }
        Ok(())
    }

    fn is_in_range(&self, sample: usize) -> bool {
        let number = |x: &f64| x.abs() <= LARGEST;
        let pose = |pose: &Pose| pose.to_homogeneous().iter().all(number);
        number(&self.times[sample])
            && self.q[sample].iter().all(number)
            && self.base.get(sample).is_none_or(pose)
            && self.contacts.iter().all(|contact| pose(&contact.poses[sample]))
            && self.points.iter().all(|track| track.at[sample].iter().all(number))
            && self.figures.iter().all(|figure| number(&figure.values[sample]))
    }

    /// The joint velocities at a sample \[rad/s or m/s\]: the slope of the parabola through it and its neighbours. At
    /// both ends it is the slope of the line to the neighbour.
    ///
    /// # Panics
    /// When there is no such sample.
    pub fn rates(&self, sample: usize) -> Vec<f64> {
        let slope = |from: usize, to: usize, joint: usize| {
            (self.q[to][joint] - self.q[from][joint]) / (self.times[to] - self.times[from])
        };
        let last = self.times.len() - 1;
        let rate = |joint: usize| match (sample.checked_sub(1), (sample < last).then_some(sample + 1)) {
            (Some(before), Some(after)) => {
                let share = (self.times[sample] - self.times[before]) / (self.times[after] - self.times[before]);
                slope(before, sample, joint) * (1.0 - share) + slope(sample, after, joint) * share
            }
            (Some(before), None) => slope(before, sample, joint),
            (None, Some(after)) => slope(sample, after, joint),
            (None, None) => 0.0,
        };
        (0..self.joints.len()).map(rate).collect()
    }

    /// The accelerations of the joints at a sample: the second derivative of this parabola; zero at both ends \[rad/s^2
    /// or m/s^2\].
    ///
    /// # Panics
    /// When there is no such sample.
    pub fn accelerations(&self, sample: usize) -> Vec<f64> {
        let n = self.joints.len();
        if sample == 0 || sample + 1 >= self.times.len() {
            return vec![0.0; n];
        }
        let [before, now, after] = [sample - 1, sample, sample + 1].map(|at| (self.times[at], &self.q[at]));
        let curve = |joint: usize| {
            let first = (now.1[joint] - before.1[joint]) / (now.0 - before.0);
            let second = (after.1[joint] - now.1[joint]) / (after.0 - now.0);
            2.0 * (second - first) / (after.0 - before.0)
        };
        (0..n).map(curve).collect()
    }
}
