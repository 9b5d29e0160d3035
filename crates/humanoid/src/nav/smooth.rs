//! Smoothing of paths: lines and arcs. Main type: [`Smooth`].
//!
//! L. Dubins, On Curves of Minimal Length with a Constraint on Average Curvature (American Journal of Mathematics 79,
//! 1957): between two directions an arc of the least radius is the shortest.

use nalgebra::{Point2, Rotation2, Vector2};

use super::map::Map;
use super::path::Path;
use super::traversal::time;
use crate::{Error, ErrorKind, Result};

/// The length of the chords of an arc for collision checks, in cells.
const CHORD: f64 = 0.05;
/// The greatest turn that is smoothed \[rad\].
const MOST_TURN: f64 = 3.0;
/// The number of iterations that place outer arcs through their original corners.
const ROUNDS: usize = 20;

/// A segment of a smooth path.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Part {
    /// A straight line \[m\].
    Line {
        /// Its start.
        from: Point2<f64>,
        /// Its end.
        to: Point2<f64>,
    },
    /// An arc of a circle \[m, rad\].
    Arc {
        /// Its centre.
        centre: Point2<f64>,
        /// Its radius.
        radius: f64,
        /// The angle from the centre to its start.
        angle: f64,
        /// Its angle, anticlockwise.
        turn: f64,
    },
}

/// A path of lines and arcs. The direction is continuous except at sharp corners.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Smooth {
    /// Its segments.
    pub parts: Vec<Part>,
    /// The corners that stay sharp because the map has no room for an arc: the robot turns there on the spot \[m\].
    pub sharp: Vec<Point2<f64>>,
}

impl Part {
    /// Its length \[m\].
    pub fn length(&self) -> f64 {
        match self {
            Part::Line { from, to } => (to - from).norm(),
            Part::Arc { radius, turn, .. } => radius * turn.abs(),
        }
    }

    /// The position \[m\] and the direction of motion \[rad\] at a fraction of the segment, from zero to one.
    pub fn pose(&self, share: f64) -> (Point2<f64>, f64) {
        match *self {
            Part::Line { from, to } => (from + (to - from) * share, (to.y - from.y).atan2(to.x - from.x)),
            Part::Arc { centre, radius, angle, turn } => {
                let at = angle + turn * share;
                let heading = at + turn.signum() * std::f64::consts::FRAC_PI_2;
                (centre + Vector2::new(at.cos(), at.sin()) * radius, heading.sin().atan2(heading.cos()))
            }
        }
    }
}

impl Smooth {
    /// Its length \[m\].
    pub fn length(&self) -> f64 {
        self.parts.iter().map(Part::length).sum()
    }

    /// Poses along the path at most `step` apart \[m\], including the ends of all segments: positions \[m\] and
    /// headings \[rad\].
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a step that is not positive.
    pub fn poses(&self, step: f64) -> Result<Vec<(Point2<f64>, f64)>> {
        if !(step.is_finite() && step > 0.0) {
            return Err(Error::new(ErrorKind::BadValue, format!("a step of {step} m: give a positive number")));
        }
        let along = |part: &Part| {
            let (part, count) = (*part, (part.length() / step).ceil().max(1.0) as usize);
            (0..=count).map(move |place| part.pose(place as f64 / count as f64))
        };
        Ok(self.parts.iter().flat_map(along).collect())
    }
}

impl Path {
    /// Replaces the corners of the path by arcs of a radius \[m\]: inside the corner where the map has room, else
    /// through the corner. A corner where neither is clear stays sharp and is reported.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a radius that is not positive, a path that crosses an obstacle, and one without
    /// points.
    pub fn smoothed(&self, map: &Map, radius: f64) -> Result<Smooth> {
        if !(radius.is_finite() && radius > 0.0) {
            return Err(Error::new(ErrorKind::BadValue, format!("a radius of {radius} m: give a positive number")));
        }
        self.check_clear(map)?;
        let mut bends = Bends::new(&self.points, radius);
        loop {
            bends.settle();
            let (parts, corners) = bends.parts();
            // Each corner that blocks a segment gets another arc, until none does.
            let blocked: Vec<usize> = parts
                .iter()
                .zip(corners)
                .filter(|(part, _)| !is_clear(map, part))
                .flat_map(|(_, corners)| corners)
                .collect();
            let crowded = bends.crowded();
            if blocked.is_empty() && crowded.is_empty() {
                return Ok(Smooth { parts, sharp: bends.sharp() });
            }
            if !bends.change_arcs(&blocked, &crowded) {
                unreachable!("a clear path with sharp corners is clear");
            }
        }
    }
}

/// The treatment of a corner.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Inside,
    /// The corner is moved outwards, so that the arc passes through its original position.
    Outside,
    Sharp,
}

/// The corners of a path and their arcs.
struct Bends<'a> {
    /// The original path; its ends have no arcs.
    old: &'a [Point2<f64>],
    points: Vec<Point2<f64>>,
    kinds: Vec<Kind>,
    radius: f64,
}

impl<'a> Bends<'a> {
    fn new(old: &'a [Point2<f64>], radius: f64) -> Self {
        Bends { old, points: old.to_vec(), kinds: vec![Kind::Inside; old.len()], radius }
    }

    fn inner(&self) -> std::ops::Range<usize> {
        1..self.old.len().max(2) - 1
    }

    /// The directions into a corner and out of it, and the anticlockwise angle between them.
    fn turn(&self, place: usize) -> (Vector2<f64>, Vector2<f64>, f64) {
        let direction =
            |from: usize| (self.points[from + 1] - self.points[from]).try_normalize(0.0).unwrap_or_default();
        let (into, out) = (direction(place - 1), direction(place));
        (into, out, into.perp(&out).atan2(into.dot(&out)))
    }

    /// The distance from a corner to the start of its arc.
    fn reach(&self, place: usize) -> f64 {
        if place == 0 || place + 1 == self.old.len() || self.kinds[place] == Kind::Sharp {
            return 0.0;
        }
        self.radius * (0.5 * self.turn(place).2.abs()).tan()
    }

    /// Moves the corners that have outer arcs.
    fn settle(&mut self) {
        self.points.copy_from_slice(self.old);
        for _ in 0..ROUNDS {
            for place in self.inner() {
                let (into, out, turn) = self.turn(place);
                if self.kinds[place] == Kind::Outside {
                    let away = (into - out).try_normalize(0.0).unwrap_or_default();
                    let depth = self.radius * (1.0 / (0.5 * turn).cos() - 1.0);
                    self.points[place] = self.old[place] + away * (depth * 1.001);
                }
            }
        }
    }

    /// Lines and arcs, each with the corners that it depends on.
    fn parts(&self) -> (Vec<Part>, Vec<Vec<usize>>) {
        let (mut parts, mut corners) = (vec![], vec![]);
        let mut from = self.points[0];
        for place in self.inner() {
            let (into, out, turn) = self.turn(place);
            let (corner, reach) = (self.points[place], self.reach(place));
            parts.push(Part::Line { from, to: corner - into * reach });
            corners.push(vec![place - 1, place]);
            from = corner + out * reach;
            if reach > 0.0 {
                let begin = corner - into * reach;
                let outwards = Rotation2::new(-turn.signum() * std::f64::consts::FRAC_PI_2) * into;
                let centre = begin - outwards * self.radius;
                parts.push(Part::Arc { centre, radius: self.radius, angle: outwards.y.atan2(outwards.x), turn });
                corners.push(vec![place]);
            }
        }
        let last = self.points.len() - 1;
        parts.push(Part::Line { from, to: self.points[last] });
        corners.push(vec![last.saturating_sub(1), last]);
        (parts, corners)
    }

    /// Corners that turn too much, or whose arcs would overlap the neighbouring ones. Of two it is the one whose arc
    /// starts farther away.
    fn crowded(&self) -> Vec<usize> {
        let turns =
            self.inner().filter(|place| self.kinds[*place] != Kind::Sharp && self.turn(*place).2.abs() > MOST_TURN);
        let overlaps = (0..self.old.len().saturating_sub(1)).filter_map(|place| {
            let reaches = [self.reach(place), self.reach(place + 1)];
            let is_tight = reaches[0] + reaches[1] > (self.points[place + 1] - self.points[place]).norm();
            is_tight.then_some(if reaches[0] > reaches[1] { place } else { place + 1 })
        });
        turns.chain(overlaps).collect()
    }

    /// Changes blocked corners to outer arcs, then to sharp corners; returns whether one has changed.
    fn change_arcs(&mut self, blocked: &[usize], crowded: &[usize]) -> bool {
        let before = self.kinds.clone();
        for place in blocked.iter().filter(|place| self.old.len() > **place + 1 && **place > 0) {
            self.kinds[*place] = match before[*place] {
                Kind::Inside => Kind::Outside,
                _ => Kind::Sharp,
            };
        }
        crowded.iter().for_each(|place| self.kinds[*place] = Kind::Sharp);
        self.kinds != before
    }

    fn sharp(&self) -> Vec<Point2<f64>> {
        self.inner().filter(|place| self.kinds[*place] == Kind::Sharp).map(|place| self.old[place]).collect()
    }
}

/// Whether a segment is clear of obstacles; an arc is checked by its chords.
fn is_clear(map: &Map, part: &Part) -> bool {
    let count = match part {
        Part::Line { .. } => 1,
        Part::Arc { .. } => (part.length() / (CHORD * map.resolution())).ceil().max(1.0) as usize,
    };
    let points: Vec<Point2<f64>> =
        (0..=count).map(|place| map.in_map(&part.pose(place as f64 / count as f64).0)).collect();
    time(map, &points).is_some()
}
