//! A biped as two cooperating chains connected at the trunk, RH0 3.4.3 and 3.4.4. Main type: [`TwoChains`].

use super::joint_space::Commanded;
use super::{Desired, Gains, Law};
use crate::dynamics::{Base, Equations, Model, State, Workspace};
use crate::model::Robot;
use crate::spatial::Wrench;
use crate::{Error, ErrorKind, Result};

/// Computed torque of two chains, RH0 (3-42), (3-43), in single support. Each chain leads from its foot over leg and
/// trunk to an arm, and has the masses of its half of the robot ([`Model::halves`]). The wrench that moves a chain as a
/// whole acts on its foot, by the thesis' six virtual joints. The swing foot has no ground contact, so its chain is
/// carried by the other one. With the wrench transmitted through the trunk, the torques equal those of the robot as one
/// tree. Without it, as in the thesis' laws, they do not.
#[derive(Clone, Debug)]
pub struct TwoChains {
    chains: [Equations; 2],
    workspaces: [Workspace; 2],
    /// The link of each chain's foot.
    feet: [usize; 2],
    trunk: usize,
    supporting: usize,
    is_coupled: bool,
    commanded: Commanded,
    torques: Vec<f64>,
    between: Wrench,
}

impl TwoChains {
    /// Builds the law of a robot with a left and a right foot. `supporting` is the index of the supporting foot, 0 or 1.
    /// The feet are links whose frames have z up when the robot is upright on level ground. The trunk is the robot's
    /// root. With `is_coupled`, the halves exchange a wrench through the trunk; without it, each is a robot of its own.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] for unknown links, [`ErrorKind::BadValue`] for feet with common joints; those of
    /// [`ComputedTorque::new`](super::ComputedTorque::new) for gains.
    pub fn new(robot: &Robot, feet: [&str; 2], supporting: usize, gains: Gains, is_coupled: bool) -> Result<Self> {
        let model = Model::new(robot)?;
        let feet = [robot.link(feet[0])?, robot.link(feet[1])?];
        let legs = feet.map(|foot| model.path(model.link(foot).0));
        if supporting > 1 || legs.iter().any(Vec::is_empty) || legs[0].iter().any(|joint| legs[1].contains(joint)) {
            let text = "two chains need feet with different joints, and a supporting foot 0 or 1";
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let chain = |half: usize| -> Result<Equations> {
            let rooted = model.halves(feet)[half].rooted_at(feet[supporting]);
            let equations = Equations::of(robot, &rooted, Base::Fixed)?;
            // Rotors and friction are counted once.
            Ok(if half == supporting { equations } else { equations.without_friction().without_rotors() })
        };
        let chains = [chain(0)?, chain(1)?];
        let count = chains[0].freedoms();
        Ok(TwoChains {
            workspaces: chains.each_ref().map(Equations::workspace),
            commanded: Commanded::new(count, gains)?,
            trunk: robot.root_place(),
            chains,
            feet,
            supporting,
            is_coupled,
            torques: vec![0.0; count],
            between: Wrench::zero(),
        })
    }

    /// The last wrench from the chain of the supporting foot to the other chain through the trunk. It is about the
    /// origin of the supporting foot, along its axes; zero if the chains are not coupled.
    pub fn between(&self) -> &Wrench {
        &self.between
    }
}

impl Law for TwoChains {
    fn torques(&mut self, desired: &Desired<'_>, state: State<'_>) -> Result<&[f64]> {
        let commanded = self.commanded.accelerations(desired, &state);
        let swinging = 1 - self.supporting;
        // The wrench that moves the half of the swing foot, in the frame of the supporting foot.
        let moves = self.chains[swinging].base_wrench(&mut self.workspaces[swinging], state, commanded)?;
        let held = if self.is_coupled { self.trunk } else { self.feet[swinging] };
        let pose = self.chains[swinging].pose(&mut self.workspaces[swinging], state.q, held)?;
        let own = moves.transform(&pose.inverse());
        let back = [(held, -own)];
        let carried: &[_] = if self.is_coupled { &back } else { &[] };
        let pushes = [(self.supporting, carried), (swinging, &[(held, own)][..])];
        self.torques.fill(0.0);
        for (chain, pushes) in pushes {
            let equations = &self.chains[chain];
            let torques = equations.inverse(&mut self.workspaces[chain], state.with_wrenches(pushes), commanded)?;
            self.torques.iter_mut().zip(torques.iter()).for_each(|(sum, torque)| *sum += torque);
        }
        self.between = if self.is_coupled { moves } else { Wrench::zero() };
        Ok(&self.torques)
    }

    fn integrate(&mut self, desired: &Desired<'_>, state: State<'_>, time: f64) {
        self.commanded.integrate(desired, &state, time);
    }
}
