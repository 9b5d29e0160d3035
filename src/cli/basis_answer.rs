//! From a system of polynomials to its basis, as text: the question, the engine for each field, the answer.

use super::basis_certificate::prove;
use crate::groebner::{Basis, Options, basis};
use crate::number::{Field, Rationals, Zp};
use crate::poly::system::{Format, Heading, PolynomialSystem};
use crate::poly::{Block, Fractions, Order, Polynomial, PolynomialRing};
use crate::{Error, ErrorKind, Result, Watch};

/// The most standard monomials that are counted.
const MAX_DEGREE: usize = 1_000_000;

/// What is asked.
pub struct Question {
    pub system: PolynomialSystem,
    /// The ring to compute in: eliminated variables first.
    pub working: Heading,
    /// The ring of the answer.
    pub target: Heading,
    pub eliminated: Vec<String>,
    pub format: Format,
    pub certificate: bool,
}

/// The basis, printed, and what it says about the ideal.
pub struct Answer {
    /// The basis in the format that was asked for.
    pub text: String,
    /// The proof as JSON, when it was asked for.
    pub certificate: Option<String>,
    heading: Heading,
    /// Exponents of the leading monomials.
    leads: Vec<Vec<u32>>,
    /// Names of a largest set of free variables; none for the unit ideal.
    free: Option<Vec<String>>,
}

/// An engine over the field `F`: the reduced basis, with cofactors when the options ask for them.
type Engine<F> =
    fn(&PolynomialRing<F>, &[Polynomial<<F as crate::number::Ring>::Element>], &Options, &Watch) -> Result<Basis<F>>;

/// Computes with the engine of the system's field.
fn compute(question: &Question, watch: &Watch) -> Result<Answer> {
    let Heading { characteristic, parameters, .. } = &question.working;
    match (*characteristic, parameters.is_empty()) {
        (0, true) => question.over(Rationals, basis, watch),
        (0, false) => question.over(Fractions::new(Rationals, parameters)?, basis, watch),
        (p, true) => question.over(Zp::new(p)?, basis, watch),
        (p, false) => question.over(Fractions::new(Zp::new(p)?, parameters)?, basis, watch),
    }
}

impl Question {
    /// The basis of `system` in `order` (by default its own), without the variables `eliminated`.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] and [`ErrorKind::DuplicateName`] for names to eliminate; [`ErrorKind::BadValue`] when none stays, or the
    /// order does not cover those that stay; [`ErrorKind::Unsupported`] when `format` cannot hold the answer.
    pub fn new(
        system: PolynomialSystem,
        order: Option<Order>,
        eliminated: &[String],
        format: Format,
        certificate: bool,
    ) -> Result<Question> {
        check_eliminated(&system.heading, eliminated)?;
        let kept = system.heading.variables.iter().filter(|name| !eliminated.contains(name));
        let target = Heading { variables: kept.cloned().collect(), ..system.heading.clone() };
        let order = match (order, &system.heading.order) {
            (Some(order), _) => order,
            (None, Order::Block(_)) if !eliminated.is_empty() => Order::GrevLex,
            (None, order) => order.clone(),
        };
        let target = target.with_order(order).map_err(|error| error.with_context("--order"))?;
        let working = working_heading(&target, eliminated);
        target.print(format, &target.ring(Rationals)?, &[])?;
        Ok(Question { system, working, target, eliminated: eliminated.to_vec(), format, certificate })
    }

    /// Computes the basis.
    ///
    /// # Errors
    /// Those of [`PolynomialSystem::expand`] and of the engine; what `watch` stops with.
    pub fn answer(&self, watch: &Watch) -> Result<Answer> {
        compute(self, watch)
    }

    fn over<F: Field>(&self, field: F, engine: Engine<F>, watch: &Watch) -> Result<Answer> {
        let ring = self.working.ring(field)?;
        let generators = self.system.expand(&ring, watch)?;
        let options = Options { cofactors: self.certificate, ..Options::default() };
        let found = engine(&ring, &generators, &options, watch)?;
        let certificate = self.certificate.then(|| prove(self, &ring, &generators, &found, watch)).transpose()?;
        watch.check()?;
        let kept = self.kept(found)?;
        let layout = kept.ring.layout();
        let names = |free: Vec<usize>| free.into_iter().map(|v| self.target.variables[v].clone()).collect();
        Ok(Answer {
            text: self.target.print(self.format, &kept.ring, &kept.polynomials)?,
            certificate,
            heading: self.target.clone(),
            leads: kept.leading_monomials().into_iter().map(|m| layout.exponents(m)).collect(),
            free: kept.independent_variables().map(names),
        })
    }

    /// The elements that are free of the eliminated variables, in the ring of the answer (Cox, Little, O'Shea, theorem 3.1.2).
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

fn check_eliminated(heading: &Heading, eliminated: &[String]) -> Result<()> {
    let fail = |kind, text: String| Err(Error::new(kind, text).with_context("--eliminate"));
    let known = heading.variables.join(", ");
    for (index, name) in eliminated.iter().enumerate() {
        if !heading.variables.contains(name) {
            return fail(ErrorKind::UnknownName, format!("`{name}` is no variable; the variables are {known}"));
        }
        if eliminated[..index].contains(name) {
            return fail(ErrorKind::DuplicateName, format!("`{name}` is named twice; name each variable once"));
        }
    }
    if eliminated.len() == heading.variables.len() {
        return fail(ErrorKind::BadValue, "no variable stays; leave one out".to_owned());
    }
    Ok(())
}

/// The eliminated variables in a graded block of their own, in front of `target`.
fn working_heading(target: &Heading, eliminated: &[String]) -> Heading {
    if eliminated.is_empty() {
        return target.clone();
    }
    let size = target.variables.len();
    let rest = match &target.order {
        Order::GrevLex => vec![Block { size, graded: true }],
        Order::Lex => vec![Block { size, graded: false }],
        Order::Block(blocks) => blocks.clone(),
    };
    let front = Block { size: eliminated.len(), graded: true };
    Heading {
        variables: [eliminated, &target.variables].concat(),
        order: Order::Block([vec![front], rest].concat()),
        ..target.clone()
    }
}

impl Answer {
    /// One line: size, field, order, dimension, degree.
    pub fn summary(&self) -> String {
        let Heading { characteristic, parameters, order, .. } = &self.heading;
        let field = if *characteristic == 0 { "Q".to_owned() } else { format!("GF({characteristic})") };
        let field = if parameters.is_empty() { field } else { format!("{field}({})", parameters.join(", ")) };
        let elements = if self.leads.len() == 1 { "element" } else { "elements" };
        let proved = if self.certificate.is_some() { ", proved" } else { "" };
        format!("{} {elements} over {field}, {order}{proved}; {}", self.leads.len(), self.ideal())
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

/// Counts the exponent vectors of so many `variables` that no lead divides; `false` when there are too many. Some lead is a power of each
/// variable.
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
