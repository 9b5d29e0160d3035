//! `groebot view`: an HTML page of a robot and its motion.

use std::path::{Path, PathBuf};

use super::description::DescriptionArguments;
use super::floor::{PlaceArguments, room_text};
use super::moving::{self, Motion};
use super::named::{CacheArguments, is_chain};
use super::output::{Force, Kind};
use super::progress::{Limits, Session};
use super::solve::read_program;
use super::{Outcome, console, json};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::limits::PROGRAM_BYTES;
use groebot_humanoid::gait::{Footprint, Side};
use groebot_humanoid::nav::Room;
use groebot_humanoid::view::{Page, RunRequest, Sole};
use groebot_humanoid::walkers::{self, Outline};
use groebot_ik::derive::{Ends, InputFile, Options};
use groebot_ik::folder::CERTIFICATE;
use groebot_ik::reach::ReachMap;
use groebot_robot::document::{read_text, shown};
use groebot_robot::model::Robot;
use groebot_robot::motion::table::TABLE_LIMIT;

const EXAMPLES: &str = "Examples:
  groebot view walk.csv -o walk.html
  groebot view walk.json -o walk.html
  groebot view task.json -o task.html
  groebot view walk.csv --robot talos.urdf --meshes -o walk.html
  groebot view nao -o nao.html
  groebot view robot.urdf -o robot.html
  groebot view robot.urdf --tip tool0 -o solutions.html
  groebot view nao --tip l_sole --tip r_sole -o legs.html
  groebot view derivations/ur5 -o ur5.html
  groebot view derivations/panda -o panda.html
  groebot view derivations/ur5 --reach ur5.json -o reach.html
  groebot view rh0 --room living-room --start 1,2.6 --goal 7.2,3.4 -o living_room.html

With --tip, and for a derivation, the page shows all solutions while the target is dragged; of a
redundant arm, all arcs of solutions within limits, with a slider along each arc. In a room the
robot walks while goal, furniture and the parameters of its gait are changed. The page is one
self-contained HTML file that makes no network requests. The JSON of a walk has footsteps and
phases, its CSV does not.

`groebot robots` lists the robots by name; a page of an arm or a leg shows all solutions. nao, rh0 and teo walk.";

/// Writes a self-contained HTML page that shows a robot and its motion in a browser
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// A walk or a task in CSV or JSON, a robot by name (`groebot robots`), a description in URDF, xacro, MJCF, SDF or TOML, or the folder
    /// of a derivation
    #[arg(value_name = "WALK-or-ROBOT-or-DIR")]
    shown: PathBuf,
    #[command(flatten)]
    cache: CacheArguments,
    /// The walking robot, if the walk does not name a robot of groebot
    #[arg(long, value_name = "ROBOT-or-FILE")]
    robot: Option<PathBuf>,
    /// Include the triangles of STL meshes in the page
    #[arg(long)]
    meshes: bool,
    /// Show all solutions of the chain from the base to this link (repeatable); its solver is derived before
    #[arg(long, value_name = "LINK", conflicts_with = "room")]
    tip: Vec<String>,
    /// The first link of such chains (default: the root)
    #[arg(long, value_name = "LINK", requires = "tip")]
    base: Option<String>,
    /// Show a reachability map of `groebot reach`, of the derivation or of the last --tip
    #[arg(long, value_name = "MAP.json", conflicts_with = "room")]
    reach: Option<PathBuf>,
    /// Show nao, rh0 or teo walking through a room: living-room, encirclement, or TOML
    #[arg(long, value_name = "ROOM-or-FILE", requires = "goal")]
    room: Option<PathBuf>,
    #[command(flatten)]
    places: PlaceArguments,
    /// The output file, HTML
    #[arg(short, long, value_name = "FILE")]
    out: PathBuf,
    /// Print the path of the page as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    described: DescriptionArguments,
    #[command(flatten)]
    force: Force,
}

/// Writes the page.
pub fn run(arguments: &Arguments) -> Outcome {
    let read = [Some(&arguments.shown), arguments.robot.as_ref(), arguments.reach.as_ref(), arguments.room.as_ref()];
    let output =
        arguments.force.output(read.into_iter().flatten().map(PathBuf::as_path)).expects([Some(&arguments.out)])?;
    let page = arguments.reached(arguments.page()?)?;
    output.write(&arguments.out, Kind::Markup, page.to_html())?;
    let text = if arguments.json {
        json::text(&json::written(&[&arguments.out]))
    } else {
        format!("{}\n", arguments.out.display())
    };
    console::print(&text)
}

impl Arguments {
    fn page(&self) -> Result<Page> {
        let file = &self.shown;
        let motion = moving::motion(file)?;
        if (motion.is_some() || file.is_dir() || is_chain(file)) && (self.room.is_some() || !self.tip.is_empty()) {
            let text = "--room and --tip are for robots at rest; leave them out for a motion or a derivation";
            return Err(Error::new(ErrorKind::BadValue, text).in_file(file));
        }
        match motion {
            Some(Motion { trajectory, walk, task }) => {
                let (robot, meshes) = moving::robot_of(&trajectory, self.robot.as_deref(), &self.described.options())
                    .map_err(|error| error.in_file(file))?;
                let soles = soles(robot.name())?;
                let title = file.file_name().unwrap_or_default().to_string_lossy();
                let page = Page::of_robot(&robot, self.meshes.then_some(&meshes))?.titled(&title);
                let page = page.with_motion(&trajectory, walk.as_ref(), &soles).map_err(|error| error.in_file(file))?;
                Ok(if let Some(task) = task { page.with_task(task) } else { page })
            }
            None if self.robot.is_some() => {
                let text = "--robot names the walking robot, but this is not a walk; give a walk in CSV or JSON, or leave it out";
                Err(Error::new(ErrorKind::BadValue, text).in_file(file))
            }
            None if file.is_dir() || is_chain(file) => derivation(self.cache.derivation(file)?.path()),
            None => {
                let (robot, meshes) = moving::described(file, &self.described.options())?;
                let page = Page::of_robot(&robot, self.meshes.then_some(&meshes))?;
                let page = self.solved(page, &robot).map_err(|error| error.in_file(file))?;
                self.room.as_ref().map_or(Ok(page.clone()), |room| self.running(page, room))
            }
        }
    }

    /// A page with the requested reachability map.
    fn reached(&self, page: Page) -> Result<Page> {
        let Some(file) = &self.reach else { return Ok(page) };
        if !self.shown.is_dir() && self.tip.is_empty() {
            let text = "a reachability map needs a limb; give the folder of its derivation, or --tip";
            return Err(Error::new(ErrorKind::BadValue, text).in_file(&self.shown));
        }
        let map = ReachMap::from_json(&read_text(file, TABLE_LIMIT)?).map_err(|error| error.in_file(file))?;
        if self.shown.is_dir() {
            let own = read_program(&self.shown)?.name;
            if map.solver != own {
                let text = format!("this is the map of {}; the derivation is that of {own}", shown(&map.solver));
                return Err(Error::new(ErrorKind::BadValue, text).in_file(file));
            }
        }
        Ok(page.with_reach(&map))
    }

    /// The robot of a page with the limbs whose solutions are requested.
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
                let text = format!("`{}`: coupled prismatic joints are not supported in a page", shown(tip));
                return Err(Error::new(ErrorKind::Unsupported, text));
            }
            let proved = Options::new().watch(session.watch.clone()).derive(&chain)?;
            let certificate = proved.certificate()?;
            page.with_limb(&chain, [&path.base, &path.tip], proved.program().to_json(), Some(&certificate))
        })
    }

    /// The robot of a page in a room.
    fn running(&self, page: Page, room: &Path) -> Result<Page> {
        let text = room_text(room)?;
        let default_start = Room::from_toml(&text).map_err(|error| error.in_file(room))?.start;
        let Footprint { x, y, yaw } = self.places.start(default_start)?;
        let goal = self.places.goal()?.numbers();
        let robot = self.shown.to_string_lossy();
        let run_request =
            RunRequest { robot: &robot, room: &text, start: [x, y, yaw], goal: &goal, apart: self.places.apart };
        page.with_run(&run_request).map_err(|error| error.in_file(room))
    }
}

/// The chain that was derived in a folder, with its solver.
fn derivation(folder: &Path) -> Result<Page> {
    let chain = InputFile::read(folder)?.chain(&Ends::default())?;
    let no_chain = || {
        let text = "this derivation is not that of a robot's chain; give the folder of one";
        Error::new(ErrorKind::Unsupported, text).in_file(folder)
    };
    let chain = chain.ok_or_else(no_chain)?;
    let program = read_program(folder)?.to_json();
    let certificate = folder.join(CERTIFICATE);
    let certificate = if certificate.is_file() { Some(read_text(&certificate, PROGRAM_BYTES)?) } else { None };
    Ok(Page::of_chain(&chain, program, certificate.as_deref()))
}

/// The measured soles of a robot of this crate.
pub(super) fn soles(robot: &str) -> Result<Vec<Sole>> {
    let Some(walker) = walkers::walker(robot, Outline::Measured) else { return Ok(Vec::new()) };
    let feet = walker?.biped.feet;
    let sole = |side: Side| Sole { contact: side.name().to_owned(), corners: feet[side as usize].corners.clone() };
    Ok(vec![sole(Side::Left), sole(Side::Right)])
}
