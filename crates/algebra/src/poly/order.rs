//! Monomial orders (NAO definitions 12 and 13). Variables are listed from the greatest to the smallest.

use std::cmp::Ordering;
use std::fmt;

/// A monomial order: total, compatible with multiplication, with 1 as the smallest monomial.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum Order {
    /// Lexicographic: the first differing exponent decides (NAO definition 13).
    Lex,
    /// Graded reverse lexicographic: total degree first, then the monomial with the smaller exponent of the smallest
    /// variable is greater.
    GrevLex,
    /// Blocks of consecutive variables, compared from the first block on: an elimination order.
    Block(Vec<Block>),
}

/// One block of a [`Order::Block`]: `size` consecutive variables compared by `graded`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Block {
    /// Number of variables, at least one.
    pub size: usize,
    /// Graded reverse lexicographic inside the block, else lexicographic.
    pub graded: bool,
}

impl Order {
    /// The elimination order of the first `first` of `variables` variables: two graded blocks.
    pub fn elimination(first: usize, variables: usize) -> Order {
        let sizes = [first, variables.saturating_sub(first)];
        let blocks = sizes.into_iter().filter(|&size| size > 0).map(|size| Block { size, graded: true });
        Order::Block(blocks.collect())
    }
}

impl fmt::Display for Order {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Order::Lex => f.write_str("lex"),
            Order::GrevLex => f.write_str("grevlex"),
            Order::Block(blocks) => {
                let name = |b: &Block| format!("{}({})", if b.graded { "grevlex" } else { "lex" }, b.size);
                f.write_str(&blocks.iter().map(name).collect::<Vec<_>>().join(" > "))
            }
        }
    }
}

/// Compares two exponent vectors block by block.
pub(super) fn compare_blocks(blocks: &[Block], a: &[u32], b: &[u32]) -> Ordering {
    let mut start = 0;
    for block in blocks {
        let range = start..start + block.size;
        start += block.size;
        let (x, y) = (&a[range.clone()], &b[range]);
        let ordering = if block.graded { compare_graded(x, y) } else { x.cmp(y) };
        if ordering.is_ne() {
            return ordering;
        }
    }
    Ordering::Equal
}

fn compare_graded(a: &[u32], b: &[u32]) -> Ordering {
    let degree = |e: &[u32]| e.iter().map(|&k| u64::from(k)).sum::<u64>();
    degree(a).cmp(&degree(b)).then_with(|| b.iter().rev().cmp(a.iter().rev()))
}
