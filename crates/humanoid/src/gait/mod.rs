//! Biped walking of NAO, RH0, TEO and other robots: footsteps, centre of mass, joint angles by the derived solvers, and a check of balance by the zero moment
//! point (ZMP). The centre of mass moves by a sine law, by preview control ([`Preview`]), or by one step goal ([`OneStep`]). Inverse dynamics (RNEA) gives the
//! forces ([`Forces`]). Sources: NAO 6.4 and 6.8; RH0 3.1 to 3.5.
//!
//! A [`Route`] of footsteps becomes a [`Schedule`] of phases. That becomes a [`Reference`] for feet and centre of mass at each sample, and then a [`Motion`] of
//! joint angles with its [`Balance`]. [`plan`] does all these steps, and slows down or rejects a walk that would fall. Its result is a [`Walk`], which prints
//! as CSV, JSON and SVG and has a [`Summary`]. The world has z up and the floor at 0; metres, seconds, radians.

mod balance;
mod biped;
mod chains;
mod check;
mod contact;
mod defaults;
mod drawing;
mod footing;
mod footprint;
mod forces;
mod join;
mod legs;
mod limbs;
mod mirrored;
mod motion;
mod nearby;
mod one_step;
mod parts;
mod plan;
mod polygon;
mod preview;
mod reference;
mod refusal;
mod request;
mod schedule;
mod shortened;
mod slower;
mod step_commands;
mod summary;
mod table;
mod thesis;
mod trials;
mod walker;
mod zmp;

pub use balance::{Balance, balance, support};
pub use biped::{Biped, Foot, JointRange};
pub use chains::{Chains, Difference};
pub use check::{Demand, Fault, Found};
pub use defaults::{GaitDefaults, REPAIRS, Steadier, plan_at};
pub use footing::Footing;
pub use footprint::{Footprint, Footstep, MAX_STEPS, Regular, Route, Side};
pub use forces::{Forces, Greatest};
pub use legs::{LegSolver, Legs, Posture};
pub use mirrored::Mirrored;
pub use motion::{Motion, Samples};
pub use one_step::{Instant, Laws, OneStep};
pub(crate) use plan::plan_actions;
pub use plan::{TICK, Walk, plan};
pub use polygon::Polygon;
pub use preview::Preview;
pub use reference::{Reference, Style, arch, smooth};
pub use request::{Gait, Request};
pub use schedule::{Action, Durations, Phase, Schedule};
pub use step_commands::{Measures, StepCommand, step_commands};
pub use summary::{Extreme, Summary};
pub use walker::Walker;
pub(crate) use walker::preview_defaults;
pub use zmp::{Configuration, GRAVITY, momentum_between, of_pendulum, zero_moment_point};
