//! The checker refuses every kind of forged claim and reports the location.

use groebot_algebra::groebner::verify::{Claim, Proof, verify};
use groebot_algebra::groebner::{Options, basis};
use groebot_algebra::number::{BigInt, Field, Rationals, Ring, Zp};
use groebot_algebra::poly::{Order, Polynomial, PolynomialRing, Width};
use groebot_algebra::{ErrorKind, Watch};

use crate::corpus::{read, read_all};

/// A claim that owns its parts, for forging.
#[derive(Clone)]
struct Owned<F: Field> {
    ring: PolynomialRing<F>,
    generators: Vec<Polynomial<F::Element>>,
    basis: Vec<Polynomial<F::Element>>,
    cofactors: Vec<Vec<Polynomial<F::Element>>>,
}

impl<F: Field> Owned<F> {
    /// Equations of three circles: a basis of several elements in `x`, `y`, `z`.
    fn honest(field: F) -> Self {
        let ring = PolynomialRing::new(field, &["x", "y", "z"], Order::GrevLex).unwrap();
        let texts = ["x^2 + y^2 - 1", "x*y - z", "y*z + 2*x - 3"].map(str::to_owned);
        let generators = read_all(&ring, &texts);
        let found =
            basis(&ring, &generators, &Options { cofactors: true, ..Options::default() }, &Watch::none()).unwrap();
        Owned { ring, generators, basis: found.polynomials, cofactors: found.cofactors }
    }

    fn verify(&self) -> groebot_algebra::Result<Proof> {
        let claim = Claim { generators: &self.generators, basis: &self.basis, cofactors: &self.cofactors };
        verify(&self.ring, &claim, &Watch::none())
    }

    /// Refused as a certificate, with `place` in the message.
    fn refused(&self, place: &str) {
        let error = self.verify().expect_err(place);
        assert_eq!(error.kind(), ErrorKind::Certificate);
        assert!(error.message().contains(place), "`{error}` does not say `{place}`");
    }

    fn forged(&self, forge: impl FnOnce(&mut Self)) -> Self {
        let mut copy = self.clone();
        forge(&mut copy);
        copy
    }

    /// Adds `factor` times element `from` to element `to`, with the cofactors that belong to it.
    fn combine(&mut self, to: usize, from: usize, factor: &str) {
        let factor = read(&self.ring, factor);
        let ring = &self.ring;
        let add = |a: &Polynomial<F::Element>, b| ring.add(a, &ring.mul(&factor, b));
        let element = add(&self.basis[to], &self.basis[from]);
        let row = self.cofactors[to].iter().zip(&self.cofactors[from]).map(|(a, b)| add(a, b)).collect();
        (self.basis[to], self.cofactors[to]) = (element, row);
    }
}

fn forge_cofactors<F: Field>(honest: &Owned<F>) {
    for row in 0..honest.basis.len() {
        let place = format!("the cofactors of basis element {} is not", row + 1);
        for column in 0..honest.generators.len() {
            let plus_one = |claim: &mut Owned<F>| {
                claim.cofactors[row][column] = claim.ring.add(&claim.cofactors[row][column], &claim.ring.one());
            };
            honest.forged(plus_one).refused(&place);
        }
        let other = (row + 1) % honest.basis.len();
        let first = row.min(other) + 1;
        let place = format!("cofactors of basis element {first} is not");
        honest.forged(|claim| claim.cofactors.swap(row, other)).refused(&place);
        let short = format!("element {} has 2 cofactors for 3 generators", row + 1);
        honest.forged(|claim| drop(claim.cofactors[row].pop())).refused(&short);
    }
    let rows = format!("{} rows of cofactors", honest.basis.len() - 1);
    honest.forged(|claim| drop(claim.cofactors.pop())).refused(&rows);
}

fn forge_basis<F: Field>(honest: &Owned<F>) {
    let count = honest.basis.len();
    for k in 0..count {
        let missing = honest.forged(|claim| {
            claim.basis.remove(k);
            claim.cofactors.remove(k);
        });
        missing.refused("does not reduce to zero");
        let doubled = honest.forged(|claim| claim.combine(k, k, "1"));
        doubled.refused(&format!("basis element {} is not monic", k + 1));
        let zero = honest.forged(|claim| claim.basis[k] = claim.ring.zero());
        zero.refused(&format!("basis element {} is zero", k + 1));
        let extra = honest.forged(|claim| {
            claim.basis.push(claim.ring.zero());
            claim.cofactors.push(vec![claim.ring.zero(); 3]);
            claim.combine(count, k, "x");
        });
        extra.refused(&format!("basis element {} is not reduced by element", count + 1));
        let foreign = honest.forged(|claim| {
            claim.basis.push(claim.ring.one());
            claim.cofactors.push(vec![claim.ring.zero(); 3]);
        });
        foreign.refused(&format!("basis element 1 is not reduced by element {}", count + 1));
    }
    let tail = honest.forged(|claim| claim.combine(count - 1, 0, "1"));
    tail.refused(&format!("basis element {count} is not reduced by element 1"));
    let wide = honest.forged(|claim| {
        let wide = claim.ring.with_width(Width::Bits32);
        claim.basis[1] = claim.ring.transfer(&claim.basis[1], &wide).unwrap();
    });
    wide.refused("basis: element 2 is not a polynomial of this ring");
}

fn forge_generators<F: Field>(honest: &Owned<F>) {
    for j in 0..3 {
        let rows = (0..honest.basis.len()).find(|&i| !honest.cofactors[i][j].is_zero());
        let place = format!("the cofactors of basis element {} is not", rows.expect("each generator is used") + 1);
        let shifted =
            |claim: &mut Owned<F>| claim.generators[j] = claim.ring.add(&claim.generators[j], &claim.ring.one());
        honest.forged(shifted).refused(&place);
    }
    let added = honest.forged(|claim| {
        claim.generators.push(claim.ring.variable(2));
        claim.cofactors.iter_mut().for_each(|row| row.push(claim.ring.zero()));
    });
    added.refused("generator 4 does not reduce to zero");
}

fn every_forgery_is_refused<F: Field>(field: F) {
    let honest = Owned::honest(field);
    let count = honest.basis.len();
    assert!(count >= 4, "enough to forge");
    let proof = honest.verify().unwrap();
    assert_eq!([proof.cofactor_rows, proof.generators, proof.pairs], [count, 3, count * (count - 1) / 2]);
    forge_cofactors(&honest);
    forge_basis(&honest);
    forge_generators(&honest);
}

#[test]
fn every_forgery_is_refused_over_every_field() {
    every_forgery_is_refused(Rationals);
    every_forgery_is_refused(Zp::new(32003).unwrap());
    every_forgery_is_refused(groebot_algebra::poly::Fractions::new(Rationals, &["p"]).unwrap());
}

/// Generators that are monic and reduced but not a basis. Only the S-pair detects it.
#[test]
fn generators_that_are_no_basis_fail_at_their_pair() {
    let ring = PolynomialRing::new(Rationals, &["x", "y"], Order::Lex).unwrap();
    let generators = read_all(&ring, &["y^3 - 1", "x*y - 2", "x^2 - y"].map(str::to_owned));
    let unit = |row: usize| (0..3).map(|k| ring.from_integer(&BigInt::from(u8::from(k == row)))).collect();
    let cofactors: Vec<Vec<_>> = (0..3).map(unit).collect();
    let claim = Owned { ring: ring.clone(), basis: generators.clone(), generators, cofactors };
    claim.refused("the S-pair of basis elements 1 and 2 does not reduce to zero");
}

#[test]
fn the_zero_and_the_unit_ideal_are_proved() {
    let ring = PolynomialRing::new(Rationals, &["x"], Order::Lex).unwrap();
    let options = Options { cofactors: true, ..Options::default() };
    for (texts, size) in [(vec!["0"], 0), (vec!["x", "x - 1"], 1), (vec![], 0), (vec!["7"], 1)] {
        let generators: Vec<_> = texts.iter().map(|text| read(&ring, text)).collect();
        let found = basis(&ring, &generators, &options, &Watch::none()).unwrap();
        let claim = Claim { generators: &generators, basis: &found.polynomials, cofactors: &found.cofactors };
        assert_eq!(verify(&ring, &claim, &Watch::none()).unwrap().cofactor_rows, size, "{texts:?}");
    }
}
