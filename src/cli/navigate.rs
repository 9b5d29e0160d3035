//! `groebot navigate`: a humanoid finds its way over a map, step by step.

use std::path::PathBuf;
use std::time::Instant;

use clap::ValueEnum;
use nalgebra::Point2;

use super::floor::FloorArguments;
use super::progress::{Limits, Session};
use super::walker::{self, Named, SoleArguments};
use super::{Halt, Outcome, console};
use crate::files::write_atomically;
use crate::gait::{Footprint, Summary, Usual};
use crate::robots::Outline;
use crate::task::{Blocked, Body, Floor, Goal, Method, Pilot, Plan};
use crate::{Error, ErrorKind, Result, Watch};

const EXAMPLES: &str = "Examples:
  groebot navigate rh0 --map room.yaml --goal 3.2,1.5 -o walk.csv --plot plan.svg
  groebot navigate nao --map room.txt --resolution 0.05 --start 0.5,0.5,90 --goal 2,1.5,0
  groebot navigate teo --map room.yaml --goal 3.2,1.5 --method m3r
  groebot navigate rh0 --map living_room.toml --furniture piano=1.2,0.4 --goal 4,3
  groebot navigate talos.urdf --left left_sole_link --right right_sole_link --map room.yaml --goal 3,1

Metres, and degrees for headings; radians in files. The way is that of the middle of the feet: first with room for the robot however it is turned, where there is none with room for
the core of its body. Steps follow it as far as legs and limits reach, or are searched where that fails; each is a walk of its own by one step goal,
checked at every sample: soles on free cells, the body so far from obstacles, joints within limits and speeds, the zero moment point within its margin.
Where there is no way the exit status is 4.";

/// Finds the way of a humanoid over a map, its footsteps, and the joint angles of the walk
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The robot: nao, rh0, teo, or a description in URDF or TOML
    #[arg(value_name = "ROBOT-or-FILE")]
    robot: String,
    #[command(flatten)]
    soles: SoleArguments,
    /// The map: ROS' YAML with its image, PGM, PNG, rows of characters, or a room in TOML
    #[arg(long, value_name = "FILE")]
    map: PathBuf,
    #[command(flatten)]
    floor: FloorArguments,
    /// Where the middle of the feet is at first, and where the robot looks [m, degrees]
    #[arg(
        long,
        value_name = "X,Y[,HEADING]",
        value_delimiter = ',',
        num_args = 1,
        default_value = "0,0",
        allow_hyphen_values = true
    )]
    start: Vec<f64>,
    /// Where it is to get, and to look there
    #[arg(long, value_name = "X,Y[,HEADING]", value_delimiter = ',', num_args = 1, allow_hyphen_values = true)]
    goal: Vec<f64>,
    /// How the way is found
    #[arg(long, value_name = "METHOD", default_value = "exact")]
    method: MethodName,
    /// How far the body keeps away from obstacles [m]
    #[arg(long, value_name = "METRES", default_value_t = 0.02, allow_hyphen_values = true)]
    apart: f64,
    /// The body from above, instead of what the description's shapes say: how long and how wide [m]
    #[arg(long, value_name = "LENGTH,WIDTH", value_delimiter = ',', num_args = 1)]
    body: Option<Vec<f64>>,
    /// Start and end in the crouch, without lowering and rising
    #[arg(long)]
    crouched: bool,
    /// Where the joint angles go: CSV, or JSON when the name ends in .json
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Where the picture of map, way and footsteps goes, SVG
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// No progress and no summary
    #[arg(long)]
    quiet: bool,
}

#[derive(Clone, Copy, ValueEnum)]
enum MethodName {
    /// The shortest way
    Exact,
    /// Down a field of fast marching
    Fmm,
    /// Down a field of the thesis' M3R
    M3r,
    /// Down an artificial potential field, which may be stuck
    Potential,
}

/// Plans the journey and writes what is asked for.
pub fn run(arguments: &Arguments) -> Outcome {
    let session = Session::start(Limits { quiet: arguments.quiet, ..Limits::default() })?;
    let named = walker::named(&arguments.robot, Outline::Measured, &arguments.soles, &session.watch)?;
    let map = arguments.floor.map(&arguments.map)?;
    let pilot = arguments.pilot(named, &session.watch)?;
    let floor = Floor::new(&map, arguments.apart)?;
    let begun = Instant::now();
    let found = arguments.found(&pilot, &floor, &session.watch)?;
    let milliseconds = 1e3 * begun.elapsed().as_secs_f64();
    drop(session);
    match found {
        Ok(plan) => arguments.tell((&pilot, &floor), &plan, milliseconds),
        Err(blocked) => {
            eprintln!("error: {blocked}");
            Err(Halt::NoWay)
        }
    }
}

impl Arguments {
    fn pilot(&self, named: Named, watch: &Watch) -> Result<Pilot> {
        let body = match self.body.as_deref() {
            Some(&[length, width]) => Body::of_size(length, width)?,
            Some(_) => return Err(bad("--body takes two numbers: --body 0.3,0.5")),
            None => Body::new(&named.robot, &named.walker.biped, &named.meshes)?,
        };
        let usual = steps(&named.walker.gaits)?;
        Pilot::new(named.walker, usual, body, !self.crouched, watch)
    }

    fn found(&self, pilot: &Pilot, floor: &Floor, watch: &Watch) -> Result<std::result::Result<Plan, Blocked>> {
        let start = match self.start[..] {
            [x, y] => Footprint { x, y, yaw: 0.0 },
            [x, y, heading] => Footprint { x, y, yaw: heading.to_radians() },
            _ => return Err(bad("--start takes two or three numbers: --start 0,0,90")),
        };
        let goal = match self.goal[..] {
            [x, y] => Goal { place: Point2::new(x, y), heading: None },
            [x, y, heading] => Goal { place: Point2::new(x, y), heading: Some(heading.to_radians()) },
            _ => return Err(bad("--goal takes two or three numbers: --goal 3.2,1.5 or --goal 3.2,1.5,90")),
        };
        let method = match self.method {
            MethodName::Exact => Method::Exact,
            MethodName::Fmm => Method::FastMarching,
            MethodName::M3r => Method::M3r,
            MethodName::Potential => Method::Potential,
        };
        Plan::find(pilot, floor, start.feet(pilot.half_width()), goal, method, watch)
    }

    fn tell(&self, (pilot, floor): (&Pilot, &Floor), plan: &Plan, milliseconds: f64) -> Outcome {
        let biped = &pilot.walker().biped;
        if let Some(file) = &self.out {
            let is_json = file.extension().is_some_and(|end| end.eq_ignore_ascii_case("json"));
            let text = if is_json { plan.walk.to_json(biped) } else { plan.walk.to_csv(biped) };
            write_atomically(file, text.as_bytes())?;
        }
        if let Some(file) = &self.plot {
            write_atomically(file, plan.to_svg(pilot, floor).as_bytes())?;
        }
        if self.quiet {
            return Ok(());
        }
        console::print(&Summary::of(biped, &plan.walk).to_string())?;
        console::print(&format!("{plan}  planned in       {milliseconds:.1} ms\n"))
    }
}

/// The first gait by one step goal.
fn steps(gaits: &[(&'static str, Usual)]) -> Result<Usual> {
    let found = gaits.iter().find(|(_, usual)| usual.gait.is_one_step());
    found.map(|(_, usual)| usual.clone()).ok_or_else(|| bad("this robot has no gait by one step goal"))
}

fn bad(text: &str) -> Error {
    Error::new(ErrorKind::BadValue, text)
}
