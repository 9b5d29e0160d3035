//! Robots: URDF.
#![no_main]

use groebot::model::Robot;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let _ = Robot::from_urdf(text);
});
