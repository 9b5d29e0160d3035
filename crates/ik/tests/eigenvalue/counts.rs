//! The number of real solutions compared with the exact number over Q, by Groebner basis and real-root isolation.

use groebot_algebra::number::BigRational;
use groebot_ik::derive::eigenvalue::all;
use groebot_ik::derive::eigenvalue::survey;
use groebot_ik::solver::eigenvalue::Layout;
use num_traits::ToPrimitive;

use super::solver::{in_doubles, lines_of, target, tip};
use super::{Random, found, rational};
use crate::sixteen::{self, Link};

fn random_links(random: &mut Random) -> [Link<BigRational>; 6] {
    std::array::from_fn(|_| Link {
        length: rational(random.integer(-9, 9), 4),
        offset: rational(random.integer(-9, 9), 4),
        twist: sixteen::turn((random.integer(1, 5), random.integer(1, 5))),
    })
}

/// Compares our number of real solutions with the exact one at random rational targets. Returns how often each number occurs.
fn compare(count: usize, seed: u64) -> [usize; 17] {
    let mut random = Random::new(seed);
    let mut seen = [0; 17];
    for index in 0..count {
        let links = random_links(&mut random);
        let turns: Vec<_> = (0..6).map(|_| sixteen::turn((random.integer(-5, 5), random.integer(1, 5)))).collect();
        let pose = sixteen::chain(&turns, &links);
        let exact = sixteen::solutions(&sixteen::eliminate(&links, &pose));
        let complex = exact[0].representation().polynomial.degree();
        assert_eq!(complex, Some(16), "chain {index} is special");
        let doubles = in_doubles(&links);
        let layout = Layout { lines: lines_of(&doubles), slides: [false; 6], length: 2.0 };
        let solver = layout.chain(&tip(&doubles), &survey(&layout, &all().collect::<Vec<_>>()));
        let pose = pose.map(|row| row.map(|entry| entry.to_f64().unwrap()));
        let answers = found(&solver.solve(&target(&pose)));
        assert_eq!(answers.len(), exact.len(), "chain {index}");
        seen[exact.len()] += 1;
    }
    seen
}

#[test]
fn counts_equal_the_exact_ones() {
    let seen = compare(3, 9);
    assert!(seen.iter().filter(|count| **count > 0).count() > 1, "{seen:?}");
}

/// Run by `cargo test --release two_hundred_counts -- --ignored --nocapture`.
#[test]
#[ignore = "two hundred exact counts"]
fn two_hundred_counts_equal_the_exact_ones() {
    println!("chains by number of real solutions: {:?}", compare(200, 10));
}
