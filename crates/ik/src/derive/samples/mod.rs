//! Random targets modulo primes: their solutions, and the relations between few joints that hold at each of them.

pub(super) mod echelon;
pub(super) mod evidence;
pub(super) mod random_sample;
pub(super) mod sampled_relations;
