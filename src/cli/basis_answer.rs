//! Computes the basis for a question, by the engine for its field, and prints it as text.

use std::fmt;

use serde_json::{Value, json};

use super::basis_certificate::prove;
use super::basis_question::Question;
use super::json::FORMAT;
use crate::{Result, Watch};
use groebot_algebra::groebner::f4::MODULUS_LIMIT;
use groebot_algebra::groebner::modular::{self, Status};
use groebot_algebra::groebner::{Basis, Options, Settings, basis, basis_modulo_prime, f4_with, parametric};
use groebot_algebra::number::{BigRational, Field, Rationals, Ring, Style, Zp};
use groebot_algebra::poly::system::Heading;
use groebot_algebra::poly::{Fraction, Fractions, Polynomial, PolynomialRing};

/// The greatest number of standard monomials that are counted.
const MAX_DEGREE: usize = 1_000_000;

/// The basis as text, with properties of the ideal.
pub struct Answer {
    /// The basis in the requested format.
    pub text: String,
    /// The proof as JSON, if requested.
    pub certificate: Option<String>,
    verdict: Verdict,
    heading: Heading,
    /// The elements of the basis as text.
    elements: Vec<String>,
    /// Exponents of the leading monomials.
    leads: Vec<Vec<u32>>,
    /// Names of a maximal set of free variables; none for the unit ideal.
    free: Option<Vec<String>>,
}

/// The certainty of a basis.
#[derive(Clone, Copy)]
enum Verdict {
    /// Proved by cofactors, which were multiplied out.
    Proved,
    /// Every step was exact.
    Exact,
    /// Confirmed modulo a prime that was not used to compute it.
    Probable,
    /// F4: complete except with a probability below 2^-50 for each block of rows. `--prove` excludes that.
    BeyondChance,
}

/// The result of an engine.
type Found<F> = Result<(Basis<F>, Verdict)>;

/// Requirements on an engine in addition to the reduced basis.
#[derive(Clone, Copy)]
struct Rigour {
    /// The cofactors that express the basis in the generators.
    cofactors: bool,
    /// A proof, or exact steps alone.
    prove: bool,
}

/// An engine over the field `F`.
type Engine<F> =
    fn(&PolynomialRing<F>, &[Polynomial<<F as groebot_algebra::number::Ring>::Element>], Rigour, &Watch) -> Found<F>;

/// Computes with the engine of the system's field.
fn compute(question: &Question, watch: &Watch) -> Result<Answer> {
    let Heading { characteristic, parameters, .. } = &question.working;
    match (*characteristic, parameters.is_empty()) {
        (0, true) => question.over(Rationals, over_the_rationals, watch),
        (0, false) => question.over(Fractions::new(Rationals, parameters)?, with_parameters, watch),
        (p, true) => question.over(Zp::new(p)?, modulo_a_prime, watch),
        (p, false) => question.over(Fractions::new(Zp::new(p)?, parameters)?, by_buchberger, watch),
    }
}

fn by_buchberger<F: Field>(
    ring: &PolynomialRing<F>,
    generators: &[Polynomial<F::Element>],
    rigour: Rigour,
    watch: &Watch,
) -> Found<F> {
    let options = Options { cofactors: rigour.cofactors, ..Options::default() };
    Ok((basis(ring, generators, &options, watch)?, Verdict::Exact))
}

fn modulo_a_prime(
    ring: &PolynomialRing<Zp>,
    generators: &[Polynomial<u64>],
    rigour: Rigour,
    watch: &Watch,
) -> Found<Zp> {
    if rigour.cofactors || (rigour.prove && ring.field().modulus() >= MODULUS_LIMIT) {
        return by_buchberger(ring, generators, rigour, watch);
    }
    if rigour.prove {
        let row_by_row = Settings { combinations: false, ..Settings::default() };
        return Ok((f4_with(ring, generators, row_by_row, watch)?, Verdict::Exact));
    }
    Ok((basis_modulo_prime(ring, generators, watch)?, Verdict::BeyondChance))
}

fn over_the_rationals(
    ring: &PolynomialRing<Rationals>,
    generators: &[Polynomial<BigRational>],
    rigour: Rigour,
    watch: &Watch,
) -> Found<Rationals> {
    let options = Options { cofactors: rigour.cofactors, ..Options::default() };
    let mut found = modular::basis(ring, generators, &options, watch)?;
    if rigour.prove && found.status == Status::Probable {
        found.status = modular::prove(&found, ring, generators, watch)?;
    }
    let verdict = if found.status == Status::Proved { Verdict::Proved } else { Verdict::Probable };
    Ok((found.basis, verdict))
}

fn with_parameters(
    ring: &PolynomialRing<Fractions<Rationals>>,
    generators: &[Polynomial<Fraction<BigRational>>],
    rigour: Rigour,
    watch: &Watch,
) -> Found<Fractions<Rationals>> {
    if rigour.cofactors || rigour.prove {
        return by_buchberger(ring, generators, rigour, watch);
    }
    let found = parametric::basis(ring, generators, &parametric::Options::default(), watch)?;
    Ok((found.basis, if found.exact { Verdict::Exact } else { Verdict::Probable }))
}

impl Verdict {
    /// Its name in JSON.
    fn name(self) -> &'static str {
        match self {
            Verdict::Proved => "proved",
            Verdict::Exact => "exact",
            Verdict::Probable => "probable",
            Verdict::BeyondChance => "probabilistic_f4",
        }
    }
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Verdict::Proved => "proved",
            Verdict::Exact => "exact",
            Verdict::Probable => "probable: agrees with a further prime (--prove proves it)",
            Verdict::BeyondChance => {
                "complete except with a probability below 2^-50 per block of rows (--prove excludes that)"
            }
        })
    }
}

impl Question {
    /// Computes the basis.
    ///
    /// # Errors
    /// Those of [`PolynomialSystem::expand`](groebot_algebra::poly::system::PolynomialSystem::expand) and of the engine; the error with which `watch` stops the
    /// work.
    pub fn answer(&self, watch: &Watch) -> Result<Answer> {
        compute(self, watch)
    }

    fn over<F: Field>(&self, field: F, engine: Engine<F>, watch: &Watch) -> Result<Answer> {
        let ring = self.working.ring(field)?;
        let generators = self.system.expand(&ring, watch)?;
        let rigour = Rigour { cofactors: self.certificate, prove: self.prove };
        let (found, verdict) = engine(&ring, &generators, rigour, watch)?;
        let certificate = self.certificate.then(|| prove(self, &ring, &generators, &found, watch)).transpose()?;
        watch.check()?;
        let kept = self.kept(found)?;
        let layout = kept.ring.layout();
        let names = |free: Vec<usize>| free.into_iter().map(|v| self.target.variables[v].clone()).collect();
        Ok(Answer {
            text: self.target.print(self.format, &kept.ring, &kept.polynomials)?,
            verdict: if certificate.is_some() { Verdict::Proved } else { verdict },
            certificate,
            heading: self.target.clone(),
            elements: kept.polynomials.iter().map(|f| kept.ring.format(f, Style::Text)).collect(),
            leads: kept.leading_monomials().into_iter().map(|m| layout.exponents(m)).collect(),
            free: kept.independent_variables().map(names),
        })
    }

    /// The elements without eliminated variables, in the ring of the answer (Cox, Little, O'Shea, theorem 3.1.2).
    fn kept<F: Field>(&self, found: Basis<F>) -> Result<Basis<F>> {
        if self.eliminated.is_empty() {
            return Ok(found);
        }
        let target = self.target.ring(found.ring.field().clone())?.with_width(found.ring.layout().width());
        let is_free = |f: &&Polynomial<F::Element>| (0..self.eliminated.len()).all(|v| found.ring.degree_in(f, v) == 0);
        let polynomials = found.polynomials.iter().filter(is_free).map(|f| found.ring.transfer(f, &target));
        Ok(Basis { polynomials: polynomials.collect::<Result<_>>()?, ring: target, cofactors: Vec::new() })
    }
}

impl Answer {
    /// One line: size, field, order, dimension, degree.
    pub fn summary(&self) -> String {
        let Heading { characteristic, parameters, order, .. } = &self.heading;
        let field = if *characteristic == 0 { "Q".to_owned() } else { format!("GF({characteristic})") };
        let field = if parameters.is_empty() { field } else { format!("{field}({})", parameters.join(", ")) };
        let elements = if self.leads.len() == 1 { "element" } else { "elements" };
        format!("{} {elements} over {field}, {order}; {}; {}", self.leads.len(), self.ideal(), self.verdict)
    }

    /// The basis with properties of the ideal, as JSON. The ideal {1} has no dimension, and only an ideal of dimension 0
    /// has a degree; above [`MAX_DEGREE`] it is not counted.
    pub fn json(&self) -> Value {
        let Heading { characteristic, parameters, variables, order, .. } = &self.heading;
        let degree = self.free.as_ref().filter(|free| free.is_empty()).and_then(|_| self.degree());
        json!({
            "format": FORMAT,
            "characteristic": characteristic,
            "parameters": parameters,
            "variables": variables,
            "order": order.to_string(),
            "basis": self.elements,
            "leading_exponents": self.leads,
            "dimension": self.free.as_ref().map(Vec::len),
            "free_variables": self.free,
            "degree": degree,
            "status": self.verdict.name(),
        })
    }

    fn ideal(&self) -> String {
        match &self.free {
            None => "no solution: the ideal is {1}".to_owned(),
            Some(free) if free.is_empty() => match self.degree() {
                Some(degree) => format!("dimension 0, degree {degree}"),
                None => format!("dimension 0, degree over {MAX_DEGREE}"),
            },
            Some(free) => format!("dimension {}, free: {}", free.len(), free.join(", ")),
        }
    }

    /// The number of standard monomials; `None` when there are more than [`MAX_DEGREE`].
    fn degree(&self) -> Option<usize> {
        let leads: Vec<&[u32]> = self.leads.iter().map(Vec::as_slice).collect();
        let mut count = 0;
        let counted = count_standard(&leads, self.heading.variables.len(), &mut count);
        counted.then_some(count)
    }
}

/// Counts the exponent vectors in `variables` variables that no leading monomial divides; `false` when there are too
/// many. Each variable must have a power among the leading monomials.
fn count_standard(leads: &[&[u32]], variables: usize, count: &mut usize) -> bool {
    if leads.iter().any(|lead| lead.iter().all(|&exponent| exponent == 0)) {
        return true;
    }
    if variables == 0 {
        *count += 1;
        return *count <= MAX_DEGREE;
    }
    let powers = leads.iter().filter(|lead| lead[1..].iter().all(|&exponent| exponent == 0));
    let end = powers.map(|lead| lead[0]).min().unwrap_or(0);
    (0..end).all(|power| {
        let rest: Vec<&[u32]> = leads.iter().filter(|lead| lead[0] <= power).map(|lead| &lead[1..]).collect();
        count_standard(&rest, variables - 1, count)
    })
}
