//! The Buchberger engine for users: pair criteria, selection strategies, cofactors, progress and budget.

use super::goal::Goal;
use super::hilbert::HilbertSeries;
use super::pairs::{Head, Pairs, Strategy};
use super::reduced::{Basis, interreduce};
use super::tracked::{Tracked, generator, monic, reduce, s_element, term_count};
use crate::number::Field;
use crate::poly::{Polynomial, PolynomialRing, Width};
use crate::{ErrorKind, Result, Watch};

/// Options of [`basis`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// The selection strategy for pairs.
    pub strategy: Strategy,
    /// Whether to compute the cofactors that express each basis element in the generators: the proof of `G in <F>`.
    pub cofactors: bool,
}

/// Computes the reduced Groebner basis of the ideal of `generators` in the order of `ring`.
///
/// Exponents start in narrow lanes; an overflow restarts the work with wider ones.
///
/// # Errors
/// [`ErrorKind::Overflow`] when a degree overflows even 31 bits; [`ErrorKind::BadValue`] when a nonzero coefficient has
/// no inverse; the error with which `watch` stops the work.
pub fn basis<'w, F: Field>(
    ring: &PolynomialRing<F>,
    generators: &[Polynomial<F::Element>],
    options: &Options,
    watch: impl Into<Option<&'w Watch>>,
) -> Result<Basis<F>> {
    let watch = Watch::or_none(watch);
    basis_towards(ring, generators, options, None, watch)
}

/// Same as [`basis`], but skips the pairs that reduce to zero according to the Hilbert series of a homogeneous ideal.
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
    let elements = interreduce(ring, elements, watch)?;
    let (polynomials, cofactors): (Vec<_>, Vec<_>) =
        elements.into_iter().map(|element| (element.polynomial, element.cofactors)).unzip();
    let cofactors = if options.cofactors { cofactors } else { Vec::new() };
    Ok(Basis { ring: ring.clone(), polynomials, cofactors })
}

/// Buchberger's loop: select a pair, reduce its S-polynomial, update the pairs with the remainder.
///
/// Redundant elements stay among the divisors, because they are older and simpler than the elements that made them
/// redundant. Without them the lexicographic basis of cyclic-5 modulo 32003 takes minutes instead of milliseconds.
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

/// Makes a nonzero remainder monic and adds it to the basis.
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
