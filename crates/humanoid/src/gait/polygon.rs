//! Convex polygons on the floor, such as the support polygon of NAO 6.4. Main type: [`Polygon`].

use nalgebra::Point2;

/// A convex polygon with its corners anticlockwise, none of them on a side. It may be a segment or a point.
#[derive(Clone, Debug, PartialEq)]
pub struct Polygon {
    corners: Vec<Point2<f64>>,
}

impl Polygon {
    /// The convex hull of `points` (Andrew 1979). Points that are not finite are ignored.
    pub fn hull(points: &[Point2<f64>]) -> Self {
        let mut sorted: Vec<Point2<f64>> =
            points.iter().filter(|p| p.x.is_finite() && p.y.is_finite()).copied().collect();
        sorted.sort_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        sorted.dedup();
        if sorted.len() < 3 {
            return Polygon { corners: sorted };
        }
        let mut corners = chain(sorted.iter());
        corners.pop();
        corners.extend(chain(sorted.iter().rev()));
        corners.pop();
        Polygon { corners }
    }

    /// The corners, anticlockwise.
    pub fn corners(&self) -> &[Point2<f64>] {
        &self.corners
    }

    /// The signed distance of `point` from the border \[m\]: positive inside, negative outside. For a segment or a
    /// point it is minus the distance; for an empty polygon minus infinity.
    pub fn signed_distance(&self, point: &Point2<f64>) -> f64 {
        let inside = self.corners.len() > 2 && self.sides().all(|(a, b)| cross(a, b, point) >= 0.0);
        let distance = self.sides().map(|(a, b)| distance_to_segment(point, a, b)).fold(f64::INFINITY, f64::min);
        if inside { distance } else { -distance }
    }

    /// The distance between two polygons \[m\]; zero when they intersect.
    pub fn distance_to(&self, other: &Polygon) -> f64 {
        if self.is_cut_by(other) {
            return 0.0;
        }
        let outside = |corners: &[Point2<f64>], of: &Polygon| {
            corners.iter().map(|corner| -of.signed_distance(corner)).fold(f64::INFINITY, f64::min)
        };
        outside(&self.corners, other).min(outside(&other.corners, self)).max(0.0)
    }

    /// The area \[m^2\].
    pub fn area(&self) -> f64 {
        self.sides().map(|(a, b)| a.x * b.y - b.x * a.y).sum::<f64>() / 2.0
    }

    /// Whether no side of this polygon separates the two. Two disjoint convex polygons are separated by a side of one
    /// of them.
    fn is_cut_by(&self, other: &Polygon) -> bool {
        let parts = |polygon: &Polygon, beyond: &Polygon| {
            polygon.corners.len() > 2
                && polygon.sides().any(|(a, b)| beyond.corners.iter().all(|corner| cross(a, b, corner) < 0.0))
        };
        !parts(self, other) && !parts(other, self)
    }

    fn sides(&self) -> impl Iterator<Item = (&Point2<f64>, &Point2<f64>)> {
        self.corners.iter().zip(self.corners.iter().cycle().skip(1))
    }
}

/// The lower chain of the convex hull of sorted points.
fn chain<'p>(points: impl Iterator<Item = &'p Point2<f64>>) -> Vec<Point2<f64>> {
    let mut corners: Vec<Point2<f64>> = Vec::new();
    for point in points {
        while let [.., a, b] = corners[..]
            && cross(&a, &b, point) <= 0.0
        {
            corners.pop();
        }
        corners.push(*point);
    }
    corners
}

/// Twice the signed area of a triangle, positive when its corners are anticlockwise.
fn cross(a: &Point2<f64>, b: &Point2<f64>, c: &Point2<f64>) -> f64 {
    (b - a).perp(&(c - a))
}

fn distance_to_segment(point: &Point2<f64>, a: &Point2<f64>, b: &Point2<f64>) -> f64 {
    let along = b - a;
    let length = along.norm_squared();
    let share = if length > 0.0 { ((point - a).dot(&along) / length).clamp(0.0, 1.0) } else { 0.0 };
    (point - (a + along * share)).norm()
}
