//! LaTeX of expressions.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|text: &str| {
    let _ = groebot::poly::parse_latex(text);
});
