//! References and simulated values of joints over time, as in RH0 Fig. 6-6 and 6-7: [`Quantity::picture`].

use groebot_robot::drawing::frame::Frame;
use groebot_robot::drawing::svg::{Svg, Swatch};
use groebot_robot::motion::Trajectory;
use groebot_robot::spatial::angle::RPM;

/// The quantity that is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// Their values \[deg\]: Fig. 6-6.
    Angle,
    /// Their rates \[rpm\]: Fig. 6-7.
    Rate,
    /// The torques of their motors \[N m\]; Fig. 6-8 of the thesis has currents.
    Torque,
}

const WIDTH: f64 = 1000.0;
const EDGE: f64 = 62.0;
const HEIGHT: f64 = 96.0;
const GAP: f64 = 34.0;
/// The most points of a line.
const MOST_POINTS: usize = 800;

type Line = Vec<(f64, f64)>;

impl Quantity {
    /// The picture of the joints in two columns, one per leg: the plan in blue, the simulation in orange. Joints that a
    /// trajectory does not have are omitted from its line.
    pub fn picture(self, plan: &Trajectory, answer: &Trajectory, legs: &[Vec<String>; 2]) -> String {
        let mut svg = Svg::default();
        let words = match self {
            Quantity::Angle => ["reference", "answer"],
            Quantity::Rate => ["rate of the reference", "simulated rate"],
            Quantity::Torque => ["torque of the plan", "torque of the motor"],
        };
        let entries = [(Swatch::Line, "left-path", words[0]), (Swatch::Line, "right-path", words[1])];
        svg.legend((EDGE, 20.0), &entries);
        let column = WIDTH / legs.len() as f64;
        let end = answer.times.last().copied().unwrap_or(1.0).max(1e-9);
        let mut bottom: f64 = 0.0;
        for (place, joints) in legs.iter().enumerate() {
            for (row, name) in joints.iter().enumerate() {
                let corner = (column * place as f64 + EDGE, GAP + 14.0 + (HEIGHT + GAP) * row as f64);
                let lines = [plan, answer].map(|motion| self.line(motion, name));
                let frame = framed(corner, column - EDGE - 14.0, (plan.times[0], end), &lines);
                svg.text("title", (corner.0, corner.1 - 5.0), name);
                frame.draw(("s", self.unit()), &mut svg);
                for (line, class) in lines.into_iter().zip(["left-path", "right-path"]) {
                    svg.line(class, line.into_iter().filter(|(time, _)| *time <= end).map(|point| frame.at(point)));
                }
                bottom = bottom.max(frame.end());
            }
        }
        svg.finish(WIDTH, bottom + 8.0)
    }

    fn unit(self) -> &'static str {
        match self {
            Quantity::Angle => "deg",
            Quantity::Rate => "rpm",
            Quantity::Torque => "N m",
        }
    }

    fn line(self, motion: &Trajectory, name: &str) -> Line {
        let stride = motion.times.len().div_ceil(MOST_POINTS).max(1);
        let rows = (0..motion.times.len()).step_by(stride);
        let joint = motion.joints.iter().position(|joint| joint.name == name);
        let torques = motion.figures.iter().find(|figure| figure.name.strip_prefix("tau:") == Some(name));
        let value = |row: usize| match self {
            Quantity::Angle => joint.map(|joint| motion.q[row][joint].to_degrees()),
            Quantity::Rate => joint.map(|joint| RPM * motion.rates(row)[joint]),
            Quantity::Torque => torques.map(|torques| torques.values[row]),
        };
        rows.filter_map(|row| Some((motion.times[row], value(row)?))).collect()
    }
}

fn framed(corner: (f64, f64), width: f64, (start, end): (f64, f64), lines: &[Line; 2]) -> Frame {
    let values = lines.iter().flatten().map(|(_, value)| *value);
    let (low, high) =
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| (low.min(value), high.max(value)));
    let (low, high) = if low.is_finite() { (low, high) } else { (0.0, 0.0) };
    let room = (0.08 * (high - low)).max(1e-3);
    Frame { corner, size: (width, HEIGHT), low: (start, low - room), high: (end, high + room) }
}
