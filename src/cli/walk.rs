//! `groebot walk`: joint angles of a balanced walk, checked by the zero moment point.

use std::path::{Path, PathBuf};

use super::files::is_json;
use super::output::{Force, Kind, Output};
use super::progress::{Budget, Session};
use super::verify::{Verification, Verified};
use super::walk_json::WalkReport;
use super::walk_request::RequestArguments;
use super::walker::{self, SoleArguments};
use super::{Outcome, console, json};
use crate::Result;
use groebot_humanoid::gait::{Biped, Chains, Difference, Forces, Greatest, Summary, Walk, Walker};
use groebot_humanoid::walkers::Outline;
use groebot_robot::robots;

/// A margin below both is reported: \[m\], and as a fraction of the sole's width.
const LEAST_MARGIN: f64 = 0.005;
const LEAST_SHARE: f64 = 0.05;

const EXAMPLES: &str = "Examples:
  groebot walk nao --steps 8 -o walk.csv --plot walk.svg
  groebot walk nao --steps 8 --length 0 --turn 40 -o turn.csv
  groebot walk nao --steps 8 --length 0 --aside 0.02 --amplitude 0.04
  groebot walk nao --steps 12 --gait preview -o dynamic.csv
  groebot walk nao --footsteps steps.csv -o curve.json
  groebot walk nao --goal 2,0 --plot goal.svg
  groebot walk teo --goal 1,0 --torques -o forces.csv
  groebot walk rh0 --torques --chains -o chains.csv
  groebot walk rh0 --plan \"out right, stride left, stride right, in left\" --thesis joints.csv
  groebot walk rh0 --plan \"turn left 90\" --plot turn.svg
  groebot walk teo --goal 1,0.5 -o goal.csv
  groebot walk talos.urdf --goal 1,0 -o walk.csv
  groebot walk talos.urdf --goal 1,0 --verify -o walk.csv
  groebot walk jvrc1.urdf --outline=-0.1,0.13,-0.06,0.06,-0.1 --goal 1,0

Metres, seconds; degrees for --turn, --max-turn, --plan and in the summary, radians in files. The
last of --steps closes the feet: 8 steps of 0.04 m move 0.28 m forward.

A file of footsteps has the header foot,x,y,yaw and a line for each step: left or right, metres,
radians; it starts at the origin.

A phase that would be unstable or too fast is slowed down. Where that does not help, turns and steps
are shortened. A walk that cannot be made stable is an error. --verify and --repair simulate it with
MuJoCo (`groebot simulate --help`); the exit status is 5 if it falls, and nothing is written.

Gaits: nao sine, preview, osg; rh0 rh0, rh0-sim, rh0-real, osg, preview; teo osg, preview; others
preview, osg. The first is the default (rh0-sim with --thesis); others walk by osg where preview is
refused.

For a description, the soles are searched (--left, --right), and the solvers of the legs are derived:
six joints each, or five, from the root link to the links of the soles. Joints that move both legs
are held at zero. A root link with other axes than x forward, y left, z up is turned by quarter
turns. The feet are level at zero. The contact points are the lowest points of the collision shapes;
meshes must be STL. Without readable shapes the sole is assumed, with a note.";

/// The outline of the soles.
#[derive(Clone, Copy, clap::ValueEnum)]
enum SoleName {
    /// As measured on the robot
    Measured,
    /// As published: 160 x 90 mm for NAO
    #[value(alias = "seed")]
    Published,
}

/// Plans a balanced walk: joint angles from the derived solver that keep the zero moment point (ZMP) inside the support
/// polygon
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The robot: nao, rh0, teo, or a description in URDF, xacro, MJCF, SDF or TOML
    #[arg(value_name = "ROBOT-or-FILE")]
    robot: String,
    #[command(flatten)]
    soles: SoleArguments,
    #[command(flatten)]
    request: RequestArguments,
    /// The outline of the soles
    #[arg(long, value_enum, default_value = "measured")]
    sole: SoleName,
    /// Write the joint angles to this file: CSV, or JSON if its name ends in .json
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Write the columns of the thesis' tables to this CSV file, in degrees and its axes; for rh0, by default with the
    /// parameters of the thesis' simulations
    #[arg(long, value_name = "FILE", conflicts_with = "repair")]
    thesis: Option<PathBuf>,
    /// Write a picture to this SVG file
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// Add joint torques (inverse dynamics, RNEA) and ground reaction forces: columns of torques and forces, and the
    /// largest torques next to the motors' limits
    #[arg(long)]
    torques: bool,
    /// Add the torques of two chains, each on its own foot, RH0 (3-40) and (3-41), the wrench between them through the
    /// trunk, and their difference
    #[arg(long, requires = "torques")]
    chains: bool,
    /// Print the summary as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    verification: Verification,
    #[command(flatten)]
    budget: Budget,
    #[command(flatten)]
    force: Force,
}

/// Plans the walk and writes the requested files.
pub fn run(arguments: &Arguments) -> Outcome {
    let outline = match arguments.sole {
        SoleName::Measured => Outline::Measured,
        SoleName::Published => Outline::Published,
    };
    let output = arguments.output()?;
    let session = Session::start(arguments.budget.limits())?;
    let mut named = walker::named(&arguments.robot, outline, &arguments.soles, &session.watch)?;
    if arguments.thesis.is_some() {
        named.walker.gaits.sort_by_key(|(name, _)| *name != "rh0-sim");
    }
    let (biped, is_described) = (&named.walker.biped, robots::robot(&arguments.robot).is_none());
    let plan = |walker: &Walker| arguments.request.planned(walker, is_described, &session.watch);
    let Verified { plan: walk, notes } =
        arguments.verification.planned(&named, &session.watch, plan, |walk| Some(walk))?;
    drop(session);
    let summary = Summary::of(biped, &walk);
    let forces = arguments.torques.then(|| walk.forces(biped));
    let chains = forces.as_ref().filter(|_| arguments.chains).map(|forces| walk.chains(biped, forces));
    arguments.write(&output, biped, &walk, (forces.as_deref(), chains.as_deref()))?;
    let notes = [named.robot.parts().notes.clone(), notes, narrow(biped, &summary).into_iter().collect()].concat();
    let report = WalkReport {
        summary: &summary,
        torques: forces.as_ref().map(|forces| walk.greatest_torques(biped, forces)),
        chains: forces.zip(chains).map(|(forces, chains)| walk.difference(biped, &forces, &chains)),
        notes: &notes,
    };
    if arguments.json {
        return console::print(&json::text(&report.json()));
    }
    if arguments.budget.quiet {
        return Ok(());
    }
    console::print_notes(&notes);
    console::print(&summary.to_string())?;
    console::print(&report.torques.as_deref().map(torques).unwrap_or_default())?;
    console::print(&report.chains.as_ref().map(difference).unwrap_or_default())
}

/// A note about a margin below 5 mm and 5 % of the sole's width, which a walk has only on request.
pub fn narrow(biped: &Biped, summary: &Summary) -> Option<String> {
    let sides = biped.feet[0].corners.iter().map(|corner| corner.y);
    let (low, high) = sides.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), y| (low.min(y), high.max(y)));
    let least = LEAST_MARGIN.min(LEAST_SHARE * (high - low));
    let margin = summary.margin.value;
    (margin < least).then(|| {
        let (margin, least) = (1e3 * margin, 1e3 * least);
        format!("the least margin is {margin:.1} mm; walks with less than {least:.1} mm may fall in physics (--verify)")
    })
}

/// The differences between two chains and the whole multibody, as text.
fn difference(found: &Difference) -> String {
    let Difference { torque, joint, time, swinging, between: [force, moment], rounding, .. } = found;
    format!(
        "two chains, each on its own foot\n  torques differ by up to {torque:.3} N m: {joint} at {time:.2} s\n  a swing foot would need up to {swinging:.1} N\n  \
         the trunk transmits up to {force:.1} N and {moment:.2} N m; with that, torques differ by {rounding:.1e}\n"
    )
}

/// The greatest torque of each joint, next to its motor's limit.
fn torques(all: &[Greatest]) -> String {
    let mut text = "greatest torques [N m, N]\n".to_owned();
    for greatest in all {
        let effort = match greatest.effort {
            Some(effort) if greatest.torque > effort => format!("more than the motor's {effort}"),
            Some(effort) => format!("of {effort}"),
            None => String::new(),
        };
        text += format!("  {}: {:.3} at {:.2} s {effort}", greatest.joint, greatest.torque, greatest.time).trim_end();
        text += "\n";
    }
    text
}

impl Arguments {
    /// The output; it replaces neither the robot nor the footsteps.
    fn output(&self) -> Result<Output> {
        let output =
            self.force.output(std::iter::once(Path::new(&self.robot)).chain(self.request.footsteps.as_deref()));
        output.expects([&self.out, &self.thesis, &self.plot].map(Option::as_ref))
    }

    fn write(
        &self,
        output: &Output,
        biped: &Biped,
        walk: &Walk,
        (forces, chains): (Option<&[Forces]>, Option<&[Chains]>),
    ) -> Outcome {
        let mut trajectory =
            forces.map_or_else(|| walk.trajectory(biped), |forces| walk.trajectory_with_forces(biped, forces));
        if let Some(chains) = chains {
            walk.add_chains(biped, chains, &mut trajectory);
        }
        if let Some(file) = &self.out {
            let text = if is_json(file) { walk.json_of(biped, &trajectory) } else { trajectory.to_csv() };
            output.write(file, Kind::of_motion(file), text)?;
        }
        if let Some(file) = &self.thesis {
            output.write(file, Kind::Plain, walk.to_thesis_csv(biped)?)?;
        }
        if let Some(file) = &self.plot {
            output.write(file, Kind::Markup, walk.to_svg(biped))?;
        }
        Ok(())
    }
}
