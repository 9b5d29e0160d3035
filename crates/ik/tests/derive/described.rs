//! Robots with fewer joints than their tasks have numbers, described with rounded angles. They must have the solutions of the exactly described robots.
//!
//! The descriptions have the structure and size of real robots (after their makers' drawings), but they are not copies of files. Dimensions are representative.

use std::f64::consts::{FRAC_PI_2, PI};

use groebot_robot::kinematics::screw::ScrewSolver;
use groebot_robot::kinematics::{BaseAxis, Chain, JointKind, Plane, Solution, Target, Task};
use groebot_robot::model::Robot;
use nalgebra::DMatrix;

use crate::codegen::random;

/// A joint: its type, its origin's position and roll, pitch, yaw, its axis. `Q` is replaced by pi/2 and `H` by pi.
pub(crate) type Link = (&'static str, &'static str, &'static str, &'static str);

/// A SCARA whose prismatic joint points down.
pub(super) const SCARA: [Link; 4] = [
    ("revolute", "0 0 0.1", "0 0 0", "0 0 1"),
    ("revolute", "0.3 0 0", "0 0 0", "0 0 1"),
    ("prismatic", "0.25 0 0.133", "H 0 0", "0 0 1"),
    ("revolute", "0 0 0", "0 0 0", "0 0 1"),
];
/// A SCARA with two links of equal length. When folded, its tool is on the first joint's axis, and this joint is free.
pub(super) const FOLDING: [Link; 4] = [
    ("revolute", "0 0 0", "0 0 0", "0 0 1"),
    ("revolute", "0.3 0 0", "0 0 0", "0 0 1"),
    ("prismatic", "0.3 0 0.13297", "H 0 0", "0 0 1"),
    ("revolute", "0 0 0", "0 0 0", "0 0 1"),
];
/// An arm of five joints, similar to a uFactory xArm 5: three parallel axes, and a wrist perpendicular to them.
pub(super) const FIVE: [Link; 5] = [
    ("revolute", "0 0 0.267", "0 0 0", "0 0 1"),
    ("revolute", "0 0 0", "-Q 0 0", "0 0 1"),
    ("revolute", "0.053 -0.2845 0", "0 0 0", "0 0 1"),
    ("revolute", "0.0775 0.3425 0", "0 0 0", "0 0 1"),
    ("revolute", "0.076 0.097 0", "-Q 0 0", "0 0 1"),
];
/// A palletizer similar to a Doosan P3020: five joints, with two perpendicular wrist joints and several rounded angles.
const PALLETIZER: [Link; 5] = [
    ("revolute", "0 0 0.1985", "0 0 0", "0 0 1"),
    ("revolute", "0 0.05 0.2", "0 -Q -Q", "0 0 1"),
    ("revolute", "0.7 0 0", "0 0 Q", "0 0 1"),
    ("revolute", "0 -0.6 0", "H 0 Q", "0 0 1"),
    ("revolute", "0 0.1 0", "Q 0 0", "0 0 1"),
];
/// An arm of four joints, similar to a PhantomX Pincher: a waist and three parallel axes.
pub(super) const PINCHER: [Link; 4] = [
    ("revolute", "0 0 0.0676", "0 0 0", "0 0 1"),
    ("revolute", "0 0 0.0394", "Q 0 0", "0 0 1"),
    ("revolute", "0 0.107 0", "0 0 0", "0 0 1"),
    ("revolute", "0.107 0 0", "0 0 0", "0 0 1"),
];
/// An arm of four joints, similar to a Mico 4: the last joint rotates the hand about the forearm.
pub(crate) const MICO: [Link; 4] = [
    ("revolute", "0 0 0.2755", "H 0 0", "0 0 1"),
    ("revolute", "0 -0.007 0", "-Q 0 H", "0 0 1"),
    ("revolute", "0 0.29 0", "H 0 0", "0 0 1"),
    ("revolute", "0 0.1233 -0.0074", "-Q 0 0", "0 0 1"),
];
/// An arm of five joints, similar to a Lynxmotion AL5D.
pub(super) const LYNX: [Link; 5] = [
    ("revolute", "0 0 0.069", "0 0 0", "0 0 1"),
    ("revolute", "0 0 0", "Q 0 0", "0 0 1"),
    ("revolute", "0.146 0 0", "0 0 0", "0 0 1"),
    ("revolute", "0.187 0 0", "0 0 -Q", "0 0 1"),
    ("revolute", "0 0.034 0", "-Q 0 0", "0 0 1"),
];
/// A shoulder of two joints and an elbow, similar to an OP2's arm.
const SHOULDER: [Link; 3] = [
    ("revolute", "0 0.06 0", "-Q 0 0", "0 0 1"),
    ("revolute", "0.019 0 0.0245", "Q 0 Q", "0 0 1"),
    ("revolute", "0.06 0.016 0", "Q 0 0", "0 0 1"),
];
/// Three links in the vertical plane.
pub(super) const PLANAR: [Link; 3] = [
    ("revolute", "0 0 0.1", "Q 0 0", "0 0 1"),
    ("revolute", "0.3 0 0", "0 0 0", "0 0 1"),
    ("revolute", "0.25 0 0", "0 0 0", "0 0 1"),
];

/// Roundings of pi/2 and pi in descriptions.
pub(super) const ROUNDINGS: [[&str; 2]; 4] = [
    ["1.5707963", "3.14159265"],
    ["1.5708", "3.1416"],
    ["1.57079", "3.14159"],
    // Single precision.
    ["1.57079637050628662109375", "3.1415927410125732421875"],
];
pub(crate) const EXACT: [&str; 2] = ["1.5707963267948966", "3.141592653589793"];

/// The robot with these values of pi/2 and pi.
pub(crate) fn robot(links: &[Link], [quarter, half]: [&str; 2]) -> Chain {
    let mut text = String::from("<robot name=\"rounded\"><link name=\"l0\"/>");
    for (index, (kind, xyz, rpy, axis)) in links.iter().enumerate() {
        let (rpy, next) = (rpy.replace('Q', quarter).replace('H', half), index + 1);
        text += &format!(
            "<link name=\"l{next}\"/><joint name=\"j{next}\" type=\"{kind}\"><parent link=\"l{index}\"/><child link=\"l{next}\"/>\
             <origin xyz=\"{xyz}\" rpy=\"{rpy}\"/><axis xyz=\"{axis}\"/>\
             <limit lower=\"-3\" upper=\"3\" effort=\"1\" velocity=\"1\"/></joint>"
        );
    }
    let last = links.len();
    text += &format!(
        "<link name=\"t\"/><joint name=\"jt\" type=\"fixed\"><parent link=\"l{last}\"/><child link=\"t\"/>\
         <origin xyz=\"0.02 0.01 0.05\" rpy=\"0 0 0\"/></joint></robot>"
    );
    Robot::from_urdf(&text).unwrap().chain(None, Some("t")).unwrap()
}

/// `chain` for a task.
pub(super) fn with_task(chain: &Chain, task: Task, direction: [i32; 3]) -> Chain {
    chain
        .with_task(task, direction.map(|x| groebot_algebra::number::BigRational::from_integer(x.into())), Vec::new())
        .unwrap()
}

/// The solver of a chain for its task.
pub(super) fn derived(chain: &Chain) -> groebot_ik::solver::Program {
    groebot_ik::derive(chain).unwrap().program().clone()
}

/// Programs of described robots: two SCARAs, an arm of five joints and a planar arm.
pub fn programs() -> Vec<groebot_ik::solver::Program> {
    let planar = with_task(&robot(&PLANAR, ROUNDINGS[1]), Task::PlanarPose { plane: Plane::Xz }, [0, 0, 1]);
    [robot(&SCARA, ROUNDINGS[0]), robot(&FOLDING, ROUNDINGS[1]), robot(&FIVE, ROUNDINGS[1]), planar]
        .iter()
        .map(derived)
        .collect()
}

fn sigma(jacobian: DMatrix<f64>) -> f64 {
    jacobian.svd(false, false).singular_values.min()
}

pub(super) fn distance(chain: &Chain, a: &[f64], b: &[f64]) -> f64 {
    let difference = |(joint, (a, b)): (&groebot_robot::kinematics::Joint, (&f64, &f64))| match joint.kind {
        JointKind::Revolute => (a - b - 2.0 * PI * ((a - b) / (2.0 * PI)).round()).abs(),
        JointKind::Prismatic => (a - b).abs() / chain.reach(),
    };
    chain.joints().iter().zip(a.iter().zip(b)).map(difference).fold(0.0, f64::max)
}

/// Joint values: random ones, and multiples of 15 degrees.
fn joints(chain: &Chain, count: usize) -> Vec<Vec<f64>> {
    let mut between = random();
    let mut vector = |k: usize| {
        let mut value = |kind: JointKind| match kind {
            JointKind::Prismatic => 0.01 * between(-20.0, 20.0).round(),
            JointKind::Revolute if k.is_multiple_of(2) => between(-PI, PI),
            JointKind::Revolute => between(-11.4, 12.4).round() * FRAC_PI_2 / 6.0,
        };
        chain.joints().iter().map(|joint| value(joint.kind)).collect()
    };
    (0..count).map(&mut vector).collect()
}

/// Whether each of `some` has a member of `others` nearby. The tolerance is the difference `within` of the robots' tips over the smallest singular value.
fn covers(chain: &Chain, some: &[Solution], others: &[Solution], within: f64) -> bool {
    let is_near = |a: &Solution, b: &Solution| {
        let least = sigma(chain.task_jacobian(&a.q, &[]));
        distance(chain, &a.q, &b.q) <= 1e-9 + 10.0 * within / least
    };
    some.iter().all(|a| others.iter().any(|b| is_near(a, b)))
}

/// The numbers of compared cases.
#[derive(Debug, Default)]
struct Seen {
    ordinary: usize,
    singular: usize,
    answers: usize,
}

/// Compares the solver of the described robot with that of the exactly described robot and the screw solver, at poses of both robots.
fn compare(described: &Chain, exact: &Chain, count: usize) -> Seen {
    let bound = described.ideal().1.bound();
    let (program, reference) = (derived(described), derived(exact).solver());
    assert!(bound > 1e-9, "{bound}: nothing is rounded");
    assert!(program.described.is_some(), "the ideal robot decides");
    let (solver, screws) = (program.solver(), ScrewSolver::new(described).unwrap());
    let mut seen = Seen::default();
    for q in joints(exact, count) {
        let target = Target::reached(exact, &q).unwrap();
        let wanted = reference.solve(target).unwrap();
        let is_ordinary =
            |answer: &Solution| answer.free.is_empty() && sigma(exact.task_jacobian(&answer.q, &[])) > 2e-2;
        for target in [target, Target::reached(described, &q).unwrap()] {
            let answers = solver.solve(target).unwrap();
            for answer in &answers {
                let [position, rotation] = target.missed(described, &answer.q);
                let off = (position / described.reach()).max(rotation);
                assert!(off <= 4.0 * bound, "{q:?}: {off:e}, allowed {bound:e}");
            }
            if !wanted.iter().all(is_ordinary) {
                seen.singular += 1;
                assert!(!answers.is_empty(), "{q:?}");
                continue;
            }
            let others = screws.solve(&target).unwrap();
            // A target out of reach by less than the tolerance has one additional solution, at the boundary of the workspace.
            let at_edge = |answer: &&Solution| sigma(exact.task_jacobian(&answer.q, &[])) <= 4.0 * bound.sqrt();
            let edges = answers.iter().filter(at_edge).count();
            assert!((wanted.len()..=wanted.len() + edges).contains(&answers.len()), "{q:?}: {wanted:?} {answers:?}");
            assert_eq!(others.len(), wanted.len(), "{q:?}");
            assert!(covers(exact, &wanted, &answers, bound), "{q:?}: {wanted:?} {answers:?}");
            assert!(covers(exact, &wanted, &others, bound), "{q:?}: {wanted:?} {others:?}");
            seen.ordinary += 1;
            seen.answers += answers.len();
        }
    }
    seen
}

#[test]
fn poses_of_rounded_robots_have_the_answers_of_all_digits() {
    let robots: [(&[Link], usize); 7] =
        [(&SCARA, 2), (&FIVE, 2), (&PALLETIZER, 1), (&PINCHER, 1), (&MICO, 1), (&LYNX, 1), (&SHOULDER, 1)];
    for (links, most) in robots {
        let exact = robot(links, EXACT);
        for rounding in ROUNDINGS {
            let seen = compare(&robot(links, rounding), &exact, 24);
            println!("{} joints, {rounding:?}: {seen:?}", links.len());
            assert!(seen.ordinary >= 20 && seen.answers >= most * 20, "{links:?} {rounding:?}: {seen:?}");
        }
    }
}

#[test]
fn rays_and_planar_poses_of_rounded_robots_have_the_answers_of_all_digits() {
    for rounding in ROUNDINGS {
        let ray = |digits| with_task(&robot(&SCARA, digits), Task::Ray, [1, 0, 0]);
        let seen = compare(&ray(rounding), &ray(EXACT), 16);
        assert!(seen.answers >= 20, "{seen:?}");
        let yaw = |digits| with_task(&robot(&SCARA, digits), Task::PositionYaw { axis: BaseAxis::Z }, [1, 0, 0]);
        let seen = compare(&yaw(rounding), &yaw(EXACT), 16);
        assert!(seen.answers >= 40, "{seen:?}");
        let planar = |digits| with_task(&robot(&PLANAR, digits), Task::PlanarPose { plane: Plane::Xz }, [0, 0, 1]);
        let seen = compare(&planar(rounding), &planar(EXACT), 24);
        assert!(seen.answers >= 40, "{seen:?}");
    }
}

/// A target that the ideal robot does not reach within the tolerance has no solution.
#[test]
fn poses_beside_the_robot_are_out_of_reach() {
    let described = robot(&SCARA, ROUNDINGS[0]);
    let (solver, bound) = (derived(&described).solver(), described.ideal().1.bound());
    let screws = ScrewSolver::new(&described).unwrap();
    let Target::Pose(pose) = Target::reached(&described, &[0.3, 0.8, -0.05, 0.4]).unwrap() else { unreachable!() };
    for (share, count) in [(0.5, 2), (20.0, 0), (1e4, 0)] {
        let tilt = nalgebra::UnitQuaternion::from_euler_angles(share * bound, 0.0, 0.0);
        let target = Target::Pose(groebot_robot::spatial::Pose::from_parts(pose.translation, tilt * pose.rotation));
        assert_eq!(solver.solve(target).unwrap().len(), count, "{share}");
        assert_eq!(screws.solve(&target).unwrap().len(), count, "{share}");
    }
}

/// The tolerance depends on the robot: a robot with larger rounding errors accepts targets with larger deviations.
#[test]
fn tolerances_follow_the_idealisation() {
    let within = |digits| derived(&robot(&SCARA, digits)).described.map(|described| described.within);
    let [fine, coarse] = [within(ROUNDINGS[0]).unwrap(), within(ROUNDINGS[1]).unwrap()];
    assert!(fine < 1e-7 && coarse > 1e-5 && coarse < 1e-3, "{fine} {coarse}");
    assert_eq!(within(EXACT), None);
}

#[test]
fn planes_that_are_tilted_beyond_the_tolerance_are_refused_with_the_option_that_helps() {
    let planar = with_task(&robot(&PLANAR, ["1.571", "3.142"]), Task::PlanarPose { plane: Plane::Xz }, [0, 0, 1]);
    let error = planar.ideal_within(1e-6).unwrap_err().to_string();
    assert!(
        error.contains("`j1`") && error.contains("the deviation is 2.0e-4 rad") && error.contains("--snap"),
        "{error}"
    );
    assert!(planar.ideal_within(1e-3).is_ok());
}
