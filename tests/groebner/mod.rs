//! Tests of `groebot::groebner`.

mod known;
