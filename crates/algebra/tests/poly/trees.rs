//! Random expressions for property tests.

use groebot_algebra::number::{BigInt, BigRational};
use groebot_algebra::poly::Expression;
use proptest::prelude::*;

/// The names that random trees use.
pub const NAMES: [&str; 5] = ["x", "c4", "py", "a_1", "L12"];

pub fn rational() -> impl Strategy<Value = BigRational> {
    (-2000i64..2000, 1i64..200).prop_map(|(a, b)| BigRational::new(BigInt::from(a), BigInt::from(b)))
}

/// Trees of any shape, empty and single sums included; `inverses` allows division.
pub fn tree(inverses: bool) -> impl Strategy<Value = Expression> {
    let leaf = prop_oneof![
        rational().prop_map(Expression::Number),
        proptest::sample::select(&NAMES[..]).prop_map(Expression::name),
    ];
    leaf.prop_recursive(5, 40, 4, move |inner| {
        prop_oneof![
            proptest::collection::vec(inner.clone(), 0..4).prop_map(Expression::Sum),
            proptest::collection::vec(inner.clone(), 0..4).prop_map(Expression::Product),
            inner.clone().prop_map(Expression::negated),
            inner.clone().prop_map(move |a| if inverses { Expression::Inverse(Box::new(a)) } else { a }),
            (inner, 0u32..4).prop_map(|(a, n)| a.power(n)),
        ]
    })
}
