//! What is asked of a mechanism: `0_task.toml`; what is read prints as text that reads the same.
#![no_main]

use groebot::derive::Ends;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    if let Ok(ends) = Ends::from_toml(text) {
        assert_eq!(Ends::from_toml(&ends.to_toml()), Ok(ends));
    }
});
