//! The rows of joint values printed in RH0: Fig. 5-16 (and 5-22), Fig. 6-5 (and 6-10). The numbers are test data in `tests/corpus/rh0`.
//!
//! Two parameters are fitted. The trunk descends by a constant length per sample, so that 1 - cos q2 grows at a constant rate. The rate and the start of the
//! descent are computed from two rows each. All other values follow from the walk itself.

use groebot_humanoid::gait::{GaitDefaults, Walk};
use groebot_humanoid::walkers::{RH0_EXPERIMENT, RH0_SIMULATION};

use super::rh0::{LINE, request, walker};

/// Thigh and shank of RH0 \[m\], as inferred in `crates/robot/src/robots/data/`.
const SEGMENT: f64 = 0.28;

#[test]
fn the_currents_of_figure_6_5_are_those_of_one_leg() {
    let (names, rows) = table(include_str!("../../../../tests/corpus/rh0/fig_6_5_currents.csv"));
    assert_eq!((rows.len(), names[0].as_str(), names[6].as_str()), (7, "q1", "q12"));
    // Columns 1 to 6 are the right leg from the foot up, 7 to 12 the left one: exact negatives in all 42 pairs.
    rows.iter().for_each(|row| (0..6).for_each(|joint| assert_eq!(row[joint], -row[joint + 6])));
    assert_eq!(rows.iter().flatten().filter(|current| **current != 0.0).count(), 70);
}

/// The names of the columns, and the rows.
fn table(text: &str) -> (Vec<String>, Vec<Vec<f64>>) {
    let mut lines = text.lines();
    let header = lines.next().unwrap().split(',').map(str::to_owned).collect();
    (header, lines.map(|line| line.split(',').map(|field| field.parse().unwrap()).collect()).collect())
}

/// 1 - cos q2 in a row.
fn depth(q2: f64) -> f64 {
    1.0 - q2.to_radians().cos()
}

/// A walk with the words `text` whose trunk descends from straight legs: 1 - cos q2 grows by `rate` per sample, in `samples` samples.
fn lowered(defaults: &GaitDefaults, text: &str, rate: f64, samples: usize) -> Walk {
    let crouch = defaults.upright_hip - 2.0 * SEGMENT * rate * (samples - 1) as f64;
    let mut request = request(defaults, text, crouch, true);
    request.durations.lower = Some(request.tick * samples as f64);
    let (robot, legs) = walker();
    let lower = groebot_humanoid::gait::plan(robot, legs, &request, &groebot_humanoid::Watch::none()).unwrap();
    assert_eq!(lower.schedule.phases[0].samples, samples);
    lower
}

/// The rows of a walk in the thesis' columns.
fn rows(walk: &Walk) -> (Vec<String>, Vec<Vec<f64>>) {
    table(&walk.to_thesis_csv(&walker().0).unwrap())
}

#[test]
fn figure_5_16_comes_out() {
    let (names, printed) = table(include_str!("../../../../tests/corpus/rh0/fig_5_16.csv"));
    let q2 = names.iter().position(|name| name == "q2").unwrap();
    let depths: Vec<f64> = printed.iter().map(|row| depth(row[q2])).collect();
    // The start of the descent: by the line through the first row that is not zero and the last one.
    let slope = (depths[13] - depths[2]) / 11.0;
    let start = 2.0 - depths[2] / slope;
    assert!((start - 1.0).abs() < 2e-3, "it starts from sample 1: {start}");
    // With that start, the rate is the mean of the rates of the last two rows.
    let rate = (depths[12] / 11.0 + depths[13] / 12.0) / 2.0;
    let walk = lowered(&RH0_SIMULATION, LINE, rate, 81);
    let height = walk.motion.centres[81].z - walker().0.feet[0].ankle_height;
    assert_eq!((height * 1e3).round(), 580.0, "H_CM of RH0 5.3.1: {height}");
    let (ours, rows) = rows(&walk);
    let mut compared = 0;
    for (printed, row) in printed.iter().zip(&rows) {
        for (name, value) in names.iter().zip(printed) {
            let column = ours.iter().position(|other| other == name).unwrap();
            assert!((row[column] - value).abs() < 1e-3, "t = {}, {name}: {} {value}", printed[0], row[column]);
            compared += usize::from(*value != 0.0 && name != "t");
        }
    }
    // 12 rows of q2, q3, q4 and of q11, q10, q9: 36 values, twice.
    assert_eq!(compared, 72);
    // The feet are at 112 mm to each side, as in the lower table of the figure.
    let at = |name: &str| rows[13][ours.iter().position(|other| other == name).unwrap()];
    assert_eq!((at("X_right_foot"), at("X_left_foot"), at("Y_left_foot")), (-0.112, 0.112, 0.0));
}

#[test]
fn figure_6_5_comes_out() {
    let (names, printed) = table(include_str!("../../../../tests/corpus/rh0/fig_6_5.csv"));
    let q2 = names.iter().position(|name| name == "q2").unwrap();
    let depths: Vec<f64> = printed.iter().map(|row| depth(row[q2])).collect();
    // The rate between the first and the last row gives the number of samples before the first one: 268.
    let count = (depths[0] / ((depths[2] - depths[0]) / 2.0)).round() as usize;
    assert_eq!(count, 268);
    let rate = (depths[0] / count as f64 + depths[2] / (count + 2) as f64) / 2.0;
    // Three rows later its depth is that of the crouch in Fig. 5-16, 80 times its rate.
    let walk = lowered(&RH0_EXPERIMENT, "turn left 10", rate, count + 4);
    let height = walk.motion.centres[count + 4].z - walker().0.feet[0].ankle_height;
    assert_eq!((height * 1e3).round(), 580.0, "H_CM of RH0 6.2.1: {height}");
    let (ours, rows) = rows(&walk);
    for (printed, row) in printed.iter().zip(&rows[count + 1..]) {
        for (name, value) in names.iter().zip(printed) {
            let column = ours.iter().position(|other| other == name).unwrap();
            // q3 and q10 are printed with at most three decimals, the others with four.
            let precision = if name == "q3" || name == "q10" { 5e-4 } else { 5e-5 };
            assert!((row[column] - value).abs() <= precision * 1.001, "{name}: {} {value}", row[column]);
        }
    }
}
