//! Walking humanoids: gait planning with the zero moment point (ZMP), navigation, whole tasks, simulation and pages.
//!
//! The modules in the order of their dependencies:
//!
//! * [`gait`] plans walks of a biped: footsteps, centre of mass, joint angles, and a check of balance at every sample.
//! * [`walkers`] has NAO, RH0 and TEO with the parameters of their gaits and the generated solvers of their legs.
//! * [`nav`] finds paths on occupancy grids: fast marching, exact shortest paths, quickest paths.
//! * [`task`] plans a path of the body on a map, and footsteps along it.
//! * [`sim`] runs a walk through a room that changes meanwhile, compares walks with physics, and exports scenes.
//! * [`view`] writes self-contained HTML pages of robots and motions.
//!
//! ```
//! use groebot_humanoid::Watch;
//! use groebot_humanoid::gait::{Regular, Route, Side, Summary, Walker, plan};
//! use groebot_humanoid::walkers::{NAO_SINE, Outline, nao_walker};
//!
//! // NAO walks four steps of 40 mm, the last of which closes the feet.
//! let Walker { biped, legs, .. } = nao_walker(Outline::Measured)?;
//! let steps = Regular { steps: 4, length: 0.04, turn: 0.0, aside: 0.0, half_width: 0.05, first: Side::Left };
//! let request = NAO_SINE.request(&biped, Route::regular(&steps)?, NAO_SINE.hip_heights[0]);
//! let walk = plan(&biped, &legs, &request, &Watch::none())?;
//!
//! // The zero moment point keeps its margin inside the support polygon at every sample.
//! assert!(walk.balances.iter().all(|balance| balance.support.signed_distance(&balance.zmp) >= request.margin));
//! assert!((Summary::of(&biped, &walk).distance - 0.12).abs() < 1e-9);
//! # Ok::<(), groebot_humanoid::Error>(())
//! ```
//!
//! Metres, radians, seconds; the world has z up and the floor at 0. "NAO (6.8.1)" and "RH0 (3-5)" are equations of the two
//! sources: a chapter on NAO's kinematics, and the thesis on the humanoid RH0. `docs/errata.md` in the repository names both.

pub mod gait;

pub mod walkers;

pub mod nav;

pub mod task;

pub mod sim;

pub mod view;

pub use groebot_algebra::{Error, ErrorKind, Result, Watch};
