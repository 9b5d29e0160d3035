//! Invariants of consecutive joints: a point on all their axes, the component along a direction, a direction.
//!
//! Because of these three invariants joints cancel in an equation: RH0 (2-14) (a point of the axis is fixed), (2-15)
//! (the distance from it is constant), and for parallel axes the component along them.

use nalgebra::{Point3, Unit, Vector3};

use super::reduced::{Goal, Member};
use crate::spatial::line::PARALLEL;
use crate::spatial::{Axis, Screw};

/// Definition of an invariant of a row of screws. Indices count from the row's start.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Feature {
    /// A point.
    Point(FixedPoint),
    /// The component of every point along a direction.
    Component(Line),
    /// A direction.
    Direction(Line),
}

/// A point that a row leaves fixed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum FixedPoint {
    /// The member's own point on its axis, moved along the axis by this length.
    On(usize, f64),
    /// The intersection of the axes of two members.
    Meeting(usize, usize),
    /// The tip, if the axes of all joints of the row contain it, or for an empty row.
    Tip,
}

/// A direction that a row leaves fixed.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Line {
    /// The direction of a member.
    Along(usize),
    /// Normal to two prismatic members.
    Normal(usize, usize),
    /// Normal to one prismatic member; one of two choices.
    Across(usize, bool),
}

/// A [`Feature`] in space.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Object {
    Point(Point3<f64>),
    /// The plane through the point with this normal.
    Plane(Unit<Vector3<f64>>, Point3<f64>),
    Direction(Unit<Vector3<f64>>),
}

/// Reference lengths of a chain for the search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Scale {
    /// A typical length of the chain.
    pub length: f64,
    /// Lengths up to this value count as zero.
    pub tolerance: f64,
}

/// All features of a nonempty row.
pub(super) fn features(row: &[Member], scale: Scale) -> Vec<Feature> {
    let points = fixed_points(row, scale).into_iter().map(Feature::Point);
    let planes = components(row).into_iter().map(Feature::Component);
    let directions = directions(row).into_iter().map(Feature::Direction);
    points.chain(planes).chain(directions).collect()
}

/// The features of the last joints of the loop. If the goal is a point, the tip is the only one.
pub(super) fn last_features(row: &[Member], goal: &Goal, scale: Scale) -> Vec<Feature> {
    match goal {
        Goal::Pose(_) if row.is_empty() => Vec::new(),
        Goal::Pose(_) => features(row, scale),
        Goal::Point { from, .. } => {
            let stays = row.iter().all(|m| m.screw.axis().is_some_and(|a| a.distance_to(from) <= scale.tolerance));
            if stays { vec![Feature::Point(FixedPoint::Tip)] } else { Vec::new() }
        }
    }
}

/// Points that the row leaves fixed.
fn fixed_points(row: &[Member], scale: Scale) -> Vec<FixedPoint> {
    let contains = |p: &Point3<f64>| axes(row).all(|axis| axis.distance_to(p) <= scale.tolerance);
    if axes(row).count() < row.len() {
        return Vec::new();
    }
    match row {
        [] => Vec::new(),
        [_] => vec![FixedPoint::On(0, 0.0), FixedPoint::On(0, scale.length), FixedPoint::On(0, -scale.length)],
        [first, second, ..] => {
            let own = (0..row.len()).find(|&i| row[i].screw.axis().is_some_and(|axis| contains(&axis.point())));
            if let Some(i) = own {
                return vec![FixedPoint::On(i, 0.0)];
            }
            let (Some(a), Some(b)) = (first.screw.axis(), second.screw.axis()) else { return Vec::new() };
            let meets = a.nearest_points(b).is_some_and(|(p, q)| contains(&p) && contains(&q));
            if meets { vec![FixedPoint::Meeting(0, 1)] } else { Vec::new() }
        }
    }
}

/// Directions along which the row leaves all components constant.
fn components(row: &[Member]) -> Vec<Line> {
    let slides: Vec<usize> = (0..row.len()).filter(|&i| row[i].screw.axis().is_none()).collect();
    if axes(row).next().is_some() {
        let along = first_parallel(row).filter(|&i| {
            slides.iter().all(|&j| direction(&row[i].screw).dot(&direction(&row[j].screw)).abs() <= PARALLEL)
        });
        return along.map(Line::Along).into_iter().collect();
    }
    match slides[..] {
        [i] => vec![Line::Across(i, false), Line::Across(i, true)],
        [i, j] => vec![Line::Normal(i, j)],
        _ => Vec::new(),
    }
}

/// Directions that the row leaves fixed. For a row of prismatic joints every direction is.
fn directions(row: &[Member]) -> Vec<Line> {
    match axes(row).next() {
        Some(_) => first_parallel(row).map(Line::Along).into_iter().collect(),
        None => vec![Line::Along(0), Line::Across(0, false)],
    }
}

/// The first revolute member, if the axes of all revolute members are parallel.
fn first_parallel(row: &[Member]) -> Option<usize> {
    let first = row.iter().position(|member| member.screw.axis().is_some())?;
    let axis = row[first].screw.axis()?;
    axes(row).all(|other| axis.is_parallel(other)).then_some(first)
}

fn axes(row: &[Member]) -> impl Iterator<Item = &Axis> {
    row.iter().filter_map(|member| member.screw.axis())
}

/// The direction of a joint's motion.
pub(super) fn direction(screw: &Screw) -> Unit<Vector3<f64>> {
    match screw {
        Screw::Revolute(axis) => axis.direction(),
        Screw::Prismatic(direction) => *direction,
    }
}

impl Feature {
    /// The object in space; `None` when two axes that should intersect are parallel, or a normal is undefined.
    pub fn locate(self, row: &[Member], goal: &Goal) -> Option<Object> {
        match self {
            Feature::Point(spot) => spot.locate(row, goal).map(Object::Point),
            Feature::Component(line) => Some(Object::Plane(line.locate(row)?, anchor(row))),
            Feature::Direction(line) => line.locate(row).map(Object::Direction),
        }
    }
}

/// A point of a plane. Any point is suitable, since the row keeps each point at its height.
fn anchor(row: &[Member]) -> Point3<f64> {
    axes(row).next().map_or_else(Point3::origin, Axis::point)
}

impl FixedPoint {
    fn locate(self, row: &[Member], goal: &Goal) -> Option<Point3<f64>> {
        match self {
            FixedPoint::On(i, along) => {
                let axis = row[i].screw.axis()?;
                Some(if along == 0.0 { axis.point() } else { axis.point() + axis.direction().scale(along) })
            }
            FixedPoint::Meeting(i, j) => {
                let (a, b) = row[i].screw.axis()?.nearest_points(row[j].screw.axis()?)?;
                Some(nalgebra::center(&a, &b))
            }
            FixedPoint::Tip => match goal {
                Goal::Point { from, .. } => Some(*from),
                Goal::Pose(_) => None,
            },
        }
    }
}

impl Line {
    fn locate(self, row: &[Member]) -> Option<Unit<Vector3<f64>>> {
        match self {
            Line::Along(i) => Some(direction(&row[i].screw)),
            Line::Normal(i, j) => {
                let normal = direction(&row[i].screw).cross(&direction(&row[j].screw));
                Unit::try_new(normal, PARALLEL)
            }
            Line::Across(i, second) => {
                let along = direction(&row[i].screw);
                let first = along.cross(&Vector3::ith(along.iamin(), 1.0));
                Unit::try_new(if second { along.cross(&first) } else { first }, PARALLEL)
            }
        }
    }
}
