//! `groebot task`: a robot walks through a furnished room, with a check of all samples.

use std::path::{Path, PathBuf};

use serde::Deserialize;
use serde_json::{Value, json};

use super::floor::{self, goal_at, moved, read_room, refurnished, start_at};
use super::json::FORMAT;
use super::navigate::MethodName;
use super::output::{Force, Kind, Output};
use super::progress::{Limits, Session};
use super::verify::Verification;
use super::view::soles;
use super::walker::{self, GaitName, Named, SoleArguments};
use super::{Halt, Outcome, console};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_humanoid::gait::{Footprint, Summary, Walk, Walker};
use groebot_humanoid::nav::Room;
use groebot_humanoid::sim::{Change, Checks, Destination, Performed, Run, Start, Thing, What, perform};
use groebot_humanoid::task::{Blocked, Body, Floor, Pilot, Plan};
use groebot_humanoid::view::{Page, WalkRecord};
use groebot_humanoid::walkers::Outline;
use groebot_robot::document::{one_among, shown};
use groebot_robot::spatial::angle::RPM;

const EXAMPLES: &str = "Examples:
  groebot task rh0 --room living-room --goal sofa -o task.json --view task.html
  groebot task rh0 --room living-room --goal sofa --furniture piano=1.2,0.4 -o task.json --view task.html
  groebot task rh0 --room encirclement --goal 7,3 --then 'chair=2.2,5,30@12' -o task.json
  groebot task nao --room room.toml --start 0.5,0.5 --goal chair --then goal=lamp@10 --json

RH0 5.5: path, footsteps and joint angles through the room, step by step. --then changes the room or
the goal during the walk, and the path is planned again from the robot's current place.

Afterwards every sample is checked: the distance of each link from each piece of furniture, the
walls and the floor, soles on the floor by forward kinematics, the margin of the zero moment point,
limits and speeds of the joints. The exit status is 1 if a check fails, 4 if there is no path.
--verify and --repair simulate the walk with MuJoCo, without furniture; the exit status is 5 if it
falls, and nothing is written.

Metres, and degrees for headings and yaws. The goal for a piece of furniture is the place in front
of it that is reached first. Rooms of groebot: living-room, encirclement (RH0 Fig. 5-25, 5-27).";

/// Plans the full task of a humanoid: a walk through a furnished room to a goal, with every sample checked
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The robot: nao, rh0, teo, or a description in URDF, xacro, MJCF, SDF or TOML
    #[arg(value_name = "ROBOT-or-FILE")]
    robot: String,
    #[command(flatten)]
    soles: SoleArguments,
    /// The room: living-room, encirclement, or TOML
    #[arg(long, value_name = "ROOM-or-FILE")]
    room: PathBuf,
    /// The goal: a piece of furniture, or a place with an optional final heading [m, degrees]
    #[arg(long, value_name = "NAME or X,Y[,HEADING]", allow_hyphen_values = true)]
    goal: String,
    /// The initial middle of the feet and heading [m, degrees] (default: the start of the room)
    #[arg(long, value_name = "X,Y[,HEADING]", value_delimiter = ',', num_args = 1, allow_hyphen_values = true)]
    start: Option<Vec<f64>>,
    /// Move a piece of furniture before the walk starts [m, degrees], or remove it
    #[arg(long, value_name = "NAME=X,Y[,YAW] or NAME=none")]
    furniture: Vec<String>,
    /// A change after this number of steps: furniture, or the goal
    #[arg(long, value_name = "NAME=X,Y[,YAW]@STEPS or NAME=none@STEPS or goal=GOAL@STEPS")]
    then: Vec<String>,
    /// The method that finds paths
    #[arg(long, value_name = "METHOD", default_value = "exact")]
    method: MethodName,
    /// The gait by one step goal [default: the robot's first one; rh0-sim has the parameters of RH0 5.5]
    #[arg(long, value_enum)]
    gait: Option<GaitName>,
    /// The least distance of the body from obstacles [m]
    #[arg(long, value_name = "METRES", default_value_t = 0.02, allow_hyphen_values = true)]
    apart: f64,
    /// Write walk, paths and checks to this JSON file, which `groebot view` reads
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Write an HTML page of the walk to this file
    #[arg(long, value_name = "FILE")]
    view: Option<PathBuf>,
    /// Write a picture of room, last path and footsteps to this SVG file, if there is a path
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// Print paths and checks as JSON instead of the summary
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

/// A pilot, and its run.
type Done = (Pilot, std::result::Result<Performed, Blocked>);

fn walk_of((_, done): &Done) -> Option<&Walk> {
    done.as_ref().ok().map(|performed| &performed.walk)
}

/// Runs the task and writes the requested files.
pub fn run(arguments: &Arguments) -> Outcome {
    let output = arguments.force.output([Path::new(&arguments.robot), arguments.room.as_path()]);
    let output = output.expects([arguments.out.as_ref(), arguments.view.as_ref(), arguments.plot.as_ref()])?;
    let session = Session::start(Limits { quiet: arguments.quiet, ..Limits::default() })?;
    let mut named = walker::named(&arguments.robot, Outline::Measured, &arguments.soles, &session.watch)?;
    walker::prefer(&mut named.walker, arguments.gait)?;
    if arguments.gait.is_some() && !named.walker.gaits[0].1.gait.is_one_step() {
        return Err(
            bad("a task needs a gait by one step goal: goal and room may change between its steps".into()).into()
        );
    }
    let room = refurnished(read_room(&arguments.room)?, &arguments.furniture)?;
    let changes = arguments.changes(&room)?;
    let plan = |walker: &Walker| -> Result<Done> {
        let run = arguments.start(&named, walker, room.clone(), &session.watch)?;
        Ok((run.pilot().clone(), perform(run, &changes, &session.watch)?))
    };
    let verified = arguments.verification.planned(&named, &session.watch, plan, walk_of)?;
    let notes = [named.robot.parts().notes.clone(), verified.notes].concat();
    let (pilot, performed) = match verified.plan {
        (pilot, Ok(performed)) => (pilot, performed),
        (_, Err(blocked)) => {
            drop(session);
            return arguments.refuse(&blocked, &notes);
        }
    };
    let checks = Checks::of(&named.robot, &named.meshes, &named.walker.biped, &performed, &session.watch)?;
    drop(session);
    let mut json_report = json_report(&performed, &checks);
    arguments.write(&output, &named, &performed, &json_report)?;
    if let (Some(file), Some(last)) = (&arguments.plot, performed.stages.last()) {
        let plan =
            Plan { course: last.course.clone(), walk: performed.walk.clone(), refusals: Vec::new(), unblended: None };
        let floor = Floor::new(&last.room.map()?, arguments.apart)?;
        output.write(file, Kind::Markup, plan.to_svg(&pilot, &floor))?;
    }
    if arguments.json {
        (json_report["format"], json_report["passed"]) = (FORMAT.into(), checks.hold().into());
        json_report["notes"] = notes.into();
        console::print(&super::json::text(&json_report))?;
    } else if !arguments.quiet {
        console::print_notes(&notes);
        console::print(&Summary::of(&named.walker.biped, &performed.walk).to_string())?;
        console::print(&summary(&performed, &checks))?;
    }
    if checks.hold() { Ok(()) } else { Err(failed(&checks).into()) }
}

impl Arguments {
    /// The run at its start.
    fn start(&self, named: &Named, walker: &Walker, room: Room, watch: &Watch) -> Result<Run> {
        let middle = match (&self.start, room.start) {
            (Some(numbers), _) => start_at(numbers)?,
            (None, Some([x, y, yaw])) => Footprint { x, y, yaw },
            (None, None) => {
                let text = "the room has no start; give --start X,Y[,HEADING]";
                return Err(Error::new(ErrorKind::MissingKey, text));
            }
        };
        let start = Start {
            walker: walker.clone(),
            body: Body::new(&named.robot, &walker.biped, &named.meshes)?,
            goal: destination(&self.goal, &room)?,
            room,
            apart: self.apart,
            middle,
            method: self.method.method(),
        };
        Run::new(start, watch)
    }

    fn changes(&self, room: &Room) -> Result<Vec<Change>> {
        let change = |option: &String| {
            let wrong =
                || bad(format!("--then `{}`: give NAME=X,Y@STEPS, NAME=none@STEPS or goal=GOAL@STEPS", shown(option)));
            let (what, after) = option.rsplit_once('@').ok_or_else(wrong)?;
            let after = after.parse().map_err(|_| wrong())?;
            let what = match what.strip_prefix("goal=") {
                Some(goal) => What::Goal(destination(goal, room)?),
                None => {
                    let (name, place) = moved(what)?;
                    What::Furniture(room.piece(name)?.name.clone(), place)
                }
            };
            Ok(Change { after, what })
        };
        let mut changes: Vec<Change> = self.then.iter().map(change).collect::<Result<_>>()?;
        changes.sort_by_key(|change| change.after);
        Ok(changes)
    }

    /// Reports that there is no path.
    fn refuse(&self, blocked: &Blocked, notes: &[String]) -> Outcome {
        let enclosure = floor::enclosure(&blocked.map, &blocked.enclosure);
        if self.json {
            let json_report = json!({ "format": FORMAT, "passed": false, "enclosure": enclosure, "notes": notes });
            console::print(&super::json::text(&json_report))?;
        }
        console::line("error", &blocked.to_string());
        Err(Halt::NoPath)
    }

    fn write(&self, output: &Output, named: &Named, performed: &Performed, json_report: &Value) -> Outcome {
        if self.out.is_none() && self.view.is_none() {
            return Ok(());
        }
        let biped = &named.walker.biped;
        let trajectory = performed.walk.trajectory(biped);
        let mut value = performed.walk.json_value(biped, &trajectory);
        if let Some(file) = &self.view {
            let record = WalkRecord::deserialize(&value["walk"]).expect("a record that was just written is valid");
            let page = Page::of_robot(&named.robot, None)?.titled(&format!("{}: the full task", biped.name));
            let page = page.with_motion(&trajectory, Some(&record), &soles(named.robot.name())?)?;
            output.write(file, Kind::Markup, page.with_task(performed.record()).to_html())?;
        }
        if let Some(file) = &self.out {
            value["task"] = json_report.clone();
            output.write(file, Kind::Json, value.to_string() + "\n")?;
        }
        Ok(())
    }
}

/// A destination: a place by its numbers, or a piece of furniture by its name.
fn destination(goal: &str, room: &Room) -> Result<Destination> {
    let numbers: Option<Vec<f64>> = goal.split(',').map(|word| word.trim().parse().ok()).collect();
    match numbers {
        Some(numbers) => goal_at(&numbers).map(Destination::Place),
        None if room.piece(goal).is_ok() => Ok(Destination::Before(goal.to_owned())),
        None => {
            let names: Vec<&str> = room.pieces.iter().map(|piece| piece.name.as_str()).collect();
            let text = format!("there is no furniture `{}`{}; or give X,Y", shown(goal), one_among(goal, &names));
            Err(Error::new(ErrorKind::UnknownName, text))
        }
    }
}

/// Room, paths and checks as JSON.
fn json_report(performed: &Performed, checks: &Checks) -> Value {
    let time = |sample: usize| performed.walk.time(sample);
    let clearance = |own: &groebot_humanoid::sim::Clearance| json!({ "link": own.link, "object": own.thing.to_string(), "distance": own.distance, "time": time(own.sample) });
    let mut json_report = serde_json::to_value(performed.record()).expect("a record can be represented in JSON");
    json_report["checks"] = json!({
        "passed": checks.hold(),
        "clearances": checks.clearances.iter().map(clearance).collect::<Vec<_>>(),
        "sole_deviation": checks.soles_off,
        "sole_penetration": checks.soles_under,
        "margin": checks.margin,
        "fastest": { "joint": checks.fastest.0, "rpm": RPM * checks.fastest.1 },
        "findings": checks.findings.len(),
        "samples_per_step": [checks.samples_per_step.0, checks.samples_per_step.1],
    });
    json_report
}

fn summary(performed: &Performed, checks: &Checks) -> String {
    let stage = |own: &groebot_humanoid::sim::Stage| {
        let length = own.course.path.length();
        format!("  path            {length:.3} m after step {}, found in {:.1} ms\n", own.steps, own.milliseconds)
    };
    let paths: String = performed.stages.iter().map(stage).collect();
    let beside = |is_floor: bool| checks.clearances.iter().find(move |own| (own.thing == Thing::Floor) == is_floor);
    let near = |own: &groebot_humanoid::sim::Clearance| {
        let (distance, time) = (100.0 * own.distance, performed.walk.time(own.sample));
        format!("  nearest         {} to {}, {distance:.1} cm at {time:.2} s\n", own.link, own.thing)
    };
    let nearest: String = [false, true].into_iter().filter_map(beside).map(near).collect();
    let (least, most) = checks.samples_per_step;
    let samples = if least == most { least.to_string() } else { format!("{least} to {most}") };
    format!(
        "{paths}{nearest}  soles           off the floor by {:.1e} m in support\n  fastest         {} rotates at {:.1} rpm\n  samples         {samples} a step\n",
        checks.soles_off,
        checks.fastest.0,
        RPM * checks.fastest.1,
    )
}

/// The error for failed checks.
fn failed(checks: &Checks) -> Error {
    let meets = checks.clearances.first().filter(|own| own.distance <= 0.0);
    let text = match (meets, checks.findings.first()) {
        (Some(own), _) => format!("a check failed: {} collides with {} at sample {}", own.link, own.thing, own.sample),
        (None, Some(finding)) => format!("a check failed at sample {}: {:?}", finding.sample, finding.fault),
        (None, None) => format!(
            "a check failed: soles are off the floor by {:e} m, the least margin is {} m",
            checks.soles_off.max(checks.soles_under),
            checks.margin
        ),
    };
    bad(text)
}

fn bad(text: String) -> Error {
    Error::new(ErrorKind::BadValue, text)
}
