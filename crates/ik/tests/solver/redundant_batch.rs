//! Many targets of a redundant arm at once, and the best solution on each arc.

use groebot_ik::solver::redundant::{Absence, Criterion};
use groebot_ik::{ErrorKind, Watch};
use groebot_robot::spatial::Pose;

use super::redundant::{READY, panda};

/// Joint vectors within the limits of a panda.
const VECTORS: [[f64; 7]; 3] =
    [READY, [0.4, 0.3, -0.7, -1.9, 0.6, 2.1, -1.1], [2.6214, 1.7513, 0.5511, -1.3872, -2.5629, 1.4541, 0.1179]];

#[test]
fn the_best_solutions_are_one_for_each_arc() {
    let arm = panda();
    let (pose, target) = arm.target(&READY);
    let limits = arm.solver.limits();
    let arcs = arm.solver.arcs(&target, &limits).unwrap().arcs;
    for criterion in [Criterion::Margin, Criterion::nearest(READY.to_vec())] {
        let found = arm.solver.best_by_arc(&target, &limits, &criterion).unwrap();
        assert_eq!((found.best.len(), &found.absence, found.is_unsure), (arcs.len(), &None, false));
        let mut numbers: Vec<usize> = found.best.iter().map(|best| best.arc).collect();
        numbers.sort_unstable();
        assert_eq!(numbers, (0..arcs.len()).collect::<Vec<_>>());
        assert_eq!(Some(&found.best[0]), arm.solver.best(&target, &limits, &criterion).unwrap().as_ref());
        let sign = if criterion.is_least_best() { 1.0 } else { -1.0 };
        assert!(found.best.windows(2).all(|pair| sign * pair[0].value <= sign * pair[1].value), "{found:?}");
        for best in &found.best {
            arm.assert_solves(&pose, &best.q);
            let at = arm.solver.at(&target, &limits, &arcs[best.arc], best.s).unwrap();
            assert!(best.q.iter().zip(&at).all(|(a, b)| (a - b).abs() < 1e-6), "{best:?}");
        }
    }
}

#[test]
fn batches_have_the_results_of_single_targets() {
    let arm = panda();
    let mut targets: Vec<_> = VECTORS.iter().map(|q| arm.target(q).1).collect();
    targets.insert(1, arm.solver.target(Pose::translation(3.0, 0.0, 0.0)).unwrap());
    let limits = arm.solver.limits();
    let within = arm.solver.any_within_batch(&targets, &limits, None).unwrap();
    let best = arm.solver.best_by_arc_batch(&targets, &limits, &[Criterion::Margin], None).unwrap();
    for ((target, within), best) in targets.iter().zip(&within).zip(&best) {
        assert_eq!(within.as_ref().unwrap(), &arm.solver.any_within(target, &limits).unwrap());
        assert_eq!(best.as_ref().unwrap(), &arm.solver.best_by_arc(target, &limits, &Criterion::Margin).unwrap());
    }
    assert_eq!(within[1].as_ref().unwrap().absence, Some(Absence::Unreachable));
    let targets: Vec<_> = VECTORS.iter().map(|q| arm.target(q).1).collect();
    let criteria = VECTORS.map(|q| Criterion::nearest(q.to_vec()));
    for found in arm.solver.best_by_arc_batch(&targets, &limits, &criteria, None).unwrap() {
        assert!(found.unwrap().best[0].value < 1e-7);
    }
}

#[test]
fn a_batch_is_cancelled_and_refuses_criteria_that_do_not_fit() {
    let arm = panda();
    let targets = VECTORS.map(|q| arm.target(&q).1);
    let limits = arm.solver.limits();
    let watch = Watch::none().with_time(std::time::Duration::ZERO);
    assert_eq!(arm.solver.any_within_batch(&targets, &limits, &watch).unwrap_err().kind(), ErrorKind::Budget);
    for criteria in [vec![], vec![Criterion::Margin; 2], vec![Criterion::nearest(vec![0.0; 6])]] {
        let refused = arm.solver.best_by_arc_batch(&targets, &limits, &criteria, None).unwrap_err();
        assert_eq!(refused.kind(), ErrorKind::BadValue, "{refused}");
    }
}

/// A residual compares the tip at joint values with the target: zero for a solution, and the shift of the position for a moved target.
#[test]
fn residuals_are_those_of_the_equations() {
    let arm = panda();
    let (pose, target) = arm.target(&READY);
    assert!(arm.solver.residual(&target, &READY) < 1e-12);
    let moved = arm.solver.target(Pose::translation(0.0, 0.0, 0.01) * pose).unwrap();
    assert!(arm.solver.residual(&moved, &READY) > 1e-4);
    assert!(arm.solver.residual(&target, &READY[..6]).is_nan());
}
