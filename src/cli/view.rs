//! `groebot view`: a page to see a robot and its motion.

use std::path::{Path, PathBuf};

use super::{Outcome, console, export};
use crate::document::{read_text, shown};
use crate::files::write_atomically;
use crate::gait::Side;
use crate::model::{Meshes, Robot};
use crate::motion::Trajectory;
use crate::motion::table::TABLE_LIMIT;
use crate::robots::{self, Outline};
use crate::view::{Page, Sole, WalkRecord};
use crate::{Error, ErrorKind, Result};

const EXAMPLES: &str = "Examples:
  groebot view walk.csv -o walk.html
  groebot view walk.json -o walk.html
  groebot view walk.csv --robot talos.urdf --meshes -o walk.html
  groebot view nao -o nao.html
  groebot view robot.urdf -o robot.html

The page is one file: it opens in a browser without a server and asks nobody for anything. A walk's JSON tells footsteps and phases beside what its CSV tells.
Robots of groebot: nao, rh0, teo.";

/// Writes a page to see a robot and its motion in a browser
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// A walk in CSV or JSON, a robot of groebot, or a description in URDF or TOML
    #[arg(value_name = "WALK-or-ROBOT")]
    shown: PathBuf,
    /// The robot that walks, where the walk does not name one of groebot
    #[arg(long, value_name = "ROBOT-or-FILE")]
    robot: Option<PathBuf>,
    /// Put the triangles of meshes into the page: STL
    #[arg(long)]
    meshes: bool,
    /// Where the page goes
    #[arg(short, long, value_name = "FILE")]
    out: PathBuf,
}

/// Writes the page.
pub fn run(arguments: &Arguments) -> Outcome {
    let page = arguments.page()?;
    write_atomically(&arguments.out, page.to_html().as_bytes())?;
    console::print(&format!("{}\n", arguments.out.display()))
}

impl Arguments {
    fn page(&self) -> Result<Page> {
        let file = &self.shown;
        match self.motion()? {
            Some((trajectory, record)) => {
                let (robot, meshes) = self.walking(&trajectory).map_err(|error| error.in_file(file))?;
                let soles = soles(robot.name())?;
                let title = file.file_name().unwrap_or_default().to_string_lossy();
                let page = Page::of_robot(&robot, self.meshes.then_some(&meshes))?.titled(&title);
                page.with_motion(&trajectory, record.as_ref(), &soles).map_err(|error| error.in_file(file))
            }
            None if self.robot.is_some() => {
                let text = "--robot says who walks, but this is no walk; give a walk in CSV or JSON, or leave it out";
                Err(Error::new(ErrorKind::BadValue, text).in_file(file))
            }
            None => {
                let (robot, meshes) = robot(file)?;
                Page::of_robot(&robot, self.meshes.then_some(&meshes))
            }
        }
    }

    /// The motion of the file, if it is one by its name.
    fn motion(&self) -> Result<Option<(Trajectory, Option<WalkRecord>)>> {
        let file = &self.shown;
        let ends = |end: &str| file.extension().is_some_and(|own| own.eq_ignore_ascii_case(end));
        if ends("csv") {
            return Ok(Some((Trajectory::read_csv(file)?, None)));
        }
        if !ends("json") {
            return Ok(None);
        }
        let text = read_text(file, TABLE_LIMIT)?;
        let read = Trajectory::from_json(&text).and_then(|own| Ok((own, WalkRecord::from_json(&text)?)));
        read.map(Some).map_err(|error| error.in_file(file))
    }

    /// The robot that `--robot` or else the trajectory names.
    fn walking(&self, trajectory: &Trajectory) -> Result<(Robot, Meshes)> {
        let own = || robots::robot(&trajectory.robot).map(|robot| (robot, Meshes::default()));
        match &self.robot {
            Some(name) => robot(name),
            None => own().ok_or_else(|| {
                let text = format!(
                    "its robot `{}` is none of groebot's; give its description by --robot, or nao, rh0 or teo",
                    shown(&trajectory.robot)
                );
                Error::new(ErrorKind::UnknownName, text)
            }),
        }
    }
}

/// A robot of this crate by its name, or the one that a file describes.
fn robot(name: &Path) -> Result<(Robot, Meshes)> {
    match name.to_str() {
        Some("nao") => Ok((robots::nao_v5(), Meshes::default())),
        _ if name.exists() || name.to_str().is_some_and(|name| robots::robot(name).is_some()) => {
            export::described(name)
        }
        _ => {
            let text = format!(
                "`{}` is neither a file nor a robot of groebot; give a file, nao, rh0 or teo",
                shown(&name.to_string_lossy())
            );
            Err(Error::new(ErrorKind::UnknownName, text))
        }
    }
}

/// The soles of a robot of this crate, as they were measured.
fn soles(robot: &str) -> Result<Vec<Sole>> {
    let name = if robot == "nao_v5" { "nao" } else { robot };
    let Some(walker) = robots::walker(name, Outline::Measured) else { return Ok(Vec::new()) };
    let feet = walker?.biped.feet;
    let sole = |side: Side| Sole { contact: side.name().to_owned(), corners: feet[side as usize].corners.clone() };
    Ok(vec![sole(Side::Left), sole(Side::Right)])
}
