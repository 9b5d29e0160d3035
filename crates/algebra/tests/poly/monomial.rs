//! Packed monomials compared with plain exponent vectors, in every width and order; axioms of monomial orders.

use std::cmp::Ordering;

use groebot_algebra::poly::{Block, Layout, Monomial, Order, Width};
use proptest::prelude::*;

const WIDTHS: [Width; 3] = [Width::Bits8, Width::Bits16, Width::Bits32];

/// Two exponent vectors of equal length and an order for them; some exponents reach the limits of lanes.
fn pair_and_order() -> impl Strategy<Value = (Vec<u32>, Vec<u32>, Order)> {
    let exponent = prop_oneof![4 => 0u32..4, 2 => 0u32..90, 1 => 0u32..20_000, 1 => 0u32..1_500_000_000];
    let top = (1usize..12).prop_flat_map(move |count| {
        let vector = prop::collection::vec(exponent.clone(), count);
        (vector.clone(), vector, order(count))
    });
    // Every third pair differs in one exponent only, so that later exponents decide.
    (top, 0..3, any::<prop::sample::Index>()).prop_map(|((a, mut b, order), kind, place)| {
        if kind == 0 {
            let place = place.index(a.len());
            let kept = b[place];
            b.clone_from(&a);
            b[place] = kept;
        }
        (a, b, order)
    })
}

fn order(variables: usize) -> impl Strategy<Value = Order> {
    let blocks = prop::collection::vec((1..=variables, any::<bool>()), 1..4).prop_map(move |sizes| {
        let mut left = variables;
        let mut blocks = Vec::new();
        for (size, graded) in sizes.into_iter().chain([(variables, true)]) {
            let size = size.min(left);
            left -= size;
            blocks.extend((size > 0).then_some(Block { size, graded }));
        }
        Order::Block(blocks)
    });
    prop_oneof![Just(Order::Lex), Just(Order::GrevLex), blocks]
}

/// The order by its definition on exponent vectors.
fn by_definition(order: &Order, a: &[u32], b: &[u32]) -> Ordering {
    let difference: Vec<i64> = a.iter().zip(b).map(|(&x, &y)| i64::from(x) - i64::from(y)).collect();
    let sign = |entry: Option<&i64>| entry.copied().unwrap_or(0).cmp(&0);
    match order {
        Order::Lex => sign(difference.iter().find(|&&d| d != 0)),
        Order::GrevLex => {
            let degree = difference.iter().sum::<i64>().cmp(&0);
            degree.then(sign(difference.iter().rfind(|&&d| d != 0)).reverse())
        }
        Order::Block(blocks) => {
            let mut start = 0;
            let pieces = blocks.iter().map(|block| {
                let range = start..start + block.size;
                start += block.size;
                let inner = if block.graded { Order::GrevLex } else { Order::Lex };
                by_definition(&inner, &a[range.clone()], &b[range])
            });
            pieces.fold(Ordering::Equal, Ordering::then)
        }
    }
}

fn degree(exponents: &[u32]) -> u64 {
    exponents.iter().map(|&e| u64::from(e)).sum()
}

fn merged(a: &[u32], b: &[u32], f: impl Fn(u32, u32) -> u32) -> Vec<u32> {
    a.iter().zip(b).map(|(&x, &y)| f(x, y)).collect()
}

/// The expected result of [`Layout::pack`]: `None` when the degree does not fit.
fn checked_pack(layout: &Layout, exponents: &[u32]) -> Option<Monomial> {
    let packed = layout.pack(exponents);
    assert_eq!(packed.is_some(), degree(exponents) <= u64::from(layout.width().max_degree()));
    if let Some(m) = &packed {
        assert_eq!(layout.exponents(m), exponents);
        assert_eq!(u64::from(layout.degree(m)), degree(exponents));
        assert!(layout.is_packed(m));
    }
    packed
}

fn compare_with_vectors(layout: &Layout, a: &[u32], b: &[u32]) {
    let (Some(x), Some(y)) = (checked_pack(layout, a), checked_pack(layout, b)) else { return };
    assert_eq!(layout.checked_mul(&x, &y), checked_pack(layout, &merged(a, b, |p, q| p + q)), "product");
    assert_eq!(layout.lcm(&x, &y), checked_pack(layout, &merged(a, b, u32::max)), "least common multiple");
    assert_eq!(Some(layout.gcd(&x, &y)), checked_pack(layout, &merged(a, b, u32::min)), "greatest common divisor");
    assert_eq!(layout.coprime(&x, &y), a.iter().zip(b).all(|(p, q)| p.min(q) == &0), "coprime");
    let divides = a.iter().zip(b).all(|(p, q)| p <= q);
    assert_eq!(layout.divides(&x, &y), divides, "divisibility");
    let quotient = if divides { layout.pack(&merged(b, a, |q, p| q - p)) } else { None };
    assert_eq!(layout.checked_div(&y, &x), quotient, "quotient");
    assert_eq!(layout.compare(&x, &y), by_definition(layout.order(), a, b), "order");
    let powers: Vec<usize> = (0..a.len()).filter(|&v| a[v] > 0).collect();
    let pure = if let [v] = powers[..] { Some((v, a[v])) } else { None };
    assert_eq!(layout.pure_power(&x), pure, "pure power");
}

proptest! {
    #![proptest_config(crate::cases(1000))]

    #[test]
    fn packed_monomials_are_exponent_vectors((a, b, order) in pair_and_order()) {
        for width in WIDTHS {
            let layout = Layout::new(a.len(), width, order.clone());
            compare_with_vectors(&layout, &a, &b);
            compare_with_vectors(&layout, &a, &merged(&a, &b, u32::max));
        }
    }

    /// NAO definition 12: 1 is the least monomial, the order is total, and multiplication preserves it.
    #[test]
    fn orders_are_monomial_orders((a, b, order) in pair_and_order(), c in prop::collection::vec(0u32..9, 12)) {
        for width in WIDTHS {
            let layout = Layout::new(a.len(), width, order.clone());
            let (Some(x), Some(y)) = (layout.pack(&a), layout.pack(&b)) else { continue };
            let z = layout.pack(&c[..a.len()]).unwrap();
            prop_assert_eq!(layout.compare(&layout.one(), &x).is_lt(), x != layout.one());
            prop_assert_eq!(layout.compare(&x, &y).is_eq(), a == b);
            prop_assert_eq!(layout.compare(&x, &y), layout.compare(&y, &x).reverse());
            let mut sorted = [x.clone(), y.clone(), z.clone()];
            sorted.sort_by(|a, b| layout.compare(a, b));
            prop_assert!(layout.compare(&sorted[0], &sorted[2]).is_le(), "transitive");
            if let (Some(left), Some(right)) = (layout.checked_mul(&x, &z), layout.checked_mul(&y, &z)) {
                prop_assert_eq!(layout.compare(&left, &right), layout.compare(&x, &y));
            }
        }
    }
}

/// NAO (6.2.1): x1 x2 x3^2 x4^5 <lex x1 x2 x3^3 x4^2, although its degree is larger.
#[test]
fn the_lexicographic_comparison_of_the_seed() {
    for (order, expected) in [(Order::Lex, Ordering::Less), (Order::GrevLex, Ordering::Greater)] {
        for width in WIDTHS {
            let layout = Layout::new(4, width, order.clone());
            let pack = |exponents: [u32; 4]| layout.pack(&exponents).unwrap();
            assert_eq!(layout.compare(&pack([1, 1, 2, 5]), &pack([1, 1, 3, 2])), expected, "{order}");
        }
    }
}

/// NAO definition 13: in b - a, the first coordinate that is not zero is positive.
#[test]
fn lexicographic_order_by_definition_13() {
    let layout = Layout::new(3, Width::Bits8, Order::Lex);
    let ascending = [
        [0, 0, 0],
        [0, 0, 1],
        [0, 0, 99],
        [0, 1, 0],
        [0, 1, 1],
        [0, 90, 0],
        [1, 0, 0],
        [1, 0, 5],
        [1, 2, 0],
        [3, 0, 0],
    ];
    for (i, a) in ascending.iter().enumerate() {
        for (j, b) in ascending.iter().enumerate() {
            let [a, b] = [a, b].map(|e| layout.pack(e).unwrap());
            assert_eq!(layout.compare(&a, &b), i.cmp(&j));
        }
    }
}

/// Cox, Little, O'Shea, Ideals, Varieties, and Algorithms, chapter 2, section 2: examples of grevlex.
#[test]
fn graded_reverse_order_by_the_textbook() {
    let layout = Layout::new(3, Width::Bits16, Order::GrevLex);
    let greater =
        |a: [u32; 3], b: [u32; 3]| layout.compare(&layout.pack(&a).unwrap(), &layout.pack(&b).unwrap()).is_gt();
    assert!(greater([4, 7, 1], [4, 2, 3]));
    assert!(greater([1, 5, 2], [4, 1, 3]));
    assert!(greater([1, 0, 0], [0, 1, 0]) && greater([0, 1, 0], [0, 0, 1]));
}

#[test]
fn widths_end_at_their_limits() {
    for (width, limit) in WIDTHS.into_iter().zip([127, 32_767, 2_147_483_647]) {
        assert_eq!(width.max_degree(), limit);
        let layout = Layout::new(2, width, Order::Lex);
        let top = layout.pack(&[limit - 1, 1]).unwrap();
        assert!(
            layout.pack(&[limit, 1]).is_none() && layout.checked_mul(&top, &layout.pack(&[0, 1]).unwrap()).is_none()
        );
        assert!(layout.lcm(&top, &layout.pack(&[0, 2]).unwrap()).is_none());
        assert!(layout.pack(&[u32::MAX, u32::MAX]).is_none());
    }
    assert_eq!(WIDTHS.map(Width::wider), [Some(Width::Bits16), Some(Width::Bits32), None]);
}

#[test]
fn orders_say_their_names() {
    assert_eq!(Order::Lex.to_string(), "lex");
    assert_eq!(Order::elimination(2, 5).to_string(), "grevlex(2) > grevlex(3)");
    assert_eq!(Order::elimination(3, 3).to_string(), "grevlex(3)");
}
