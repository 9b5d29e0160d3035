//! In which order the joints of a chain are found, one at a time: [`Plan`].

mod types;

pub use types::{Evidence, Plan, PlanStep, Way};
