//! Points of intersection of axes: [`at_meeting_points`].

use nalgebra::{Point3, Vector3};

use crate::spatial::{Axis, Screw};

/// The screws, with the point of each axis at an intersection with its neighbours: with three or more of them if
/// possible, else with one.
///
/// Such points stay exact while the joints move, even when their axes become almost parallel.
pub(super) fn at_meeting_points(screws: &[Screw], tolerance: f64) -> Vec<Screw> {
    let mut groups: Vec<(usize, usize, Point3<f64>)> = Vec::new();
    for start in 0..screws.len() {
        for stop in start + 2..=screws.len() {
            groups.extend(meeting_point(&screws[start..stop], tolerance).map(|point| (start, stop, point)));
        }
    }
    groups.sort_by_key(|(start, stop, _)| std::cmp::Reverse(stop - start));
    let mut points: Vec<Option<Point3<f64>>> = vec![None; screws.len()];
    for whole in [false, true] {
        for (start, stop, point) in &groups {
            let known = points[*start..*stop].iter().flatten().any(|p| (p - point).norm() <= tolerance);
            let open: Vec<usize> = (*start..*stop).filter(|&i| points[i].is_none()).collect();
            let taken = if whole { open.len() } else { usize::from(!known) };
            open.iter().take(taken).for_each(|&i| points[i] = Some(*point));
        }
    }
    let placed = |(screw, point): (&Screw, &Option<Point3<f64>>)| match (screw, point) {
        (Screw::Revolute(axis), Some(point)) => Screw::Revolute(axis.level_with(point)),
        _ => *screw,
    };
    screws.iter().zip(&points).map(placed).collect()
}

/// The common point of all axes of the row.
fn meeting_point(row: &[Screw], tolerance: f64) -> Option<Point3<f64>> {
    let axes: Vec<&Axis> = row.iter().map(Screw::axis).collect::<Option<_>>()?;
    let other = axes[1..].iter().find(|axis| !axes[0].is_parallel(axis))?;
    let (a, b) = axes[0].nearest_points(other)?;
    let point: Vector3<f64> = (a.coords + b.coords) / 2.0;
    let point = Point3::from(point);
    axes.iter().all(|axis| axis.distance_to(&point) <= tolerance).then_some(point)
}
