//! Rooms with furniture, `nav::Room`.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| groebot_fuzz::run("room_toml", bytes));
