//! `groebot reach`: a reachability map of a derived solver.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use nalgebra::Point3;
use serde_json::{Value, json};

use super::json::{self, FORMAT};
use super::moving::ends;
use super::named::CacheArguments;
use super::output::{Force, Kind};
use super::progress::{Budget, Session};
use super::solve::read_program;
use super::{Outcome, console};
use crate::{Error, ErrorKind, Result};
use groebot_ik::derive::{Ends, InputFile};
use groebot_ik::reach::{Axis, Grid, Measure, ReachMap, Request, Survey};
use groebot_ik::solver::Program;
use groebot_robot::document::shown;
use groebot_robot::kinematics::{BaseAxis, Chain, Joint, JointKind, TargetNumber};

/// The default number of points per axis.
const USUAL: usize = 21;

const EXAMPLES: &str = "Examples:
  groebot reach derivations/ur5 -o ur5.json --plot ur5.svg
  groebot reach derivations/ur5 --x -1:1:41 --y -1:1:41 --z 0.3 --orientations 400 --plot at_30_cm.svg
  groebot reach derivations/ur5 --measure manipulability -o map.csv
  groebot reach derivations/iiwa14 --given 0.5 --measure limits --plot within.svg
  groebot reach panda --measure limits --orientations 20 --plot panda.svg
  groebot view derivations/ur5 --reach ur5.json -o ur5.html

An axis is FROM:TO:COUNT, evenly spaced points including both ends, or one number. The default is a
cube around the first joint that contains the workspace. Each point has orientations, spread evenly
over all that the task distinguishes: rotations, directions, or angles.

A redundant arm (such as panda, of `groebot derive panda.urdf`) needs no --given with --measure limits:
an orientation counts if some solution is within the limits. Those where one may have been missed
are reported as open.

--plot colours slices by the fraction of orientations that are reached, or by the mean
manipulability (of each orientation that of its best solution).";

/// Computes a reachability map of a derived solver: the number of solutions at each point of a grid
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// A folder that `groebot derive` wrote, or its 5_program.json, or a robot's name (`groebot robots`)
    derivation: PathBuf,
    #[command(flatten)]
    cache: CacheArguments,
    /// The grid in x, in the derivation's unit of length (default: 21 points over the workspace)
    #[arg(long, value_name = "FROM:TO:COUNT", value_parser = axis, allow_hyphen_values = true)]
    x: Option<Axis>,
    /// The grid in y (default: as for x)
    #[arg(long, value_name = "FROM:TO:COUNT", value_parser = axis, allow_hyphen_values = true)]
    y: Option<Axis>,
    /// The grid in z (default: as for x)
    #[arg(long, value_name = "FROM:TO:COUNT", value_parser = axis, allow_hyphen_values = true)]
    z: Option<Axis>,
    /// The number of orientations per point
    #[arg(long, value_name = "COUNT", default_value_t = 100)]
    orientations: usize,
    /// The measure: all solutions, those within the described limits, or all with their manipulability
    #[arg(long, value_name = "count|limits|manipulability", default_value = "count", value_parser = measure)]
    measure: Measure,
    /// Count only solutions within the described limits, with any measure
    #[arg(long)]
    limits: bool,
    /// Rotate the orientations of each point randomly, by this random seed
    #[arg(long, value_name = "SEED")]
    seed: Option<u64>,
    /// The values of the joints that are given with each target [rad, m]; a redundant arm needs none with --measure
    /// limits
    #[arg(long, value_name = "NUMBERS", value_delimiter = ',', allow_hyphen_values = true)]
    given: Vec<f64>,
    /// Write the map to this file: JSON, which `groebot view` shows, or CSV
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Write slices of the map to this SVG file
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
    /// The axis normal to the slices (default: one with a single point, else z)
    #[arg(long, value_parser = ["x", "y", "z"], requires = "plot")]
    across: Option<String>,
    /// Print the summary as JSON
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    budget: Budget,
    #[command(flatten)]
    force: Force,
}

/// Computes the map.
pub fn run(arguments: &Arguments) -> Outcome {
    let derivation = arguments.cache.derivation(&arguments.derivation)?;
    let file = derivation.path();
    if let Some(out) = arguments.out.as_ref().filter(|out| !ends(out, "json") && !ends(out, "csv")) {
        let text = "a map is written as JSON or CSV; end its name in .json or .csv";
        return Err(Error::new(ErrorKind::BadValue, text).in_file(out).into());
    }
    let output = arguments.force.output([file]);
    let output = output.expects([arguments.out.as_ref(), arguments.plot.as_ref()])?;
    let (program, chain) = (read_program(file)?, chain(file)?);
    let request = arguments.request(&program, chain.as_ref()).map_err(|error| error.in_file(file))?;
    let session = Session::start(arguments.budget.limits())?;
    let (start, solver) = (Instant::now(), program.solver());
    let map = Survey::new(&solver, &program, chain.as_ref(), &request)
        .map_err(|error| error.in_file(file))?
        .map(&session.watch)?;
    drop(session);
    if let Some(out) = &arguments.out {
        let text = if ends(out, "csv") { map.to_csv() } else { map.to_json() };
        output.write(out, Kind::of_motion(out), text)?;
    }
    if let Some(plot) = &arguments.plot {
        let across = arguments.across.as_deref().and_then(|name| ["x", "y", "z"].iter().position(|own| *own == name));
        output.write(plot, Kind::Markup, map.to_svg(across))?;
    }
    let counts = Counts::of(&map, program.redundancy.is_some() && arguments.given.is_empty(), start.elapsed());
    if arguments.json {
        return console::print(&json::text(&counts.json(&map)));
    }
    if arguments.budget.quiet { Ok(()) } else { console::print(&counts.text(&map)) }
}

impl Arguments {
    fn request(&self, program: &Program, chain: Option<&Chain>) -> Result<Request> {
        let has = |axis: BaseAxis| program.tip().is_some_and(|tip| tip.input(TargetNumber::Position(axis)).is_some());
        let around = chain.and_then(around);
        let axis = |given: Option<Axis>, place: usize| match (given, &around) {
            (Some(axis), _) => Ok(axis),
            _ if !has(BaseAxis::ALL[place]) => Axis::new(0.0, 0.0, 1),
            (None, Some((middle, reach))) => Axis::new(middle[place] - reach, middle[place] + reach, USUAL),
            _ => {
                let name = ["x", "y", "z"][place];
                Err(Error::new(
                    ErrorKind::MissingKey,
                    format!("there is no grid in {name}; give --{name} FROM:TO:COUNT"),
                ))
            }
        };
        let grid = Grid::new([axis(self.x, 0)?, axis(self.y, 1)?, axis(self.z, 2)?])?;
        Ok(Request {
            orientations: self.orientations,
            seed: self.seed,
            given: self.given.clone(),
            measure: self.measure,
            limits: self.limits.then(|| Request::described(program)).transpose()?,
            ..Request::new(grid)
        })
    }
}

/// The chain that was derived in a folder, where there is one.
fn chain(file: &Path) -> Result<Option<Chain>> {
    if file.is_dir() { InputFile::read(file)?.chain(&Ends::default()) } else { Ok(None) }
}

/// A cube that contains the tip of a chain: its centre and half of its side. `None` where a prismatic joint has no
/// limits, or the chain no length.
fn around(chain: &Chain) -> Option<(Point3<f64>, f64)> {
    let travel = |joint: &Joint| match (joint.kind, joint.limits) {
        (JointKind::Revolute, _) => Some(0.0),
        (JointKind::Prismatic, limits) => limits.map(|(low, high)| low.abs().max(high.abs())),
    };
    let travels = chain.joints().iter().map(travel).sum::<Option<f64>>()?;
    let ball = chain.ball();
    Some((ball.middle, ball.radius + travels)).filter(|(_, radius)| *radius > 0.0)
}

/// The sums over a map.
struct Counts {
    points: usize,
    points_reached: usize,
    targets: usize,
    targets_reached: usize,
    /// The number of solutions; `None` of a redundant arm, whose solutions are curves.
    solutions: Option<u64>,
    /// Targets whose solutions are not decided.
    open: usize,
    greatest_manipulability: Option<f32>,
    time: Duration,
}

impl Counts {
    fn of(map: &ReachMap, is_redundant: bool, time: Duration) -> Self {
        let places = map.grid.places();
        let solutions = || map.entries.iter().map(|entry| u64::from(entry.answers)).sum();
        let best = || map.entries.iter().map(|entry| entry.best).fold(0.0, f32::max);
        Counts {
            points: places,
            points_reached: map.entries.iter().filter(|entry| entry.reached > 0).count(),
            targets: places * map.orientations,
            targets_reached: map.reached(),
            solutions: (!is_redundant).then(solutions),
            open: map.open(),
            greatest_manipulability: (map.measure == Measure::Manipulability).then(best),
            time,
        }
    }

    fn text(&self, map: &ReachMap) -> String {
        let ReachMap { solver, task, orientations, .. } = map;
        let Counts { points, points_reached, targets, targets_reached, open, .. } = self;
        let within = if map.limited { " within limits" } else { "" };
        let answers = self.solutions.map(|count| format!(", with {count} answers")).unwrap_or_default();
        let mut text = format!(
            "{solver}, {task}: {points} points, {orientations} orientations each, {:.2} s\nreached{within}: {points_reached} points; {targets_reached} of {targets} targets ({:.1} %){answers}\n",
            self.time.as_secs_f64(),
            100.0 * *targets_reached as f64 / *targets as f64
        );
        if *open > 0 {
            let why = match self.solutions {
                None => "may have a solution that was missed",
                Some(_) => "are on strata that could not be derived",
            };
            text += &format!("{open} targets {why}; they count as not reached\n");
        }
        if let Some(best) = self.greatest_manipulability {
            text += &format!("the greatest manipulability is {best:.6} (metres, radians)\n");
        }
        text
    }

    fn json(&self, map: &ReachMap) -> Value {
        let measure = Measure::NAMES.iter().find(|(_, own)| *own == map.measure).map(|(name, _)| *name);
        json!({
            "format": FORMAT,
            "name": map.solver,
            "task": map.task,
            "measure": measure,
            "within_limits": map.limited,
            "orientations": map.orientations,
            "points": self.points,
            "points_reached": self.points_reached,
            "targets": self.targets,
            "targets_reached": self.targets_reached,
            "targets_undecided": self.open,
            "solutions": self.solutions,
            "greatest_manipulability": self.greatest_manipulability,
            "seconds": self.time.as_secs_f64(),
        })
    }
}

/// Reads `-1:1:41` or `0.3`.
fn axis(text: &str) -> std::result::Result<Axis, String> {
    let wrong = || format!("`{}` is not an axis; give FROM:TO:COUNT such as -1:1:41, or a number", shown(text));
    let number = |text: &str| text.trim().parse::<f64>().map_err(|_| wrong());
    let parts: Vec<&str> = text.split(':').collect();
    let axis = match *parts.as_slice() {
        [at] => Axis::new(number(at)?, number(at)?, 1),
        [from, to, count] => Axis::new(number(from)?, number(to)?, count.trim().parse().map_err(|_| wrong())?),
        _ => return Err(wrong()),
    };
    axis.map_err(|error| error.message().to_owned())
}

fn measure(name: &str) -> std::result::Result<Measure, String> {
    Measure::of(name).map_err(|error| error.message().to_owned())
}
