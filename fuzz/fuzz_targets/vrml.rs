//! VRML in the form of RH0 Fig. 5-4, written in all formats.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| groebot_fuzz::run("vrml", bytes));
