//! Dense univariate polynomials over a finite field: words, constant term first, without trailing zeros.

use super::field::WordField;

/// A dense polynomial; empty for zero.
pub type Dense = Vec<u64>;

/// Drops trailing zeros.
pub fn trim(f: &mut Dense) {
    while f.last() == Some(&0) {
        f.pop();
    }
}

/// `f + c g x^shift`, in place.
pub fn add_scaled<K: WordField>(field: &K, f: &mut Dense, c: u64, g: &[u64], shift: usize) {
    if f.len() < g.len() + shift {
        f.resize(g.len() + shift, 0);
    }
    for (target, &value) in f[shift..].iter_mut().zip(g) {
        *target = field.add(*target, field.mul(c, value));
    }
    trim(f);
}

/// `f - g`.
pub fn sub<K: WordField>(field: &K, f: &[u64], g: &[u64]) -> Dense {
    let mut result = f.to_vec();
    add_scaled(field, &mut result, field.neg(1), g, 0);
    result
}

/// `c f`.
pub fn scale<K: WordField>(field: &K, f: &[u64], c: u64) -> Dense {
    if c == 0 { Dense::new() } else { f.iter().map(|&value| field.mul(value, c)).collect() }
}

/// `f` with leading coefficient one; zero stays zero.
pub fn monic<K: WordField>(field: &K, f: &[u64]) -> Dense {
    match f.last().and_then(|&lead| field.inverse(lead)) {
        Some(inverse) => scale(field, f, inverse),
        None => f.to_vec(),
    }
}

/// `f g`.
pub fn mul<K: WordField>(field: &K, f: &[u64], g: &[u64]) -> Dense {
    if f.is_empty() || g.is_empty() {
        return Dense::new();
    }
    let mut product = vec![0; f.len() + g.len() - 1];
    for (shift, &c) in f.iter().enumerate().filter(|(_, c)| **c != 0) {
        for (target, &value) in product[shift..].iter_mut().zip(g) {
            *target = field.add(*target, field.mul(c, value));
        }
    }
    product
}

/// Quotient and remainder of `f` by a nonzero `g`.
pub fn div_rem<K: WordField>(field: &K, f: &[u64], g: &[u64]) -> (Dense, Dense) {
    let inverse = g.last().and_then(|&lead| field.inverse(lead)).expect("the divisor is not zero");
    let low = &g[..g.len() - 1];
    let mut rest = f.to_vec();
    let mut quotient = vec![0; (f.len() + 1).saturating_sub(g.len())];
    for shift in (0..quotient.len()).rev() {
        let factor = field.mul(rest.pop().expect("it is longer than the divisor"), inverse);
        quotient[shift] = factor;
        if factor != 0 {
            let minus = field.neg(factor);
            for (target, &value) in rest[shift..].iter_mut().zip(low) {
                *target = field.add(*target, field.mul(minus, value));
            }
        }
    }
    trim(&mut rest);
    (quotient, rest)
}

/// The remainder of `f` by a nonzero `g`.
pub fn rem<K: WordField>(field: &K, f: &[u64], g: &[u64]) -> Dense {
    div_rem(field, f, g).1
}

/// The monic greatest common divisor.
pub fn gcd<K: WordField>(field: &K, f: &[u64], g: &[u64]) -> Dense {
    let (mut a, mut b) = (f.to_vec(), g.to_vec());
    while !b.is_empty() {
        let rest = rem(field, &a, &b);
        a = std::mem::replace(&mut b, rest);
    }
    monic(field, &a)
}

/// `s` with `s f = 1` modulo `g`; `None` unless `f` and `g` are coprime.
pub fn inverse_modulo<K: WordField>(field: &K, f: &[u64], g: &[u64]) -> Option<Dense> {
    let (mut r, mut s) = ((g.to_vec(), rem(field, f, g)), (Dense::new(), vec![1]));
    while !r.1.is_empty() {
        let (quotient, rest) = div_rem(field, &r.0, &r.1);
        let next = sub(field, &s.0, &mul(field, &quotient, &s.1));
        r = (r.1, rest);
        s = (s.1, next);
    }
    let inverse = if r.0.len() == 1 { field.inverse(r.0[0])? } else { return None };
    Some(rem(field, &scale(field, &s.0, inverse), g))
}

/// The formal derivative.
pub fn derivative<K: WordField>(field: &K, f: &[u64]) -> Dense {
    let p = field.characteristic();
    let mut result = f.iter().enumerate().skip(1).map(|(n, &c)| times(field, c, n as u64 % p)).collect();
    trim(&mut result);
    result
}

/// `n c`, by doubling: `n` is a plain number, not an element.
fn times<K: WordField>(field: &K, mut c: u64, mut n: u64) -> u64 {
    let mut sum = 0;
    while n > 0 {
        if n & 1 == 1 {
            sum = field.add(sum, c);
        }
        c = field.add(c, c);
        n >>= 1;
    }
    sum
}

/// The value at `x`.
pub fn evaluate<K: WordField>(field: &K, f: &[u64], x: u64) -> u64 {
    f.iter().rev().fold(0, |value, &c| field.add(field.mul(value, x), c))
}

/// `f^n` modulo `modulus`.
pub fn pow_modulo<K: WordField>(field: &K, f: &[u64], mut n: u64, modulus: &[u64]) -> Dense {
    let (mut result, mut square) = (rem(field, &[1], modulus), rem(field, f, modulus));
    while n > 0 {
        if n & 1 == 1 {
            result = rem(field, &mul(field, &result, &square), modulus);
        }
        n >>= 1;
        if n > 0 {
            square = rem(field, &mul(field, &square, &square), modulus);
        }
    }
    result
}
