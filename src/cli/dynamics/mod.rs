//! `groebot dynamics`: the equations of motion of a robot, at states of a table or as polynomials.

mod code;
mod reading;
mod states;
mod symbolic;

use std::path::{Path, PathBuf};

use super::Outcome;
use super::output::{Force, Output};
use super::part::PartArguments;
use crate::{ErrorKind, Result};
use groebot_ik::codegen::dynamics::Function;
use groebot_robot::dynamics::{Base, Equations};
use groebot_robot::model::Robot;

const EXAMPLES: &str = "Examples:
  groebot dynamics ur5.urdf --states states.csv -o out.csv
  groebot dynamics nao_v5 --states flight.csv --gravity 0,0,-1.62 --json
  groebot dynamics ur5.urdf --lang c -o ur5_dynamics.c
  groebot dynamics ur5.urdf --lang rust --functions inverse,inertia > src/ur5_dynamics.rs
  groebot dynamics --symbolic derivations/scara
  groebot dynamics --symbolic ur5.urdf --tip forearm_link --numbers -o ur5_dynamics

states.csv begins with a row of names: q0, q1, ... (the independent joints, in the order of the description; before them, where the root moves freely, its
position x, y, z and its quaternion x, y, z, w), v0, v1, ... (the root's linear and angular velocity in its own frame first), a0, a1, ... and, if they are known,
tau0, tau1, ... Without velocities and accelerations they are zero. Joints may be named instead, in any order: q:elbow, v:elbow, ...; the free root then has q0 to q6 and v0
to v5. With --floating the root moves freely; without it the numbers of columns decide that, and a table that allows two readings is refused. Where joints that follow others
have columns, too, each joint is independent; a note tells it.

Written are tau0.. (inverse dynamics), M0_0, M1_0, M1_1.. (the inertia matrix's lower triangle), C0_0, C0_1.. (the Coriolis matrix of Christoffel's symbols),
g0.. (gravity) and qdd0.. (forward dynamics of the given torques, else of the computed ones; empty, with a note, where bodies without mass would have to move). Metres,
kilograms, seconds, radians.

With --lang the equations of motion are printed as code, friction left out: inverse (torques of a motion), gravity, inertia (M), coriolis (C), forward and derivatives
(of inverse dynamics by configuration and velocity). Where bodies without mass would have to move forward is left out, with a note, unless --functions names it. Rust needs the crate groebot-runtime, C needs runtime/c/groebot_dynamics.h. With --floating the root moves
freely.

With --symbolic M, C, N and the potential energy V are polynomials in cosines and sines, of a chain of up to 7 joints; gravity's direction is that of --gravity, its size g; -o FOLDER writes them as 7_dynamics.txt
with a certificate, 7_dynamics.json, that `groebot check FOLDER` proves again.";

/// Computes torques, inertia, Coriolis and gravity terms of a robot, at states, as polynomials, or as code
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// A robot of groebot, or a description in URDF or TOML; with --symbolic also a chain or a mechanism's folder
    #[arg(value_name = "ROBOT-or-FILE")]
    robot: PathBuf,
    /// The states, CSV
    #[arg(long, value_name = "FILE", required_unless_present_any = ["symbolic", "lang"])]
    states: Option<PathBuf>,
    /// Print polynomials in cosines, sines, masses and moments of the bodies
    #[arg(long, conflicts_with_all = ["states", "no_friction", "as_told", "json"])]
    symbolic: bool,
    /// Print code in this language
    #[arg(long, value_name = "LANGUAGE", conflicts_with_all = ["states", "symbolic", "no_friction", "json"])]
    lang: Option<code::Language>,
    /// With --lang: which functions (default: all)
    #[arg(long, value_name = "NAMES", value_delimiter = ',', requires = "lang", value_parser = code::functions())]
    functions: Vec<Function>,
    /// With --lang: how functions are printed [default: straight-line code, and loops where that would be over 100 KB]
    #[arg(long, value_name = "FORM", requires = "lang")]
    form: Option<code::FormName>,
    /// The root moves freely
    #[arg(long, conflicts_with = "symbolic")]
    floating: bool,
    /// With --symbolic: what bodies weigh in the numbers of the description
    #[arg(long, requires = "symbolic")]
    numbers: bool,
    /// With --symbolic: a page of LaTeX
    #[arg(long, requires = "symbolic", conflicts_with = "out")]
    latex: bool,
    #[command(flatten)]
    part: PartArguments,
    /// Leave the friction of joints out
    #[arg(long)]
    no_friction: bool,
    /// Accept masses, inertias and damping that no rigid body or joint can have
    #[arg(long)]
    as_told: bool,
    /// Where the table or code goes, or the folder of polynomials; C goes into NAME.c and NAME.h beside it; standard output without it
    #[arg(short, long, value_name = "FILE-or-FOLDER")]
    out: Option<PathBuf>,
    /// JSON in place of the table
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    force: Force,
}

impl Arguments {
    /// The writer, which replaces neither the robot nor `states`.
    fn output(&self, states: Option<&Path>) -> Output {
        self.force.output(std::iter::once(self.robot.as_path()).chain(states))
    }
}

impl Arguments {
    /// The equations of motion of a robot, its figures checked unless `--as-told` is given.
    fn equations(&self, robot: &Robot, base: Base) -> Result<Equations> {
        if self.as_told {
            return Equations::as_told(robot, base).map_err(|error| error.in_file(&self.robot));
        }
        let checked = Equations::new(robot, base).map_err(|error| error.in_file(&self.robot));
        checked.map_err(|error| match error.kind() {
            ErrorKind::BadValue if Equations::as_told(robot, base).is_ok() => {
                error.with_advice("`--as-told` takes the numbers unchanged")
            }
            _ => error,
        })
    }
}

/// Prints what is requested.
pub fn run(arguments: &Arguments) -> Outcome {
    match (&arguments.states, arguments.lang) {
        (Some(states), _) => states::run(arguments, states),
        (None, Some(language)) => code::run(arguments, language),
        (None, None) => symbolic::run(arguments),
    }
}
