//! Writes arcs of redundant arms by the Rust run time, like redundant.c: a word of 64 bits in hexadecimal for each number.
#[path = "redundant_arms.rs"]
mod arms;

use core::f64::consts::PI;
use std::fs::File;
use std::io::{BufWriter, Write};

use arms::{Kind, Random, Robot, about, image, product};
use groebot_runtime::Error;
use groebot_runtime::redundant::{
    Arc, Arm, Best, Criterion, End, Limits, Q, Span, Target, Task, Within, any_within, arcs, at, optima, sample,
    sample_from,
};

/// Maximal numbers of arcs, samples and optima.
const ARCS: usize = 64;
const SAMPLES: usize = 7;
const OPTIMA: usize = 6;

struct Output {
    file: BufWriter<File>,
    random: Random,
}

fn code(error: Error) -> i32 {
    match error {
        Error::NotFinite => -1,
        Error::NotRotation => -3,
        Error::NotUnit => -4,
        Error::Limits(_) => -7,
        _ => -100,
    }
}

impl Output {
    fn line(&mut self, text: &str) {
        writeln!(self.file, "{text}").expect("the file is writable");
    }

    fn numbers(&mut self, name: &str, numbers: &[f64]) {
        let words: String = numbers.iter().map(|number| format!(" {:016x}", number.to_bits())).collect();
        self.line(&format!("{name}{words}"));
    }

    fn end(&mut self, name: &str, end: &End) {
        let joint = end.joint.map_or(-1, |joint| joint as i32);
        self.line(&format!("joint {joint} {}", u8::from(end.is_upper)));
        self.numbers(name, &end.q);
    }

    fn optima(&mut self, arm: &Arm, target: &Target, limits: &Limits, arcs: &[Arc]) {
        let q0: Q = core::array::from_fn(|i| 0.1 * i as f64 - 0.3);
        let weights: Q = core::array::from_fn(|i| 1.0 + 0.5 * i as f64);
        let criteria = [
            Criterion::Margin { is_relative: false },
            Criterion::Nearest { q0, weights },
            Criterion::Manipulability,
            Criterion::Change { joint: 1, value: 0.25 },
            Criterion::Margin { is_relative: true },
        ];
        for criterion in criteria {
            let mut list = [Best::NONE; OPTIMA];
            let number = optima(arm, target, limits, (arcs, &criterion), &mut list).expect("the limits are in order");
            self.line(&format!("optima {number}"));
            for one in &list[..number] {
                self.line(&format!("arc {}", one.arc));
                self.numbers("optimum", &one.q);
                self.numbers("value", &[one.value]);
                self.numbers("s", &[one.s]);
            }
        }
    }

    fn samples(&mut self, arm: &Arm, target: &Target, limits: &Limits, arc: &Arc) {
        let mut list = [[0.0; 7]; SAMPLES];
        sample(arm, target, limits, arc, &mut list).expect("the limits are in order");
        for q in &list {
            self.numbers("sample", q);
        }
        let q = at(arm, target, limits, arc, 0.3 * arc.length).expect("the limits are in order");
        self.numbers("at", &q);
        self.turned(arm, target, limits, arc);
    }

    /// Writes one of the arcs that differ by whole turns, within limits that are wider by more than one turn.
    fn turned(&mut self, arm: &Arm, target: &Target, limits: &Limits, arc: &Arc) {
        let wide = limits.map(|[low, high]| [low - 7.0, high + 8.0]);
        let span = Span::along(arm, target, limits, arc).expect("the limits are in order");
        let count = span.count_turns(arm, &wide);
        let start = span.turn(arm, &wide, count / 2);
        let mut list = [[0.0; 7]; 3];
        sample_from(arm, target, limits, (arc, &start), &mut list).expect("the limits are in order");
        self.numbers("low", &span.low);
        self.numbers("high", &span.high);
        self.line(&format!("turns {count}"));
        for q in &list {
            self.numbers("turned", q);
        }
    }

    fn within(&mut self, robot: &Robot, target: &Target) {
        let none = |is_reachable: u8, beyond: u32, is_unsure: bool| {
            format!("within 0\nnone {is_reachable} {beyond} {}", u8::from(is_unsure))
        };
        match any_within(robot, target, &robot.arm.limits) {
            Err(error) => self.line(&format!("within {}", code(error))),
            Ok(Within::Solution(q)) => {
                self.line("within 1");
                self.numbers("q", &q);
            }
            Ok(Within::Beyond { joints, is_unsure }) => self.line(&none(1, joints, is_unsure)),
            Ok(Within::Unreachable { is_unsure }) => self.line(&none(0, 0, is_unsure)),
            Ok(_) => unreachable!("there are three results"),
        }
    }

    /// Writes all results for a target.
    fn all(&mut self, robot: &Robot, target: &Target) {
        let limits = &robot.arm.limits;
        let mut list = [Arc::NONE; ARCS];
        self.numbers("target", target);
        self.within(robot, target);
        let outcome = match arcs(robot, target, limits, &mut list) {
            Ok(outcome) => outcome,
            Err(error) => return self.line(&format!("arcs {}", code(error))),
        };
        let flags = [outcome.is_unsure, outcome.is_surface, outcome.is_reachable, outcome.is_grid_only].map(u8::from);
        self.line("arcs 0");
        self.line(&format!(
            "outcome {} {} {} {} {} {} {} {}",
            outcome.count, outcome.ends, flags[0], outcome.closed, flags[1], flags[2], flags[3], outcome.beyond
        ));
        for arc in &list[..outcome.count] {
            self.line(&format!("arc {} {}", u8::from(arc.is_closed), u8::from(arc.is_unsure)));
            self.end("start", &arc.start);
            self.end("end", &arc.end);
            self.numbers("length", &[arc.length]);
            self.samples(&robot.arm, target, limits, arc);
        }
        self.optima(&robot.arm, target, limits, &list[..outcome.count]);
    }

    /// Limits of an angle: random, round, a whole turn, none, or not in order.
    fn random_limits(&mut self, number: usize) -> [f64; 2] {
        let random = &mut self.random;
        let low = random.between(-3.0, 0.0);
        let range = random.between(0.2, 5.0);
        if number % 5 == 1 {
            let lower = -PI / 6.0 * f64::from((6.0 * random.next()) as i32);
            return [lower, PI / 6.0 * f64::from((6.0 * random.next()) as i32)];
        }
        match number {
            _ if number % 11 == 3 => [low, low + 2.0 * PI],
            _ if number % 11 == 5 => [f64::NEG_INFINITY, f64::INFINITY],
            77 => [1.0, -1.0],
            _ => [low, low + range],
        }
    }

    /// A random joint value within limits; a round one for every fifth target.
    fn random_value(&mut self, number: usize, limits: [f64; 2]) -> f64 {
        let low = if limits[0] >= -PI { limits[0] } else { -PI };
        let high = if limits[1] <= PI { limits[1] } else { PI };
        if number % 5 == 1 {
            let most = ((high - low) * 6.0 / PI) as i32;
            return low + PI / 6.0 * f64::from((f64::from(most + 1) * self.random.next()) as i32);
        }
        self.random.between(low, high)
    }

    /// Random and round targets of an arm within random limits.
    fn targets(&mut self, kind: Kind, count: usize) {
        for number in 0..count {
            let mut robot = Robot::new(kind);
            let mut q = [0.0; 7];
            for i in 0..robot.arm.count {
                let limits = &mut robot.arm.limits[i];
                if kind == Kind::Srs && number % 3 == 0 {
                    *limits = [0.6 * limits[0], 0.9 * limits[1]];
                } else if kind != Kind::Srs {
                    *limits = self.random_limits(number);
                }
                q[i] = self.random_value(number, *limits);
            }
            if kind == Kind::Srs && number % 10 == 6 {
                q[3] = 0.0;
            }
            let mut target = robot.forward(&q);
            if number % 7 == 4 {
                target[0] += self.random.between(-2.0, 2.0);
            }
            self.all(&robot, &target);
        }
    }

    fn random_direction(&mut self) -> [f64; 3] {
        let (x, y) = (self.random.between(-1.0, 1.0), self.random.between(-1.0, 1.0));
        let z = self.random.between(0.1, 1.0);
        let length = (x * x + y * y + z * z).sqrt();
        [x / length, y / length, z / length]
    }

    /// An arm with random axes, all parallel for planar tasks, and a prismatic joint; and the target that it reaches at zero.
    fn random_arm(&mut self, number: usize, kind: usize) -> (Arm, Target) {
        let axis = number % 3;
        let slide = (8.0 * self.random.next()) as usize;
        let [yaw, pitch, roll] = [3.0, 1.0, 1.0].map(|most| self.random.between(-most, most));
        let coordinates = [usize::from(axis == 0), if axis == 2 { 1 } else { 2 }];
        let mut direction = self.random_direction();
        let mut arm = Arm { length: 0.7, ..Arm::NONE };
        arm.tip.rotation = product(&product(&about(2, yaw), &about(1, pitch)), &about(0, roll));
        arm.tip.translation = core::array::from_fn(|_| self.random.between(0.5, 1.0));
        if kind == 6 {
            arm.tip.rotation = about(axis, yaw);
            direction = core::array::from_fn(|k| if k == (axis + 1) % 3 { 1.0 } else { 0.0 });
        }
        arm.task = [
            Task::Pose,
            Task::Position,
            Task::Rotation,
            Task::Ray { direction },
            Task::Direction { direction },
            Task::PositionPitchRoll,
            Task::PositionYaw { axis, direction },
            Task::PlanarPosition { coordinates },
            Task::PlanarPose { coordinates },
        ][kind];
        arm.count = arm.task.equations() + 1;
        for i in 0..arm.count {
            arm.directions[i] = self.random_direction();
            arm.points[i] = core::array::from_fn(|_| self.random.between(-1.0, 1.0));
            if kind >= 6 {
                arm.directions[i] = core::array::from_fn(|k| if k == axis { 1.0 } else { 0.0 });
            }
            arm.slides[i] = if kind == 6 { i == 1 } else { i == slide && ![2, 4, 7, 8].contains(&kind) };
            arm.limits[i] = [-3.0, 2.5];
        }
        let ([x, y, z], p) = (arm.tip.rotation, arm.tip.translation);
        let aim = image(&arm.tip.rotation, &direction);
        let numbers: Vec<f64> = match kind {
            0 => [p, x, y, z].concat(),
            1 => p.to_vec(),
            2 => [x, y, z].concat(),
            3 => [p, aim].concat(),
            4 => aim.to_vec(),
            5 => [p, [pitch, roll, 0.0]].concat(),
            6 => [p, [yaw, 0.0, 0.0]].concat(),
            _ => coordinates.map(|c| p[c]).to_vec(),
        };
        let mut target = [0.0; 12];
        target[..numbers.len()].copy_from_slice(&numbers);
        (arm, target)
    }

    /// The curves through zero of arms with all tasks.
    fn tasks(&mut self) {
        for number in 0..90 {
            let (arm, target) = self.random_arm(number / 9, number % 9);
            let mut arc = Arc::NONE;
            arc.length = 2.0;
            self.numbers("target", &target);
            self.samples(&arm, &target, &arm.limits, &arc);
            self.optima(&arm, &target, &arm.limits, &[arc]);
        }
    }
}

fn main() -> std::io::Result<()> {
    let arguments: Vec<String> = std::env::args().collect();
    let file = BufWriter::new(File::create(&arguments[1])?);
    let mut output = Output { file, random: Random(88_172_645_463_325_252) };
    output.targets(Kind::Planar, 150);
    output.targets(Kind::Rail, 60);
    output.targets(Kind::Srs, 60);
    output.tasks();
    output.file.flush()
}
