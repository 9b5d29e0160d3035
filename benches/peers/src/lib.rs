//! Peers of groebot behind one interface each, for measurements and for a test that their answers pass our forward kinematics.
//!
//! [`by_ik_geo`]: ik-geo (Elias and Wen 2022), closed forms only. [`by_opw`]: rs-opw-kinematics (Brandstoetter, Angerer and Hofbaur
//! 2014). [`by_print`] and [`by_batch`]: our own, one target at a time and several at once; [`by_c`]: the same in C. [`by_library`]: our own without a compiler. [`inputs`]: the random inputs, always the same. [`rounds`]: the measurement,
//! interleaved. [`census`]: how many poses are lost, how many answers are wrong, how exact the others are.

pub mod by_batch;
pub mod by_c;
pub mod by_ik_geo;
pub mod by_library;
pub mod by_opw;
pub mod by_print;
pub mod census;
pub mod inputs;
pub mod rounds;

/// Joint values in the order and with the signs of our chain \[rad\].
pub type Joints = [f64; 6];

/// By joint: an angle's cosine and sine; a length and zero.
pub type Pairs = [[f64; 2]; 6];
