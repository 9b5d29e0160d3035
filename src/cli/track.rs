//! `groebot track`: simulates a robot under a control law that follows a trajectory.

use std::path::PathBuf;

use clap::ValueEnum;

use super::json::FORMAT;
use super::moving::described;
use super::output::{Force, Kind};
use super::part::PartArguments;
use super::{Outcome, console};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_algebra::number::{BigRational, parse_rational};
use groebot_robot::control::{
    ClosedLoop, ComputedTorque, Desired, Disturbance, Gains, GravityCompensation, Inversion, Law, Limited, OpenLoop,
    OperationalSpace, Sample, errors_and_torques,
};
use groebot_robot::dynamics::{Base, Equations, State, Workspace};
use groebot_robot::model::Robot;
use groebot_robot::motion::{Spline, StateTable};

const EXAMPLES: &str = "Examples:
  groebot track ur5.urdf --law computed-torque --trajectory t.csv --plot p.svg
  groebot track ur5.urdf --law computed-torque --trajectory t.csv --masses 1.05 --delay 1 -o tracked.csv
  groebot track ur5.urdf --law operational-space --link wrist_3_link --trajectory t.csv

t.csv begins with a row of names: t, q0, q1, ... (the independent joints, in the order of the
description), and optionally v0.. and a0..; the motion is interpolated smoothly between its rows.
The robot starts at the trajectory, or at the distance --error from it. Its motion is integrated by
the Runge-Kutta method of order four, with a constant torque during each step. The columns of -o are
t, q0.., v0.., tau0.. (the torques of the law) and d0.. (the desired positions).

Laws: open-loop is RH0 (2-46), computed-torque (2-47), operational-space (2-50), gravity-compensation N -
Kv e' - Kp e. Gains are Kp = w^2 and Kv = 2 w for --frequency w; those of gravity-compensation are
multiplied by 1 kg m^2.";

/// Simulates a robot under a control law that follows a trajectory, and reports errors and torques
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// A robot by name, or a description in URDF, xacro, MJCF, SDF or TOML
    #[arg(value_name = "ROBOT-or-FILE")]
    robot: PathBuf,
    /// The control law
    #[arg(long, value_name = "LAW")]
    law: LawName,
    /// The trajectory, CSV
    #[arg(long, value_name = "FILE")]
    trajectory: PathBuf,
    #[command(flatten)]
    part: PartArguments,
    /// The controlled link, for the law operational-space
    #[arg(long, value_name = "LINK", required_if_eq_any([("law", "operational-space"), ("law", "work-space")]))]
    link: Option<String>,
    /// Damp the inverse Jacobian by this fraction of its greatest singular value (default: no damping; singular
    /// configurations are refused)
    #[arg(long, value_name = "SHARE")]
    damped: Option<f64>,
    /// The natural frequency of the error dynamics [rad/s]
    #[arg(long, value_name = "W", default_value_t = 20.0)]
    frequency: f64,
    /// The gain of the integral of errors [1/s^3, or N m/(rad s)]
    #[arg(long, value_name = "KI", default_value_t = 0.0)]
    integral: f64,
    /// The time for which a torque is constant [s]
    #[arg(long, value_name = "S", default_value_t = 1e-3)]
    step: f64,
    /// The initial deviation of each joint from the trajectory [rad or m]
    #[arg(long, value_name = "E", default_value_t = 0.0, allow_hyphen_values = true)]
    error: f64,
    /// The ratio of the robot's masses to those in the control law
    #[arg(long, value_name = "FACTOR", value_parser = factor, default_value = "1")]
    masses: BigRational,
    /// The number of steps before torques act
    #[arg(long, value_name = "STEPS", default_value_t = 0)]
    delay: usize,
    /// The standard deviations of the measurement noise of positions and velocities [rad, rad/s]
    #[arg(long, value_name = "PLACE,RATE", value_delimiter = ',', num_args = 1..=2)]
    noise: Vec<f64>,
    /// Limit torques to the efforts of the description
    #[arg(long)]
    efforts: bool,
    /// Ignore the friction of joints, in the robot and in the control law
    #[arg(long)]
    no_friction: bool,
    /// Write the motion to this CSV file
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Write a picture of errors and torques to this SVG file
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// Print JSON instead of text
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    force: Force,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum LawName {
    OpenLoop,
    ComputedTorque,
    GravityCompensation,
    #[value(alias = "work-space")]
    OperationalSpace,
}

fn factor(text: &str) -> std::result::Result<BigRational, String> {
    let number = parse_rational(text).ok().filter(|number| *number > BigRational::default());
    number.ok_or_else(|| "give a positive number, such as 1.05".to_owned())
}

/// A control law of a link as one of joints: the target is the link's motion computed from that of the joints.
struct Following {
    law: OperationalSpace,
    equations: Equations,
    room: Workspace,
    link: usize,
}

impl Law for Following {
    fn torques(&mut self, desired: &Desired<'_>, state: State<'_>) -> Result<&[f64]> {
        let target = desired.target(&self.equations, &mut self.room, self.link)?;
        self.law.torques(&target, state)
    }
}

/// The result.
#[derive(serde::Serialize)]
struct Summary {
    format: u32,
    steps: usize,
    joints: Vec<JointSummary>,
    /// The ignored parts of the robot's file.
    notes: Vec<String>,
}

#[derive(serde::Serialize)]
struct JointSummary {
    name: String,
    /// Over all times, and over the second half.
    greatest_error: f64,
    greatest_error_second_half: f64,
    root_mean_square_error: f64,
    greatest_torque: f64,
    effort: Option<f64>,
}

/// Follows the trajectory and prints the result.
pub fn run(arguments: &Arguments) -> Outcome {
    let output = arguments.force.output([arguments.robot.as_path(), arguments.trajectory.as_path()]);
    let output = output.expects([arguments.out.as_ref(), arguments.plot.as_ref()])?;
    let (robot, _) = described(&arguments.robot, &arguments.part.options())?;
    let (robot, gravity) = arguments.part.of(&robot)?;
    let equations = |robot: &Robot| -> Result<Equations> {
        let plain = Equations::new(robot, Base::Fixed)?.with_gravity(gravity);
        Ok(if arguments.no_friction { plain.without_friction() } else { plain })
    };
    let known = equations(&robot).map_err(|error| error.in_file(&arguments.robot))?;
    let plant = equations(&heavier(&robot, &arguments.masses)?)?;
    let trajectory = read(arguments, known.joints())?;
    let efforts = efforts(&robot, &known);
    let law = law(arguments, &robot, &known)?;
    let most = efforts.iter().map(|effort| effort.filter(|_| arguments.efforts).unwrap_or(f64::INFINITY)).collect();
    let noise = [0, 1].map(|at| arguments.noise.get(at).copied().unwrap_or(0.0));
    let disturbance = Disturbance { delay: arguments.delay, noise, seed: 1 };
    let mut closed = ClosedLoop::new(&plant, Limited::new(law, most), arguments.step, disturbance)?;
    let [begin, end] = trajectory.times();
    let desired = |time: f64| trajectory.at(begin + time);
    let [q, velocity, _] = desired(0.0);
    let q: Vec<f64> = q.iter().map(|q| q + arguments.error).collect();
    let samples = closed.run([&q, &velocity], end - begin, desired, &Watch::none())?;
    if let Some(file) = &arguments.out {
        output.write(file, Kind::Plain, table(&samples, begin))?;
    }
    if let Some(file) = &arguments.plot {
        output.write(file, Kind::Markup, errors_and_torques(&samples, known.joints()))?;
    }
    let summary = Summary { notes: robot.parts().notes.clone(), ..summary(&samples, known.joints(), &efforts) };
    if arguments.json {
        return console::print(&(serde_json::to_string_pretty(&summary).expect("numbers and names") + "\n"));
    }
    console::print_notes(&summary.notes);
    console::print(&text(&summary))
}

fn law(arguments: &Arguments, robot: &Robot, known: &Equations) -> Result<Box<dyn Law>> {
    let count = known.freedoms();
    let gains = Gains { integral: vec![arguments.integral; count], ..Gains::critical(count, arguments.frequency) };
    let [proportional, derivative] = [arguments.frequency.powi(2), 2.0 * arguments.frequency];
    Ok(match arguments.law {
        LawName::OpenLoop => Box::new(OpenLoop::new(known)?),
        LawName::ComputedTorque => Box::new(ComputedTorque::new(known, gains)?),
        LawName::GravityCompensation => Box::new(GravityCompensation::new(known, gains)?),
        LawName::OperationalSpace => {
            let link = robot.link(arguments.link.as_deref().unwrap_or_default())?;
            let inversion = arguments.damped.map_or(Inversion::Exact(1e-3), Inversion::Damped);
            let law = OperationalSpace::new(known, link, [proportional, derivative], inversion)?;
            Box::new(Following { law, equations: known.clone(), room: known.workspace(), link })
        }
    })
}

fn read(arguments: &Arguments, names: &[String]) -> Result<Spline> {
    let fault = |error: Error| error.in_file(&arguments.trajectory);
    let table = StateTable::read_csv(&arguments.trajectory)?.in_order_of(names).map_err(fault)?;
    let joints = names.len();
    let missing = |text: String| fault(Error::new(ErrorKind::BadValue, text));
    let times = table.rows.iter().map(|row| row.time).collect::<Option<Vec<f64>>>();
    let times = times.ok_or_else(|| missing("there is no column t; give times in seconds".to_owned()))?;
    if let Some(row) = table.rows.iter().find(|row| row.q.len() != joints) {
        let text = format!("{} columns q0.. are given; the robot has {joints} independent joints", row.q.len());
        return Err(missing(text));
    }
    let known = table.rows.iter().map(|row| Some([row.q.clone(), row.velocity.clone()?, row.acceleration.clone()?]));
    match known.collect::<Option<Vec<_>>>() {
        Some(knots) => Spline::new(times, knots).map_err(fault),
        None => Spline::through(times, table.rows.into_iter().map(|row| row.q).collect()).map_err(fault),
    }
}

/// The robot with the masses of its bodies multiplied by a factor.
fn heavier(robot: &Robot, factor: &BigRational) -> Result<Robot> {
    let mut parts = robot.parts().clone();
    for mass in parts.links.iter_mut().filter_map(|link| link.mass.as_mut()) {
        mass.mass *= factor;
        mass.moments.iter_mut().for_each(|moment| *moment *= factor);
    }
    Robot::new(parts)
}

/// By independent joint, the limit of its motor, where it is given.
fn efforts(robot: &Robot, equations: &Equations) -> Vec<Option<f64>> {
    let effort = |name: &String| robot.joint(name).ok().and_then(|joint| robot.joints()[joint].effort);
    equations.joints().iter().map(|name| effort(name).filter(|effort| *effort > 0.0)).collect()
}

fn summary(samples: &[Sample], names: &[String], efforts: &[Option<f64>]) -> Summary {
    let greatest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, |most: f64, x| most.max(x.abs()));
    let joint = |(joint, name): (usize, &String)| {
        let error = |sample: &Sample| sample.q[joint] - sample.desired[joint];
        let squares: f64 = samples.iter().map(|sample| error(sample).powi(2)).sum();
        JointSummary {
            name: name.clone(),
            greatest_error: greatest(&mut samples.iter().map(error)),
            greatest_error_second_half: greatest(&mut samples[samples.len() / 2..].iter().map(error)),
            root_mean_square_error: (squares / samples.len() as f64).sqrt(),
            greatest_torque: greatest(&mut samples.iter().map(|sample| sample.torques[joint])),
            effort: efforts[joint],
        }
    };
    let joints = names.iter().enumerate().map(joint).collect();
    Summary { format: FORMAT, steps: samples.len() - 1, joints, notes: Vec::new() }
}

fn text(summary: &Summary) -> String {
    let width = summary.joints.iter().map(|joint| joint.name.chars().count()).max().unwrap_or(0).max(5);
    let mut text = format!(
        "{} steps; errors in rad or m, torques in N m or N\n{:<width$}  {:>11}  {:>11}  {:>11}  {:>10}  {:>8}\n",
        summary.steps, "joint", "worst", "later", "rms", "torque", "effort"
    );
    for joint in &summary.joints {
        let effort = joint.effort.map_or("-".to_owned(), |effort| effort.to_string());
        let beyond = joint.effort.is_some_and(|effort| joint.greatest_torque > effort);
        text += &format!(
            "{:<width$}  {:>11.3e}  {:>11.3e}  {:>11.3e}  {:>10.3}  {effort:>8}{}\n",
            joint.name,
            joint.greatest_error,
            joint.greatest_error_second_half,
            joint.root_mean_square_error,
            joint.greatest_torque,
            if beyond { "  more than the motor's limit" } else { "" }
        );
    }
    text
}

fn table(samples: &[Sample], begin: f64) -> String {
    let count = samples.first().map_or(0, |sample| sample.q.len());
    let lists = ["q", "v", "tau", "d"].into_iter().flat_map(|head| (0..count).map(move |i| format!("{head}{i}")));
    let mut text = std::iter::once("t".to_owned()).chain(lists).collect::<Vec<_>>().join(",") + "\n";
    for sample in samples {
        let Sample { time, q, velocity, torques, desired, .. } = sample;
        let numbers = [q, velocity, torques, desired].into_iter().flatten();
        let words: Vec<String> =
            std::iter::once(&(begin + time)).chain(numbers).map(|number| format!("{number:?}")).collect();
        text += &(words.join(",") + "\n");
    }
    text
}
