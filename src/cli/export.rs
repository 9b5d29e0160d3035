//! `groebot export`: a robot in another format.

use std::path::{Path, PathBuf};

use super::{Outcome, console};
use crate::derive::{Description, InputFile};
use crate::files::write_atomically;
use crate::model::{Meshes, Robot};
use crate::robots;
use crate::{Error, ErrorKind, Result};

const EXAMPLES: &str = "Examples:
  groebot export nao_v5 --format mjcf -o nao.xml
  groebot export robot.toml --format urdf -o robot.urdf
  groebot export talos.urdf --format mjcf -o talos.xml

Robots of groebot: nao_v5, rh0, teo. In MJCF the root moves freely over a floor, every joint has a position servo, and nothing but the floor is
touched; meshes are named by their files.";

/// A format of robots.
#[derive(Clone, Copy, clap::ValueEnum)]
enum Format {
    /// As ROS reads it
    Urdf,
    /// As MuJoCo reads it
    Mjcf,
}

/// Writes a robot, with masses, shapes, limits and actuators, in another format
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// A robot of groebot, or a description in URDF or TOML
    #[arg(value_name = "ROBOT-or-FILE")]
    robot: PathBuf,
    /// The format
    #[arg(long, value_enum)]
    format: Format,
    /// Where it goes; standard output without it
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
}

/// Writes the robot.
pub fn run(arguments: &Arguments) -> Outcome {
    let (robot, meshes) = described(&arguments.robot)?;
    let text = match arguments.format {
        Format::Urdf => robot.to_urdf(),
        Format::Mjcf => robot.to_mjcf(&meshes),
    };
    match &arguments.out {
        Some(file) => Ok(write_atomically(file, text.as_bytes())?),
        None => console::print(&text),
    }
}

/// A robot of this crate by its name, or the one that a file describes.
pub(super) fn described(robot: &Path) -> Result<(Robot, Meshes)> {
    if let Some(known) = robot.to_str().and_then(robots::robot) {
        return Ok((known, Meshes::default()));
    }
    let input = InputFile::read(robot)?;
    match input.description {
        Description::Robot(read) => Ok((read, Meshes::beside(&input.path))),
        _ => {
            let text = "this describes no robot with links; give one in URDF or TOML";
            Err(Error::new(ErrorKind::BadValue, text).in_file(robot))
        }
    }
}
