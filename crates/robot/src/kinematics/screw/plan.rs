//! The order of subproblems that solves a chain, described in words as in RH0 A.1, A.2 and 3.4.2.

use std::fmt;

use super::feature::{Feature, FixedPoint, Line, Scale, direction};
use super::reduced::{Goal, Member, Reduced};
use super::step::{Kind, Relation, Step};
use crate::spatial::line;
use crate::spatial::{Relation as Lines, Screw};

/// The canonical subproblem of a step.
#[non_exhaustive]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subproblem {
    /// Rotation about one axis to a point, RH0 (2-28).
    PadenKahan1,
    /// Two rotations about intersecting axes to a point, RH0 (2-30).
    PadenKahan2,
    /// Rotation to a distance from a point, RH0 (2-32).
    PadenKahan3,
    /// Translation to a distance from a point, RH0 (2-34); PG3.
    PardosOne,
    /// Translation to a plane.
    Pardos1,
    /// Two translations to a point.
    Pardos2,
    /// Two rotations about parallel axes to a point.
    Pardos4,
    /// Rotation to a plane; IK-Geo's circle and plane.
    Pardos5,
    /// Two rotations about skew axes to a point.
    Pardos6,
    /// A rotation and two rotations about parallel axes, to a point.
    Pardos7,
    /// Three rotations about parallel axes to a pose: PG4 and the remaining angle.
    Pardos8,
    /// Translation to a point.
    Translation,
    /// A rotation and a translation, in either order, to a point.
    RotationAndTranslation,
    /// Three joints to a point: IK-Geo's three circles, possibly with translations.
    ThreeCircles,
    /// Two equations in two angles: IK-Geo's four circles.
    FourCircles,
    /// Three rotations to a plane, the dual of three circles.
    ThreeToPlane,
    /// Six joints in three parallel pairs.
    ThreePairs,
}

/// One step of a [`Plan`].
#[derive(Clone, Debug, PartialEq)]
pub struct PlanStep {
    /// The indices of the joints that it solves, from 0.
    pub joints: Vec<usize>,
    /// The subproblem.
    pub subproblem: Subproblem,
    /// Maximum number of solutions.
    pub answers: usize,
    /// Text: what cancels and what remains.
    pub text: String,
}

/// An order of subproblems that solves a chain.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Plan {
    /// The steps in their order.
    pub steps: Vec<PlanStep>,
}

impl Plan {
    /// The maximum number of solutions of all steps together.
    pub fn most_solutions(&self) -> usize {
        self.steps.iter().map(|step| step.answers).product()
    }
}

impl Subproblem {
    /// The short name: `PK1`, `Pardos-One`, `PG4`, `SP6` ...
    pub fn name(self) -> &'static str {
        match self {
            Subproblem::PadenKahan1 => "PK1",
            Subproblem::PadenKahan2 => "PK2",
            Subproblem::PadenKahan3 => "PK3",
            Subproblem::PardosOne => "Pardos-One",
            Subproblem::Pardos1 => "PG1",
            Subproblem::Pardos2 => "PG2",
            Subproblem::Pardos4 => "PG4",
            Subproblem::Pardos5 => "PG5",
            Subproblem::Pardos6 => "PG6",
            Subproblem::Pardos7 => "PG7",
            Subproblem::Pardos8 => "PG8",
            Subproblem::Translation => "translation",
            Subproblem::RotationAndTranslation => "rotation and translation",
            Subproblem::ThreeCircles => "SP5",
            Subproblem::FourCircles => "SP6",
            Subproblem::ThreeToPlane => "three rotations to a plane",
            Subproblem::ThreePairs => "three parallel pairs",
        }
    }
}

impl fmt::Display for Plan {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (number, step) in self.steps.iter().enumerate() {
            let thetas: Vec<String> = step.joints.iter().map(|joint| format!("theta{}", joint + 1)).collect();
            let answers = if step.answers == 1 { "1 value".to_owned() } else { format!("{} values", step.answers) };
            let (name, thetas) = (step.subproblem.name(), thetas.join(", "));
            writeln!(f, "{}. {}: {name} for {thetas} ({answers})", number + 1, step.text)?;
        }
        let factors: Vec<String> = self.steps.iter().map(|step| step.answers.to_string()).collect();
        let product = if factors.len() > 1 { format!("{} = ", factors.join(" x ")) } else { String::new() };
        let most = self.most_solutions();
        write!(f, "at most {product}{most} {}", if most == 1 { "solution" } else { "solutions" })
    }
}

/// Describes the step. `reduced` is its loop at a sample.
pub(super) fn describe(step: &Step, reduced: &Reduced, answers: usize, scale: Scale) -> PlanStep {
    let row = reduced.cut_at(step.end);
    let (rest, tail) = row.split_at(row.len() - step.tail);
    let solved: Vec<&Screw> = step.unknown.iter().map(|&place| &row[place].screw).collect();
    let (subproblem, text) = match &step.kind {
        Kind::ToPoint(spot) => (to_point(&solved, reduced, scale), format!("{} to its place", say_spot(*spot, tail))),
        Kind::ToDirection(line) => {
            let name = if solved.len() == 1 { Subproblem::PadenKahan1 } else { Subproblem::PadenKahan2 };
            (name, format!("the direction of {} to its place", say_line(*line, tail)))
        }
        Kind::ToPlane(line) => {
            (Subproblem::ThreeToPlane, format!("a plane normal to {} to its place", say_line(*line, tail)))
        }
        Kind::ThreePairs => {
            let text = "the orientation gives the sum of each pair, the position three arms of a known sum".to_owned();
            (Subproblem::ThreePairs, text)
        }
        Kind::Last => {
            let turns = solved[0].axis().is_some();
            let name = if turns { Subproblem::PadenKahan1 } else { Subproblem::Translation };
            (name, format!("a point beside axis {} to its place", row[0].joint + 1))
        }
        Kind::Between(relation) => (between(relation, solved[0]), compare(relation, rest, tail)),
        Kind::Around([first, second]) => {
            let text = format!("{}, and {}", compare(first, rest, tail), compare(second, rest, tail));
            (Subproblem::FourCircles, text)
        }
    };
    let joints = step.unknown.iter().map(|&place| row[place].joint).collect();
    PlanStep { joints, subproblem, answers, text }
}

/// The subproblem that moves a point by these screws.
fn to_point(screws: &[&Screw], reduced: &Reduced, scale: Scale) -> Subproblem {
    let axes: Vec<_> = screws.iter().filter_map(|screw| screw.axis()).collect();
    match (screws.len(), &axes[..]) {
        (1, []) => Subproblem::Translation,
        (1, _) => Subproblem::PadenKahan1,
        (2, []) => Subproblem::Pardos2,
        (2, [_]) => Subproblem::RotationAndTranslation,
        (2, [a, b, ..]) => match a.relation(b, scale.tolerance) {
            Lines::Coincident | Lines::Parallel { .. } if is_parallel_pose(reduced) => Subproblem::Pardos8,
            Lines::Coincident | Lines::Parallel { .. } => Subproblem::Pardos4,
            Lines::Intersecting { .. } => Subproblem::PadenKahan2,
            Lines::Skew { .. } => Subproblem::Pardos6,
        },
        (_, [a, b, c]) if a.is_parallel(b) != b.is_parallel(c) => Subproblem::Pardos7,
        _ => Subproblem::ThreeCircles,
    }
}

/// Whether three parallel joints remain for a pose.
fn is_parallel_pose(reduced: &Reduced) -> bool {
    let [a, b, c] = &reduced.row[..] else { return false };
    let parallel = |x: &Member, y: &Member| direction(&x.screw).cross(&direction(&y.screw)).norm() <= line::PARALLEL;
    matches!(reduced.goal, Goal::Pose(_)) && parallel(a, b) && parallel(b, c)
}

fn between(relation: &Relation, screw: &Screw) -> Subproblem {
    match (screw.axis().is_some(), relation.run, relation.tail) {
        (true, Feature::Point(_), Feature::Point(_)) => Subproblem::PadenKahan3,
        (false, Feature::Point(_), Feature::Point(_)) => Subproblem::PardosOne,
        (true, _, _) => Subproblem::Pardos5,
        (false, _, _) => Subproblem::Pardos1,
    }
}

/// `the distance of A from B`, `the component of A along B`, `the angle between A and B`.
fn compare(relation: &Relation, rest: &[Member], tail: &[Member]) -> String {
    let run = &rest[relation.start..relation.start + relation.length];
    match (relation.run, relation.tail) {
        (Feature::Point(a), Feature::Point(b)) => {
            format!("the distance of {} from {}", say_spot(b, tail), say_spot(a, run))
        }
        (Feature::Component(line), Feature::Point(spot)) => {
            format!("the component of {} along {}", say_spot(spot, tail), say_line(line, run))
        }
        (Feature::Point(spot), Feature::Component(line)) => {
            format!("the component of {} along {}", say_spot(spot, run), say_line(line, tail))
        }
        (Feature::Direction(a), Feature::Direction(b)) => {
            format!("the angle between {} and {}", say_line(b, tail), say_line(a, run))
        }
        // Other pairs do not occur.
        _ => String::new(),
    }
}

fn say_spot(spot: FixedPoint, row: &[Member]) -> String {
    match (spot, row) {
        (FixedPoint::Tip, _) => "the tip".to_owned(),
        (_, [one]) => format!("a point of axis {}", one.joint + 1),
        _ => format!("the point where axes {} meet", numbers(row)),
    }
}

fn say_line(line: Line, row: &[Member]) -> String {
    let turning: Vec<Member> = row.iter().filter(|member| member.screw.axis().is_some()).copied().collect();
    match (line, &turning[..]) {
        (Line::Along(_), [one]) => format!("axis {}", one.joint + 1),
        (Line::Along(i), []) => format!("axis {}", row[i].joint + 1),
        (Line::Along(_), _) => format!("the parallel axes {}", numbers(&turning)),
        (Line::Normal(..), _) => format!("the normal of axes {}", numbers(row)),
        (Line::Across(i, _), _) => format!("a normal of axis {}", row[i].joint + 1),
    }
}

/// `1, 2, 3`.
fn numbers(row: &[Member]) -> String {
    let mut joints: Vec<usize> = row.iter().map(|member| member.joint + 1).collect();
    joints.sort_unstable();
    joints.iter().map(usize::to_string).collect::<Vec<_>>().join(", ")
}
