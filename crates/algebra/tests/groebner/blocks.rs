//! Blocks of unknowns of known mechanisms, over the rational functions of their parameters.
//!
//! Each is derived from the kinematics. `c` and `s` are cosine and sine of a joint angle. The parameters are
//! coordinates of the tip and, for names with `symbolic`, lengths.

use groebot_algebra::number::{BigRational, Rationals, Ring};
use groebot_algebra::poly::{Block, Fraction, Fractions, Order, Polynomial, PolynomialRing};

use crate::corpus::read;

pub type Field = Fractions<Rationals>;
pub type Poly = Polynomial<Fraction<BigRational>>;

/// A system of equations with parameters.
pub struct Mechanism {
    pub ring: PolynomialRing<Field>,
    pub generators: Vec<Poly>,
    /// The number of solutions for generic parameters.
    pub solutions: usize,
}

/// Pairs (cosine, sine), one graded block for each pair. The angle that is solved first is last.
fn pairs(count: usize) -> Order {
    Order::Block(vec![Block { size: 2, graded: true }; count])
}

fn mechanism(parameters: &str, unknowns: &str, order: Order, equations: &[String], solutions: usize) -> Mechanism {
    let names = |text: &str| text.split_whitespace().map(str::to_owned).collect::<Vec<_>>();
    let field = Fractions::new(Rationals, &names(parameters)).expect("distinct names");
    over(field, &names(unknowns), order, equations, solutions)
}

fn over(field: Field, unknowns: &[String], order: Order, equations: &[String], solutions: usize) -> Mechanism {
    let ring = PolynomialRing::new(field, unknowns, order).expect("distinct names");
    let generators = equations.iter().map(|text| read(&ring, text)).collect();
    Mechanism { ring, generators, solutions }
}

fn circle(joint: &str) -> String {
    format!("c{joint}^2 + s{joint}^2 - 1")
}

/// The sagittal leg of NAO, (6.7.12)-(6.7.15).
pub fn nao_leg() -> Mechanism {
    let equations = [
        "1029/10*c3*c4 - 1029/10*s3*s4 + 100*c3 - pz".into(),
        "1029/10*c3*s4 + 1029/10*c4*s3 + 100*s3 - px".into(),
        circle("3"),
        circle("4"),
    ];
    mechanism("px pz", "c4 c3 s4 s3", Order::GrevLex, &equations, 2)
}

/// The planar arm of NAO, (6.7.1)-(6.7.4).
pub fn nao_arm() -> Mechanism {
    let equations = ["105*c2 + 1137/10*s4 - pz".into(), "105*s2 + 1137/10*c4 - py".into(), circle("2"), circle("4")];
    mechanism("py pz", "c4 c2 s4 s2", Order::GrevLex, &equations, 2)
}

/// Three revolute joints in the plane with links 3, 2 and 1; the tip (x, y) points along (c, s), where `s^2 = 1 - c^2`.
pub fn planar_3r() -> Mechanism {
    let field = Fractions::new(Rationals, &["x", "y", "c", "s"]).expect("distinct names");
    let ring = field.ring().clone();
    let c = ring.variable(2);
    let field = field.with_square(3, &ring.sub(&ring.one(), &ring.mul(&c, &c))).expect("a square of c");
    // The wrist is at (x - c, y - s). The third angle follows from the orientation.
    let equations = [
        "3*c1 + 2*(c1*c2 - s1*s2) + c - x".into(),
        "3*s1 + 2*(s1*c2 + c1*s2) + s - y".into(),
        "(c1*c2 - s1*s2)*c3 - (s1*c2 + c1*s2)*s3 - c".into(),
        "(s1*c2 + c1*s2)*c3 + (c1*c2 - s1*s2)*s3 - s".into(),
        circle("1"),
        circle("2"),
        circle("3"),
    ];
    let unknowns = ["c3", "s3", "c1", "c2", "s2", "s1"].map(str::to_owned);
    over(field, &unknowns, Order::GrevLex, &equations, 2)
}

/// The position of the PUMA 560's wrist (Craig, Introduction to Robotics, 3rd edition, section 4.7), shoulder to wrist:
/// the forward equations multiplied by the inverse of the first joint, and the squared distance, in which the second
/// joint cancels.
fn puma(lengths: [&str; 4], parameters: &str) -> Mechanism {
    let [a2, a3, d3, d4] = lengths;
    let reach = format!("{a3}*c3 - {d4}*s3 + {a2}");
    let depth = format!("{a3}*s3 + {d4}*c3");
    let equations = [
        format!("c1*x + s1*y - c2*({reach}) + s2*({depth})"),
        format!("c1*y - s1*x - {d3}"),
        format!("z + s2*({reach}) + c2*({depth})"),
        format!("x^2 + y^2 + z^2 - {a2}^2 - {a3}^2 - {d3}^2 - {d4}^2 - 2*{a2}*({a3}*c3 - {d4}*s3)"),
        circle("1"),
        circle("2"),
        circle("3"),
    ];
    mechanism(
        parameters,
        "c2 s2 c1 c3 s1 s3",
        Order::Block(vec![Block { size: 2, graded: true }, Block { size: 4, graded: true }]),
        &equations,
        4,
    )
}

/// PUMA with the lengths of Corke and Armstrong-Helouvry (ICRA 1994): a2, a3, d3, d4 in metres.
pub fn puma_position() -> Mechanism {
    puma(["(4318/10000)", "(203/10000)", "(1500/10000)", "(4318/10000)"], "x y z")
}

/// PUMA with symbolic lengths.
pub fn puma_symbolic() -> Mechanism {
    puma(["a2", "a3", "d3", "d4"], "x y z a2 a3 d3 d4")
}

/// The tip's position of three revolute joints in general position, in Denavit and Hartenberg's parameters; the twists
/// have the cosines 3/5 and 5/13, the first offset is part of z, and the third twist has no influence. The squared
/// distance is added (Pieper 1968).
fn generic_3r(lengths: [&str; 5], parameters: &str) -> Mechanism {
    let [a1, a2, a3, d2, d3] = lengths;
    let (x, y, z) =
        (format!("{a2} + {a3}*c3"), format!("5/13*{a3}*s3 - 12/13*{d3}"), format!("{d2} + 12/13*{a3}*s3 + 5/13*{d3}"));
    let along = format!("c2*({x}) - s2*({y})");
    let across = format!("s2*({x}) + c2*({y})");
    let squares = format!("{a2}^2 + {a3}^2 + {d2}^2 + {d3}^2 + 2*{a2}*{a3}*c3 + 2*{d2}*(12/13*{a3}*s3 + 5/13*{d3})");
    let equations = [
        format!("c1*x + s1*y - {a1} - ({along})"),
        format!("c1*y - s1*x - 3/5*({across}) + 4/5*({z})"),
        format!("z - 4/5*({across}) - 3/5*({z})"),
        format!("x^2 + y^2 + z^2 - {a1}^2 - 2*{a1}*({along}) - ({squares})"),
        circle("1"),
        circle("2"),
        circle("3"),
    ];
    mechanism(parameters, "c1 s1 c2 s2 c3 s3", pairs(3), &equations, 4)
}

/// The generic arm with numeric lengths.
pub fn generic_3r_position() -> Mechanism {
    generic_3r(["(3/10)", "(7/10)", "(11/20)", "(1/5)", "(2/5)"], "x y z")
}

/// The generic arm with its five lengths and three coordinates symbolic.
pub fn generic_3r_symbolic() -> Mechanism {
    generic_3r(["a1", "a2", "a3", "d2", "d3"], "x y z a1 a2 a3 d2 d3")
}
