//! `groebot walk`: joint angles of a walk that does not fall, with their proof by the zero moment point.

use std::path::{Path, PathBuf};

use super::progress::{Limits, Session};
use super::{Outcome, console};
use crate::document::read_text;
use crate::files::write_atomically;
use crate::gait::{
    Durations, Gait, Humanoid, NaoLegs, Outline, Regular, Request, Route, Side, Style, Summary, Walk, nao, plan,
};
use crate::{Error, ErrorKind, Result, Watch};

/// The longest file of footsteps, in bytes.
const FOOTSTEPS_LIMIT: u64 = 4_000_000;
/// From the axes of the hip up to the origin of the torso \[m\]: HipOffsetZ of NAO Table 6.1.
const HIP_TO_TORSO: f64 = 0.085;
/// Half of the way from foot to foot \[m\]: HipOffsetY of NAO Table 6.1.
const HALF_WIDTH: f64 = 0.05;

const EXAMPLES: &str = "Examples:
  groebot walk nao --steps 8 -o walk.csv --plot walk.svg
  groebot walk nao --steps 8 --length 0 --turn 40 -o turn.csv
  groebot walk nao --steps 12 --gait preview -o dynamic.csv
  groebot walk nao --footsteps steps.csv -o curve.json

Metres, seconds; degrees for --turn and in the summary, radians in files. The last step closes the feet: 8 steps of 0.04 m lead 0.28 m ahead.
A file of footsteps has the header foot,x,y,yaw and a line for each step: left or right, metres, radians; it starts at the origin.
Rows are 0.01 s apart. A phase that would be unstable or too fast is slowed down; a walk that no slower phase makes stable is refused.";

/// How the centre of mass is moved.
#[derive(Clone, Copy, clap::ValueEnum)]
enum GaitName {
    /// The seed's sine: over one foot the centre of mass rests
    Seed,
    /// Preview control of the zero moment point: the centre of mass never rests
    Preview,
}

/// Which soles.
#[derive(Clone, Copy, clap::ValueEnum)]
enum SoleName {
    /// As measured on the robot
    Measured,
    /// 160 x 90 mm, as the seed has it
    Seed,
}

/// Which foot steps first.
#[derive(Clone, Copy, clap::ValueEnum)]
enum FootName {
    /// The left foot
    Left,
    /// The right foot
    Right,
}

/// The robot that walks.
#[derive(Clone, Copy, clap::ValueEnum)]
enum RobotName {
    /// NAO V5
    Nao,
}

/// Plans a walk that keeps its zero moment point over the feet, with joint angles by the derived solver
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The robot
    robot: RobotName,
    /// The number of steps; the last one closes the feet
    #[arg(long, default_value_t = 8, conflicts_with = "footsteps")]
    steps: usize,
    /// x_d: how far ahead of the standing foot the other one lands [m] [default: 0.04, or 0.05 with --gait preview]
    #[arg(long, value_name = "METRES", allow_hyphen_values = true, conflicts_with = "footsteps")]
    length: Option<f64>,
    /// The turn of the whole walk, anticlockwise [degrees]
    #[arg(
        long,
        default_value_t = 0.0,
        value_name = "DEGREES",
        allow_hyphen_values = true,
        conflicts_with = "footsteps"
    )]
    turn: f64,
    /// The foot that steps first
    #[arg(long, value_enum, default_value = "left", conflicts_with = "footsteps")]
    first: FootName,
    /// Footsteps from a CSV file
    #[arg(long, value_name = "FILE")]
    footsteps: Option<PathBuf>,
    /// How the centre of mass is moved
    #[arg(long, value_enum, default_value = "seed")]
    gait: GaitName,
    /// z_d: how high a foot is lifted [m] [default: 0.02, or 0.03 with --gait preview]
    #[arg(long, value_name = "METRES")]
    lift: Option<f64>,
    /// A: how far to the side the centre of mass goes [m]
    #[arg(long, default_value_t = 0.05, value_name = "METRES")]
    amplitude: f64,
    /// The height of the axes of the hip over the floor [m] [default: the first of 0.228, 0.225, 0.232, 0.222, 0.215, 0.205 that works]
    #[arg(long, value_name = "METRES")]
    hip_height: Option<f64>,
    /// How far ahead of the ankles the centre of mass is held [m]
    #[arg(long, default_value_t = 0.005, value_name = "METRES", allow_hyphen_values = true)]
    ahead: f64,
    /// The time of a step [s] [default: 1.6, or 0.8 with --gait preview]
    #[arg(long, value_name = "SECONDS")]
    period: Option<f64>,
    /// The share of a step in which both feet stand [default: 0.66, or 0.3 with --gait preview]
    #[arg(long, value_name = "SHARE")]
    double_support: Option<f64>,
    /// How long the robot stands before the first and behind the last step [s] [default: 0.5, or 1.5 with --gait preview]
    #[arg(long, value_name = "SECONDS")]
    rest: Option<f64>,
    /// The least distance of the zero moment point from the border of the support polygon [m]
    #[arg(long, default_value_t = 0.01, value_name = "METRES")]
    margin: f64,
    /// The greatest share of its own speed that a joint may have
    #[arg(long, default_value_t = 0.9, value_name = "SHARE")]
    speed: f64,
    /// The outline of the soles
    #[arg(long, value_enum, default_value = "measured")]
    sole: SoleName,
    /// Where the joint angles go: CSV, or JSON when the name ends in .json
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Where the same goes as JSON
    #[arg(long, value_name = "FILE")]
    json: Option<PathBuf>,
    /// Where the picture goes, SVG
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// No progress and no summary
    #[arg(long)]
    quiet: bool,
}

/// Plans the walk and writes what is asked for.
pub fn run(arguments: &Arguments) -> Outcome {
    let outline = match arguments.sole {
        SoleName::Measured => Outline::Measured,
        SoleName::Seed => Outline::Seed,
    };
    let (humanoid, legs) = match arguments.robot {
        RobotName::Nao => nao(outline)?,
    };
    let session = Session::start(Limits { quiet: arguments.quiet, ..Limits::default() })?;
    let walk = arguments.plan(&humanoid, &legs, &session.watch)?;
    drop(session);
    arguments.write(&humanoid, &walk)?;
    if arguments.quiet {
        return Ok(());
    }
    console::print(&Summary::of(&humanoid, &walk).to_string())
}

/// The figures that a gait has unless others are given.
struct Defaults {
    gait: Gait,
    length: f64,
    lift: f64,
    period: f64,
    double_support: f64,
    rest: f64,
}

const SEED: Defaults =
    Defaults { gait: Gait::Seed, length: 0.04, lift: 0.02, period: 1.6, double_support: 0.66, rest: 0.5 };
const PREVIEW: Defaults =
    Defaults { gait: Gait::Preview, length: 0.05, lift: 0.03, period: 0.8, double_support: 0.3, rest: 1.5 };

/// Heights of the hip that are tried when none is given \[m\]: higher ones leave the ankles' roll more room, lower ones reach further.
const HIP_HEIGHTS: [f64; 6] = [0.228, 0.225, 0.232, 0.222, 0.215, 0.205];

impl Arguments {
    /// The walk at the height of the hip that is given, or at the first of [`HIP_HEIGHTS`] at which it can be walked.
    ///
    /// # Errors
    /// As [`plan`]; that of the first height when it can be walked at none.
    fn plan(&self, humanoid: &Humanoid, legs: &NaoLegs, watch: &Watch) -> Result<Walk> {
        let walk = |height: f64| plan(humanoid, legs, &self.request(height)?, watch);
        let Some(height) = self.hip_height else {
            let first = walk(HIP_HEIGHTS[0]);
            let is_refused =
                |walk: &Result<Walk>| walk.as_ref().is_err_and(|error| error.kind() == ErrorKind::BadValue);
            if !is_refused(&first) {
                return first;
            }
            let others = HIP_HEIGHTS[1..].iter().map(|height| walk(*height));
            return others.into_iter().find(|walk| !is_refused(walk)).unwrap_or(first);
        };
        walk(height)
    }

    fn request(&self, hip_height: f64) -> Result<Request> {
        let defaults = match self.gait {
            GaitName::Seed => SEED,
            GaitName::Preview => PREVIEW,
        };
        let period = self.period.unwrap_or(defaults.period);
        let double = self.double_support.unwrap_or(defaults.double_support);
        if !(double > 0.0 && double < 1.0) {
            let text = format!("--double-support is {double}; give a share between 0 and 1");
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let style = Style {
            lift: self.lift.unwrap_or(defaults.lift),
            amplitude: self.amplitude,
            half_width: HALF_WIDTH,
            ahead: self.ahead,
            torso_height: hip_height + HIP_TO_TORSO,
        };
        let durations = Durations {
            rest: self.rest.unwrap_or(defaults.rest),
            shift: period * double,
            swing: period * (1.0 - double),
        };
        let (gait, margin, speed_share) = (defaults.gait, self.margin, self.speed);
        let route = self.route(defaults.length)?;
        Ok(Request { route, gait, style, durations, margin, speed_share })
    }

    fn route(&self, length: f64) -> Result<Route> {
        if let Some(file) = &self.footsteps {
            let text = read_text(file, FOOTSTEPS_LIMIT)?;
            return Route::from_csv(&text, HALF_WIDTH).map_err(|error| error.in_file(file));
        }
        Route::regular(&Regular {
            steps: self.steps,
            length: self.length.unwrap_or(length),
            turn: self.turn.to_radians(),
            half_width: HALF_WIDTH,
            first: match self.first {
                FootName::Left => Side::Left,
                FootName::Right => Side::Right,
            },
        })
    }

    fn write(&self, humanoid: &Humanoid, walk: &Walk) -> Result<()> {
        let is_json = |file: &Path| file.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("json"));
        if let Some(file) = &self.out {
            let text = if is_json(file) { walk.to_json(humanoid) } else { walk.to_csv(humanoid) };
            write_atomically(file, text.as_bytes())?;
        }
        if let Some(file) = &self.json {
            write_atomically(file, walk.to_json(humanoid).as_bytes())?;
        }
        if let Some(file) = &self.plot {
            write_atomically(file, walk.to_svg(humanoid).as_bytes())?;
        }
        Ok(())
    }
}
