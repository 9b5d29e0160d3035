//! Monomial orders; what is read prints as the same order.
#![no_main]

use groebot::poly::system::parse_order;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    if let Ok(order) = parse_order(text) {
        assert_eq!(parse_order(&order.to_string()), Ok(order));
    }
});
