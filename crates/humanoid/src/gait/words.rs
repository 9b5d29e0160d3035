//! Walks in words, RH0 3.5.1: `out right, stride left, stride right, in left`, `turn left 90`. Main type: [`Word`].

use nalgebra::Point2;

use super::footprint::{Footprint, Footstep, MAX_STEPS, Route, Side};
use crate::{Error, ErrorKind, Result};
use groebot_robot::spatial::angle;

/// How near to its goal a walk ends \[m\].
const ARRIVED: f64 = 1e-3;

/// A part of a walk: one of the four kinds of steps of RH0 3.5.1, or a turn by as many as it takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Word {
    /// From level feet, the foot of this side goes one length ahead.
    Out(Side),
    /// From behind, the foot of this side goes one length ahead of the other one.
    Stride(Side),
    /// From behind, the foot of this side comes beside the other one.
    In(Side),
    /// On the spot, by pairs of steps \[rad\], anticlockwise.
    Turn(f64),
}

/// Reads the words of a walk, parted by commas.
///
/// # Errors
/// [`ErrorKind::Syntax`] for what is no word.
pub fn words(text: &str) -> Result<Vec<Word>> {
    let word = |part: &str| {
        let wrong = || {
            let text = format!(
                "`{}`: give `out`, `stride` or `in` with `left` or `right`, or `turn left` or `turn right` with degrees, parted by commas",
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
            ["out", name] => Ok(Word::Out(side(name)?)),
            ["stride", name] => Ok(Word::Stride(side(name)?)),
            ["in", name] => Ok(Word::In(side(name)?)),
            ["turn", name, degrees] => {
                let angle = degrees.parse::<f64>().ok().filter(|angle| angle.is_finite() && *angle > 0.0);
                Ok(Word::Turn(side(name)?.sign() * angle.ok_or_else(wrong)?.to_radians()))
            }
            _ => Err(wrong()),
        }
    };
    text.split(',').map(word).collect()
}

/// The measures of the steps of a walk in words. Metres, radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measures {
    /// `L_p`: how far ahead of the standing foot the other one lands.
    pub length: f64,
    /// `W_p`: half of the way from foot to foot, sideways.
    pub half_width: f64,
    /// `G_CM`: how far the robot turns by a pair of steps at most.
    pub most_turn: f64,
}

/// The feet and the trunk on the way.
struct Traveller {
    measures: Measures,
    /// Where the robot's middle is, and where it looks.
    middle: Footprint,
    /// How far ahead of the middle each foot is: half a length, or nothing.
    ahead: [f64; 2],
    steps: Vec<Footstep>,
    rests: Vec<Footprint>,
}

impl Route {
    /// The way of a walk in words, from level feet about the origin.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when a word does not fit to where the feet are, there are no words or too many steps, or a measure is not
    /// finite and positive.
    pub fn of_words(words: &[Word], measures: &Measures) -> Result<Self> {
        let mut traveller = Traveller::new(measures)?;
        let start = traveller.level();
        for (place, word) in words.iter().enumerate() {
            traveller.go(word).map_err(|error| error.with_context(format!("word {}", place + 1)))?;
        }
        traveller.route(start)
    }

    /// One step after the other towards `goal` \[m\], seen from level feet about the origin: each turns the robot to it as far as
    /// `most_turn` lets it and leads up to a length ahead, and the last one closes the feet, RH0 3.3. With a `heading` \[rad\] the robot turns to it
    /// on the spot before.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when the goal is not finite or too far, or a measure is not finite and positive.
    pub fn towards(goal: &Point2<f64>, heading: Option<f64>, first: Side, measures: &Measures) -> Result<Self> {
        let mut traveller = Traveller::new(measures)?;
        if !goal.iter().chain(&heading).all(|x| x.is_finite()) {
            return Err(bad("the goal is not finite; give --goal two numbers, in metres: ahead, to the left"));
        }
        let start = traveller.level();
        let turning_circle = 2.0 * measures.length / measures.most_turn;
        let mut side = first;
        loop {
            let way = goal - traveller.middle.point();
            if way.norm() < ARRIVED {
                break;
            }
            let bearing = angle::difference(way.y.atan2(way.x), traveller.middle.yaw);
            let yaw = bearing.clamp(-measures.most_turn, measures.most_turn);
            // Within the circle that it turns on, the robot would never face the goal: it turns on the spot.
            let advance = match bearing - yaw {
                0.0 => way.norm().min(measures.length),
                left if way.norm() > turning_circle => measures.length * left.cos().max(0.0),
                _ => 0.0,
            };
            let turned = traveller.middle.then(&Footprint { yaw, ..Footprint::default() });
            traveller.middle = turned.then(&Footprint { x: advance, ..Footprint::default() });
            traveller.land(side)?;
            side = side.other();
        }
        let mut left = heading.map_or(0.0, |heading| angle::difference(heading, traveller.middle.yaw));
        while left != 0.0 {
            let yaw = left.clamp(-measures.most_turn, measures.most_turn);
            traveller.middle = traveller.middle.then(&Footprint { yaw, ..Footprint::default() });
            traveller.land(side)?;
            side = side.other();
            left -= yaw;
        }
        traveller.land(side)?;
        let mut route = traveller.route(start)?;
        // A foot that goes ahead leaves the robot half-way between both.
        route.rests = route.stands().iter().map(|feet| feet[0].middle(&feet[1])).collect();
        Ok(route)
    }
}

impl Traveller {
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
        Ok(Traveller { measures: *measures, middle, ahead: [0.0; 2], steps: Vec::new(), rests: vec![middle] })
    }

    /// Both feet beside the middle.
    fn level(&self) -> [Footprint; 2] {
        [Side::Left, Side::Right].map(|side| self.beside(side))
    }

    fn route(self, start: [Footprint; 2]) -> Result<Route> {
        let mut route = Route::new(start, self.steps)?;
        route.rests = self.rests;
        Ok(route)
    }

    fn go(&mut self, word: &Word) -> Result<()> {
        let half = self.measures.length / 2.0;
        let level = self.ahead == [0.0; 2];
        let behind = |side: Side| self.ahead[side as usize] < 0.0;
        match *word {
            Word::Out(_) | Word::Turn(_) if !level => Err(bad("the feet are not level; give `in` first")),
            Word::Stride(side) | Word::In(side) if !behind(side) => {
                Err(bad(&format!("the {} foot is not behind; give `out` or the other foot first", side.name())))
            }
            Word::Out(side) => self.step(side, half, [half, -half]),
            Word::Stride(side) => self.step(side, 2.0 * half, [half, -half]),
            Word::In(side) => self.step(side, half, [0.0, 0.0]),
            Word::Turn(angle) => self.turn(angle),
        }
    }

    /// The middle goes `advance` ahead; behind it the foot of `side` and the other one are `ahead` of the middle.
    fn step(&mut self, side: Side, advance: f64, ahead: [f64; 2]) -> Result<()> {
        self.middle = self.middle.then(&Footprint { x: advance, ..Footprint::default() });
        self.ahead[side as usize] = ahead[0];
        self.ahead[side.other() as usize] = ahead[1];
        self.land(side)
    }

    /// Pairs of steps on the spot, of the same angle each; the foot on the outer side goes first.
    fn turn(&mut self, angle: f64) -> Result<()> {
        // A whole number of pairs must not become one more by rounding.
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
