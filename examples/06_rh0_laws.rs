//! The RH0 laws as printed, (3-46) and (3-48), compared with ours: the path of the centre of mass in a stride from above, and its height, as SVG.
//!
//!     cargo run --release --example 06_rh0_laws > docs/rh0_laws.svg

use std::f64::consts::PI;

use groebot::gait::{Action, Measures, Route, Walker, plan, step_commands};
use groebot::robots::{RH0_SIMULATION, rh0_walker};
use groebot::{Result, Watch};

/// The numbers of RH0 5.3.1 \[m\].
const LENGTH: f64 = 0.16;
const HALF_WIDTH: f64 = 0.112;
const RADIUS: f64 = 0.06;
const HEIGHT: f64 = 0.58;
const DIP: f64 = 0.004;
/// The fraction of phases 1 and 2, and that of phase 5, in a step.
const DOUBLE: f64 = 17.0 / 81.0;

/// A curve in a frame: its points, and the ranges of both axes.
struct Frame {
    corner: (f64, f64),
    x: (f64, f64),
    y: (f64, f64),
}

impl Frame {
    fn line(&self, class: &str, points: &[(f64, f64)]) -> String {
        let place = |(x, y): &(f64, f64)| {
            let share = |value: f64, (low, high): (f64, f64)| (value - low) / (high - low);
            format!(
                "{:.1},{:.1}",
                self.corner.0 + 360.0 * share(*x, self.x),
                self.corner.1 + 200.0 * (1.0 - share(*y, self.y))
            )
        };
        let points: Vec<String> = points.iter().map(place).collect();
        format!("<polyline class=\"{class}\" points=\"{}\"/>\n", points.join(" "))
    }

    fn frame(&self, title: &str) -> String {
        let (x, y) = self.corner;
        format!(
            "<rect x=\"{x}\" y=\"{y}\" width=\"360\" height=\"200\"/>\n<text x=\"{x}\" y=\"{}\">{title}</text>\n",
            y - 8.0
        )
    }
}

fn main() -> Result<()> {
    let Walker { biped: robot, legs, .. } = rh0_walker()?;
    let measures = Measures { length: LENGTH, half_width: HALF_WIDTH, most_turn: 0.1 };
    let route = Route::of_commands(&step_commands("out right, stride left")?, &measures)?;
    let request = RH0_SIMULATION.request(&robot, route, RH0_SIMULATION.hip_heights[0]);
    let walk = plan(&robot, &legs, &request, &Watch::none())?;

    // The stride is the second step: the left foot swings, and the right foot is at y = -0.112 m.
    let of_stride = |action: Action| matches!(action, Action::Shift(1) | Action::Swing(1) | Action::Balance(1));
    let samples: Vec<usize> = (0..walk.references.len())
        .filter(|sample| of_stride(walk.schedule.phases[walk.references[*sample].phase].action))
        .collect();
    let ankle = robot.feet[0].ankle_height;
    let share = |place: usize| place as f64 / (samples.len() - 1) as f64;
    let ours_from_above: Vec<_> =
        samples.iter().map(|s| (walk.motion.centres[*s].x - LENGTH, -walk.motion.centres[*s].y)).collect();
    let ours_height: Vec<_> =
        samples.iter().enumerate().map(|(place, s)| (share(place), walk.motion.centres[*s].z - ankle)).collect();

    // As printed: the lateral displacement is measured outwards from the supporting foot; here it is measured from the
    // middle.
    let steps = (0..=200).map(|step| f64::from(step) / 200.0);
    let printed_from_above: Vec<_> = steps
        .clone()
        .map(|u| LENGTH * (u - 0.5))
        .map(|x| (x, HALF_WIDTH + RADIUS - (HALF_WIDTH + RADIUS) / LENGTH.powi(4) * x.powi(4)))
        .collect();
    let printed_height: Vec<_> = steps
        .map(|u| {
            let angle = match u {
                u if u <= DOUBLE => PI * u / DOUBLE,
                u if u <= 1.0 - DOUBLE => PI * (2.0 * (u - DOUBLE) / (1.0 - 2.0 * DOUBLE) - 1.0),
                u => PI * ((u - 1.0 + DOUBLE) / DOUBLE - 1.0),
            };
            (u, HEIGHT - DIP * angle.cos())
        })
        .collect();

    let above = Frame { corner: (40.0, 60.0), x: (-0.09, 0.09), y: (-0.02, 0.19) };
    let height = Frame { corner: (440.0, 60.0), x: (0.0, 1.0), y: (0.570, 0.586) };
    println!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"840\" height=\"290\">\n<style>text {{ font: 12px sans-serif }} rect {{ fill: #fafafa; stroke: #ccc }} \
         polyline {{ fill: none; stroke-width: 1.5 }} .printed {{ stroke: #c2352b; stroke-dasharray: 5 3 }} .ours {{ stroke: #1b4f8a }} .foot {{ stroke: #74a85a }}</style>"
    );
    print!("{}", above.frame("a stride from above: ahead -90..90 mm, aside -20..190 mm"));
    print!("{}", above.line("foot", &[(-0.09, HALF_WIDTH), (0.09, HALF_WIDTH)]));
    print!("{}{}", above.line("printed", &printed_from_above), above.line("ours", &ours_from_above));
    print!("{}", height.frame("height of the centre of mass over the step: 570..586 mm"));
    print!("{}{}", height.line("printed", &printed_height), height.line("ours", &ours_height));
    println!(
        "<text x=\"40\" y=\"24\">dashed: RH0 (3-48) as printed; full: ours; green: the standing foot's middle</text>\n</svg>"
    );
    Ok(())
}
