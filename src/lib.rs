//! Closed-form inverse kinematics that is complete and proven: from a description of a mechanism to a solver of all solutions.
//!
//! The modules stand in the order of the way that the data goes; each stage is plain data that prints.
//!
//! ```
//! use groebot::derive::{Derivation, certificate, formulate};
//! use groebot::kinematics::Chain;
//! use groebot::{Watch, codegen};
//!
//! // A chain: NAO's leg in the sagittal plane, two joints about y, lengths in exact millimetres.
//! let chain = Chain::from_toml(r#"
//!     name = "leg"
//!     length_unit = "mm"
//!     order = ["c4", "c3", "s4", "s3"]
//!     task = { kind = "planar_position", plane = "xz" }
//!     tip = { point = [0, 0, 202.9] }
//!     [[joint]]
//!     name = "HipPitch"
//!     symbol = "3"
//!     type = "revolute"
//!     axis = [0, 1, 0]
//!     point = [0, 0, 0]
//!     [[joint]]
//!     name = "KneePitch"
//!     symbol = "4"
//!     type = "revolute"
//!     axis = [0, 1, 0]
//!     point = [0, 0, 100]
//! "#)?;
//!
//! // Its equations, and a proved Groebner basis of them on every stratum of the target (px, pz).
//! let system = formulate(&chain)?;
//! let derivation = Derivation::new(system.clone(), &Watch::none())?;
//! let basis = derivation.requested.solved().expect("two solutions").triangular.to_string();
//! assert!(basis.contains("20580*c4 + (-px^2 - pz^2 + 20588.41) = 0"), "NAO (6.7.18)");
//!
//! // The proof can be checked again from its text, without the engine.
//! let text = certificate::write(&derivation)?;
//! assert_eq!(certificate::prove(&system, &text)?, derivation);
//!
//! // All solutions, and forward kinematics as their witness.
//! let solutions = derivation.program.solve(&[60.0, 150.0])?;
//! assert_eq!(solutions.len(), 2);
//! for solution in &solutions {
//!     let tip = chain.forward(&solution.q)?.translation;
//!     assert!((tip.x - 60.0).abs() < 1e-10 && (tip.z - 150.0).abs() < 1e-10);
//! }
//!
//! // The same solver as source code.
//! assert!(codegen::c99::emit(&derivation.program).contains("HipPitch"));
//! # Ok::<(), groebot::Error>(())
//! ```
#![cfg_attr(test, allow(missing_docs))]

pub mod error;
pub mod files;
pub mod watch;

pub mod number;
pub mod poly;

pub mod groebner;
pub mod roots;

pub mod real;

pub mod document;

pub mod spatial;

pub mod model;

pub mod kinematics;

pub mod dynamics;

pub mod solver;

pub mod motion;

pub mod gait;

pub mod robots;

pub mod derive;

pub mod codegen;

pub mod witness;

#[cfg(feature = "cli")]
pub mod cli;

pub use error::{Error, ErrorKind, Result};
pub use watch::Watch;
