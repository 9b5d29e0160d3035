//! The derivation does not depend on names: systems of the same type with other names, orders and lengths.

use groebot_algebra::number::{BigInt, BigRational, Ring};
use groebot_algebra::poly::parse;
use groebot_ik::derive::System;

use super::seed::derive;

/// A small reproducible generator of numbers.
struct Numbers(u64);

impl Numbers {
    fn below(&mut self, n: usize) -> usize {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((self.0 >> 33) as usize) % n
    }

    fn shuffled<T>(&mut self, mut list: Vec<T>) -> Vec<T> {
        for k in (1..list.len()).rev() {
            list.swap(k, self.below(k + 1));
        }
        list
    }
}

struct Random {
    text: String,
    lengths: [i64; 2],
    names: [String; 4],
    target: [String; 2],
    relative: bool,
}

/// A two-link system: absolute or relative second angle, arbitrary names, arbitrary order of unknowns, equations and joints.
fn random_system(numbers: &mut Numbers) -> Random {
    let letters = ["alpha", "Beta", "u", "v_1", "w", "zz", "k9", "Q", "m2", "theta", "x", "y"];
    let names = numbers.shuffled(letters.to_vec());
    let [c1, s1, c2, s2, px, pz] = std::array::from_fn(|k| names[k].to_owned());
    let lengths = [numbers.below(300) as i64 + 20, numbers.below(300) as i64 + 20];
    let [l1, l2] = lengths;
    let relative = numbers.below(2) == 0;
    let (x, z) = if relative {
        (
            format!("{l1}/10*{s1} + {l2}/10*({s1}*{c2} + {c1}*{s2}) = {px}"),
            format!("{l1}/10*{c1} + {l2}/10*({c1}*{c2} - {s1}*{s2}) = {pz}"),
        )
    } else {
        (format!("{l1}/10*{s1} + {l2}/10*{s2} = {px}"), format!("{l1}/10*{c1} + {l2}/10*{c2} = {pz}"))
    };
    let unknowns = numbers.shuffled(vec![&c1, &s1, &c2, &s2]);
    let order = unknowns.iter().map(|name| format!("{name:?}")).collect::<Vec<_>>().join(", ");
    let equations = numbers.shuffled(vec![x, z]);
    let text = format!(
        "name = \"random\"\norder = [{order}]\nequations = {equations:?}\n\
         [[parameter]]\nname = \"{px}\"\n[[parameter]]\nname = \"{pz}\"\n\
         [[joint]]\nname = \"first\"\ncosine = \"{c1}\"\nsine = \"{s1}\"\n\
         [[joint]]\nname = \"second\"\ncosine = \"{c2}\"\nsine = \"{s2}\"\n"
    );
    Random { text, lengths, names: [c1, s1, c2, s2], target: [px, pz], relative }
}

#[test]
fn twenty_random_systems_are_derived_proved_and_solved() {
    let mut numbers = Numbers(7);
    for _ in 0..20 {
        let random = random_system(&mut numbers);
        let derivation = derive(System::from_toml(&random.text).unwrap_or_else(|e| panic!("{e}\n{}", random.text)));
        let solved = derivation.equations().unwrap().method.requested.solved().unwrap();
        assert_eq!(solved.triangular.bound(), 2, "{}", random.text);
        known_members_vanish(&random, &derivation);
        known_angles_are_found(&random, &derivation, &mut numbers);
    }
}

/// Checks that the law of cosines, derived by hand, is in the ideal: `2 L1 L2 cos(relative angle) = r^2 - L1^2 - L2^2`.
fn known_members_vanish(random: &Random, derivation: &groebot_ik::derive::Derivation) {
    let solved = derivation.equations().unwrap().method.requested.solved().unwrap();
    let ring = &solved.triangular.ring;
    let ([l1, l2], [c1, s1, c2, s2], [px, pz]) = (random.lengths, &random.names, &random.target);
    let cosine = if random.relative { c2.clone() } else { format!("({c1}*{c2} + {s1}*{s2})") };
    let law = format!("2*{l1}*{l2}*{cosine} - 100*{px}^2 - 100*{pz}^2 + {l1}^2 + {l2}^2");
    let law = parse(&law).unwrap().evaluate(ring).unwrap();
    let rest = groebot_algebra::groebner::normal_form(ring, &law, &solved.certified.basis).unwrap();
    assert!(ring.is_zero(&rest), "{}", random.text);
}

fn known_angles_are_found(random: &Random, derivation: &groebot_ik::derive::Derivation, numbers: &mut Numbers) {
    let [l1, l2] = random.lengths.map(|l| l as f64 / 10.0);
    for _ in 0..50 {
        let [q1, q2] = [0, 1].map(|_| (numbers.below(62_000) as f64 - 31_000.0) / 10_000.0);
        let forearm = if random.relative { q1 + q2 } else { q2 };
        let target = [l1 * q1.sin() + l2 * forearm.sin(), l1 * q1.cos() + l2 * forearm.cos()];
        let solutions = derivation.program().solve_numbers(&target).unwrap();
        let near = |a: f64, b: f64| (a - b).sin().abs() < 1e-6 && (a - b).cos() > 0.0;
        let found = solutions.iter().any(|s| near(s.q[0], q1) && near(s.q[1], q2));
        assert!(found, "{q1} {q2} not among {solutions:?}\n{}", random.text);
        assert!(solutions.len() <= 2 && solutions.iter().all(|s| s.residual <= 1e-10), "{solutions:?}");
    }
}

#[test]
fn exact_lengths_stay_exact() {
    let text = "name = \"e\"\n[[parameter]]\nname = \"p\"\n[[joint]]\nname = \"j\"\nunknown = \"d\"\nequations = []\n";
    let text = text.replace("equations = []\n", "") + "[[equation]]\nequation = \"0.1029*d = p\"\n";
    let derivation = derive(System::from_toml(&text).unwrap());
    let solved = derivation.equations().unwrap().method.requested.solved().unwrap();
    let constant = solved.certified.basis[0].terms()[1].coefficient.numerator().terms()[0].coefficient.clone();
    assert_eq!(constant, BigRational::new(BigInt::from(-10_000), BigInt::from(1029)));
}
