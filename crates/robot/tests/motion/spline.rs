//! Splines through knots.

use groebot_robot::motion::Spline;

use crate::dynamics::samples::near;

#[test]
fn splines_go_through_their_knots_smoothly() {
    let times = vec![0.0, 0.5, 1.2, 2.0];
    let places = vec![vec![0.0, 1.0], vec![0.7, 0.2], vec![-0.3, 0.4], vec![0.1, 0.0]];
    let spline = Spline::through(times.clone(), places.clone()).unwrap();
    for (time, place) in times.iter().zip(&places) {
        near(&spline.at(*time)[0], place, 1e-14, "knot");
        let (before, behind) = (spline.at(time - 1e-9), spline.at(time + 1e-9));
        if *time > 0.0 && *time < 2.0 {
            near(&before[1], &behind[1], 1e-6, "rate");
            near(&before[2], &behind[2], 1e-6, "change");
        }
    }
    let step = 1e-5;
    let (ahead, here, behind) = (spline.at(0.8 + step), spline.at(0.8), spline.at(0.8 - step));
    let rate: Vec<f64> = (0..2).map(|i| (ahead[0][i] - behind[0][i]) / (2.0 * step)).collect();
    let change: Vec<f64> = (0..2).map(|i| (ahead[1][i] - behind[1][i]) / (2.0 * step)).collect();
    near(&here[1], &rate, 1e-8, "rate");
    near(&here[2], &change, 1e-8, "change");
    near(&spline.at(0.0)[2], &[0.0, 0.0], 1e-14, "natural");
    // Between knots with position, velocity and acceleration the polynomial has degree five.
    let fifth = |t: f64| [vec![t.powi(5)], vec![5.0 * t.powi(4)], vec![20.0 * t.powi(3)]];
    let exact = Spline::new(vec![0.0, 2.0], vec![fifth(0.0), fifth(2.0)]).unwrap();
    (0..3).for_each(|which| near(&exact.at(0.7)[which], &fifth(0.7)[which], 1e-13, "fifth"));
    assert!(Spline::through(vec![0.0, 0.0], places[..2].to_vec()).is_err());
    assert!(Spline::through(vec![0.0], places[..1].to_vec()).is_err());
    assert!(Spline::through(vec![0.0, 1.0], vec![vec![f64::NAN], vec![0.0]]).is_err());
}
