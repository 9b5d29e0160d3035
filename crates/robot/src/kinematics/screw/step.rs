//! One step of a plan: an equation in which one, two or three unknown joints remain and the others cancel, and its
//! subproblem.
//!
//! The loop is cut so that its last joints, the *tail*, leave an object b fixed. The joints before them are the *rest*.
//! Either the rest moves b to its position `T b`. Or a run of joints in the rest leaves an object a fixed and cancels
//! too: then the distance (component, angle) between a and b determines the joint between them, or the joint before
//! both.

use nalgebra::{Point3, Unit, Vector3};

use super::circles::four_circles;
use super::feature::{Feature, FixedPoint, Line, Object};
use super::one_joint::{
    rotate_to_distance, rotate_to_plane, rotate_to_point, translate_to_distance, translate_to_plane, translate_to_point,
};
use super::parallel_pairs;
use super::planes::carry_plane;
use super::reduced::{Goal, Member, Reduced};
use super::three_joints::three_screws_to_point;
use super::two_joints::two_screws_to_point;
use super::values::{Reach, Values};
use crate::spatial::{Axis, Pose, Screw, angle};

use smallvec::SmallVec;

/// Values for the joints of a step, in the order of [`Step::solved`]; `None` when every value is a solution.
pub(super) type Answer = [Option<f64>; 6];
pub(super) type Answers = SmallVec<[Answer; 2]>;

/// The first entries of an answer, which has more entries than most steps have joints.
fn answer<const N: usize>(values: [Option<f64>; N]) -> Answer {
    std::array::from_fn(|i| values.get(i).copied().flatten())
}

/// Position of the cut, and the equations solved there.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Step {
    /// The tail ends before this index of the reduced row.
    pub end: usize,
    /// Number of joints of the tail.
    pub tail: usize,
    /// The equations.
    pub kind: Kind,
    /// The indices, in the cut row, of the joints that it solves.
    pub unknown: SmallVec<[usize; 3]>,
}

/// The equations of a step.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Kind {
    /// The rest, one to three joints, moves the tail's point to its position.
    ToPoint(FixedPoint),
    /// The revolute joints of the rest, one or two, rotate the tail's direction to its target.
    ToDirection(Line),
    /// Three rotations move a plane that the tail leaves fixed. The last two of them are solved.
    ToPlane(Line),
    /// One joint remains and moves to the pose.
    Last,
    /// All six joints, in three pairs of parallel axes.
    ThreePairs,
    /// A run of the rest cancels too. One joint remains.
    Between(Relation),
    /// A run of the rest cancels too. One joint before it and one after it remain, in two equations.
    Around([Relation; 2]),
}

/// An invariant: the distance, offset or angle of an object of the run and an object of the tail.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Relation {
    /// The first index of the run in the cut row.
    pub start: usize,
    /// Number of joints of the run.
    pub length: usize,
    /// The object that the run leaves fixed.
    pub run: Feature,
    /// The object that the tail leaves fixed.
    pub tail: Feature,
}

impl Step {
    /// The values of the unknown joints that satisfy this step's equations; `None` when an object does not exist.
    pub fn solve(&self, reduced: &Reduced) -> Option<Answers> {
        let row = reduced.cut_at(self.end);
        let (rest, tail) = row.split_at(row.len() - self.tail);
        match &self.kind {
            Kind::ToPoint(spot) => {
                let Object::Point(p) = Feature::Point(*spot).locate(tail, &reduced.goal)? else { return None };
                let k = match reduced.goal {
                    Goal::Pose(pose) => pose * p,
                    Goal::Point { to, .. } => to,
                };
                Some(carry_point(rest, &p, &k, reduced.loose))
            }
            Kind::ToDirection(line) => {
                let Object::Direction(x) = Feature::Direction(*line).locate(tail, &reduced.goal)? else { return None };
                let Goal::Pose(pose) = reduced.goal else { return None };
                Some(turn_direction(&self.pick(rest), &x, &(pose.rotation * x), reduced.loose))
            }
            Kind::ToPlane(line) => {
                let Object::Plane(n, c) = Feature::Component(*line).locate(tail, &reduced.goal)? else { return None };
                let Goal::Pose(pose) = reduced.goal else { return None };
                let to = (pose.rotation * n, pose * c);
                let [a, b, c3] = [rest[0].screw.axis()?, rest[1].screw.axis()?, rest[2].screw.axis()?];
                let found = carry_plane(a, b, c3, &(n, c), &to);
                Some(found.iter().map(|[q, r]| answer([Some(*q), Some(*r)])).collect())
            }
            Kind::Last => {
                let Goal::Pose(pose) = reduced.goal else { return None };
                Some(last(&rest[0].screw, &pose))
            }
            Kind::ThreePairs => {
                let Goal::Pose(pose) = reduced.goal else { return None };
                let found = parallel_pairs::solve(&reduced.row, &pose, reduced.loose);
                Some(found.iter().map(|q| q.map(Some)).collect())
            }
            Kind::Between(relation) => {
                let (a, b) = relation.locate(rest, tail, &reduced.goal)?;
                let before = self.unknown[0] < relation.start;
                Some(answers(between(&rest[self.unknown[0]].screw, &a, &b, reduced, before)))
            }
            Kind::Around(relations) => {
                let Goal::Pose(pose) = reduced.goal else { return None };
                let screws = [&rest[self.unknown[0]].screw, &rest[self.unknown[1]].screw];
                let pairs =
                    [relations[0].locate(rest, tail, &reduced.goal)?, relations[1].locate(rest, tail, &reduced.goal)?];
                around(screws, &pairs, &pose, reduced.loose)
            }
        }
    }

    /// The indices in the chain of the joints that it solves.
    pub fn solved(&self, reduced: &Reduced) -> SmallVec<[usize; 3]> {
        self.unknown.iter().map(|&place| reduced.joint_at(self.end, place)).collect()
    }

    fn pick(&self, rest: &[Member]) -> SmallVec<[Screw; 3]> {
        self.unknown.iter().map(|&place| rest[place].screw).collect()
    }
}

impl Relation {
    fn locate(&self, rest: &[Member], tail: &[Member], goal: &Goal) -> Option<(Object, Object)> {
        let run = &rest[self.start..self.start + self.length];
        Some((self.run.locate(run, goal)?, self.tail.locate(tail, goal)?))
    }
}

fn answers(values: Values) -> Answers {
    values.choices().into_iter().map(|q| answer([q])).collect()
}

/// Moves `p` to `k` by all joints of `rest`.
fn carry_point(rest: &[Member], p: &Point3<f64>, k: &Point3<f64>, loose: Reach) -> Answers {
    match rest {
        [one] => answers(match &one.screw {
            Screw::Revolute(axis) => rotate_to_point(axis, p, k, loose),
            Screw::Prismatic(direction) => translate_to_point(direction, p, k, loose),
        }),
        [first, second] => {
            let found = two_screws_to_point(&first.screw, &second.screw, p, k, loose);
            found.iter().map(|q| answer(*q)).collect()
        }
        [first, second, third] => {
            let found = three_screws_to_point([&first.screw, &second.screw, &third.screw], p, k, loose);
            found.iter().map(|q| answer(*q)).collect()
        }
        _ => Answers::new(),
    }
}

/// Rotates the direction `x` to `y` by one or two joints.
fn turn_direction(screws: &[Screw], x: &Unit<Vector3<f64>>, y: &Unit<Vector3<f64>>, loose: Reach) -> Answers {
    let (p, k) = (Point3::from(x.into_inner()), Point3::from(y.into_inner()));
    let central = |screw: &Screw| screw.axis().map(Axis::through_origin);
    match screws {
        [one] => central(one).map_or_else(Answers::new, |axis| answers(rotate_to_point(&axis, &p, &k, loose))),
        [first, second] => match (central(first), central(second)) {
            (Some(first), Some(second)) => {
                let (first, second) = (Screw::Revolute(first), Screw::Revolute(second));
                let found = two_screws_to_point(&first, &second, &p, &k, loose);
                found.iter().map(|q| answer(*q)).collect()
            }
            _ => Answers::new(),
        },
        _ => Answers::new(),
    }
}

/// The value at which `screw` moves by `pose`, if there is one. Forward kinematics checks it.
fn last(screw: &Screw, pose: &Pose) -> Answers {
    let q = match screw {
        Screw::Revolute(axis) => {
            angle::wrap(2.0 * axis.direction().dot(&pose.rotation.imag()).atan2(pose.rotation.scalar()))
        }
        Screw::Prismatic(direction) => direction.dot(&pose.translation.vector),
    };
    std::iter::once(answer([Some(q)])).collect()
}

/// The single remaining joint `screw`, after the run (`E b` has the same relation to a as `T b`) or before it (`E a`
/// has the same relation to `T b` as a to b).
fn between(screw: &Screw, a: &Object, b: &Object, reduced: &Reduced, before: bool) -> Values {
    let loose = reduced.loose;
    let target = match &reduced.goal {
        Goal::Pose(pose) => b.moved(pose),
        Goal::Point { to, .. } => Object::Point(*to),
    };
    let (moving, fixed, value) = if before { (a, &target, a.measure(b)) } else { (b, a, a.measure(&target)) };
    let Some(value) = value else { return Values::None };
    match (screw, moving, fixed) {
        (Screw::Revolute(axis), Object::Point(p), Object::Point(k)) => rotate_to_distance(axis, p, k, value, loose),
        (Screw::Prismatic(v), Object::Point(p), Object::Point(k)) => translate_to_distance(v, p, k, value, loose),
        (Screw::Revolute(axis), Object::Point(p), Object::Plane(n, c)) => {
            rotate_to_plane(axis, p, n, &(c + n.scale(value)), loose)
        }
        (Screw::Prismatic(v), Object::Point(p), Object::Plane(n, c)) => {
            translate_to_plane(v, p, n, &(c + n.scale(value)), loose)
        }
        (Screw::Revolute(axis), Object::Plane(n, c), Object::Point(p)) => {
            rotate_to_plane(axis, p, n, &(c + n.scale(value)), loose).negated()
        }
        (Screw::Prismatic(v), Object::Plane(n, c), Object::Point(p)) => {
            translate_to_plane(v, p, n, &(c + n.scale(value)), loose).negated()
        }
        (Screw::Revolute(axis), Object::Direction(x), Object::Direction(y)) => {
            let (axis, p) = (axis.through_origin(), Point3::from(x.into_inner()));
            rotate_to_plane(&axis, &p, y, &Point3::from(y.scale(value)), loose)
        }
        _ => Values::None,
    }
}

/// The joints before (first) and after (second) the run: `E1 a` has the same relation to `T b` as a to `E2 b`, for two
/// pairs of objects.
fn around(screws: [&Screw; 2], pairs: &[(Object, Object); 2], pose: &Pose, loose: Reach) -> Option<Answers> {
    let mut rows = [[0.0; 5]; 2];
    for (row, (a, b)) in rows.iter_mut().zip(pairs) {
        let target = b.moved(pose);
        let [c0, c1, c2] = harmonics(screws[0], |motion| a.moved(motion).linear_measure(&target))?;
        let [d0, d1, d2] = harmonics(screws[1], |motion| a.linear_measure(&b.moved(motion)))?;
        *row = [c1, c2, -d1, -d2, d0 - c0];
    }
    let (x, z) = (Vector3::x(), Vector3::z_axis());
    let part = |i: usize, j: usize| Vector3::new(rows[i][j], rows[i][j + 1], 0.0);
    let found =
        four_circles([part(0, 0), part(0, 2), part(1, 0), part(1, 2)], [z; 4], [x; 4], [rows[0][4], rows[1][4]], loose);
    Some(found.iter().map(|q| answer(*q)).collect())
}

/// `f(q) = f0 + f1 cos q + f2 sin q` for a revolute joint.
fn harmonics(screw: &Screw, f: impl Fn(&Pose) -> Option<f64>) -> Option<[f64; 3]> {
    use std::f64::consts::{FRAC_PI_2, PI};
    screw.axis()?;
    let (zero, quarter, half) = (f(&screw.exp(0.0))?, f(&screw.exp(FRAC_PI_2))?, f(&screw.exp(PI))?);
    let mean = (zero + half) / 2.0;
    Some([mean, (zero - half) / 2.0, quarter - mean])
}

impl Object {
    fn moved(&self, motion: &Pose) -> Object {
        match self {
            Object::Point(p) => Object::Point(motion * p),
            Object::Plane(n, c) => Object::Plane(motion.rotation * n, motion * c),
            Object::Direction(x) => Object::Direction(motion.rotation * x),
        }
    }

    /// The invariant of two objects under rigid motions: the distance of two points, the signed offset of a point and a
    /// plane, the cosine between two directions.
    fn measure(&self, other: &Object) -> Option<f64> {
        match (self, other) {
            (Object::Point(p), Object::Point(k)) => Some((p - k).norm()),
            _ => self.linear_measure(other),
        }
    }

    /// Same as `measure`, but squared for points: it is linear in the cosine and sine of a rotation of either.
    fn linear_measure(&self, other: &Object) -> Option<f64> {
        match (self, other) {
            (Object::Point(p), Object::Point(k)) => Some((p - k).norm_squared()),
            (Object::Point(p), Object::Plane(n, c)) | (Object::Plane(n, c), Object::Point(p)) => Some(n.dot(&(p - c))),
            (Object::Direction(x), Object::Direction(y)) => Some(x.dot(y)),
            _ => None,
        }
    }
}
