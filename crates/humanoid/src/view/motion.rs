//! A trajectory in the format of a page.

use nalgebra::{Point2, Point3};

use super::bytes;
use super::data::{Contact, Figure, Motion, Point, Robot, Support};
use super::sole::Sole;
use super::walk::WalkRecord;
use crate::gait::Polygon;
use crate::{Error, ErrorKind, Result};
use groebot_robot::document::{did_you_mean, shown};
use groebot_robot::motion::{JointTrack, Trajectory, pose_numbers};
use groebot_robot::spatial::Pose;

/// The motion of `robot` by `trajectory`.
///
/// # Errors
/// As [`super::Page::with_motion`].
pub fn motion(robot: &Robot, trajectory: &Trajectory, record: Option<&WalkRecord>, soles: &[Sole]) -> Result<Motion> {
    trajectory.check()?;
    if trajectory.times.is_empty() {
        return Err(Error::new(ErrorKind::BadValue, "the trajectory has no sample; give at least one"));
    }
    if let Some(record) = record {
        record.check(trajectory.times.len())?;
    }
    let recorded = record.map(|record| record.soles(trajectory)).unwrap_or_default();
    let corners = |name: &str| -> &[Point2<f64>] {
        let sole = recorded.iter().chain(soles).find(|sole| sole.contact == name);
        sole.map_or(&[], |sole| &sole.corners)
    };
    let poses = |poses: &[Pose]| bytes::columns(&poses.iter().map(pose_numbers).collect::<Vec<_>>());
    let contact = |own: &groebot_robot::motion::Contact| Contact {
        name: own.name.clone(),
        poses: poses(&own.poses),
        stands: own.stands.iter().map(|stands| if *stands { '1' } else { '0' }).collect(),
        outline: corners(&own.name).iter().map(|corner| [corner.x, corner.y]).collect(),
    };
    let point = |own: &groebot_robot::motion::Track| Point {
        name: own.name.clone(),
        at: bytes::columns(&own.at.iter().map(|at| at.coords.into()).collect::<Vec<[f64; 3]>>()),
    };
    let figure = |own: &groebot_robot::motion::Figure| Figure {
        name: own.name.clone(),
        unit: own.unit.clone(),
        values: bytes::column(own.values.iter().copied()),
    };
    let support = match record {
        Some(record) => Some(record.support.clone()),
        None => supports(trajectory, &corners),
    };
    Ok(Motion {
        times: bytes::column(trajectory.times.iter().copied()),
        joints: trajectory.joints.iter().map(|track| place(robot, track)).collect::<Result<_>>()?,
        q: (0..trajectory.joints.len())
            .map(|joint| bytes::column(trajectory.q.iter().map(move |q| q[joint])))
            .collect(),
        base: (!trajectory.base.is_empty()).then(|| poses(&trajectory.base)),
        contacts: trajectory.contacts.iter().map(contact).collect(),
        points: trajectory.points.iter().map(point).collect(),
        figures: trajectory.figures.iter().map(figure).collect(),
        support: support.as_deref().map(polygons),
        steps: record.map(WalkRecord::shown_steps).unwrap_or_default(),
        phases: record.map(WalkRecord::shown_phases).unwrap_or_default(),
    })
}

/// The index of a track's joint.
fn place(robot: &Robot, track: &JointTrack) -> Result<usize> {
    let named = |kind, text: String| Error::new(kind, format!("joint `{}`: {text}", shown(&track.name)));
    let place = robot.joints.iter().position(|joint| joint.name == track.name).ok_or_else(|| {
        let names: Vec<&str> = robot.joints.iter().map(|joint| joint.name.as_str()).collect();
        let text = format!("the robot `{}` has no such joint{}", shown(&robot.name), did_you_mean(&track.name, &names));
        named(ErrorKind::UnknownName, text)
    })?;
    match (robot.joints[place].kind, track.slides) {
        ("prismatic", true) | ("revolute" | "continuous", false) => Ok(place),
        (kind, _) => {
            let text = format!("the trajectory gives it in {}, but in the robot it is {kind}", track.unit());
            Err(named(ErrorKind::BadValue, text))
        }
    }
}

/// The support polygon at each sample; `None` where the outlines of the soles are not known.
fn supports<'s>(trajectory: &Trajectory, corners: &impl Fn(&str) -> &'s [Point2<f64>]) -> Option<Vec<Vec<[f64; 2]>>> {
    let contacts: Vec<_> = trajectory.contacts.iter().map(|own| (own, corners(&own.name))).collect();
    if contacts.is_empty() || contacts.iter().any(|(_, outline)| outline.is_empty()) {
        return None;
    }
    let hull = |sample: usize| {
        let supporting = contacts.iter().filter(|(own, _)| own.stands[sample]);
        let points: Vec<Point2<f64>> = supporting
            .flat_map(|(own, outline)| outline.iter().map(|at| own.poses[sample] * Point3::new(at.x, at.y, 0.0)))
            .map(|point| point.xy())
            .collect();
        Polygon::hull(&points).corners().iter().map(|corner| [corner.x, corner.y]).collect()
    };
    Some((0..trajectory.times.len()).map(hull).collect())
}

fn polygons(support: &[Vec<[f64; 2]>]) -> Support {
    let is_new = |sample: &usize| sample.checked_sub(1).is_none_or(|before| support[before] != support[*sample]);
    let starts: Vec<usize> = (0..support.len()).filter(is_new).collect();
    Support {
        starts: bytes::packed(starts.iter().map(|sample| *sample as f64)),
        counts: bytes::packed(starts.iter().map(|sample| support[*sample].len() as f64)),
        corners: bytes::packed(starts.iter().flat_map(|sample| &support[*sample]).flatten().copied()),
    }
}
