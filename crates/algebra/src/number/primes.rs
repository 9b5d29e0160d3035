//! Word-size primes in descending order.

use super::Zp;
use super::zp::is_prime;

/// All primes below `limit` in descending order. A `limit` above [`Zp::LIMIT`] is reduced to it.
///
/// ```
/// let first: Vec<u64> = groebot_algebra::number::primes_below(1 << 31).take(2).collect();
/// assert_eq!(first, [2_147_483_647, 2_147_483_629]);
/// ```
pub fn primes_below(limit: u64) -> impl Iterator<Item = u64> {
    (2..limit.min(Zp::LIMIT)).rev().filter(|&n| is_prime(n))
}
