//! Robots by name. [`LISTED`] has arms, legs, hands and humanoids of many vendors; [`by_name`] gives a chain, [`robot`] a humanoid.
//! The numbers are in `data/*.toml` with their sources. Inferred and assumed values are marked there.
//!
//! All are in metres and radians. Main types: [`Listed`], a robot with its vendor and the check of its numbers, and [`Known`], a chain with a function of its own.

mod find;
mod listed;
mod table;

pub use find::find;
pub use listed::{Kind, Listed};
pub use table::LISTED;

use crate::kinematics::{Chain, ChainParts};
use crate::model::Robot;

/// A chain of this crate: an arm, or a limb of a humanoid.
#[derive(Clone, Copy, Debug)]
pub struct Known {
    name: &'static str,
    chain: fn() -> Chain,
}

impl Known {
    /// Its name, which is that of its chain and of its function in this module.
    pub fn name(&self) -> &'static str {
        self.name
    }

    /// The chain.
    pub fn chain(&self) -> Chain {
        (self.chain)()
    }
}

macro_rules! arms {
    ($($(#[$about:meta])* $name:ident;)+) => {
        $($(#[$about])* pub fn $name() -> Chain {
            let text = include_str!(concat!("data/", stringify!($name), ".toml"));
            Chain::from_toml(text).expect("the crate's own data, which tests/robots reads")
        })+
    };
}

arms! {
    /// The polar robot of RH0 2.7: yaw, pitch, and a prismatic joint. Task: position.
    polar;
    /// The arm of PUMA type of RH0 A.2.
    puma;
    /// The arm of Stanford type of RH0 A.1, whose third joint is prismatic.
    stanford;
    /// Universal Robots UR5, from the manufacturer's Denavit-Hartenberg parameters.
    ur5;
    /// ABB IRB 120 with a tool that points down at the zero configuration.
    irb120;
}

macro_rules! limbs {
    ($($(#[$about:meta])* $name:ident: $robot:ident, $base:literal to $tip:literal, $words:literal;)+) => {
        /// All chains of this module.
        pub const ALL: &[Known] = &[
            Known { name: "polar", chain: polar },
            Known { name: "puma", chain: puma },
            Known { name: "stanford", chain: stanford },
            Known { name: "ur5", chain: ur5 },
            Known { name: "irb120", chain: irb120 },
            $(Known { name: stringify!($name), chain: $name }),+
        ];

        $($(#[$about])* pub fn $name() -> Chain {
            limb(&$robot(), stringify!($name), $base, $tip, $words)
        })+
    };
}

limbs! {
    /// RH0's right leg, foot to trunk: RH0 (3-10)-(3-24). Lengths inferred, limits assumed.
    rh0_right_leg: rh0, "RS" to "Trunk", "ankle axes meet, knee parallel, hip axes meet in one point; x left, y up, z ahead";
    /// RH0's left leg, foot to trunk: RH0 (3-25)-(3-39). Lengths inferred, limits assumed.
    rh0_left_leg: rh0, "LS" to "Trunk", "ankle axes meet, knee parallel, hip axes meet in one point; x left, y up, z ahead";
    /// The left leg of TEO, RH0's successor, root to sole.
    teo_leg: teo, "RootWaist" to "l_sole", "three hip axes meet, hip, knee and ankle pitch parallel, ankle axes meet; z up";
    /// NAO's left leg, torso to sole.
    nao_left_leg: nao_v5, "Torso" to "l_sole", "three hip axes meet, hip, knee and ankle pitch parallel, ankle axes meet; z up";
    /// NAO's right leg, torso to sole.
    nao_right_leg: nao_v5, "Torso" to "r_sole", "three hip axes meet, hip, knee and ankle pitch parallel, ankle axes meet; z up";
    /// NAO's left arm, torso to hand: five joints.
    nao_left_arm: nao_v5, "Torso" to "l_hand", "five joints: few poses are reachable, so use poses from forward kinematics";
    /// NAO's right arm, torso to hand: five joints.
    nao_right_arm: nao_v5, "Torso" to "r_hand", "five joints: few poses are reachable, so use poses from forward kinematics";
    /// NAO's head, torso to HeadPitch: two joints.
    nao_head: nao_v5, "Torso" to "Head", "two joints whose axes intersect at the tip: it reaches view directions only";
}

/// The chain `name` of [`ALL`] or [`LISTED`]; `None` when they do not contain it, and for a robot with several chains.
pub fn by_name(name: &str) -> Option<Chain> {
    let known = ALL.iter().find(|known| known.name == name).map(Known::chain);
    known.or_else(|| LISTED.iter().find(|listed| listed.name() == name)?.chain())
}

/// The humanoid `name`: `nao` or `nao_v5`, `rh0` or `teo`.
pub fn robot(name: &str) -> Option<Robot> {
    match name {
        "nao" | "nao_v5" => Some(nao_v5()),
        "rh0" => Some(rh0()),
        "teo" => Some(teo()),
        _ => None,
    }
}

/// NAO V5: torso, head, arms and legs, with masses, speeds and soles.
pub fn nao_v5() -> Robot {
    described(include_str!("data/nao_v5.toml"))
}

/// RH0: legs, column and arms. Its mass is a point at the trunk's frame, because the masses of its links are not known.
pub fn rh0() -> Robot {
    described(include_str!("data/rh0.toml"))
}

/// TEO: its legs, and the upper body as one link.
pub fn teo() -> Robot {
    described(include_str!("data/teo.toml"))
}

/// Reads the robot of one of this crate's files.
fn described(text: &str) -> Robot {
    Robot::from_toml(text).expect("the crate's own data, which tests/robots reads")
}

/// The chain of a limb with its own name.
fn limb(robot: &Robot, name: &str, base: &str, tip: &str, words: &str) -> Chain {
    let chain = robot.chain(Some(base), Some(tip)).expect("the crate's own data, which tests/robots reads");
    let description = Some(format!("{}, {base} to {tip}: {words}", robot.name()));
    let source = robot.parts().source.clone();
    Chain::new(ChainParts { name: name.to_owned(), description, source, ..chain.parts().clone() })
        .expect("the crate's own data, which tests/robots reads")
}
