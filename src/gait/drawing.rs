//! A walk as a picture, SVG: the footprints and the paths of centre of mass and zero moment point from above, and the joints in time.

use std::fmt::Write;

use nalgebra::{Point2, Point3, Vector3};

use super::footprint::{Footprint, Side};
use super::humanoid::Humanoid;
use super::plan::Walk;

/// Pixels.
const WIDTH: f64 = 1200.0;
const MARGIN: f64 = 40.0;
const MOST_VIEW_HEIGHT: f64 = 520.0;
const PLOT: (f64, f64) = (360.0, 110.0);
const COLUMNS: usize = 3;
/// The height of the view of the paths.
const PATHS: f64 = 260.0;
/// A path that is smaller than this is not drawn larger \[m\].
const LEAST_PATH: f64 = 0.01;
/// How far a metre to the left is drawn to the right and up.
const LEFTWARDS: (f64, f64) = (0.35, 0.3);
/// What is left free around the footprints \[m\].
const ROOM: f64 = 0.03;

/// An SVG text that grows.
struct Svg(String);

impl Svg {
    fn add(&mut self, element: std::fmt::Arguments<'_>) {
        // Writing to a string cannot fail.
        let _ = self.0.write_fmt(element);
        self.0.push('\n');
    }

    fn line(&mut self, class: &str, points: impl Iterator<Item = (f64, f64)>) {
        let points = points.map(|(x, y)| format!("{x:.1},{y:.1}")).collect::<Vec<_>>().join(" ");
        self.add(format_args!(r#"<polyline class="{class}" points="{points}"/>"#));
    }

    fn text(&mut self, x: f64, y: f64, text: &str) {
        self.add(format_args!(r#"<text x="{x:.1}" y="{y:.1}">{text}</text>"#));
    }
}

/// From metres on the floor to pixels: x of the world goes to the right, y up.
struct View {
    low: Point2<f64>,
    high: Point2<f64>,
    scale: f64,
    top: f64,
}

impl View {
    fn of(points: impl Iterator<Item = Point2<f64>>, top: f64) -> Self {
        let (mut low, mut high) = (Point2::new(f64::MAX, f64::MAX), Point2::new(f64::MIN, f64::MIN));
        for point in points {
            (low, high) = (low.inf(&point), high.sup(&point));
        }
        low -= nalgebra::Vector2::repeat(ROOM);
        high += nalgebra::Vector2::repeat(ROOM);
        let size = high - low;
        let scale = ((WIDTH - 2.0 * MARGIN) / size.x).min(MOST_VIEW_HEIGHT / size.y);
        View { low, high, scale, top }
    }

    fn height(&self) -> f64 {
        (self.high.y - self.low.y) * self.scale
    }

    fn at(&self, point: &Point2<f64>) -> (f64, f64) {
        (MARGIN + (point.x - self.low.x) * self.scale, self.top + (self.high.y - point.y) * self.scale)
    }
}

impl Walk {
    /// The walk as SVG: from above (x to the right, y up), and below it each joint that moves, against its limits.
    pub fn to_svg(&self, humanoid: &Humanoid) -> String {
        let moving: Vec<usize> = (0..humanoid.joints.len()).filter(|joint| self.moves(*joint)).collect();
        let view = View::of(self.prints().iter().flat_map(|(side, print)| sole(humanoid, *side, print)), 50.0);
        let rows = moving.len().div_ceil(COLUMNS);
        let below = view.top + view.height() + 60.0 + PATHS;
        let height = below + rows as f64 * (PLOT.1 + 40.0);
        let mut svg = Svg(String::new());
        svg.add(format_args!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{height:.0}" viewBox="0 0 {WIDTH} {height:.0}">"#
        ));
        svg.add(format_args!("{STYLE}"));
        self.draw_floor(humanoid, &view, &mut svg);
        self.draw_paths(humanoid, view.top + view.height() + 30.0, &mut svg);
        for (place, joint) in moving.into_iter().enumerate() {
            let (column, row) = (place % COLUMNS, place / COLUMNS);
            let corner = (MARGIN + column as f64 * (PLOT.0 + 20.0), below + row as f64 * (PLOT.1 + 40.0));
            self.draw_joint(humanoid, joint, corner, &mut svg);
        }
        svg.0 + "</svg>\n"
    }

    fn moves(&self, joint: usize) -> bool {
        let postures = &self.motion.postures;
        postures.iter().any(|posture| (posture.q[joint] - postures[0].q[joint]).abs() > 1e-9)
    }

    /// All footprints, the start first.
    fn prints(&self) -> Vec<(Side, Footprint)> {
        let route = &self.schedule.route;
        let start = [(Side::Left, route.start[0]), (Side::Right, route.start[1])];
        start.into_iter().chain(route.steps.iter().map(|step| (step.side, step.print))).collect()
    }

    fn draw_floor(&self, humanoid: &Humanoid, view: &View, svg: &mut Svg) {
        let steps = self.schedule.route.steps.len();
        svg.text(
            MARGIN,
            20.0,
            &format!("{}: {steps} steps from above; 1 m is {:.0} pixels", humanoid.name, view.scale),
        );
        svg.add(format_args!(
            r#"<text x="{MARGIN}" y="38"><tspan class="com-key">centre of mass</tspan>, <tspan class="zmp-key">zero moment point</tspan>, left and right soles by the number of their step</text>"#
        ));
        let prints = self.prints();
        for (side, print) in &prints {
            let corners = sole(humanoid, *side, print).into_iter().map(|corner| view.at(&corner));
            let corners: Vec<String> = corners.map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
            svg.add(format_args!(r#"<polygon class="{}" points="{}"/>"#, side.name(), corners.join(" ")));
        }
        for (place, (_, print)) in prints.iter().enumerate() {
            let (x, y) = view.at(&print.carry(&Point2::new(0.085, 0.0)));
            svg.text(
                x,
                y,
                &place.checked_sub(1).filter(|step| *step > 0).map_or("start".into(), |step| step.to_string()),
            );
        }
        svg.line("zmp", self.balances.iter().map(|balance| view.at(&balance.zmp)));
        svg.line("com", self.balances.iter().map(|balance| view.at(&balance.pressure)));
    }

    /// The paths of ankles and trunk in space, seen aslant from the right: RH0 Fig. 5-14, 5-20.
    fn draw_paths(&self, humanoid: &Humanoid, top: f64, svg: &mut Svg) {
        let aslant = |at: Vector3<f64>| Point2::new(at.x + LEFTWARDS.0 * at.y, at.z + LEFTWARDS.1 * at.y);
        let ankle = |side: Side| -> Vec<Point2<f64>> {
            let up = Point3::new(0.0, 0.0, humanoid.feet[side as usize].ankle_height);
            let soles = self.references.iter().map(|reference| reference.world_from_soles[side as usize]);
            soles.map(|sole| aslant((sole * up).coords)).collect()
        };
        let torso = self.motion.postures.iter().map(|posture| aslant(posture.world_from_torso.translation.vector));
        let feet = [("left-path", ankle(Side::Left)), ("right-path", ankle(Side::Right))];
        let half = WIDTH / 2.0 - 1.5 * MARGIN;
        draw_path("ankles", &feet, (MARGIN, top), half, svg);
        draw_path("trunk", &[("com", torso.collect())], (WIDTH / 2.0 + MARGIN / 2.0, top), half, svg);
    }

    /// A joint in time against its limits; limits far away are beyond the frame.
    fn draw_joint(&self, humanoid: &Humanoid, joint: usize, corner: (f64, f64), svg: &mut Svg) {
        let range = &humanoid.joints[joint];
        let values: Vec<f64> = self.motion.postures.iter().map(|posture| posture.q[joint].to_degrees()).collect();
        let limits = [range.limits.0.to_degrees(), range.limits.1.to_degrees()];
        let (mut low, mut high) = (limits[0], limits[1]);
        let spread = 1.0 + 0.1 * (high - low);
        (low, high) = (low - 0.05 * spread, high + 0.05 * spread);
        let end = self.time(values.len() - 1);
        let at = |time: f64, value: f64| {
            (corner.0 + time / end * PLOT.0, corner.1 + 16.0 + (high - value) / (high - low) * PLOT.1)
        };
        svg.text(
            corner.0,
            corner.1 + 10.0,
            &format!("{}: limits {:.1}..{:.1} deg, {end:.1} s", range.name, limits[0], limits[1]),
        );
        svg.add(format_args!(
            r#"<rect class="frame" x="{:.1}" y="{:.1}" width="{}" height="{}"/>"#,
            corner.0,
            corner.1 + 16.0,
            PLOT.0,
            PLOT.1
        ));
        for limit in limits {
            svg.line("limit", [at(0.0, limit), at(end, limit)].into_iter());
        }
        svg.line("joint", values.iter().enumerate().map(|(sample, value)| at(self.time(sample), *value)));
    }
}

/// Paths in a frame of the width `width` at `corner`, in one scale for both axes.
fn draw_path(name: &str, paths: &[(&str, Vec<Point2<f64>>)], corner: (f64, f64), width: f64, svg: &mut Svg) {
    let (mut low, mut high) = (Point2::new(f64::MAX, f64::MAX), Point2::new(f64::MIN, f64::MIN));
    for point in paths.iter().flat_map(|(_, path)| path) {
        (low, high) = (low.inf(point), high.sup(point));
    }
    let size = high - low;
    let scale = (width / size.x.max(LEAST_PATH)).min((PATHS - 40.0) / size.y.max(LEAST_PATH));
    svg.text(corner.0, corner.1, &format!("{name} aslant from the right; 1 m is {scale:.0} pixels"));
    for (class, path) in paths {
        let points = path.iter();
        svg.line(
            class,
            points.map(|at| (corner.0 + (at.x - low.x) * scale, corner.1 + 16.0 + (high.y - at.y) * scale)),
        );
    }
}

fn sole(humanoid: &Humanoid, side: Side, print: &Footprint) -> Vec<Point2<f64>> {
    humanoid.sole_at(side, print).corners().to_vec()
}

const STYLE: &str = "<style>
text { font: 12px sans-serif; fill: #333 }
polyline { fill: none; stroke-width: 1.5 }
.left { fill: #cfe3f7; fill-opacity: 0.6; stroke: #5b8fc4 }
.right { fill: #dcefd2; fill-opacity: 0.6; stroke: #74a85a }
.com { stroke: #1b4f8a } .com-key { fill: #1b4f8a }
.zmp { stroke: #c2352b } .zmp-key { fill: #c2352b }
.left-path { stroke: #5b8fc4 } .right-path { stroke: #74a85a }
.joint { stroke: #1b4f8a } .limit { stroke: #c2352b; stroke-dasharray: 4 3 }
.frame { fill: #fafafa; stroke: #ccc }
</style>
<rect width=\"100%\" height=\"100%\" fill=\"white\"/>";
