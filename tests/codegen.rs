//! A program in source form that the tests of groebot-ik also use.
#![allow(dead_code)]

#[path = "../crates/ik/tests/codegen/builder.rs"]
pub mod builder;
#[path = "../crates/ik/tests/codegen/samples/wrist.rs"]
pub mod wrist;
