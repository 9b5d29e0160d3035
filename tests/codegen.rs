//! A program written by hand that the tests of groebot-ik have too.
#![allow(dead_code)]

#[path = "../crates/ik/tests/codegen/builder.rs"]
pub mod builder;
#[path = "../crates/ik/tests/codegen/samples/wrist.rs"]
pub mod wrist;
