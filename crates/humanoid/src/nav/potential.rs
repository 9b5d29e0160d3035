//! The comparison method of RH0 4.3.7: an artificial potential field, which has local minima. Main type: [`Potential`].
//!
//! O. Khatib, Real-time obstacle avoidance for manipulators and mobile robots, International Journal of Robotics
//! Research 5 (1986). The attraction is quadratic, and conical far from the goal. The repulsion depends on the
//! reciprocal of the clearance.

use std::fmt;

use nalgebra::Point2;

use super::map::Map;
use super::path::{Path, around};
use crate::{Error, ErrorKind, Result};

/// Parameters of attraction and repulsion.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Forces {
    /// The gain of the attraction \[1/s^2\].
    pub attraction: f64,
    /// The distance from the goal beyond which the attraction is constant \[m\].
    pub reach: f64,
    /// The gain of the repulsion \[m^4/s^2\].
    pub repulsion: f64,
    /// The distance beyond which obstacles do not repel \[m\].
    pub influence: f64,
}

impl Default for Forces {
    /// Values for a robot of the size of a person in a room: it keeps a distance of half a metre where possible.
    fn default() -> Self {
        Forces { attraction: 1.0, reach: 1.0, repulsion: 0.02, influence: 0.5 }
    }
}

/// The potential by cell: the sum of those of the goal and of the nearest obstacle.
#[derive(Clone, Debug, PartialEq)]
pub struct Potential {
    goal: usize,
    values: Vec<f64>,
}

/// A descent that ended in a local minimum.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Stuck {
    /// The local minimum \[m\].
    pub place: Point2<f64>,
    /// The path to it.
    pub path: Path,
}

impl fmt::Display for Stuck {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (x, y) = (self.place.x, self.place.y);
        write!(f, "the potential field has a local minimum at ({x:.3}, {y:.3}), which is not the goal")
    }
}

impl std::error::Error for Stuck {}

impl Potential {
    /// Computes the potential of a map with a goal \[m\].
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a goal that is not free ([`Map::free_cell_at`]), or parameters that are not finite
    /// and positive.
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

    /// The potential by cell \[m^2/s^2\]; infinite in cells that are not free.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// Descends the potential from a place over the middles of cells, each time to the one of eight neighbours with the
    /// steepest slope. Returns the path, or the local minimum in which it is stuck.
    ///
    /// # Errors
    /// As [`Map::free_cell_at`].
    pub fn descend(&self, map: &Map, start: &Point2<f64>) -> Result<std::result::Result<Path, Stuck>> {
        let mut cell = map.free_cell_at(start)?;
        let mut points = vec![map.centre(cell)];
        while cell != self.goal {
            let fall = |(next, distance): &(usize, f64)| (self.values[cell] - self.values[*next]) / distance;
            let steepest = around(map, cell).max_by(|a, b| fall(a).total_cmp(&fall(b)));
            let Some((next, _)) = steepest.filter(|step| fall(step) > 0.0) else {
                return Ok(Err(Stuck { place: map.centre(cell), path: Path { points } }));
            };
            cell = next;
            points.push(map.centre(cell));
        }
        Ok(Ok(Path { points }))
    }
}

impl Forces {
    /// The attraction: a parabola, and the cone that continues it.
    fn attracting(&self, distance: f64) -> f64 {
        let near = distance.min(self.reach);
        self.attraction * near * (distance - 0.5 * near)
    }

    fn repelling(&self, clearance: f64) -> f64 {
        let excess = clearance.recip() - self.influence.recip();
        0.5 * self.repulsion * excess.max(0.0).powi(2)
    }
}
