//! The axioms of rings and fields as reusable test functions. Every ring and field of the crate is tested with them.

use super::{BigInt, Field, Ring};

/// Asserts the axioms of a commutative ring on all triples of `samples`.
///
/// # Panics
/// When an axiom does not hold; the message names it.
pub fn ring_axioms<R: Ring>(ring: &R, samples: &[R::Element]) {
    let (zero, one) = (ring.zero(), ring.one());
    assert!(ring.is_zero(&zero) && ring.is_one(&one) && zero != one, "zero and one differ");
    for a in samples {
        assert_eq!(&ring.add(a, &zero), a, "a + 0 = a");
        assert_eq!(&ring.mul(a, &one), a, "a * 1 = a");
        assert!(ring.is_zero(&ring.mul(a, &zero)), "a * 0 = 0");
        assert!(ring.is_zero(&ring.add(a, &ring.neg(a))), "a + (-a) = 0");
        assert_eq!(ring.is_zero(a), a == &zero, "zero is one element");
        assert_eq!(ring.pow(a, 3), ring.mul(a, &ring.mul(a, a)), "a^3 = a a a");
        for b in samples {
            pair_axioms(ring, a, b);
            for c in samples {
                triple_axioms(ring, a, b, c);
            }
        }
    }
    integers_embed(ring);
}

fn pair_axioms<R: Ring>(ring: &R, a: &R::Element, b: &R::Element) {
    assert_eq!(ring.add(a, b), ring.add(b, a), "a + b = b + a");
    assert_eq!(ring.mul(a, b), ring.mul(b, a), "a b = b a");
    assert_eq!(ring.sub(a, b), ring.add(a, &ring.neg(b)), "a - b = a + (-b)");
    if let Some(quotient) = ring.checked_div(a, b) {
        assert_eq!(&ring.mul(&quotient, b), a, "(a / b) b = a");
    }
}

fn triple_axioms<R: Ring>(ring: &R, a: &R::Element, b: &R::Element, c: &R::Element) {
    let sum = ring.add(b, c);
    assert_eq!(ring.add(&ring.add(a, b), c), ring.add(a, &sum), "(a + b) + c = a + (b + c)");
    assert_eq!(ring.mul(&ring.mul(a, b), c), ring.mul(a, &ring.mul(b, c)), "(a b) c = a (b c)");
    let distributed = ring.add(&ring.mul(a, b), &ring.mul(a, c));
    assert_eq!(ring.mul(a, &sum), distributed, "a (b + c) = a b + a c");
}

fn integers_embed<R: Ring>(ring: &R) {
    let image = |n: i64| ring.from_integer(&BigInt::from(n));
    assert!(ring.is_zero(&image(0)) && ring.is_one(&image(1)), "0 and 1 embed");
    assert_eq!(ring.add(&image(7), &image(-12)), image(-5), "integers add");
    assert_eq!(ring.mul(&image(7), &image(-12)), image(-84), "integers multiply");
}

/// Asserts the axioms of a field: those of a ring, and an inverse of every nonzero element.
pub fn field_axioms<F: Field>(field: &F, samples: &[F::Element]) {
    ring_axioms(field, samples);
    assert!(field.inverse(&field.zero()).is_none(), "zero has no inverse");
    for a in samples.iter().filter(|a| !field.is_zero(a)) {
        let inverse = field.inverse(a).expect("every nonzero element has an inverse");
        assert!(field.is_one(&field.mul(a, &inverse)), "a / a = 1");
    }
    if field.characteristic() > 0 {
        let p = field.from_integer(&BigInt::from(field.characteristic()));
        assert!(field.is_zero(&p), "p = 0 in characteristic p");
    }
}
