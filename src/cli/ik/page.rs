//! The output of `groebot ik`: a text table, JSON, or CSV.

use serde::Serialize;
use serde_json::Value;

use super::NUMERIC;
use crate::cli::cells::{csv_line, exact, fixed, table};
use crate::cli::columns::{Field, heading, of_joints};
use crate::cli::ends::TipLink;
use crate::cli::following::{followers, leaders};
use crate::cli::json::{FORMAT, given};
use crate::cli::targets;
use groebot_ik::derive::planner::Choice;
use groebot_robot::kinematics::{Chain, Joint, JointKind, Mimic, Placed, Quantity, Solution, Target};

/// The properties that all targets share.
pub struct Question<'a> {
    /// The chain.
    pub chain: &'a Chain,
    /// The name of the method in JSON.
    pub method: &'static str,
    /// The last link, for a robot.
    pub tip: Option<TipLink>,
    /// The joints that the planner gives.
    pub choice: Option<&'a Choice>,
    /// The ignored parts of the robot.
    pub notes: &'a [String],
    /// Whether angles are in degrees, in targets, in JSON and in tables.
    pub degrees: bool,
}

/// The solutions of a target.
pub struct Page<'a> {
    /// The shared properties.
    pub question: &'a Question<'a>,
    /// The target as it was given.
    pub text: &'a str,
    /// The target.
    pub target: &'a Target,
    /// The values of the given joints.
    pub given: &'a [f64],
    /// The solutions after [`turned`].
    pub answers: &'a [Solution],
}

/// Moves each angle into its joint's limits by whole turns, where that is possible; given joints stay unchanged.
pub fn turned(chain: &Chain, answers: &mut [Solution]) {
    let given = chain.given();
    let turns = |(place, joint): &(usize, &Joint)| joint.kind == JointKind::Revolute && !given.contains(place);
    for (place, joint) in chain.joints().iter().enumerate().filter(turns) {
        answers.iter_mut().for_each(|answer| answer.q[place] = Placed::turned(answer.q[place], joint.limits).value);
    }
}

impl Page<'_> {
    /// The solutions as text.
    pub fn table(&self) -> String {
        let Page { question: Question { chain, method, .. }, answers, .. } = self;
        let title = format!("{} at {}", chain.name(), targets::shown(self.text));
        let unit = chain.length_unit().symbol();
        let is_numeric = *method == NUMERIC;
        if answers.is_empty() {
            let why = if is_numeric { "the search found none; there may be some" } else { "out of reach:" };
            return format!("{title}: {why} no solution\n");
        }
        let plural = if answers.len() == 1 { "solution" } else { "solutions" };
        let how = if is_numeric { ", found by search; there may be others" } else { "" };
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
                JointKind::Revolute => fixed(value.to_degrees(), 6),
                JointKind::Prismatic => fixed(*value, 9),
            }));
            row.extend(self.target.missed(chain, &answer.q).map(|miss| format!("{miss:.1e}")));
            row.push(notes(chain, answer));
            rows.push(row);
        }
        let followers = followers(names(chain).into_iter().zip(follows(chain)));
        format!("{title}: {} {plural}{how}\n{}{followers}", answers.len(), table(&rows))
    }

    /// One JSON object: on several lines when `pretty`, else on one.
    pub fn json(&self, pretty: bool) -> String {
        let Question { chain, method, tip, choice, notes, .. } = self.question;
        let object = Object {
            format: FORMAT,
            name: chain.name(),
            method,
            tip_link: tip.as_ref(),
            given: choice.map(given),
            target: self.text,
            joints: names(chain),
            mimics: leaders(follows(chain)),
            unit: chain.joints().iter().map(|joint| self.question.unit(joint)).collect(),
            solutions: self.answers.iter().map(|answer| self.entry(answer)).collect(),
            notes,
        };
        let text = if pretty { serde_json::to_string_pretty(&object) } else { serde_json::to_string(&object) };
        text.expect("an answer can be represented in JSON") + "\n"
    }

    fn entry(&self, answer: &Solution) -> Entry<'_> {
        let chain = self.question.chain;
        let [position_residual, rotation_residual] = self.target.missed(chain, &answer.q);
        Entry {
            q: self.question.shown(&answer.q),
            free: free(chain, answer),
            outside_limits: outside(chain, answer),
            position_residual,
            rotation_residual,
            branch: answer.branch,
        }
    }

    /// The rows of a table: one per solution; a target without one has a row with 0 solutions and empty cells. `index`
    /// counts targets from 1.
    pub fn csv(&self, index: usize) -> String {
        let chain = self.question.chain;
        let mut start = vec![index.to_string()];
        start.extend(self.target_numbers().into_iter().map(exact));
        start.push(self.answers.len().to_string());
        if self.answers.is_empty() {
            start.extend(vec![String::new(); chain.joints().len() + 5]);
            return csv_line(&start);
        }
        let row = |answer: &Solution| {
            let entry = self.entry(answer);
            let mut cells = start.clone();
            cells.push(entry.branch.to_string());
            cells.extend(entry.q.into_iter().map(exact));
            cells.extend([entry.position_residual, entry.rotation_residual].map(|residual| format!("{residual:e}")));
            cells.extend([entry.free.join(" "), entry.outside_limits.join(" ")]);
            csv_line(&cells)
        };
        self.answers.iter().map(row).collect()
    }

    /// The numbers of the target, then the values of the given joints, angles in the output unit.
    fn target_numbers(&self) -> Vec<f64> {
        let Question { chain, degrees, .. } = self.question;
        let layout = chain.task().layout();
        let is_angle = layout.numbers().iter().map(|number| number.quantity() == Quantity::Angle);
        let shown = |(value, is_angle): (f64, bool)| if is_angle && *degrees { value.to_degrees() } else { value };
        let own = layout.values(self.target).expect("the target is of the chain's task").into_iter().zip(is_angle);
        let turns = chain.given_inputs().into_iter().map(|joint| chain.joints()[joint].kind == JointKind::Revolute);
        own.chain(self.given.iter().copied().zip(turns)).map(shown).collect()
    }
}

impl Question<'_> {
    fn unit(&self, joint: &Joint) -> &'static str {
        match (joint.kind, self.degrees) {
            (JointKind::Revolute, true) => "deg",
            (JointKind::Revolute, false) => "rad",
            (JointKind::Prismatic, _) => self.chain.length_unit().symbol(),
        }
    }

    fn shown(&self, q: &[f64]) -> Vec<f64> {
        let value = |(joint, value): (&Joint, &f64)| {
            if joint.kind == JointKind::Revolute && self.degrees { value.to_degrees() } else { *value }
        };
        self.chain.joints().iter().zip(q).map(value).collect()
    }

    /// The names of the columns of a table.
    pub fn csv_header(&self) -> String {
        let of = |field: &Field| heading(&field.name, field.quantity == Quantity::Angle, self.degrees);
        let joints = of_joints(self.chain.joints());
        let mut cells = vec!["target".to_owned()];
        cells.extend(self.chain.task().layout().numbers().iter().map(|number| of(&Field::of_target(*number))));
        cells.extend(self.chain.given_inputs().into_iter().map(|joint| of(&joints[joint])));
        cells.extend(["solutions", "branch"].map(str::to_owned));
        cells.extend(joints.iter().map(of));
        cells.extend(["position_residual", "rotation_residual", "free", "outside_limits"].map(str::to_owned));
        csv_line(&cells)
    }
}

fn names(chain: &Chain) -> Vec<&str> {
    chain.joints().iter().map(|joint| joint.name.as_str()).collect()
}

/// The leader of each mimic joint.
fn follows(chain: &Chain) -> impl Iterator<Item = Option<&Mimic>> {
    chain.joints().iter().map(|joint| joint.mimic.as_ref())
}

/// The joints that may have any value.
fn free<'c>(chain: &'c Chain, answer: &Solution) -> Vec<&'c str> {
    answer.free.iter().map(|&joint| chain.joints()[joint].name.as_str()).collect()
}

/// The joints that are outside their limits, also after adding whole turns.
fn outside<'c>(chain: &'c Chain, answer: &Solution) -> Vec<&'c str> {
    let joints = chain.joints().iter().zip(&answer.q).enumerate();
    let is_outside = |(place, (joint, value)): &(usize, (&Joint, &f64))| {
        !answer.free.contains(place) && !Placed::fixed(**value, joint.limits).is_within
    };
    joints.filter(is_outside).map(|(_, (joint, _))| joint.name.as_str()).collect()
}

/// Notes about free joints and joints outside their limits.
fn notes(chain: &Chain, answer: &Solution) -> String {
    let free = free(chain, answer).into_iter().map(|name| format!("{name} is free"));
    let outside = outside(chain, answer).into_iter().map(|name| format!("{name} outside its limits"));
    free.chain(outside).collect::<Vec<_>>().join(", ")
}

#[derive(Serialize)]
struct Object<'a> {
    format: u32,
    name: &'a str,
    /// The method of solution.
    method: &'a str,
    /// The last link of a robot's chain.
    #[serde(skip_serializing_if = "Option::is_none")]
    tip_link: Option<&'a TipLink>,
    /// The joints that the planner gives, and other possible choices.
    #[serde(skip_serializing_if = "Option::is_none")]
    given: Option<Value>,
    target: &'a str,
    joints: Vec<&'a str>,
    /// The leader of each mimic joint.
    #[serde(skip_serializing_if = "Option::is_none")]
    mimics: Option<Vec<Option<&'a str>>>,
    unit: Vec<&'a str>,
    solutions: Vec<Entry<'a>>,
    /// The ignored parts of the robot.
    #[serde(skip_serializing_if = "<[String]>::is_empty")]
    notes: &'a [String],
}

#[derive(Serialize)]
struct Entry<'a> {
    q: Vec<f64>,
    /// Names of the joints that may have any value.
    free: Vec<&'a str>,
    /// Names of the joints that are outside their limits, also after adding whole turns.
    outside_limits: Vec<&'a str>,
    position_residual: f64,
    rotation_residual: f64,
    branch: usize,
}
