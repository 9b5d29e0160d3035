//! A robot that nothing holds: a base that moves freely, and a tree of links behind it. Main type: [`Multibody`].
//!
//! The motion of a link is the product of exponentials along its path, as in RH0 (2-20), behind the pose of the base.

use nalgebra::{Matrix3, Matrix3xX, Point3, Vector3};

use super::Body;
use super::momentum::Momentum;
use crate::spatial::{Pose, Screw, Twist};
use crate::{Error, ErrorKind, Result};

/// A link behind a joint of one freedom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limb {
    /// The link that carries the joint, by its place in the list; `None` for the base.
    pub parent: Option<usize>,
    /// The joint, in the base frame at the zero configuration.
    pub screw: Screw,
    /// What it moves; its frame is in the base frame at the zero configuration.
    pub body: Body,
}

/// A free base with a tree of links, each behind its joint: link `i` is moved by joint `i`. Metres, kilograms, radians.
#[derive(Clone, Debug, PartialEq)]
pub struct Multibody {
    limbs: Vec<Limb>,
    /// The base first, then the links.
    masses: Vec<Mass>,
    total: f64,
}

/// What a link weighs, in the base frame at the zero configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Mass {
    mass: f64,
    centre: Point3<f64>,
    rotational: Matrix3<f64>,
}

/// Where the links of a [`Multibody`] are.
#[derive(Clone, Debug, PartialEq)]
pub struct Placed<'m> {
    body: &'m Multibody,
    /// Of the base and of each link: its motion since the zero configuration with the base at the origin.
    motions: Vec<Pose>,
}

impl Multibody {
    /// The tree of `limbs` on `base`, whose frame is the base frame; each limb stands behind its parent in the list.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for a parent that does not stand before its limb, or a frame that is not finite.
    pub fn new(base: Body, limbs: Vec<Limb>) -> Result<Self> {
        if let Some(link) = limbs.iter().enumerate().position(|(i, limb)| limb.parent.is_some_and(|parent| parent >= i))
        {
            let text = format!("link {link}: its parent stands behind it; name parents before their limbs");
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let bodies: Vec<Body> = [base].into_iter().chain(limbs.iter().map(|limb| limb.body)).collect();
        let is_finite = |pose: &Pose| pose.to_homogeneous().iter().all(|x| x.is_finite());
        if !bodies.iter().all(|body| is_finite(&body.base_from_link)) {
            return Err(Error::new(ErrorKind::BadValue, "the frame of a link is not finite"));
        }
        let masses: Vec<Mass> = bodies.iter().map(Mass::of).collect();
        let total = masses.iter().map(|mass| mass.mass).sum();
        Ok(Multibody { limbs, masses, total })
    }

    /// The links, without the base.
    pub fn limbs(&self) -> &[Limb] {
        &self.limbs
    }

    /// The mass of base and links \[kg\].
    pub fn mass(&self) -> f64 {
        self.total
    }

    /// Where everything is when the base is at `world_from_base` and the joints are at `q`.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when `q` has not one finite value per joint.
    pub fn place(&self, world_from_base: &Pose, q: &[f64]) -> Result<Placed<'_>> {
        self.check(q)?;
        let mut motions = Vec::with_capacity(self.masses.len());
        motions.push(*world_from_base);
        for (limb, &value) in self.limbs.iter().zip(q) {
            let parent: Pose = motions[limb.parent.map_or(0, |parent| parent + 1)];
            motions.push(parent * limb.screw.exp(value));
        }
        Ok(Placed { body: self, motions })
    }

    fn check(&self, q: &[f64]) -> Result<()> {
        let text = if q.len() != self.limbs.len() {
            format!("{} joint values are given; the robot has {} joints", q.len(), self.limbs.len())
        } else if let Some(joint) = q.iter().position(|value| !value.is_finite()) {
            format!("joint {joint}: the value {} is not finite", q[joint])
        } else {
            return Ok(());
        };
        Err(Error::new(ErrorKind::BadValue, text))
    }
}

impl Mass {
    fn of(body: &Body) -> Self {
        let turn = body.base_from_link.rotation.to_rotation_matrix().into_inner();
        let inertia = &body.inertia;
        Mass {
            mass: inertia.mass(),
            centre: body.base_from_link * inertia.centre_of_mass(),
            rotational: turn * inertia.rotational() * turn.transpose(),
        }
    }
}

impl Placed<'_> {
    /// The pose of the base in the world.
    pub fn world_from_base(&self) -> Pose {
        self.motions[0]
    }

    /// The motion of link `link` since the zero configuration with the base at the origin: it takes what is fixed to the link from its
    /// place in the base frame at the zero configuration to its place in the world.
    pub fn motion(&self, link: usize) -> Pose {
        self.motions[link + 1]
    }

    /// The pose of the frame of link `link` in the world.
    pub fn world_from_link(&self, link: usize) -> Pose {
        self.motion(link) * self.body.limbs[link].body.base_from_link
    }

    /// The centre of mass in the world \[m\].
    pub fn centre_of_mass(&self) -> Point3<f64> {
        let moment = self.bodies().map(|(mass, motion)| (motion * mass.centre).coords * mass.mass);
        Point3::from(moment.sum::<Vector3<f64>>() / self.body.total)
    }

    /// How the centre of mass moves, 3 x (6 + n): its velocity is the matrix times the twist (v, w) of the base, in the world frame, and
    /// below it the rates of the joints.
    pub fn centre_of_mass_jacobian(&self) -> Matrix3xX<f64> {
        let mut jacobian = Matrix3xX::zeros(6 + self.body.limbs.len());
        let (carried, centres) = self.carried();
        let centre = centres[0];
        jacobian.fixed_view_mut::<3, 3>(0, 0).fill_with_identity();
        jacobian.fixed_view_mut::<3, 3>(0, 3).copy_from(&-centre.cross_matrix());
        for (joint, twist) in self.twists().enumerate().filter(|(joint, _)| carried[joint + 1] > 0.0) {
            let velocity = twist.v + twist.w.cross(&centres[joint + 1]);
            jacobian.set_column(6 + joint, &(velocity * (carried[joint + 1] / self.body.total)));
        }
        jacobian
    }

    /// The momentum at the twist `base` of the base \[m/s, rad/s\], in the world frame, and the rates of the joints.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when `rates` has not one finite value per joint.
    pub fn momentum(&self, base: &Twist, rates: &[f64]) -> Result<Momentum> {
        self.body.check(rates)?;
        let mut twists = Vec::with_capacity(self.motions.len());
        twists.push(*base);
        for ((limb, unit), &rate) in self.body.limbs.iter().zip(self.twists()).zip(rates) {
            let parent: Twist = twists[limb.parent.map_or(0, |parent| parent + 1)];
            twists.push(parent + unit * rate);
        }
        let parts = self.bodies().zip(&twists).map(|((mass, motion), twist)| mass.momentum(motion, twist));
        Ok(parts.sum())
    }

    /// Each body with its motion, the base first.
    fn bodies(&self) -> impl Iterator<Item = (&Mass, &Pose)> {
        self.body.masses.iter().zip(&self.motions)
    }

    /// The unit twist of each joint, in the world frame.
    fn twists(&self) -> impl Iterator<Item = Twist> {
        let parent = |limb: &Limb| self.motions[limb.parent.map_or(0, |parent| parent + 1)];
        self.body.limbs.iter().map(move |limb| limb.screw.twist().transform(&parent(limb)))
    }

    /// The mass that the base and each joint carry, and its centre in the world.
    fn carried(&self) -> (Vec<f64>, Vec<Vector3<f64>>) {
        let mut masses: Vec<f64> = self.body.masses.iter().map(|mass| mass.mass).collect();
        let mut moments: Vec<Vector3<f64>> =
            self.bodies().map(|(mass, motion)| (motion * mass.centre).coords * mass.mass).collect();
        for (link, limb) in self.body.limbs.iter().enumerate().rev() {
            let parent = limb.parent.map_or(0, |parent| parent + 1);
            masses[parent] += masses[link + 1];
            let moment = moments[link + 1];
            moments[parent] += moment;
        }
        let centres = moments.iter().zip(&masses).map(|(moment, mass)| moment / *mass).collect();
        (masses, centres)
    }
}

impl Mass {
    /// What a body with this mass, moved by `motion`, has of momentum at its twist in the world.
    fn momentum(&self, motion: &Pose, twist: &Twist) -> Momentum {
        let centre = motion * self.centre;
        let linear = (twist.v + twist.w.cross(&centre.coords)) * self.mass;
        let turn = motion.rotation;
        let spin = turn * (self.rotational * turn.inverse_transform_vector(&twist.w));
        Momentum { linear, angular: centre.coords.cross(&linear) + spin }
    }
}
