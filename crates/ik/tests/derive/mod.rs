//! Tests of `groebot_ik::derive`.

mod certificate;
mod chains;
mod closure;
mod coupled;
pub mod described;
mod described_singular;
mod encoding;
mod ends;
mod explain;
mod families;
mod followers;
mod mimic;
mod noisy;
mod options;
mod planner;
mod position_yaw;
mod random_chains;
pub mod redundant;
mod renamed;
mod robots;
mod seed;
mod sequential;
mod strata;
mod system;
mod system_toml;
mod upright;
