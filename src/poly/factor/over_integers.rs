//! Factors of a square-free polynomial over the integers, in one or several variables.
//!
//! Small integers are put for all variables but the main one; the factors of that image over the integers are lifted
//! modulo word-size primes, and the coefficients rebuilt. Exact division proves the product; a factor is irreducible
//! because no part of its image's factors lifts.

use num_traits::{One, Pow, Zero};

use super::integers::{self, Integers};
use super::lift::Lifting;
use crate::number::BigInt;
use crate::poly::words::dense::{self, Dense};
use crate::poly::words::{Images, Integral, Packing, Prime, Random, primes, residue};
use crate::{Result, Watch};

/// Among how many points the one whose image has the fewest factors is chosen.
const POINTS: usize = 3;

/// A point and the factors of the image there.
struct Anchor {
    point: Vec<i64>,
    factors: Vec<Integers>,
}

/// The primitive irreducible factors of a square-free `f` that is primitive in `main`.
pub fn split_over_integers(packing: &Packing, f: &Integral, main: usize, watch: &Watch) -> Result<Vec<Integral>> {
    let others: Vec<usize> = (0..packing.variables())
        .filter(|&v| v != main && f.keys.iter().any(|&key| packing.exponent(key, v) > 0))
        .collect();
    if others.is_empty() {
        let factors = integers::factors(&image_at(f, packing, main, &[]), watch)?;
        return Ok(factors.into_iter().map(|factor| from_line(packing, main, factor)).collect());
    }
    let mut random = Random::new(3);
    for range in 4.. {
        let anchor = choose_anchor(f, packing, main, &others, range, &mut random, watch)?;
        if anchor.factors.len() == 1 {
            return Ok(vec![f.clone()]);
        }
        if let Some(factors) = split_at(f, packing, main, &others, &anchor, &mut random, watch)? {
            return Ok(factors);
        }
    }
    unreachable!("the range of points has no end")
}

fn from_line(packing: &Packing, main: usize, line: Integers) -> Integral {
    let terms = line.into_iter().enumerate().rev().filter(|(_, value)| !value.is_zero());
    let (keys, values) = terms.map(|(n, value)| (packing.power(main, n as u32), value)).unzip();
    Integral { keys, values }.primitive().0
}

/// `f` with integers for the variables of `point`, dense in `main`.
fn image_at(f: &Integral, packing: &Packing, main: usize, point: &[(usize, i64)]) -> Integers {
    let mut line = Integers::new();
    for (&key, value) in f.keys.iter().zip(&f.values) {
        let place = packing.exponent(key, main) as usize;
        if line.len() <= place {
            line.resize(place + 1, BigInt::zero());
        }
        let powers = point.iter().map(|&(v, x)| BigInt::from(x).pow(packing.exponent(key, v)));
        line[place] += powers.fold(value.clone(), |product, power| product * power);
    }
    line
}

/// A point with coordinates up to about `range` where `f` keeps its degree and stays square-free.
fn choose_anchor(
    f: &Integral,
    packing: &Packing,
    main: usize,
    others: &[usize],
    range: u64,
    random: &mut Random,
    watch: &Watch,
) -> Result<Anchor> {
    let field = Prime::new(primes().next().expect("there are primes below 2^61"));
    let (mut best, mut found, mut tries): (Option<Anchor>, _, _) = (None, 0, 0);
    loop {
        watch.check()?;
        tries += 1;
        let spread = range + tries / 8;
        let point: Vec<i64> = others.iter().map(|_| random.below(2 * spread + 1) as i64 - spread as i64).collect();
        let placed: Vec<(usize, i64)> = others.iter().copied().zip(point.iter().copied()).collect();
        let line = image_at(f, packing, main, &placed);
        let small: Dense = line.iter().map(|c| residue(c, &field)).collect();
        if small.last() == Some(&0) || dense::gcd(&field, &small, &dense::derivative(&field, &small)).len() != 1 {
            continue;
        }
        let factors = integers::factors(&primitive(line), watch)?;
        if best.as_ref().is_none_or(|best| factors.len() < best.factors.len()) {
            best = Some(Anchor { point, factors });
        }
        found += 1;
        if let Some(best) = best.take_if(|best| found == POINTS || best.factors.len() == 1) {
            return Ok(best);
        }
    }
}

fn primitive(line: Integers) -> Integers {
    let keys = (0..line.len() as u128).rev().collect();
    let (part, _) = Integral { keys, values: line.into_iter().rev().collect() }.primitive();
    part.values.into_iter().rev().collect()
}

/// The factors lifted from one point; `None` when it is unlucky.
fn split_at(
    f: &Integral,
    packing: &Packing,
    main: usize,
    others: &[usize],
    anchor: &Anchor,
    random: &mut Random,
    watch: &Watch,
) -> Result<Option<Vec<Integral>>> {
    let mut parts: Option<Vec<Vec<usize>>> = None;
    let mut images: Vec<Images> = Vec::new();
    let enough = 4 * (f.bits() + f.keys.iter().map(|&key| packing.degree(key)).max().unwrap_or(0)) + 64;
    for p in primes() {
        let field = Prime::new(p);
        let image = f.image(&field);
        let point = anchor.point.iter().map(|&x| residue(&BigInt::from(x), &field)).collect();
        let Some(lifting) = Lifting::new(&field, packing, &image, main, others, point) else { continue };
        let lines: Vec<Dense> =
            anchor.factors.iter().map(|line| line.iter().map(|c| residue(c, &field)).collect()).collect();
        if parts.is_none() {
            parts = lifting.partition(&lines, watch)?;
        }
        let Some(parts) = &parts else { continue };
        if parts.len() == 1 {
            return Ok(Some(vec![f.clone()]));
        }
        let product =
            |part: &Vec<usize>| part.iter().fold(vec![1], |product, &i| dense::mul(&field, &product, &lines[i]));
        let starts: Vec<Dense> = parts.iter().map(product).collect();
        let Some(factors) = lifting.factors(&starts, random, watch)? else { return Ok(None) };
        images.resize_with(factors.len(), Images::default);
        images.iter_mut().zip(factors).for_each(|(images, factor)| images.add(&field, factor));
        if let Some(factors) = proved(f, packing, &images) {
            return Ok(Some(factors));
        }
        if images[0].bits() > enough {
            return Ok(None);
        }
    }
    Ok(None)
}

/// The factors that the images stand for, when their product is `f`.
fn proved(f: &Integral, packing: &Packing, images: &[Images]) -> Option<Vec<Integral>> {
    let factors = images.iter().map(Images::rational).collect::<Option<Vec<_>>>()?;
    let rest = factors.iter().try_fold(f.clone(), |rest, factor| rest.quotient(packing, factor))?;
    (rest.is_constant() && rest.values.iter().all(One::is_one)).then_some(factors)
}
