//! A walk as an SVG picture: from above, the margin of the zero moment point over time, the paths in space, and the
//! joints over time.

mod floor;
mod margin;
mod series;

use super::biped::Biped;
use super::plan::Walk;
use groebot_robot::drawing::svg::Svg;

/// The width of the picture, the left edge of its frames, and the width of frames that fill the picture \[px\].
const WIDTH: f64 = 1200.0;
const LEFT: f64 = 60.0;
const INNER: f64 = WIDTH - LEFT - 24.0;
/// The gap between two panels \[px\].
const GAP: f64 = 18.0;

impl Walk {
    /// The walk as SVG. The first panel is the view from above (x to the right, y up) with the number of the step on
    /// each sole. The second is the margin of the zero moment point over time, with the least one marked and single
    /// support shaded. Then follow the paths of ankles and trunk, and each moving joint with its limits. Metres,
    /// millimetres for the margin, seconds, degrees.
    pub fn to_svg(&self, biped: &Biped) -> String {
        let mut svg = Svg::default();
        let above = floor::draw(self, biped, GAP, &mut svg);
        let margin = margin::draw(self, above + GAP, &mut svg);
        let paths = series::draw_paths(self, biped, margin + GAP, &mut svg);
        let joints = series::draw_joints(self, biped, paths + GAP, &mut svg);
        svg.finish(WIDTH, joints + GAP)
    }
}
