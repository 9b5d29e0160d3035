//! The source's own bases: NAO (6.7.16)-(6.7.19) and (6.7.5)-(6.7.8), coefficient by coefficient.
//!
//! Expected polynomials are typed from the printed document. Where it prints rounded constants, this file has the exact ones; `printed_constants_are_rounded`
//! compares them with the printed ones (docs/errata.md).

use std::path::Path;

use groebot_algebra::number::{BigRational, Ring, Style, parse_rational};
use groebot_algebra::poly::{PolynomialRing, parse};
use groebot_ik::derive::equations::setting::Poly;
use groebot_ik::derive::{Derivation, Source, System};
use groebot_ik::{Watch, derive::equations::setting::Unknowns};

const LEG: [&str; 4] = [
    // (6.7.16) with its exact constant: 346226.3281 instead of the printed 346226.3
    "40000*(px^2 + pz^2)*s3^2 - 400*(px^3 + px*pz^2)*s3 + 235364*px*s3 + 346226.3281 - 1176.82*px^2 - 41176.82*pz^2
        + px^4 + 2*px^2*pz^2 + pz^4",
    // (6.7.17)
    "200*(px^2 + pz^2)*s3 + 20580*pz*s4 + 588.41*px - px^3 - px*pz^2",
    // (6.7.19)
    "200*pz*c3 - px^2 + 200*px*s3 - pz^2 + 588.41",
    // (6.7.18)
    "-px^2 - pz^2 + 20580*c4 + 20588.41",
];

const ARM: [&str; 4] = [
    // (6.7.5) with its exact constant: 3620229.2361 instead of the printed 3620229.3
    "44100*(py^2 + pz^2)*s2^2 - 420*(py^3 + py*pz^2)*s2 + 799129.8*py*s2 + 3620229.2361 - 3805.38*py^2 - 47905.38*pz^2
        + py^4 + 2*py^2*pz^2 + pz^4",
    // (6.7.6)
    "py^2 - 210*s2*py - pz^2 + 227.40*pz*s4 - 1902.69",
    // (6.7.7)
    "210*pz*c2 - py^2 + 210*s2*py - pz^2 + 1902.69",
    // (6.7.8)
    "113.70*c4 - py + 105*s2",
];

pub fn source(name: &str) -> Source {
    Source::read(&Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("derivations").join(name)).unwrap()
}

pub fn derive(system: System) -> Derivation {
    Derivation::of_problem(system, &Watch::none()).unwrap()
}

/// Asserts that the generic basis is `expected`, up to a factor from the field for each polynomial.
fn assert_basis(derivation: &Derivation, expected: &[&str]) {
    let solved = derivation.equations().unwrap().method.requested.solved().unwrap();
    let ring = &solved.triangular.ring;
    let expected: Vec<Poly> = expected.iter().map(|text| ring.monic(&polynomial(ring, text))).collect();
    assert_eq!(solved.certified.basis, expected);
}

fn polynomial(ring: &Unknowns, text: &str) -> Poly {
    parse(text).unwrap().evaluate(ring).unwrap()
}

#[test]
fn the_leg_gives_the_source_s_basis() {
    let derivation = derive(source("nao_leg_sagittal").system.unwrap());
    assert_eq!(derivation.equations().unwrap().problem.order, ["c4", "c3", "s4", "s3"]);
    assert_basis(&derivation, &LEG);
}

#[test]
fn the_arm_gives_the_source_s_basis() {
    let derivation = derive(source("nao_arm_planar").system.unwrap());
    assert_eq!(derivation.equations().unwrap().problem.order, ["c4", "c2", "s4", "s2"]);
    assert_basis(&derivation, &ARM);
}

/// The cleared polynomials are equal to the source's up to a rational number, not only up to a rational function.
#[test]
fn cleared_polynomials_differ_from_the_source_s_by_a_number() {
    for (name, expected) in [("nao_leg_sagittal", LEG), ("nao_arm_planar", ARM)] {
        let derivation = derive(source(name).system.unwrap());
        let triangular = &derivation.equations().unwrap().method.requested.solved().unwrap().triangular;
        let ring = &triangular.ring;
        for (stair, text) in triangular.stairs.iter().zip(expected) {
            let [ours] = stair.polynomials.as_slice() else { panic!("one polynomial an unknown") };
            let theirs = polynomial(ring, text);
            let lead = |f: &Poly| f.leading().unwrap().coefficient.clone();
            let ratio = ring.field().checked_div(&lead(ours), &lead(&theirs)).unwrap();
            assert!(ring.field().as_constant(&ratio).is_some(), "{name}: {}", ring.format(ours, Style::Text));
            assert_eq!(*ours, ring.scale(&theirs, &ratio), "{name}");
        }
    }
}

#[test]
fn the_chain_yields_the_source_s_equations() {
    let system = source("nao_leg_sagittal").system.unwrap();
    let ring = PolynomialRing::new(
        groebot_algebra::poly::Fractions::new(groebot_algebra::number::Rationals, &["px", "pz"]).unwrap(),
        &system.order,
        groebot_algebra::poly::Order::Lex,
    )
    .unwrap();
    let ours: Vec<Poly> = system.equations.iter().map(|e| e.expression.evaluate(&ring).unwrap()).collect();
    let printed = [
        "102.9*c3*s4 + 102.9*c4*s3 + 100*s3 - px", // (6.7.13)
        "102.9*c3*c4 - 102.9*s3*s4 + 100*c3 - pz", // (6.7.12)
        "c3^2 + s3^2 - 1",                         // (6.7.14)
        "c4^2 + s4^2 - 1",                         // (6.7.15)
    ];
    assert_eq!(ours, printed.map(|text| polynomial(&ring, text)));
}

#[test]
fn printed_constants_are_rounded() {
    let number = |text: &str| parse_rational(text).unwrap();
    let off = |printed: &str, exact: &BigRational| number(printed) - exact;
    let (l1, l2) = (number("100"), number("102.9"));
    let constant = (&l1 * &l1 - &l2 * &l2).pow(2);
    assert_eq!(constant, number("346226.3281"));
    assert_eq!(off("346226.3", &constant), number("-0.0281"));
    let (l1, l2) = (number("105"), number("113.7"));
    let constant = (&l1 * &l1 - &l2 * &l2).pow(2);
    assert_eq!(constant, number("3620229.2361"));
    assert_eq!(off("3620229.3", &constant), number("0.0639"), "not the nearest: 3620229.2 is");
}

/// The leg's equations with the lengths as parameters.
pub fn symbolic_leg() -> System {
    System::from_toml(&two_links("leg", ["c4", "c3", "s4", "s3"])).unwrap()
}

/// A leg-like system with given names for its unknowns, in the order `[c4, c3, s4, s3]`.
pub fn two_links(name: &str, [c4, c3, s4, s3]: [&str; 4]) -> String {
    format!(
        r#"
name = "{name}"
length_unit = "mm"
order = ["{c4}", "{c3}", "{s4}", "{s3}"]
equations = ["L2*{c3}*{c4} - L2*{s3}*{s4} + L1*{c3} = pz", "L2*{c3}*{s4} + L2*{c4}*{s3} + L1*{s3} = px"]
[[parameter]]
name = "px"
[[parameter]]
name = "pz"
[[parameter]]
name = "L1"
positive = true
[[parameter]]
name = "L2"
positive = true
[[joint]]
name = "hip"
cosine = "{c3}"
sine = "{s3}"
[[joint]]
name = "knee"
cosine = "{c4}"
sine = "{s4}"
"#
    )
}

/// The arm's equations with the lengths as parameters.
pub fn symbolic_arm() -> System {
    let text = std::fs::read_to_string(source("nao_arm_planar").path).unwrap();
    let lengths = "[constants]\nL1 = 105.0\nL2 = \"55.95 + 57.75\"\n";
    assert!(text.contains(lengths));
    let symbolic = "[[parameter]]\nname = \"L1\"\npositive = true\n[[parameter]]\nname = \"L2\"\npositive = true\n";
    System::from_toml(&text.replace(lengths, symbolic)).unwrap()
}

#[test]
fn symbolic_lengths_specialise_to_the_source_s_basis() {
    for (system, lengths, expected) in [
        (symbolic_leg(), [("L1", "100"), ("L2", "102.9")], LEG),
        (symbolic_arm(), [("L1", "105"), ("L2", "113.7")], ARM),
    ] {
        let derivation = derive(system);
        let solved = derivation.equations().unwrap().method.requested.solved().unwrap();
        let ring = &solved.triangular.ring;
        let value = |name: &str| {
            let found = lengths.iter().find(|(length, _)| *length == name);
            found.map(|(_, text)| parse(text).unwrap())
        };
        for (ours, theirs) in solved.certified.basis.iter().zip(expected) {
            let text = parse(&ring.format(ours, Style::Text)).unwrap().substitute(&value);
            assert_eq!(text.evaluate(ring).unwrap(), ring.monic(&polynomial(ring, theirs)));
        }
    }
}

/// The report shows the decimals of the source.
#[test]
fn the_report_shows_the_source_s_coefficients() {
    let derivation = derive(source("nao_leg_sagittal").system.unwrap());
    let text = derivation.equations().unwrap().method.requested.solved().unwrap().triangular.to_string();
    for part in ["20580*c4", "20588.41", "346226.3281", "235364*px", "1176.82*px^2", "41176.82*pz^2", "588.41"] {
        assert!(text.contains(part), "{part} in\n{text}");
    }
}
