//! The generated solvers in the wheel, those of `derivations/`. Their results are bitwise identical to those of the interpreted programs. Main type: [`Known`].

use crate::compiled::Code;

/// A solver in the wheel.
pub struct Known {
    /// Its name, which is that of its folder in `derivations/`.
    pub name: &'static str,
    /// The chain, as `chain.toml`.
    pub chain: &'static str,
    /// The program, as JSON.
    pub program: &'static str,
    /// Its generated code.
    pub code: fn() -> Box<dyn Code>,
}

macro_rules! known {
    ($($name:ident)+) => {
        /// All solvers of the wheel.
        pub const ALL: &[Known] = &[$(Known {
            name: stringify!($name),
            chain: include_str!(concat!("../../derivations/", stringify!($name), "/0_chain.toml")),
            program: include_str!(concat!("../../derivations/", stringify!($name), "/5_program.json")),
            code: || Box::new($name::Solver),
        }),+];
    };
}

#[rustfmt::skip]
#[path = "../../derivations/ur5/5_solver.rs"]
mod ur5;
#[rustfmt::skip]
#[path = "../../derivations/puma/5_solver.rs"]
mod puma;
#[rustfmt::skip]
#[path = "../../derivations/puma560/5_solver.rs"]
mod puma560;
#[rustfmt::skip]
#[path = "../../derivations/irb120/5_solver.rs"]
mod irb120;
#[rustfmt::skip]
#[path = "../../derivations/stanford/5_solver.rs"]
mod stanford;
#[rustfmt::skip]
#[path = "../../derivations/scara/5_solver.rs"]
mod scara;
#[rustfmt::skip]
#[path = "../../derivations/iiwa14/5_solver.rs"]
mod iiwa14;
#[rustfmt::skip]
#[path = "../../derivations/nao_left_leg/5_solver.rs"]
mod nao_left_leg;
#[rustfmt::skip]
#[path = "../../derivations/nao_right_leg/5_solver.rs"]
mod nao_right_leg;
#[rustfmt::skip]
#[path = "../../derivations/nao_left_arm/5_solver.rs"]
mod nao_left_arm;
#[rustfmt::skip]
#[path = "../../derivations/nao_right_arm/5_solver.rs"]
mod nao_right_arm;
#[rustfmt::skip]
#[path = "../../derivations/nao_head/5_solver.rs"]
mod nao_head;
#[rustfmt::skip]
#[path = "../../derivations/rh0_left_leg/5_solver.rs"]
mod rh0_left_leg;
#[rustfmt::skip]
#[path = "../../derivations/rh0_right_leg/5_solver.rs"]
mod rh0_right_leg;
#[rustfmt::skip]
#[path = "../../derivations/teo_leg/5_solver.rs"]
mod teo_leg;

known! {
    ur5 puma puma560 irb120 stanford scara iiwa14 nao_left_leg nao_right_leg nao_left_arm nao_right_arm nao_head rh0_left_leg rh0_right_leg teo_leg
}

/// The solver with this name.
pub fn by_name(name: &str) -> Option<&'static Known> {
    ALL.iter().find(|known| known.name == name)
}
