//! `groebot dynamics`: the equations of motion of a robot, at the states of a table, as polynomials or as code.

mod code;
mod reading;
mod states;
mod symbolic;

use std::path::{Path, PathBuf};

use super::Outcome;
use super::output::{Force, Output};
use super::part::PartArguments;
use crate::{Error, ErrorKind, Result};
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

states.csv begins with a row of names: q0, q1, ... (the independent joints, in the order of the
description), v0, v1, ..., a0, a1, ... and optionally tau0, tau1, .... Missing velocities and
accelerations are zero. A free root comes first: its position x, y, z and its quaternion x, y, z, w
in q, its linear and angular velocity in its own frame in v. Joints may be named instead, in any
order: q:elbow, v:elbow, ...; the free root then has q0 to q6 and v0 to v5.

With --floating the root moves freely. Without it the numbers of columns decide; an ambiguous table
is an error. If joints that follow others have columns too, each joint is independent, and a note
reports it.

The output columns are tau0.. (inverse dynamics, RNEA), M0_0, M1_0, M1_1.. (lower triangle of the
mass matrix, CRBA), C0_0, C0_1.. (the Coriolis matrix of Christoffel symbols), g0.. (gravity) and
qdd0.. (forward dynamics, ABA). qdd is for the given torques, else for the computed ones; it is
empty, with a note, where bodies without mass would have to move. Metres, kilograms, seconds,
radians.

With --lang the equations of motion are printed as code, without friction: inverse (torques of a
motion), gravity, inertia (M), coriolis (C), forward, and derivatives (of inverse dynamics by
configuration and velocity). If bodies without mass would have to move, forward is omitted, with a
note, unless --functions names it. Rust needs the crate groebot-runtime, C needs
runtime/c/groebot_dynamics.h.

With --symbolic M, C, N and the potential energy V are polynomials in cosines and sines, for a chain
of up to 7 joints. The direction of gravity is that of --gravity, its size is g. -o FOLDER writes
them as 7_dynamics.txt with a certificate, 7_dynamics.json, that `groebot check FOLDER` proves
again.";

/// Computes the dynamics of a robot: torques (RNEA), mass matrix (CRBA), accelerations (ABA), Coriolis and gravity
/// terms; at states, as polynomials, or as code
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// A robot by name, or a description in URDF, xacro, MJCF, SDF or TOML; with --symbolic also a chain or a mechanism's folder
    #[arg(value_name = "ROBOT-or-FILE")]
    robot: PathBuf,
    /// The states, CSV; positions, velocities, accelerations, torques [rad, rad/s, rad/s^2, N m, or metres and newtons]
    #[arg(long, value_name = "FILE", required_unless_present_any = ["symbolic", "lang"])]
    states: Option<PathBuf>,
    /// Print polynomials in cosines, sines and the inertial parameters of the bodies
    #[arg(long, conflicts_with_all = ["states", "no_friction", "as_given"])]
    symbolic: bool,
    /// Print code in this language
    #[arg(long, value_name = "LANGUAGE", conflicts_with_all = ["states", "symbolic", "no_friction"])]
    lang: Option<code::Language>,
    /// With --lang: the functions to print (default: all)
    #[arg(long, value_name = "NAMES", value_delimiter = ',', requires = "lang", value_parser = code::functions())]
    functions: Vec<Function>,
    /// With --lang: the form of functions [default: straight-line code, or loops if it exceeds 100 KB]
    #[arg(long, value_name = "FORM", requires = "lang")]
    form: Option<code::FormName>,
    /// Use a floating base: the root moves freely
    #[arg(long, conflicts_with = "symbolic")]
    floating: bool,
    /// With --symbolic: use the inertial parameters of the description as numbers
    #[arg(long, requires = "symbolic")]
    numbers: bool,
    /// With --symbolic: print a page of LaTeX
    #[arg(long, requires = "symbolic", conflicts_with_all = ["out", "json"])]
    latex: bool,
    #[command(flatten)]
    part: PartArguments,
    /// Ignore the friction of joints
    #[arg(long)]
    no_friction: bool,
    /// Accept masses, inertias and damping that are physically impossible
    #[arg(long, alias = "as-told")]
    as_given: bool,
    /// The output file for the table or code, or the output folder for polynomials (default: standard output); C is
    /// written as NAME.c with NAME.h
    #[arg(short, long, value_name = "FILE-or-FOLDER")]
    out: Option<PathBuf>,
    /// Print JSON instead of the table or the polynomials; for files of code or polynomials, their paths
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    force: Force,
}

impl Arguments {
    /// The output; it replaces neither the robot nor `states`.
    fn output(&self, states: Option<&Path>) -> Output {
        self.force.output(std::iter::once(self.robot.as_path()).chain(states))
    }
}

impl Arguments {
    /// The equations of motion of a robot. Its parameters are checked unless `--as-given` is set.
    fn equations(&self, robot: &Robot, base: Base) -> Result<Equations> {
        if self.as_given {
            return Equations::unchecked(robot, base).map_err(|error| error.in_file(&self.robot));
        }
        let checked = Equations::new(robot, base).map_err(|error| error.in_file(&self.robot));
        checked.map_err(|error| match error.kind() {
            ErrorKind::BadValue if Equations::unchecked(robot, base).is_ok() => {
                error.with_advice("`--as-given` takes the numbers unchanged")
            }
            _ => error,
        })
    }
}

/// The error for a robot without mass.
fn massless() -> Error {
    Error::new(ErrorKind::BadValue, "no link has a mass; give masses")
}

/// Prints the requested result.
pub fn run(arguments: &Arguments) -> Outcome {
    match (&arguments.states, arguments.lang) {
        (Some(states), _) => states::run(arguments, states),
        (None, Some(language)) => code::run(arguments, language),
        (None, None) => symbolic::run(arguments),
    }
}
