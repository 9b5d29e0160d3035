//! Closed-form inverse kinematics that is complete and proven: from a description of a mechanism to a solver of all solutions.
//!
//! The modules are in the order of the data flow. Each stage is a plain struct that implements `Display`.
//!
//! ```
//! use groebot::codegen;
//! use groebot::kinematics::Target;
//! use groebot::model::Robot;
//!
//! // A robot from its description, here with angles of 1.5708, and the chain from its root to its tip.
//! let robot = Robot::read("tests/corpus/urdf/ur5.urdf")?;
//! let chain = robot.chain(None, None)?;
//!
//! // Its solver: the order of the joints, a Groebner basis for each step with its proof, a program.
//! let derivation = groebot::derive(&chain)?;
//! let solver = derivation.solver();
//!
//! // All solutions of a pose, checked by forward kinematics.
//! let pose = chain.forward(&[0.1, -1.2, 1.4, -0.3, 0.8, 0.5])?;
//! let solutions = solver.solve(&pose)?;
//! assert_eq!(solutions.len(), 8);
//! for solution in &solutions {
//!     let [distance, angle] = Target::Pose(pose).missed(&chain, &solution.q);
//!     assert!(distance < 1e-12 && angle < 1e-12);
//! }
//!
//! // The same solver as source code.
//! assert!(codegen::rust::emit(derivation.program()).contains("shoulder_pan"));
//! # Ok::<(), groebot::Error>(())
//! ```
//!
//! A mechanism may have one block of equations, such as NAO's leg in its sagittal plane. [`derive::Derivation`] displays its polynomials:
//! `examples/02_planar_leg.rs`.
#![cfg_attr(test, allow(missing_docs))]

pub use groebot_algebra::{Error, ErrorKind, Result, Watch};
pub use groebot_algebra::{error, escape, groebner, limits, number, poly, random, real, roots, watch};
pub use groebot_humanoid::{gait, nav, sim, task, view};
pub use groebot_ik::{codegen, derive, folder, reach, solver, witness};
pub use groebot_robot::{control, document, dynamics, files, kinematics, model, motion, spatial};

/// Robots by name: chains and descriptions, and humanoids with their walks.
pub mod robots {
    pub use groebot_humanoid::walkers::*;
    pub use groebot_robot::robots::*;
}

#[cfg(feature = "cli")]
pub mod cli;
