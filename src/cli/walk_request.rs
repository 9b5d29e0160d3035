//! The request of `groebot walk` by its options: route, gait and parameters.

use std::path::PathBuf;

use nalgebra::Point2;

use super::walker::{self, GaitName};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_algebra::limits;
use groebot_humanoid::gait::{
    Biped, Gait, GaitDefaults, Laws, Measures, Regular, Request, Route, Side, Walk, Walker, plan_at, step_commands,
};
use groebot_robot::document::read_text;

/// The greatest length of a file of footsteps in bytes.
const FOOTSTEPS_LIMIT: u64 = limits::FOOTSTEPS_BYTES;

/// The first swing foot.
#[derive(Clone, Copy, clap::ValueEnum)]
enum FootName {
    /// The left foot
    Left,
    /// The right foot
    Right,
}

/// Route, gait and parameters of a walk.
#[derive(clap::Args)]
#[command(group = clap::ArgGroup::new("route").args(["footsteps", "plan", "goal"]))]
pub struct RequestArguments {
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
    pub footsteps: Option<PathBuf>,
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
}

impl RequestArguments {
    /// The walk by the given gait, or by the default one. A described robot walks by preview control, where that is
    /// refused by one step goal.
    ///
    /// # Errors
    /// As [`plan_at`]; [`ErrorKind::BadValue`] for parameters that the gait does not have.
    pub fn planned(&self, walker: &Walker, is_described: bool, watch: &Watch) -> Result<Walk> {
        let biped = &walker.biped;
        let planned = |gait: GaitDefaults| {
            let defaults = self.defaults(gait)?;
            let request = |height, ease| self.request(&defaults.clone().eased(ease), biped, height);
            plan_at((biped, &walker.legs), self.hip_height, &defaults.hip_heights, request, watch)
        };
        if self.gait.is_some() || !is_described {
            return planned(walker::defaults(walker, self.gait)?);
        }
        let (blended, resting): (Vec<_>, Vec<_>) = walker.gaits.iter().partition(|(_, own)| own.gait == Gait::Preview);
        let mut walk = Err(bad("the robot has no gait".into()));
        for (_, gait) in blended.into_iter().chain(resting) {
            walk = planned(gait.clone());
            if !walk.as_ref().is_err_and(|error| error.kind() == ErrorKind::BadValue) {
                break;
            }
        }
        walk
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
                    let text = "--dip, --power, --crouched and --descent-intervals are for one step goal: --gait osg, rh0, rh0-sim or rh0-real";
                    Err(bad(text.into()))
                }
            };
        };
        one_step.dip = self.dip.unwrap_or(one_step.dip);
        match (&mut one_step.laws, self.power) {
            (_, None) => {}
            (Laws::Rh0 { power }, Some(given)) => *power = given,
            (Laws::Generic, Some(_)) => {
                return Err(bad("--power is for RH0's laws: --gait rh0, rh0-sim or rh0-real".into()));
            }
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
}

fn bad(text: String) -> Error {
    Error::new(ErrorKind::BadValue, text)
}
