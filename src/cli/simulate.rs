//! `groebot simulate`: simulates a walk with MuJoCo, with feedback or in open loop, and compares it with the plan.

use std::path::PathBuf;

use serde_json::json;

use super::feedback::Feedback;
use super::files::is_json;
use super::json::FORMAT;
use super::moving::{self, Motion};
use super::output::{Force, Kind, Output};
use super::physics::{Case, Push, ScriptOutput, Stage};
use super::progress::{Limits, Session, seconds};
use super::walker::{self, Described, Named, Shod, SoleArguments};
use super::{Halt, Outcome, console};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_humanoid::gait::Walker;
use groebot_humanoid::sim::{Comparison, Quantity, Usage, soles};
use groebot_humanoid::walkers::Outline;
use groebot_robot::document::shown;
use groebot_robot::model::{Meshes, Robot};
use groebot_robot::motion::Trajectory;

const EXAMPLES: &str = "Examples:
  groebot walk rh0 --plan \"out right, stride left, stride right, in left\" --torques -o walk.csv
  groebot simulate walk.csv -o answer.csv --plot joints.svg
  groebot simulate walk.csv --friction 0.4 --slope 0,3 --mass 1.2 --push 4,60,0.1,90
  groebot simulate walk.csv --open-loop
  groebot simulate walk.csv --vary
  groebot simulate walk.csv --model talos.urdf

MuJoCo is an external program. GROEBOT_PYTHON is a Python that has it, by default python3 (python3
-m venv mujoco && mujoco/bin/pip install mujoco). The robot is exported to MJCF as by `export`.

Motors are position servos: torque = stiffness (command - q) - damping (q' - planned q'), within the
efforts of the description, with an inertia at the joint. Position gains of the description (MJCF)
are used where it has them, with its rotor inertias. Otherwise the stiffness is 30 m g l, the damping
1.5 m g^0.5 l^1.5 and the inertia 0.21 m l^2, where m is the robot's mass and l is 0.63 of the height
of its torso; with an effort limit, the stiffness is at most effort / 10 mrad, the damping less in
proportion, and with a velocity limit too, the inertia is that with which the motor reaches the
velocity in 15 ms with the effort, so that MuJoCo integrates it stably (docs/walking.md). --servo
replaces all gains. A body that is described as a point has moments of inertia 0.2 m l^2.

A stabiliser reads joint values, orientation and angular velocity of the base and the forces on both
soles at 200 Hz, and corrects the commands (docs/walking.md). It knows the motors' stiffness and the
described masses. With --open-loop, only the servos' own angles are fed back. If the walk has torques (`walk --torques`), the predicted
sag is reported next to the deviation.

The output is a trajectory with the times of the walk until the robot falls: joints, base, soles and
their contacts, ZMP by the contact forces over 20 ms, torques.

The exit status is 5 if the robot falls; with --vary, if it falls in any run.";

/// Simulates a walk with MuJoCo, with feedback or in open loop, and reports the deviations of joints, zero moment point
/// and path from the plan
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The walk, CSV or JSON
    walk: PathBuf,
    /// The robot: nao, rh0, teo, or a description in URDF, xacro, MJCF, SDF or TOML [default: the one that the walk names]
    #[arg(long, value_name = "ROBOT-or-FILE")]
    model: Option<PathBuf>,
    #[command(flatten)]
    soles: SoleArguments,
    /// Stiffness, damping and inertia of all motors, in m g l, m g^0.5 l^1.5 and m l^2 [default: as described, else
    /// 30,1.5,0.21, less stiff where efforts are limited]
    #[arg(long, value_name = "STIFFNESS,DAMPING,INERTIA", value_delimiter = ',', num_args = 1)]
    servo: Option<Vec<f64>>,
    /// The coefficient of friction between soles and floor
    #[arg(long, value_name = "F", default_value_t = 0.8)]
    friction: f64,
    /// The rotation of the floor about x, left side up, and about y, front down [degrees]
    #[arg(
        long,
        value_name = "ROLL,PITCH",
        value_delimiter = ',',
        num_args = 1,
        default_value = "0,0",
        allow_hyphen_values = true
    )]
    slope: Vec<f64>,
    /// The factor on all masses
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0)]
    mass: f64,
    /// The factor on the stiffness of motors
    #[arg(long, value_name = "FACTOR", default_value_t = 1.0)]
    gain: f64,
    /// The delay of commands and of feedback [s]
    #[arg(long, value_name = "S", default_value_t = 0.0)]
    latency: f64,
    /// Play the walk in open loop, without feedback
    #[arg(long)]
    open_loop: bool,
    /// The noise of the feedback's measurements, relative to the usual one: 0.5 mrad of joints, 5 mrad of the
    /// orientation, 20 mrad/s of the angular velocity, 2 % of forces
    #[arg(long, value_name = "FACTOR", default_value_t = 0.0)]
    noise: f64,
    /// Push the torso at its centre of mass: start [s], force [N], duration [s], direction [degrees from ahead to the
    /// left]
    #[arg(long, value_name = "T,N,S,DIRECTION", value_delimiter = ',', num_args = 1, allow_hyphen_values = true)]
    push: Option<Vec<f64>>,
    /// Simulate slopes up to 3 degrees, frictions from 0.4 to 1 and masses 20 % lower and higher, then all combined;
    /// report which runs fall
    #[arg(long, conflicts_with_all = ["out", "plot", "plot_rates", "plot_torques"])]
    vary: bool,
    /// The time budget [s]
    #[arg(long, value_name = "SECONDS", value_parser = seconds, default_value = "3600")]
    time: std::time::Duration,
    /// Write the simulated motion to this file: CSV, or JSON if its name ends in .json
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Write a picture of the legs' joint angles, references and simulation, to this SVG file
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// Write a picture of their velocities to this SVG file
    #[arg(long, value_name = "FILE")]
    plot_rates: Option<PathBuf>,
    /// Write a picture of their torques to this SVG file
    #[arg(long, value_name = "FILE")]
    plot_torques: Option<PathBuf>,
    /// Print JSON instead of text
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    force: Force,
}

/// Simulates, compares and writes the requested files.
pub fn run(arguments: &Arguments) -> Outcome {
    let output = arguments.output()?;
    let session = Session::start(Limits { time: Some(arguments.time), ..Limits::default() })?;
    let Walking { plan, shod: Shod { robot, soles }, meshes, walker } = arguments.read(&session.watch)?;
    let feet = soles.each_ref().map(String::as_str);
    let mut notes = robot.parts().notes.clone();
    let model = robot.to_mjcf(&meshes, &mut notes)?;
    if !arguments.json {
        console::print_notes(&notes);
    }
    let nominal = arguments.case()?;
    let legs = legs(&robot, feet).map_err(|error| error.with_context("--left and --right are the soles"))?;
    let stage = Stage::new(&model, &plan, feet, arguments.servo.as_deref())?;
    let mut feedback = walker.map(|walker| Feedback::new(&walker, &plan)).transpose()?;
    if arguments.vary {
        let runs = varied((&stage, &plan), &nominal, feedback.as_ref(), &session.watch)?;
        drop(session);
        return report_runs(&runs, &notes, arguments.json);
    }
    let (answer, result) = stage.play(&nominal, feedback.as_mut(), &session.watch)?;
    drop(session);
    let compared = Comparison::of(&plan, &answer, |joint| result.stiffness(joint, nominal.mass))?;
    let usage = feedback.as_ref().map(|feedback| Usage::of(feedback.biped(), &answer)).transpose()?;
    arguments.write(&output, &plan, &answer, &legs)?;
    if arguments.json {
        let value = json!({ "format": FORMAT, "robot": plan.robot, "feedback": feedback.is_some(), "case": nominal, "run": result, "usage": usage,
            "comparison": compared, "notes": notes });
        console::print(&super::json::text(&value))?;
    } else {
        let usage = usage.map(|usage| usage.to_string()).unwrap_or_default();
        let law = if feedback.is_some() { "with feedback" } else { "in open loop" };
        console::print(&format!(
            "{}: {law}, {}\n{}{usage}{compared}",
            plan.robot,
            result.verdict(),
            result.motors_text()
        ))?;
    }
    if result.fell.is_some() { Err(Halt::Fell) } else { Ok(()) }
}

/// A walk and its robot.
struct Walking {
    plan: Trajectory,
    shod: Shod,
    meshes: Meshes,
    walker: Option<Walker>,
}

impl Arguments {
    /// The walk and its robot, with its walker unless it is played in open loop.
    fn read(&self, watch: &Watch) -> Result<Walking> {
        let file = &self.walk;
        let Some(Motion { trajectory: plan, .. }) = moving::motion(file)? else {
            let text = "the file name is not that of a walk; give the output of `groebot walk` or `groebot navigate`, .csv or .json";
            return Err(Error::new(ErrorKind::BadValue, text).in_file(file));
        };
        soles(&plan).map_err(|error| error.in_file(file))?;
        let model = self.model.clone().unwrap_or_else(|| PathBuf::from(&plan.robot));
        if !model.exists() && model.to_str().and_then(groebot_robot::robots::robot).is_none() {
            let text = format!(
                "`{}` is neither a file nor a robot of groebot; give a file, nao, rh0 or teo by --model",
                shown(&model.to_string_lossy())
            );
            return Err(Error::new(ErrorKind::UnknownName, text));
        }
        let described = Described::read(&model.to_string_lossy(), &self.soles)?;
        let robot = &described.robot;
        if let Some(joint) = plan.joints.iter().find(|joint| robot.joint(&joint.name).is_err()) {
            let text = format!(
                "the walk moves joint `{}`, which {} does not have; give its robot by --model",
                shown(&joint.name),
                shown(robot.name())
            );
            return Err(Error::new(ErrorKind::UnknownName, text).in_file(file));
        }
        if self.open_loop {
            let Described { robot, meshes, .. } = described;
            let shod = walker::with_soles(robot, &meshes, &self.soles)?;
            return Ok(Walking { plan, shod, meshes, walker: None });
        }
        let Named { shod, meshes, walker, .. } = described.walker(Outline::default(), &self.soles, watch)?;
        Ok(Walking { plan, shod, meshes, walker: Some(walker) })
    }

    fn case(&self) -> Result<Case> {
        let &[roll, pitch] = &self.slope[..] else {
            return Err(bad("--slope takes two numbers of degrees, such as 0,3"));
        };
        if self
            .servo
            .as_ref()
            .is_some_and(|servo| servo.len() != 3 || servo.iter().any(|x| !(x.is_finite() && *x > 0.0)))
        {
            return Err(bad("--servo takes three positive numbers, such as 30,1.5,0.21"));
        }
        if !(roll.abs() < 45.0 && pitch.abs() < 45.0) {
            return Err(bad("--slope is too steep; give less than 45 degrees"));
        }
        for (name, value) in [("--mass", self.mass), ("--gain", self.gain), ("--friction", self.friction)] {
            if !(value.is_finite() && value > 0.0) {
                return Err(bad(&format!("{name} is {value}; give a positive number")));
            }
        }
        for (name, value) in [("--latency", self.latency), ("--noise", self.noise)] {
            if !(value.is_finite() && value >= 0.0) {
                return Err(bad(&format!("{name} is {value}; give 0 or more")));
            }
        }
        Ok(Case {
            friction: self.friction,
            slope: [roll, pitch],
            mass: self.mass,
            gain: self.gain,
            latency: self.latency,
            noise: self.noise,
            push: self.push()?,
        })
    }

    fn push(&self) -> Result<Option<Push>> {
        let Some(numbers) = &self.push else { return Ok(None) };
        match numbers[..] {
            [time, force, duration, direction] if numbers.iter().all(|number| number.is_finite()) && duration > 0.0 => {
                Ok(Some(Push { time, force, duration, direction }))
            }
            _ => Err(bad(
                "--push takes four numbers: start [s], force [N], duration [s], direction [degrees], such as 3,20,0.1,90",
            )),
        }
    }

    /// The output; it replaces neither the walk nor the model.
    fn output(&self) -> Result<Output> {
        let output = self.force.output(std::iter::once(self.walk.as_path()).chain(self.model.as_deref()));
        output.expects([&self.out, &self.plot, &self.plot_rates, &self.plot_torques].map(Option::as_ref))
    }

    fn write(&self, output: &Output, plan: &Trajectory, answer: &Trajectory, legs: &[Vec<String>; 2]) -> Outcome {
        if let Some(file) = &self.out {
            let text = if is_json(file) { answer.to_json().to_string() + "\n" } else { answer.to_csv() };
            output.write(file, Kind::of_motion(file), text)?;
        }
        let pictures =
            [(&self.plot, Quantity::Angle), (&self.plot_rates, Quantity::Rate), (&self.plot_torques, Quantity::Torque)];
        for (file, quantity) in pictures {
            if let Some(file) = file {
                output.write(file, Kind::Markup, quantity.picture(plan, answer, legs))?;
            }
        }
        Ok(())
    }
}

/// The joints of both legs, from the root to the soles.
fn legs(robot: &Robot, feet: [&str; 2]) -> Result<[Vec<String>; 2]> {
    let leg = |foot: &str| -> Result<Vec<String>> {
        let path = robot.path(None, Some(foot))?;
        let joints = path.joints.iter().map(|(joint, _)| &robot.joints()[*joint]);
        Ok(joints.filter(|joint| joint.kind.is_single()).map(|joint| joint.name.clone()).collect())
    };
    Ok([leg(feet[0])?, leg(feet[1])?])
}

/// A run of --vary.
struct Run {
    case: Case,
    result: ScriptOutput,
    compared: Comparison,
}

/// Slopes, frictions and masses, one after the other and together.
fn cases(nominal: &Case) -> Vec<Case> {
    let mut cases = vec![*nominal];
    for angle in [1.0, 2.0, 3.0] {
        let slopes = [[0.0, -angle], [0.0, angle], [angle, 0.0], [-angle, 0.0]];
        cases.extend(slopes.map(|slope| Case { slope, ..*nominal }));
    }
    cases.extend([0.4, 0.6, 1.0].map(|friction| Case { friction, ..*nominal }));
    cases.extend([0.8, 1.2].map(|mass| Case { mass, ..*nominal }));
    for slope in [[0.0, -3.0], [0.0, 3.0], [3.0, 0.0], [-3.0, 0.0]] {
        for friction in [0.4, 1.0] {
            cases.extend([0.8, 1.2].map(|mass| Case { slope, friction, mass, ..*nominal }));
        }
    }
    cases.extend([0.8, 1.2].map(|gain| Case { gain, ..*nominal }));
    cases.extend([0.02, 0.04].map(|latency| Case { latency, ..*nominal }));
    cases
}

fn varied(
    (stage, plan): (&Stage, &Trajectory),
    nominal: &Case,
    feedback: Option<&Feedback>,
    watch: &Watch,
) -> Result<Vec<Run>> {
    let cases = cases(nominal);
    let one = |(done, case): (usize, &Case)| {
        watch.report("runs", done, cases.len() - done);
        let (answer, result) = stage.play(case, feedback.cloned().as_mut(), watch)?;
        let compared = Comparison::of(plan, &answer, |joint| result.stiffness(joint, case.mass))?;
        Ok(Run { case: *case, result, compared })
    };
    cases.iter().enumerate().map(one).collect()
}

fn report_runs(runs: &[Run], notes: &[String], as_json: bool) -> Outcome {
    if as_json {
        let run = |Run { case, result, compared }: &Run| json!({ "case": case, "run": result, "comparison": compared });
        let value = json!({ "format": FORMAT, "runs": runs.iter().map(run).collect::<Vec<_>>(), "notes": notes });
        console::print(&super::json::text(&value))?;
    } else {
        let rows: String = runs.iter().map(row).collect();
        console::print(&format!(
            "roll_deg,pitch_deg,friction,mass,gain,latency_s,fall_time_s,off_mm,turn_off_deg,tilt_deg,landings,planned_landings,lift_mm,zmp_rms_mm,deviation_mrad\n{rows}"
        ))?;
    }
    if runs.iter().any(|run| run.result.fell.is_some()) { Err(Halt::Fell) } else { Ok(()) }
}

fn row(Run { case, result, compared }: &Run) -> String {
    let fell = result.fell.map_or_else(String::new, |time| format!("{time:.2}"));
    let deviation = compared.joints.iter().map(|joint| joint.greatest.abs()).fold(0.0, f64::max);
    format!(
        "{},{},{},{},{},{},{fell},{:.0},{:.1},{:.1},{},{},{:.1},{:.1},{:.1}\n",
        case.slope[0],
        case.slope[1],
        case.friction,
        case.mass,
        case.gain,
        case.latency,
        1e3 * compared.off(),
        (compared.walked.turn - compared.planned.turn).to_degrees(),
        compared.tilt.to_degrees(),
        compared.landings[1],
        compared.landings[0],
        1e3 * compared.lift,
        1e3 * compared.zmp[1],
        1e3 * deviation
    )
}

fn bad(text: &str) -> Error {
    Error::new(ErrorKind::BadValue, text)
}
