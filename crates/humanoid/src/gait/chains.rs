//! Forces of a walk from two chains, each on its own foot: RH0 (3-40) and (3-41). Main type: [`Chains`].

use super::biped::Biped;
use super::forces::{Forces, pushed};
use super::plan::Walk;
use groebot_robot::dynamics::{Data, Six, Tree};
use groebot_robot::motion::{Figure, Trajectory};
use groebot_robot::spatial::Wrench;

/// The torques at a sample for two chains, the left and the right half of the robot
/// ([`Model::halves`](groebot_robot::dynamics::Model::halves)), and the wrench between them.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Chains {
    /// The ground reaction that each foot would need if its chain moved alone, about the world's origin: the virtual
    /// torques of (3-40) and (3-41). Their sum is the total ground reaction.
    pub alone: [Wrench; 2],
    /// By joint, the torques of (3-40) and (3-41). A joint in the middle has the sum of both.
    pub torques: Vec<f64>,
    /// The wrench from the right half to the left half through the trunk, for the actual ground reactions
    /// ([`Forces::feet`]), about the world's origin.
    pub between: Wrench,
    /// By joint, the torques of both chains with that wrench. They equal the torques of the whole multibody.
    pub coupled: Vec<f64>,
}

/// The differences between the two models in a walk. They are largest while a foot swings.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Difference {
    /// The greatest difference of a torque of [`Chains::torques`] \[N m, N\].
    pub torque: f64,
    /// The joint with that difference.
    pub joint: String,
    /// The time of that difference \[s\].
    pub time: f64,
    /// The greatest force that a chain requires from a swinging foot \[N\].
    pub swinging: f64,
    /// The greatest force \[N\] and moment \[N m\] through the trunk, about the origin of the trunk's frame.
    pub between: [f64; 2],
    /// The greatest difference in [`Chains::coupled`] and in the sum of both chains' ground reactions, which is
    /// rounding error \[N m, N\].
    pub rounding: f64,
}

impl Walk {
    /// Computes the two chains at every sample, in addition to the forces of the whole multibody.
    pub fn chains(&self, biped: &Biped, forces: &[Forces]) -> Vec<Chains> {
        let feet = biped.feet.each_ref().map(|foot| foot.link);
        let halves = biped.model.halves(feet).map(|half| Tree::new(&half));
        let mut rooms = halves.each_ref().map(Data::new);
        let all = forces.iter().enumerate();
        all.map(|(sample, forces)| self.chains_at(biped, &halves, &mut rooms, (sample, forces))).collect()
    }

    fn chains_at(
        &self,
        biped: &Biped,
        halves: &[Tree<f64>; 2],
        rooms: &mut [Data<f64>; 2],
        (sample, forces): (usize, &Forces),
    ) -> Chains {
        let world_from_torso = &self.motion.postures[sample].world_from_torso;
        let torso_from_world = world_from_torso.inverse();
        let moving = self.moving(&halves[0], sample);
        let count = biped.joints.len();
        let none = Wrench::zero();
        let mut found =
            Chains { alone: [none; 2], torques: vec![0.0; count], between: none, coupled: vec![0.0; count] };
        let mut own = vec![0.0; count];
        for (side, (tree, data)) in halves.iter().zip(rooms).enumerate() {
            data.place(tree, moving.places.iter().copied());
            let alone = data.inverse(tree, &moving.motion(), &[], &mut own);
            found.alone[side] = Wrench::from(alone).transform(world_from_torso);
            let given = self.about_origin(sample, side, &forces.feet[side]);
            let rest = found.alone[side] - given;
            if side == 0 {
                found.between = rest;
            }
            // Alone, the foot takes the whole load. Otherwise the foot takes the actual ground reaction and the trunk
            // the rest.
            for (at_foot, at_trunk, torques) in
                [(found.alone[side], none, &mut found.torques), (given, rest, &mut found.coupled)]
            {
                let mut outside = vec![Six::zero(); count + 1];
                outside[0] = at_trunk.transform(&torso_from_world).into();
                let (body, push) = pushed(tree, data, &biped.feet[side], &at_foot.transform(&torso_from_world));
                outside[body] = push;
                data.inverse(tree, &moving.motion(), &outside, &mut own);
                torques.iter_mut().zip(&own).for_each(|(sum, torque)| *sum += torque);
            }
        }
        found
    }

    /// Measures how the two chains differ from the whole multibody.
    pub fn difference(&self, biped: &Biped, forces: &[Forces], chains: &[Chains]) -> Difference {
        let joint = |place: usize| biped.joints[place].name.clone();
        let mut most =
            Difference { torque: 0.0, joint: joint(0), time: 0.0, swinging: 0.0, between: [0.0; 2], rounding: 0.0 };
        for (sample, (whole, two)) in forces.iter().zip(chains).enumerate() {
            for (place, torque) in whole.torques.iter().enumerate() {
                let apart = (two.torques[place] - torque).abs();
                if apart > most.torque {
                    (most.torque, most.joint, most.time) = (apart, joint(place), self.time(sample));
                }
                most.rounding = most.rounding.max((two.coupled[place] - torque).abs());
            }
            let apart = two.alone[0] + two.alone[1] - whole.ground;
            most.rounding = most.rounding.max(apart.to_vector().amax());
            for (alone, stands) in two.alone.iter().zip(self.references[sample].stands) {
                if !stands {
                    most.swinging = most.swinging.max(alone.f.norm());
                }
            }
            let at = &self.motion.postures[sample].world_from_torso.translation.vector;
            let moment = two.between.tau - at.cross(&two.between.f);
            most.between = [most.between[0].max(two.between.f.norm()), most.between[1].max(moment.norm())];
        }
        most
    }

    /// Adds the chains to a table: figures `chain:NAME`, the torque of each joint, and `trunk_fx` to `trunk_mz`, the
    /// wrench through the trunk.
    pub fn add_chains(&self, biped: &Biped, chains: &[Chains], trajectory: &mut Trajectory) {
        let mut add = |name: String, unit: &str, value: &dyn Fn(&Chains) -> f64| {
            let values = chains.iter().map(value).collect();
            trajectory.figures.push(Figure { name, unit: unit.to_owned(), values });
        };
        for (joint, range) in biped.joints.iter().enumerate() {
            let unit = biped.torque_unit(joint);
            add(format!("chain:{}", range.name), unit, &|chains| chains.torques[joint]);
        }
        for (entry, end) in ["fx", "fy", "fz", "mx", "my", "mz"].into_iter().enumerate() {
            let unit = if entry < 3 { "N" } else { "N m" };
            add(format!("trunk_{end}"), unit, &|chains| chains.between.to_vector()[entry]);
        }
    }
}
