//! Systems of polynomials in plain text.
#![no_main]

use groebot::poly::system::Format;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| groebot_fuzz::system(bytes, Format::Plain));
