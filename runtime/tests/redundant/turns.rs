//! Solutions and arcs that differ by whole turns, where a joint has a range of more than one turn.

use std::f64::consts::{PI, TAU};

use groebot_runtime::redundant::{Arc, Limits, Q, Span, arcs, sample, sample_from};

use super::planar::{ANY, Planar, tip};

/// Whether values are those of another list up to whole turns.
fn are_turned(a: &Q, b: &Q) -> bool {
    a.iter().zip(b).all(|(a, b)| ((a - b) / TAU - ((a - b) / TAU).round()).abs() < 1e-9)
}

#[test]
fn all_turns_of_a_solution() {
    let mut limits: Limits = [ANY; 7];
    (limits[0], limits[1], limits[2]) = ([-4.0 * PI, 4.0 * PI], [-0.5 * PI, 3.0 * PI], [-1.0, 1.0]);
    let robot = Planar::new(limits);
    let q = [0.3, 0.5, 0.2, 0.0, 0.0, 0.0, 0.0];
    let within = |i: usize| {
        (-9..=9).map(|k| q[i] + TAU * f64::from(k)).filter(|x| (limits[i][0]..=limits[i][1]).contains(x)).count()
    };
    let expected = within(0) * within(1) * within(2);
    let span = Span::of(&q);
    assert_eq!((span.count_turns(&robot.0, &limits), expected), (8, 8));
    let turns: Vec<Q> = (0..expected).map(|index| span.turn(&robot.0, &limits, index)).collect();
    for (k, turn) in turns.iter().enumerate() {
        assert!(are_turned(turn, &q) && turns[..k].iter().all(|other| other != turn), "{turns:?}");
        assert!((0..3).all(|i| (limits[i][0]..=limits[i][1]).contains(&turn[i])), "{turn:?}");
    }
    limits[2] = [0.3, 1.0];
    assert_eq!(span.count_turns(&robot.0, &limits), 0);
}

/// With the tip near the first axis, every link turns completely: the first joint passes a whole turn along a closed curve.
#[test]
fn all_turns_of_an_arc() {
    for (most, copies) in [(PI, 0), (1.5 * PI, 1), (4.0 * PI, 3), (6.0 * PI, 5)] {
        let mut limits: Limits = [ANY; 7];
        limits[0] = [-most, most];
        let robot = Planar::new(limits);
        let mut target = [0.0; 12];
        (target[0], target[1]) = (0.08, 0.06);
        let mut out = [Arc::NONE; 8];
        let outcome = arcs(&robot, &target, &limits, &mut out).unwrap();
        assert!(outcome.count == 2 && outcome.closed == 2 && !outcome.is_unsure, "{outcome:?}");
        for arc in &out[..2] {
            let span = Span::along(&robot.0, &target, &limits, arc).unwrap();
            assert!((span.high[0] - span.low[0] - TAU).abs() < 1e-6, "{span:?}");
            let count = span.count_turns(&robot.0, &limits);
            assert!(count == copies || most == 1.5 * PI && count == 0, "{most} {count}");
            let mut list = [[0.0; 7]; 400];
            sample(&robot.0, &target, &limits, arc, &mut list).unwrap();
            for index in 0..count {
                let start = span.turn(&robot.0, &limits, index);
                assert!(are_turned(&start, &arc.start.q), "{start:?}");
                let mut turned = [[0.0; 7]; 400];
                sample_from(&robot.0, &target, &limits, (arc, &start), &mut turned).unwrap();
                assert_eq!(turned[0], start);
                for (a, b) in turned.iter().zip(&list) {
                    assert!(are_turned(a, b) && a[0].abs() <= most + 1e-9, "{a:?} {b:?}");
                    let [x, y] = tip(a);
                    assert!((x - 0.08).abs() < 1e-9 && (y - 0.06).abs() < 1e-9, "{a:?}");
                }
                assert!(turned.windows(2).all(|pair| (0..3).all(|i| (pair[1][i] - pair[0][i]).abs() < 0.2)));
                assert!((turned[399][0] - start[0]).abs() > TAU - 1e-6);
            }
        }
    }
}
