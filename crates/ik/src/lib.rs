//! Closed-form inverse kinematics that is complete and proved: from a chain of joints to a solver of all solutions.
//!
//! The modules in the order of their dependencies:
//!
//! * [`solver`] is the derived solver as plain data, a straight-line program with branches, and its evaluation.
//! * [`reach`] computes reachability maps of a solver.
//! * [`derive`](mod@derive) derives and proves a solver from a chain or a system of equations.
//! * [`witness`] checks a solver numerically by independent methods.
//! * [`codegen`] prints a solver, or the dynamics of a robot, as source code.
//! * [`folder`] lists and checks the files of a derivation.
//!
//! ```
//! use groebot_ik::{codegen, derive};
//! use groebot_robot::kinematics::Target;
//! use groebot_robot::robots;
//!
//! // The order of the joints, a Groebner basis for each step with its proof, and a program.
//! let chain = robots::ur5();
//! let derivation = derive(&chain)?;
//!
//! // All solutions of a pose; forward kinematics confirms each.
//! let target = Target::Pose(chain.forward(&[0.1, -1.2, 1.4, -0.3, 0.8, 0.5])?);
//! let solutions = derivation.solver().solve(&target)?;
//! assert_eq!(solutions.len(), 8);
//! for solution in &solutions {
//!     let [distance, angle] = target.missed(&chain, &solution.q);
//!     assert!(distance < 1e-12 && angle < 1e-12);
//! }
//!
//! // The same solver as source code.
//! assert!(codegen::rust::emit(derivation.program()).contains("pub fn"));
//! # Ok::<(), groebot_ik::Error>(())
//! ```

pub mod solver;

pub mod reach;

pub mod derive;

pub mod witness;

pub mod codegen;

pub mod folder;

pub use derive::derive;
pub use groebot_algebra::{Error, ErrorKind, Result, Watch};
