//! Closed curves of solutions that reach no limit, and the values of joints at which they are searched.

use groebot_algebra::random::SplitMix64;
use groebot_ik::solver::redundant::Criterion;

use super::redundant::panda;

/// Joint vectors on closed curves of a Panda that move the joint of the grid, `panda_joint5`, by less than 0.3 rad, of 4,000 random vectors.
const SHORT: [[f64; 7]; 3] = [
    [-1.637006, 1.332531, 2.727722, -0.485787, 0.018149, 2.664245, -1.790226],
    [-2.501808, -0.842643, -2.063544, -0.503207, -0.079830, 3.299495, 1.706405],
    [-2.467606, -1.222651, 2.852880, -0.479480, -0.069045, 2.486338, -1.719587],
];

/// The vector that made the pose is on an arc, which is closed.
#[test]
fn short_closed_curves_are_found() {
    let arm = panda();
    for q in SHORT {
        let (pose, target) = arm.target(&q);
        let limits = arm.solver.limits();
        let arcs = arm.solver.arcs(&target, &limits).unwrap();
        let nearest = Criterion::nearest(q.to_vec());
        let best = arm.solver.best_on(&target, &limits, &arcs.arcs, &nearest).unwrap().unwrap();
        assert!(best.value > -1e-8, "{q:?}: {best:?}");
        assert!(arcs.arcs[best.arc].is_closed, "{arcs:?}");
        arm.assert_solves(&pose, &best.q);
    }
}

/// With joint 5 straight and joint 4 at its section, the screws of a Panda's joints are dependent whatever the other joints.
#[test]
fn the_elbow_of_a_panda_is_a_section() {
    let arm = panda();
    let derivation = groebot_ik::derive(&arm.chain).unwrap();
    let closed = derivation.program().redundancy.as_ref().unwrap().closed.as_ref().unwrap();
    let elbow = closed.sections.iter().find(|section| section.joint == 3).unwrap();
    let mut random = SplitMix64::new(5);
    let mut least = |joint4: f64| {
        let mut q: Vec<f64> = (0..7).map(|_| random.between(-2.0, 2.0)).collect();
        (q[3], q[4]) = (joint4, 0.0);
        arm.chain.task_jacobian(&q, &[]).singular_values().min()
    };
    for _ in 0..20 {
        assert!(least(elbow.value) < 1e-6);
        assert!(least(elbow.value - 0.3) > 1e-3);
    }
}
