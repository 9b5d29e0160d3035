//! Output of solutions: a text table, JSON, CSV.

use serde::Serialize;

use super::cells::{csv_line, exact, fixed, table};
use super::closest::{self, Search};
use super::columns::heading;
use super::following::{followers, leaders};
use super::json::FORMAT;
use groebot_ik::solver::{Closest, Joint, Program, Unit};
use groebot_robot::kinematics::{Placed, Solution};

/// The unit of angles in input and output.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum Angles {
    /// Radians.
    Radians,
    /// Degrees.
    Degrees,
}

impl Angles {
    /// Converts `target` to the units of the program.
    pub fn to_radians(self, program: &Program, target: &[f64]) -> Vec<f64> {
        let value = |(index, value): (usize, &f64)| match program.inputs.get(index).map(|input| input.unit) {
            Some(Unit::Radian) if self == Angles::Degrees => value.to_radians(),
            _ => *value,
        };
        target.iter().enumerate().map(value).collect()
    }

    /// Converts `target` from the units of the program.
    pub fn of_target(self, program: &Program, target: &[f64]) -> Vec<f64> {
        let value = |(index, value): (usize, &f64)| match program.inputs.get(index).map(|input| input.unit) {
            Some(Unit::Radian) if self == Angles::Degrees => value.to_degrees(),
            _ => *value,
        };
        target.iter().enumerate().map(value).collect()
    }

    /// The symbol of `unit` in the unit of angles.
    pub fn symbol(self, unit: Unit) -> &'static str {
        match unit {
            Unit::Radian if self == Angles::Degrees => "deg",
            unit => unit.symbol(),
        }
    }

    /// A value of `joint` in the unit of angles.
    pub fn shown(self, joint: &Joint, value: f64) -> f64 {
        if joint.unit == Unit::Radian && self == Angles::Degrees { value.to_degrees() } else { value }
    }
}

/// A target and its solutions.
pub struct Answer<'a> {
    /// The program that solved it.
    pub program: &'a Program,
    /// The target as it was given.
    pub target: Vec<f64>,
    /// All solutions.
    pub solutions: Vec<Solution>,
    /// The reason why there is no solution, if it is known.
    pub reason: Option<String>,
    /// The closest joint values, if they were requested.
    pub closest: Search,
    /// The unit of angles in the target, in JSON and in CSV.
    pub angles: Angles,
}

impl<'a> Answer<'a> {
    /// A target of a redundant arm whose solutions are printed elsewhere, with the closest joint values.
    pub fn of_closest(program: &'a Program, closest: Search, angles: Angles) -> Self {
        Answer { program, target: Vec::new(), solutions: Vec::new(), reason: None, closest, angles }
    }
}

impl Answer<'_> {
    /// The error of the closest joint values, and a table of them; empty without them.
    pub fn closest_text(&self) -> String {
        self.closest.found().map(|found| closest_text(self, found)).unwrap_or_default()
    }

    /// The closest joint values in JSON.
    pub fn closest_entry(&self) -> Option<ClosestEntry<'_>> {
        self.closest.found().map(|found| ClosestEntry::new(self, found))
    }

    /// Whether the solver completed its work on the target.
    fn are_settled(&self) -> bool {
        self.solutions.iter().all(|solution| solution.settled)
    }

    fn free_names(&self, solution: &Solution) -> Vec<&str> {
        solution.free.iter().map(|&joint| self.program.joints[joint].name.as_str()).collect()
    }

    /// The joints that are outside their limits, also after adding whole turns.
    pub fn outside_names(&self, solution: &Solution) -> Vec<&str> {
        let outside = |(index, _): &(usize, &Joint)| {
            let placed = Placed::fixed(solution.q[*index], limits(self.program, *index));
            !solution.free.contains(index) && !placed.is_within
        };
        self.program.joints.iter().enumerate().filter(outside).map(|(_, joint)| joint.name.as_str()).collect()
    }

    /// The joint values with both units of each angle.
    pub fn joint_cells(&self, solution: &Solution) -> Vec<String> {
        let cell = |(joint, value): (&Joint, &f64)| match joint.unit {
            Unit::Radian => format!("{} deg ({} rad)", fixed(value.to_degrees(), 6), fixed(*value, 9)),
            unit => format!("{} {}", fixed(*value, 9), self.angles.symbol(unit)).trim_end().to_owned(),
        };
        self.program.joints.iter().zip(&solution.q).map(cell).collect()
    }

    /// The joint values in the unit of angles.
    pub fn shown(&self, solution: &Solution) -> Vec<f64> {
        let joints = self.program.joints.iter().zip(&solution.q);
        joints.map(|(joint, value)| self.angles.shown(joint, *value)).collect()
    }
}

/// The least and greatest value of the joint with this index.
fn limits(program: &Program, joint: usize) -> Option<(f64, f64)> {
    program.about.as_ref().and_then(|about| about.limits.get(joint).copied().flatten())
}

/// Moves each angle into its joint's limits by whole turns, where that is possible; given joints stay unchanged.
pub fn turned(program: &Program, mut solutions: Vec<Solution>) -> Vec<Solution> {
    let turns = |index: &usize| program.joints[*index].unit == Unit::Radian && !program.is_given(*index);
    for index in (0..program.joints.len()).filter(turns) {
        let limits = limits(program, index);
        solutions.iter_mut().for_each(|solution| solution.q[index] = Placed::turned(solution.q[index], limits).value);
    }
    solutions
}

/// A text table with both units of each angle.
pub fn text(answer: &Answer<'_>) -> String {
    let program = answer.program;
    let target = program.inputs.iter().zip(&answer.target).map(|(input, value)| {
        let unit = answer.angles.symbol(input.unit);
        format!("{} = {}{}{unit}", input.name, exact(*value), if unit.is_empty() { "" } else { " " })
    });
    let title = format!("{} at {}", program.name, target.collect::<Vec<_>>().join(", "));
    if answer.solutions.is_empty() {
        let reason = answer.reason.as_ref().map(|reason| format!(": {reason}")).unwrap_or_default();
        return format!("{title}: unreachable: no solution{reason}\n{}", answer.closest_text());
    }
    let plural = if answer.solutions.len() == 1 { "solution" } else { "solutions" };
    let mut text = format!("{title}: {} {plural}\n", answer.solutions.len());
    let mut rows = vec![header(program)];
    rows.extend(answer.solutions.iter().map(|solution| cells(answer, solution)));
    text += &table(&rows);
    text += &followers(program.joints.iter().map(|joint| joint.name.as_str()).zip(program.follows()));
    if answer.solutions.iter().any(|solution| !solution.free.is_empty()) {
        text += "  A free joint may have any value: the row is one member of a self-motion.\n";
    }
    if !answer.are_settled() {
        text += "  Not settled: the step limit of this target was reached. Other solutions may be missing.\n";
    }
    text
}

fn header(program: &Program) -> Vec<String> {
    let mut header = vec!["branch".to_owned()];
    header.extend(program.joints.iter().map(|joint| joint.name.clone()));
    header.extend(["residual".to_owned(), String::new()]);
    header
}

fn cells(answer: &Answer<'_>, solution: &Solution) -> Vec<String> {
    let mut row = vec![solution.branch.to_string()];
    row.extend(answer.joint_cells(solution));
    row.push(if solution.residual == 0.0 { "0".to_owned() } else { format!("{:.1e}", solution.residual) });
    let mut notes: Vec<String> = answer.free_names(solution).iter().map(|name| format!("{name} is free")).collect();
    notes.extend(answer.outside_names(solution).iter().map(|name| format!("{name} outside its limits")));
    if solution.chosen {
        notes.push("<- the published choice".to_owned());
    }
    if !solution.settled {
        notes.push("not settled".to_owned());
    }
    row.push(notes.join(", "));
    row
}

#[derive(Serialize)]
struct Page<'a> {
    format: u32,
    name: &'a str,
    target: &'a [f64],
    unit: Units<'a>,
    joints: Vec<&'a str>,
    /// The leader of each mimic joint.
    #[serde(skip_serializing_if = "Option::is_none")]
    mimics: Option<Vec<Option<&'a str>>>,
    /// Whether the solver completed its work on the target; otherwise solutions may be missing.
    settled: bool,
    solutions: Vec<Entry<'a>>,
    /// The reason why there is no solution, if it is known.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<&'a str>,
    /// The closest joint values, if they were requested and there is no solution.
    #[serde(skip_serializing_if = "Option::is_none")]
    closest: Option<ClosestEntry<'a>>,
}

/// The unit of each number of the target and of each joint.
#[derive(Serialize)]
struct Units<'a> {
    target: Vec<&'a str>,
    joints: Vec<&'a str>,
}

#[derive(Serialize)]
struct Entry<'a> {
    q: Vec<f64>,
    residual: f64,
    branch: usize,
    /// Names of the joints that may have any value.
    free: Vec<&'a str>,
    /// Names of the joints that are outside their limits, also after adding whole turns.
    outside_limits: Vec<&'a str>,
    chosen: bool,
    /// Whether the solver completed its work on the target.
    settled: bool,
}

/// One JSON object: on several lines when `pretty`, else on one.
pub fn json(answer: &Answer<'_>, pretty: bool) -> String {
    let program = answer.program;
    let entry = |solution| Entry {
        q: answer.shown(solution),
        residual: solution.residual,
        branch: solution.branch,
        free: answer.free_names(solution),
        outside_limits: answer.outside_names(solution),
        chosen: solution.chosen,
        settled: solution.settled,
    };
    let page = Page {
        format: FORMAT,
        name: &program.name,
        target: &answer.target,
        unit: Units {
            target: program.inputs.iter().map(|input| answer.angles.symbol(input.unit)).collect(),
            joints: program.joints.iter().map(|joint| answer.angles.symbol(joint.unit)).collect(),
        },
        joints: program.joints.iter().map(|joint| joint.name.as_str()).collect(),
        mimics: leaders(program.follows().into_iter()),
        settled: answer.are_settled(),
        solutions: answer.solutions.iter().map(entry).collect(),
        reason: answer.reason.as_deref(),
        closest: answer.closest_entry(),
    };
    let text = if pretty { serde_json::to_string_pretty(&page) } else { serde_json::to_string(&page) };
    text.expect("an answer can be represented in JSON") + "\n"
}

/// The names of the columns; with `closest` those of the closest joint values after them.
pub fn csv_header(program: &Program, angles: Angles, closest: bool) -> String {
    let named = |name: &str, unit: Unit| heading(name, unit == Unit::Radian, angles == Angles::Degrees);
    let mut cells = vec!["target".to_owned()];
    cells.extend(program.inputs.iter().map(|input| named(&input.name, input.unit)));
    cells.extend(["solutions".to_owned(), "branch".to_owned()]);
    cells.extend(program.joints.iter().map(|joint| named(&joint.name, joint.unit)));
    cells.extend(["residual", "chosen", "settled", "free", "outside_limits"].map(str::to_owned));
    if closest {
        cells.extend(closest::COLUMNS.map(|name| heading(name, name.ends_with("angle"), angles == Angles::Degrees)));
    }
    csv_line(&cells)
}

/// One row per solution; an unreachable target has one row with 0 solutions and empty cells, or with the closest joint
/// values. `index` counts targets from 1.
pub fn csv_rows(answer: &Answer<'_>, index: usize) -> String {
    let mut start = vec![index.to_string()];
    start.extend(answer.target.iter().map(|value| exact(*value)));
    start.push(answer.solutions.len().to_string());
    if answer.solutions.is_empty() {
        return csv_line(&unreachable_row(answer, start));
    }
    let beside = if answer.closest.is_on() { closest_cells(answer) } else { Vec::new() };
    let row = |solution: &Solution| {
        let mut cells = start.clone();
        cells.push(solution.branch.to_string());
        cells.extend(answer.shown(solution).iter().map(|value| exact(*value)));
        cells.push(format!("{:e}", solution.residual));
        cells.push(solution.chosen.to_string());
        cells.push(solution.settled.to_string());
        cells.push(answer.free_names(solution).join(" "));
        cells.push(answer.outside_names(solution).join(" "));
        cells.extend(beside.iter().cloned());
        csv_line(&cells)
    };
    answer.solutions.iter().map(row).collect()
}

/// The row of a target without a solution.
fn unreachable_row(answer: &Answer<'_>, start: Vec<String>) -> Vec<String> {
    let joints = answer.program.joints.len();
    let Some(found) = answer.closest.found() else {
        let blank = joints + 6 + if answer.closest.is_on() { closest::COLUMNS.len() } else { 0 };
        return start.into_iter().chain(vec![String::new(); blank]).collect();
    };
    let row = closest::solution(found);
    let mut cells = start;
    cells.push(String::new());
    cells.extend(answer.shown(&row).iter().map(|value| exact(*value)));
    cells.extend(vec![String::new(); 4]);
    cells.push(answer.outside_names(&row).join(" "));
    cells.extend(closest_cells(answer));
    cells
}

/// Their error, and a table of the joints.
fn closest_text(answer: &Answer<'_>, closest: &Closest) -> String {
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
    let row = closest::solution(closest);
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
pub struct ClosestEntry<'a> {
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

impl<'a> ClosestEntry<'a> {
    /// The entry, with angles in the unit of the answer.
    fn new(answer: &'a Answer<'_>, closest: &Closest) -> Self {
        let row = closest::solution(closest);
        let reached =
            answer.program.tip().and_then(|tip| tip.layout().values(&closest.reached).ok()).unwrap_or_default();
        ClosestEntry {
            q: answer.shown(&row),
            reached: answer.angles.of_target(answer.program, &reached),
            distance: closest.distance,
            angle: angle_shown(answer.angles, closest.angle),
            is_minimum: closest.is_minimum,
            starts: closest.starts,
            agreeing: closest.agreeing,
            outside_limits: answer.outside_names(&row),
        }
    }
}

/// The cells of [`closest::COLUMNS`]; empty for a target with solutions.
fn closest_cells(answer: &Answer<'_>) -> Vec<String> {
    match answer.closest.found() {
        Some(closest) => vec![exact(closest.distance), exact(angle_shown(answer.angles, closest.angle))],
        None => vec![String::new(); closest::COLUMNS.len()],
    }
}

fn angle_shown(angles: Angles, angle: f64) -> f64 {
    if angles == Angles::Degrees { angle.to_degrees() } else { angle }
}
