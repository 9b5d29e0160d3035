//! The paths of ankles and trunk in space, and the joints over time.

use nalgebra::{Point2, Point3, Vector3};

use super::{GAP, INNER, LEFT, Walk};
use crate::gait::biped::Biped;
use crate::gait::footprint::Side;
use groebot_robot::drawing::frame::Frame;
use groebot_robot::drawing::svg::Svg;

/// The width and height of a joint's panel, and the margins beside it and above it \[px\].
const PANEL: (f64, f64) = (332.0, 110.0);
const BESIDE: f64 = (INNER - COLUMNS as f64 * PANEL.0) / (COLUMNS - 1) as f64;
const ABOVE: f64 = 16.0;
const COLUMNS: usize = 3;
/// The greatest and the least height of a view of paths \[px\].
const PATHS: f64 = 200.0;
const FLATTEST: f64 = 90.0;
/// The least extent of a path that is scaled to the view \[m\].
const LEAST_PATH: f64 = 0.01;
/// The displacement to the right and up in the picture of a metre to the left.
const LEFTWARDS: (f64, f64) = (0.35, 0.3);

/// Draws the paths of ankles and trunk in an oblique view from the right: RH0 Fig. 5-14, 5-20. Returns the lower end
/// \[px\].
pub(super) fn draw_paths(walk: &Walk, biped: &Biped, top: f64, svg: &mut Svg) -> f64 {
    let aslant = |at: Vector3<f64>| Point2::new(at.x + LEFTWARDS.0 * at.y, at.z + LEFTWARDS.1 * at.y);
    let ankle = |side: Side| -> Vec<Point2<f64>> {
        let up = Point3::new(0.0, 0.0, biped.feet[side as usize].ankle_height);
        let soles = walk.references.iter().map(|reference| reference.world_from_soles[side as usize]);
        soles.map(|sole| aslant((sole * up).coords)).collect()
    };
    let torso = walk.motion.postures.iter().map(|posture| aslant(posture.world_from_torso.translation.vector));
    let feet = [("left-path", ankle(Side::Left)), ("right-path", ankle(Side::Right))];
    let width = (INNER - LEFT) / 2.0;
    let ankles = draw_path("ankles", &feet, (LEFT, top), width, svg);
    let trunk = draw_path("trunk", &[("com", torso.collect())], (LEFT + width + LEFT, top), width, svg);
    ankles.max(trunk)
}

/// Draws paths in a frame of the width `width` below a title at `corner`, with one scale for both axes. Returns the
/// lower end \[px\].
fn draw_path(name: &str, paths: &[(&str, Vec<Point2<f64>>)], corner: (f64, f64), width: f64, svg: &mut Svg) -> f64 {
    let (mut low, mut high) = (Point2::new(f64::MAX, f64::MAX), Point2::new(f64::MIN, f64::MIN));
    for point in paths.iter().flat_map(|(_, path)| path) {
        (low, high) = (low.inf(point), high.sup(point));
    }
    let size = high - low;
    let scale = (0.94 * width / size.x.max(LEAST_PATH)).min(0.88 * PATHS / size.y.max(LEAST_PATH));
    let height = (size.y * scale / 0.88).clamp(FLATTEST, PATHS);
    let (half, middle) = ((width / scale / 2.0, height / scale / 2.0), nalgebra::center(&low, &high));
    svg.text(
        "title",
        (corner.0, corner.1 + 12.0),
        &format!("{name}, oblique view from the right; the axes are those at y = 0"),
    );
    let frame = Frame {
        corner: (corner.0, corner.1 + ABOVE + 4.0),
        size: (width, height),
        low: (middle.x - half.0, middle.y - half.1),
        high: (middle.x + half.0, middle.y + half.1),
    };
    frame.draw(("m", "m"), svg);
    for (class, path) in paths {
        svg.line(class, path.iter().map(|at| frame.at((at.x, at.y))));
    }
    frame.end()
}

/// Draws each moving joint with its limits; returns the lower end \[px\].
pub(super) fn draw_joints(walk: &Walk, biped: &Biped, top: f64, svg: &mut Svg) -> f64 {
    let moving = (0..biped.joints.len()).filter(|joint| moves(walk, *joint));
    let mut end = top;
    for (place, joint) in moving.enumerate() {
        let (column, row) = (place % COLUMNS, place / COLUMNS);
        let height = ABOVE + PANEL.1 + groebot_robot::drawing::frame::BELOW + GAP / 2.0;
        let corner = (LEFT + column as f64 * (PANEL.0 + BESIDE), top + row as f64 * height);
        end = draw_joint(walk, biped, joint, corner, svg);
    }
    end
}

fn moves(walk: &Walk, joint: usize) -> bool {
    let postures = &walk.motion.postures;
    postures.iter().any(|posture| (posture.q[joint] - postures[0].q[joint]).abs() > 1e-9)
}

/// Draws a joint over time with its limits, in degrees; returns the lower end of its panel \[px\].
fn draw_joint(walk: &Walk, biped: &Biped, joint: usize, corner: (f64, f64), svg: &mut Svg) -> f64 {
    let range = &biped.joints[joint];
    let values: Vec<f64> = walk.motion.postures.iter().map(|posture| posture.q[joint].to_degrees()).collect();
    let limits = [range.limits.0.to_degrees(), range.limits.1.to_degrees()];
    let room = 0.05 * (1.0 + limits[1] - limits[0]);
    let title = format!("{}: limits {:.1}..{:.1} deg", range.name, limits[0], limits[1]);
    svg.text("", (corner.0, corner.1 + 10.0), &title);
    let frame = Frame {
        corner: (corner.0, corner.1 + ABOVE),
        size: PANEL,
        low: (0.0, limits[0] - room),
        high: (walk.time(values.len() - 1).max(walk.schedule.tick), limits[1] + room),
    };
    frame.draw(("s", "deg"), svg);
    for limit in limits {
        svg.line("limit", [frame.at((frame.low.0, limit)), frame.at((frame.high.0, limit))]);
    }
    svg.line("joint", values.iter().enumerate().map(|(sample, value)| frame.at((walk.time(sample), *value))));
    frame.end()
}
