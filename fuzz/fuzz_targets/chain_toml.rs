//! Chains: `chain.toml`.
#![no_main]

use groebot::kinematics::Chain;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let _ = Chain::from_toml(text);
});
