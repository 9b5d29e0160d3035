//! The part of a walk's JSON that is not the trajectory. Main type: [`WalkRecord`].

use nalgebra::{Point2, Point3};
use serde::Deserialize;

use super::data::{Phase, Step};
use super::sole::Sole;
use crate::{Error, ErrorKind, Result};
use groebot_robot::motion::Trajectory;

/// Footsteps, phases and support polygons of a walk, as [`crate::gait::Walk::to_json`] writes them under `walk`.
#[derive(Clone, Debug, PartialEq, Deserialize)]
pub struct WalkRecord {
    pub(super) support: Vec<Vec<[f64; 2]>>,
    #[serde(default)]
    start: Option<Start>,
    #[serde(default)]
    steps: Vec<RecordedStep>,
    #[serde(default)]
    phases: Vec<RecordedPhase>,
}

#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
struct Start {
    left: Print,
    right: Print,
}

#[derive(Clone, Copy, Debug, PartialEq, Deserialize)]
struct Print {
    x: f64,
    y: f64,
    yaw: f64,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
struct RecordedStep {
    foot: String,
    #[serde(flatten)]
    print: Print,
}

#[derive(Clone, Debug, PartialEq, Deserialize)]
struct RecordedPhase {
    action: String,
    step: Option<usize>,
    from: f64,
    to: f64,
}

#[derive(Deserialize)]
struct File {
    #[serde(default)]
    walk: Option<WalkRecord>,
}

impl WalkRecord {
    /// Reads the record in the JSON of a walk; `None` where there is only a trajectory.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] for an invalid `walk`, with the line.
    pub fn from_json(text: &str) -> Result<Option<Self>> {
        let read: std::result::Result<File, _> = serde_json::from_str(text);
        read.map(|file| file.walk).map_err(|error| {
            let line = error.line().max(1);
            Error::new(ErrorKind::Syntax, format!("`walk` does not have the format of groebot: {error}")).at_line(line)
        })
    }

    /// Checks that there is a polygon for each sample.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`].
    pub(super) fn check(&self, samples: usize) -> Result<()> {
        let count = self.support.len();
        if count == samples {
            return Ok(());
        }
        let text = format!("`walk` has {count} support polygons for {samples} samples; give one each");
        Err(Error::new(ErrorKind::BadValue, text))
    }

    /// The soles, from the polygons of single support.
    pub(super) fn soles(&self, trajectory: &Trajectory) -> Vec<Sole> {
        let stands = |sample: usize| trajectory.contacts.iter().filter(move |own| own.stands[sample]).count();
        let sole = |own: &groebot_robot::motion::Contact| {
            let sample = (0..self.support.len()).find(|sample| own.stands[*sample] && stands(*sample) == 1)?;
            let sole_from_world = own.poses[sample].inverse();
            let height = own.poses[sample].translation.z;
            let corner = |[x, y]: &[f64; 2]| (sole_from_world * Point3::new(*x, *y, height)).xy();
            let corners: Vec<Point2<f64>> = self.support[sample].iter().map(corner).collect();
            Some(Sole { contact: own.name.clone(), corners })
        };
        trajectory.contacts.iter().filter_map(sole).collect()
    }

    /// The footprints, the initial ones first.
    pub(super) fn shown_steps(&self) -> Vec<Step> {
        let step = |foot: &str, Print { x, y, yaw }: Print| Step { foot: foot.to_owned(), x, y, yaw };
        let start = self.start.map(|start| [step("left", start.left), step("right", start.right)]);
        start.into_iter().flatten().chain(self.steps.iter().map(|own| step(&own.foot, own.print))).collect()
    }

    pub(super) fn shown_phases(&self) -> Vec<Phase> {
        let phase =
            |own: &RecordedPhase| Phase { action: own.action.clone(), step: own.step, from: own.from, to: own.to };
        self.phases.iter().map(phase).collect()
    }
}
