//! A planar arm with two links, written by hand like a printed file, and its solutions.

use std::f64::consts::{PI, TAU};

use groebot_runtime::ordinary::{Candidate, Ordinary, Receiver};
use groebot_runtime::{
    Candidates, Error, Facts, Fixed, Found, Joint, Mechanism, Number, Pairs, Reached, Solution, Solve, With,
};

/// A planar arm with links of 1 m and 0.5 m: the tip is at `(c1 + c12 / 2, s1 + s12 / 2)`.
struct Arm;

const FACTS: Facts<'static> = Facts {
    inputs: 2,
    joints: &[Joint::Angle([0, 1]), Joint::Angle([2, 3])],
    last_first: &[0, 1],
    places: 4,
    size_of: &[0, 0],
    sizes: 1,
    compared: &[0, 1],
    candidates: 2,
    runs: &[1, 2],
    scale: 1.5,
    capacity: 2,
    isolated: Some(2),
    reached: &[Reached::Value(0), Reached::Value(1)],
    ..Facts::NONE
};

impl Mechanism for Arm {
    type Storage = Fixed<2, 2, 2, 4, 2, 1, 0, 2, 2, 12>;

    fn facts(&self) -> Facts<'_> {
        FACTS
    }

    fn parameters<N: Number>(&self, target: &[N; 2]) -> [N; 2]
    where
        f64: With<N>,
    {
        *target
    }

    fn walk<N: Number, C: Candidates<N, Self>>(&self, &[x, y]: &[N; 2], c: &mut C)
    where
        f64: With<N>,
    {
        let square = x * x + y * y;
        let c2 = square - 1.25;
        let roots = N::square_roots(c2 * c2 - 1.0, N::of(1.0));
        for (i, &s2) in roots.as_slice().iter().enumerate() {
            let (along, across) = (1.0 + 0.5 * c2, 0.5 * s2);
            let (c1, s1) = ((along * x + across * y) / square, (along * y - across * x) / square);
            c.finish(self, Found::first(i, 2).by_root(&roots, i), &[c1, s1, c2, s2]);
        }
    }

    fn tip<N: Number>(&self, &[c1, s1, c2, s2]: &[N; 4]) -> [N; 2]
    where
        f64: With<N>,
    {
        [c1 + 0.5 * (c1 * c2 - s1 * s2), s1 + 0.5 * (s1 * c2 + c1 * s2)]
    }

    fn sizes<N: Number>(&self, _: &[N; 2], _: &[N; 4]) -> [N; 1]
    where
        f64: With<N>,
    {
        [N::of(1.5)]
    }

    fn jacobian(&self, _: &[f64; 2], &[c1, s1, c2, s2]: &[f64; 4]) -> Option<[[f64; 2]; 2]> {
        let (c12, s12) = (0.5 * (c1 * c2 - s1 * s2), 0.5 * (s1 * c2 + c1 * s2));
        Some([[-s1 - s12, -s12], [c1 + c12, c12]])
    }
}

fn solutions(target: [f64; 2]) -> Vec<Solution<Arm>> {
    let mut out = [Solution::empty(&Arm); 2];
    let count = Arm.solve(&target, &mut out).unwrap();
    out[..count].to_vec()
}

#[test]
fn all_joint_values_that_reach_a_target_are_found() {
    let mut next = super::random();
    for _ in 0..10_000 {
        let q = [(next() - 0.5) * TAU, (next() - 0.5) * TAU];
        let target = Arm.forward(&q).unwrap();
        let found = solutions(target);
        assert!(found.iter().all(|answer| Arm.residual(&target, &answer.q) < 1e-14));
        let is_same = |a: f64, b: f64| (a - b).abs() < 1e-9 || (TAU - (a - b).abs()) < 1e-9;
        assert!(found.iter().any(|answer| is_same(answer.q[0], q[0]) && is_same(answer.q[1], q[1])), "{q:?} {found:?}");
    }
}

#[test]
fn edges_of_the_reach_have_one_answer_and_what_is_beyond_none() {
    let [only] = &solutions([1.5, 0.0])[..] else { panic!("the arm is straight there") };
    assert!(only.q[0].abs().max(only.q[1].abs()) < 1e-7 && only.is_isolated());
    assert_eq!(solutions([0.0, -0.5])[0].q[1].abs(), PI);
    assert!(solutions([2.0, 0.0]).is_empty() && solutions([0.1, 0.1]).is_empty());
    let mut out = [Solution::empty(&Arm); 2];
    assert_eq!(Arm.solve(&[f64::NAN, 0.0], &mut out), Err(Error::NotFinite));
    let (count, nearest) = Arm.solve_or_nearest(&[1.501, 0.0], &mut out).unwrap();
    assert!(count == 0 && nearest.is_none_or(|nearest| nearest.residual < 0.01));
}

#[test]
fn pairs_and_batches_are_single_solutions() {
    let mut next = super::random();
    let targets: Vec<[f64; 2]> = (0..100).map(|_| [3.2 * (next() - 0.5), 3.2 * (next() - 0.5)]).collect();
    let (mut out, mut counts) = (vec![Solution::empty(&Arm); 200], vec![Ok(0); 100]);
    assert_eq!(Arm.solve_batch(&targets, &mut out, &mut counts), 100);
    let mut rest = &out[..];
    for (target, count) in targets.iter().zip(&counts) {
        let alone = solutions(*target);
        assert_eq!((Ok(alone.len()), &rest[..alone.len()]), (*count, &alone[..]));
        rest = &rest[alone.len()..];
        let mut pairs = [Pairs::empty(&Arm); 2];
        assert_eq!(Arm.solve_pairs(target, &mut pairs), Ok(alone.len()));
        for (pairs, answer) in pairs.iter().zip(&alone) {
            for ([c, s], q) in pairs.joints.iter().zip(answer.q) {
                assert!((c - q.cos()).abs().max((s - q.sin()).abs()) < 1e-14);
            }
        }
    }
}

/// Branch, joint values and residual.
type Listed = (usize, [f64; 2], f64);

/// By target, its solutions if it is ordinary.
#[derive(Default)]
struct Collected(Vec<Option<Vec<Listed>>>);

impl Receiver<Arm> for Collected {
    fn take(&mut self, target: usize, candidates: impl ExactSizeIterator<Item = Candidate<Arm>>) {
        assert_eq!(self.0.len(), target);
        let solution = |one: Candidate<Arm>| one.is_real.then_some((one.branch, one.q, one.residual));
        self.0.push(Some(candidates.filter_map(solution).collect()));
    }

    fn leave(&mut self, target: usize) {
        assert_eq!(self.0.len(), target);
        self.0.push(None);
    }
}

#[test]
fn ordinary_targets_have_the_solutions_of_all_targets() {
    let mut next = super::random();
    let mut targets: Vec<[f64; 2]> = (0..3000).map(|_| [3.2 * (next() - 0.5), 3.2 * (next() - 0.5)]).collect();
    // From the edge of the reach inwards: the two solutions approach each other.
    let (random, depths) = (targets.len(), (1..160).map(|k| 10_f64.powf(-0.1 * f64::from(k))).collect::<Vec<f64>>());
    targets.extend(depths.iter().map(|depth| [1.5 - depth, 0.0]));
    targets.extend([[1.5, 0.0], [f64::NAN, 0.0], [0.0, 0.0]]);
    let (mut together, mut ordinary) = (Collected::default(), 0);
    Arm.solve_ordinary_batch(&targets, &mut together);
    assert_eq!(together.0.len(), targets.len());
    for (depth, found) in depths.iter().zip(&together.0[random..]) {
        // The elbow is at sqrt(6 depth). The least pivot, a third of that, must be 1e-4 of the greatest, so that rounding cannot have made two solutions of one.
        assert!(found.is_some() || *depth < 1e-7, "{depth:e}");
        assert!(found.is_none() || *depth > 1e-9, "{depth:e}");
    }
    for (target, found) in targets.iter().zip(together.0) {
        let mut alone = Collected::default();
        Arm.solve_ordinary(target, &mut alone);
        assert_eq!(alone.0, std::slice::from_ref(&found), "{target:?}");
        if let Some(found) = found {
            let all = solutions(*target).iter().map(|one| (one.branch, one.q, one.residual)).collect::<Vec<_>>();
            assert_eq!(found, all, "{target:?}");
            ordinary += 1;
        }
    }
    assert!(ordinary > 3000, "{ordinary}");
}

#[test]
fn turns_and_limits_move_answers() {
    let limits = [[-TAU, TAU], [0.0, f64::INFINITY]];
    let [first, second] = &solutions([1.0, 0.5])[..] else { panic!("two solutions") };
    assert_eq!((Arm.count_turns(&first.q, &limits), Arm.count_turns(&second.q, &limits)), (2, 3));
    let turned = Arm.turn(&first.q, &limits, 0);
    assert!(turned[1] >= 0.0 && ((turned[1] - first.q[1]) / TAU).fract().abs() < 1e-9);
    let mut out = [Solution::empty(&Arm); 2];
    assert_eq!(Arm.solve_within(&[1.0, 0.5], &[[-PI, PI], [0.0, PI]], &mut out), Ok(1));
    let list = solutions([1.0, 0.5]);
    let (index, near) = Arm.nearest(&list, &list[1].q, &[1.0, 1.0], &[[-9.0, 9.0]; 2]).unwrap();
    assert_eq!((index, near), (1, list[1].q));
}
