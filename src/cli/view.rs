//! `groebot view`: a page to see a robot and its motion.

use std::path::{Path, PathBuf};

use super::files::CERTIFICATE;
use super::floor::PlaceArguments;
use super::progress::{Limits, Session};
use super::solve::{PROGRAM_LIMIT, PROGRAM_NAME, read_program};
use super::{Outcome, console, export};
use crate::derive::{Ends, InputFile, Proved};
use crate::document::{TEXT_LIMIT, read_text, shown};
use crate::files::write_atomically;
use crate::gait::{Footprint, Side};
use crate::model::{Meshes, Robot};
use crate::motion::Trajectory;
use crate::motion::table::TABLE_LIMIT;
use crate::robots::{self, Outline};
use crate::task::Goal;
use crate::view::{Asked, Page, Sole, WalkRecord};
use crate::{Error, ErrorKind, Result};

const EXAMPLES: &str = "Examples:
  groebot view walk.csv -o walk.html
  groebot view walk.json -o walk.html
  groebot view walk.csv --robot talos.urdf --meshes -o walk.html
  groebot view nao -o nao.html
  groebot view robot.urdf -o robot.html
  groebot view robot.urdf --tip tool0 -o solutions.html
  groebot view nao --tip l_sole --tip r_sole -o legs.html
  groebot view derivations/ur5 -o ur5.html
  groebot view rh0 --room examples/living_room.toml --start 1,2.6 --goal 7.2,3.4 -o living_room.html

With --tip, and for a derivation, the page shows all solutions while the target is dragged. In a room the robot walks while goal, furniture and the figures of its gait are changed. The page is one file: it opens in a browser without a server and asks nobody for anything. A walk's JSON tells footsteps and phases beside what its CSV tells.
Robots of groebot: nao, rh0, teo.";

/// Writes a page to see a robot and its motion in a browser
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// A walk in CSV or JSON, a robot of groebot, a description in URDF or TOML, or the folder of a derivation
    #[arg(value_name = "WALK-or-ROBOT-or-DIR")]
    shown: PathBuf,
    /// The robot that walks, where the walk does not name one of groebot
    #[arg(long, value_name = "ROBOT-or-FILE")]
    robot: Option<PathBuf>,
    /// Put the triangles of meshes into the page: STL
    #[arg(long)]
    meshes: bool,
    /// Show all solutions of the chain from the base to this link, derived on the spot; repeatable
    #[arg(long, value_name = "LINK", conflicts_with = "room")]
    tip: Vec<String>,
    /// The link that such chains begin with; the root without it
    #[arg(long, value_name = "LINK", requires = "tip")]
    base: Option<String>,
    /// Let nao, rh0 or teo walk through a room, TOML
    #[arg(long, value_name = "FILE", requires = "goal")]
    room: Option<PathBuf>,
    #[command(flatten)]
    places: PlaceArguments,
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
        match motion(file)? {
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
            None if file.is_dir() => derivation(file),
            None => {
                let (robot, meshes) = robot(file)?;
                let page = Page::of_robot(&robot, self.meshes.then_some(&meshes))?;
                let page = self.solved(page, &robot).map_err(|error| error.in_file(file))?;
                self.room.as_ref().map_or(Ok(page.clone()), |room| self.running(page, room))
            }
        }
    }

    /// The robot of a page with the limbs whose solutions are asked for.
    fn solved(&self, page: Page, robot: &Robot) -> Result<Page> {
        if self.tip.is_empty() {
            return Ok(page);
        }
        let session = Session::start(Limits::default())?;
        self.tip.iter().try_fold(page, |page, tip| {
            let (path, chain) =
                (robot.path(self.base.as_deref(), Some(tip))?, robot.chain(self.base.as_deref(), Some(tip))?);
            let moving = path.joints.iter().filter(|(joint, _)| robot.joints()[*joint].kind.is_single()).count();
            if moving != chain.joints().len() {
                let text = format!("`{}`: slides that move together are not shown in a page", shown(tip));
                return Err(Error::new(ErrorKind::Unsupported, text));
            }
            let proved = Proved::of_chain(&chain, &session.watch)?;
            page.with_limb(&chain, [&path.base, &path.tip], proved.program().to_json())
        })
    }

    /// The robot of a page in a room.
    fn running(&self, page: Page, room: &Path) -> Result<Page> {
        let Footprint { x, y, yaw } = self.places.start()?;
        let Goal { place, heading } = self.places.goal()?;
        let goal: Vec<f64> = [place.x, place.y].into_iter().chain(heading).collect();
        let text = read_text(room, TEXT_LIMIT)?;
        let robot = self.shown.to_string_lossy();
        let asked = Asked { robot: &robot, room: &text, start: [x, y, yaw], goal: &goal, apart: self.places.apart };
        page.with_run(&asked).map_err(|error| error.in_file(room))
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

/// The motion of the file, if it is one by its name.
pub(super) fn motion(file: &Path) -> Result<Option<(Trajectory, Option<WalkRecord>)>> {
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

/// The chain that was derived in a folder, with its solver.
fn derivation(folder: &Path) -> Result<Page> {
    let chain = InputFile::read(folder)?.chain(&Ends::default())?;
    let no_chain = || {
        let text = "what was derived here is no chain of a robot; give the folder of one";
        Error::new(ErrorKind::Unsupported, text).in_file(folder)
    };
    let chain = chain.ok_or_else(no_chain)?;
    read_program(folder)?;
    let program = read_text(&folder.join(PROGRAM_NAME), PROGRAM_LIMIT)?;
    let certificate = folder.join(CERTIFICATE);
    let certificate = if certificate.is_file() { Some(read_text(&certificate, PROGRAM_LIMIT)?) } else { None };
    Ok(Page::of_chain(&chain, program, certificate.as_deref()))
}

/// A robot of this crate by its name, or the one that a file describes.
fn robot(name: &Path) -> Result<(Robot, Meshes)> {
    if !name.exists() && name.to_str().and_then(robots::robot).is_none() {
        let text = format!(
            "`{}` is neither a file nor a robot of groebot; give a file, nao, rh0 or teo",
            shown(&name.to_string_lossy())
        );
        return Err(Error::new(ErrorKind::UnknownName, text));
    }
    export::described(name)
}

/// The soles of a robot of this crate, as they were measured.
fn soles(robot: &str) -> Result<Vec<Sole>> {
    let Some(walker) = robots::walker(robot, Outline::Measured) else { return Ok(Vec::new()) };
    let feet = walker?.biped.feet;
    let sole = |side: Side| Sole { contact: side.name().to_owned(), corners: feet[side as usize].corners.clone() };
    Ok(vec![sole(Side::Left), sole(Side::Right)])
}
