//! groebot's generated solvers: the files `5_solver.rs` of `derivations/`.

use groebot::spatial::Pose;
use groebot_runtime::Solve;

use crate::{Joints, Pairs};

/// The twelve numbers of a target: a position, and a rotation by rows.
pub type Target = [f64; 12];

/// A generated solver as function pointers.
#[derive(Clone, Copy)]
pub struct Printed {
    /// Solves all targets and returns the number of all solutions.
    pub pass: fn(&[Target]) -> usize,
    /// Returns all solutions of one target.
    pub solutions: fn(&Target) -> Vec<Joints>,
    /// Same as `pass`, but with cosines and sines.
    pub pass_by_pairs: fn(&[Target]) -> usize,
    /// Same as `solutions`, but with cosines and sines.
    pub pairs: fn(&Target) -> Vec<Pairs>,
    /// Forward kinematics of all joint vectors.
    pub forward: fn(&[Joints]),
}

/// Solves all targets with a function of a generated solver.
macro_rules! pass {
    ($name:ident, $answer:ident, $solve:ident, $targets:ident) => {{
        let mut out = [$name::$answer::empty(&$name::Solver); $name::CAPACITY];
        let mut count = 0;
        for target in $targets {
            count += $name::Solver.$solve(std::hint::black_box(target), &mut out).unwrap_or(0);
            std::hint::black_box(&out);
        }
        count
    }};
}

/// Declares the generated solvers and their selection by name.
macro_rules! printed {
    ($($name:ident: $file:literal),* $(,)?) => {
        $(
            #[allow(missing_docs)]
            #[path = $file]
            pub(crate) mod $name;
        )*

        /// The generated solver of the robot with this name.
        pub fn solver(name: &str) -> Option<Printed> {
            match name {
                $(
                    stringify!($name) => Some(Printed {
                        pass: |targets| pass!($name, Solution, solve, targets),
                        pass_by_pairs: |targets| pass!($name, Pairs, solve_pairs, targets),
                        pairs: |target| {
                            let mut out = [$name::Pairs::empty(&$name::Solver); $name::CAPACITY];
                            let count = $name::Solver.solve_pairs(target, &mut out).unwrap_or(0);
                            out[..count].iter().map(|answer| answer.joints).collect()
                        },
                        solutions: |target| {
                            let mut out = [$name::EMPTY; $name::CAPACITY];
                            let count = $name::Solver.solve(target, &mut out).unwrap_or(0);
                            out[..count].iter().map(|answer| answer.q).collect()
                        },
                        forward: |all| {
                            for q in all {
                                std::hint::black_box($name::Solver.forward(std::hint::black_box(q)));
                            }
                        },
                    }),
                )*
                _ => None,
            }
        }
    };
}

printed! {
    irb120: "../../../derivations/irb120/5_solver.rs",
    nao_left_leg: "../../../derivations/nao_left_leg/5_solver.rs",
    nao_right_leg: "../../../derivations/nao_right_leg/5_solver.rs",
    puma: "../../../derivations/puma/5_solver.rs",
    rh0_left_leg: "../../../derivations/rh0_left_leg/5_solver.rs",
    rh0_right_leg: "../../../derivations/rh0_right_leg/5_solver.rs",
    spherical_wrist: "../../../derivations/spherical_wrist/5_solver.rs",
    stanford: "../../../derivations/stanford/5_solver.rs",
    teo_leg: "../../../derivations/teo_leg/5_solver.rs",
    ur5: "../../../derivations/ur5/5_solver.rs",
}

/// Converts `pose` to the target of a generated solver.
pub fn target(pose: &Pose) -> Target {
    let (position, rotation) = (pose.translation.vector, pose.rotation.to_rotation_matrix());
    std::array::from_fn(|i| if i < 3 { position[i] } else { rotation[((i - 3) / 3, i % 3)] })
}
