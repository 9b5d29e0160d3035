//! Robots: URDF.
#![no_main]

use groebot::kinematics::Tree;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let _ = Tree::from_urdf(text);
});
