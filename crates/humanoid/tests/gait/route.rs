use std::f64::consts::{FRAC_PI_2, PI};

use groebot_humanoid::ErrorKind;
use groebot_humanoid::gait::{Footprint, MAX_STEPS, Regular, Route, Side};
use proptest::prelude::*;

use super::{regular, request, walk};

#[test]
fn eight_steps_of_4_cm_lead_28_cm_ahead() {
    let route = Route::regular(&Regular { steps: 8, ..regular() }).unwrap();
    let ahead: Vec<f64> = route.steps.iter().map(|step| (step.print.x * 1e3).round()).collect();
    assert_eq!(ahead, [40.0, 80.0, 120.0, 160.0, 200.0, 240.0, 280.0, 280.0]);
    assert!(route.steps.iter().all(|step| step.print.y == step.side.sign() * 0.05 && step.print.yaw == 0.0));
    assert_eq!((route.steps[0].side, route.steps[1].side), (Side::Left, Side::Right));
}

#[test]
fn a_turn_is_shared_by_the_steps() {
    let route = Route::regular(&Regular { steps: 5, length: 0.0, turn: 0.4, ..regular() }).unwrap();
    let stands = route.stands();
    let last = stands[stands.len() - 1];
    assert!(last.iter().all(|print| (print.yaw - 0.4).abs() < 1e-15));
    assert!((last[0].middle(&last[1]).point().coords).norm() < 1e-15, "on the spot");
    let yaw: Vec<f64> = route.steps.iter().map(|step| (step.print.yaw * 1e3).round()).collect();
    assert_eq!(yaw, [100.0, 200.0, 300.0, 400.0, 400.0]);
}

proptest! {
    #![proptest_config(crate::cases(256))]

    /// The prints of a regular route are on both sides of a polygon with equal sides, and the last step closes the feet.
    #[test]
    fn regular_routes_close(steps in 1usize..30, length in -0.1..0.1f64, turn in -2.0..2.0f64, right: bool) {
        let first = if right { Side::Right } else { Side::Left };
        let route = Route::regular(&Regular { steps, length, aside: 0.0, turn, half_width: 0.05, first }).unwrap();
        let stands = route.stands();
        let [left, right] = stands[stands.len() - 1];
        prop_assert_eq!(route.steps.len(), steps);
        if steps > 1 {
            prop_assert!((nalgebra::distance(&left.point(), &right.point()) - 0.1).abs() < 1e-12);
            prop_assert!((left.yaw - turn).abs() < 1e-12 && (right.yaw - turn).abs() < 1e-12);
        }
    }
}

#[test]
fn side_steps_move_sideways_and_close() {
    for (aside, first) in [(0.01, Side::Left), (-0.01, Side::Right), (0.01, Side::Right)] {
        let route = Route::regular(&Regular { steps: 8, length: 0.0, aside, first, ..regular() }).unwrap();
        let [left, right] = route.stands().pop().unwrap();
        let leading = route.steps[..7].iter().filter(|step| step.side.sign() == aside.signum()).count();
        let total = leading as f64 * aside;
        assert!((left.y - 0.05 - total).abs() < 1e-12 && (right.y + 0.05 - total).abs() < 1e-12, "{aside}");
        // With the published 50 mm the AnkleRoll of the swing foot is near its limit; 40 mm leave a margin.
        let mut requested = groebot_humanoid::gait::Request { route, ..request(&regular()) };
        requested.style.amplitude = 0.04;
        super::nao::feet_are_where_they_should_be(&walk(&requested).unwrap());
    }
}

#[test]
fn footprints_compose() {
    let print = Footprint { x: 1.0, y: 2.0, yaw: FRAC_PI_2 };
    let there = print.then(&Footprint { x: 0.5, y: 0.25, yaw: 0.1 });
    assert!((there.x - 0.75).abs() < 1e-15 && (there.y - 2.5).abs() < 1e-15 && there.yaw == FRAC_PI_2 + 0.1);
    let (a, b) = (Footprint { yaw: 3.0, ..Default::default() }, Footprint { yaw: -3.0, ..Default::default() });
    assert!((a.middle(&b).yaw - PI).abs() < 1e-12, "the shorter rotation");
}

#[test]
fn footsteps_are_read_from_csv() {
    let text = "# a curve\nfoot, x, y, yaw\n\nright,0.03,-0.05,0\nleft,0.05,0.05,0.05\nright, 0.06,-0.048,0.05\n";
    let route = Route::from_csv(text, 0.05).unwrap();
    for ends in ["\r\n", "\r"] {
        assert_eq!(Route::from_csv(&text.replace('\n', ends), 0.05), Ok(route.clone()), "{ends:?}");
    }
    assert_eq!((route.steps.len(), route.steps[0].side), (3, Side::Right));
    assert_eq!(route.steps[1].print, Footprint { x: 0.05, y: 0.05, yaw: 0.05 });
    assert_eq!(route.start[1], Footprint { y: -0.05, ..Default::default() });
    let walked = walk(&groebot_humanoid::gait::Request { route, ..request(&regular()) }).unwrap();
    super::nao::feet_are_where_they_should_be(&walked);
}

#[test]
fn bad_footsteps_are_refused_with_their_line() {
    let refused = [
        ("", 1, ErrorKind::Syntax),
        ("foot,x,y\nleft,0,0\n", 1, ErrorKind::Syntax),
        ("foot,x,y,yaw\nleft,0,0.05\n", 2, ErrorKind::Syntax),
        ("foot,x,y,yaw\nleft,0,0.05,zero\n", 2, ErrorKind::Syntax),
        ("foot,x,y,yaw\nleft,0,0.05,nan\n", 2, ErrorKind::Syntax),
        ("foot,x,y,yaw\n# no\nhand,0,0.05,0\n", 3, ErrorKind::Syntax),
        ("foot,x,y,yaw\nleft,0,0.05,0\nleft,0.1,0.05,0\n", 3, ErrorKind::BadValue),
    ];
    for (text, line, kind) in refused {
        let error = Route::from_csv(text, 0.05).unwrap_err();
        assert_eq!((error.kind(), error.place().line), (kind, Some(line)), "{error}");
    }
    assert_eq!(Route::from_csv("foot,x,y,yaw\n", 0.05).unwrap_err().kind(), ErrorKind::BadValue);
    assert!(Route::from_csv("foot,x,y,yaw\nleft,1e9,0,0\n", 0.05).is_err());
    for bad in [
        Regular { steps: 0, ..regular() },
        Regular { steps: MAX_STEPS + 1, ..regular() },
        Regular { length: f64::NAN, ..regular() },
        Regular { length: 1e6, ..regular() },
        Regular { aside: f64::NAN, ..regular() },
        Regular { turn: f64::INFINITY, ..regular() },
        Regular { half_width: 0.0, ..regular() },
    ] {
        assert_eq!(Route::regular(&bad).unwrap_err().kind(), ErrorKind::BadValue);
    }
}
