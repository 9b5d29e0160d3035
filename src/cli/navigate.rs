//! `groebot navigate`: path and footsteps of a humanoid on a map.

use std::path::{Path, PathBuf};
use std::time::Instant;

use clap::ValueEnum;
use serde_json::{Value, json};

use super::files::is_json;
use super::floor::{self, FloorArguments, PlaceArguments};
use super::json::FORMAT;
use super::output::{Force, Kind, Output};
use super::progress::{Limits, Session};
use super::verify::Verification;
use super::walk::narrow;
use super::walker::{self, GaitName, Named, SoleArguments};
use super::{Halt, Outcome, console};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_humanoid::gait::{Footstep, Summary, Walk, Walker};
use groebot_humanoid::task::{Blocked, Body, Floor, Method, Navigator, Pilot, Plan, Refusal};
use groebot_humanoid::walkers::Outline;

const EXAMPLES: &str = "Examples:
  groebot navigate rh0 --map room.yaml --goal 3.2,1.5 -o walk.csv --plot plan.svg
  groebot navigate nao --map room.txt --resolution 0.05 --start 0.5,0.5,90 --goal 2,1.5,0
  groebot navigate teo --map room.yaml --goal 3.2,1.5 --method m3r
  groebot navigate rh0 --map living_room.toml --furniture piano=1.2,0.4 --goal 4,3
  groebot navigate talos.urdf --map room.yaml --goal 3,1

Metres, and degrees for headings; radians in files. The path is that of the middle of the feet. It
has room for the robot at every heading; if there is no such path, room for the core of its body.

Footsteps follow the path as far as legs and limits permit; where that fails, they are searched.
Each step is first planned as a walk of its own by one step goal, checked at every sample: soles on
free cells, distance of the body from obstacles, joints within limits and speeds, the zero moment
point within its margin. Then preview control walks all footsteps without rests between them, with
the same checks. Where that fails even slowly, the robot rests after each step, with a note; so it
does by --gait osg.

--verify and --repair simulate the walk with MuJoCo, without the obstacles. The exit status is 5 if it
falls, and nothing is written.

If there is no path, the exit status is 4, and picture and JSON show the cells that enclose start or
goal.";

/// Plans the path of a humanoid on a map, its footsteps, and the joint angles of the walk
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The robot: nao, rh0, teo, or a description in URDF, xacro, MJCF, SDF or TOML
    #[arg(value_name = "ROBOT-or-FILE")]
    robot: String,
    #[command(flatten)]
    soles: SoleArguments,
    /// The map: ROS YAML with its image, PGM, PNG, text, a room in TOML, or living-room or encirclement
    #[arg(long, value_name = "FILE")]
    map: PathBuf,
    #[command(flatten)]
    floor: FloorArguments,
    #[command(flatten)]
    places: PlaceArguments,
    /// The method that finds the path
    #[arg(long, value_name = "METHOD", default_value = "exact")]
    method: MethodName,
    /// The length and width of the body, seen from above (default: from the shapes of the description) [m]
    #[arg(long, value_name = "LENGTH,WIDTH", value_delimiter = ',', num_args = 1)]
    body: Option<Vec<f64>>,
    /// The gait: preview walks without rests between the steps, a gait by one step goal rests after each [default: preview]
    #[arg(long, value_enum)]
    gait: Option<GaitName>,
    /// Start and end in the crouch, without lowering and rising
    #[arg(long)]
    crouched: bool,
    /// Write the joint angles to this file: CSV, or JSON if its name ends in .json
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Write a picture of map, path and footsteps to this SVG file
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// Print path, footsteps and refused steps as JSON instead of the summary
    #[arg(long)]
    json: bool,
    /// Print neither progress nor summary
    #[arg(long)]
    quiet: bool,
    #[command(flatten)]
    verification: Verification,
    #[command(flatten)]
    force: Force,
}

#[derive(Clone, Copy, ValueEnum)]
pub(super) enum MethodName {
    /// The shortest path
    Exact,
    /// The descent path of a fast marching field
    Fmm,
    /// The descent path of an M3R field (RH0 thesis)
    M3r,
    /// The descent path of an artificial potential field, which may end in a local minimum
    Potential,
}

/// A plan, or the proof that there is no path.
type Found = std::result::Result<Plan, Blocked>;

/// The result of a navigator.
struct Navigated {
    navigator: Navigator,
    found: Found,
    /// The time of planning \[ms\].
    milliseconds: f64,
}

fn walk_of(navigated: &Navigated) -> Option<&Walk> {
    navigated.found.as_ref().ok().map(|plan| &plan.walk)
}

/// Plans the walk and writes the requested files.
pub fn run(arguments: &Arguments) -> Outcome {
    let output = arguments.output()?;
    let session = Session::start(Limits { quiet: arguments.quiet, ..Limits::default() })?;
    let named = walker::named(&arguments.robot, Outline::Measured, &arguments.soles, &session.watch)?;
    let (map, default_start) = arguments.floor.map(&arguments.map)?;
    let floor = Floor::new(&map, arguments.places.apart)?;
    let (start, goal) = (arguments.places.start(default_start)?, arguments.places.goal()?);
    let search = goal.by(arguments.method.method());
    let plan = |walker: &Walker| -> Result<Navigated> {
        let navigator = arguments.navigator(&named, walker, &session.watch)?;
        let begun = Instant::now();
        let found = navigator.plan(&floor, &start, search, &session.watch)?;
        Ok(Navigated { navigator, found, milliseconds: 1e3 * begun.elapsed().as_secs_f64() })
    };
    let verified = arguments.verification.planned(&named, &session.watch, plan, walk_of)?;
    let Navigated { navigator, found, milliseconds } = verified.plan;
    let pilot = navigator.pilot();
    drop(session);
    match &found {
        Ok(plan) => arguments.write(&output, pilot, &floor, plan)?,
        Err(blocked) => {
            if let Some(file) = &arguments.plot {
                output.write(file, Kind::Markup, blocked.to_svg(&floor, &start.point(), &goal.place))?;
            }
        }
    }
    let own = found.as_ref().map(|plan| notes(pilot, plan)).unwrap_or_default();
    let notes = [named.robot.parts().notes.clone(), own, verified.notes].concat();
    if arguments.json {
        let mut json_report = arguments.json_report(pilot, &found, milliseconds);
        json_report["notes"] = notes.into();
        console::print(&super::json::text(&json_report))?;
    } else if !arguments.quiet {
        console::print_notes(&notes);
    }
    match found {
        Ok(_) if arguments.json || arguments.quiet => Ok(()),
        Ok(plan) => {
            console::print(&Summary::of(&pilot.walker().biped, &plan.walk).to_string())?;
            console::print(&format!("{plan}  planned in       {milliseconds:.1} ms\n"))
        }
        Err(blocked) => {
            console::line("error", &blocked.to_string());
            Err(Halt::NoPath)
        }
    }
}

impl Arguments {
    fn navigator(&self, named: &Named, walker: &Walker, watch: &Watch) -> Result<Navigator> {
        let body = match self.body.as_deref() {
            Some(&[length, width]) => Body::of_size(length, width)?,
            Some(_) => return Err(bad("--body takes two numbers: --body 0.3,0.5")),
            None => Body::new(&named.robot, &walker.biped, &named.meshes)?,
        };
        let gait = self.gait.map(GaitName::name);
        Navigator::new(walker.clone(), gait.as_deref(), body, !self.crouched, watch)
    }

    /// The output; it replaces neither the robot nor the map.
    fn output(&self) -> Result<Output> {
        let output = self.force.output([Path::new(&self.robot), self.map.as_path()]);
        output.expects([self.out.as_ref(), self.plot.as_ref()])
    }

    fn write(&self, output: &Output, pilot: &Pilot, floor: &Floor, plan: &Plan) -> Outcome {
        let biped = &pilot.walker().biped;
        if let Some(file) = &self.out {
            let text = if is_json(file) { plan.walk.to_json(biped) } else { plan.walk.to_csv(biped) };
            output.write(file, Kind::of_motion(file), text)?;
        }
        match &self.plot {
            Some(file) => output.write(file, Kind::Markup, plan.to_svg(pilot, floor)),
            None => Ok(()),
        }
    }

    fn json_report(&self, pilot: &Pilot, found: &Found, milliseconds: f64) -> Value {
        let method = self.method.to_possible_value().map(|value| value.get_name().to_owned());
        let biped = &pilot.walker().biped;
        let mut json_report =
            json!({ "format": FORMAT, "robot": biped.name, "method": method, "milliseconds": milliseconds });
        let step = |Footstep { side, print, .. }: &Footstep| json!({ "foot": side.name(), "x": print.x, "y": print.y, "yaw": print.yaw });
        match found {
            Ok(plan) => {
                let summary = Summary::of(biped, &plan.walk);
                json_report["points"] = floor::points(&plan.course.path);
                json_report["length"] = plan.course.path.length().into();
                json_report["clear_at_every_heading"] = plan.course.is_wide.into();
                json_report["steps"] = plan.walk.schedule.route.steps.iter().map(step).collect();
                json_report["seconds"] = summary.duration.into();
                json_report["rests_between_steps"] = summary.gait.is_one_step().into();
                json_report["margin"] = summary.margin.value.into();
                let refused = |refusal: &Refusal| {
                    let mut value = step(&refusal.footstep);
                    value["step"] = refusal.step.into();
                    value["reason"] = refusal.to_string().into();
                    value
                };
                json_report["rejected_steps"] = plan.refusals.iter().map(refused).collect();
            }
            Err(blocked) => {
                json_report["points"] = Value::Null;
                json_report["enclosure"] = floor::enclosure(&blocked.map, &blocked.enclosure);
            }
        }
        json_report
    }
}

impl MethodName {
    pub fn method(self) -> Method {
        match self {
            MethodName::Exact => Method::Exact,
            MethodName::Fmm => Method::FastMarching,
            MethodName::M3r => Method::M3r,
            MethodName::Potential => Method::Potential,
        }
    }
}

/// The notes of a plan, and one about a small margin.
fn notes(pilot: &Pilot, plan: &Plan) -> Vec<String> {
    let biped = &pilot.walker().biped;
    let narrow = narrow(biped, &Summary::of(biped, &plan.walk));
    plan.notes().into_iter().chain(narrow).collect()
}

fn bad(text: &str) -> Error {
    Error::new(ErrorKind::BadValue, text)
}
