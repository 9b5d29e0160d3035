//! The sagittal kinematics division (SKD; DCS in the thesis) of RH0, 3.4: the biped as two manipulators, left and
//! right, from the ground to the hands. Main type: [`Manipulator`].
//!
//! Frames and joints are those of the thesis: x to the robot's left, y up, z forward. S is below the trunk's middle at
//! the height of the ankles, H is the trunk. Six virtual joints position the foot: three translations, then rotations
//! about y, z and x through S.

use nalgebra::{Point3, Vector3};

use super::printed::{Printed, RH0_LEFT_LEG, RH0_RIGHT_LEG};
use crate::Result;
use crate::gait::Side;
use groebot_robot::kinematics::{Chain, InverseKinematics, Target};
use groebot_robot::robots;
use groebot_robot::spatial::{Pose, Screw};

/// The joints of a leg, from the foot up \[rad\].
pub type LegValues = [f64; 6];

/// The virtual joints of a foot: `theta_v1..theta_v3` \[m\], `theta_v4..theta_v6` \[rad\].
pub type Virtual = [f64; 6];

/// The real joints of one half of RH0.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Real {
    /// From the ankle up: 1 to 6 on the right, 12 to 7 on the left \[rad\].
    pub leg: LegValues,
    /// The column, 13 \[rad\].
    pub column: f64,
    /// The arm: 14 to 17 on the right, 18 to 21 on the left \[rad\].
    pub arm: [f64; 4],
}

/// One half of RH0: six virtual joints and eleven real ones.
#[derive(Clone, Debug)]
pub struct Manipulator {
    /// The leg, from S to the trunk.
    chain: Chain,
    /// Leg, column and arm, from S to the hand; the lengths of column and arm are assumed.
    whole: Chain,
    solver: Printed,
    /// The screws of the virtual joints, RH0 (3-10), (3-11), (3-25), (3-26).
    foot: Vec<Screw>,
}

impl Manipulator {
    /// The half of RH0 on `side`.
    ///
    /// # Errors
    /// None with the crate's own data.
    pub fn rh0(side: Side) -> Result<Self> {
        let (chain, solver, ends) = match side {
            Side::Left => (robots::rh0_left_leg(), RH0_LEFT_LEG, ["LS", "LHand"]),
            Side::Right => (robots::rh0_right_leg(), RH0_RIGHT_LEG, ["RS", "RHand"]),
        };
        let whole = robots::rh0().chain(Some(ends[0]), Some(ends[1]))?;
        let slide = [Vector3::x(), Vector3::y(), Vector3::z()].map(Screw::prismatic);
        let turn = [Vector3::y(), Vector3::z(), Vector3::x()].map(|axis| Screw::revolute(axis, Point3::origin()));
        Ok(Manipulator { chain, whole, solver, foot: slide.into_iter().chain(turn).collect::<Result<_>>()? })
    }

    /// The motion of the foot relative to the reference configuration.
    pub fn foot(&self, virtual_joints: &Virtual) -> Pose {
        product(&self.foot, virtual_joints)
    }

    /// The virtual joints of the motion `foot` relative to the reference configuration. Where the rotation about z is a
    /// quarter turn, the rotation about x is zero.
    pub fn virtual_joints(&self, foot: &Pose) -> Virtual {
        let (p, r) = (foot.translation.vector, foot.rotation.to_rotation_matrix().into_inner());
        let z = r[(1, 0)].atan2(r[(0, 0)].hypot(r[(2, 0)]));
        if r[(0, 0)].hypot(r[(2, 0)]) < 1e-12 {
            return [p.x, p.y, p.z, r[(0, 2)].atan2(r[(2, 2)]), z, 0.0];
        }
        [p.x, p.y, p.z, (-r[(2, 0)]).atan2(r[(0, 0)]), z, (-r[(1, 2)]).atan2(r[(1, 1)])]
    }

    /// The pose of the trunk H, `g_sh`: RH0 (3-13), (3-28).
    pub fn trunk(&self, virtual_joints: &Virtual, leg: &LegValues) -> Pose {
        self.foot(virtual_joints) * product(self.chain.screws(), leg) * self.chain.base_from_tip()
    }

    /// The pose of the hand: RH0 (3-8), (3-9).
    pub fn hand(&self, virtual_joints: &Virtual, real: &Real) -> Pose {
        let q = [&real.leg[..], &[real.column], &real.arm].concat();
        self.foot(virtual_joints) * product(self.whole.screws(), &q) * self.whole.base_from_tip()
    }

    /// All joint values of the leg that move the trunk to `trunk` with the foot at `virtual_joints`: up to eight
    /// solutions, (3-24), (3-39), by the derived solver.
    ///
    /// # Errors
    /// [`crate::ErrorKind::BadValue`] when a value is not finite.
    pub fn legs(&self, virtual_joints: &Virtual, trunk: &Pose) -> Result<Vec<LegValues>> {
        let mut found = Vec::new();
        self.solver.solve(&Target::Pose(self.foot(virtual_joints).inv_mul(trunk)), &[], &mut found)?;
        Ok(found.into_iter().filter_map(|answer| answer.q.try_into().ok()).collect())
    }

    /// The leg's chain, from foot to trunk.
    pub fn chain(&self) -> &Chain {
        &self.chain
    }
}

/// The joints 14 to 16 of the right arm, or 18 to 20 of the left one, from the opposite leg: RH0 (3-23), (3-38).
pub fn coordinated_arm(other_leg: &LegValues) -> [f64; 3] {
    let [_, _, knee, hip_pitch, hip_roll, _] = *other_leg;
    [hip_pitch, hip_roll, knee]
}

/// `e^(S1 q1) ... e^(Sn qn)`, RH0 (2-20).
fn product(screws: &[Screw], q: &[f64]) -> Pose {
    screws.iter().zip(q).fold(Pose::identity(), |pose, (screw, q)| pose * screw.exp(*q))
}
