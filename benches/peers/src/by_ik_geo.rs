//! ik-geo: a robot is given by its axes and by the offsets between them at zero. The caller selects the family.

use groebot::kinematics::Chain;
use groebot::spatial::{Axis, Pose, Screw};
use ik_geo::nalgebra::{Matrix3, Matrix3x6, SMatrix, Vector3};
use ik_geo::robot::{self, IKSolver, Robot};

use crate::Joints;

/// One of ik-geo's families with a closed form.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Family {
    /// Axes 4, 5, 6 intersect; 2 and 3 are parallel.
    SphericalTwoParallel,
    /// Axes 4, 5, 6 intersect, and so do axes 1 and 2.
    SphericalTwoIntersecting,
    /// Axes 4, 5, 6 intersect.
    Spherical,
    /// Axes 2, 3, 4 are parallel; 5 and 6 intersect.
    ThreeParallelTwoIntersecting,
}

impl Family {
    /// The family that solves the robot with this name; `true` if its chain must be reversed, because its first axes
    /// intersect.
    pub fn of(name: &str) -> Option<(Family, bool)> {
        match name {
            "irb120" => Some((Family::SphericalTwoParallel, false)),
            "puma" | "rh0_right_leg" | "rh0_left_leg" => Some((Family::SphericalTwoIntersecting, false)),
            "nao_left_leg" | "nao_right_leg" | "teo_leg" => Some((Family::SphericalTwoIntersecting, true)),
            "spherical_wrist" => Some((Family::Spherical, false)),
            "ur5" => Some((Family::ThreeParallelTwoIntersecting, false)),
            _ => None,
        }
    }
}

/// A robot in ik-geo's format.
pub struct IkGeo {
    robot: Robot,
    base_from_tip: Pose,
    reversed: bool,
}

/// A pose in ik-geo's format.
pub type Target = (Matrix3<f64>, Vector3<f64>);

impl IkGeo {
    /// Converts `chain`, if ik-geo has a closed form for it.
    pub fn new(chain: &Chain) -> Option<Self> {
        let (family, reversed) = Family::of(chain.name())?;
        let mut axes = chain.screws().iter().map(axis_of).collect::<Option<Vec<Axis>>>()?;
        let mut base_from_tip = chain.base_from_tip();
        if reversed {
            base_from_tip = base_from_tip.inverse();
            axes = axes.iter().rev().map(|axis| turned_round(axis, &base_from_tip)).collect();
        }
        let robot = robot_of(family, &axes, &base_from_tip);
        Some(IkGeo { robot, base_from_tip, reversed })
    }

    /// Converts `pose`, that of the tip in the base frame, to ik-geo's format.
    pub fn target(&self, pose: &Pose) -> Target {
        let pose = if self.reversed { pose.inverse() } else { *pose };
        let rotation = (pose.rotation * self.base_from_tip.rotation.inverse()).to_rotation_matrix().into_inner();
        (Matrix3::from_fn(|i, j| rotation[(i, j)]), vector(&pose.translation.vector))
    }

    /// ik-geo's solutions: joint values, and whether they are only a least-squares approximation.
    pub fn solve(&self, target: &Target) -> Vec<(ik_geo::nalgebra::Vector6<f64>, bool)> {
        self.robot.ik(target.0, target.1)
    }

    /// Forward kinematics of all joint vectors with groebot's chain.
    pub fn forward(&self, all: &[Joints]) {
        for q in all {
            std::hint::black_box(self.robot.fk(std::hint::black_box(q)));
        }
    }

    /// The solutions that ik-geo reports as exact, as joint values of groebot's chain.
    pub fn solutions(&self, target: &Target) -> Vec<Joints> {
        let exact = self.solve(target).into_iter().filter(|(_, is_nearest)| !is_nearest);
        exact.map(|(q, _)| std::array::from_fn(|i| if self.reversed { q[5 - i] } else { q[i] })).collect()
    }
}

/// Converts `v` to the version of nalgebra that ik-geo uses.
pub fn vector(v: &nalgebra::Vector3<f64>) -> Vector3<f64> {
    Vector3::new(v.x, v.y, v.z)
}

fn axis_of(screw: &Screw) -> Option<Axis> {
    match screw {
        Screw::Revolute(axis) => Some(*axis),
        Screw::Prismatic(_) => None,
    }
}

/// `axis` in the tip frame of the reversed chain: a rotation of the base about it is the opposite rotation of the tip.
fn turned_round(axis: &Axis, tip_from_base: &Pose) -> Axis {
    let direction = -(tip_from_base.rotation * axis.direction().into_inner());
    Axis::new(direction, tip_from_base * axis.point()).expect("a chain's axis")
}

fn robot_of(family: Family, axes: &[Axis], base_from_tip: &Pose) -> Robot {
    let points = points_of(family, axes, base_from_tip);
    let h = Matrix3x6::from_fn(|i, j| axes[j].direction()[i]);
    let p = SMatrix::<f64, 3, 7>::from_fn(|i, j| points[j + 1][i] - points[j][i]);
    match family {
        Family::SphericalTwoParallel => robot::spherical_two_parallel(h, p),
        Family::SphericalTwoIntersecting => robot::spherical_two_intersecting(h, p),
        Family::Spherical => robot::spherical(h, p),
        Family::ThreeParallelTwoIntersecting => robot::three_parallel_two_intersecting(h, p),
    }
}

/// The base, a point of each axis, the tip. Intersecting axes have their point of intersection.
fn points_of(family: Family, axes: &[Axis], base_from_tip: &Pose) -> Vec<[f64; 3]> {
    let mut points: Vec<[f64; 3]> = axes.iter().map(|axis| axis.point().into()).collect();
    let meeting = |a: usize, b: usize| -> [f64; 3] {
        axes[a].nearest_points(&axes[b]).map_or(points[b], |(point, _)| point.into())
    };
    let (first, wrist, last) = (meeting(0, 1), meeting(3, 4), meeting(4, 5));
    match family {
        Family::SphericalTwoParallel | Family::Spherical => points[3..].fill(wrist),
        Family::SphericalTwoIntersecting => {
            points[..2].fill(first);
            points[3..].fill(wrist);
        }
        Family::ThreeParallelTwoIntersecting => points[4..].fill(last),
    }
    let tip = base_from_tip.translation.vector;
    [[0.0; 3]].into_iter().chain(points).chain([[tip.x, tip.y, tip.z]]).collect()
}
