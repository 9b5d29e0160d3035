//! A diagram frame with ticks on both axes. Main type: [`Frame`].

use super::svg::Svg;

/// Minimum distance between two ticks of the lower and of the left axis \[px\].
const APART: (f64, f64) = (60.0, 18.0);
/// Maximum number of ticks of an axis.
const MOST: f64 = 16.0;
/// Height of the numbers below a frame \[px\].
pub const BELOW: f64 = 18.0;

/// A rectangle of the page with the values at its sides. The first axis points right, the second one up.
pub struct Frame {
    /// The upper left corner \[px\].
    pub corner: (f64, f64),
    /// Width and height \[px\].
    pub size: (f64, f64),
    /// The values at the lower left corner.
    pub low: (f64, f64),
    /// The values at the upper right corner.
    pub high: (f64, f64),
}

impl Frame {
    /// The position of a pair of values on the page \[px\].
    pub fn at(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let share = |value: f64, low: f64, high: f64| (value - low) / (high - low);
        (
            self.corner.0 + share(x, self.low.0, self.high.0) * self.size.0,
            self.corner.1 + share(y, self.high.1, self.low.1) * self.size.1,
        )
    }

    /// The lower end of the frame and its numbers \[px\].
    pub fn end(&self) -> f64 {
        self.corner.1 + self.size.1 + BELOW
    }

    /// Draws the frame with grid lines and numbers at round values. The last number of each axis has its unit.
    pub fn draw(&self, units: (&str, &str), svg: &mut Svg) {
        let bottom = self.corner.1 + self.size.1;
        let right = self.corner.0 + self.size.0;
        let along = ticks(self.low.0, self.high.0, (self.size.0 / APART.0).min(MOST));
        for (place, (value, number)) in along.iter().enumerate() {
            let (x, _) = self.at((*value, self.low.1));
            svg.line("grid", [(x, self.corner.1), (x, bottom)]);
            svg.line("frame", [(x, bottom), (x, bottom + 4.0)]);
            svg.text("tick x middle", (x, bottom + 15.0), &labelled(number, units.0, place + 1 == along.len()));
        }
        let up = ticks(self.low.1, self.high.1, (self.size.1 / APART.1).min(MOST));
        for (place, (value, number)) in up.iter().enumerate() {
            let (_, y) = self.at((self.low.0, *value));
            svg.line("grid", [(self.corner.0, y), (right, y)]);
            svg.line("frame", [(self.corner.0 - 4.0, y), (self.corner.0, y)]);
            let text = labelled(number, units.1, place + 1 == up.len());
            svg.text("tick y end", (self.corner.0 - 6.0, y + 4.0), &text);
        }
        svg.rectangle("frame", self.corner, self.size);
    }
}

fn labelled(number: &str, unit: &str, is_last: bool) -> String {
    if is_last { format!("{number} {unit}") } else { number.to_owned() }
}

/// The multiples of 1, 2 or 5 times a power of ten from `low` to `high`, at most `most` plus one, with the necessary
/// decimals.
fn ticks(low: f64, high: f64, most: f64) -> Vec<(f64, String)> {
    let wanted = (high - low) / most.max(1.0);
    if !(wanted.is_finite() && wanted > 0.0) {
        return Vec::new();
    }
    let power = wanted.log10().floor() as i32;
    let steps = [(1.0, power), (2.0, power), (5.0, power), (1.0, power + 1)];
    let step = |(factor, power): (f64, i32)| factor * 10f64.powi(power);
    let (factor, power) = steps.into_iter().find(|choice| step(*choice) >= wanted).unwrap_or((1.0, power + 1));
    let (step, decimals) = (step((factor, power)), (-power).max(0) as usize);
    if step < f64::MIN_POSITIVE {
        return Vec::new();
    }
    let (first, last) = ((low / step).ceil() as i64, (high / step).floor() as i64);
    // Integers have no negative zero.
    (first..=last).map(|count| (count as f64 * step, format!("{:.decimals$}", count as f64 * step))).collect()
}
