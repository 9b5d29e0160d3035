//! The data of a redundant solver in its program: [`Redundancy`].

use serde::{Deserialize, Serialize};

use crate::eigenvalue::Line;
use crate::{Error, ErrorKind, Result};
use crate::{Program, Unit};
use groebot_runtime::tolerances::ACCEPTANCE;

/// The maximum number of scanned joints.
pub const MOST_SCANNED: usize = 3;
/// The maximum number of sections.
pub use groebot_runtime::redundant::MOST_SECTIONS;

/// The programs of a redundant chain, one for each joint as the given one, and its axes as described. Each part has the values of scanned joints as inputs, too.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Redundancy {
    /// By joint, its axis at zero joint values, in the base frame and in the unit of the target. The point of a prismatic joint is arbitrary.
    pub lines: Vec<Line>,
    /// The position of the tip at zero joint values, in the base frame and in the unit of the target.
    pub position: [f64; 3],
    /// The rotation of the tip at zero joint values, by rows, in the base frame.
    pub rotation: [[f64; 3]; 3],
    /// By joint, the least and the greatest value in the joint's unit, if it has limits.
    pub limits: Vec<Option<[f64; 2]>>,
    /// By joint, the program with this joint given.
    pub parts: Vec<RedundantPart>,
    /// Where closed curves of solutions are searched. Missing with scanned joints, and in older files: then at values of the main joint.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub closed: Option<ClosedSearch>,
}

/// Where closed curves of solutions are searched that reach no limit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ClosedSearch {
    /// The joint whose values are a grid.
    pub grid: usize,
    /// Values of joints that short closed curves pass, at most [`MOST_SECTIONS`].
    pub sections: Vec<Section>,
}

/// A value of a joint: rad, or the length unit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Section {
    /// The index of the joint.
    pub joint: usize,
    /// Its value.
    pub value: f64,
}

/// The program of a redundant chain with one joint given.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum RedundantPart {
    /// The program that has the redundancy.
    Main,
    /// Another program.
    Program(Box<Program>),
    /// The target determines the joint: it is constant on every self-motion and is only compared with its limits.
    Constant,
    /// The range of the joint is scanned: its value is given to all programs.
    Scanned,
    /// There is no program, for this reason.
    Unsolved(String),
}

impl Redundancy {
    /// By joint, the least and the greatest value; infinite without limits.
    pub fn limit_pairs(&self) -> Vec<[f64; 2]> {
        self.limits.iter().map(|limits| limits.unwrap_or([f64::NEG_INFINITY, f64::INFINITY])).collect()
    }

    /// Checks the redundancy of `main`.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] with the wrong part.
    pub(crate) fn validate(&self, main: &Program) -> Result<()> {
        let count = main.joints.len();
        let scanned = self.scanned();
        let determines = main.tip().is_some_and(|tip| count == tip.task.freedoms() + 1 + scanned.len());
        ensure(determines, "one tip is allowed, whose task determines all joints but one that are not scanned")?;
        ensure(scanned.len() <= MOST_SCANNED, "at most three joints are scanned")?;
        let sizes = [self.lines.len(), self.limits.len(), self.parts.len()];
        ensure(sizes == [count; 3], "one line, one pair of limits and one part per joint")?;
        let numbers = self.lines.iter().flat_map(|line| line.direction.iter().chain(&line.point));
        let numbers = numbers.chain(&self.position).chain(self.rotation.as_flattened());
        ensure(numbers.clone().all(|number| number.is_finite()), "only finite numbers are allowed")?;
        let is_unit = |row: &[f64; 3]| (dot(row, row) - 1.0).abs() <= ACCEPTANCE.input;
        ensure(self.lines.iter().all(|line| is_unit(&line.direction)), "a direction is not of length one")?;
        let [x, y, z] = &self.rotation;
        let is_rotation = [x, y, z].into_iter().all(is_unit)
            && [(x, y), (y, z), (z, x)].iter().all(|(a, b)| dot(a, b).abs() <= ACCEPTANCE.input);
        ensure(is_rotation, "the rotation of the tip is not a rotation")?;
        let are_ordered = self.limits.iter().flatten().all(|[low, high]| low <= high);
        ensure(are_ordered, "limits: the least, then the greatest value")?;
        self.parts.iter().enumerate().try_for_each(|(joint, part)| match part {
            RedundantPart::Main => ensure(self.gives(main, joint), "the main part is not that of the given joint"),
            RedundantPart::Program(other) => {
                ensure(!self.gives(main, joint) && self.gives(other, joint), "a part is not that of its joint")?;
                ensure(is_alike(main, other), "a part has another task, other joints or its own redundancy")?;
                other.validate().map_err(|error| error.with_context(format!("{} given", main.joints[joint].name)))
            }
            RedundantPart::Constant | RedundantPart::Unsolved(_) => {
                ensure(!self.gives(main, joint), "the given joint has no program")
            }
            RedundantPart::Scanned => Ok(()),
        })?;
        self.closed.as_ref().map_or(Ok(()), |closed| self.validate_closed(closed))
    }

    fn validate_closed(&self, closed: &ClosedSearch) -> Result<()> {
        let is_solved =
            |joint: usize| matches!(self.parts.get(joint), Some(RedundantPart::Main | RedundantPart::Program(_)));
        let is_known = is_solved(closed.grid) && closed.sections.iter().all(|section| is_solved(section.joint));
        ensure(is_known && self.scanned().is_empty(), "closed curves are searched at values of joints with a program")?;
        let is_finite = closed.sections.iter().all(|section| section.value.is_finite());
        ensure(is_finite && closed.sections.len() <= MOST_SECTIONS, "at most eight sections with finite values")
    }

    /// The indices of the joints that are scanned.
    pub fn scanned(&self) -> Vec<usize> {
        (0..self.parts.len()).filter(|&joint| self.parts[joint] == RedundantPart::Scanned).collect()
    }

    /// Whether `joint` is the only given joint of `program` apart from the scanned ones, and their values are the last inputs, from base to tip.
    fn gives(&self, program: &Program, joint: usize) -> bool {
        let mut wanted = self.scanned();
        wanted.push(joint);
        wanted.sort_unstable();
        wanted.dedup();
        let first = program.inputs.len().checked_sub(wanted.len());
        let given = program.given_joints.iter().map(|given| (given.joint, Some(given.input)));
        given.eq(wanted.iter().enumerate().map(|(k, joint)| (*joint, first.map(|first| first + k))))
    }
}

fn dot(a: &[f64; 3], b: &[f64; 3]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// Whether two programs have the same joints, the same numbers of the target and the same length unit.
fn is_alike(main: &Program, other: &Program) -> bool {
    let target = |program: &Program| -> Vec<Unit> {
        program
            .inputs
            .iter()
            .take(program.inputs.len().saturating_sub(program.given_joints.len()))
            .map(|input| input.unit)
            .collect()
    };
    let joints = |program: &Program| -> Vec<(String, Unit)> {
        program.joints.iter().map(|joint| (joint.name.clone(), joint.unit)).collect()
    };
    other.redundancy.is_none()
        && main.tasks == other.tasks
        && target(main) == target(other)
        && joints(main) == joints(other)
}

fn ensure(condition: bool, text: &str) -> Result<()> {
    let error = || Error::new(ErrorKind::BadValue, format!("malformed program: redundancy: {text}"));
    if condition { Ok(()) } else { Err(error()) }
}
