//! Robots by name or file, and motions in files with the robots that they move.

use std::path::Path;

use crate::{Error, ErrorKind, Result};
use groebot_humanoid::sim::TaskRecord;
use groebot_humanoid::view::WalkRecord;
use groebot_ik::derive::problem::input::robot_name;
use groebot_ik::derive::{Description, InputFile};
use groebot_robot::document::{read_text, shown};
use groebot_robot::model::{Meshes, ReadOptions, Robot};
use groebot_robot::motion::Trajectory;
use groebot_robot::motion::table::TABLE_LIMIT;
use groebot_robot::robots;

/// Whether the name of a file has this ending.
pub fn ends(file: &Path, end: &str) -> bool {
    file.extension().is_some_and(|own| own.eq_ignore_ascii_case(end))
}

/// A motion, and other data of its file.
pub struct Motion {
    pub trajectory: Trajectory,
    pub walk: Option<WalkRecord>,
    pub task: Option<TaskRecord>,
}

/// The motion of a file, if its name is that of CSV or JSON.
pub fn motion(file: &Path) -> Result<Option<Motion>> {
    if ends(file, "csv") {
        return Ok(Some(Motion { trajectory: Trajectory::read_csv(file)?, walk: None, task: None }));
    }
    if !ends(file, "json") {
        return Ok(None);
    }
    let text = read_text(file, TABLE_LIMIT)?;
    let read = || {
        let trajectory = Trajectory::from_json(&text)?;
        Ok(Motion { trajectory, walk: WalkRecord::from_json(&text)?, task: TaskRecord::from_json(&text)? })
    };
    read().map(Some).map_err(|error: Error| error.in_file(file))
}

/// The robot with this name or file, or else the one that the trajectory names.
pub fn robot_of(
    trajectory: &Trajectory,
    described_by: Option<&Path>,
    options: &ReadOptions,
) -> Result<(Robot, Meshes)> {
    let own = || robots::robot(&trajectory.robot).map(|robot| (robot, Meshes::default()));
    match described_by {
        Some(name) => described(name, options),
        None => own().ok_or_else(|| {
            let text = format!(
                "its robot `{}` is not a robot of groebot; give its description by --robot, or nao, rh0 or teo",
                shown(&trajectory.robot)
            );
            Error::new(ErrorKind::UnknownName, text)
        }),
    }
}

/// A robot of this crate by its name, or from a file.
pub fn described(robot: &Path, options: &ReadOptions) -> Result<(Robot, Meshes)> {
    if let Some(known) = robot.to_str().and_then(robots::robot) {
        return Ok((known, Meshes::default()));
    }
    let input = InputFile::read_with(robot, options)?;
    match input.description {
        Description::Robot(read) => Ok((read, Meshes::beside_with(&input.path, options.clone()))),
        _ => {
            let given = match robot_name(robot) {
                Some(_) => "this name is that of a chain, without links and masses",
                None => "this does not describe a robot with links",
            };
            let text = format!("{given}; give a robot with links in URDF, xacro, MJCF, SDF or TOML");
            Err(Error::new(ErrorKind::BadValue, text).in_file(robot))
        }
    }
}
