//! Peers of groebot with one interface each, for measurements and for a test of their solutions by groebot's forward kinematics.
//!
//! [`by_ik_geo`]: ik-geo (Elias and Wen 2022), closed forms only. [`by_opw`]: rs-opw-kinematics (Brandstoetter, Angerer and Hofbaur 2014). [`by_print`] and
//! [`by_batch`]: groebot, one target at a time and several at once; [`by_c`]: groebot in C. [`by_library`]: groebot without a compiler. [`inputs`]: the
//! pseudorandom inputs. [`rounds`]: the interleaved measurement. [`census`]: the numbers of lost poses and wrong solutions, and the accuracy of the correct
//! ones.

pub mod by_batch;
pub mod by_c;
pub mod by_ik_geo;
pub mod by_library;
pub mod by_opw;
pub mod by_print;
pub mod census;
pub mod inputs;
pub mod rounds;

/// Joint values in the order and with the signs of groebot's chain \[rad\].
pub type Joints = [f64; 6];

/// For each joint: an angle's cosine and sine, or a length and zero.
pub type Pairs = [[f64; 2]; 6];
