//! The way that a walker is to follow. Main type: [`Course`].

use std::fmt;

use nalgebra::Point2;

use super::floor::Floor;
use super::pilot::Pilot;
use super::stance::Stances;
use crate::gait::Footprint;
use crate::nav::{self, Enclosure, Field, Forces, Guide, Map, Potential, Way};
use crate::{Error, ErrorKind, Result, Watch};

/// By how much more than it should, as a share, the body keeps away at most: circles are polygons around them.
const ROUNDED: f64 = 0.04;

/// How the way is found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Method {
    /// The shortest way.
    #[default]
    Exact,
    /// Down a field of fast marching, RH0 (4-15), pulled taut.
    FastMarching,
    /// Down a field of the thesis' M3R, RH0 (4-17), pulled taut.
    M3r,
    /// Down an artificial potential field, which may be stuck and then says so, RH0 Fig. 4-12.
    Potential,
}

/// Where a walker is to get.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Goal {
    /// Where the middle of its feet is to be \[m\].
    pub place: Point2<f64>,
    /// Where it is to look \[rad\]; as it comes where there is none.
    pub heading: Option<f64>,
}

impl Goal {
    /// That of x and y \[m\], and a heading \[rad\] if one is told.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for another count of numbers than two or three.
    pub fn of(numbers: &[f64]) -> Result<Self> {
        match *numbers {
            [x, y] => Ok(Goal { place: Point2::new(x, y), heading: None }),
            [x, y, heading] => Ok(Goal { place: Point2::new(x, y), heading: Some(heading) }),
            _ => Err(Error::new(ErrorKind::BadValue, "a goal has two or three numbers: x, y, heading")),
        }
    }

    /// Its numbers, as [`Goal::of`] takes them.
    pub fn numbers(&self) -> Vec<f64> {
        [self.place.x, self.place.y].into_iter().chain(self.heading).collect()
    }
}

/// A way for the middle of a walker's feet.
#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    /// Where it leads.
    pub goal: Goal,
    /// The way.
    pub way: Way,
    /// Whether there is room for the walker on it however it is turned; else steps are to be searched.
    pub is_wide: bool,
}

impl Course {
    /// The way from a place to a goal: with room for the walker however it is turned; where there is none, with room for it at some heading everywhere; else with room for its core. Where there is no way for that, either, what encloses start or goal,
    /// which is proof that the walker gets nowhere.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a start or goal off the map or too near to an obstacle, with the nearest place that is not; [`Watch::check`].
    pub fn find(
        pilot: &Pilot,
        floor: &Floor,
        start: &Footprint,
        goal: Goal,
        method: Method,
        watch: &Watch,
    ) -> Result<std::result::Result<Self, Blocked>> {
        if goal.heading.is_some_and(|heading| !heading.is_finite()) {
            return Err(Error::new(ErrorKind::BadValue, "the heading at the goal is not finite; give a finite number"));
        }
        let places = |is_wide: bool| match is_wide {
            true => floor.of_disc(pilot.radius() + floor.map().half_diagonal() + ROUNDED * floor.apart()),
            false => Stances::new(pilot, floor)?.places(watch),
        };
        for is_wide in [true, false] {
            match way(&places(is_wide)?, &start.point(), &goal.place, method, watch) {
                Ok(Ok(way)) => return Ok(Ok(Course { goal, way, is_wide })),
                Ok(Err(_)) => {}
                Err(error) if error.kind() == ErrorKind::BadValue => {}
                Err(error) => return Err(error),
            }
        }
        let narrow = floor.of_core(pilot)?;
        let found = way(&narrow, &start.point(), &goal.place, method, watch)?;
        Ok(found
            .map(|way| Course { goal, way, is_wide: false })
            .map_err(|enclosure| Blocked { enclosure, map: narrow }))
    }
}

/// Why there is no way.
#[derive(Clone, Debug, PartialEq)]
pub struct Blocked {
    /// The cells that no way leaves.
    pub enclosure: Enclosure,
    /// The map whose cells they are: obstacles grown by the walker's core.
    pub map: Map,
}

impl fmt::Display for Blocked {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let area = self.enclosure.cells.len() as f64 * self.map.resolution().powi(2);
        write!(
            f,
            "there is no path: {} cells ({area:.2} m^2) that nothing as wide as the body's core leaves enclose start or goal",
            self.enclosure.cells.len()
        )
    }
}

/// The way on a map by a method.
fn way(
    map: &Map,
    start: &Point2<f64>,
    goal: &Point2<f64>,
    method: Method,
    watch: &Watch,
) -> Result<std::result::Result<Way, Enclosure>> {
    let down = |method: nav::Method| match Field::new(map, &[*goal], method, watch)?.descend(map, start)? {
        Ok(way) => way.between(start, goal).taut(map, watch).map(Ok),
        Err(enclosure) => Ok(Err(enclosure)),
    };
    match method {
        Method::Exact => {
            let found = map.shortest_way(start, goal, &Guide::default(), watch)?;
            Ok(found.map(|shortest| shortest.way))
        }
        Method::FastMarching => down(nav::Method::FastMarching(1)),
        Method::M3r => down(nav::Method::M3r),
        Method::Potential => match Potential::new(map, goal, &Forces::default())?.descend(map, start)? {
            Ok(way) => way.between(start, goal).taut(map, watch).map(Ok),
            Err(stuck) => Err(Error::new(ErrorKind::BadValue, format!("{stuck}; take another method"))),
        },
    }
}
