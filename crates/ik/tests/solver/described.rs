//! Solutions of a robot that is described in rounded numbers, where the equations change little along a curve.

use std::f64::consts::TAU;

use groebot_robot::model::Robot;

/// Joint values in degrees with a straight wrist. Along the curve on which the equations of the described robot hold almost, the residual is least there, and does not
/// change its sign. Two consecutive places of the walk have nearly equal residuals, one before and one after it.
const TANGENT: [[f64; 6]; 2] = [[-70.0, 174.0, 34.0, 155.0, 0.0, -73.0], [-94.0, -94.0, 134.0, -39.0, 0.0, -139.0]];

#[test]
fn double_solutions_on_a_curve_are_found() {
    let robot = Robot::read("../../tests/corpus/urdf/ur5.urdf").unwrap();
    let chain = robot.chain(None, None).unwrap();
    let derivation = groebot_ik::derive(&chain).unwrap();
    let solver = derivation.solver();
    for degrees in TANGENT {
        let q = degrees.map(f64::to_radians);
        let solutions = solver.solve(chain.forward(&q).unwrap()).unwrap();
        let turn = |a: f64, b: f64| ((a - b) / TAU - ((a - b) / TAU).round()).abs() * TAU;
        let is_same = |own: &[f64]| own.iter().zip(&q).all(|(a, b)| turn(*a, *b) < 1e-3);
        assert!(solutions.iter().any(|solution| is_same(&solution.q)), "{degrees:?}");
        assert!(solutions.iter().all(|solution| solution.residual < 1e-12), "{degrees:?}");
    }
}
