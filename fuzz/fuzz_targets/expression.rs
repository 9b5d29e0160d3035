//! Plain text of expressions and equations.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let _ = groebot::poly::parse_equation(text);
    groebot_fuzz::expression(groebot::poly::parse(text));
});
