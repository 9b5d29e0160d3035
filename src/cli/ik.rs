//! `groebot ik`: all joint values that bring a tip to a target, by screw theory, without deriving anything first; or by search.

use serde::Serialize;

use nalgebra::{Quaternion, Translation3, UnitQuaternion, Vector3};

use super::answers::table;
use super::json::FORMAT;
use super::plan::Mechanism;
use super::{Outcome, console, targets};
use crate::kinematics::numeric::NumericSolver;
use crate::kinematics::screw::ScrewSolver;
use crate::kinematics::{Chain, InverseKinematics, JointKind, Solution, Target, Task};
use crate::spatial::Pose;
use crate::{Error, ErrorKind, Result};

const EXAMPLES: &str = "Examples:
  groebot ik ur5 --target 0.4,0.1,0.5,0,180,0 --degrees      position, then roll, pitch, yaw
  groebot ik puma --target 0.3,1.1,0.4,0,0,0,1               position, then the quaternion x, y, z, w
  groebot ik nao_left_leg --q 0.1,0.2,-0.3,0.5,-0.1,0.2      the pose that these joint values reach
  groebot ik robot.urdf --base base_link --tip tool0 --q 0,-90,90,0,0,0 --degrees
  groebot ik general_arm.toml --numeric --target 0.3,1.1,0.4,0,0,0,1

Positions are in the length unit of the description, in its base frame. A rotation is Rz(yaw) Ry(pitch) Rx(roll), as in a URDF. The
task of a chain may ask for less: x,y,z for a position, and a direction behind them for a ray; a direction alone, or angles or a
quaternion alone; two coordinates in a plane, or those and the angle about its normal. Values of given joints stand last.
A target out of reach is no error: the answer is \"no solution\".";

/// The method that may not find all answers.
const NUMERIC: &str = "numeric, maybe not all";

/// Finds all joint values for a target by screw theory, each checked by forward kinematics
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    #[command(flatten)]
    mechanism: Mechanism,
    /// The target, numbers with commas between them (repeatable)
    #[arg(long, value_name = "NUMBERS", allow_hyphen_values = true)]
    target: Vec<String>,
    /// Joint values whose pose is the target (repeatable)
    #[arg(long, value_name = "NUMBERS", allow_hyphen_values = true)]
    q: Vec<String>,
    /// Search by damped least squares from 300 starts instead, for any chain: each answer is checked, but they may not be all
    #[arg(long)]
    numeric: bool,
    /// JSON: an object for each target
    #[arg(long)]
    json: bool,
    /// Angles in degrees, in targets, joint values and JSON (text shows both)
    #[arg(long)]
    degrees: bool,
}

/// Prints the answers to each target.
pub fn run(arguments: &Arguments) -> Outcome {
    let chain = arguments.mechanism.chain()?;
    let solver = Method::of(&arguments.mechanism, &chain, arguments.numeric)?;
    let degrees = arguments.degrees;
    let given = arguments.target.iter().map(|text| (text, target(&chain, text, degrees)));
    let reached = arguments.q.iter().map(|text| (text, reached(&chain, text, degrees)));
    let mut page = String::new();
    for (text, target) in given.chain(reached) {
        let context = |error: Error| error.with_context(format!("`{}`", targets::shown(text)));
        let mut answers = Vec::new();
        let (target, given) = target.map_err(context)?;
        solver.solver().solve(&target, &given, &mut answers).map_err(context)?;
        let page_of = Page { chain: &chain, method: solver.name(), text, target: &target, answers: &answers };
        page += &if arguments.json { page_of.json(degrees) } else { page_of.table() };
    }
    if page.is_empty() {
        let text = "no target; give one by --target, or joint values by --q";
        return Err(Error::new(ErrorKind::MissingKey, text).into());
    }
    console::print(&page)
}

/// How answers are found.
enum Method {
    Screws(Box<ScrewSolver>),
    Numeric(Box<NumericSolver>),
}

impl Method {
    fn of(mechanism: &Mechanism, chain: &Chain, numeric: bool) -> Result<Self> {
        if numeric {
            return NumericSolver::new(chain).map(|solver| Method::Numeric(Box::new(solver)));
        }
        mechanism.solver(chain).map(|solver| Method::Screws(Box::new(solver)))
    }

    fn solver(&self) -> &dyn InverseKinematics {
        match self {
            Method::Screws(solver) => solver.as_ref(),
            Method::Numeric(solver) => solver.as_ref(),
        }
    }

    /// What JSON calls it.
    fn name(&self) -> &'static str {
        match self {
            Method::Screws(_) => "screw theory",
            Method::Numeric(_) => NUMERIC,
        }
    }
}

/// The numbers of `text`, angles still in the unit that they were given in.
fn numbers(text: &str) -> Result<Vec<f64>> {
    let number = |part: &str| {
        let value: f64 = part.trim().parse().ok().filter(|value: &f64| value.is_finite())?;
        Some(value)
    };
    text.split(',').map(number).collect::<Option<_>>().ok_or_else(|| {
        Error::new(ErrorKind::Syntax, "give finite numbers with commas between them, such as 0.3,-1.5,2e-3")
    })
}

/// A target, and the values of the given joints.
type Aim = (Target, Vec<f64>);

/// The target that `text` names, in the form of the chain's task, then the values of the given joints.
fn target(chain: &Chain, text: &str, degrees: bool) -> Result<Aim> {
    let values = numbers(text)?;
    let count = chain.given_inputs().len();
    let Some(own) = values.len().checked_sub(count) else {
        let names = chain.parts().given.join(", ");
        let text = format!("{} numbers are given; the values of {count} joints stand last: {names}", values.len());
        return Err(Error::new(ErrorKind::BadValue, text));
    };
    let turns = chain.given_inputs().into_iter().map(|joint| chain.joints()[joint].kind == JointKind::Revolute);
    let inside = |(value, turns): (&f64, bool)| if degrees && turns { value.to_radians() } else { *value };
    let given = values[own..].iter().zip(turns).map(inside).collect();
    Ok((asked(chain, &values[..own], degrees)?, given))
}

/// The target of `values`.
fn asked(chain: &Chain, values: &[f64], degrees: bool) -> Result<Target> {
    let radians = |value: f64| if degrees { value.to_radians() } else { value };
    let wanted = match chain.task() {
        Task::Pose => "a pose has 6 numbers (x, y, z, roll, pitch, yaw) or 7 (x, y, z, qx, qy, qz, qw)",
        Task::Position => "a position has 3 numbers (x, y, z)",
        Task::Ray => "a ray has 6 numbers (x, y, z and the direction's x, y, z)",
        Task::PositionPitchRoll => "a position with pitch and roll has 5 numbers (x, y, z, pitch, roll)",
        Task::PositionYaw { .. } => "a position with yaw has 4 numbers (x, y, z, yaw)",
        Task::Direction => "a direction has 3 numbers (x, y, z, of any length)",
        Task::Rotation => "a rotation has 3 numbers (roll, pitch, yaw) or 4 (qx, qy, qz, qw)",
        Task::PlanarPosition { .. } => "a planar position has 2 numbers",
        Task::PlanarPose { .. } => "a planar pose has 3 numbers, the last one the angle",
    };
    let euler = |[r, p, y]: [f64; 3]| UnitQuaternion::from_euler_angles(radians(r), radians(p), radians(y));
    let unit = |vector: Vector3<f64>| vector.try_normalize(0.0).unwrap_or(vector);
    Ok(match (chain.task(), values.len(), values) {
        (Task::Pose, 6, &[x, y, z, roll, pitch, yaw]) => {
            Target::Pose(Pose::from_parts(Translation3::new(x, y, z), euler([roll, pitch, yaw])))
        }
        (Task::Pose, 7, &[x, y, z, i, j, k, w]) => {
            let rotation = UnitQuaternion::new_unchecked(Quaternion::new(w, i, j, k));
            Target::Pose(Pose::from_parts(Translation3::new(x, y, z), rotation))
        }
        (Task::Position, 3, &[x, y, z]) => Target::Position([x, y, z].into()),
        (Task::Ray, 6, &[x, y, z, i, j, k]) => {
            Target::Ray { point: [x, y, z].into(), direction: unit(Vector3::new(i, j, k)) }
        }
        (Task::PositionPitchRoll, 5, &[x, y, z, pitch, roll]) => {
            Target::PositionPitchRoll { point: [x, y, z].into(), pitch: radians(pitch), roll: radians(roll) }
        }
        (Task::PositionYaw { .. }, 4, &[x, y, z, yaw]) => {
            Target::PositionYaw { point: [x, y, z].into(), yaw: radians(yaw) }
        }
        (Task::Direction, 3, &[i, j, k]) => Target::Direction(unit(Vector3::new(i, j, k))),
        (Task::Rotation, 3, &[roll, pitch, yaw]) => Target::Rotation(euler([roll, pitch, yaw])),
        (Task::Rotation, 4, &[i, j, k, w]) => {
            Target::Rotation(UnitQuaternion::new_unchecked(Quaternion::new(w, i, j, k)))
        }
        (Task::PlanarPosition { .. }, 2, &[x, y]) => Target::PlanarPosition([x, y]),
        (Task::PlanarPose { .. }, 3, &[x, y, phi]) => Target::PlanarPose([x, y, radians(phi)]),
        (_, count, _) => {
            return Err(Error::new(ErrorKind::BadValue, format!("{count} numbers are given; {wanted}")));
        }
    })
}

/// What the joint values of `text` reach.
fn reached(chain: &Chain, text: &str, degrees: bool) -> Result<Aim> {
    let turns = |i: usize| chain.joints().get(i).is_some_and(|joint| joint.kind == JointKind::Revolute);
    let inside = |(i, value): (usize, f64)| if degrees && turns(i) { value.to_radians() } else { value };
    let q: Vec<f64> = numbers(text)?.into_iter().enumerate().map(inside).collect();
    let target = Target::reached(chain, &q)?;
    Ok((target, chain.given_inputs().into_iter().map(|joint| q[joint]).collect()))
}

/// The answers to a target.
struct Page<'a> {
    chain: &'a Chain,
    method: &'static str,
    /// The target as it was given.
    text: &'a str,
    target: &'a Target,
    answers: &'a [Solution],
}

impl Page<'_> {
    fn table(&self) -> String {
        let Page { chain, answers, .. } = self;
        let title = format!("{} at {}", chain.name(), targets::shown(self.text));
        let unit = chain.length_unit().symbol();
        let is_numeric = self.method == NUMERIC;
        if answers.is_empty() {
            let why = if is_numeric { "the search found none: there may be" } else { "out of reach:" };
            return format!("{title}: {why} no solution\n");
        }
        let plural = if answers.len() == 1 { "solution" } else { "solutions" };
        let how = if is_numeric { ", found by search: there may be others" } else { "" };
        let mut header = vec!["#".to_owned()];
        header.extend(chain.joints().iter().map(|joint| match joint.kind {
            JointKind::Revolute => format!("{} [deg]", joint.name),
            JointKind::Prismatic => format!("{} [{unit}]", joint.name),
        }));
        header.extend([format!("position off [{unit}]"), "rotation off [rad]".to_owned(), String::new()]);
        let mut rows = vec![header];
        for (index, answer) in answers.iter().enumerate() {
            let mut row = vec![(index + 1).to_string()];
            row.extend(chain.joints().iter().zip(&answer.q).map(|(joint, value)| match joint.kind {
                JointKind::Revolute => format!("{:.6}", value.to_degrees() + 0.0),
                JointKind::Prismatic => format!("{value:.9}"),
            }));
            row.extend(self.target.missed(chain, &answer.q).map(|miss| format!("{miss:.1e}")));
            row.push(notes(chain, answer));
            rows.push(row);
        }
        format!("{title}: {} {plural}{how}\n{}", answers.len(), table(&rows))
    }

    fn json(&self, degrees: bool) -> String {
        let chain = self.chain;
        let turns = |i: usize| chain.joints()[i].kind == JointKind::Revolute;
        let unit = |i: usize| match (turns(i), degrees) {
            (true, true) => "deg",
            (true, false) => "rad",
            (false, _) => chain.length_unit().symbol(),
        };
        let entry = |answer: &Solution| Entry {
            q: answer
                .q
                .iter()
                .enumerate()
                .map(|(i, q)| if turns(i) && degrees { q.to_degrees() } else { *q })
                .collect(),
            free: answer.free.iter().map(|&i| chain.joints()[i].name.as_str()).collect(),
            position_residual: self.target.missed(chain, &answer.q)[0],
            rotation_residual: self.target.missed(chain, &answer.q)[1],
            branch: answer.branch,
        };
        let object = Object {
            format: FORMAT,
            name: chain.name(),
            method: self.method,
            target: self.text,
            joints: chain.joints().iter().map(|joint| joint.name.as_str()).collect(),
            unit: (0..chain.joints().len()).map(unit).collect(),
            solutions: self.answers.iter().map(entry).collect(),
        };
        serde_json::to_string_pretty(&object).expect("an answer holds nothing that JSON cannot say") + "\n"
    }
}

/// Which joints are free, and which stand outside their limits.
fn notes(chain: &Chain, answer: &Solution) -> String {
    let named = |joint: &usize| format!("{} is free", chain.joints()[*joint].name);
    let free = answer.free.iter().map(named);
    let outside = chain
        .joints()
        .iter()
        .zip(&answer.q)
        .filter(|(joint, value)| joint.limits.is_some_and(|(low, high)| **value < low || **value > high));
    let outside = outside.map(|(joint, _)| format!("{} outside its limits", joint.name));
    free.chain(outside).collect::<Vec<_>>().join(", ")
}

#[derive(Serialize)]
struct Object<'a> {
    format: u32,
    name: &'a str,
    /// By which method the solutions were found.
    method: &'a str,
    target: &'a str,
    joints: Vec<&'a str>,
    unit: Vec<&'a str>,
    solutions: Vec<Entry<'a>>,
}

#[derive(Serialize)]
struct Entry<'a> {
    q: Vec<f64>,
    /// Names of the joints that may take any value.
    free: Vec<&'a str>,
    position_residual: f64,
    rotation_residual: f64,
    branch: usize,
}
