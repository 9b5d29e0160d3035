//! Forces of a walk by inverse dynamics (RNEA): ground reaction forces and joint torques. Main type: [`Forces`].
//!
//! The recursive Newton-Euler algorithm runs on the whole multibody. The motion of base and joints is from central
//! differences over three samples. Only the floor exerts external forces, so the wrench that the base needs is the
//! ground reaction. In single support the foot takes all of it. In double support each foot takes a fraction of the
//! force, by the position of the centre of pressure between them. It takes the same fraction of the remaining moment,
//! which statics does not determine.

use nalgebra::{Point2, Point3, Vector3};

use super::biped::{Biped, Foot};
use super::footprint::Side;
use super::plan::Walk;
use super::zmp::GRAVITY;
use groebot_robot::dynamics::{Data, Frame, Freedom, Motion, Place, Six, Tree};
use groebot_robot::motion::{Figure, Track, Trajectory};
use groebot_robot::spatial::{Pose, Twist, Wrench, pose};

/// The forces at a sample.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Forces {
    /// By joint, the torque or force of its motor \[N m, N\], without rotor inertia and friction.
    pub torques: Vec<f64>,
    /// The total ground reaction, about the world's origin.
    pub ground: Wrench,
    /// Its centre of pressure, where it has no horizontal moment: the zero moment point.
    pub centre: Point2<f64>,
    /// The ground reactions of the left and the right foot, about the sole's origin and along the axes of the world;
    /// zero for a swing foot.
    pub feet: [Wrench; 2],
}

/// The greatest torque of a joint in a walk.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Greatest {
    /// The joint's name.
    pub joint: String,
    /// Its magnitude \[N m, N\].
    pub torque: f64,
    /// The time at which it occurs \[s\].
    pub time: f64,
    /// The motor's limit, where it is given.
    pub effort: Option<f64>,
}

/// Velocities and accelerations of a biped at a sample, by central differences over three samples.
pub(super) struct Moving {
    pub(super) places: Vec<Place<f64>>,
    /// The velocity of the torso, and its acceleration minus gravity, in the torso's frame.
    base: [Six<f64>; 2],
    rates: Vec<f64>,
    accelerations: Vec<f64>,
}

impl Moving {
    /// The arguments of the recursive algorithms.
    pub(super) fn motion(&self) -> Motion<'_, f64> {
        let [base, base_acceleration] = self.base;
        Motion { base, base_acceleration, rates: &self.rates, accelerations: &self.accelerations }
    }
}

impl Walk {
    /// Computes the forces at every sample of the walk, which starts and ends at rest.
    pub fn forces(&self, biped: &Biped) -> Vec<Forces> {
        let tree = Tree::new(&biped.model);
        let mut data = Data::new(&tree);
        (0..self.motion.postures.len()).map(|sample| self.forces_at(biped, &tree, &mut data, sample)).collect()
    }

    /// Velocities and accelerations of the biped at a sample.
    pub(super) fn moving(&self, tree: &Tree<f64>, sample: usize) -> Moving {
        let (tick, postures) = (self.schedule.tick, &self.motion.postures);
        let here = &postures[sample];
        // Before the first sample and after the last one the robot is at rest.
        let neighbours = [sample.saturating_sub(1), (sample + 1).min(postures.len() - 1)].map(|near| &postures[near]);
        let twist = |from: &Pose, to: &Pose| pose::log(&(to * from.inverse())) * (1.0 / tick);
        let [before, after] = [
            twist(&neighbours[0].world_from_torso, &here.world_from_torso),
            twist(&here.world_from_torso, &neighbours[1].world_from_torso),
        ];
        let torso_from_world = here.world_from_torso.inverse();
        let own = |twist: Twist| {
            let own = twist.transform(&torso_from_world);
            Six { linear: own.v.into(), angular: own.w.into() }
        };
        let velocity = own((before + after) * 0.5);
        let mut acceleration = own((after + before * -1.0) * (1.0 / tick));
        let up = torso_from_world.rotation * Vector3::new(0.0, 0.0, GRAVITY);
        (0..3).for_each(|i| acceleration.linear[i] += up[i]);
        let rates = |change: fn(f64, f64, f64) -> f64, time: f64| -> Vec<f64> {
            let three = neighbours[0].q.iter().zip(&here.q).zip(&neighbours[1].q);
            three.map(|((a, b), c)| change(*a, *b, *c) / time).collect()
        };
        let freedoms = tree.bodies.iter().map(|body| body.freedom);
        Moving {
            places: freedoms.zip(&here.q).map(|(freedom, q): (Freedom, &f64)| Place::of(freedom, *q)).collect(),
            base: [velocity, acceleration],
            rates: rates(|a, _, c| c - a, 2.0 * tick),
            accelerations: rates(|a, b, c| c - 2.0 * b + a, tick * tick),
        }
    }

    fn forces_at(&self, biped: &Biped, tree: &Tree<f64>, data: &mut Data<f64>, sample: usize) -> Forces {
        let world_from_torso = &self.motion.postures[sample].world_from_torso;
        let moving = self.moving(tree, sample);
        data.place(tree, moving.places.iter().copied());
        let mut torques = vec![0.0; tree.bodies.len()];
        let base = data.inverse(tree, &moving.motion(), &[], &mut torques);
        let ground = Wrench::from(base).transform(world_from_torso);
        let centre = Point2::new(-ground.tau.y / ground.f.z, ground.tau.x / ground.f.z);
        let feet = self.feet(sample, &ground, &centre);
        let mut outside = vec![Six::zero(); tree.bodies.len() + 1];
        for side in [0, 1] {
            let about_origin = self.about_origin(sample, side, &feet[side]);
            let own = about_origin.transform(&world_from_torso.inverse());
            let (body, push) = pushed(tree, data, &biped.feet[side], &own);
            outside[body] = push;
        }
        data.inverse(tree, &moving.motion(), &outside, &mut torques);
        Forces { torques, ground, centre, feet }
    }

    /// Moves the reference point of a wrench from the origin of a foot's sole to the world's origin.
    pub(super) fn about_origin(&self, sample: usize, side: usize, wrench: &Wrench) -> Wrench {
        let at = &self.references[sample].world_from_soles[side].translation.vector;
        Wrench { f: wrench.f, tau: wrench.tau + at.cross(&wrench.f) }
    }

    /// The ground reaction of each foot, about its sole's origin.
    fn feet(&self, sample: usize, ground: &Wrench, centre: &Point2<f64>) -> [Wrench; 2] {
        let reference = &self.references[sample];
        let places = [Side::Left, Side::Right]
            .map(|side| Point3::from(reference.world_from_soles[side as usize].translation.vector));
        let shares = match reference.stands {
            [true, false] => [1.0, 0.0],
            [false, true] => [0.0, 1.0],
            _ => {
                let offset = places[1].xy() - places[0].xy();
                let right = ((centre - places[0].xy()).dot(&offset) / offset.norm_squared()).clamp(0.0, 1.0);
                [1.0 - right, right]
            }
        };
        let forces = shares.map(|share| ground.f * share);
        let taken: Vector3<f64> = places.iter().zip(&forces).map(|(place, force)| place.coords.cross(force)).sum();
        [0, 1].map(|foot| Wrench { f: forces[foot], tau: (ground.tau - taken) * shares[foot] })
    }

    /// By joint, the greatest torque over the forces at every sample.
    pub fn greatest_torques(&self, biped: &Biped, forces: &[Forces]) -> Vec<Greatest> {
        let greatest = |(joint, range): (usize, &super::JointRange)| {
            let sizes = forces.iter().map(|forces| forces.torques[joint].abs()).enumerate();
            let (sample, torque) = sizes.fold((0, 0.0), |most, one| if one.1 > most.1 { one } else { most });
            Greatest { joint: range.name.clone(), torque, time: self.time(sample), effort: range.effort }
        };
        biped.joints.iter().enumerate().map(greatest).collect()
    }

    /// The walk's trajectory with its forces. The point `ground` is their centre of pressure. The figures are
    /// `tau:NAME` of each joint, and `ground_fx` to `ground_mz`, `left_fx` to `right_mz` as in [`Forces`].
    pub fn trajectory_with_forces(&self, biped: &Biped, forces: &[Forces]) -> Trajectory {
        let mut trajectory = self.trajectory(biped);
        let at = forces.iter().map(|forces| Point3::new(forces.centre.x, forces.centre.y, 0.0)).collect();
        trajectory.points.push(Track { name: "ground".to_owned(), at });
        for (joint, range) in biped.joints.iter().enumerate() {
            let values = forces.iter().map(|forces| forces.torques[joint]).collect();
            let unit = biped.torque_unit(joint).to_owned();
            trajectory.figures.push(Figure { name: format!("tau:{}", range.name), unit, values });
        }
        for (which, name) in ["ground", "left", "right"].into_iter().enumerate() {
            let own = |forces: &Forces| if which == 0 { forces.ground } else { forces.feet[which - 1] };
            for (entry, end) in ["fx", "fy", "fz", "mx", "my", "mz"].into_iter().enumerate() {
                let values = forces.iter().map(|forces| own(forces).to_vector()[entry]).collect();
                let unit = if entry < 3 { "N" } else { "N m" };
                trajectory.figures.push(Figure { name: format!("{name}_{end}"), unit: unit.to_owned(), values });
            }
        }
        trajectory
    }
}

/// The body that a wrench on a foot acts on, and the wrench in that body's frame. The given wrench `own` is in the
/// torso's frame.
pub(super) fn pushed(tree: &Tree<f64>, data: &Data<f64>, foot: &Foot, own: &Wrench) -> (usize, Six<f64>) {
    let stands = data.pose_in_base(tree, foot.body.checked_sub(1), &Frame::identity());
    (foot.body, stands.force_inward(&Six::from(*own)))
}
