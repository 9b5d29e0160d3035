//! Relations between the joint axes of a chain, which make it solvable in closed form. Main type: [`Geometry`].
//!
//! Relations of neighbours, runs of parallel axes and axes through one point hold in every configuration if they hold
//! at zero.

use std::fmt;

use nalgebra::{Point3, Unit, Vector3};

use super::{Chain, LengthUnit};
use crate::spatial::{Axis, Relation, Screw};

/// Distances up to this fraction of the reach count as zero.
pub(crate) const TOLERANCE: f64 = 1e-9;

/// Two neighbouring joints.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Neighbours {
    /// The index of the first joint. The other one is next.
    pub first: usize,
    /// The angle between the lines of the axes, in \[0, pi/2\] \[rad\].
    pub angle: f64,
    /// The relation of the axes, with distances in the chain's length unit; `None` when one of them is prismatic and
    /// has no position.
    pub relation: Option<Relation>,
}

/// Consecutive revolute joints whose axes intersect in one point.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Meeting {
    /// The indices of the joints, two or more.
    pub joints: std::ops::Range<usize>,
    /// The point in the base frame at the zero configuration, in the chain's length unit.
    pub point: Point3<f64>,
}

/// Relations between the axes of a chain.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Geometry {
    /// The names of the joints.
    pub names: Vec<String>,
    /// The unit of lengths.
    pub length_unit: LengthUnit,
    /// Each pair of neighbouring joints.
    pub neighbours: Vec<Neighbours>,
    /// Maximal ranges of two or more consecutive revolute joints with parallel axes.
    pub parallel: Vec<std::ops::Range<usize>>,
    /// Maximal ranges of two or more consecutive revolute joints, not all parallel, with axes through one point.
    pub meeting: Vec<Meeting>,
}

impl Geometry {
    /// Computes the geometry of `chain`. Distances up to 1e-9 of its reach count as zero, and angles up to 1e-9 rad as
    /// parallel.
    pub fn of(chain: &Chain) -> Self {
        let screws = chain.screws();
        let tolerance = TOLERANCE * size(chain);
        let neighbours: Vec<Neighbours> =
            screws.windows(2).enumerate().map(|(first, pair)| relate(first, &pair[0], &pair[1], tolerance)).collect();
        Geometry {
            names: chain.joints().iter().map(|joint| joint.name.clone()).collect(),
            length_unit: chain.length_unit(),
            parallel: parallel_runs(screws),
            meeting: meetings(screws, &neighbours, tolerance),
            neighbours,
        }
    }
}

/// The reach, or the distance from the base if the whole chain is one point.
fn size(chain: &Chain) -> f64 {
    let far = chain.joints().iter().map(|joint| joint.location().coords.norm()).fold(0.0, f64::max);
    if chain.reach() > 0.0 { chain.reach() } else { far }
}

fn axis(screw: &Screw) -> Option<&Axis> {
    if let Screw::Revolute(axis) = screw { Some(axis) } else { None }
}

fn direction(screw: &Screw) -> Unit<Vector3<f64>> {
    match screw {
        Screw::Revolute(axis) => axis.direction(),
        Screw::Prismatic(direction) => *direction,
    }
}

fn relate(first: usize, a: &Screw, b: &Screw, tolerance: f64) -> Neighbours {
    let (u, v) = (direction(a), direction(b));
    let angle = u.cross(&v).norm().atan2(u.dot(&v).abs());
    let relation = axis(a).zip(axis(b)).map(|(a, b)| a.relation(b, tolerance));
    Neighbours { first, angle, relation }
}

/// Maximal ranges of two or more consecutive joints in which all neighbours satisfy `together`.
fn runs(count: usize, together: impl Fn(usize) -> bool) -> Vec<std::ops::Range<usize>> {
    let (mut runs, mut start) = (Vec::new(), 0);
    for next in 1..=count {
        if next == count || !together(next - 1) {
            if next - start > 1 {
                runs.push(start..next);
            }
            start = next;
        }
    }
    runs
}

fn parallel_runs(screws: &[Screw]) -> Vec<std::ops::Range<usize>> {
    runs(screws.len(), |first| {
        let pair = axis(&screws[first]).zip(axis(&screws[first + 1]));
        pair.is_some_and(|(a, b)| a.is_parallel(b))
    })
}

/// For each pair of intersecting axes, all consecutive axes through the point of intersection.
fn meetings(screws: &[Screw], neighbours: &[Neighbours], tolerance: f64) -> Vec<Meeting> {
    let mut meetings: Vec<Meeting> = Vec::new();
    for pair in neighbours {
        let Some(Relation::Intersecting { point }) = pair.relation else { continue };
        let goes_through = |screw: &Screw| axis(screw).is_some_and(|axis| axis.distance_to(&point) <= tolerance);
        let before = screws[..pair.first].iter().rev().take_while(|screw| goes_through(screw)).count();
        let after = screws[pair.first + 2..].iter().take_while(|screw| goes_through(screw)).count();
        let joints = pair.first - before..pair.first + 2 + after;
        if meetings.last().is_none_or(|last| last.joints != joints) {
            meetings.push(Meeting { joints, point });
        }
    }
    meetings
}

/// Formats a number with at most twelve significant digits; zero below `tiny`.
fn tidy(value: f64, tiny: f64) -> String {
    if value.abs() <= tiny {
        return "0".to_owned();
    }
    let digits = (11 - value.abs().log10().floor() as i32).clamp(0, 30) as usize;
    let text = format!("{value:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

impl Geometry {
    /// Formats a range as `1-2`, with joints counted from 1.
    fn label(range: &std::ops::Range<usize>) -> String {
        format!("{}-{}", range.start + 1, range.end)
    }

    fn list(&self, range: &std::ops::Range<usize>) -> String {
        self.names[range.clone()].join(", ")
    }

    fn length(&self, value: f64) -> String {
        format!("{} {}", tidy(value, 0.0), self.length_unit.symbol())
    }

    /// Describes the relation of a pair.
    fn words(&self, pair: &Neighbours) -> String {
        let degrees = tidy(pair.angle.to_degrees(), 1e-9);
        let crossing = match degrees.as_str() {
            "90" => "perpendicular".to_owned(),
            degrees => format!("at {degrees} deg"),
        };
        match pair.relation {
            Some(Relation::Coincident) => "the same line".to_owned(),
            Some(Relation::Parallel { distance }) => format!("parallel, {} apart", self.length(distance)),
            Some(Relation::Intersecting { .. }) => format!("meet, {crossing}"),
            Some(Relation::Skew { distance, .. }) => format!("skew, {crossing}, {} apart", self.length(distance)),
            None if degrees == "0" => "parallel directions".to_owned(),
            None => format!("directions {crossing}"),
        }
    }

    /// Each pair of neighbours: label, names, relation.
    fn pairs(&self) -> Vec<[String; 3]> {
        let row = |pair: &Neighbours| {
            let range = pair.first..pair.first + 2;
            [Geometry::label(&range), self.list(&range), self.words(pair)]
        };
        self.neighbours.iter().map(row).collect()
    }

    /// Groups of three and more joints, and pairs that intersect: label, names, what they share.
    fn groups(&self) -> Vec<[String; 3]> {
        let group = |joints, shared| [Geometry::label(joints), self.list(joints), shared];
        let parallel = self.parallel.iter().map(|run| group(run, "parallel axes".to_owned()));
        let meeting = self.meeting.iter().map(|meeting| {
            let [x, y, z] = <[f64; 3]>::from(meeting.point).map(|value| tidy(value, 1e-12));
            group(&meeting.joints, format!("through one point, ({x}, {y}, {z}) {}", self.length_unit.symbol()))
        });
        parallel.chain(meeting).collect()
    }
}

/// Neighbours, then groups, one line each. Joints are counted from 1.
impl fmt::Display for Geometry {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (pairs, groups) = (self.pairs(), self.groups());
        let width =
            |column: usize| pairs.iter().chain(&groups).map(|row| row[column].chars().count()).max().unwrap_or(0);
        let (first, second) = (width(0), width(1));
        let line = |[label, names, text]: &[String; 3]| format!("  {label:<first$}  {names:<second$}  {text}");
        let mut lines = vec!["neighbouring axes".to_owned()];
        lines.extend(pairs.iter().map(line));
        lines.push("groups".to_owned());
        lines.extend(groups.iter().map(line));
        if groups.is_empty() {
            lines.push("  none: no two neighbouring axes are parallel or meet".to_owned());
        }
        f.write_str(&lines.join("\n"))
    }
}
