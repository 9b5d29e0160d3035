//! Velocities, accelerations and checks of trajectories.

use groebot_robot::ErrorKind;
use groebot_robot::motion::{Bounds, Fault, Finding, Trajectory, findings};

use super::sample;

/// For a parabola both are exact at inner samples, for any times.
#[test]
fn a_parabola_has_its_slope_and_curvature() {
    let (a, b, c) = (0.3, -1.2, 0.7);
    let times = vec![0.0, 0.1, 0.25, 0.3, 0.7];
    let mut path =
        Trajectory { times: times.clone(), joints: vec![sample().joints[0].clone()], ..Trajectory::default() };
    path.q = times.iter().map(|t| vec![a + b * t + c * t * t]).collect();
    path.check().unwrap();
    for (at, t) in times.iter().enumerate().take(4).skip(1) {
        assert!((path.rates(at)[0] - (b + 2.0 * c * t)).abs() < 1e-13);
        assert!((path.accelerations(at)[0] - 2.0 * c).abs() < 1e-12);
    }
    assert!((path.rates(0)[0] - (b + c * 0.1)).abs() < 1e-13, "the line to the neighbour");
    assert_eq!((path.accelerations(0), path.accelerations(4)), (vec![0.0], vec![0.0]));
    path.times.truncate(1);
    path.q.truncate(1);
    assert_eq!(path.rates(0), [0.0]);
}

#[test]
fn what_is_beyond_bounds_is_found() {
    let mut path = sample();
    let found = |path: &Trajectory, bounds: Bounds| findings(path, &bounds);
    // From 0.1 to 0.5 rad in 0.2 s is 2 rad/s.
    let fast = Bounds { speed_share: 1.001, ..Bounds::default() };
    assert_eq!(found(&path, fast), [Finding { sample: 2, fault: Fault::Margin { margin: -0.005 } }]);
    let lax = Bounds { margin: -1.0, ..fast };
    assert!(found(&path, lax).is_empty());
    let hasty = found(&path, Bounds { speed_share: 0.9, ..lax });
    let [Finding { sample: 2, fault: Fault::Speed { joint: 0, rate } }] = hasty[..] else { panic!("{hasty:?}") };
    assert!((rate - 2.0).abs() < 1e-12);
    path.q[1][1] = 1.5;
    assert_eq!(found(&path, lax)[0], Finding { sample: 1, fault: Fault::Limit { joint: 1, value: 1.5 } });
    path.joints.iter_mut().for_each(|joint| (joint.speed, joint.limits) = (None, None));
    let jumps: Vec<usize> = found(&path, lax).iter().map(|finding| finding.sample).collect();
    assert_eq!(jumps, [1, 2], "from 0.5 to 1.5 m and back");
}

#[test]
fn tracks_that_do_not_fit_are_refused() {
    type Change = fn(&mut Trajectory);
    let changes: [(&str, Change); 8] = [
        ("its time is not at least 1e-8 s after the previous one", |path| path.times[1] = 0.3),
        ("its time is not at least 1e-8 s after the previous one", |path| path.times[1] = f64::NAN),
        ("`joint values` has 2 values for 3 samples", |path| path.q.truncate(2)),
        ("1 values for 2 joints", |path| path.q[1].truncate(1)),
        ("`left` has 2 values", |path| path.contacts[0].stands.truncate(2)),
        ("`margin` has 4 values", |path| path.figures[0].values.push(1.0)),
        ("sample 2: a value is not finite", |path| path.points[0].at[1].x = f64::INFINITY),
        ("`base` has 1 values", |path| path.base.truncate(1)),
    ];
    for (words, change) in changes {
        let mut path = sample();
        path.check().unwrap();
        change(&mut path);
        let error = path.check().unwrap_err();
        assert!(error.kind() == ErrorKind::BadValue && error.message().contains(words), "{error}");
    }
    let mut path = sample();
    path.joints[1].name = "hip".into();
    assert_eq!(path.check().unwrap_err().kind(), ErrorKind::DuplicateName);
}
