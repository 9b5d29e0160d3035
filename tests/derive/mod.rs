//! Tests of `groebot::derive`.

mod system;
