//! The sagittal kinematics division (SKD; DCS in the thesis) of RH0, 3.4: the humanoid as two manipulators, left and right, from the
//! ground to the hands. Main type: [`Manipulator`].
//!
//! Frames and joints are the thesis': x to the robot's left, y up, z ahead; S lies below the trunk's middle at the height of the ankles,
//! H is the trunk. Six virtual joints put the foot where it is: three translations, then turns about y, z and x through S.

use nalgebra::{Point3, Vector3};

use super::footprint::Side;
use super::legs::{LegValues, answers};
use crate::kinematics::Chain;
use crate::robots::{self, Whole};
use crate::spatial::{Pose, Screw};
use crate::{Error, ErrorKind, Result};

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
#[derive(Clone, Debug, PartialEq)]
pub struct Manipulator {
    chain: Chain,
    /// Of the virtual joints, RH0 (3-10), (3-11), (3-25), (3-26).
    foot: Vec<Screw>,
    /// Of the column and the arm; lengths assumed.
    upper: Vec<Screw>,
    root_from_hand: Pose,
}

impl Manipulator {
    /// The half of RH0 on `side`.
    ///
    /// # Errors
    /// None with the crate's own data.
    pub fn rh0(side: Side) -> Result<Self> {
        let chain = match side {
            Side::Left => robots::rh0_left_leg(),
            Side::Right => robots::rh0_right_leg(),
        };
        let whole = robots::rh0();
        let missing = |name: &str| Error::new(ErrorKind::UnknownName, format!("rh0 has no limb `{name}`"));
        let limb = |name: String| whole.limbs.iter().find(|limb| limb.chain == name).ok_or_else(|| missing(&name));
        let root_from_base = limb(chain.name().to_owned())?.base_from_root.inverse();
        let upper = [limb("rh0_column".into())?, limb(format!("rh0_{}_arm", side.name()))?];
        let joints: Vec<usize> = upper.iter().flat_map(|limb| limb.joints.iter().copied()).collect();
        let hand = joints.last().map_or(Point3::origin(), |joint| location(&whole, *joint));
        let slide = [Vector3::x(), Vector3::y(), Vector3::z()].map(Screw::prismatic);
        let turn = [Vector3::y(), Vector3::z(), Vector3::x()].map(|axis| Screw::revolute(axis, Point3::origin()));
        Ok(Manipulator {
            foot: slide.into_iter().chain(turn).collect::<Result<_>>()?,
            upper: joints.iter().map(|joint| whole.links[*joint].screw.moved(&root_from_base)).collect(),
            root_from_hand: Pose::from_parts(
                (root_from_base * hand).coords.into(),
                nalgebra::UnitQuaternion::identity(),
            ),
            chain,
        })
    }

    /// The motion of the foot since the reference configuration.
    pub fn foot(&self, virtual_joints: &Virtual) -> Pose {
        product(&self.foot, virtual_joints)
    }

    /// The virtual joints that make the motion `foot` since the reference configuration; where the turn about z is a quarter, the turn
    /// about x is zero.
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
        let [a, b, c, d] = real.arm;
        let upper = product(&self.upper, &[real.column, a, b, c, d]) * self.root_from_hand;
        self.foot(virtual_joints) * product(self.chain.screws(), &real.leg) * upper
    }

    /// All joint values of the leg that bring the trunk to `trunk` with the foot at `virtual_joints`, up to eight (3-24), (3-39), by the
    /// derived solver.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when a value is not finite.
    pub fn legs(&self, virtual_joints: &Virtual, trunk: &Pose) -> Result<Vec<LegValues>> {
        answers(self.chain.name(), &self.foot(virtual_joints).inv_mul(trunk))
    }

    /// The leg's chain, from foot to trunk.
    pub fn chain(&self) -> &Chain {
        &self.chain
    }
}

/// The joints 14 to 16 of the right arm, or 18 to 20 of the left one, from the leg of the other side: RH0 (3-23), (3-38).
pub fn coordinated_arm(other_leg: &LegValues) -> [f64; 3] {
    let [_, _, knee, hip_pitch, hip_roll, _] = *other_leg;
    [hip_pitch, hip_roll, knee]
}

/// `e^(S1 q1) ... e^(Sn qn)`, RH0 (2-20).
fn product(screws: &[Screw], q: &[f64]) -> Pose {
    screws.iter().zip(q).fold(Pose::identity(), |pose, (screw, q)| pose * screw.exp(*q))
}

fn location(whole: &Whole, joint: usize) -> Point3<f64> {
    whole.links[joint].base_from_link.translation.vector.into()
}
