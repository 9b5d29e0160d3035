//! YAML of ROS' `map_server`, `nav::Meaning`.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| groebot_fuzz::run("map_yaml", bytes));
