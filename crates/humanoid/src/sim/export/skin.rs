//! Triangles of bodies. Main type: [`Skin`].

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use nalgebra::{Point3, Vector3};

use super::Body;
use groebot_robot::model::Solid;

/// The number of segments of a circle; a multiple of four.
const ROUND: u32 = 20;

/// The triangles of a box about the origin. The bits of a corner's number, from the lowest, are its sides in x, y and
/// z.
const BOX: [[u32; 3]; 12] = [
    [0, 4, 6],
    [0, 6, 2],
    [1, 3, 7],
    [1, 7, 5],
    [0, 1, 5],
    [0, 5, 4],
    [2, 6, 7],
    [2, 7, 3],
    [0, 2, 3],
    [0, 3, 1],
    [4, 5, 7],
    [4, 7, 6],
];

/// Triangles, each counterclockwise as seen from outside.
pub struct Skin {
    pub points: Vec<Point3<f64>>,
    /// One per point; empty where each triangle is flat.
    pub normals: Vec<Vector3<f64>>,
    pub triangles: Vec<[u32; 3]>,
}

/// A ring of a body of revolution: its radius, its height, and the latitude of its normal.
type Ring = (f64, f64, f64);

impl Skin {
    /// The surface of a body in its own frame.
    pub fn of(body: &Body) -> Self {
        match body {
            Body::Surface(own) => {
                Skin { points: own.points.clone(), normals: Vec::new(), triangles: own.triangles.clone() }
            }
            Body::Solid(solid) => Skin::of_solid(solid),
        }
    }

    fn of_solid(solid: &Solid) -> Self {
        match *solid {
            Solid::Box { size } => {
                let side =
                    |corner: u32, axis: usize| if corner >> axis & 1 == 1 { size[axis] } else { -size[axis] } / 2.0;
                let points =
                    (0..8).map(|corner| Point3::from(std::array::from_fn::<f64, 3, _>(|axis| side(corner, axis))));
                Skin { points: points.collect(), normals: Vec::new(), triangles: BOX.to_vec() }
            }
            Solid::Cylinder { radius, length } => {
                let [low, high] = [-length / 2.0, length / 2.0];
                let under = [(0.0, low, -FRAC_PI_2), (radius, low, -FRAC_PI_2)];
                let over = [(radius, high, FRAC_PI_2), (0.0, high, FRAC_PI_2)];
                turned(&[under, [(radius, low, 0.0), (radius, high, 0.0)], over].concat())
            }
            Solid::Sphere { radius } => turned(&ball(radius, 0.0)),
            Solid::Capsule { radius, length } => turned(&ball(radius, length / 2.0)),
            Solid::Mesh { .. } => Skin { points: Vec::new(), normals: Vec::new(), triangles: Vec::new() },
        }
    }
}

/// The rings of a ball whose halves are moved apart by `half` each.
fn ball(radius: f64, half: f64) -> Vec<Ring> {
    let count = ROUND / 2;
    let ring = |place: u32, half: f64| {
        let latitude = PI * (f64::from(place) / f64::from(count) - 0.5);
        let is_pole = place == 0 || place == count;
        (if is_pole { 0.0 } else { radius * latitude.cos() }, radius * latitude.sin() + half, latitude)
    };
    let lower = (0..=count / 2).map(|place| ring(place, -half));
    lower.chain((count / 2..=count).map(|place| ring(place, half))).collect()
}

/// The surface through rings, from the lowest up.
fn turned(rings: &[Ring]) -> Skin {
    let turn = |step: u32| TAU * f64::from(step) / f64::from(ROUND);
    let around = |(out, height): (f64, f64)| {
        (0..ROUND).map(move |step| Vector3::new(out * turn(step).cos(), out * turn(step).sin(), height))
    };
    let points = rings.iter().flat_map(|(out, height, _)| around((*out, *height))).map(Point3::from).collect();
    let normals = rings.iter().flat_map(|(_, _, latitude)| around((latitude.cos(), latitude.sin()))).collect();
    let mut triangles = Vec::new();
    for (below, pair) in (0..).zip(rings.windows(2)) {
        let at = |ring: u32, step: u32| ROUND * (below + ring) + step % ROUND;
        // Two rings at one place have no surface between them, a pole no second triangle.
        let is_seam = (pair[0].0, pair[0].1) == (pair[1].0, pair[1].1);
        for step in (0..ROUND).filter(|_| !is_seam) {
            if pair[0].0 > 0.0 {
                triangles.push([at(0, step), at(0, step + 1), at(1, step + 1)]);
            }
            if pair[1].0 > 0.0 {
                triangles.push([at(0, step), at(1, step + 1), at(1, step)]);
            }
        }
    }
    Skin { points, normals, triangles }
}
