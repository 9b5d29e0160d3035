//! Robots: URDF, in any encoding.
#![no_main]

use groebot::document::decode_xml;
use groebot::model::Robot;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let Ok(decoded) = decode_xml(bytes) else { return };
    let Ok(robot) = Robot::from_urdf(&decoded.text) else { return };
    for tip in robot.leaves() {
        let _ = robot.chain(None, Some(tip)).and_then(|_| robot.path(None, Some(tip))).map(|path| robot.notes(&path));
    }
});
