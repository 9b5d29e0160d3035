//! `groebot path`: the path of a point or of a round robot on a map.

use std::path::PathBuf;
use std::time::Instant;

use clap::ValueEnum;
use nalgebra::Point2;
use serde_json::{Value, json};

use super::cells::fixed;
use super::floor::{self, FloorArguments};
use super::json::FORMAT;
use super::output::{Force, Kind};
use super::progress::{Limits, Session};
use super::{Halt, Outcome, console};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_humanoid::nav::{Enclosure, Field, Forces, Guide, Map, Method, Path as FloorPath, Potential};

const EXAMPLES: &str = "Examples:
  groebot path map.pgm --start 1,1 --goal 8,5
  groebot path room.yaml --start 1,1 --goal 8,5 --radius 0.2 --method fmm --json
  groebot path maze.map --resolution 1 --start 0.5,0.5 --goal 40.5,30.5 --method octile -o path.csv

Metres. `exact` is the shortest path for a point; it may touch obstacles, which --radius grows.
`fmm` descends a fast marching field, and `m3r` that of the thesis' modified method, over the
middles of cells. `octile` is the shortest path on the grid with eight neighbours, between the
middles of cells. Without speeds in the map, a field is in metres.

If there is no path, the exit status is 4, and the output is a set of cells that no path leaves.";

/// Finds the shortest path on a map, with a proof, or a path by another method
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The map: ROS YAML with its image, PGM, PNG, text, or a room in TOML
    #[arg(value_name = "MAP")]
    map: PathBuf,
    #[command(flatten)]
    floor: FloorArguments,
    /// The start [m]
    #[arg(long, value_name = "X,Y", value_delimiter = ',', num_args = 1, allow_hyphen_values = true)]
    start: Vec<f64>,
    /// The goal [m]
    #[arg(long, value_name = "X,Y", value_delimiter = ',', num_args = 1, allow_hyphen_values = true)]
    goal: Vec<f64>,
    /// The method that finds the path
    #[arg(long, value_name = "METHOD", default_value = "exact")]
    method: MethodName,
    /// Pull the path taut (string pulling)
    #[arg(long)]
    taut: bool,
    /// Replace its corners by arcs of this radius where the map has space [m]; the points are then at a distance of a
    /// twentieth of a cell
    #[arg(long, value_name = "METRES", allow_hyphen_values = true)]
    smooth: Option<f64>,
    /// The radius of a round robot: the least distance of each point of the path from obstacles and unknown cells [m].
    /// The middles of cells on the path are farther away by half a cell's diagonal, as in `navigate`
    #[arg(long, value_name = "METRES", default_value_t = 0.0, allow_hyphen_values = true)]
    radius: f64,
    /// Write the corners of the path to this CSV file
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Print JSON instead of text
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    force: Force,
}

#[derive(Clone, Copy, ValueEnum)]
enum MethodName {
    /// The shortest path, or the fastest one if the map has speeds
    Exact,
    /// The descent path of a fast marching field
    Fmm,
    /// The descent path of an M3R field (RH0 thesis)
    M3r,
    /// The shortest path on the grid with eight neighbours
    Octile,
    /// The descent path of an artificial potential field, which may end in a local minimum
    Potential,
}

/// The distance between the points of a smoothed path, in cells: the spacing of collision checks.
const CHORD: f64 = 0.05;

/// The map of the free cells in which a round robot may be anywhere: their middles are farther from obstacles by half a
/// diagonal.
fn for_radius(map: Map, radius: f64) -> Result<Map> {
    let radius = if radius > 0.0 { radius + map.half_diagonal() } else { radius };
    map.with_unknown_occupied().grown(radius)
}

/// The result.
struct Found {
    path: std::result::Result<FloorPath, Enclosure>,
    /// A lower bound for the length \[m\] or the time \[s\] of all paths, where it is known.
    bound: Option<f64>,
    /// Its time where the map has speeds \[s\].
    time: Option<f64>,
}

/// Finds the path and prints it.
pub fn run(arguments: &Arguments) -> Outcome {
    let output = arguments.force.output([arguments.map.as_path()]).expects([arguments.out.as_ref()])?;
    let session = Session::start(Limits::default())?;
    let (map, _) = arguments.floor.map(&arguments.map)?;
    let map = if arguments.radius == 0.0 { map } else { for_radius(map, arguments.radius)? };
    let [start, goal] =
        [("start", &arguments.start), ("goal", &arguments.goal)].map(|(name, numbers)| match numbers[..] {
            [x, y] => Ok(Point2::new(x, y)),
            _ => Err(Error::new(ErrorKind::BadValue, format!("--{name} takes two numbers: --{name} 1,0.5"))),
        });
    let begun = Instant::now();
    let found = arguments.found(&map, &start?, &goal?, &session.watch)?;
    let milliseconds = 1e3 * begun.elapsed().as_secs_f64();
    drop(session);
    if let (Some(file), Ok(path)) = (&arguments.out, &found.path) {
        let rows: String = path.points.iter().map(|point| format!("{},{}\n", point.x, point.y)).collect();
        output.write(file, Kind::Plain, format!("x,y\n{rows}"))?;
    }
    let text = if arguments.json {
        super::json::text(&arguments.json(&map, &found, milliseconds))
    } else {
        found.text(&map, milliseconds)
    };
    console::print(&text)?;
    found.path.map(|_| ()).map_err(|_| Halt::NoPath)
}

impl Arguments {
    fn found(&self, map: &Map, start: &Point2<f64>, goal: &Point2<f64>, watch: &Watch) -> Result<Found> {
        let mut found = self.method.find(map, start, goal, watch)?;
        let Ok(path) = &mut found.path else { return Ok(found) };
        if self.taut {
            *path = path.taut(map, watch)?;
            found.time = found.time.and_then(|_| path.time(map));
        }
        if let Some(radius) = self.smooth {
            let poses = path.smoothed(map, radius)?.poses(CHORD * map.resolution())?;
            *path = FloorPath { points: poses.into_iter().map(|(at, _)| at).collect() };
            found.time = found.time.and_then(|_| path.time(map));
        }
        Ok(found)
    }

    fn json(&self, map: &Map, found: &Found, milliseconds: f64) -> Value {
        let method = self.method.to_possible_value().map(|value| value.get_name().to_owned());
        let mut json_report = json!({ "format": FORMAT, "method": method, "milliseconds": milliseconds });
        match &found.path {
            Ok(path) => {
                json_report["points"] = floor::points(path);
                json_report["length"] = path.length().into();
                json_report["seconds"] = found.time.into();
                json_report["lower_bound"] = found.bound.into();
            }
            Err(enclosure) => {
                json_report["points"] = Value::Null;
                json_report["enclosure"] = floor::enclosure(map, enclosure);
            }
        }
        json_report
    }
}

impl MethodName {
    fn find(self, map: &Map, start: &Point2<f64>, goal: &Point2<f64>, watch: &Watch) -> Result<Found> {
        let down = |method: Method| {
            let path = Field::new(map, &[*goal], method, watch)?.descend(map, start)?;
            Ok(path.map(|path| path.between(start, goal)))
        };
        let path = match self {
            MethodName::Exact if map.speeds().is_some() => {
                let found = map.quickest_path(start, goal, None, watch)?;
                let (time, bound) = found.as_ref().map(|quickest| (quickest.time, quickest.bound)).ok().unzip();
                return Ok(Found { path: found.map(|quickest| quickest.path), bound, time });
            }
            MethodName::Exact => {
                let found = map.shortest_path(start, goal, &Guide::default(), watch)?;
                let bound = found.as_ref().ok().map(|shortest| shortest.bound);
                return Ok(Found { path: found.map(|shortest| shortest.path), bound, time: None });
            }
            MethodName::Fmm => down(Method::FastMarching(1)),
            MethodName::M3r => down(Method::M3r),
            MethodName::Octile => map.octile_path(start, goal, watch),
            MethodName::Potential => {
                let found = Potential::new(map, goal, &Forces::default())?.descend(map, start)?;
                let stuck = |stuck| Error::new(ErrorKind::BadValue, format!("{stuck}; use another method"));
                found.map(|path| Ok(path.between(start, goal))).map_err(stuck)
            }
        }?;
        let time = path.as_ref().ok().filter(|_| map.speeds().is_some()).and_then(|path| path.time(map));
        Ok(Found { path, bound: None, time })
    }
}

impl Found {
    fn text(&self, map: &Map, milliseconds: f64) -> String {
        match &self.path {
            Ok(path) => {
                let proved = match (self.bound, self.time) {
                    (Some(bound), None) if bound >= path.length() * (1.0 - 1e-12) => {
                        ", proved to be the shortest".to_owned()
                    }
                    (Some(bound), None) => format!(", lower bound {bound:.4} m"),
                    (Some(bound), Some(time)) => format!(", {time:.4} s, lower bound {bound:.4} s"),
                    (None, Some(time)) => format!(", {time:.4} s"),
                    (None, None) => String::new(),
                };
                let rows: String = path
                    .points
                    .iter()
                    .map(|point| format!("  {} {}\n", fixed(point.x, 4), fixed(point.y, 4)))
                    .collect();
                format!(
                    "path of {:.4} m{proved}, {} points, {milliseconds:.2} ms\n{rows}",
                    path.length(),
                    path.points.len()
                )
            }
            Err(enclosure) => {
                let area = enclosure.cells.len() as f64 * map.resolution().powi(2);
                format!(
                    "there is no path: {} cells ({area:.2} m^2) enclose start or goal, and no path leaves them, {milliseconds:.2} ms\n",
                    enclosure.cells.len()
                )
            }
        }
    }
}
