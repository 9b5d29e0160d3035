//! Targets that need the tolerances of `tolerances.rs`: without its tolerance, each one has lost, equal or wrong solutions.
//!
//! "Without" is a value of zero, infinity, or a thousand times more or less, as the comment says. Each row was found and checked with a run time whose
//! tolerances can be changed.

#![allow(clippy::duplicate_mod)]

use std::f64::consts::{FRAC_PI_2, PI};

use groebot_runtime::mechanism::Joints;
use groebot_runtime::roots::real_roots;
use groebot_runtime::storage::Array;
use groebot_runtime::{Solution, Solve, number};

#[rustfmt::skip]
#[path = "../../derivations/crx_like/5_solver.rs"]
mod crx;
#[rustfmt::skip]
#[path = "../../derivations/iiwa14/5_solver.rs"]
mod iiwa;
#[rustfmt::skip]
#[path = "../../derivations/irb120/5_solver.rs"]
mod irb120;
#[rustfmt::skip]
#[path = "../../derivations/irb4600_rounded/5_solver.rs"]
mod irb4600;
#[rustfmt::skip]
#[path = "../../derivations/spherical_wrist/5_solver.rs"]
mod spherical;
#[rustfmt::skip]
#[path = "../../derivations/stanford/5_solver.rs"]
mod stanford;
#[rustfmt::skip]
#[path = "../../derivations/ur5/5_solver.rs"]
mod ur5;

/// Whether the pose of joint values has so many solutions, of which so many have free joints, and each one holds.
fn check<M: Solve>(robot: &M, q: &[f64], count: usize, free: usize) {
    let row: Joints<M> = Array::by(q.len(), |joint| q[joint]);
    let target = robot.forward(&row).unwrap();
    let mut out = vec![Solution::empty(robot); robot.facts().capacity];
    let found = robot.solve(&target, &mut out).unwrap();
    let found = &out[..found];
    assert!(found.iter().all(|solution| solution.residual <= 1e-11 * f64::max(robot.facts().scale, 1.0)));
    let with_free_joints = found.iter().filter(|solution| solution.free != 0).count();
    assert_eq!((found.len(), with_free_joints), (count, free), "solutions, and those with free joints, of {q:?}");
}

/// One test for each tolerance: the robot, its joint values, the number of solutions, and that of solutions with free joints.
macro_rules! targets {
    ($($(#[$comment:meta])* $name:ident: $robot:ident, $q:expr, $count:expr, $free:expr;)*) => {
        $($(#[$comment])* #[test] fn $name() { check(&$robot::Solver, &$q, $count, $free); })*
    };
}

/// Joint values near a singular configuration of the arm with an offset wrist, in which it has a curve of nearly correct solutions.
const BESIDE_A_CURVE: [f64; 6] = [
    0.16173555615872015,
    2.105824803791804,
    1.5707964267948966,
    -2.455255332926444,
    0.3469638808778166,
    -2.9217282671524805,
];
/// The same, nearer.
const NEAR_A_CURVE: [f64; 6] = [
    0.16173555615872015,
    2.105824803791804,
    1.5707963277948966,
    -2.455255332926444,
    0.3469638808778166,
    -2.9217282671524805,
];
/// An ordinary target of that arm.
const ORDINARY: [f64; 6] = [
    0.7430714532393212,
    -2.5591654540550053,
    -2.5398050556358918,
    -1.8129529227689192,
    -3.1015113808746397,
    0.41865331703641795,
];
/// A round target of that arm, with self-motions.
const ROUND: [f64; 6] = [0.0, 0.0, FRAC_PI_2, 0.0, 0.0, -FRAC_PI_2];
/// Another one, with double solutions.
const FOLDED: [f64; 6] = [0.0, PI, PI, PI, PI, 0.0];
/// A target of the arm with seven joints, one of them given, with self-motions.
const SEVEN: [f64; 7] =
    [PI, -PI, 1.832595714594046, 0.5235987755982988, -1.0471975511965976, -0.0, -1.3089969389957472];

targets! {
    /// 0: no solution.
    roots_tangent: iiwa, [2.0314403820122324, PI, FRAC_PI_2, 0.6631093053380188, 0.0, 1.6063746213121617, FRAC_PI_2], 4, 0;
    /// Infinity: no solution.
    roots_close: spherical,
        [0.16173555615872015, 2.105824803791804, 1.9651190922675807, -2.455255332926444, 0.3469638808778166, -2.9217282671524805], 8, 0;
    /// Infinity: 4 solutions, because a self-motion is given twice.
    roots_pivot: crx, ROUND, 2, 2;
    /// Infinity: no solution.
    roots_zero: crx, ORDINARY, 4, 0;
    /// 0: 8 solutions.
    strata_near: crx, NEAR_A_CURVE, 16, 0;
    /// 0: no solution. The axes of joints 1, 4 and 6 coincide: two surfaces of solutions, with the arm upwards and downwards.
    derived_strata_close: stanford, [0.0, 0.0, 0.1, FRAC_PI_2, FRAC_PI_2, FRAC_PI_2], 2, 2;
    /// 4e-12: 4 solutions with free joints, and none at these joint values.
    derived_strata_lost: stanford,
        [0.0, -3.1315926535897933, 0.1, -FRAC_PI_2, -1.5707963267947966, -1.258015725934114], 8, 0;
    /// Infinity: no solution.
    strata_denominator: iiwa,
        [0.16173555615872015, 2.105824803791804, 1.9651190922675807, -2.455255332926444, 0.3469638808778166, -2.9217282671524805,
         0.7430714532393212], 8, 0;
    /// Infinity: 16 solutions, some of them wrong.
    acceptance_residual: crx,
        [-2.0204100052388556, 0.48909008692947786, 1.5708063267948966, 2.6095271871019694, 0.6892067634619838, 1.9325159376991865], 12, 0;
    /// 0: 8 solutions without free joints, members of the self-motions.
    acceptance_rounding: iiwa, SEVEN, 6, 2;
    /// 1e-9: 4 solutions without free joints.
    acceptance_unsettled: iiwa, [2.274551612128215, -2.214458719751504, 1.3637384360639049, PI, -FRAC_PI_2, PI, 1.603055393922713], 2, 2;
    /// 0: no solution, but an error, because rounding makes the rotation inaccurate.
    acceptance_input: crx, ORDINARY, 4, 0;
    /// 1e-12: 8 solutions without free joints.
    polishing_done: iiwa, [PI, PI, FRAC_PI_2, 0.0, -2.800678874667966, 2.634284867563448, 2.8420756810393524], 2, 2;
    /// 0: 8 solutions.
    polishing_step: crx, NEAR_A_CURVE, 16, 0;
    /// 0 for the last one: no solution.
    polishing_dampings: ur5, [0.16173555615872015, 2.105824803791804, 0.0, -FRAC_PI_2, PI, 1.9651190922675807], 1, 0;
    /// Infinity: no solution.
    pivots_singular: crx, ORDINARY, 4, 0;
    /// 0: 8 solutions without free joints.
    pivots_regular: iiwa, SEVEN, 6, 2;
    /// 0: 8 solutions, of which some are equal.
    pivots_isolated: crx, FOLDED, 6, 0;
    /// 0: no solution.
    pivots_weak: crx, ORDINARY, 4, 0;
    /// 0: 8 solutions.
    self_motions_member: crx, BESIDE_A_CURVE, 16, 0;
    /// 0: 14 solutions, because one self-motion is returned several times.
    self_motions_curve: irb120,
        [0.16173555615872015, 2.105824803791804, 1.9651190922675807, -2.455255332926444, -1.5707963267938965, -2.9217282671524805], 7, 1;
    /// 0: 8 solutions.
    self_motions_flat: crx, BESIDE_A_CURVE, 16, 0;
    /// 0: 16 solutions, of which some are equal.
    merging_joints: crx, FOLDED, 6, 0;
    /// 0: 8 solutions, of which some are equal.
    merging_blur: crx, FOLDED, 6, 0;
    /// 2.5e-12: 4 solutions.
    merging_halfway: irb120,
        [-2.5398050556358918, -1.8129529227689192, 1.798563292532853, 0.41865331703641795, -0.8743929778533097, -0.7822171424082569], 8, 0;
    /// Infinity: 8 solutions.
    merging_apart: crx, BESIDE_A_CURVE, 16, 0;
    /// 10: 4 solutions.
    merging_known: irb4600,
        [3.113633476242822, -0.29226681166699375, 1.750077352040686, -2.9837705415716655, -0.49457523379538904, -1.5246686662083384], 6, 0;
    /// 0: 5 solutions.
    nearby_robots_off: irb4600,
        [-0.27752749924018083, -0.5774862587978071, -1.391515537437087, 2.7022411545859297, 0.578387474466695, 0.4212696689418043], 6, 0;
    /// Infinity: 7 solutions.
    eigenvalues_shift: crx, [0.0, 0.0, 0.0, FRAC_PI_2, -FRAC_PI_2, 2.274551612128215], 8, 0;
    /// Infinity: 4 solutions, because a self-motion is given twice.
    eigenvalues_accuracy: crx, ROUND, 2, 2;
    /// 0: 4 solutions.
    eigenvalues_blurred: crx, [PI, FRAC_PI_2, -FRAC_PI_2, -FRAC_PI_2, FRAC_PI_2, -FRAC_PI_2], 8, 0;
    /// Infinity for the sixth one: 3 solutions without free joints.
    eigenvalues_aside: crx, ROUND, 2, 2;
}

/// A quartic with a double root: with 0, Ferrari's two quadratics have none.
#[test]
fn roots_distinct() {
    let quartic = [-32.13417717457102, 49.34407041761285, -33.34322583358136, 12.967313990433372, -2.317353073013435];
    let roots: number::Roots<f64, 4> = real_roots(&quartic, 1.0);
    assert_eq!(roots.as_slice().len(), 1, "{:?}", roots.as_slice());
    assert!((roots.as_slice()[0] - 1.873_357).abs() < 1e-5);
}
