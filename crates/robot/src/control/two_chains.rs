//! A robot on two legs as two chains that hold the trunk together, RH0 3.4.3 and 3.4.4. Main type: [`TwoChains`].

use super::joint_space::Commanded;
use super::{Desired, Gains, Law};
use crate::dynamics::{Base, Equations, Model, State, Workspace};
use crate::model::Robot;
use crate::spatial::Wrench;
use crate::{Error, ErrorKind, Result};

/// Computed torque of two chains, RH0 (3-42), (3-43), in single support: each leads from its foot over leg and trunk to an arm, and weighs what its half of the robot
/// weighs ([`Model::halves`]). What moves a chain as a whole acts on its foot, the thesis' six virtual joints. A foot that swings has no ground to push against, so that the chain
/// above it is carried by the other one: with what goes through the trunk torques are those of the robot as one tree; without it, as the thesis has the laws, they are not.
#[derive(Clone, Debug)]
pub struct TwoChains {
    chains: [Equations; 2],
    rooms: [Workspace; 2],
    /// By chain the link of its foot.
    feet: [usize; 2],
    trunk: usize,
    standing: usize,
    is_coupled: bool,
    commanded: Commanded,
    torques: Vec<f64>,
    between: Wrench,
}

impl TwoChains {
    /// That of a robot with these feet, left and right, which stands on one of them: 0 or 1. The feet are links, whose frames have z up where the robot
    /// stands level, and the trunk is the robot's root. With `is_coupled` the halves hold each other through the trunk; without it each is a robot of its own.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] for links that are not there, [`ErrorKind::BadValue`] for feet that stand on the same joints and gains as
    /// [`ComputedTorque::new`](super::ComputedTorque::new) has them.
    pub fn new(robot: &Robot, feet: [&str; 2], standing: usize, gains: Gains, is_coupled: bool) -> Result<Self> {
        let model = Model::new(robot)?;
        let feet = [robot.link(feet[0])?, robot.link(feet[1])?];
        let legs = feet.map(|foot| model.path(model.link(foot).0));
        if standing > 1 || legs.iter().any(Vec::is_empty) || legs[0].iter().any(|joint| legs[1].contains(joint)) {
            let text = "two chains stand on feet that different joints lead to, of which 0 or 1 stands";
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let chain = |half: usize| -> Result<Equations> {
            let rooted = model.halves(feet)[half].rooted_at(feet[standing]);
            let equations = Equations::of(robot, &rooted, Base::Fixed)?;
            // Rotors and friction count once.
            Ok(if half == standing { equations } else { equations.without_friction().without_rotors() })
        };
        let chains = [chain(0)?, chain(1)?];
        let count = chains[0].freedoms();
        Ok(TwoChains {
            rooms: chains.each_ref().map(Equations::workspace),
            commanded: Commanded::new(count, gains)?,
            trunk: robot.root_place(),
            chains,
            feet,
            standing,
            is_coupled,
            torques: vec![0.0; count],
            between: Wrench::zero(),
        })
    }

    /// What the chain of the standing foot gave to the other one through the trunk last, about the origin of the standing foot and along its axes; nothing where chains are not
    /// coupled.
    pub fn between(&self) -> &Wrench {
        &self.between
    }
}

impl Law for TwoChains {
    fn torques(&mut self, desired: &Desired<'_>, state: State<'_>) -> Result<&[f64]> {
        let commanded = self.commanded.accelerations(desired, &state);
        let swinging = 1 - self.standing;
        // What moves the half of the foot that swings, seen from the foot that stands.
        let moves = self.chains[swinging].base_wrench(&mut self.rooms[swinging], state, commanded)?;
        let held = if self.is_coupled { self.trunk } else { self.feet[swinging] };
        let stands = self.chains[swinging].pose(&mut self.rooms[swinging], state.q, held)?;
        let own = moves.transform(&stands.inverse());
        let back = [(held, -own)];
        let carried: &[_] = if self.is_coupled { &back } else { &[] };
        let pushes = [(self.standing, carried), (swinging, &[(held, own)][..])];
        self.torques.fill(0.0);
        for (chain, pushes) in pushes {
            let equations = &self.chains[chain];
            let torques = equations.inverse(&mut self.rooms[chain], state.pushed(pushes), commanded)?;
            self.torques.iter_mut().zip(torques.iter()).for_each(|(sum, torque)| *sum += torque);
        }
        self.between = if self.is_coupled { moves } else { Wrench::zero() };
        Ok(&self.torques)
    }

    fn endure(&mut self, desired: &Desired<'_>, state: State<'_>, time: f64) {
        self.commanded.endure(desired, &state, time);
    }
}
