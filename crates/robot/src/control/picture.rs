//! Pictures of a tracked motion: errors and torques over time.

use super::Sample;
use crate::drawing::frame::Frame;
use crate::drawing::svg::{Svg, Swatch};

const WIDTH: f64 = 1000.0;
const LEFT: f64 = 70.0;
const HEIGHT: f64 = 220.0;
const GAP: f64 = 20.0;
/// Smaller errors are drawn at this value.
const LEAST: f64 = 1e-8;
/// Line colours. This is the maximum number of different lines.
const COLOURS: [&str; 8] = ["#1f5f9e", "#b05a00", "#2f8f4e", "#b0126f", "#6b4fa0", "#7a6a1f", "#3aa0a0", "#444444"];

/// Errors and torques of all joints over time, as SVG. `names` are the joint names.
pub fn errors_and_torques(samples: &[Sample], names: &[String]) -> String {
    let mut svg = Svg::default();
    let errors = |joint: usize| samples.iter().map(move |sample| 1e3 * (sample.q[joint] - sample.desired[joint]));
    let torques = |joint: usize| samples.iter().map(move |sample| sample.torques[joint]);
    let end = panel(&mut svg, GAP, "errors: actual minus desired values", "mrad, mm", samples, names, errors);
    let end = panel(&mut svg, end + GAP, "torques and forces", "N m, N", samples, names, torques);
    svg.finish(WIDTH, end + GAP)
}

/// The largest error of each run over time on a logarithmic scale, as SVG. Each run has a name.
pub fn greatest_errors(runs: &[(&str, &[Sample])]) -> String {
    let mut svg = Svg::default();
    let greatest = |sample: &Sample| {
        let errors = sample.q.iter().zip(&sample.desired).map(|(q, desired)| (q - desired).abs());
        errors.fold(LEAST, f64::max).log10()
    };
    let lines: Vec<Vec<(f64, f64)>> =
        runs.iter().map(|(_, run)| run.iter().map(|sample| (sample.time, greatest(sample))).collect()).collect();
    let all = || lines.iter().flatten();
    let (low, high) = all().fold((0.0, LEAST.log10()), |(low, high), (_, y)| (f64::min(low, *y), f64::max(high, *y)));
    let end = all().fold(1e-9, |end, (x, _)| f64::max(end, *x));
    svg.text("title", (LEFT, GAP + 12.0), "the greatest error of all joints");
    let frame = Frame {
        corner: (LEFT, GAP + 42.0),
        size: (WIDTH - LEFT - GAP, 1.5 * HEIGHT),
        low: (0.0, low.floor()),
        high: (end, high.ceil()),
    };
    frame.draw(("s", "log rad"), &mut svg);
    for (number, ((name, _), line)) in runs.iter().zip(lines).enumerate() {
        let class = format!("joint\" style=\"stroke: {}", COLOURS[number % COLOURS.len()]);
        svg.line(&class, line.into_iter().map(|point| frame.at(point)));
        svg.legend((LEFT + 180.0 * number as f64, GAP + 26.0), &[(Swatch::Line, &class, name)]);
    }
    svg.finish(WIDTH, frame.end() + GAP)
}

/// Draws one panel below `top` \[px\]. Returns its lower end \[px\].
fn panel<I: Iterator<Item = f64>>(
    svg: &mut Svg,
    top: f64,
    title: &str,
    unit: &str,
    samples: &[Sample],
    names: &[String],
    values: impl Fn(usize) -> I,
) -> f64 {
    svg.text("title", (LEFT, top + 12.0), title);
    let all = (0..names.len()).flat_map(&values);
    let (low, high) = all.fold((0.0, 0.0), |(low, high): (f64, f64), value| (low.min(value), high.max(value)));
    let workspace = 0.05 * (high - low).max(1e-12);
    let end = samples.last().map_or(1.0, |sample| sample.time);
    let frame = Frame {
        corner: (LEFT, top + 42.0),
        size: (WIDTH - LEFT - GAP, HEIGHT),
        low: (0.0, low - workspace),
        high: (end.max(1e-9), high + workspace),
    };
    frame.draw(("s", unit), svg);
    for (joint, name) in names.iter().enumerate() {
        let colour = COLOURS[joint % COLOURS.len()];
        let class = format!("joint\" style=\"stroke: {colour}");
        let points = samples.iter().zip(values(joint)).map(|(sample, value)| frame.at((sample.time, value)));
        svg.line(&class, points);
        let shown: String = name.chars().take(16).collect();
        svg.legend(
            (LEFT + 150.0 * (joint % 6) as f64, top + 26.0 + 12.0 * (joint / 6) as f64),
            &[(Swatch::Line, &class, &shown)],
        );
    }
    frame.end()
}
