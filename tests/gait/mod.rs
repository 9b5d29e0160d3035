//! Walking.

mod seed;
