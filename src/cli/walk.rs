//! `groebot walk`: joint angles of a balanced walk, checked by the zero moment point.

use std::path::{Path, PathBuf};

use nalgebra::Point2;

use super::files::is_json;
use super::output::{Force, Kind, Output};
use super::progress::{Budget, Session};
use super::walker::{self, GaitName, Named, SoleArguments};
use super::{Outcome, console};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_algebra::limits;
use groebot_humanoid::gait::{
    Biped, Chains, Difference, Forces, Gait, GaitDefaults, Laws, Measures, Regular, Request, Route, Side, Summary,
    Walk, Walker, plan_at, step_commands,
};
use groebot_humanoid::walkers::Outline;
use groebot_robot::document::read_text;
use groebot_robot::robots;

/// The greatest length of a file of footsteps in bytes.
const FOOTSTEPS_LIMIT: u64 = limits::FOOTSTEPS_BYTES;

/// The greatest tilt of a supporting sole \[rad\]: the margins are those of level soles.
const MOST_TILT: f64 = 0.04;

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
  groebot walk jvrc1.urdf --outline=-0.1,0.13,-0.06,0.06,-0.1 --goal 1,0

Metres, seconds; degrees for --turn, --max-turn, --plan and in the summary, radians in files. The
last of --steps closes the feet: 8 steps of 0.04 m move 0.28 m forward.

A file of footsteps has the header foot,x,y,yaw and a line for each step: left or right, metres,
radians; it starts at the origin.

A phase that would be unstable or too fast is slowed down. Where that does not help, turns and steps
are shortened. A walk that cannot be made stable is an error.

Gaits: nao sine, preview, osg; rh0 rh0, rh0-real, osg; teo osg; others osg, preview. The first is
the default; others walk by preview where osg is refused.

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

/// The first swing foot.
#[derive(Clone, Copy, clap::ValueEnum)]
enum FootName {
    /// The left foot
    Left,
    /// The right foot
    Right,
}

/// Plans a balanced walk: joint angles from the derived solver that keep the zero moment point (ZMP) inside the support
/// polygon
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
#[command(group = clap::ArgGroup::new("route").args(["footsteps", "plan", "goal"]))]
pub struct Arguments {
    /// The robot: nao, rh0, teo, or a description in URDF or TOML
    #[arg(value_name = "ROBOT-or-FILE")]
    robot: String,
    #[command(flatten)]
    soles: SoleArguments,
    /// The number of steps; the last one closes the feet
    #[arg(long, default_value_t = 8, conflicts_with = "route")]
    steps: usize,
    /// x_d, L_p: the distance from the supporting foot forward to the landing foot [m] (default: the gait's)
    #[arg(long, value_name = "METRES", allow_hyphen_values = true, conflicts_with = "footsteps")]
    length: Option<f64>,
    /// The lateral distance to the left of each step of the foot on that side; the other one follows [m]
    #[arg(long, default_value_t = 0.0, value_name = "METRES", allow_hyphen_values = true, conflicts_with = "route")]
    aside: f64,
    /// The rotation of the whole walk, anticlockwise [degrees]
    #[arg(long, default_value_t = 0.0, value_name = "DEGREES", allow_hyphen_values = true, conflicts_with = "route")]
    turn: f64,
    /// G_CM: the maximum rotation of one step, or of a pair of steps in --plan [degrees] (default: the gait's)
    #[arg(long, value_name = "DEGREES")]
    max_turn: Option<f64>,
    /// The first swing foot
    #[arg(long, value_enum, default_value = "left", conflicts_with_all = ["footsteps", "plan"])]
    first: FootName,
    /// Read footsteps from this CSV file
    #[arg(long, value_name = "FILE")]
    footsteps: Option<PathBuf>,
    /// The walk as text, separated by commas: out, stride, in with left or right; turn left or right with degrees
    #[arg(long, value_name = "COMMANDS")]
    plan: Option<String>,
    /// Walk to a place in the initial frame of the feet: forward, to the left [m], and an optional final heading
    /// [degrees]
    #[arg(long, value_name = "X,Y[,HEADING]", value_delimiter = ',', num_args = 1, allow_hyphen_values = true)]
    goal: Option<Vec<f64>>,
    /// The gait: the law of motion of the centre of mass (default: the robot's first gait)
    #[arg(long, value_enum)]
    gait: Option<GaitName>,
    /// z_d, H_p: the height to which a foot is lifted [m] (default: the gait's)
    #[arg(long, value_name = "METRES")]
    lift: Option<f64>,
    /// W_p: half of the lateral distance between the feet [m] [default: half the width of the hips]
    #[arg(long, value_name = "METRES")]
    half_width: Option<f64>,
    /// A, W_p - RA_AS: the lateral displacement of the centre of mass [m] (default: the gait's)
    #[arg(long, value_name = "METRES")]
    amplitude: Option<f64>,
    /// K_CM: half of the trunk's descent until lift-off and landing [m] (default: the gait's); for one step goal
    #[arg(long, value_name = "METRES")]
    dip: Option<f64>,
    /// Po_CM: the exponent of the lateral motion (default: the gait's); for RH0's laws
    #[arg(long, value_name = "NUMBER")]
    power: Option<f64>,
    /// Start and end in the crouch, without lowering and rising; for one step goal
    #[arg(long)]
    crouched: bool,
    /// The number of samples in which the trunk is lowered, and rises [default: that of a step]; for one step goal
    #[arg(long, value_name = "COUNT", conflicts_with = "crouched", value_parser = clap::value_parser!(u32).range(1..))]
    descent_intervals: Option<u32>,
    /// The height of the hip axes above the floor [m] [default: the first feasible one of the gait]
    #[arg(long, value_name = "METRES")]
    hip_height: Option<f64>,
    /// The distance of the centre of mass forward of the ankles [m] (default: the gait's)
    #[arg(long, value_name = "METRES", allow_hyphen_values = true)]
    ahead: Option<f64>,
    /// The duration of a step [s] (default: the gait's)
    #[arg(long, value_name = "SECONDS")]
    period: Option<f64>,
    /// The fraction of a step in double support, between 0 and 1 (default: the gait's)
    #[arg(long, value_name = "SHARE")]
    double_support: Option<f64>,
    /// The duration of the rest before the first and after the last step [s] (default: the gait's)
    #[arg(long, value_name = "SECONDS")]
    rest: Option<f64>,
    /// S_D: the time between two rows [s] (default: the gait's)
    #[arg(long, value_name = "SECONDS")]
    tick: Option<f64>,
    /// The least distance of the zero moment point from the border of the support polygon [m] (default: the gait's)
    #[arg(long, value_name = "METRES")]
    margin: Option<f64>,
    /// The maximum joint velocity, as a fraction of the joint's limit (default: the gait's)
    #[arg(long, value_name = "SHARE")]
    speed: Option<f64>,
    /// The outline of the soles
    #[arg(long, value_enum, default_value = "measured")]
    sole: SoleName,
    /// Write the joint angles to this file: CSV, or JSON if its name ends in .json
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Write the joint angles to this JSON file
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Write the columns of the thesis' tables to this CSV file, in degrees and its axes; for rh0
    #[arg(long, value_name = "FILE")]
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
    let Named { walker, robot, .. } = walker::named(&arguments.robot, outline, &arguments.soles, &session.watch)?;
    let biped = &walker.biped;
    let walk = arguments.planned(&walker, &session.watch)?;
    drop(session);
    let summary = Summary::of(biped, &walk);
    if summary.tilt.value > MOST_TILT {
        let text = format!(
            "{}: a supporting sole would tilt by {:.1} deg at {:.2} s, because a leg of five joints does not hold this rotation; at most {:.1} deg are allowed, \
             because only its edge would touch the floor; move the body less to the sides (--amplitude)",
            biped.name,
            summary.tilt.value.to_degrees(),
            summary.tilt.time,
            MOST_TILT.to_degrees()
        );
        return Err(Error::new(ErrorKind::BadValue, text).into());
    }
    let forces = arguments.torques.then(|| walk.forces(biped));
    let chains = forces.as_ref().filter(|_| arguments.chains).map(|forces| walk.chains(biped, forces));
    arguments.write(&output, biped, &walk, (forces.as_deref(), chains.as_deref()))?;
    if arguments.budget.quiet {
        return Ok(());
    }
    console::print_notes(&robot.parts().notes);
    console::print(&summary.to_string())?;
    let Some(forces) = forces else { return Ok(()) };
    console::print(&torques(biped, &walk, &forces))?;
    chains.map_or(Ok(()), |chains| console::print(&difference(&walk.difference(biped, &forces, &chains))))
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
fn torques(biped: &Biped, walk: &Walk, forces: &[Forces]) -> String {
    let mut text = "greatest torques [N m, N]\n".to_owned();
    for greatest in walk.greatest_torques(biped, forces) {
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
    /// The walk by the given gait, or by the default one. A described robot walks by its first feasible gait.
    fn planned(&self, walker: &Walker, watch: &Watch) -> Result<Walk> {
        let biped = &walker.biped;
        let planned = |gait: GaitDefaults| {
            let defaults = self.defaults(gait)?;
            let request = |height, ease| self.request(&defaults.clone().eased(ease), biped, height);
            plan_at((biped, &walker.legs), self.hip_height, &defaults.hip_heights, request, watch)
        };
        let first = planned(walker::defaults(&walker.gaits, self.gait)?);
        let is_refused = first.as_ref().is_err_and(|error| error.kind() == ErrorKind::BadValue);
        if self.gait.is_some() || robots::robot(&self.robot).is_some() || !is_refused {
            return first;
        }
        let others = walker.gaits.iter().skip(1);
        others.map(|(_, gait)| planned(gait.clone())).find(Result::is_ok).unwrap_or(first)
    }

    /// The parameters of the gait `defaults`, with the given ones replaced.
    fn defaults(&self, mut defaults: GaitDefaults) -> Result<GaitDefaults> {
        let places = [
            (&mut defaults.length, self.length),
            (&mut defaults.lift, self.lift),
            (&mut defaults.amplitude, self.amplitude),
            (&mut defaults.ahead, self.ahead),
            (&mut defaults.period, self.period),
            (&mut defaults.double_support, self.double_support),
            (&mut defaults.rest, self.rest),
            (&mut defaults.tick, self.tick),
            (&mut defaults.margin, self.margin),
            (&mut defaults.speed_share, self.speed),
            (&mut defaults.most_turn, self.max_turn.map(f64::to_radians)),
        ];
        for (place, given) in places {
            *place = given.unwrap_or(*place);
        }
        defaults.half_width = self.half_width.or(defaults.half_width);
        let double = defaults.double_support;
        if !(double > 0.0 && double < 1.0) {
            return Err(bad(format!("--double-support is {double}; give a fraction between 0 and 1")));
        }
        self.one_step(&mut defaults.gait)?;
        Ok(defaults)
    }

    /// Sets the given parameters of one step goal.
    fn one_step(&self, gait: &mut Gait) -> Result<()> {
        let Gait::OneStep(one_step) = gait else {
            return match (self.dip, self.power, self.crouched, self.descent_intervals) {
                (None, None, false, None) => Ok(()),
                _ => {
                    let text = "--dip, --power, --crouched and --descent-intervals are for one step goal: --gait osg, rh0 or rh0-real";
                    Err(bad(text.into()))
                }
            };
        };
        one_step.dip = self.dip.unwrap_or(one_step.dip);
        match (&mut one_step.laws, self.power) {
            (_, None) => {}
            (Laws::Rh0 { power }, Some(given)) => *power = given,
            (Laws::Generic, Some(_)) => return Err(bad("--power is for RH0's laws: --gait rh0 or rh0-real".into())),
        }
        Ok(())
    }

    fn request(&self, defaults: &GaitDefaults, biped: &Biped, hip_height: f64) -> Result<Request> {
        let route = self.route(defaults, defaults.half_width(biped))?;
        let defaults = if self.crouched { defaults.clone() } else { defaults.clone().from_upright(biped) };
        let mut request = defaults.request(biped, route, hip_height);
        request.durations.lower = self.descent_intervals.map(|count| f64::from(count) * request.tick);
        Ok(request)
    }

    fn route(&self, defaults: &GaitDefaults, half_width: f64) -> Result<Route> {
        if let Some(file) = &self.footsteps {
            let text = read_text(file, FOOTSTEPS_LIMIT)?;
            return Route::from_csv(&text, half_width).map_err(|error| error.in_file(file));
        }
        let first = match self.first {
            FootName::Left => Side::Left,
            FootName::Right => Side::Right,
        };
        let measures = Measures { length: defaults.length, half_width, most_turn: defaults.most_turn };
        if let Some(text) = &self.plan {
            return Route::of_commands(&step_commands(text)?, &measures);
        }
        match self.goal.as_deref() {
            Some(&[x, y]) => return Route::towards(&Point2::new(x, y), None, first, &measures),
            Some(&[x, y, heading]) => {
                return Route::towards(&Point2::new(x, y), Some(heading.to_radians()), first, &measures);
            }
            Some(_) => return Err(bad("--goal takes two or three numbers: --goal 1,0.5 or --goal 1,0.5,90".into())),
            None => {}
        }
        let turn = self.turn.to_radians();
        Route::regular(&Regular {
            steps: self.steps,
            length: defaults.length,
            aside: self.aside,
            turn,
            half_width,
            first,
        })
    }

    /// The output; it replaces neither the robot nor the footsteps.
    fn output(&self) -> Result<Output> {
        let output = self.force.output(std::iter::once(Path::new(&self.robot)).chain(self.footsteps.as_deref()));
        output.expects([&self.out, &self.json, &self.thesis, &self.plot].map(Option::as_ref))
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
        if let Some(file) = &self.json {
            output.write(file, Kind::Json, walk.json_of(biped, &trajectory))?;
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

fn bad(text: String) -> Error {
    Error::new(ErrorKind::BadValue, text)
}
