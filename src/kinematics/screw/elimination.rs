//! The elimination of the first two of three joints: what is left is an [`Equation`] for the third.
//!
//! The first joint leaves two functions of a point as they are (see [`two_joints`](super::two_joints)). Of a point that the second
//! joint has turned, both are linear in its part y across the second axis: `g1.y = f1`, `g2.y = f2`, where g1, g2 are constant and
//! f1, f2 are [`Form`]s of the third joint. The second joint does not change the length of y, hence
//! `|f1 g2 - f2 g1|^2 = det(g1, g2)^2 |y|^2`: a quartic. Where the first two axes are parallel or meet, or the first slides
//! across the second axis, one of g1, g2 vanishes and its form alone must be zero. The quartic has then double roots, so that
//! near these cases both equations give candidates.

use nalgebra::{Point3, Unit, Vector3};
use smallvec::SmallVec;

use super::quartic::{Equation, Form, zeros};
use super::two_joints::{across, facing};
use crate::spatial::{Axis, Screw};

/// A condition counts as nearly independent of the second joint when its vector across the axis is shorter than this.
const WEAK: f64 = 1e-2;

/// Forms whose coefficients are below this vanish identically.
const VANISHING: f64 = 1e-12;

/// Where the third joint takes the point: `centre + u cos q + v sin q`, or `centre + u q`.
pub(super) struct Path {
    turns: bool,
    centre: Vector3<f64>,
    u: Vector3<f64>,
    v: Vector3<f64>,
}

impl Path {
    pub fn new(screw: &Screw, p: &Point3<f64>) -> Self {
        match screw {
            Screw::Revolute(axis) => {
                let centre = axis.foot(p);
                let u = p - centre;
                Path { turns: true, centre: centre.coords, u, v: axis.direction().cross(&u) }
            }
            Screw::Prismatic(d) => Path { turns: false, centre: p.coords, u: d.into_inner(), v: Vector3::zeros() },
        }
    }

    /// `n.(x - origin)` for the points x of the path.
    fn along(&self, n: &Vector3<f64>, origin: &Point3<f64>) -> Form {
        [n.dot(&(self.centre - origin.coords)), n.dot(&self.u), n.dot(&self.v)]
    }

    /// `|x - origin|^2` for the points x of the path.
    fn squared_distance(&self, origin: &Point3<f64>) -> Form {
        let arm = self.centre - origin.coords;
        match self.turns {
            true => [arm.norm_squared() + self.u.norm_squared(), 2.0 * arm.dot(&self.u), 2.0 * arm.dot(&self.v)],
            false => [arm.norm_squared(), 2.0 * arm.dot(&self.u), 1.0],
        }
    }
}

/// The equations that the third joint alone must solve.
pub(super) struct Elimination {
    turns: bool,
    /// The quartic; none when the first two joints slide.
    quartic: Option<Equation>,
    /// Forms that must be zero, or nearly.
    forms: SmallVec<[Form; 2]>,
    /// How far the first two joints are from a case in which one form alone must be zero.
    pub strength: f64,
}

impl Elimination {
    /// Of the joints `first` and `second` from `exp(first) exp(second) x = k` for the points x of `path`.
    pub fn new(first: &Screw, second: &Screw, path: &Path, k: &Point3<f64>) -> Self {
        match (first, second) {
            (_, Screw::Revolute(axis)) => turning(first, axis, path, k),
            (Screw::Revolute(axis), Screw::Prismatic(direction)) => sliding(axis, direction, path, k),
            (Screw::Prismatic(direction), Screw::Prismatic(_)) => {
                let [normal, _] = across(direction, second);
                let forms = SmallVec::from_elem(path.along(&normal, k), 1);
                Elimination { turns: path.turns, quartic: None, forms, strength: 0.0 }
            }
        }
    }

    /// Whether the third joint remains undetermined.
    pub fn vanishes(&self) -> bool {
        let is_zero = |form: &Form| form.iter().all(|c| c.abs() <= VANISHING);
        match &self.quartic {
            Some(quartic) if self.strength > VANISHING => quartic.vanishes(),
            _ => self.forms.iter().all(is_zero),
        }
    }

    /// Values near which all solutions are.
    pub fn candidates(&self) -> SmallVec<[f64; 16]> {
        let quartic = self.quartic.iter().filter(|_| self.strength > VANISHING);
        let weak = self.forms.iter().flat_map(|form| zeros(form, self.turns));
        weak.chain(quartic.flat_map(Equation::candidates)).collect()
    }
}

/// The second joint turns about `axis`.
fn turning(first: &Screw, axis: &Axis, path: &Path, k: &Point3<f64>) -> Elimination {
    let w = axis.direction().into_inner();
    let flat = |g: &Vector3<f64>| g - w * w.dot(g);
    let (second, rows) = match first {
        Screw::Revolute(first) => revolute_rows(first, axis, path, k),
        Screw::Prismatic(direction) => {
            let second = axis.point();
            let row = |n: Unit<Vector3<f64>>| (n.into_inner(), [n.dot(&(k - second)), 0.0, 0.0]);
            (second, across(direction, &Screw::Revolute(*axis)).map(row))
        }
    };
    let height = path.along(&w, &second);
    let [(g1, f1), (g2, f2)] = rows.map(|(g, f)| (flat(&g), combined(1.0, &f, -g.dot(&w), &height)));
    let det = w.dot(&g1.cross(&g2));
    let [a, b] = basis(&w);
    let part = |n: &Vector3<f64>| combined(n.dot(&g2), &f1, -n.dot(&g1), &f2);
    let (pa, pb, one) = (part(&a), part(&b), [1.0, 0.0, 0.0]);
    let squares =
        [(1.0, pa, pa), (1.0, pb, pb), (-det * det, path.squared_distance(&second), one), (det * det, height, height)];
    let rows = [(g1, f1), (g2, f2)];
    let forms = rows.iter().filter(|(g, _)| g.norm() <= WEAK).map(|(_, f)| *f).collect();
    let quartic = Equation { turns: path.turns, terms: squares.into_iter().collect() };
    Elimination { turns: path.turns, quartic: Some(quartic), forms, strength: g1.norm().min(g2.norm()) }
}

/// The conditions `g.z = f` on `z = y - origin`, y turned by the second joint: the height along the first axis, and the distance
/// from a point of it; with the origin, a point of the second axis.
fn revolute_rows(
    first: &Axis,
    second: &Axis,
    path: &Path,
    k: &Point3<f64>,
) -> (Point3<f64>, [(Vector3<f64>, Form); 2]) {
    let (r1, r2) = (facing(first, second), facing(second, first));
    let (w1, apart) = (first.direction().into_inner(), r2 - r1);
    let [one, c, s] = path.squared_distance(&r2);
    let radius = (k - r1).norm_squared() - apart.norm_squared();
    let height = [w1.dot(&(k - r2)), 0.0, 0.0];
    (r2, [(w1, height), (apart, [(radius - one) / 2.0, -c / 2.0, -s / 2.0])])
}

/// The second joint slides along `direction`, the first turns about `axis`: the height of `k` gives the displacement, the radius
/// is the equation.
fn sliding(axis: &Axis, direction: &Unit<Vector3<f64>>, path: &Path, k: &Point3<f64>) -> Elimination {
    let w = axis.direction().into_inner();
    let r = axis.foot(k);
    let rate = w.dot(direction);
    let height = path.along(&w, k).map(|c| -c);
    let along = path.along(direction, &r);
    let one = [1.0, 0.0, 0.0];
    let terms = [
        (rate * rate, path.squared_distance(&r), one),
        (2.0 * rate, height, along),
        (1.0, height, height),
        (-rate * rate * (k - r).norm_squared(), one, one),
    ];
    let forms = if rate.abs() <= WEAK { SmallVec::from_elem(height, 1) } else { SmallVec::new() };
    let quartic = Equation { turns: path.turns, terms: terms.into_iter().collect() };
    Elimination { turns: path.turns, quartic: Some(quartic), forms, strength: rate.abs() }
}

fn combined(a: f64, f: &Form, b: f64, g: &Form) -> Form {
    std::array::from_fn(|i| a * f[i] + b * g[i])
}

/// Two normals of `w` at right angles.
fn basis(w: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let first = w.cross(&Vector3::ith(w.iamin(), 1.0)).normalize();
    [first, w.cross(&first)]
}
