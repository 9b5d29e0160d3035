//! A model in a configuration: poses of the bodies, centre of mass and momentum. Main type: [`Placed`].

use nalgebra::{Matrix3xX, Point3, Vector3};

use super::momentum::Momentum;
use super::{Model, ModelJoint};
use crate::Result;
use crate::spatial::{Inertia, Pose, Twist};

/// A [`Model`] in a configuration, with its base at a pose in the world frame.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed<'m> {
    model: &'m Model,
    /// For the base and each body: its displacement from the zero configuration with the base at the origin.
    motions: Vec<Pose>,
}

impl Model {
    /// Places the model: the base at `world_from_base` and the joints at `q`.
    ///
    /// # Errors
    /// [`crate::ErrorKind::BadValue`] unless `q` has one finite value per joint.
    pub fn place(&self, world_from_base: &Pose, q: &[f64]) -> Result<Placed<'_>> {
        self.check(q)?;
        let mut motions = vec![*world_from_base; self.bodies.len()];
        for &joint in &self.order {
            let ModelJoint { parent, screw, .. } = &self.joints()[joint];
            motions[joint + 1] = motions[*parent] * screw.exp(q[joint]);
        }
        Ok(Placed { model: self, motions })
    }
}

impl Placed<'_> {
    /// The displacement of a body from the zero configuration with the base at the origin. It maps a point of the body
    /// from the base frame at the zero configuration to the world frame. Body 0 is the base, `k + 1` is moved by joint
    /// `k`.
    ///
    /// # Panics
    /// When there is no such body.
    pub fn motion(&self, body: usize) -> Pose {
        self.motions[body]
    }

    /// The pose of a link of the robot in the world frame.
    ///
    /// # Panics
    /// When there is no such link.
    pub fn world_from_link(&self, link: usize) -> Pose {
        let (body, base_from_link) = self.model.link(link);
        self.motion(body) * base_from_link
    }

    /// The centre of mass in the world frame \[m\].
    pub fn centre_of_mass(&self) -> Point3<f64> {
        let moment = self.bodies().map(|(inertia, motion)| (motion * inertia.centre_of_mass()).coords * inertia.mass());
        Point3::from(moment.sum::<Vector3<f64>>() / self.model.mass())
    }

    /// The Jacobian of the centre of mass, 3 x (6 + n). Its velocity is the matrix times the twist (v, w) of the base
    /// in the world frame, followed by the joint velocities.
    pub fn centre_of_mass_jacobian(&self) -> Matrix3xX<f64> {
        let mut jacobian = Matrix3xX::zeros(6 + self.model.joints().len());
        let (carried, centres) = self.carried();
        let centre = centres[0];
        jacobian.fixed_view_mut::<3, 3>(0, 0).fill_with_identity();
        jacobian.fixed_view_mut::<3, 3>(0, 3).copy_from(&-centre.cross_matrix());
        for (joint, twist) in self.twists().enumerate().filter(|(joint, _)| carried[joint + 1] > 0.0) {
            let velocity = twist.v + twist.w.cross(&centres[joint + 1]);
            jacobian.set_column(6 + joint, &(velocity * (carried[joint + 1] / self.model.mass())));
        }
        jacobian
    }

    /// The momentum for the twist `base` of the base in the world frame \[m/s, rad/s\] and the joint velocities
    /// `rates`.
    ///
    /// # Errors
    /// [`crate::ErrorKind::BadValue`] unless `rates` has one finite value per joint.
    pub fn momentum(&self, base: &Twist, rates: &[f64]) -> Result<Momentum> {
        self.model.check(rates)?;
        let units: Vec<Twist> = self.twists().collect();
        let mut twists = vec![*base; self.motions.len()];
        for &joint in &self.model.order {
            twists[joint + 1] = twists[self.model.joints()[joint].parent] + units[joint] * rates[joint];
        }
        let parts = self.bodies().zip(&twists).map(|((inertia, motion), twist)| momentum(inertia, motion, twist));
        Ok(parts.sum())
    }

    /// Each body with its displacement, the base first.
    fn bodies(&self) -> impl Iterator<Item = (&Inertia, &Pose)> {
        self.model.bodies.iter().zip(&self.motions)
    }

    /// The unit twist of each joint in the world frame.
    fn twists(&self) -> impl Iterator<Item = Twist> {
        self.model.joints().iter().map(|joint| joint.screw.twist().transform(&self.motions[joint.parent]))
    }

    /// The mass that the base and each joint carry, and its centre in the world frame.
    fn carried(&self) -> (Vec<f64>, Vec<Vector3<f64>>) {
        let mut masses: Vec<f64> = self.model.bodies.iter().map(Inertia::mass).collect();
        let mut moments: Vec<Vector3<f64>> = self
            .bodies()
            .map(|(inertia, motion)| (motion * inertia.centre_of_mass()).coords * inertia.mass())
            .collect();
        for &joint in self.model.order.iter().rev() {
            let parent = self.model.joints()[joint].parent;
            masses[parent] += masses[joint + 1];
            let moment = moments[joint + 1];
            moments[parent] += moment;
        }
        let centres = moments.iter().zip(&masses).map(|(moment, mass)| moment / *mass).collect();
        (masses, centres)
    }
}

/// The momentum of a body at the displacement `motion` with a twist in the world frame.
fn momentum(inertia: &Inertia, motion: &Pose, twist: &Twist) -> Momentum {
    let centre = motion * inertia.centre_of_mass();
    let linear = (twist.v + twist.w.cross(&centre.coords)) * inertia.mass();
    let turn = motion.rotation;
    let spin = turn * (inertia.rotational() * turn.inverse_transform_vector(&twist.w));
    Momentum { linear, angular: centre.coords.cross(&linear) + spin }
}
