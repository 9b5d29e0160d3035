//! Maps of what solvers reach; what is read is written as text that reads the same, and drawn.
#![no_main]

use groebot::reach::ReachMap;
use libfuzzer_sys::fuzz_target;

/// Maps of more places are read but not drawn.
const PLACES: usize = 100_000;

fuzz_target!(|text: &str| {
    if let Ok(map) = ReachMap::from_json(text) {
        assert_eq!(ReachMap::from_json(&map.to_json()).map(|again| again.to_json()), Ok(map.to_json()));
        if map.grid.places() < PLACES {
            let _ = map.to_svg(None);
        }
    }
});
