//! `groebot follow`: joint values along a sequence of poses, on the branch of solutions that stays continuous.

use std::io::{BufRead, BufReader};
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use super::columns::{Columns, Field};
use super::ends::{IdealEndArguments, TipLink};
use super::files::is_json;
use super::json::{self, FORMAT};
use super::output::{Force, Kind};
use super::progress::{Limits, Session};
use super::targets::Reader;
use super::{Outcome, console};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::limits;
use groebot_ik::derive::planner::is_redundant;
use groebot_ik::derive::{ChainProblem, Derivation, Description, Ends, InputFile, Options};
use groebot_ik::solver::redundant::{ArmPath, ArmTarget, PathOptions};
use groebot_robot::document::{is_stdin, open};
use groebot_robot::dynamics::{Clearance, Model};
use groebot_robot::kinematics::{Chain, Joint, JointKind, LengthUnit, Quantity};
use groebot_robot::model::Robot;
use groebot_robot::motion::table::pose_of;
use groebot_robot::motion::{Followed, JointTrack, Jump, Pace, PathRequest, Trajectory, follow};
use groebot_robot::spatial::Pose;

/// The tolerance for the length of a quaternion, for example one with 0.707.
const ROUNDED: f64 = 1e-3;
/// The names of a pose's numbers: of the position, and of the quaternion.
const POSE: [&str; 7] = ["x", "y", "z", "qx", "qy", "qz", "qw"];

/// The line for a path whose arcs are unsure.
const UNSURE: &str = "  Unsure: other solutions within limits may exist at some poses.\n";

/// The line for a robot that has faults.
const UNCHECKED: &str = "  collisions of links were not checked: parts of the robot have faults\n";

const EXAMPLES: &str = "Examples:
  groebot follow robot.urdf --poses poses.csv -o path.csv
  groebot follow robot.urdf --base base_link --tip tool0 --poses poses.csv --every 0.01 -o path.json

poses.csv has the columns x, y, z, qx, qy, qz, qw (metres, quaternion), and optionally time
(seconds) first. A row of names is optional.

Of all paths of solutions within the limits, the result has the fewest jumps between branches, and
of those it is the shortest. A step is a jump if a joint exceeds its speed (velocity in the URDF) in
the given time. Without times or speeds, the limit is half a radian or a tenth of the reach. Each
jump is reported with its place and reason; with --strict it is an error. For a chain with one joint
more than the pose determines, solutions are sampled along the arcs within the limits; the result is
the best path through the samples. The result may then be unsure, which is reported: other solutions
within the limits may exist (docs/redundant.md).";

/// Computes a continuous joint trajectory along a sequence of poses
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// A mechanism's folder, an input file with a chain, or a robot's name (`groebot robots`)
    #[arg(value_name = "DIR-or-FILE")]
    input: PathBuf,
    #[command(flatten)]
    ends: IdealEndArguments,
    /// The poses, CSV; `-` for standard input
    #[arg(long, value_name = "FILE")]
    poses: PathBuf,
    /// The time between two poses, if the file has none [s]; without it joint velocities are unlimited
    #[arg(long, value_name = "SECONDS")]
    every: Option<f64>,
    /// Write the joint trajectory to this file: CSV, or JSON if its name ends in .json
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Print the summary as JSON
    #[arg(long)]
    json: bool,
    /// Fail at a jump, and write nothing
    #[arg(long)]
    strict: bool,
    /// Print neither progress nor summary
    #[arg(long)]
    quiet: bool,
    #[command(flatten)]
    force: Force,
}

/// Follows the poses and writes the requested files.
pub fn run(arguments: &Arguments) -> Outcome {
    let output = arguments.force.output([arguments.input.as_path(), arguments.poses.as_path()]);
    let output = output.expects([arguments.out.as_ref()])?;
    let input = InputFile::read_with(&arguments.input, &arguments.ends.options())?;
    let ends = arguments.ends.ends()?.or(&input.ends);
    let none = || Error::new(ErrorKind::BadValue, "there is no chain here").in_file(&input.path);
    let chain = input.chain(&ends)?.ok_or_else(none)?;
    let notes = input.ignored(&ends)?;
    if !arguments.quiet && !arguments.json {
        console::print_notes(&notes);
    }
    let (poses, times) = read_poses(&arguments.poses, &chain)?;
    let session = Session::start(Limits { quiet: arguments.quiet, ..Limits::default() })?;
    let solver = derived(&ends, &chain, &session.watch)?;
    let description =
        if times.is_some() || arguments.every.is_some() { speeds(&input.description, &chain) } else { Vec::new() };
    let pace = match (times, arguments.every) {
        (Some(times), _) => Pace::At(times),
        (None, every) => Pace::Every(every.unwrap_or(1.0)),
    };
    let request = PathRequest::new(&poses, &pace).speeds(&description);
    let program = solver.program();
    let found = match (program.redundant_solver(), program.scanning_solver()) {
        (Some(arm), _) => along(
            &chain,
            &request,
            |pose| arm.target(pose),
            |targets, options| arm.path(targets, options, &session.watch),
        ),
        (None, Some(arm)) => {
            let path = |targets: &[_], options: &PathOptions<'_>| arm.path(targets, None, options, &session.watch);
            along(&chain, &request, |pose| arm.target(pose), path)
        }
        (None, None) => {
            follow(&chain, &solver.program().solver(), &request, &session.watch).map(|followed| (followed, false))
        }
    };
    let (followed, is_unsure) = found.map_err(|error| error.in_file(&arguments.poses))?;
    drop(session);
    if let Some(jump) = followed.jumps.first().filter(|_| arguments.strict) {
        let text = format!("the path must jump at pose {}: {}", jump.sample + 1, jump.why);
        return Err(Error::new(ErrorKind::BadValue, text).in_file(&arguments.poses).into());
    }
    if let Some(file) = &arguments.out {
        let trajectory = &followed.trajectory;
        let text = if is_json(file) { trajectory.to_json().to_string() + "\n" } else { trajectory.to_csv() };
        output.write(file, Kind::of_motion(file), text)?;
    }
    if arguments.quiet && !arguments.json {
        return Ok(());
    }
    let tip = input.path(&ends)?.as_ref().map(TipLink::of_path);
    let shown =
        Shown { chain: &chain, followed: &followed, is_unsure, collisions: None, tip: tip.as_ref(), notes: &notes };
    arguments.print(&input.description, shown)
}

impl Arguments {
    /// Prints the summary with the collisions of links.
    fn print<'a>(&self, description: &'a Description, shown: Shown<'a>) -> Outcome {
        let collisions = match description {
            Description::Robot(robot) if robot.faults().is_empty() => Some(touching(robot, shown.followed)?),
            _ => None,
        };
        let shown = Shown { collisions, ..shown };
        if self.json {
            return console::print(&json::text(&shown.json()));
        }
        let unchecked = match description {
            Description::Robot(_) if shown.collisions.is_none() => UNCHECKED,
            _ => "",
        };
        let touches: String = shown.collisions.iter().flatten().map(Collision::line).collect();
        let doubt = if shown.is_unsure { UNSURE } else { "" };
        console::print(
            &(TipLink::line(shown.tip) + &summary(shown.chain, shown.followed) + doubt + unchecked + &touches),
        )
    }
}

/// The solver of `chain`. If its folder has the solvers with each joint given, these are derived again: the given joint is only that of the main solver.
fn derived(ends: &Ends, chain: &Chain, watch: &crate::Watch) -> Result<Derivation> {
    if ends.redundant && is_redundant(chain) && !chain.given().is_empty() {
        return Derivation::redundant(ChainProblem::ideal(ends.ideal(chain)?, chain), watch);
    }
    Options::new().watch(watch.clone()).tolerance(ends.tolerance()).derive(chain)
}

/// The path of a redundant chain along arcs of solutions within limits, and whether it is unsure.
fn along(
    chain: &Chain,
    request: &PathRequest<'_>,
    target: impl Fn(Pose) -> Result<ArmTarget>,
    path: impl FnOnce(&[ArmTarget], &PathOptions<'_>) -> Result<ArmPath>,
) -> Result<(Followed, bool)> {
    let times = request.pace.times(request.poses.len())?;
    let targets: Vec<ArmTarget> = request.poses.iter().map(|pose| target(*pose)).collect::<Result<_>>()?;
    let path = path(&targets, &PathOptions::new().speeds(&times, request.speeds))?;
    let track = |(place, joint): (usize, &Joint)| JointTrack {
        name: joint.name.clone(),
        slides: joint.kind == JointKind::Prismatic,
        limits: joint.limits,
        speed: request.speeds.get(place).copied().flatten(),
    };
    let trajectory = Trajectory {
        robot: chain.name().to_owned(),
        joints: chain.joints().iter().enumerate().map(track).collect(),
        times,
        q: path.q,
        ..Trajectory::default()
    };
    trajectory.check()?;
    let jumps = path.jumps.into_iter().map(|jump| Jump::new(jump.sample, jump.joint, jump.step, jump.why));
    Ok((Followed::new(trajectory, jumps.collect()), path.is_unsure))
}

/// The maximum velocities of the chain's joints, if the description has them.
fn speeds(description: &Description, chain: &Chain) -> Vec<Option<f64>> {
    let Description::Robot(robot) = description else { return Vec::new() };
    let speed = |name: &str| robot.joint(name).ok().and_then(|joint| robot.joints()[joint].speed);
    chain.joints().iter().map(|joint| speed(&joint.name).filter(|speed| *speed > 0.0)).collect()
}

/// The poses of a file, and their times if it has them.
fn read_poses(file: &Path, chain: &Chain) -> Result<(Vec<Pose>, Option<Vec<f64>>)> {
    if is_stdin(file) {
        return read_from(std::io::stdin().lock(), file, chain).map_err(|error| error.in_file(file));
    }
    read_from(BufReader::new(open(file)?), file, chain).map_err(|error| error.in_file(file))
}

/// The columns of poses, with times and without.
fn columns(chain: &Chain) -> Columns {
    let field = |name: &str| {
        Field::new(name, if ["x", "y", "z"].contains(&name) { Quantity::Length } else { Quantity::Number })
    };
    Columns {
        forms: vec![["time"].into_iter().chain(POSE).map(field).collect(), POSE.map(field).to_vec()],
        joints: chain.joints().iter().map(|joint| joint.name.clone()).collect(),
        millimetres: chain.length_unit() == LengthUnit::Millimetre,
        degrees: false,
        skips_unsolved: false,
    }
}

/// The poses of a table of `chain`, and their times if it has them.
///
/// # Errors
/// As [`Reader::next`]; [`ErrorKind::BadValue`] for a quaternion that is not of length one, more poses than
/// [`limits::POSES`], and times in some rows only.
pub fn read_from(input: impl BufRead, file: &Path, chain: &Chain) -> Result<(Vec<Pose>, Option<Vec<f64>>)> {
    let mut reader = Reader::new(columns(chain), input, file);
    let (mut poses, mut times) = (Vec::new(), Vec::new());
    while let Some(row) = reader.next() {
        let row = row?;
        let (time, numbers) = match row.target.len() {
            8 => (Some(row.target[0]), &row.target[1..]),
            _ => (None, &row.target[..]),
        };
        limits::check_count("poses", poses.len() + 1, limits::POSES)?;
        poses.push(pose(numbers).map_err(|error| error.at_line(row.line))?);
        times.extend(time);
    }
    match times.len() {
        0 => Ok((poses, None)),
        count if count == poses.len() => Ok((poses, Some(times))),
        _ => Err(Error::new(ErrorKind::BadValue, "some rows have a time and some have none; give all or none")),
    }
}

fn pose(numbers: &[f64]) -> Result<Pose> {
    let count = |_| {
        let text = format!(
            "{} numbers; a pose has seven: x, y, z, qx, qy, qz, qw, and a time before them or none",
            numbers.len()
        );
        Error::new(ErrorKind::BadValue, text)
    };
    pose_of(numbers.try_into().map_err(count)?, ROUNDED)
}

/// A pair of links that touch.
struct Collision<'a> {
    links: [&'a str; 2],
    /// The index of the first such pose.
    sample: usize,
}

impl Collision<'_> {
    fn line(&self) -> String {
        let [one, other] = self.links;
        format!("  links touch: {one} and {other}, from pose {} on\n", self.sample + 1)
    }
}

/// A path with all that is reported of it.
struct Shown<'a> {
    chain: &'a Chain,
    followed: &'a Followed,
    is_unsure: bool,
    /// `None` if collisions of links were not checked.
    collisions: Option<Vec<Collision<'a>>>,
    tip: Option<&'a TipLink>,
    notes: &'a [String],
}

impl Shown<'_> {
    fn json(&self) -> Value {
        let Followed { trajectory, jumps, .. } = self.followed;
        let jump = |jump: &Jump| {
            let joint = &trajectory.joints[jump.joint];
            let unit = if joint.slides { self.chain.length_unit().symbol() } else { "rad" };
            json!({ "pose": jump.sample + 1, "joint": joint.name, "step": jump.step, "unit": unit, "reason": jump.why })
        };
        let collision = |found: &Collision<'_>| json!({ "links": found.links, "first_pose": found.sample + 1 });
        let collisions = self.collisions.as_ref().map(|all| all.iter().map(collision).collect::<Vec<_>>());
        json!({
            "format": FORMAT,
            "name": self.chain.name(),
            "tip_link": self.tip,
            "poses": trajectory.times.len(),
            "duration": trajectory.times.last().zip(trajectory.times.first()).map(|(end, start)| end - start),
            "jumps": jumps.iter().map(jump).collect::<Vec<_>>(),
            "unsure": self.is_unsure,
            "collisions": collisions,
            "notes": self.notes,
        })
    }
}

/// The pairs of links that touch along the path, with the first such pose, all other joints at zero.
fn touching<'a>(robot: &'a Robot, followed: &Followed) -> Result<Vec<Collision<'a>>> {
    let model = Model::new(robot)?;
    let clearance = Clearance::new(robot, &model);
    let places = followed.trajectory.joints.iter().map(|joint| model.joint(&joint.name).ok()).collect::<Vec<_>>();
    let mut seen: Vec<[usize; 2]> = Vec::new();
    let mut collisions = Vec::new();
    for (sample, values) in followed.trajectory.q.iter().enumerate() {
        let mut q = vec![0.0; model.joints().len()];
        for (place, value) in places.iter().zip(values) {
            if let Some(place) = place {
                q[*place] = *value;
            }
        }
        for touch in clearance.touching(&model.place(&Pose::identity(), &q)?) {
            if !seen.contains(&touch.links) {
                seen.push(touch.links);
                collisions.push(Collision { links: touch.links.map(|link| robot.links()[link].name.as_str()), sample });
            }
        }
    }
    Ok(collisions)
}

/// A short summary of the path.
fn summary(chain: &Chain, followed: &Followed) -> String {
    let Followed { trajectory, jumps, .. } = followed;
    let count = trajectory.times.len();
    let plural = if count == 1 { "pose" } else { "poses" };
    let mut text = match jumps.len() {
        0 => format!("{}: {count} {plural}, without a jump\n", chain.name()),
        1 => format!("{}: {count} {plural}, one jump\n", chain.name()),
        more => format!("{}: {count} {plural}, {more} jumps\n", chain.name()),
    };
    for jump in jumps {
        let joint = &trajectory.joints[jump.joint];
        let (step, unit) = if joint.slides { (jump.step, "m") } else { (jump.step.to_degrees(), "deg") };
        text += &format!("  pose {}: {} goes {step:.4} {unit}; {}\n", jump.sample + 1, joint.name, jump.why);
    }
    text
}
