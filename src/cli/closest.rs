//! The closest joint values of a target without a solution, in the output of `groebot solve --closest`. Main type: [`Search`].

use serde::Serialize;

use super::answers::{Angles, Answer, exact, table, turned};
use crate::Result;
use groebot_ik::solver::{Closest, ClosestOptions, Program, Solver, Unit};
use groebot_robot::kinematics::Solution;

/// The names of the columns after those of all answers; the second is an angle.
pub const COLUMNS: [&str; 2] = ["closest_distance", "closest_angle"];

/// Whether the closest joint values were requested, and found.
#[derive(Clone, Debug)]
pub enum Search {
    /// They were not requested.
    Off,
    /// The target has solutions.
    Needless,
    /// The closest joint values.
    Found(Box<Closest>),
}

impl Search {
    /// Searches for `target`, in radians, unless it has solutions. Angles are moved into their joints' limits by whole turns where possible.
    ///
    /// # Errors
    /// As [`Solver::closest_numbers`].
    pub fn run(program: &Program, solver: &Solver, target: &[f64], options: &ClosestOptions) -> Result<Search> {
        let mut found = solver.closest_numbers(target, options)?;
        if found.reachable {
            return Ok(Search::Needless);
        }
        let moved = turned(program, vec![solution(&found)]);
        found.q = moved.into_iter().next().map_or(found.q, |solution| solution.q);
        Ok(Search::Found(Box::new(found)))
    }

    /// The closest joint values.
    pub fn found(&self) -> Option<&Closest> {
        match self {
            Search::Found(closest) => Some(closest),
            _ => None,
        }
    }

    pub fn is_on(&self) -> bool {
        !matches!(self, Search::Off)
    }
}

/// The joint values as a solution without branch.
pub fn solution(closest: &Closest) -> Solution {
    Solution { q: closest.q.clone(), ..Solution::default() }
}

/// Their error, and a table of the joints.
pub fn text(answer: &Answer<'_>, closest: &Closest) -> String {
    let length =
        answer.program.inputs.iter().map(|input| input.unit).find(|unit| !matches!(unit, Unit::Radian | Unit::One));
    let short = closest.distance < 1e-3 && closest.distance > 0.0;
    let number = if short { format!("{:.3e}", closest.distance) } else { format!("{:.6}", closest.distance) };
    let distance = length.map(|unit| format!("{number} {}", unit.symbol()));
    let angle = format!("{:.6} deg ({:.9} rad)", closest.angle.to_degrees(), closest.angle);
    let misses = match distance {
        Some(distance) if closest.angle == 0.0 => distance,
        Some(distance) => format!("{distance} and {angle}"),
        None => angle,
    };
    let kind = if closest.is_minimum { "a local minimum" } else { "not certainly a local minimum" };
    let row = solution(closest);
    let mut header: Vec<String> = answer.program.joints.iter().map(|joint| joint.name.clone()).collect();
    header.push(String::new());
    let mut cells = answer.joint_cells(&row);
    let outside: Vec<String> =
        answer.outside_names(&row).iter().map(|name| format!("{name} outside its limits")).collect();
    cells.push(outside.join(", "));
    format!(
        "closest joint values: {misses} from the target; {kind}, found from {} of {} starting points\n{}",
        closest.agreeing,
        closest.starts,
        table(&[header, cells])
    )
}

/// The closest joint values in JSON.
#[derive(Serialize)]
pub struct Entry<'a> {
    q: Vec<f64>,
    /// The numbers that they reach, as those of the target.
    reached: Vec<f64>,
    distance: f64,
    angle: f64,
    is_minimum: bool,
    starts: usize,
    agreeing: usize,
    outside_limits: Vec<&'a str>,
}

impl<'a> Entry<'a> {
    /// The entry, with angles in the unit of the answer.
    pub fn new(answer: &'a Answer<'_>, closest: &Closest) -> Self {
        let row = solution(closest);
        let reached =
            answer.program.tip().and_then(|tip| tip.layout().values(&closest.reached).ok()).unwrap_or_default();
        Entry {
            q: answer.shown(&row),
            reached: answer.angles.of_target(answer.program, &reached),
            distance: closest.distance,
            angle: shown(answer.angles, closest.angle),
            is_minimum: closest.is_minimum,
            starts: closest.starts,
            agreeing: closest.agreeing,
            outside_limits: answer.outside_names(&row),
        }
    }
}

/// The cells of [`COLUMNS`]; empty for a target with solutions.
pub fn cells(answer: &Answer<'_>) -> Vec<String> {
    match answer.closest.found() {
        Some(closest) => vec![exact(closest.distance), exact(shown(answer.angles, closest.angle))],
        None => vec![String::new(); COLUMNS.len()],
    }
}

fn shown(angles: Angles, angle: f64) -> f64 {
    if angles == Angles::Degrees { angle.to_degrees() } else { angle }
}
