//! The dynamic margin over time: the distance of the zero moment point from the border of the support polygon, with the
//! single support phases.

use super::{INNER, LEFT, Walk};
use crate::gait::footprint::Side;
use crate::gait::schedule::Action;
use crate::gait::summary::least_margin;
use groebot_robot::drawing::frame::Frame;
use groebot_robot::drawing::svg::{Svg, Swatch};

/// The height of the panel \[px\].
const HEIGHT: f64 = 200.0;
/// The width of a digit of a step's number \[px\].
const DIGIT: f64 = 6.8;

/// A single support phase: from the last instant with both feet in contact to the first one with both again.
struct Alone {
    side: Side,
    /// The number of the step, from 1.
    step: usize,
    /// Start and end \[s\].
    times: (f64, f64),
}

/// Draws the panel with its title at `top` \[px\], and returns its lower end.
pub(super) fn draw(walk: &Walk, top: f64, svg: &mut Svg) -> f64 {
    svg.text(
        "title",
        (LEFT, top + 12.0),
        "margin of the zero moment point: its distance from the border of the support polygon",
    );
    let required = format!("required: {:.1} mm", 1e3 * walk.request.margin);
    let legend = [
        (Swatch::Line, "margin", "margin, RH0 (3-5)"),
        (Swatch::Line, "limit", required.as_str()),
        (Swatch::Area, "left-stands", "the left foot supports alone in the swing of step n"),
        (Swatch::Area, "right-stands", "the right one"),
        (Swatch::Area, "both-stand", "double support"),
    ];
    svg.legend((LEFT, top + 32.0), &legend);
    let margins: Vec<f64> = walk.balances.iter().map(|balance| 1e3 * balance.margin).collect();
    let frame = around(walk, &margins, top + 42.0);
    draw_alone(walk, &frame, svg);
    frame.draw(("s", "mm"), svg);
    let level = |value: f64| [frame.at((frame.low.0, value)), frame.at((frame.high.0, value))];
    svg.line("zero", level(0.0));
    svg.line("limit", level(1e3 * walk.request.margin));
    svg.line("margin", margins.iter().enumerate().map(|(sample, margin)| frame.at((walk.time(sample), *margin))));
    mark_least(walk, &frame, svg);
    frame.end()
}

/// The frame of the panel: from zero, or below it, to a little above the greatest margin \[mm\].
fn around(walk: &Walk, margins: &[f64], top: f64) -> Frame {
    let greatest = margins.iter().copied().fold(1e3 * walk.request.margin, f64::max);
    let least = margins.iter().copied().fold(0.0, f64::min);
    let (room, end) = (0.12 * (greatest - least).max(1.0), walk.time(margins.len() - 1));
    let (low, high) = ((0.0, least - room), (end.max(walk.schedule.tick), greatest + 1.5 * room));
    Frame { corner: (LEFT, top), size: (INNER, HEIGHT), low, high }
}

/// Shades the single support phases, with the number of the step where there is room for it.
fn draw_alone(walk: &Walk, frame: &Frame, svg: &mut Svg) {
    let mut written = f64::NEG_INFINITY;
    for alone in times_alone(walk) {
        let [(from, top), (to, _)] = [alone.times.0, alone.times.1].map(|time| frame.at((time, frame.high.1)));
        svg.rectangle(&format!("{}-stands", alone.side.name()), (from, top), (to - from, frame.size.1));
        let (text, middle) = (alone.step.to_string(), (from + to) / 2.0);
        let half = DIGIT * text.len() as f64 / 2.0 + 2.0;
        if middle - half > written {
            svg.text(&format!("number {}-number", alone.side.other().name()), (middle, top + 13.0), &text);
            written = middle + half;
        }
    }
}

/// The single support phases in order.
fn times_alone(walk: &Walk) -> Vec<Alone> {
    let mut found: Vec<Alone> = Vec::new();
    let mut stood = None;
    for (sample, reference) in walk.references.iter().enumerate() {
        let side = match (reference.stands, walk.schedule.phases[reference.phase].action) {
            ([true, false], Action::Swing(step)) => Some((Side::Left, step + 1)),
            ([false, true], Action::Swing(step)) => Some((Side::Right, step + 1)),
            _ => None,
        };
        if let (Some((side, step)), None) = (side, stood) {
            let from = walk.time(sample.saturating_sub(1));
            found.push(Alone { side, step, times: (from, from) });
        }
        if let (Some(alone), true) = (found.last_mut(), side.is_some() || stood.is_some()) {
            alone.times.1 = walk.time(sample);
        }
        stood = side;
    }
    found
}

/// Marks the least margin, with the text of the summary.
fn mark_least(walk: &Walk, frame: &Frame, svg: &mut Svg) {
    let least = least_margin(walk);
    let (x, y) = frame.at((least.time, 1e3 * least.value));
    svg.add(format_args!(r#"<circle class="least" cx="{x:.1}" cy="{y:.1}" r="4"/>"#));
    let is_late = x > LEFT + INNER / 2.0;
    let (class, aside) = if is_late { ("least end", -7.0) } else { ("least", 7.0) };
    let text = format!("least: {:.1} mm at {:.2} s", 1e3 * least.value, least.time);
    let levels = [0.0, 1e3 * walk.request.margin].map(|value| frame.at((0.0, value)).1);
    // Below the mark, or below the zero line where a grid line would cross the text.
    let is_crossed = |base: f64| levels.iter().any(|level| (base - 13.0..base + 5.0).contains(level));
    let base = [y + 15.0, levels[0].max(y) + 14.0].into_iter().find(|base| !is_crossed(*base));
    svg.text(class, (x + aside, base.unwrap_or(y + 15.0)), &text);
}
