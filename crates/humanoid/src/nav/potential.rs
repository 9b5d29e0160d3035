//! The adversary of RH0 4.3.7: an artificial potential field, which has local minima. Main type: [`Potential`].
//!
//! O. Khatib, Real-time obstacle avoidance for manipulators and mobile robots, International Journal of Robotics Research 5 (1986): a quadratic attraction and a repulsion by the reciprocal
//! of the clearance; far from the goal the attraction is a cone.

use std::fmt;

use nalgebra::Point2;

use super::map::Map;
use super::way::{Way, around};
use crate::{Error, ErrorKind, Result};

/// What draws a robot to a goal and keeps it from obstacles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forces {
    /// How much the goal attracts \[1/s^2\].
    pub attraction: f64,
    /// Beyond that distance from the goal it attracts no more strongly \[m\].
    pub reach: f64,
    /// How much obstacles repel \[m^4/s^2\].
    pub repulsion: f64,
    /// Obstacles farther than that do not repel \[m\].
    pub influence: f64,
}

impl Default for Forces {
    /// For a robot of the size of a person in a room: it keeps half a metre away where it can.
    fn default() -> Self {
        Forces { attraction: 1.0, reach: 1.0, repulsion: 0.02, influence: 0.5 }
    }
}

/// A potential by cell: that of the goal and that of the nearest obstacle.
#[derive(Clone, Debug, PartialEq)]
pub struct Potential {
    goal: usize,
    values: Vec<f64>,
}

/// Where a potential field leads no further though the goal is elsewhere.
#[derive(Clone, Debug, PartialEq)]
pub struct Stuck {
    /// The local minimum \[m\].
    pub place: Point2<f64>,
    /// The way up to there.
    pub way: Way,
}

impl fmt::Display for Stuck {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (x, y) = (self.place.x, self.place.y);
        write!(f, "the potential field has a local minimum at ({x:.3}, {y:.3}), which is not the goal")
    }
}

impl std::error::Error for Stuck {}

impl Potential {
    /// That of a map with a goal \[m\].
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a goal that is not free ([`Map::free_cell_at`]), forces that are not finite and positive.
    pub fn new(map: &Map, goal: &Point2<f64>, forces: &Forces) -> Result<Self> {
        let Forces { attraction, reach, repulsion, influence } = *forces;
        if ![attraction, reach, repulsion, influence].iter().all(|x| x.is_finite() && *x > 0.0) {
            let text = format!("{forces:?}: give finite positive numbers");
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let goal = map.free_cell_at(goal)?;
        let middle = map.centre(goal);
        let value = |(cell, clearance): (usize, f64)| {
            if map.is_free(cell) {
                forces.attracting((map.centre(cell) - middle).norm()) + forces.repelling(clearance)
            } else {
                f64::INFINITY
            }
        };
        let values = map.clearances().into_iter().enumerate().map(value).collect();
        Ok(Potential { goal, values })
    }

    /// The potential by cell \[m^2/s^2\], infinite where nobody goes.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The way from a place down the field of its map, over the middles of cells, each the one of eight neighbours to which it falls most for its distance; or where it is stuck.
    ///
    /// # Errors
    /// As [`Map::free_cell_at`].
    pub fn descend(&self, map: &Map, start: &Point2<f64>) -> Result<std::result::Result<Way, Stuck>> {
        let mut cell = map.free_cell_at(start)?;
        let mut points = vec![map.centre(cell)];
        while cell != self.goal {
            let fall = |(next, distance): &(usize, f64)| (self.values[cell] - self.values[*next]) / distance;
            let steepest = around(map, cell).max_by(|a, b| fall(a).total_cmp(&fall(b)));
            let Some((next, _)) = steepest.filter(|step| fall(step) > 0.0) else {
                return Ok(Err(Stuck { place: map.centre(cell), way: Way { points } }));
            };
            cell = next;
            points.push(map.centre(cell));
        }
        Ok(Ok(Way { points }))
    }
}

impl Forces {
    /// A parabola, and the cone that continues it.
    fn attracting(&self, distance: f64) -> f64 {
        let near = distance.min(self.reach);
        self.attraction * near * (distance - 0.5 * near)
    }

    fn repelling(&self, clearance: f64) -> f64 {
        let excess = clearance.recip() - self.influence.recip();
        0.5 * self.repulsion * excess.max(0.0).powi(2)
    }
}
