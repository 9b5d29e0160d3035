//! The walk from above: soles with the numbers of their steps, and the paths of centre of mass and zero moment point.

use nalgebra::{Point2, Vector2};

use super::{INNER, LEFT, Walk};
use crate::gait::biped::Biped;
use crate::gait::footprint::{Footprint, Side};
use groebot_robot::drawing::frame::Frame;
use groebot_robot::drawing::svg::{Svg, Swatch};
use groebot_robot::spatial::angle;

/// The greatest height of the view \[px\].
const MOST_HEIGHT: f64 = 640.0;
/// The margin around the soles \[px\].
const ROOM: f64 = 36.0;
/// Soles within this distance \[m\] and angle \[rad\] are drawn as one.
const SAME: (f64, f64) = (5e-4, 5e-3);
/// The opacity of the first sole; that of the last one is 1.
const PALEST: f64 = 0.4;
/// The width of a digit, and the height of a number \[px\].
const DIGIT: (f64, f64) = (6.8, 11.0);
/// The greatest number of steps that are listed one by one at one place.
const MOST_NUMBERS: usize = 5;
/// The number of places beside a sole, from its border outwards, that are tried for its number.
const PLACES_BESIDE: usize = 5;

/// Soles at one place, and the steps that land there; 0 is the start.
struct Sole {
    side: Side,
    print: Footprint,
    steps: Vec<usize>,
}

/// Draws the view with its title at `top` \[px\], and returns its lower end.
pub(super) fn draw(walk: &Walk, biped: &Biped, top: f64, svg: &mut Svg) -> f64 {
    let count = walk.schedule.route.steps.len();
    let title = format!("{}: {count} steps from above, forward to the right, left up", biped.name);
    svg.text("title", (LEFT, top + 12.0), &title);
    let legend = [
        (Swatch::Area, "left", "left sole"),
        (Swatch::Area, "right", "right sole"),
        (Swatch::Line, "com", "centre of mass"),
        (Swatch::Line, "zmp", "zero moment point"),
        (Swatch::None, "", "on each sole the number of its step, 0 at the start; later ones are darker"),
    ];
    svg.legend((LEFT, top + 32.0), &legend);
    let soles = soles(walk);
    let frame = around(soles.iter().flat_map(|sole| corners(biped, sole)), top + 42.0);
    frame.draw(("m", "m"), svg);
    for sole in &soles {
        let share = *sole.steps.last().unwrap_or(&0) as f64 / count.max(1) as f64;
        let corners = corners(biped, sole).into_iter().map(|corner| frame.at((corner.x, corner.y)));
        svg.polygon(sole.side.name(), PALEST + (1.0 - PALEST) * share, corners);
    }
    let path = |point: &Point2<f64>| frame.at((point.x, point.y));
    svg.line("zmp", walk.balances.iter().map(|balance| path(&balance.zmp)));
    svg.line("com", walk.balances.iter().map(|balance| path(&balance.pressure)));
    draw_numbers(biped, &soles, &frame, svg);
    frame.end()
}

/// The soles in the order of their first use; those at one place are one.
fn soles(walk: &Walk) -> Vec<Sole> {
    let route = &walk.schedule.route;
    let start = [(Side::Left, route.start[0], 0), (Side::Right, route.start[1], 0)];
    let steps = route.steps.iter().enumerate().map(|(place, step)| (step.side, step.print, place + 1));
    let mut soles: Vec<Sole> = Vec::new();
    for (side, print, step) in start.into_iter().chain(steps) {
        match soles.iter_mut().find(|sole| sole.side == side && is_same(&sole.print, &print)) {
            Some(sole) => sole.steps.push(step),
            None => soles.push(Sole { side, print, steps: vec![step] }),
        }
    }
    soles
}

fn is_same(a: &Footprint, b: &Footprint) -> bool {
    (a.point() - b.point()).norm() < SAME.0 && angle::difference(a.yaw, b.yaw).abs() < SAME.1
}

fn corners(biped: &Biped, sole: &Sole) -> Vec<Point2<f64>> {
    biped.sole_at(sole.side, &sole.print).corners().to_vec()
}

/// The frame at `top` that contains all `points`, with one scale for both axes.
fn around(points: impl Iterator<Item = Point2<f64>>, top: f64) -> Frame {
    let (mut low, mut high) = (Point2::new(f64::MAX, f64::MAX), Point2::new(f64::MIN, f64::MIN));
    for point in points {
        (low, high) = (low.inf(&point), high.sup(&point));
    }
    let size = high - low;
    let scale = ((INNER - 2.0 * ROOM) / size.x).min((MOST_HEIGHT - 2.0 * ROOM) / size.y);
    let room = Vector2::repeat(ROOM / scale);
    (low, high) = (low - room, high + room);
    let size = (high - low) * scale;
    Frame { corner: (LEFT, top), size: (size.x, size.y), low: (low.x, low.y), high: (high.x, high.y) }
}

/// Writes each sole's number where it overlaps no other: on the toes, or elsewhere with a line to the sole. The first
/// and the last soles are placed first; a number without room is omitted.
fn draw_numbers(biped: &Biped, soles: &[Sole], frame: &Frame, svg: &mut Svg) {
    let count = soles.len();
    let mut order: Vec<usize> = (0..count).collect();
    order.sort_by_key(|place| (2..count.saturating_sub(2).max(2)).contains(place));
    let mut taken: Vec<[f64; 4]> = Vec::new();
    for sole in order.into_iter().map(|place| &soles[place]) {
        let text = numbers(&sole.steps);
        let half = (DIGIT.0 * text.chars().count() as f64 / 2.0 + 1.5, DIGIT.1 / 2.0 + 1.0);
        let places = places(biped, sole, frame, half);
        let boxed = |(x, y): (f64, f64)| [x - half.0, x + half.0, y - half.1, y + half.1];
        let free =
            |at: &(f64, f64)| lies_within(boxed(*at), frame) && !taken.iter().any(|other| meet(boxed(*at), *other));
        let Some(at) = places.iter().copied().find(free) else { continue };
        taken.push(boxed(at));
        if at != places[0] {
            svg.line("leader", [places[0], at]);
        }
        svg.text(&format!("number {}-number", sole.side.name()), (at.0, at.1 + 4.0), &text);
    }
}

/// `3`, `3,5,7`, `3,5..19`.
fn numbers(steps: &[usize]) -> String {
    let list = |steps: &[usize]| steps.iter().map(usize::to_string).collect::<Vec<_>>().join(",");
    match steps {
        [first @ .., last] if steps.len() > MOST_NUMBERS => format!("{}..{last}", list(&first[..MOST_NUMBERS - 2])),
        _ => list(steps),
    }
}

/// The places for a number that is twice `half` wide and high \[px\], the best first: on the toes; beside them and
/// forward, at increasing distance; on the heel and in the middle.
fn places(biped: &Biped, sole: &Sole, frame: &Frame, half: (f64, f64)) -> Vec<(f64, f64)> {
    let metres = (frame.high.0 - frame.low.0) / frame.size.0;
    let outline = &biped.feet[sole.side as usize].corners;
    let range = |coordinate: fn(&Point2<f64>) -> f64| {
        let values = outline.iter().map(coordinate);
        (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max))
    };
    let ((back, front), (right, left)) = (range(|corner| corner.x), range(|corner| corner.y));
    let (middle, inset) = ((right + left) / 2.0, (half.0.max(half.1) + 2.0) * metres);
    let (sign, outer) = (sole.side.sign(), if sole.side == Side::Left { left } else { right });
    let farther = (0..PLACES_BESIDE).flat_map(|place| {
        let away = inset + 2.0 * half.1 * place as f64 * metres;
        [(front - inset, outer + sign * away), (front + away, middle)]
    });
    let toes = (front - inset, middle);
    let rest = [(back + inset, middle), ((front + back) / 2.0, middle)];
    let all = [toes].into_iter().chain(farther).chain(rest);
    all.map(|(x, y)| sole.print.carry(&Point2::new(x, y))).map(|point| frame.at((point.x, point.y))).collect()
}

fn meet(a: [f64; 4], b: [f64; 4]) -> bool {
    a[0] < b[1] && b[0] < a[1] && a[2] < b[3] && b[2] < a[3]
}

fn lies_within(boxed: [f64; 4], frame: &Frame) -> bool {
    let (x, y) = (frame.corner.0, frame.corner.1);
    boxed[0] > x && boxed[1] < x + frame.size.0 && boxed[2] > y && boxed[3] < y + frame.size.1
}
