//! The path that a walker follows. Main type: [`Course`].

use std::fmt;

use nalgebra::Point2;

use super::floor::Floor;
use super::pilot::Pilot;
use super::stance::Stances;
use crate::gait::Footprint;
use crate::nav::{self, Enclosure, Field, Forces, Guide, Map, Path, Potential};
use crate::{Error, ErrorKind, Result, Watch};

/// The greatest excess of the body's distance from obstacles, as a fraction: circles are approximated by polygons
/// around them.
const ROUNDED: f64 = 0.04;

/// The method that finds the path.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum Method {
    /// The shortest path.
    #[default]
    Exact,
    /// The descent path of a fast marching field, RH0 (4-15), pulled taut.
    FastMarching,
    /// The descent path of a field of the thesis' M3R, RH0 (4-17), pulled taut.
    M3r,
    /// The descent path of an artificial potential field. It may end in a local minimum, which is an error, RH0 Fig.
    /// 4-12.
    Potential,
}

/// The goal of a walker.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Goal {
    /// The position of the middle of its feet \[m\].
    pub place: Point2<f64>,
    /// The final heading \[rad\]; any heading where none is given.
    pub heading: Option<f64>,
}

/// A goal, and the method that finds the path to it. A [`Goal`] alone is reached by the shortest path.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Search {
    /// The goal.
    pub goal: Goal,
    /// The method.
    pub method: Method,
}

impl From<Goal> for Search {
    fn from(goal: Goal) -> Self {
        goal.by(Method::default())
    }
}

impl Goal {
    /// The search of a path to this goal by a method.
    pub fn by(self, method: Method) -> Search {
        Search { goal: self, method }
    }

    /// Makes a goal from x and y \[m\], and optionally a heading \[rad\].
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a number of values other than two or three.
    pub fn of(numbers: &[f64]) -> Result<Self> {
        match *numbers {
            [x, y] => Ok(Goal { place: Point2::new(x, y), heading: None }),
            [x, y, heading] => Ok(Goal { place: Point2::new(x, y), heading: Some(heading) }),
            _ => Err(Error::new(ErrorKind::BadValue, "a goal has two or three numbers: x, y, heading")),
        }
    }

    /// Its values, as [`Goal::of`] takes them.
    pub fn numbers(&self) -> Vec<f64> {
        [self.place.x, self.place.y].into_iter().chain(self.heading).collect()
    }
}

/// A path for the middle of a walker's feet.
#[derive(Clone, Debug, PartialEq)]
pub struct Course {
    /// Its goal.
    pub goal: Goal,
    /// The path.
    pub path: Path,
    /// Whether the walker has room on it at every heading; otherwise footsteps must be searched.
    pub is_wide: bool,
}

impl Course {
    /// Finds a path to a goal, with room for the walker at every heading. If there is none, the path has room at some
    /// heading everywhere, else room for the walker's core. If even that does not exist, returns the cells that enclose
    /// start or goal, which prove that the goal cannot be reached.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a start or goal outside the map or too near to an obstacle, with the nearest
    /// feasible place; [`Watch::check`].
    pub fn find<'w>(
        pilot: &Pilot,
        floor: &Floor,
        start: &Footprint,
        search: impl Into<Search>,
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<std::result::Result<Self, Blocked>> {
        let watch = Watch::or_none(watch);
        let Search { goal, method } = search.into();
        if goal.heading.is_some_and(|heading| !heading.is_finite()) {
            return Err(Error::new(ErrorKind::BadValue, "the heading at the goal is not finite; give a finite number"));
        }
        let places = |is_wide: bool| match is_wide {
            true => floor.of_disc(pilot.radius() + floor.map().half_diagonal() + ROUNDED * floor.apart()),
            false => Stances::new(pilot, floor)?.places(watch),
        };
        for is_wide in [true, false] {
            match path(&places(is_wide)?, &start.point(), &goal.place, method, watch) {
                Ok(Ok(path)) => return Ok(Ok(Course { goal, path, is_wide })),
                Ok(Err(_)) => {}
                Err(error) if error.kind() == ErrorKind::BadValue => {}
                Err(error) => return Err(error),
            }
        }
        let narrow = floor.of_core(pilot)?;
        let found = path(&narrow, &start.point(), &goal.place, method, watch)?;
        Ok(found
            .map(|path| Course { goal, path, is_wide: false })
            .map_err(|enclosure| Blocked { enclosure, map: narrow }))
    }
}

/// The proof that no path exists.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Blocked {
    /// The cells that no path leaves.
    pub enclosure: Enclosure,
    /// The map that contains them: obstacles grown by the walker's core.
    pub map: Map,
}

impl fmt::Display for Blocked {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let area = self.enclosure.cells.len() as f64 * self.map.resolution().powi(2);
        write!(
            f,
            "there is no path: {} cells ({area:.2} m^2) enclose start or goal; no path with the width of the body's core leaves them",
            self.enclosure.cells.len()
        )
    }
}

/// Finds the path on a map by a method.
fn path(
    map: &Map,
    start: &Point2<f64>,
    goal: &Point2<f64>,
    method: Method,
    watch: &Watch,
) -> Result<std::result::Result<Path, Enclosure>> {
    let down = |method: nav::Method| match Field::new(map, &[*goal], method, watch)?.descend(map, start)? {
        Ok(path) => path.between(start, goal).taut(map, watch).map(Ok),
        Err(enclosure) => Ok(Err(enclosure)),
    };
    match method {
        Method::Exact => {
            let found = map.shortest_path(start, goal, &Guide::default(), watch)?;
            Ok(found.map(|shortest| shortest.path))
        }
        Method::FastMarching => down(nav::Method::FastMarching(1)),
        Method::M3r => down(nav::Method::M3r),
        Method::Potential => match Potential::new(map, goal, &Forces::default())?.descend(map, start)? {
            Ok(path) => path.between(start, goal).taut(map, watch).map(Ok),
            Err(stuck) => Err(Error::new(ErrorKind::BadValue, format!("{stuck}; use another method"))),
        },
    }
}
