//! The places of a map. Main type: [`Grid`].

use serde::{Deserialize, Serialize};

use crate::{Error, ErrorKind, Result};

/// Maximal number of places in a grid.
const MOST: usize = groebot_algebra::limits::GRID_PLACES;

/// Places on an axis, evenly spaced.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Axis {
    /// The first place, in the solver's unit of length.
    pub from: f64,
    /// The last place.
    pub to: f64,
    /// Number of places.
    pub count: usize,
}

impl Axis {
    /// # Errors
    /// [`ErrorKind::BadValue`] for no places, for ends that are not finite or in the wrong order, and for one place with two different ends.
    pub fn new(from: f64, to: f64, count: usize) -> Result<Self> {
        let text = match count {
            _ if !(from.is_finite() && to.is_finite()) => {
                format!("an axis from {from} to {to} is invalid; give finite ends")
            }
            0 => "an axis without places; give 1 or more".to_owned(),
            1 if from != to => {
                format!("an axis with one place cannot extend from {from} to {to}; give 2 or more places, or one end")
            }
            _ if from > to || (from == to && count > 1) => {
                format!("{count} places from {from} to {to}: give the lower end first")
            }
            _ => return Ok(Axis { from, to, count }),
        };
        Err(Error::new(ErrorKind::BadValue, text))
    }

    /// The coordinate of the place with this index.
    pub fn at(&self, number: usize) -> f64 {
        if self.count == 1 {
            return self.from;
        }
        let share = number as f64 / (self.count - 1) as f64;
        self.from * (1.0 - share) + self.to * share
    }

    /// The distance between neighbouring places; zero if there is only one.
    pub fn step(&self) -> f64 {
        if self.count == 1 { 0.0 } else { (self.to - self.from) / (self.count - 1) as f64 }
    }
}

/// Places by x, y and z. The index of z changes fastest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Grid {
    axes: [Axis; 3],
}

impl Grid {
    /// # Errors
    /// Same as [`Axis::new`], with the name of the axis. [`ErrorKind::BadValue`] for more than 10^8 places.
    pub fn new(axes: [Axis; 3]) -> Result<Self> {
        for (axis, name) in axes.iter().zip(["x", "y", "z"]) {
            Axis::new(axis.from, axis.to, axis.count).map_err(|error| error.with_context(format!("`{name}`")))?;
        }
        let count = axes.iter().try_fold(1usize, |count, axis| count.checked_mul(axis.count));
        match count {
            Some(count) if count <= MOST => Ok(Grid { axes }),
            _ => {
                let [x, y, z] = axes.map(|axis| axis.count);
                let text = format!("{x} x {y} x {z} places; at most {MOST} are allowed");
                Err(Error::new(ErrorKind::BadValue, text))
            }
        }
    }

    /// The axes x, y and z.
    pub fn axes(&self) -> &[Axis; 3] {
        &self.axes
    }

    /// Number of places.
    pub fn places(&self) -> usize {
        self.axes.iter().map(|axis| axis.count).product()
    }

    /// The indices of a place by axis.
    pub fn numbers(&self, place: usize) -> [usize; 3] {
        let [_, y, z] = self.axes.map(|axis| axis.count);
        [place / (y * z), place / z % y, place % z]
    }

    /// The place with these indices by axis.
    pub fn place(&self, [x, y, z]: [usize; 3]) -> usize {
        (x * self.axes[1].count + y) * self.axes[2].count + z
    }

    /// The coordinates of a place.
    pub fn at(&self, place: usize) -> [f64; 3] {
        let numbers = self.numbers(place);
        std::array::from_fn(|axis| self.axes[axis].at(numbers[axis]))
    }
}
