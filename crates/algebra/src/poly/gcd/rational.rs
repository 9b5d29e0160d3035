//! The gcd over Q from gcds modulo word-size primes: Chinese remaindering, rational reconstruction, and a proof by
//! exact division over the integers (Brown 1971; von zur Gathen and Gerhard, Modern Computer Algebra, chapter 6).

use num_traits::One;

use super::Common;
use super::modular::Search;
use crate::Watch;
use crate::number::{BigInt, BigRational, Field};
use crate::poly::words::{Images, Integral, Packing, Prime, convert, primes};
use crate::poly::{Polynomial, PolynomialRing};

/// Maximum number of primes before the caller uses another method.
const PRIMES: usize = 1000;

/// The monic gcd of two nonzero polynomials over Q and its cofactors.
pub fn common_in<F: Field>(
    ring: &PolynomialRing<F>,
    packing: &Packing,
    f: &Polynomial<F::Element>,
    g: &Polynomial<F::Element>,
    watch: &Watch,
) -> Option<Common<Polynomial<F::Element>>> {
    let (f_integral, f_content) = convert::to_integral(ring, packing, f)?;
    let (g_integral, g_content) = convert::to_integral(ring, packing, g)?;
    let found = common(packing, &f_integral, &g_integral, watch)?;
    if found.gcd.is_constant() {
        return Some(Common { gcd: ring.constant(ring.field().one()), left: f.clone(), right: g.clone() });
    }
    let one = BigRational::one();
    let gcd = convert::from_integral(ring, packing, &found.gcd, &one);
    let lead = convert::leading_number(ring, &gcd)?;
    let back = |part: &Integral, content: BigRational| convert::from_integral(ring, packing, part, &(content * &lead));
    let (left, right) = (back(&found.left, f_content), back(&found.right, g_content));
    Some(Common { gcd: ring.monic(&gcd), left, right })
}

/// The primitive gcd of two primitive polynomials and its cofactors.
pub fn common(packing: &Packing, f: &Integral, g: &Integral, watch: &Watch) -> Option<Common<Integral>> {
    let (mut images, mut lead) = (Images::default(), u128::MAX);
    for p in primes().take(PRIMES) {
        let field = Prime::new(p);
        let (f_image, g_image) = (f.image(&field), g.image(&field));
        if f_image.keys.first() != f.keys.first() || g_image.keys.first() != g.keys.first() {
            continue;
        }
        let image = Search::new(&field, packing, watch).repeated(&f_image, &g_image)?.gcd;
        if image.is_constant() {
            let one = Integral { keys: vec![0], values: vec![BigInt::one()] };
            return Some(Common { gcd: one, left: f.clone(), right: g.clone() });
        }
        let found = image.keys[0];
        if found > lead {
            continue;
        }
        if found < lead {
            (images, lead) = (Images::default(), found);
        }
        images.add(&field, image);
        if let Some(gcd) = images.rational()
            && let Some(left) = f.quotient(packing, &gcd)
            && let Some(right) = g.quotient(packing, &gcd)
        {
            return Some(Common { gcd, left, right });
        }
    }
    None
}
