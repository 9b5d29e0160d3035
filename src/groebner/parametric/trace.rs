//! A stand-in for the trace of F4: every lane runs the generic engine.

use crate::groebner::{Basis, Options, basis};
use crate::number::Zp;
use crate::poly::{Monomial, Polynomial, PolynomialRing, Term};
use crate::{Result, Watch};

/// What the first computation taught.
#[derive(Clone, Debug)]
pub struct Trace {
    ring: PolynomialRing<Zp>,
    inputs: Vec<Vec<Monomial>>,
    outputs: Vec<Vec<Monomial>>,
}

impl Trace {
    pub fn learn(
        ring: &PolynomialRing<Zp>,
        generators: &[Polynomial<u64>],
        watch: &Watch,
    ) -> Result<(Basis<Zp>, Trace)> {
        let found = basis(ring, generators, &Options::default(), watch)?;
        let support = |f: &Polynomial<u64>| f.terms().iter().map(|t| t.monomial.clone()).collect();
        let inputs = generators.iter().map(support).collect();
        let outputs = found.polynomials.iter().map(support).collect();
        Ok((found, Trace { ring: ring.clone(), inputs, outputs }))
    }

    pub fn replay<const N: usize>(
        &self,
        moduli: [u32; N],
        generators: &[Vec<[u32; N]>],
        watch: &Watch,
    ) -> Result<[Option<Vec<Vec<u32>>>; N]> {
        let mut results = [const { None }; N];
        for lane in 0..N {
            let zp = Zp::new(u64::from(moduli[lane]))?;
            let ring = PolynomialRing::new(zp, self.ring.variables(), self.ring.layout().order().clone())?
                .with_width(self.ring.layout().width());
            let polynomial = |(support, values): (&Vec<Monomial>, &Vec<[u32; N]>)| {
                let terms = support.iter().zip(values);
                ring.collect(terms.map(|(m, v)| Term { coefficient: u64::from(v[lane]), monomial: m.clone() }))
            };
            let generators: Vec<_> = self.inputs.iter().zip(generators).map(polynomial).collect();
            let found = basis(&ring, &generators, &Options::default(), watch)?;
            if found.polynomials.len() != self.outputs.len() {
                continue;
            }
            let row = |(f, support): (&Polynomial<u64>, &Vec<Monomial>)| -> Option<Vec<u32>> {
                f.terms().iter().all(|t| support.contains(&t.monomial)).then_some(())?;
                let coefficient = |m: &Monomial| f.terms().iter().find(|t| t.monomial == *m).map_or(0, |t| t.coefficient as u32);
                Some(support.iter().map(coefficient).collect())
            };
            results[lane] = found.polynomials.iter().zip(&self.outputs).map(row).collect();
        }
        Ok(results)
    }
}
