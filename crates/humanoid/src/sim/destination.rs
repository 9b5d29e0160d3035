//! The destination of a robot: a place, or a piece of furniture. Main type: [`Destination`].

use std::f64::consts::TAU;

use nalgebra::{Point2, Vector2};

use crate::nav::{Field, Map, Method, Room, Shape, signed_area};
use crate::task::{Floor, Goal, Pilot};
use crate::{Error, ErrorKind, Result, Watch};
use groebot_robot::document::shown;

/// The greatest distance between two places in front of a side of furniture \[m\].
const ASIDE: f64 = 0.25;
/// The number of places around a circle.
const AROUND: usize = 24;

/// The destination of a robot.
#[derive(Clone, Debug, PartialEq)]
pub enum Destination {
    /// A place.
    Place(Goal),
    /// In front of the piece of furniture of that name, facing it: at the place that is reached first.
    Before(String),
}

impl From<Goal> for Destination {
    fn from(goal: Goal) -> Self {
        Destination::Place(goal)
    }
}

impl Destination {
    /// The goal for a robot that comes from a place. Where no place in front of the furniture can be reached, it is the
    /// nearest one, to which no path exists.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] for unknown furniture; [`ErrorKind::BadValue`] where there is no room in front of it;
    /// as [`Field::new`].
    pub fn goal<'w>(
        &self,
        room: &Room,
        pilot: &Pilot,
        floor: &Floor,
        from: &Point2<f64>,
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<Goal> {
        let watch = Watch::or_none(watch);
        let name = match self {
            Destination::Place(goal) => return Ok(*goal),
            Destination::Before(name) => name,
        };
        // A place is free where its cell is: half a cell's diagonal more on either side.
        let away = pilot.radius() + floor.apart() + 2.0 * floor.map().half_diagonal();
        let places = places(&room.piece(name)?.shape(), away);
        let wide = floor.of_disc(pilot.radius() + floor.map().half_diagonal())?;
        let core = floor.of_core(pilot)?;
        for map in [&wide, &core] {
            if map.free_cell_at(from).is_err() {
                continue;
            }
            let field = Field::new(map, &[*from], Method::FastMarching(1), watch)?;
            let time = |goal: &Goal| free(map, goal).map_or(f64::INFINITY, |cell| field.times()[cell]);
            let first = places.iter().min_by(|a, b| time(a).total_cmp(&time(b)));
            if let Some(first) = first.filter(|goal| time(goal).is_finite()) {
                return Ok(*first);
            }
        }
        let distance = |goal: &&Goal| (goal.place - from).norm();
        let near = places.iter().filter(|goal| free(&core, goal).is_some());
        near.min_by(|a, b| distance(a).total_cmp(&distance(b))).copied().ok_or_else(|| {
            let text = format!("the robot has no room in front of `{}`; give a place", shown(name));
            Error::new(ErrorKind::BadValue, text)
        })
    }
}

/// The cell of a goal, if it is free.
fn free(map: &Map, goal: &Goal) -> Option<usize> {
    map.cell_at(&goal.place).ok().filter(|cell| map.is_free(*cell))
}

/// Places at a distance from a shape \[m\], each facing it.
fn places(shape: &Shape, away: f64) -> Vec<Goal> {
    let before =
        |at: Point2<f64>, out: Vector2<f64>| Goal { place: at + out * away, heading: Some((-out.y).atan2(-out.x)) };
    match shape {
        Shape::Circle { centre, radius } => {
            let place = |count: usize| {
                let (sine, cosine) = (TAU * count as f64 / AROUND as f64).sin_cos();
                let out = Vector2::new(cosine, sine);
                before(centre + out * *radius, out)
            };
            (0..AROUND).map(place).collect()
        }
        Shape::Polygon(corners) => {
            let sides = corners.iter().zip(corners.iter().cycle().skip(1));
            let outwards = signed_area(corners).signum();
            let along = |(a, b): (&Point2<f64>, &Point2<f64>)| {
                let side = b - a;
                let out = Vector2::new(side.y, -side.x) * (outwards / side.norm());
                let count = (side.norm() / ASIDE).ceil().max(1.0);
                let shares = (0..count as usize).map(move |place| (place as f64 + 0.5) / count);
                let at = *a;
                shares.map(move |share| before(at + side * share, out))
            };
            sides.filter(|(a, b)| a != b).flat_map(along).collect()
        }
    }
}
