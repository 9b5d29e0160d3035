//! A folder with one modified file, `folder::check`. The first line is the file's name.
#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| groebot_fuzz::run("folder", bytes));
