//! The forces of a walk: what the floor gives, and what the joints' motors must. Main type: [`Forces`].
//!
//! Newton's and Euler's recursion on the whole multibody, whose base and joints move as central differences over three samples say. Nothing but the floor pushes, so
//! what the base asks for is what the floor gives. A foot that stands alone takes it all; of two each takes a share of the force by where its centre is between
//! them, and the same share of the moment that is left, which statics leaves open.

use nalgebra::{Point2, Point3, Vector3};

use super::biped::Biped;
use super::footprint::Side;
use super::plan::Walk;
use super::zmp::GRAVITY;
use crate::dynamics::{Data, Frame, Freedom, Motion, Place, Six, Tree};
use crate::motion::{Figure, Track, Trajectory};
use crate::spatial::{Pose, Twist, Wrench, pose};

/// The forces at a sample.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Forces {
    /// By joint, what its motor gives \[N m, N\]; rotors and friction are left out.
    pub torques: Vec<f64>,
    /// What the floor gives in all, about the world's origin.
    pub ground: Wrench,
    /// Its centre: where it has no horizontal moment, the zero moment point.
    pub centre: Point2<f64>,
    /// What it gives to the left and the right foot, about the sole's origin and along the axes of the world; none to one that swings.
    pub feet: [Wrench; 2],
}

/// The greatest torque of a joint in a walk.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Greatest {
    /// The joint's name.
    pub joint: String,
    /// Its size \[N m, N\].
    pub torque: f64,
    /// When it is met \[s\].
    pub time: f64,
    /// What the motor gives, where that is told.
    pub effort: Option<f64>,
}

impl Walk {
    /// The forces at every sample of the walk, which starts from rest and ends in rest.
    pub fn forces(&self, biped: &Biped) -> Vec<Forces> {
        let tree = Tree::new(&biped.model);
        let mut data = Data::new(&tree);
        (0..self.motion.postures.len()).map(|sample| self.forces_at(biped, &tree, &mut data, sample)).collect()
    }

    fn forces_at(&self, biped: &Biped, tree: &Tree<f64>, data: &mut Data<f64>, sample: usize) -> Forces {
        let (tick, postures) = (self.schedule.tick, &self.motion.postures);
        let here = &postures[sample];
        // Behind the last sample and before the first one it rests.
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
        let (moving, changing) = (rates(|a, _, c| c - a, 2.0 * tick), rates(|a, b, c| c - 2.0 * b + a, tick * tick));
        let freedoms = tree.bodies.iter().map(|body| body.freedom);
        data.place(tree, freedoms.zip(&here.q).map(|(freedom, q): (Freedom, &f64)| Place::of(freedom, *q)));
        let motion =
            Motion { base: velocity, base_acceleration: acceleration, rates: &moving, accelerations: &changing };
        let mut torques = vec![0.0; tree.bodies.len()];
        let base = data.inverse(tree, &motion, &[], &mut torques);
        let ground = Wrench { f: base.linear.into(), tau: base.angular.into() }.transform(&here.world_from_torso);
        let centre = Point2::new(-ground.tau.y / ground.f.z, ground.tau.x / ground.f.z);
        let feet = self.feet(sample, &ground, &centre);
        let mut outside = vec![Six::zero(); tree.bodies.len() + 1];
        let soles = &self.references[sample].world_from_soles;
        for ((foot, wrench), sole) in biped.feet.iter().zip(&feet).zip(soles) {
            let Some(joint) = foot.body.checked_sub(1) else { continue };
            let at = &sole.translation.vector;
            let about_origin = Wrench { f: wrench.f, tau: wrench.tau + at.cross(&wrench.f) };
            let own = about_origin.transform(&torso_from_world);
            let stands = data.stands(tree, Some(joint), &Frame::identity());
            outside[joint + 1] = stands.force_inward(&Six { linear: own.f.into(), angular: own.tau.into() });
        }
        data.inverse(tree, &motion, &outside, &mut torques);
        Forces { torques, ground, centre, feet }
    }

    /// What the floor gives to each foot, about its sole's origin.
    fn feet(&self, sample: usize, ground: &Wrench, centre: &Point2<f64>) -> [Wrench; 2] {
        let reference = &self.references[sample];
        let places = [Side::Left, Side::Right]
            .map(|side| Point3::from(reference.world_from_soles[side as usize].translation.vector));
        let shares = match reference.stands {
            [true, false] => [1.0, 0.0],
            [false, true] => [0.0, 1.0],
            _ => {
                let way = places[1].xy() - places[0].xy();
                let right = ((centre - places[0].xy()).dot(&way) / way.norm_squared()).clamp(0.0, 1.0);
                [1.0 - right, right]
            }
        };
        let forces = shares.map(|share| ground.f * share);
        let taken: Vector3<f64> = places.iter().zip(&forces).map(|(place, force)| place.coords.cross(force)).sum();
        [0, 1].map(|foot| Wrench { f: forces[foot], tau: (ground.tau - taken) * shares[foot] })
    }

    /// By joint the greatest torque, of forces at every sample.
    pub fn greatest_torques(&self, biped: &Biped, forces: &[Forces]) -> Vec<Greatest> {
        let greatest = |(joint, range): (usize, &super::JointRange)| {
            let sizes = forces.iter().map(|forces| forces.torques[joint].abs()).enumerate();
            let (sample, torque) = sizes.fold((0, 0.0), |most, one| if one.1 > most.1 { one } else { most });
            Greatest { joint: range.name.clone(), torque, time: self.time(sample), effort: range.effort }
        };
        biped.joints.iter().enumerate().map(greatest).collect()
    }

    /// The walk's trajectory with its forces: the point `ground` is their centre; figures are `tau:NAME` of each joint, and `ground_fx` to `ground_mz`, `left_fx` to `right_mz` as
    /// [`Forces`] has them.
    pub fn trajectory_with_forces(&self, biped: &Biped, forces: &[Forces]) -> Trajectory {
        let mut trajectory = self.trajectory(biped);
        let at = forces.iter().map(|forces| Point3::new(forces.centre.x, forces.centre.y, 0.0)).collect();
        trajectory.points.push(Track { name: "ground".to_owned(), at });
        for (joint, range) in biped.joints.iter().enumerate() {
            let values = forces.iter().map(|forces| forces.torques[joint]).collect();
            let slides = biped.model.joints()[joint].screw.axis().is_none();
            let unit = if slides { "N" } else { "N m" };
            trajectory.figures.push(Figure { name: format!("tau:{}", range.name), unit: unit.to_owned(), values });
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
