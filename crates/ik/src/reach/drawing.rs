//! Slices of a map as an SVG picture.

use std::fmt::Write;

use super::map::ReachMap;
use super::request::Measure;
use groebot_robot::drawing::frame::{BELOW, Frame};
use groebot_robot::drawing::svg::Svg;

/// Maximal number of slices in a picture, and number of slices in a row.
const MOST: usize = 12;
const ABREAST: usize = 4;
/// Maximal side of a slice, margins on its left and above it, and the distance between slices \[px\].
const SIDE: f64 = 300.0;
const LEFT: f64 = 56.0;
const ABOVE: f64 = 22.0;
const APART: f64 = 14.0;
/// Height of the title and the legend \[px\].
const TOP: f64 = 76.0;
/// Size of the legend \[px\].
const BAR: (f64, f64) = (240.0, 12.0);

/// Colours from the least to the greatest value: viridis of matplotlib (N. Smith and S. van der Walt, 2015). Its lightness increases evenly, and it is suitable
/// for colour-blind readers.
const COLOURS: [(u8, u8, u8); 9] = [
    (68, 1, 84),
    (71, 44, 122),
    (59, 81, 139),
    (44, 113, 142),
    (33, 144, 141),
    (39, 173, 129),
    (92, 200, 99),
    (170, 220, 50),
    (253, 231, 37),
];
/// Number of distinct colours.
const SHADES: usize = 33;
const AXES: [&str; 3] = ["x", "y", "z"];

impl ReachMap {
    /// Slices of the map orthogonal to an axis (0, 1, 2 for x, y, z), at most twelve at even distances, as SVG. The colour is the share of reached
    /// orientations, or the mean manipulability if it was measured. Places without reached orientations have no colour. Without an axis, the first one with a
    /// single place is used, else z.
    pub fn to_svg(&self, across: Option<usize>) -> String {
        let axes = self.grid.axes();
        let normal = across.unwrap_or_else(|| axes.iter().position(|axis| axis.count == 1).unwrap_or(2)).min(2);
        let [right, up] = [[1, 2], [0, 2], [0, 1]][normal];
        let slices = chosen(axes[normal].count);
        let spans = [right, up].map(|axis| self.span(axis));
        let longest = spans.iter().map(|(low, high)| high - low).fold(0.0, f64::max);
        let size = spans.map(|(low, high)| (SIDE * (high - low) / longest).max(8.0));
        let (wide, high) = (LEFT + size[0] + APART, ABOVE + size[1] + BELOW + APART);
        let mut svg = Svg::default();
        svg.add(format_args!("{}", style()));
        svg.text("title", (LEFT, 24.0), &self.title());
        let greatest = self.draw_legend(&mut svg);
        for (slot, slice) in slices.iter().enumerate() {
            let corner = (LEFT + (slot % ABREAST) as f64 * wide, TOP + ABOVE + (slot / ABREAST) as f64 * high);
            let [along, above] = spans;
            let frame = Frame { corner, size: (size[0], size[1]), low: (along.0, above.0), high: (along.1, above.1) };
            // Avoids a negative zero.
            let at = (1e3 * axes[normal].at(*slice)).round() / 1e3 + 0.0;
            let label = format!("{} = {at:.3} {}", AXES[normal], self.unit);
            svg.text("", (corner.0, corner.1 - 6.0), label.trim_end());
            self.draw_slice([normal, right, up], *slice, greatest, &frame, &mut svg);
            let units = [right, up].map(|axis| format!("{} {}", self.unit, AXES[axis]).trim().to_owned());
            frame.draw((&units[0], &units[1]), &mut svg);
        }
        let rows = slices.len().div_ceil(ABREAST) as f64;
        let width = LEFT + slices.len().min(ABREAST) as f64 * wide;
        svg.finish(width.max(2.0 * LEFT + BAR.0 + 160.0), TOP + rows * high)
    }

    fn title(&self) -> String {
        let counted = if self.limited { " within limits" } else { "" };
        format!("{}, {}: {} orientations{counted}", self.solver, self.task, self.orientations)
    }

    /// The interval that an axis covers, with half a step on both sides.
    fn span(&self, axis: usize) -> (f64, f64) {
        let own = &self.grid.axes()[axis];
        let others = self.grid.axes().iter().map(|axis| axis.step()).filter(|step| *step > 0.0);
        let step = if own.step() > 0.0 { own.step() } else { others.fold(f64::INFINITY, f64::min) };
        let half = if step.is_finite() { step / 2.0 } else { 0.5 };
        (own.from - half, own.to + half)
    }

    /// The value that determines the colour of a place. `None` if nothing is reached there.
    fn value(&self, place: usize) -> Option<f64> {
        let entry = &self.entries[place];
        let value = if self.measure == Measure::Manipulability { entry.mean.into() } else { self.index(place) };
        (entry.reached > 0).then_some(value)
    }

    /// Draws the legend. Returns the greatest value, which has the last colour.
    fn draw_legend(&self, svg: &mut Svg) -> f64 {
        let is_measured = self.measure == Measure::Manipulability;
        let values = (0..self.entries.len()).filter_map(|place| self.value(place));
        let greatest = if is_measured { values.fold(0.0, f64::max) } else { 1.0 };
        let at = (LEFT, 40.0);
        let width = BAR.0 / SHADES as f64;
        for shade in 0..SHADES {
            svg.rectangle(&format!("s{shade}"), (at.0 + shade as f64 * width, at.1), (width + 0.2, BAR.1));
        }
        let words = if is_measured { "mean manipulability (metres, radians)" } else { "share of orientations" };
        svg.text("", (at.0 + BAR.0 + 10.0, at.1 + 11.0), &format!("0 to {greatest:.3}: {words}"));
        greatest
    }

    /// Draws the places of a slice. Neighbours with equal colours are one rectangle.
    fn draw_slice(&self, [normal, right, up]: [usize; 3], slice: usize, greatest: f64, frame: &Frame, svg: &mut Svg) {
        let [columns, rows] = [right, up].map(|axis| self.grid.axes()[axis].count);
        let (wide, high) = (frame.size.0 / columns as f64, frame.size.1 / rows as f64);
        let mut paths = vec![String::new(); SHADES];
        for row in 0..rows {
            let shade = |column: usize| {
                let mut numbers = [0; 3];
                (numbers[normal], numbers[right], numbers[up]) = (slice, column, row);
                self.value(self.grid.place(numbers)).map(|value| shade(value, greatest))
            };
            let shades: Vec<Option<usize>> = (0..columns).map(shade).collect();
            let mut column = 0;
            for run in shades.chunk_by(|a, b| a == b) {
                if let Some(shade) = run[0] {
                    let (x, y) = (column as f64 * wide, frame.size.1 - (row + 1) as f64 * high);
                    let (x, y, width) = (frame.corner.0 + x, frame.corner.1 + y, run.len() as f64 * wide);
                    // Writing to a string cannot fail.
                    let _ = write!(paths[shade], "M{x:.1} {y:.1}h{width:.1}v{high:.1}h-{width:.1}z");
                }
                column += run.len();
            }
        }
        for (shade, path) in paths.iter().enumerate().filter(|(_, path)| !path.is_empty()) {
            svg.add(format_args!(r#"<path class="s{shade}" d="{path}"/>"#));
        }
    }
}

/// At most [`MOST`] indices below a count, at even distances.
fn chosen(count: usize) -> Vec<usize> {
    let shown = count.min(MOST);
    // The indices in the middle of equal parts.
    (0..shown).map(|slot| (2 * slot + 1) * count / (2 * shown)).collect()
}

fn shade(value: f64, greatest: f64) -> usize {
    let share = if greatest > 0.0 { (value / greatest).clamp(0.0, 1.0) } else { 0.0 };
    (share * (SHADES - 1) as f64).round() as usize
}

fn style() -> String {
    let mut text = String::from("<style>\n");
    for shade in 0..SHADES {
        let at = shade as f64 / (SHADES - 1) as f64 * (COLOURS.len() - 1) as f64;
        let (first, share) =
            ((at as usize).min(COLOURS.len() - 2), at.fract() + (at as usize / (COLOURS.len() - 1)) as f64);
        let mix = |a: u8, b: u8| f64::from(a) + (f64::from(b) - f64::from(a)) * share;
        let ((r, g, b), (red, green, blue)) = (COLOURS[first], COLOURS[first + 1]);
        let (r, g, b) = (mix(r, red), mix(g, green), mix(b, blue));
        // Writing to a string cannot fail.
        let _ = writeln!(text, ".s{shade} {{ fill: rgb({r:.0},{g:.0},{b:.0}) }}");
    }
    text + "</style>"
}
