//! Known robots as [`Chain`]s: NAO, RH0, TEO, PUMA, Stanford, a polar robot, UR5, IRB 120. The figures stand in `data/*.toml`
//! (format: [`crate::kinematics::chain_toml`]) with their source beside them; what is inferred or assumed says so there.
//!
//! All are in metres and radians. Main type: [`Robot`]. [`Whole`] is NAO, RH0 or TEO with all its limbs and masses.

mod whole;

pub use whole::{Sole, Weight, Whole, WholeLimb, WholeLink, place_of};

use crate::kinematics::Chain;

/// A robot, or one limb of it, that comes with this crate.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Robot {
    name: &'static str,
    text: &'static str,
}

impl Robot {
    /// Its name: that of its chain, its file and its function here.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// The text of its `chain.toml`.
    pub fn text(&self) -> &'static str {
        self.text
    }

    /// Its chain.
    pub fn chain(&self) -> Chain {
        Chain::from_toml(self.text).expect("the crate's own data, which tests/robots reads")
    }
}

macro_rules! robots {
    ($($(#[$about:meta])* $name:ident;)+) => {
        /// All robots of this module.
        pub const ALL: &[Robot] = &[$(Robot {
            name: stringify!($name),
            text: include_str!(concat!("data/", stringify!($name), ".toml")),
        }),+];

        $($(#[$about])* pub fn $name() -> Chain {
            Robot { name: stringify!($name), text: include_str!(concat!("data/", stringify!($name), ".toml")) }.chain()
        })+
    };
}

robots! {
    /// The polar robot of RH0 2.7: yaw, pitch, slide. Task: position.
    polar;
    /// The arm of PUMA type of RH0 A.2.
    puma;
    /// The arm of Stanford type of RH0 A.1: the third joint slides.
    stanford;
    /// Universal Robots UR5, from the maker's Denavit-Hartenberg parameters.
    ur5;
    /// ABB IRB 120 with a tool that points down at zero.
    irb120;
    /// RH0's right leg, foot to trunk: RH0 (3-10)-(3-24). Lengths inferred, limits assumed.
    rh0_right_leg;
    /// RH0's left leg, foot to trunk: RH0 (3-25)-(3-39). Lengths inferred, limits assumed.
    rh0_left_leg;
    /// The left leg of TEO, RH0's successor, root to sole.
    teo_leg;
    /// NAO's left leg, torso to sole.
    nao_left_leg;
    /// NAO's right leg, torso to sole.
    nao_right_leg;
    /// NAO's left arm, torso to hand: five joints.
    nao_left_arm;
    /// NAO's right arm, torso to hand: five joints.
    nao_right_arm;
    /// NAO's head, torso to HeadPitch: two joints.
    nao_head;
}

/// The chain of the robot called `name`; `None` when no robot of [`ALL`] has that name.
pub fn by_name(name: &str) -> Option<Chain> {
    ALL.iter().find(|robot| robot.name == name).map(Robot::chain)
}

/// RH0 as a whole: its legs, column and arms; its mass is a point at the trunk's frame, for that of its links is not known.
pub fn rh0() -> Whole {
    Whole::from_toml(include_str!("whole/rh0.toml")).expect("the crate's own data, which tests/robots reads")
}

/// TEO as a whole: its legs, and all that is above them as one body.
pub fn teo() -> Whole {
    Whole::from_toml(include_str!("whole/teo.toml")).expect("the crate's own data, which tests/robots reads")
}

/// NAO V5 as a whole: torso, head, arms and legs, their masses, speeds and soles.
pub fn nao_v5() -> Whole {
    Whole::from_toml(include_str!("whole/nao_v5.toml")).expect("the crate's own data, which tests/robots reads")
}
