//! Multiplication by the variables in the quotient ring, on rows of residues.

use std::borrow::Cow;

use super::kernel::{Modulus, Sums, padded};
use crate::groebner::division::inverse;
use crate::groebner::fglm::staircase::{Origin, Product, Staircase};
use crate::groebner::{Basis, normal_form};
use crate::number::{Ring, Zp};
use crate::poly::{Polynomial, PolynomialRing, Term};
use crate::{Result, Watch};

/// The normal forms of the border monomials, computed on demand.
#[derive(Clone, Debug)]
pub(super) struct Table {
    pub modulus: Modulus,
    pub ring: PolynomialRing<Zp>,
    stairs: Staircase,
    /// The row of each border monomial, once it is computed.
    places: Vec<Option<usize>>,
    rows: Vec<u32>,
}

impl Table {
    pub fn new(basis: &Basis<Zp>, modulus: Modulus) -> Result<Self> {
        basis.require_zero_dimensional()?;
        let stairs = Staircase::new(basis)?;
        let descending = descending(basis, &stairs);
        let mut table = Table {
            modulus,
            ring: basis.ring.clone(),
            places: vec![None; stairs.border.len()],
            rows: Vec::new(),
            stairs,
        };
        for border in 0..table.places.len() {
            if let Origin::Lead(index) = table.stairs.origins[border] {
                table.store(border, &table.lead_row(basis, index, &descending)?);
            }
        }
        Ok(table)
    }

    fn store(&mut self, border: usize, row: &[u32]) {
        self.places[border] = Some(self.rows.len() / self.stride());
        self.rows.extend(row);
    }

    /// The normal form of the leading monomial of a basis polynomial: its negated tail, if the basis is reduced.
    fn lead_row(&self, basis: &Basis<Zp>, index: usize, descending: &[usize]) -> Result<Vec<u32>> {
        let (ring, f) = (&basis.ring, &basis.polynomials[index]);
        let factor = ring.field().neg(&inverse(ring, &f.terms()[0].coefficient)?);
        if let Some(row) = self.coordinates(&f.terms()[1..], factor, descending) {
            return Ok(row);
        }
        let tail = ring.sub(f, &ring.collect(f.terms()[..1].iter().cloned()));
        let tail = normal_form(ring, &tail, &basis.polynomials)?;
        Ok(self.coordinates(tail.terms(), factor, descending).expect("a normal form has standard monomials"))
    }

    /// The combination of `terms`, multiplied by `factor`; `None` when some monomial is not standard.
    fn coordinates(&self, terms: &[Term<u64>], factor: u64, descending: &[usize]) -> Option<Vec<u32>> {
        let mut row = vec![0; self.stride()];
        let mut indices = descending.iter();
        for term in terms {
            let index = *indices.find(|&&index| self.stairs.standard[index] == term.monomial)?;
            row[index] = self.modulus.residue(term.coefficient * factor);
        }
        Some(row)
    }

    /// The dimension of the quotient ring.
    pub fn dimension(&self) -> usize {
        self.stairs.standard.len()
    }

    /// The length of a row.
    pub fn stride(&self) -> usize {
        padded(self.dimension())
    }

    pub fn one(&self) -> Vec<u32> {
        let mut one = vec![0; self.stride()];
        one[0] = 1;
        one
    }

    fn row(&self, place: usize) -> &[u32] {
        &self.rows[place * self.stride()..][..self.stride()]
    }

    /// Computes the multiplication by `variable`.
    pub fn learn(&mut self, variable: usize, watch: &Watch) -> Result<()> {
        for index in 0..self.dimension() {
            self.learn_product(variable, index, watch)?;
        }
        Ok(())
    }

    /// Computes `variable` times one standard monomial.
    pub fn learn_product(&mut self, variable: usize, index: usize, watch: &Watch) -> Result<()> {
        match self.stairs.products[variable][index] {
            Product::Border(border) => self.resolve(border, watch),
            Product::Standard(_) => Ok(()),
        }
    }

    /// Computes one border monomial, after all smaller ones that its normal form needs.
    fn resolve(&mut self, border: usize, watch: &Watch) -> Result<()> {
        let mut open = vec![border];
        while let Some(&border) = open.last() {
            if self.places[border].is_some() {
                open.pop();
                continue;
            }
            let before = open.len();
            let Origin::Multiple(variable, smaller) = self.stairs.origins[border] else {
                unreachable!("the rows of leading monomials are there from the start")
            };
            watch.check()?;
            self.unknown_needs(variable, smaller, &mut open);
            if open.len() == before {
                let place = self.places[smaller].expect("known by now");
                let row = self.matrix(variable).apply(self.row(place));
                self.store(border, &row);
            }
        }
        Ok(())
    }

    /// Pushes to `open` the border monomials that are needed for `variable` times the border monomial `smaller`.
    fn unknown_needs(&self, variable: usize, smaller: usize, open: &mut Vec<usize>) {
        let Some(place) = self.places[smaller] else { return open.push(smaller) };
        let products = self.row(place).iter().zip(&self.stairs.products[variable]);
        open.extend(products.filter(|(entry, _)| **entry != 0).filter_map(|(_, product)| match *product {
            Product::Border(border) if self.places[border].is_none() => Some(border),
            _ => None,
        }));
    }

    /// The known part of the multiplication by `variable`.
    pub fn matrix(&self, variable: usize) -> Matrix<'_> {
        let place = |product: &Product| match *product {
            Product::Border(border) => self.places[border].map_or(Column::Unknown, Column::Row),
            Product::Standard(index) => Column::Unit(index),
        };
        let columns = self.stairs.products[variable].iter().map(place).collect();
        Matrix { modulus: self.modulus, columns, rows: Cow::Borrowed(&self.rows), stride: self.stride() }
    }

    /// The multiplication by `f`. All variables must be computed.
    pub fn multiplication(&self, f: &Polynomial<u64>, watch: &Watch) -> Result<Matrix<'_>> {
        let matrices: Vec<Matrix<'_>> = (0..self.ring.variables().len()).map(|v| self.matrix(v)).collect();
        if let [term] = f.terms()
            && term.coefficient == 1
            && let Some((variable, 1)) = self.ring.layout().pure_power(&term.monomial)
        {
            return Ok(self.matrix(variable));
        }
        let mut rows = vec![self.image(f, &matrices, watch)?];
        for (_, variable, factor) in self.stairs.descents() {
            watch.check()?;
            rows.push(matrices[variable].apply(&rows[factor]));
        }
        let columns = (0..self.dimension()).map(Column::Row).collect();
        Ok(Matrix { modulus: self.modulus, columns, rows: Cow::Owned(rows.concat()), stride: self.stride() })
    }

    /// The normal form of `f`, term by term.
    fn image(&self, f: &Polynomial<u64>, matrices: &[Matrix<'_>], watch: &Watch) -> Result<Vec<u32>> {
        let mut image = vec![0; self.stride()];
        for term in f.terms() {
            let mut power = self.one();
            for (variable, matrix) in matrices.iter().enumerate() {
                for _ in 0..self.ring.layout().exponent(&term.monomial, variable) {
                    watch.check()?;
                    power = matrix.apply(&power);
                }
            }
            let factor = self.modulus.residue(term.coefficient);
            image.iter_mut().zip(&power).for_each(|(sum, &entry)| *sum = self.modulus.add_mul(*sum, factor, entry));
        }
        Ok(image)
    }
}

/// The standard monomials' indices, the greatest monomial first.
fn descending(basis: &Basis<Zp>, stairs: &Staircase) -> Vec<usize> {
    let layout = basis.ring.layout();
    let mut descending: Vec<usize> = (0..stairs.standard.len()).collect();
    descending.sort_by(|&a, &b| layout.compare(&stairs.standard[b], &stairs.standard[a]));
    descending
}

/// One column of a multiplication matrix.
#[derive(Clone, Copy, Debug)]
enum Column {
    /// A unit vector.
    Unit(usize),
    /// This row of the store.
    Row(usize),
    /// Not computed.
    Unknown,
}

/// A multiplication matrix: unit columns as indices, the others as padded rows.
#[derive(Clone, Debug)]
pub(super) struct Matrix<'a> {
    modulus: Modulus,
    columns: Vec<Column>,
    rows: Cow<'a, [u32]>,
    stride: usize,
}

impl Matrix<'_> {
    pub fn dimension(&self) -> usize {
        self.columns.len()
    }

    fn row(&self, place: usize) -> &[u32] {
        &self.rows[place * self.stride..][..self.stride]
    }

    /// The matrix times `vector`, whose entries at unknown columns are zero.
    pub fn apply(&self, vector: &[u32]) -> Vec<u32> {
        let mut sums = Sums::new(self.modulus, self.stride);
        let terms = vector.iter().zip(&self.columns).filter(|(entry, _)| **entry != 0);
        sums.add(terms.clone().filter_map(|(&entry, column)| match *column {
            Column::Row(place) => Some((entry, self.row(place))),
            Column::Unit(_) | Column::Unknown => None,
        }));
        for (&entry, column) in terms {
            if let Column::Unit(index) = *column {
                sums.lo[index] += u64::from(entry);
            }
        }
        sums.residues()
    }

    /// The row vector `functional` times the matrix. All columns are known.
    pub fn apply_left(&self, functional: &[u32]) -> Vec<u32> {
        let mut result: Vec<u32> = self.columns.iter().map(|column| self.value(functional, *column)).collect();
        result.resize(self.stride, 0);
        result
    }

    /// The value of `functional` at the image of one, which is the element that the matrix multiplies by.
    pub fn value_at_one(&self, functional: &[u32]) -> u32 {
        self.value(functional, self.columns[0])
    }

    fn value(&self, functional: &[u32], column: Column) -> u32 {
        match column {
            Column::Unit(index) => functional[index],
            Column::Row(place) => self.modulus.dot(functional, self.row(place)),
            Column::Unknown => 0,
        }
    }
}
