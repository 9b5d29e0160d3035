//! Self-collision: which links of a robot touch one another. Main type: [`Clearance`].
//!
//! Bodies are capsules: spheres and capsules exactly, cylinders and boxes by their longest inner capsule. Meshes are
//! ignored.

use nalgebra::{Point3, Vector3};

use super::{Model, Placed};
use crate::model::{Robot, Shape, Solid};

/// A capsule of a link, in the base frame at the zero configuration.
#[derive(Clone, Debug, PartialEq)]
struct Capsule {
    link: usize,
    body: usize,
    ends: [Point3<f64>; 2],
    radius: f64,
}

/// Two links that touch.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Touch {
    /// The indices of the links in the robot.
    pub links: [usize; 2],
    /// Penetration depth \[m\].
    pub depth: f64,
}

/// The capsules of a robot and the pairs that are tested. Pairs of one body are not tested, nor pairs of bodies without
/// another capsule between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Clearance {
    capsules: Vec<Capsule>,
    pairs: Vec<(usize, usize)>,
}

impl Clearance {
    /// Builds the capsules of all collision shapes of `robot`. `model` is its mechanical model.
    pub fn new(robot: &Robot, model: &Model) -> Self {
        let mut capsules = Vec::new();
        for (link, described) in robot.links().iter().enumerate() {
            let (body, base_from_link) = model.link(link);
            for (ends, radius) in described.collisions.iter().filter_map(capsule) {
                capsules.push(Capsule { link, body, ends: ends.map(|end| base_from_link * end), radius });
            }
        }
        let mut is_shaped = vec![false; model.joints().len() + 1];
        capsules.iter().for_each(|capsule| is_shaped[capsule.body] = true);
        let all = (0..capsules.len()).flat_map(|a| (0..a).map(move |b| (a, b)));
        let pairs = all.filter(|(a, b)| !are_neighbours(model, &is_shaped, capsules[*a].body, capsules[*b].body));
        Clearance { pairs: pairs.collect(), capsules }
    }

    /// The links that touch in the configuration `placed`, deepest first. For each pair of links only the deepest
    /// contact is returned.
    pub fn touching(&self, placed: &Placed<'_>) -> Vec<Touch> {
        let at = |capsule: &Capsule| capsule.ends.map(|end| placed.motion(capsule.body) * end);
        let moved: Vec<[Point3<f64>; 2]> = self.capsules.iter().map(at).collect();
        let mut touches: Vec<Touch> = Vec::new();
        for (a, b) in &self.pairs {
            let (one, other) = (&self.capsules[*a], &self.capsules[*b]);
            let depth = one.radius + other.radius - distance(&moved[*a], &moved[*b]);
            if depth > 0.0 {
                touches.push(Touch { links: [other.link, one.link], depth });
            }
        }
        touches.sort_by(|a, b| b.depth.total_cmp(&a.depth));
        let mut found = Vec::new();
        touches.retain(|touch| {
            let is_new = !found.contains(&touch.links);
            found.push(touch.links);
            is_new
        });
        touches
    }
}

/// The capsule of a shape in the frame of its link; `None` for a mesh.
fn capsule(shape: &Shape) -> Option<([Point3<f64>; 2], f64)> {
    let (axis, half, radius) = match shape.solid {
        Solid::Sphere { radius } => (2, 0.0, radius),
        Solid::Capsule { radius, length } => (2, length / 2.0, radius),
        Solid::Cylinder { radius, length } => {
            let radius = radius.min(length / 2.0);
            (2, length / 2.0 - radius, radius)
        }
        Solid::Box { size } => {
            let longest = (0..3).max_by(|a, b| size[*a].total_cmp(&size[*b]))?;
            let radius = size.iter().copied().fold(f64::INFINITY, f64::min) / 2.0;
            (longest, size[longest] / 2.0 - radius, radius)
        }
        Solid::Mesh { .. } => return None,
    };
    let along = Vector3::ith(axis, half);
    Some(([-along, along].map(|end| shape.pose() * Point3::from(end)), radius))
}

/// Whether two bodies are equal, or no other body on the path between them has a capsule.
fn are_neighbours(model: &Model, is_shaped: &[bool], a: usize, b: usize) -> bool {
    let bodies = |body: usize| {
        let path = model.path(body);
        [0].into_iter().chain(path.into_iter().map(|joint| joint + 1)).collect::<Vec<usize>>()
    };
    let (one, other) = (bodies(a), bodies(b));
    let shared = one.iter().zip(&other).take_while(|(a, b)| a == b).count();
    // The last body that both paths share also belongs to the path.
    let path = one[shared..].iter().chain(&other[shared..]).chain(&one[shared - 1..shared]);
    path.filter(|body| **body != a && **body != b).all(|body| !is_shaped[*body])
}

/// The distance of two segments (Ericson 2005, 5.1.9).
fn distance([p, q]: &[Point3<f64>; 2], [r, s]: &[Point3<f64>; 2]) -> f64 {
    let (u, v, w) = (q - p, s - r, p - r);
    let (a, b, c, d, e) = (u.dot(&u), u.dot(&v), v.dot(&v), u.dot(&w), v.dot(&w));
    let share = |top: f64, bottom: f64| if bottom > 0.0 { (top / bottom).clamp(0.0, 1.0) } else { 0.0 };
    let mut first = share(b * e - c * d, a * c - b * b);
    let second = share(b * first + e, c);
    first = share(b * second - d, a);
    let second = share(b * first + e, c);
    (w + u * first - v * second).norm()
}
