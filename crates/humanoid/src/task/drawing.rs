//! A plan as an SVG picture: the map from above with the path, the footsteps, the body at its rests and the path of the
//! centre of mass.

use std::collections::HashSet;

use nalgebra::{Point2, Vector2};

use super::course::Blocked;
use super::floor::Floor;
use super::pilot::Pilot;
use super::plan::Plan;
use crate::gait::Side;
use crate::nav::{Cell, Map};
use groebot_robot::drawing::frame::Frame;
use groebot_robot::drawing::svg::{Svg, Swatch};

/// The width of the picture, the left edge of its frame, and the greatest width and height of the frame \[px\].
const WIDTH: f64 = 1200.0;
const LEFT: f64 = 60.0;
const MOST: (f64, f64) = (WIDTH - LEFT - 24.0, 900.0);
/// The upper edge of the frame \[px\].
const TOP: f64 = 60.0;

const STYLE: &str = "<style>
.wall { fill: #555; stroke: #555; stroke-width: 0.6 } .near { fill: #e4dccf; stroke: #e4dccf; stroke-width: 0.6 }
.path { stroke: #2a7d46; stroke-width: 2; stroke-dasharray: 7 4 } .body { fill: none; stroke: #999; stroke-width: 0.8 }
.goal { fill: #2a7d46 } .start { fill: #444 } .closed { fill: #f0b8a8; stroke: #f0b8a8; stroke-width: 0.6 }
</style>";

impl Plan {
    /// The plan of a pilot on its floor as SVG, in the axes of the map's world. Metres.
    pub fn to_svg(&self, pilot: &Pilot, floor: &Floor) -> String {
        let place = self.course.goal.place;
        let steps = self.walk.schedule.route.steps.len();
        let title = format!("{}: {steps} steps to ({:.2}, {:.2})", pilot.walker().biped.name, place.x, place.y);
        let legend = [
            (Swatch::Line, "path", "path"),
            (Swatch::Area, "left", "left sole"),
            (Swatch::Area, "right", "right sole"),
            (Swatch::Line, "body", "body at rest"),
            (Swatch::Line, "com", "centre of mass"),
        ];
        let (frame, mut svg) = begun(&title, &legend, floor, &[]);
        self.draw_walk(pilot, &frame, &mut svg);
        svg.finish(WIDTH, frame.end() + 18.0)
    }

    fn draw_walk(&self, pilot: &Pilot, frame: &Frame, svg: &mut Svg) {
        let line =
            |points: &mut dyn Iterator<Item = Point2<f64>>| points.map(|at| page(frame, &at)).collect::<Vec<_>>();
        let (biped, route) = (&pilot.walker().biped, &self.walk.schedule.route);
        let rests = route.rests.iter().map(|rest| pilot.outline_at(rest));
        for outline in rests {
            let closed = outline.corners().iter().chain(outline.corners().first()).copied();
            svg.line("body", line(&mut { closed }));
        }
        let start = [Side::Left, Side::Right].map(|side| (side, route.start[side as usize]));
        let steps = route.steps.iter().map(|step| (step.side, step.print));
        for (side, print) in start.into_iter().chain(steps) {
            let sole = biped.sole_at(side, &print);
            svg.polygon(side.name(), 1.0, line(&mut sole.corners().iter().copied()));
        }
        svg.line("path", line(&mut self.course.path.points.iter().copied()));
        svg.line("com", line(&mut self.walk.motion.centres.iter().map(|centre| centre.xy())));
        dot("goal", frame, &self.course.goal.place, svg);
    }
}

impl Blocked {
    /// The cells that enclose start or goal as SVG, in the axes of the map's world. Metres.
    pub fn to_svg(&self, floor: &Floor, start: &Point2<f64>, goal: &Point2<f64>) -> String {
        let legend =
            [(Swatch::Area, "closed", "enclosed"), (Swatch::Area, "start", "start"), (Swatch::Area, "goal", "goal")];
        let title = format!("no path from ({:.2}, {:.2}) to ({:.2}, {:.2})", start.x, start.y, goal.x, goal.y);
        let (frame, mut svg) = begun(&title, &legend, floor, &self.enclosure.cells);
        dot("start", &frame, start, &mut svg);
        dot("goal", &frame, goal, &mut svg);
        svg.finish(WIDTH, frame.end() + 18.0)
    }
}

/// Starts a picture of a floor with some of its cells marked.
fn begun(title: &str, legend: &[(Swatch, &str, &str)], floor: &Floor, closed: &[usize]) -> (Frame, Svg) {
    let mut svg = Svg::default();
    svg.add(format_args!("{STYLE}"));
    svg.text("title", (LEFT, 24.0), title);
    let own = [(Swatch::Area, "wall", "occupied"), (Swatch::Area, "near", "too near for the body")];
    svg.legend((LEFT, 46.0), &[&own[..], legend].concat());
    let frame = around(floor.map());
    draw_floor(floor, closed, &frame, &mut svg);
    frame.draw(("m", "m"), &mut svg);
    (frame, svg)
}

fn dot(class: &str, frame: &Frame, at: &Point2<f64>, svg: &mut Svg) {
    let (x, y) = page(frame, at);
    svg.add(format_args!(r#"<circle class="{class}" cx="{x:.1}" cy="{y:.1}" r="4"/>"#));
}

/// Draws occupied cells, cells too near to them for the body, and enclosed cells.
fn draw_floor(floor: &Floor, closed: &[usize], frame: &Frame, svg: &mut Svg) {
    let map = floor.map();
    let drawn = |class: &str, holds: &dyn Fn(usize) -> bool, svg: &mut Svg| {
        for (row, columns) in runs(map, holds) {
            let corners = [(columns.start, row), (columns.end, row), (columns.end, row + 1), (columns.start, row + 1)];
            let at = |(x, y): (usize, usize)| map.in_world(&Point2::new(x as f64, y as f64));
            svg.polygon(class, 1.0, corners.map(|corner| page(frame, &at(corner))));
        }
    };
    if let Ok(far) = floor.of_disc(map.half_diagonal()) {
        drawn("near", &|cell| !far.is_free(cell) && map.is_free(cell), svg);
    }
    let closed: HashSet<usize> = closed.iter().copied().collect();
    drawn("closed", &|cell| closed.contains(&cell), svg);
    drawn("wall", &|cell| map.cells()[cell] == Cell::Occupied, svg);
}

fn page(frame: &Frame, at: &Point2<f64>) -> (f64, f64) {
    frame.at((at.x, at.y))
}

/// A frame that contains a map, with one scale for both axes.
fn around(map: &Map) -> Frame {
    let (width, height) = (map.columns() as f64, map.rows() as f64);
    let corners = [(0.0, 0.0), (width, 0.0), (width, height), (0.0, height)];
    let corners = corners.map(|(x, y)| map.in_world(&Point2::new(x, y)));
    let (low, high) = corners.iter().fold((corners[0], corners[0]), |(low, high), at| (low.inf(at), high.sup(at)));
    let size: Vector2<f64> = high - low;
    let scale = (MOST.0 / size.x).min(MOST.1 / size.y);
    Frame { corner: (LEFT, TOP), size: (size.x * scale, size.y * scale), low: (low.x, low.y), high: (high.x, high.y) }
}

/// By row of a map, the intervals of cells that satisfy a condition.
fn runs<'a>(
    map: &'a Map,
    holds: &'a dyn Fn(usize) -> bool,
) -> impl Iterator<Item = (usize, std::ops::Range<usize>)> + 'a {
    let columns = map.columns();
    (0..map.rows()).flat_map(move |row| {
        let mut at = 0;
        std::iter::from_fn(move || {
            let start = (at..columns).find(|column| holds(row * columns + column))?;
            let end = (start..columns).find(|column| !holds(row * columns + column)).unwrap_or(columns);
            at = end;
            Some((row, start..end))
        })
    })
}
