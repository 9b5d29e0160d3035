//! Output of `groebot solve` for an arm with scanned joints: the best solution within limits of the samples.

use serde::Serialize;

use super::answers::{Angles, Answer, ClosestEntry};
use super::arcs::{ArcOptions, Units, closest_beside, joint_values, joints_table, limits_of, title};
use super::forms::Forms;
use super::json::FORMAT;
use crate::{Error, ErrorKind, Result};
use groebot_ik::solver::redundant::{Criterion, Scanned, ScanningSolver};
use groebot_ik::solver::{ErrorWeights, Program};

/// A solver with scanned joints and the options of the command.
pub struct ScanQuestion {
    /// The program without the inputs of its given joints.
    bare: Program,
    solver: ScanningSolver,
    forms: Forms,
    limits: Vec<[f64; 2]>,
    criterion: Criterion,
    closest: Option<ErrorWeights>,
    angles: Angles,
}

impl ScanQuestion {
    /// The question for `program`; `None` if no joint is scanned.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] and [`ErrorKind::UnknownName`] for limits or joint values that are not those of the joints.
    pub fn new(program: &Program, angles: Angles, options: &ArcOptions<'_>) -> Result<Option<ScanQuestion>> {
        let Some(solver) = program.scanning_solver() else { return Ok(None) };
        let mut bare = Program { redundancy: None, ..program.clone() };
        bare.inputs.truncate(program.inputs.len() - program.given_joints.len());
        bare.given_joints.clear();
        let mut limits = solver.limits();
        for text in options.limits {
            let (joint, [low, high]) = limits_of(&bare, text, angles)?;
            let [least, greatest] = limits[joint];
            limits[joint] = [low.max(least), high.min(greatest)];
            if low.is_nan() || high.is_nan() || limits[joint][0] > limits[joint][1] {
                let name = &bare.joints[joint].name;
                let text =
                    format!("--limits: those of `{name}` are {low} and {high}; only {least} to {greatest} is allowed");
                return Err(Error::new(ErrorKind::BadValue, text));
            }
        }
        let criterion = match options.closest_to {
            Some(text) => Criterion::nearest(joint_values(&bare, text, angles)?),
            None => Criterion::Margin,
        };
        let closest = options.closest;
        Ok(Some(ScanQuestion { forms: Forms::new(&bare), bare, solver, limits, criterion, closest, angles }))
    }

    /// The names of the target's numbers if they are `count`: a target without the values of given joints.
    pub fn names(&self, count: usize) -> Option<Vec<&str>> {
        self.forms.names().into_iter().find(|names| names.len() == count)
    }

    /// The best solution of a target in one of the forms.
    ///
    /// # Errors
    /// As [`Forms::inputs`], [`ScanningSolver::target`], [`ScanningSolver::best`] and [`ScanningSolver::closest`].
    pub fn answer(&self, numbers: Vec<f64>) -> Result<ScanAnswer<'_>> {
        let target = self.forms.inputs(numbers)?;
        let own = self.solver.target_of_numbers(&self.angles.to_radians(&self.bare, &target))?;
        let found = self.solver.best(&own, Some(&self.limits), &self.criterion)?;
        let search = |weights: &ErrorWeights| self.solver.closest(&own, Some(&self.limits), weights);
        let closest = closest_beside(self.closest.as_ref().filter(|_| found.q.is_none()), search)?;
        let closest = Answer::of_closest(&self.bare, closest, self.angles);
        Ok(ScanAnswer { question: self, target, found, closest })
    }

    fn scanned(&self) -> Vec<&str> {
        self.solver.scanned().iter().map(|&joint| self.bare.joints[joint].name.as_str()).collect()
    }
}

/// The best solution of a target.
pub struct ScanAnswer<'a> {
    question: &'a ScanQuestion,
    /// The target as it was given.
    target: Vec<f64>,
    found: Scanned,
    /// The closest joint values, if there is no solution.
    closest: Answer<'a>,
}

impl ScanAnswer<'_> {
    /// The reason why no sample has a solution within limits.
    fn reason(&self) -> Option<String> {
        let names: Vec<&str> = self.question.bare.joints.iter().map(|joint| joint.name.as_str()).collect();
        self.found.absence.as_ref().map(|absence| absence.text(&names))
    }

    /// A table of the solution, or the reason why there is none.
    pub fn text(&self) -> String {
        let ScanQuestion { bare, angles, criterion, .. } = self.question;
        let title = title(bare, &self.target, *angles);
        let note = format!(
            "  Samples of {}: narrow ranges of solutions may be missing.\n",
            self.question.scanned().join(", ")
        );
        let (Some(q), Some(value)) = (&self.found.q, self.found.value) else {
            let (reason, closest) = (self.reason().unwrap_or_default(), self.closest.closest_text());
            return format!("{title}: no solution within limits: {reason}\n{note}{closest}");
        };
        let what = match criterion {
            Criterion::Margin => format!("largest margin to the limits: {value:.6}"),
            _ => format!("nearest solution: distance {value:.6}"),
        };
        format!("{title}: a solution within limits\n{what}\n{}{note}", joints_table(bare, q))
    }

    /// One JSON object: on several lines when `pretty`, else on one.
    pub fn json(&self, pretty: bool) -> String {
        let ScanQuestion { bare, angles, criterion, .. } = self.question;
        let shown =
            |q: &Vec<f64>| bare.joints.iter().zip(q).map(|(joint, value)| angles.shown(joint, *value)).collect();
        let page = Page {
            format: FORMAT,
            name: &bare.name,
            target: &self.target,
            unit: Units::of(bare, *angles),
            joints: bare.joints.iter().map(|joint| joint.name.as_str()).collect(),
            scanned: self.question.scanned(),
            best: self.found.q.as_ref().map(|q| BestEntry {
                q: shown(q),
                criterion: criterion.name(),
                value: self.found.value,
            }),
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
    /// The joints whose ranges are sampled.
    scanned: Vec<&'a str>,
    /// The best solution within limits.
    best: Option<BestEntry>,
    /// The reason why no sample has a solution within limits.
    #[serde(skip_serializing_if = "Option::is_none")]
    reason: Option<String>,
    /// The closest joint values, if they were requested and there is no solution.
    #[serde(skip_serializing_if = "Option::is_none")]
    closest: Option<ClosestEntry<'a>>,
}

#[derive(Serialize)]
struct BestEntry {
    q: Vec<f64>,
    criterion: &'static str,
    value: Option<f64>,
}
