//! VRML as RH0 Fig. 5-4 shows it: what is read is written again.
#![no_main]

use groebot::sim::export::Scene;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let Ok(scene) = Scene::from_vrml(text) else { return };
    assert!(scene.to_x3d().is_ok() && scene.to_wrl().is_ok());
    // Numbers may be too large for singles.
    let _ = scene.to_glb();
});
