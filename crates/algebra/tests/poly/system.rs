//! Systems in files: the three readers, and reading back of printed text.

use groebot_algebra::number::{Field, Rationals, Ring, Style, Zp};
use groebot_algebra::poly::system::{Format, Heading, PolynomialSystem, parse_order};
use groebot_algebra::poly::{Block, Fractions, Order, Polynomial, PolynomialRing};
use groebot_algebra::{Result, Watch};
use proptest::prelude::*;

use super::sparse::{Sparse, build, quotient, sparse};

pub const FORMATS: [Format; 3] = [Format::Plain, Format::Singular, Format::Msolve];

/// The polynomials as text, expanded, and the heading.
fn read(text: &str) -> (Heading, Vec<String>) {
    let system = PolynomialSystem::read(text, None).unwrap_or_else(|error| panic!("{text}: {error}"));
    let list = match (system.heading.characteristic, system.heading.parameters.as_slice()) {
        (0, []) => texts(&system, Rationals),
        (p, []) => texts(&system, Zp::new(p).unwrap()),
        (0, parameters) => texts(&system, Fractions::new(Rationals, parameters).unwrap()),
        (p, parameters) => texts(&system, Fractions::new(Zp::new(p).unwrap(), parameters).unwrap()),
    };
    (system.heading, list)
}

fn texts<F: Field>(system: &PolynomialSystem, field: F) -> Vec<String> {
    let ring = system.heading.ring(field).unwrap();
    system.expand(&ring, &Watch::none()).unwrap().iter().map(|f| ring.format(f, Style::Text)).collect()
}

fn blocks(list: &[(usize, bool)]) -> Order {
    Order::Block(list.iter().map(|&(size, graded)| Block { size, graded }).collect())
}

#[test]
fn plain_text() {
    let text = "\u{feff}# a circle and a line\r\nvariables: x, y\r\norder: lex\r\ncharacteristic: 7\r\n\r\n\
                x^2 + y^2 = 1   # the circle\r\n(x - y)*(x + y) + 8\r\n0.5*x = y/3";
    let (heading, list) = read(text);
    let names = ["x", "y"].map(str::to_owned).to_vec();
    assert_eq!(heading, Heading { characteristic: 7, parameters: vec![], variables: names, order: Order::Lex });
    // 1/2 = 4 and -1/3 = 2 modulo 7.
    assert_eq!(list, ["x^2 + y^2 + 6", "x^2 + 6*y^2 + 1", "4*x + 2*y"]);
}

#[test]
fn plain_text_without_a_header() {
    let (heading, list) = read("L1*c2 + pz = 0\ns4 - c2\n");
    assert_eq!(heading.variables, ["L1", "c2", "pz", "s4"]);
    assert_eq!((heading.order, heading.characteristic), (Order::GrevLex, 0));
    assert_eq!(list, ["L1*c2 + pz", "-c2 + s4"]);
}

#[test]
fn plain_text_with_parameters() {
    let (heading, list) = read("parameters: a, b\norder: lex\na*x/(a*b) + y - 1/b\n");
    assert_eq!((heading.variables, heading.parameters), (vec!["x".into(), "y".into()], vec!["a".into(), "b".into()]));
    assert_eq!(list, ["(1)/(b)*x + y + (-1)/(b)"]);
}

#[test]
fn singular() {
    let text = "// three ways to write\nring r = 0, (x,y,z(1..2)), (dp(2),lp(2));\n/* a comment\n   over lines */\n\
                poly f = 3x2y - 1/3xy2 + (x+y)^2;\nideal i = f, z(1)*z(2)^2 - 1/2*x^3,\n  -x^2 + 2x^2;\n";
    let (heading, list) = read(text);
    assert_eq!(heading.variables, ["x", "y", "z1", "z2"]);
    assert_eq!(heading.order, blocks(&[(2, true), (2, false)]));
    // Singular 4.3.1 with this text and `short=0; i;`, its z(1) written as z1.
    assert_eq!(list, ["3*x^2*y - 1/3*x*y^2 + x^2 + 2*x*y + y^2", "-1/2*x^3 + z1*z2^2", "3*x^2"]);
}

#[test]
fn singular_with_parameters() {
    let text = "ring r = (7,a,b),(x,y),lp; ideal i = ax2 + (b/(a+1))*y - 9, a*x*y + 1/3;";
    let (heading, list) = read(text);
    assert_eq!(
        (heading.characteristic, heading.parameters, heading.order),
        (7, vec!["a".into(), "b".into()], Order::Lex)
    );
    // Singular prints `(a)*x^2+(b)/(a+1)*y-2` and `(a)*x*y-2`.
    assert_eq!(list, ["a*x^2 + (b)/(a + 1)*y + 5", "a*x*y + 5"]);
}

#[test]
fn singular_rings() {
    let heading = |ring: &str, variable: &str| read(&format!("ring R_1={ring};poly p={variable};")).0;
    assert_eq!(heading("QQ,x,lp", "x").variables, ["x"]);
    assert_eq!(heading("0,t(3),dp", "t(3)").variables, ["t3"]);
    assert_eq!(heading("(32003,q(1..2)),(x),(dp(1),C)", "q(1)*x").parameters, ["q1", "q2"]);
    assert_eq!(heading("(2147483647),(x,y),(c,lp)", "x").order, Order::Lex);
    assert_eq!(heading("0,(x,y,z),(dp(1),dp)", "x").order, blocks(&[(1, true), (2, true)]));
    // A declared name has precedence over a monomial of that form.
    assert_eq!(read("ring r=0,(xy,x,y),dp; poly f=xy+2xy;").1, ["2*x*y + xy"]);
}

#[test]
fn polynomials_without_an_ideal_are_the_system() {
    assert_eq!(read("ring r=0,(x,y),dp; poly f=x; poly g=y2;").1, ["x", "y^2"]);
}

#[test]
fn msolve() {
    let (heading, list) = read("# a comment\nx, y1\n2147483647\nx^2*y1-1,\n-1/2*x\n+y1\n,3\n");
    assert_eq!((heading.characteristic, heading.variables), (2147483647, vec!["x".into(), "y1".into()]));
    // -1/2 modulo p is (p - 1)/2.
    assert_eq!(list, ["x^2*y1 + 2147483646", "1073741823*x + y1", "3"]);
}

#[test]
fn orders() {
    for (text, order) in [
        ("lex", Order::Lex),
        ("grevlex", Order::GrevLex),
        ("block:2,3", blocks(&[(2, true), (3, true)])),
        ("grevlex(2), lex(1)", blocks(&[(2, true), (1, false)])),
        ("lex(1) > grevlex(4)", blocks(&[(1, false), (4, true)])),
    ] {
        assert_eq!(parse_order(text).unwrap(), order);
        assert_eq!(parse_order(&order.to_string()).unwrap(), order);
    }
    for (text, word) in [
        ("degrevlex", "column 1: an order is `lex`"),
        ("", "column 1"),
        ("lex(0)", "column 5: a number of variables from 1 to 1000"),
        ("block:", "column 7"),
        ("lex lex", "column 5: the end of the order expected"),
        ("grevlex(2),dp(1)", "column 12: a block is"),
        ("lex(99999999999999999999)", "column 5"),
    ] {
        let error = parse_order(text).unwrap_err();
        assert!(error.message().starts_with(word), "{text}: {error}");
    }
}

/// A random system over some field: characteristic, parameters, order, polynomials with their scales.
#[derive(Clone, Debug)]
struct Sample {
    characteristic: u64,
    parametric: bool,
    order: Order,
    polynomials: Vec<(Sparse, Sparse, Sparse)>,
}

fn sample() -> impl Strategy<Value = Sample> {
    let order = prop_oneof![
        Just(Order::Lex),
        Just(Order::GrevLex),
        Just(blocks(&[(1, true), (2, true)])),
        Just(blocks(&[(2, false), (1, true)])),
    ];
    let polynomial = (sparse(3, 6, 4), sparse(2, 2, 2), sparse(2, 2, 2));
    let characteristic = prop::sample::select(vec![0u64, 2, 32003, 2147483647]);
    (characteristic, any::<bool>(), order, prop::collection::vec(polynomial, 0..4)).prop_map(
        |(characteristic, parametric, order, polynomials)| Sample { characteristic, parametric, order, polynomials },
    )
}

impl Sample {
    fn heading(&self) -> Heading {
        let parameters = if self.parametric { vec!["a".to_owned(), "q1".to_owned()] } else { Vec::new() };
        let variables = ["x", "R", "y_2"].map(str::to_owned).to_vec();
        Heading { characteristic: self.characteristic, parameters, variables, order: self.order.clone() }
    }

    /// Prints, reads, and compares over `field`. `scale` builds its elements.
    fn check<F: Field>(&self, field: F, scale: impl Fn(&F, &Sparse, &Sparse) -> F::Element) {
        let heading = self.heading();
        let ring = heading.ring(field.clone()).unwrap();
        let given =
            |(f, top, bottom): &(Sparse, Sparse, Sparse)| ring.scale(&build(&ring, f), &scale(&field, top, bottom));
        let polynomials: Vec<Polynomial<F::Element>> = self.polynomials.iter().map(given).collect();
        for format in FORMATS {
            let printed = heading.print(format, &ring, &polynomials);
            if self.parametric && format == Format::Msolve {
                assert!(printed.is_err());
                continue;
            }
            self.compare(&ring, &polynomials, format, &printed.unwrap()).unwrap();
        }
    }

    fn compare<F: Field>(
        &self,
        ring: &PolynomialRing<F>,
        polynomials: &[Polynomial<F::Element>],
        format: Format,
        text: &str,
    ) -> Result<()> {
        let system = PolynomialSystem::read(text, Some(format))?;
        assert_eq!(PolynomialSystem::read(text, None)?, system, "the format shows");
        let mut heading = self.heading();
        if format == Format::Msolve {
            heading.order = Order::GrevLex;
        }
        assert_eq!(system.heading, heading, "{text}");
        let none = [ring.zero()];
        assert_eq!(
            system.expand(ring, &Watch::none())?,
            if polynomials.is_empty() { &none } else { polynomials },
            "{text}"
        );
        if system.heading.order == self.order {
            assert_eq!(system.print(format)?, text);
        }
        Ok(())
    }
}

proptest! {
    #![proptest_config(crate::cases(96))]

    #[test]
    fn what_is_printed_is_read_back(sample in sample()) {
        let ratio = |top: &Sparse, bottom: &Sparse| {
            let value = |s: &Sparse, other: i64| s.first().map_or(other, |term| term.0);
            groebot_algebra::number::BigRational::new(value(top, 1).into(), value(bottom, 3).abs().max(1).into())
        };
        match (sample.characteristic, sample.parametric) {
            (0, false) => sample.check(Rationals, |_, top, bottom| ratio(top, bottom)),
            (0, true) => sample.check(Fractions::new(Rationals, &["a", "q1"]).unwrap(), quotient),
            (p, false) => sample.check(Zp::new(p).unwrap(), |field, top, _| field.from_integer(ratio(top, &Vec::new()).numer())),
            (p, true) => sample.check(Fractions::new(Zp::new(p).unwrap(), &["a", "q1"]).unwrap(), quotient),
        }
    }
}
