//! The Buchberger engine that users run: pair criteria, strategies, cofactors, progress and budget.

use super::division::{divide_by, inverse, s_factors};
use super::hilbert::HilbertSeries;
use super::homogeneous::Goal;
use super::pairs::{Head, Pair, Pairs, Strategy};
use super::reduced;
use crate::number::{Field, Ring};
use crate::poly::{Polynomial, PolynomialRing, Width};
use crate::{ErrorKind, Result, Watch};

/// How [`basis`] works.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// Which pair comes next.
    pub strategy: Strategy,
    /// Whether to carry the cofactors that express each basis element in the generators: the proof of `G in <F>`.
    pub cofactors: bool,
}

/// A reduced Groebner basis: monic, sorted by leading monomial from the smallest, unique for ideal and order.
#[derive(Clone, Debug, PartialEq)]
pub struct Basis<F: Field> {
    /// The ring and its order; its lanes are wider than those of the ring asked for when the basis does not fit those.
    pub ring: PolynomialRing<F>,
    /// The basis; empty for the zero ideal, `[1]` for the unit ideal.
    pub polynomials: Vec<Polynomial<F::Element>>,
    /// With [`Options::cofactors`]: `polynomials[i] = sum over j of cofactors[i][j] * generators[j]`, else empty.
    pub cofactors: Vec<Vec<Polynomial<F::Element>>>,
}

/// A polynomial of the running basis with its cofactors (empty when they are not asked for).
#[derive(Clone, Debug)]
pub(super) struct Tracked<E> {
    pub polynomial: Polynomial<E>,
    pub cofactors: Vec<Polynomial<E>>,
}

/// The reduced Groebner basis of the ideal of `generators` in the order of `ring`.
///
/// Exponents start in narrow lanes; an overflow restarts the work with wider ones.
///
/// # Errors
/// [`ErrorKind::Overflow`] when a degree outgrows even 31 bits; [`ErrorKind::BadValue`] when a nonzero coefficient has
/// no inverse; what `watch` stops with.
pub fn basis<F: Field>(
    ring: &PolynomialRing<F>,
    generators: &[Polynomial<F::Element>],
    options: &Options,
    watch: &Watch,
) -> Result<Basis<F>> {
    basis_towards(ring, generators, options, None, watch)
}

/// [`basis`], without the pairs that the Hilbert series of a homogeneous ideal shows to be idle.
pub(super) fn basis_towards<F: Field>(
    ring: &PolynomialRing<F>,
    generators: &[Polynomial<F::Element>],
    options: &Options,
    series: Option<&HilbertSeries>,
    watch: &Watch,
) -> Result<Basis<F>> {
    let mut width = Width::Bits8;
    loop {
        let narrow = ring.with_width(width);
        let moved = generators.iter().map(|f| ring.transfer(f, &narrow)).collect::<Result<Vec<_>>>();
        let attempt = moved.and_then(|moved| basis_in_width(&narrow, &moved, options, series, watch));
        match (attempt, width.wider()) {
            (Err(error), Some(wider)) if error.kind() == ErrorKind::Overflow => width = wider,
            (Ok(basis), _) if width <= ring.layout().width() => return basis.with_width(ring.layout().width()),
            (attempt, _) => return attempt,
        }
    }
}

fn basis_in_width<F: Field>(
    ring: &PolynomialRing<F>,
    generators: &[Polynomial<F::Element>],
    options: &Options,
    series: Option<&HilbertSeries>,
    watch: &Watch,
) -> Result<Basis<F>> {
    let elements = complete(ring, generators, options, series.map(Goal::new), watch)?;
    let elements = reduced::interreduce(ring, elements, watch)?;
    let (polynomials, cofactors): (Vec<_>, Vec<_>) =
        elements.into_iter().map(|element| (element.polynomial, element.cofactors)).unzip();
    let cofactors = if options.cofactors { cofactors } else { Vec::new() };
    Ok(Basis { ring: ring.clone(), polynomials, cofactors })
}

impl<F: Field> Basis<F> {
    /// The same basis with exponent lanes of `width`.
    ///
    /// # Errors
    /// [`ErrorKind::Overflow`] when a degree does not fit.
    pub fn with_width(self, width: Width) -> Result<Self> {
        let ring = self.ring.with_width(width);
        let transfer = |list: &[Polynomial<F::Element>]| -> Result<Vec<_>> {
            list.iter().map(|f| self.ring.transfer(f, &ring)).collect()
        };
        let polynomials = transfer(&self.polynomials)?;
        let cofactors = self.cofactors.iter().map(|row| transfer(row)).collect::<Result<_>>()?;
        Ok(Basis { ring, polynomials, cofactors })
    }

    /// Whether the ideal is the whole ring: the equations have no solution in any extension field.
    pub fn is_unit_ideal(&self) -> bool {
        self.polynomials.iter().any(|f| self.ring.as_constant(f).is_some_and(|c| !self.ring.field().is_zero(&c)))
    }
}

/// Buchberger's loop: select a pair, reduce its S-polynomial, update the pairs with what remains.
///
/// Redundant elements stay among the divisors: they are older and simpler than what made them so. Without them the
/// lexicographic basis of cyclic-5 modulo 32003 takes minutes instead of milliseconds.
fn complete<F: Field>(
    ring: &PolynomialRing<F>,
    generators: &[Polynomial<F::Element>],
    options: &Options,
    mut goal: Option<Goal<'_>>,
    watch: &Watch,
) -> Result<Vec<Tracked<F::Element>>> {
    let mut elements = Vec::new();
    let mut heads = Vec::new();
    let mut pairs = Pairs::new(options.strategy);
    let mut done = 0;
    for (index, f) in generators.iter().enumerate() {
        let sugar = ring.degree(f);
        let element = generator(ring, f, index, generators.len(), options.cofactors);
        let element = reduce(ring, element, &elements, watch)?;
        adjoin(ring, element, sugar, &mut elements, &mut heads, &mut pairs)?;
    }
    while let Some(pair) = pairs.select(ring) {
        watch.check()?;
        if let Some(goal) = &mut goal
            && goal.is_full(ring, &heads, pair.sugar)?
        {
            continue;
        }
        watch.check_terms(elements.iter().map(term_count).sum())?;
        watch.check_memory(
            elements.iter().map(term_count).sum::<usize>() * size_of::<crate::poly::Term<F::Element>>(),
        )?;
        watch.report("Groebner basis", done, pairs.len());
        let element = s_element(ring, &pair, &elements)?;
        let element = reduce(ring, element, &elements, watch)?;
        adjoin(ring, element, pair.sugar, &mut elements, &mut heads, &mut pairs)?;
        done += 1;
    }
    let live = elements.into_iter().zip(heads).filter(|(_, head)| !head.redundant);
    Ok(live.map(|(element, _)| element).collect())
}

fn term_count<E>(element: &Tracked<E>) -> usize {
    let cofactors: usize = element.cofactors.iter().map(|f| f.terms().len()).sum();
    element.polynomial.terms().len() + cofactors
}

/// Generator number `index` with its unit vector of cofactors.
fn generator<F: Field>(
    ring: &PolynomialRing<F>,
    f: &Polynomial<F::Element>,
    index: usize,
    count: usize,
    track: bool,
) -> Tracked<F::Element> {
    let unit = |k: usize| if k == index { ring.one() } else { ring.zero() };
    let cofactors = if track { (0..count).map(unit).collect() } else { Vec::new() };
    Tracked { polynomial: f.clone(), cofactors }
}

/// Makes a nonzero remainder monic and takes it into the basis.
fn adjoin<F: Field>(
    ring: &PolynomialRing<F>,
    element: Tracked<F::Element>,
    sugar: u32,
    elements: &mut Vec<Tracked<F::Element>>,
    heads: &mut Vec<Head>,
    pairs: &mut Pairs,
) -> Result<()> {
    let Some(lead) = element.polynomial.leading() else { return Ok(()) };
    let head =
        Head { monomial: lead.monomial.clone(), sugar: sugar.max(ring.degree(&element.polynomial)), redundant: false };
    pairs.update(ring, heads, head)?;
    elements.push(monic(ring, element)?);
    Ok(())
}

/// The multiple of `element` with leading coefficient one; zero stays zero.
pub(super) fn monic<F: Field>(ring: &PolynomialRing<F>, element: Tracked<F::Element>) -> Result<Tracked<F::Element>> {
    let factor = match element.polynomial.leading() {
        Some(lead) if !ring.field().is_one(&lead.coefficient) => inverse(ring, &lead.coefficient)?,
        _ => return Ok(element),
    };
    Ok(Tracked {
        polynomial: ring.scale(&element.polynomial, &factor),
        cofactors: element.cofactors.iter().map(|f| ring.scale(f, &factor)).collect(),
    })
}

/// The S-polynomial of a pair with its cofactors.
fn s_element<F: Field>(
    ring: &PolynomialRing<F>,
    pair: &Pair,
    elements: &[Tracked<F::Element>],
) -> Result<Tracked<F::Element>> {
    let (a, b) = (&elements[pair.left], &elements[pair.right]);
    let (left, right) = s_factors(ring, &a.polynomial, &b.polynomial)?.expect("basis elements are not zero");
    let combine = |f: &Polynomial<F::Element>, g: &Polynomial<F::Element>| {
        let first = ring.mul_term(f, &left.coefficient, &left.monomial)?;
        ring.sub_mul_term(&first, &right.coefficient, &right.monomial, g)
    };
    let cofactors = a.cofactors.iter().zip(&b.cofactors).map(|(f, g)| combine(f, g)).collect::<Result<_>>()?;
    Ok(Tracked { polynomial: combine(&a.polynomial, &b.polynomial)?, cofactors })
}

/// The normal form of `element` by `divisors`, cofactors carried along.
pub(super) fn reduce<F: Field>(
    ring: &PolynomialRing<F>,
    element: Tracked<F::Element>,
    divisors: &[Tracked<F::Element>],
    watch: &Watch,
) -> Result<Tracked<F::Element>> {
    let polynomials: Vec<_> = divisors.iter().map(|divisor| &divisor.polynomial).collect();
    let division = divide_by(ring, element.polynomial, &polynomials, watch)?;
    let mut cofactors = element.cofactors;
    if !division.remainder.is_zero() {
        for (quotient, divisor) in division.quotients.iter().zip(divisors).filter(|(q, _)| !q.is_zero()) {
            for (cofactor, part) in cofactors.iter_mut().zip(&divisor.cofactors) {
                *cofactor = ring.sub(cofactor, &ring.checked_mul(quotient, part)?);
            }
        }
    }
    Ok(Tracked { polynomial: division.remainder, cofactors })
}

/// Whether the leading monomial of `a` divides that of `b`.
pub(super) fn leads_divide<F: Field>(
    ring: &PolynomialRing<F>,
    a: &Polynomial<F::Element>,
    b: &Polynomial<F::Element>,
) -> bool {
    let leads = a.leading().zip(b.leading());
    leads.is_some_and(|(a, b)| ring.layout().divides(&a.monomial, &b.monomial))
}
