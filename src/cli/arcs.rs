//! Output of `groebot solve` for a redundant solver: all arcs of solutions within limits, and the best solution.

use serde::Serialize;

use super::answers::{Angles, Answer, ClosestEntry};
use super::cells::{exact, table};
use super::closest::Search;
use super::forms::Forms;
use super::json::FORMAT;
use super::targets;
use crate::{Error, ErrorKind, Result};
use groebot_ik::solver::redundant::{ArcEnd, Arcs, Best, Criterion, JointLimits, RedundantSolver};
use groebot_ik::solver::{Closest, ErrorWeights, Program, Unit};

/// A redundant solver with the options of the command.
pub struct ArcQuestion {
    /// The program without the input of its given joint.
    bare: Program,
    solver: RedundantSolver,
    forms: Forms,
    limits: JointLimits,
    criterion: Criterion,
    closest: Option<ErrorWeights>,
    angles: Angles,
}

/// The options of the command for redundant solvers.
pub struct ArcOptions<'a> {
    /// Narrower limits, each `JOINT=LOW,HIGH`.
    pub limits: &'a [String],
    /// The joint values that the solution shall be near to, as text.
    pub closest_to: Option<&'a str>,
    /// The error of the closest joint values, if they are requested.
    pub closest: Option<ErrorWeights>,
}

impl ArcOptions<'_> {
    /// Whether an option is set that other solvers do not have.
    pub fn are_set(&self) -> bool {
        !self.limits.is_empty() || self.closest_to.is_some()
    }
}

impl ArcQuestion {
    /// The question for `program`; `None` if it is not redundant.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for limits or joint values that are not those of the joints, and for options that a solver without redundancy does not have.
    pub fn new(program: &Program, angles: Angles, options: &ArcOptions<'_>) -> Result<Option<ArcQuestion>> {
        let Some(solver) = program.redundant_solver() else {
            if options.are_set() {
                let text = "--limits and --closest-to are for a redundant solver; this one has no joint more than its task determines";
                return Err(Error::new(ErrorKind::BadValue, text));
            }
            return Ok(None);
        };
        let mut bare = Program { redundancy: None, ..program.clone() };
        bare.inputs.pop();
        bare.given_joints.clear();
        let limits = options
            .limits
            .iter()
            .try_fold(solver.limits(), |limits, text| narrowed(&bare, &solver, limits, text, angles))?;
        let criterion = match options.closest_to {
            Some(text) => Criterion::nearest(joint_values(&bare, text, angles)?),
            None => Criterion::Margin,
        };
        let (forms, closest) = (Forms::new(&bare), options.closest);
        Ok(Some(ArcQuestion { forms, bare, solver, limits, criterion, closest, angles }))
    }

    /// The names of the target's numbers if they are `count`: a target without the value of a given joint.
    pub fn names(&self, count: usize) -> Option<Vec<&str>> {
        self.forms.names().into_iter().find(|names| names.len() == count)
    }

    /// The arcs of a target in one of the forms.
    ///
    /// # Errors
    /// As [`Forms::inputs`], [`RedundantSolver::target_of_numbers`], [`RedundantSolver::arcs`] and [`RedundantSolver::closest`].
    pub fn answer(&self, numbers: Vec<f64>) -> Result<ArcAnswer<'_>> {
        let given = self.forms.inputs(numbers)?;
        let target = self.solver.target_of_numbers(&self.angles.to_radians(&self.bare, &given))?;
        let arcs = self.solver.arcs(&target, &self.limits)?;
        let best = self.solver.best_on(&target, &self.limits, &arcs.arcs, &self.criterion)?;
        let search = |weights: &ErrorWeights| self.solver.closest(&target, &self.limits, weights);
        let closest = closest_beside(self.closest.as_ref().filter(|_| arcs.arcs.is_empty()), search)?;
        let closest = Answer::of_closest(&self.bare, closest, self.angles);
        Ok(ArcAnswer { question: self, target: given, arcs, best, closest })
    }
}

/// The closest joint values, if they are requested.
pub(super) fn closest_beside(
    weights: Option<&ErrorWeights>,
    search: impl FnOnce(&ErrorWeights) -> Result<Closest>,
) -> Result<Search> {
    weights.map_or(Ok(Search::Off), |weights| Ok(Search::Found(Box::new(search(weights)?))))
}

/// The value of a joint as it is given, in the unit of the program.
fn value(program: &Program, joint: usize, text: &str, angles: Angles) -> Result<f64> {
    let own = &program.joints[joint];
    let value: f64 = text.trim().parse().map_err(|_| {
        let text = format!("`{}` for {} is not a number", targets::shown(text), own.name);
        Error::new(ErrorKind::BadValue, text)
    })?;
    Ok(if own.unit == Unit::Radian && angles == Angles::Degrees { value.to_radians() } else { value })
}

/// The values of all joints in a text.
pub(super) fn joint_values(program: &Program, text: &str, angles: Angles) -> Result<Vec<f64>> {
    let cells: Vec<&str> = text.split(',').collect();
    if cells.len() != program.joints.len() {
        let names: Vec<&str> = program.joints.iter().map(|joint| joint.name.as_str()).collect();
        let text = format!("--closest-to has {} values; give {}: {}", cells.len(), names.len(), names.join(", "));
        return Err(Error::new(ErrorKind::BadValue, text));
    }
    cells.iter().enumerate().map(|(joint, cell)| value(program, joint, cell, angles)).collect()
}

/// `limits` narrowed to those in the text `JOINT=LOW,HIGH`.
fn narrowed(
    program: &Program,
    solver: &RedundantSolver,
    limits: JointLimits,
    text: &str,
    angles: Angles,
) -> Result<JointLimits> {
    let (joint, pair) = limits_of(program, text, angles)?;
    solver.narrowed(limits, joint, pair).map_err(|error| error.with_context("--limits"))
}

/// The joint and its limits in the text `JOINT=LOW,HIGH`.
pub(super) fn limits_of(program: &Program, text: &str, angles: Angles) -> Result<(usize, [f64; 2])> {
    let bad = |text: String| Error::new(ErrorKind::BadValue, text);
    let form = || bad(format!("--limits `{}`: give JOINT=LOW,HIGH", targets::shown(text)));
    let (name, pair) = text.rsplit_once('=').ok_or_else(form)?;
    let (low, high) = pair.split_once(',').ok_or_else(form)?;
    let place = program.joints.iter().position(|joint| joint.name == name);
    let joint = place.ok_or_else(|| {
        let names: Vec<&str> = program.joints.iter().map(|joint| joint.name.as_str()).collect();
        let text =
            format!("--limits: there is no joint `{}`; the joints are {}", targets::shown(name), names.join(", "));
        Error::new(ErrorKind::UnknownName, text)
    })?;
    Ok((joint, [value(program, joint, low, angles)?, value(program, joint, high, angles)?]))
}

/// The name of the solver and the target, as text.
pub(super) fn title(program: &Program, target: &[f64], angles: Angles) -> String {
    let target = program.inputs.iter().zip(target).map(|(input, value)| {
        let unit = angles.symbol(input.unit);
        format!("{} = {}{}{unit}", input.name, exact(*value), if unit.is_empty() { "" } else { " " })
    });
    format!("{} at {}", program.name, target.collect::<Vec<_>>().join(", "))
}

/// A table of joint values.
pub(super) fn joints_table(program: &Program, q: &[f64]) -> String {
    let header = program.joints.iter().map(|joint| joint.name.clone()).chain([String::new()]).collect();
    let cell = |(joint, value): (&groebot_ik::solver::Joint, &f64)| match joint.unit {
        Unit::Radian => format!("{:.6} deg ({value:.9} rad)", value.to_degrees()),
        unit => format!("{value:.9} {}", unit.symbol()).trim_end().to_owned(),
    };
    let row: Vec<String> = program.joints.iter().zip(q).map(cell).chain([String::new()]).collect();
    table(&[header, row])
}

/// The arcs of a target.
pub struct ArcAnswer<'a> {
    question: &'a ArcQuestion,
    /// The target as it was given.
    target: Vec<f64>,
    arcs: Arcs,
    best: Option<Best>,
    /// The closest joint values, if there is no arc.
    closest: Answer<'a>,
}

impl ArcAnswer<'_> {
    fn names(&self) -> Vec<&str> {
        self.question.bare.joints.iter().map(|joint| joint.name.as_str()).collect()
    }

    fn shown(&self, q: &[f64]) -> Vec<f64> {
        let angles = self.question.angles;
        self.question.bare.joints.iter().zip(q).map(|(joint, value)| angles.shown(joint, *value)).collect()
    }

    /// The reason why there is no solution within limits.
    fn reason(&self) -> Option<String> {
        self.arcs.absence.as_ref().map(|absence| absence.text(&self.names()))
    }

    /// One line for each arc, and a table of the best solution.
    pub fn text(&self) -> String {
        let (program, angles) = (&self.question.bare, self.question.angles);
        let title = title(program, &self.target, angles);
        let unsure = "  Unsure: other solutions within limits may exist.\n";
        if let Some(reason) = self.reason() {
            let doubt = if self.arcs.is_unsure { unsure } else { "" };
            return format!("{title}: no solution within limits: {reason}\n{doubt}{}", self.closest.closest_text());
        }
        let count = self.arcs.arcs.len();
        let plural = if count == 1 { "arc" } else { "arcs" };
        let mut text = format!("{title}: {count} {plural} of solutions within limits\n");
        let mut header = ["arc", "length", "end"].map(str::to_owned).to_vec();
        header.extend(program.joints.iter().map(|joint| format!("{} [{}]", joint.name, angles.symbol(joint.unit))));
        header.push(String::new());
        let mut rows = vec![header];
        for (number, arc) in self.arcs.arcs.iter().enumerate() {
            let ends = [("start", &arc.start), ("end", &arc.end)];
            let shown = if arc.is_closed { &ends[..1] } else { &ends[..] };
            for (place, (name, end)) in shown.iter().enumerate() {
                let first = [(number + 1).to_string(), format!("{:.6}", arc.length)];
                let mut row = if place == 0 { first.to_vec() } else { vec![String::new(); 2] };
                row.push(if arc.is_closed { "closed".to_owned() } else { (*name).to_owned() });
                row.extend(self.shown(&end.q).iter().map(|value| format!("{value:.6}")));
                row.push(self.notes(end, arc.is_unsure && place == 0));
                rows.push(row);
            }
        }
        text += &table(&rows);
        if self.arcs.is_surface {
            text += "  The solutions are a surface: the row is one of them.\n";
        }
        if self.arcs.is_unsure {
            text += unsure;
        }
        text + &self.best.as_ref().map(|best| self.best_text(best)).unwrap_or_default()
    }

    fn notes(&self, end: &ArcEnd, is_unsure: bool) -> String {
        let limit = end.limit_text(&self.names());
        let notes = [limit.as_str(), if is_unsure { "unsure" } else { "" }];
        notes.into_iter().filter(|note| !note.is_empty()).collect::<Vec<_>>().join(", ")
    }

    fn best_text(&self, best: &Best) -> String {
        let arc = format!(" on arc {}", best.arc + 1);
        let title = match self.question.criterion {
            Criterion::Margin => format!("largest margin to the limits{arc}: {:.6}", best.value),
            _ => format!("nearest solution{arc}: distance {:.6}", best.value),
        };
        format!("{title}\n{}", joints_table(&self.question.bare, &best.q))
    }

    /// One JSON object: on several lines when `pretty`, else on one.
    pub fn json(&self, pretty: bool) -> String {
        let (program, angles) = (&self.question.bare, self.question.angles);
        let names = self.names();
        let end = |end: &ArcEnd| EndEntry {
            q: self.shown(&end.q),
            joint: end.joint.map(|joint| names[joint]),
            limit: end.joint.map(|_| if end.is_upper { "upper" } else { "lower" }),
        };
        let page = Page {
            format: FORMAT,
            name: &program.name,
            target: &self.target,
            unit: Units::of(program, angles),
            joints: names.clone(),
            arcs: self
                .arcs
                .arcs
                .iter()
                .map(|arc| ArcEntry {
                    start: end(&arc.start),
                    end: end(&arc.end),
                    length: arc.length,
                    closed: arc.is_closed,
                    unsure: arc.is_unsure,
                })
                .collect(),
            best: self.best.as_ref().map(|best| BestEntry {
                q: self.shown(&best.q),
                criterion: self.question.criterion.name(),
                value: best.value,
                arc: best.arc + 1,
            }),
            surface: self.arcs.is_surface,
            grid_only: self.arcs.is_grid_only,
            unsure: self.arcs.is_unsure,
            reason: self.reason(),
            closest: self.closest.closest_entry(),
        };
        let text = if pretty { serde_json::to_string_pretty(&page) } else { serde_json::to_string(&page) };
        text.expect("an answer can be represented in JSON") + "\n"
    }
}

#[derive(Serialize)]
struct Page<'a> {
    format: u32,
    name: &'a str,
    target: &'a [f64],
    unit: Units<'a>,
    joints: Vec<&'a str>,
    /// All arcs of solutions within limits.
    arcs: Vec<ArcEntry<'a>>,
    /// The best solution within limits.
    best: Option<BestEntry>,
    /// Whether the solutions are a surface: the arc is then one solution.
    surface: bool,
    /// Whether closed curves that reach no limit were searched by a grid only.
    grid_only: bool,
    /// Whether other solutions within limits may exist.
    unsure: bool,
    /// The reason why there is no solution within limits.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    /// The closest joint values, if they were requested and there is no arc.
    #[serde(skip_serializing_if = "Option::is_none")]
    closest: Option<ClosestEntry<'a>>,
}

/// The unit of each number of the target and of each joint.
#[derive(Serialize)]
pub(super) struct Units<'a> {
    target: Vec<&'a str>,
    joints: Vec<&'a str>,
}

impl<'a> Units<'a> {
    pub fn of(program: &'a Program, angles: Angles) -> Self {
        Units {
            target: program.inputs.iter().map(|input| angles.symbol(input.unit)).collect(),
            joints: program.joints.iter().map(|joint| angles.symbol(joint.unit)).collect(),
        }
    }
}

#[derive(Serialize)]
struct ArcEntry<'a> {
    start: EndEntry<'a>,
    end: EndEntry<'a>,
    length: f64,
    closed: bool,
    unsure: bool,
}

#[derive(Serialize)]
struct EndEntry<'a> {
    q: Vec<f64>,
    /// The joint that is at its limit.
    joint: Option<&'a str>,
    /// `lower` or `upper`.
    limit: Option<&'a str>,
}

#[derive(Serialize)]
struct BestEntry {
    q: Vec<f64>,
    criterion: &'static str,
    value: f64,
    /// The number of its arc, counted from 1.
    arc: usize,
}
