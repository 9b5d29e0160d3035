//! Robots in TOML, written as URDF and MJCF.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| groebot_fuzz::run("robot_toml", bytes));
