//! Inertia and Coriolis matrices compared with the motion of point masses.

mod clearance;
mod coriolis;
mod equations;
mod exact;
mod identify;
mod lagrange;
pub mod parts;
mod pinocchio;
mod placed;
mod quantiles;
pub mod samples;

use groebot_robot::dynamics::Model;
use groebot_robot::spatial::{Inertia, Pose, Screw};
use nalgebra::{DVector, Matrix3, Point3, Vector3};
use proptest::prelude::*;

pub use parts::{Part, model};

use crate::kinematics::jacobian::screw;
use crate::spatial::{pose, vector};

/// A rigid body as point masses: (mass \[kg\], position in the link's frame \[m\]).
#[derive(Clone, Debug)]
pub struct Cloud(pub Vec<(f64, Vector3<f64>)>);

impl Cloud {
    pub fn mass(&self) -> f64 {
        self.0.iter().map(|(mass, _)| mass).sum()
    }

    pub fn centre(&self) -> Vector3<f64> {
        self.0.iter().map(|(mass, place)| place * *mass).sum::<Vector3<f64>>() / self.mass()
    }

    /// Sum of `m (d.d 1 - d d')` over the masses, `d` from the centre.
    pub fn tensor(&self) -> Matrix3<f64> {
        let terms = self.0.iter().map(|(mass, place)| {
            let d = place - self.centre();
            (Matrix3::identity() * d.norm_squared() - d * d.transpose()) * *mass
        });
        terms.sum()
    }

    pub fn inertia(&self) -> Inertia {
        Inertia::new(self.mass(), Point3::from(self.centre()), self.tensor()).unwrap()
    }
}

pub fn cloud() -> impl Strategy<Value = Cloud> {
    prop::collection::vec((0.1..2.0_f64, vector(0.5)), 4..7).prop_map(Cloud)
}

/// A manipulator, the masses of its bodies, and a state.
#[derive(Clone, Debug)]
pub struct Case {
    arm: Model,
    parts: Vec<Part>,
    clouds: Vec<Cloud>,
    q: Vec<f64>,
    velocity: Vec<f64>,
}

impl Case {
    /// The joint values after the time `t` at constant velocity.
    fn after(&self, t: f64) -> Vec<f64> {
        self.q.iter().zip(&self.velocity).map(|(q, rate)| q + t * rate).collect()
    }

    fn rates(&self) -> DVector<f64> {
        DVector::from_column_slice(&self.velocity)
    }

    fn base_from_link(&self, link: usize, q: &[f64]) -> Pose {
        let zero = self.parts[link].base_from_link;
        self.parts[..=link].iter().zip(q).rev().fold(zero, |pose, (part, q)| part.screw.exp(*q) * pose)
    }

    /// Half the sum of mass times squared velocity over the points of `link`, the velocities by differences.
    fn kinetic_energy_of(&self, link: usize) -> f64 {
        let place = |point: &Vector3<f64>, t| (self.base_from_link(link, &self.after(t)) * Point3::from(*point)).coords;
        let points = self.clouds[link].0.iter();
        points
            .map(|(mass, point)| crate::kinematics::jacobian::slope(|t| place(point, t)).norm_squared() * mass / 2.0)
            .sum()
    }
}

/// Manipulators of up to four joints.
pub fn case() -> impl Strategy<Value = Case> {
    (1..5_usize).prop_flat_map(|n| {
        let links = prop::collection::vec((screw(), pose(), cloud()), n);
        let numbers = || prop::collection::vec(-2.0..2.0_f64, n);
        (links, numbers(), numbers()).prop_map(|(links, q, velocity)| {
            let part = |(place, (screw, base_from_link, cloud)): (usize, &(Screw, Pose, Cloud))| Part {
                parent: place.checked_sub(1),
                screw: *screw,
                base_from_link: *base_from_link,
                inertia: cloud.inertia(),
            };
            let parts: Vec<Part> = links.iter().enumerate().map(part).collect();
            let clouds = links.into_iter().map(|(.., cloud)| cloud).collect();
            Case { arm: model(None, &parts), parts, clouds, q, velocity }
        })
    })
}
