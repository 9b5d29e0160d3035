//! `groebot path`: the way of a point or of a round robot over a map.

use std::path::PathBuf;
use std::time::Instant;

use clap::ValueEnum;
use nalgebra::Point2;
use serde_json::{Value, json};

use super::floor::{self, FloorArguments};
use super::json::FORMAT;
use super::output::{Force, Kind};
use super::progress::{Limits, Session};
use super::{Halt, Outcome, console};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_humanoid::nav::{Enclosure, Field, Forces, Guide, Map, Method, Potential, Way};

const EXAMPLES: &str = "Examples:
  groebot path map.pgm --start 1,1 --goal 8,5
  groebot path room.yaml --start 1,1 --goal 8,5 --radius 0.2 --method fmm --json
  groebot path maze.map --resolution 1 --start 0.5,0.5 --goal 40.5,30.5 --method octile -o path.csv

Metres. `exact` is the shortest path for a point; it may touch obstacles, which --radius grows. `fmm` goes down a field of fast marching and `m3r` down one of the thesis' own, over the
middles of cells; `octile` is the shortest path over eight neighbours, from the middle of a cell to that of another one. A map without speeds has a field in metres. Where there is no path the exit status is 4, and the output is a set of cells that no
path leaves.";

/// Finds a path over a map
#[derive(clap::Args)]
#[command(after_help = EXAMPLES)]
pub struct Arguments {
    /// The map: ROS' YAML with its image, PGM, PNG, rows of characters, or a room in TOML
    #[arg(value_name = "MAP")]
    map: PathBuf,
    #[command(flatten)]
    floor: FloorArguments,
    /// Where it begins [m]
    #[arg(long, value_name = "X,Y", value_delimiter = ',', num_args = 1, allow_hyphen_values = true)]
    start: Vec<f64>,
    /// Where it ends [m]
    #[arg(long, value_name = "X,Y", value_delimiter = ',', num_args = 1, allow_hyphen_values = true)]
    goal: Vec<f64>,
    /// How it is found
    #[arg(long, value_name = "METHOD", default_value = "exact")]
    method: MethodName,
    /// Pull the path taut as a string
    #[arg(long)]
    taut: bool,
    /// Round its corners by arcs of this radius where the map leaves room [m]; points are then a twentieth of a cell apart
    #[arg(long, value_name = "METRES", allow_hyphen_values = true)]
    smooth: Option<f64>,
    /// Keep obstacles, and what has not been seen, the radius of a round robot away [m]
    #[arg(long, value_name = "METRES", default_value_t = 0.0, allow_hyphen_values = true)]
    radius: f64,
    /// Where the corners of the path go, CSV
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// JSON instead of text
    #[arg(long)]
    json: bool,
    #[command(flatten)]
    force: Force,
}

#[derive(Clone, Copy, ValueEnum)]
enum MethodName {
    /// The shortest path; the quickest one where the map has speeds
    Exact,
    /// Down a field of fast marching
    Fmm,
    /// Down a field of the thesis' M3R
    M3r,
    /// The shortest path over eight neighbours
    Octile,
    /// Down an artificial potential field, which may be stuck
    Potential,
}

/// How far apart the points of a rounded way are, in cells: so arcs are compared with the map.
const CHORD: f64 = 0.05;

/// Where a round robot may be at any place of a free cell.
fn for_radius(map: Map, radius: f64) -> Result<Map> {
    let radius = if radius > 0.0 { radius + map.half_diagonal() } else { radius };
    map.with_unknown_occupied().grown(radius)
}

/// What was found.
struct Found {
    way: std::result::Result<Way, Enclosure>,
    /// No way is shorter \[m\], or quicker \[s\], where that is known.
    bound: Option<f64>,
    /// How long it takes where the map tells speeds \[s\].
    time: Option<f64>,
}

/// Finds the way and tells it.
pub fn run(arguments: &Arguments) -> Outcome {
    let output = arguments.force.output([arguments.map.as_path()]).expects([arguments.out.as_ref()])?;
    let session = Session::start(Limits::default())?;
    let (map, _) = arguments.floor.map(&arguments.map)?;
    let map = if arguments.radius == 0.0 { map } else { for_radius(map, arguments.radius)? };
    let [start, goal] = [("start", &arguments.start), ("goal", &arguments.goal)].map(|(name, told)| match told[..] {
        [x, y] => Ok(Point2::new(x, y)),
        _ => Err(Error::new(ErrorKind::BadValue, format!("--{name} takes two numbers: --{name} 1,0.5"))),
    });
    let begun = Instant::now();
    let found = arguments.found(&map, &start?, &goal?, &session.watch)?;
    let milliseconds = 1e3 * begun.elapsed().as_secs_f64();
    drop(session);
    if let (Some(file), Ok(way)) = (&arguments.out, &found.way) {
        let rows: String = way.points.iter().map(|point| format!("{},{}\n", point.x, point.y)).collect();
        output.write(file, Kind::Plain, format!("x,y\n{rows}"))?;
    }
    let text = if arguments.json {
        super::json::text(&arguments.json(&map, &found, milliseconds))
    } else {
        found.text(&map, milliseconds)
    };
    console::print(&text)?;
    found.way.map(|_| ()).map_err(|_| Halt::NoWay)
}

impl Arguments {
    fn found(&self, map: &Map, start: &Point2<f64>, goal: &Point2<f64>, watch: &Watch) -> Result<Found> {
        let mut found = self.method.find(map, start, goal, watch)?;
        let Ok(way) = &mut found.way else { return Ok(found) };
        if self.taut {
            *way = way.taut(map, watch)?;
            found.time = found.time.and_then(|_| way.time(map));
        }
        if let Some(radius) = self.smooth {
            let poses = way.smoothed(map, radius)?.poses(CHORD * map.resolution())?;
            *way = Way { points: poses.into_iter().map(|(at, _)| at).collect() };
            found.time = found.time.and_then(|_| way.time(map));
        }
        Ok(found)
    }

    fn json(&self, map: &Map, found: &Found, milliseconds: f64) -> Value {
        let method = self.method.to_possible_value().map(|value| value.get_name().to_owned());
        let mut told = json!({ "format": FORMAT, "method": method, "milliseconds": milliseconds });
        match &found.way {
            Ok(way) => {
                told["points"] = floor::points(way);
                told["length"] = way.length().into();
                told["seconds"] = found.time.into();
                told["bound"] = found.bound.into();
            }
            Err(enclosure) => {
                told["points"] = Value::Null;
                told["enclosure"] = floor::enclosure(map, enclosure);
            }
        }
        told
    }
}

impl MethodName {
    fn find(self, map: &Map, start: &Point2<f64>, goal: &Point2<f64>, watch: &Watch) -> Result<Found> {
        let down = |method: Method| {
            let way = Field::new(map, &[*goal], method, watch)?.descend(map, start)?;
            Ok(way.map(|way| way.between(start, goal)))
        };
        let way = match self {
            MethodName::Exact if map.speeds().is_some() => {
                let found = map.quickest_way(start, goal, None, watch)?;
                let (time, bound) = found.as_ref().map(|quickest| (quickest.time, quickest.bound)).ok().unzip();
                return Ok(Found { way: found.map(|quickest| quickest.way), bound, time });
            }
            MethodName::Exact => {
                let found = map.shortest_way(start, goal, &Guide::default(), watch)?;
                let bound = found.as_ref().ok().map(|shortest| shortest.bound);
                return Ok(Found { way: found.map(|shortest| shortest.way), bound, time: None });
            }
            MethodName::Fmm => down(Method::FastMarching(1)),
            MethodName::M3r => down(Method::M3r),
            MethodName::Octile => map.octile_way(start, goal, watch),
            MethodName::Potential => {
                let found = Potential::new(map, goal, &Forces::default())?.descend(map, start)?;
                let stuck = |stuck| Error::new(ErrorKind::BadValue, format!("{stuck}; take another method"));
                found.map(|way| Ok(way.between(start, goal))).map_err(stuck)
            }
        }?;
        let time = way.as_ref().ok().filter(|_| map.speeds().is_some()).and_then(|way| way.time(map));
        Ok(Found { way, bound: None, time })
    }
}

impl Found {
    fn text(&self, map: &Map, milliseconds: f64) -> String {
        match &self.way {
            Ok(way) => {
                let proved = match (self.bound, self.time) {
                    (Some(bound), None) if bound >= way.length() * (1.0 - 1e-12) => {
                        ", proved to be the shortest".to_owned()
                    }
                    (Some(bound), None) => format!(", none is shorter than {bound:.4} m"),
                    (Some(bound), Some(time)) => format!(", {time:.4} s, none is quicker than {bound:.4} s"),
                    (None, Some(time)) => format!(", {time:.4} s"),
                    (None, None) => String::new(),
                };
                let rows: String =
                    way.points.iter().map(|point| format!("  {:.4} {:.4}\n", point.x, point.y)).collect();
                format!(
                    "path of {:.4} m{proved}, {} points, {milliseconds:.2} ms\n{rows}",
                    way.length(),
                    way.points.len()
                )
            }
            Err(enclosure) => {
                let area = enclosure.cells.len() as f64 * map.resolution().powi(2);
                format!(
                    "there is no path: {} cells ({area:.2} m^2) that no path leaves enclose start or goal, {milliseconds:.2} ms\n",
                    enclosure.cells.len()
                )
            }
        }
    }
}
