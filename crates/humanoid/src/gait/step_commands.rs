//! Walks as lists of step commands, RH0 3.5.1: `out right, stride left, stride right, in left`, `turn left 90`. Main type:
//! [`StepCommand`].

use nalgebra::Point2;

use super::footprint::{Footprint, Footstep, MAX_STEPS, Route, Side};
use crate::{Error, ErrorKind, Result};
use groebot_robot::spatial::angle;

/// The distance from its goal at which a walk ends \[m\].
const ARRIVED: f64 = 1e-3;

/// A part of a walk: one of the four kinds of steps of RH0 3.5.1, or a turn in as many steps as needed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum StepCommand {
    /// From parallel feet, the foot of this side moves one length forward.
    Out(Side),
    /// From the rear, the foot of this side moves to one length forward of the other one.
    Stride(Side),
    /// From the rear, the foot of this side moves beside the other one.
    In(Side),
    /// A turn on the spot, by pairs of steps \[rad\], anticlockwise.
    Turn(f64),
}

/// Reads the step commands of a walk, separated by commas.
///
/// # Errors
/// [`ErrorKind::Syntax`] for an unknown command.
pub fn step_commands(text: &str) -> Result<Vec<StepCommand>> {
    let command = |part: &str| {
        let wrong = || {
            let text = format!(
                "`{}`: give `out`, `stride` or `in` with `left` or `right`, or `turn left` or `turn right` with degrees, separated by commas",
                part.trim()
            );
            Error::new(ErrorKind::Syntax, text)
        };
        let side = |name: &str| match name {
            "left" => Ok(Side::Left),
            "right" => Ok(Side::Right),
            _ => Err(wrong()),
        };
        match part.split_whitespace().collect::<Vec<_>>()[..] {
            ["out", name] => Ok(StepCommand::Out(side(name)?)),
            ["stride", name] => Ok(StepCommand::Stride(side(name)?)),
            ["in", name] => Ok(StepCommand::In(side(name)?)),
            ["turn", name, degrees] => {
                let angle = degrees.parse::<f64>().ok().filter(|angle| angle.is_finite() && *angle > 0.0);
                Ok(StepCommand::Turn(side(name)?.sign() * angle.ok_or_else(wrong)?.to_radians()))
            }
            _ => Err(wrong()),
        }
    };
    text.split(',').map(command).collect()
}

/// The dimensions of the steps of a walk given as step commands. Metres, radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measures {
    /// `L_p`: the distance from the supporting foot forward to the landing foot.
    pub length: f64,
    /// `W_p`: half of the lateral distance between the feet.
    pub half_width: f64,
    /// `G_CM`: the greatest turn by a pair of steps.
    pub most_turn: f64,
}

/// The state of the feet and the trunk while a route is made.
struct RouteBuilder {
    measures: Measures,
    /// The pose of the robot's middle.
    middle: Footprint,
    /// The distance of each foot forward of the middle: half a length, or zero.
    ahead: [f64; 2],
    steps: Vec<Footstep>,
    rests: Vec<Footprint>,
}

impl Route {
    /// Makes the route of a walk given as step commands, from parallel feet about the origin.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when a command does not fit the current footprints, there are no commands or too many steps,
    /// or a dimension is not finite and positive.
    pub fn of_commands(commands: &[StepCommand], measures: &Measures) -> Result<Self> {
        let mut builder = RouteBuilder::new(measures)?;
        let start = builder.level();
        for (place, command) in commands.iter().enumerate() {
            builder.go(command).map_err(|error| error.with_context(format!("command {}", place + 1)))?;
        }
        builder.route(start)
    }

    /// Makes a route to `goal` \[m\], in the frame of parallel feet about the origin, step by step. Each step turns the
    /// robot to the goal by at most `most_turn` and moves up to a length forward. The last step closes the feet, RH0
    /// 3.3. With a `heading` \[rad\] the robot turns to it on the spot at the end. At its goal already, it stands: the
    /// route has no steps.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when the goal is not finite or too far, or a dimension is not finite and positive.
    pub fn towards(goal: &Point2<f64>, heading: Option<f64>, first: Side, measures: &Measures) -> Result<Self> {
        let mut builder = RouteBuilder::new(measures)?;
        if !goal.iter().chain(&heading).all(|x| x.is_finite()) {
            return Err(bad("the goal is not finite; give --goal two numbers, in metres: forward, to the left"));
        }
        let start = builder.level();
        let turning_circle = 2.0 * measures.length / measures.most_turn;
        let mut side = first;
        loop {
            let offset = goal - builder.middle.point();
            if offset.norm() < ARRIVED {
                break;
            }
            let bearing = angle::difference(offset.y.atan2(offset.x), builder.middle.yaw);
            let yaw = bearing.clamp(-measures.most_turn, measures.most_turn);
            // Inside its turning circle the robot would never face the goal, so it turns on the spot.
            let advance = match bearing - yaw {
                0.0 => offset.norm().min(measures.length),
                left if offset.norm() > turning_circle => measures.length * left.cos().max(0.0),
                _ => 0.0,
            };
            let turned = builder.middle.then(&Footprint { yaw, ..Footprint::default() });
            builder.middle = turned.then(&Footprint { x: advance, ..Footprint::default() });
            builder.land(side)?;
            side = side.other();
        }
        let mut left = heading.map_or(0.0, |heading| angle::difference(heading, builder.middle.yaw));
        while left != 0.0 {
            let yaw = left.clamp(-measures.most_turn, measures.most_turn);
            builder.middle = builder.middle.then(&Footprint { yaw, ..Footprint::default() });
            builder.land(side)?;
            side = side.other();
            left -= yaw;
        }
        if builder.steps.is_empty() {
            return Ok(Route::at_rest(start));
        }
        builder.land(side)?;
        let mut route = builder.route(start)?;
        // After a step forward the robot is halfway between both feet.
        route.rests = route.stands().iter().map(|feet| feet[0].middle(&feet[1])).collect();
        Ok(route)
    }
}

impl RouteBuilder {
    fn new(measures: &Measures) -> Result<Self> {
        let Measures { length, half_width, most_turn } = *measures;
        let positive = [
            ("length of a step", length, "--length"),
            ("half width", half_width, "--half-width"),
            ("greatest turn of a step", most_turn, "--max-turn"),
        ];
        if let Some((name, value, option)) = positive.iter().find(|(_, value, _)| !(value.is_finite() && *value > 0.0))
        {
            return Err(bad(&format!("the {name} is {value}; give {option} a positive number")));
        }
        let middle = Footprint::default();
        Ok(RouteBuilder { measures: *measures, middle, ahead: [0.0; 2], steps: Vec::new(), rests: vec![middle] })
    }

    /// Moves both feet beside the middle.
    fn level(&self) -> [Footprint; 2] {
        [Side::Left, Side::Right].map(|side| self.beside(side))
    }

    fn route(self, start: [Footprint; 2]) -> Result<Route> {
        let mut route = Route::new(start, self.steps)?;
        route.rests = self.rests;
        Ok(route)
    }

    fn go(&mut self, command: &StepCommand) -> Result<()> {
        let half = self.measures.length / 2.0;
        let level = self.ahead == [0.0; 2];
        let is_rear = |side: Side| self.ahead[side as usize] < 0.0;
        match *command {
            StepCommand::Out(_) | StepCommand::Turn(_) if !level => {
                Err(bad("the feet are not side by side; give `in` first"))
            }
            StepCommand::Stride(side) | StepCommand::In(side) if !is_rear(side) => {
                Err(bad(&format!("the {} foot is not at the rear; give `out` or the other foot first", side.name())))
            }
            StepCommand::Out(side) => self.step(side, half, [half, -half]),
            StepCommand::Stride(side) => self.step(side, 2.0 * half, [half, -half]),
            StepCommand::In(side) => self.step(side, half, [0.0, 0.0]),
            StepCommand::Turn(angle) => self.turn(angle),
        }
    }

    /// Moves the middle forward by `advance`; afterwards the foot of `side` and the other one are `ahead` of the
    /// middle.
    fn step(&mut self, side: Side, advance: f64, ahead: [f64; 2]) -> Result<()> {
        self.middle = self.middle.then(&Footprint { x: advance, ..Footprint::default() });
        self.ahead[side as usize] = ahead[0];
        self.ahead[side.other() as usize] = ahead[1];
        self.land(side)
    }

    /// Pairs of steps on the spot, all by the same angle; the foot on the outer side moves first.
    fn turn(&mut self, angle: f64) -> Result<()> {
        // Rounding must not add a pair to a whole number of pairs.
        let pairs = (angle.abs() / self.measures.most_turn - 1e-9).ceil().max(1.0);
        if pairs > MAX_STEPS as f64 {
            return Err(bad(&format!("the turn takes more than {MAX_STEPS} steps")));
        }
        let first = if angle > 0.0 { Side::Right } else { Side::Left };
        for _ in 0..pairs as usize {
            self.middle = self.middle.then(&Footprint { yaw: angle / pairs, ..Footprint::default() });
            self.land(first)?;
            self.land(first.other())?;
        }
        Ok(())
    }

    fn land(&mut self, side: Side) -> Result<()> {
        if self.steps.len() == MAX_STEPS {
            return Err(bad(&format!(
                "the walk has more than {MAX_STEPS} steps; give longer ones (--length) or a nearer goal"
            )));
        }
        self.steps.push(Footstep { side, print: self.beside(side) });
        self.rests.push(self.middle);
        Ok(())
    }

    fn beside(&self, side: Side) -> Footprint {
        let (x, y) = (self.ahead[side as usize], side.sign() * self.measures.half_width);
        self.middle.then(&Footprint { x, y, ..Footprint::default() })
    }
}

fn bad(text: &str) -> Error {
    Error::new(ErrorKind::BadValue, text)
}
