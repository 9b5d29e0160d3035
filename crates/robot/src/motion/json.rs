//! Trajectories as JSON: [`Trajectory::to_json`], [`Trajectory::from_json`].

use nalgebra::Point3;
use serde::{Deserialize, Serialize};

use super::table::{ROUNDING, pose_numbers, pose_of};
use super::{Contact, Figure, JointTrack, Track, Trajectory};
use crate::Result;
use crate::document::JsonFormat;
use crate::spatial::Pose;

const FORMAT: JsonFormat = JsonFormat {
    what: "trajectory",
    oldest: 1,
    // Since 2, the summary of a walk has the keys of `groebot walk --json`; nothing else differs from 1.
    number: 2,
    renew: "`groebot walk` and `groebot follow` write new ones",
};

/// The JSON form of a trajectory. Poses are position and quaternion xyzw.
#[derive(Serialize, Deserialize)]
struct Written {
    format: u32,
    robot: String,
    joints: Vec<JointTrack>,
    time: Vec<f64>,
    q: Vec<Vec<f64>>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    base: Vec<[f64; 7]>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    contacts: Vec<WrittenContact>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    points: Vec<WrittenTrack>,
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    figures: Vec<WrittenFigure>,
}

#[derive(Serialize, Deserialize)]
struct WrittenContact {
    name: String,
    poses: Vec<[f64; 7]>,
    stands: Vec<bool>,
}

#[derive(Serialize, Deserialize)]
struct WrittenTrack {
    name: String,
    at: Vec<[f64; 3]>,
}

#[derive(Serialize, Deserialize)]
struct WrittenFigure {
    name: String,
    unit: String,
    values: Vec<f64>,
}

impl Trajectory {
    /// Converts the trajectory to JSON: `format` (2), `robot`, `joints` (name, slides, limits, speed), `time`, `q`,
    /// `base`, `contacts`, `points`, `figures`; poses are position and quaternion xyzw.
    pub fn to_json(&self) -> serde_json::Value {
        let poses = |poses: &[Pose]| poses.iter().map(pose_numbers).collect::<Vec<_>>();
        let contact = |own: &Contact| WrittenContact {
            name: own.name.clone(),
            poses: poses(&own.poses),
            stands: own.stands.clone(),
        };
        let track = |own: &Track| WrittenTrack {
            name: own.name.clone(),
            at: own.at.iter().map(|point| point.coords.into()).collect(),
        };
        let figure =
            |own: &Figure| WrittenFigure { name: own.name.clone(), unit: own.unit.clone(), values: own.values.clone() };
        let written = Written {
            format: FORMAT.number,
            robot: self.robot.clone(),
            joints: self.joints.clone(),
            time: self.times.clone(),
            q: self.q.clone(),
            base: poses(&self.base),
            contacts: self.contacts.iter().map(contact).collect(),
            points: self.points.iter().map(track).collect(),
            figures: self.figures.iter().map(figure).collect(),
        };
        serde_json::to_value(written).expect("JSON can represent every trajectory")
    }

    /// Reads a trajectory in the format of [`Trajectory::to_json`], or in format 1, which differs only in the summary of
    /// a walk. Other keys are ignored.
    ///
    /// # Errors
    /// [`crate::ErrorKind::Syntax`] for text that is not such JSON, [`crate::ErrorKind::Unsupported`] for another
    /// `format`; [`crate::ErrorKind::BadValue`] for a quaternion whose length is not one; those of
    /// [`Trajectory::check`].
    pub fn from_json(text: &str) -> Result<Self> {
        let written: Written = FORMAT.read(text)?;
        let poses =
            |poses: Vec<[f64; 7]>| poses.into_iter().map(|pose| pose_of(pose, ROUNDING)).collect::<Result<Vec<Pose>>>();
        let contact =
            |own: WrittenContact| Ok(Contact { name: own.name, poses: poses(own.poses)?, stands: own.stands });
        let track = |own: WrittenTrack| Track { name: own.name, at: own.at.into_iter().map(Point3::from).collect() };
        let trajectory = Trajectory {
            robot: written.robot,
            joints: written.joints,
            times: written.time,
            q: written.q,
            base: poses(written.base)?,
            contacts: written.contacts.into_iter().map(contact).collect::<Result<_>>()?,
            points: written.points.into_iter().map(track).collect(),
            figures: written
                .figures
                .into_iter()
                .map(|own| Figure { name: own.name, unit: own.unit, values: own.values })
                .collect(),
        };
        trajectory.check()?;
        Ok(trajectory)
    }
}
