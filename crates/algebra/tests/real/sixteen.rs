//! Sixteen real solutions at one pose, the maximum for six joints, compared with a published table.
//!
//! D. Manocha and J. F. Canny, "Efficient inverse kinematics for general 6R manipulators", IEEE Trans. Robotics and
//! Automation 10 (1994) 648-657: Table I, the pose below it and Table III. It is problem 6 of C. Wampler and A. P.
//! Morgan, Mechanism and Machine Theory 26 (1991) 91-106, a slight variation of the manipulator of R. Manseur and K. L.
//! Doty, Int. J. Robotics Research 8 (1989) 75-79.
//!
//! Fourteen functions of the fifth frame's axis and origin are affine in the cosine and sine of every joint (M.
//! Raghavan and B. Roth, J. Mechanical Design 115 (1993) 502-508), so joints 1 and 2 are eliminated by linear algebra
//! over Q.

use std::ops::Neg;

use groebot_algebra::Watch;
use groebot_algebra::number::{BigInt, BigRational, Rationals};
use groebot_algebra::poly::{Order, Polynomial, PolynomialRing, parse};
use groebot_algebra::real::{Options, RealSolution, solve};
use num_traits::{Num, One, ToPrimitive, Zero};

type Ground = PolynomialRing<Rationals>;
type Poly = Polynomial<BigRational>;

pub(crate) fn rational(n: i64, d: i64) -> BigRational {
    BigRational::new(BigInt::from(n), BigInt::from(d))
}

pub(crate) fn system<S: AsRef<str>>(variables: &[S], equations: &[S]) -> (Ground, Vec<Poly>) {
    let ring = PolynomialRing::new(Rationals, variables, Order::GrevLex).unwrap();
    let generators = equations.iter().map(|text| parse(text.as_ref()).unwrap().evaluate(&ring).unwrap()).collect();
    (ring, generators)
}

pub(crate) type Frame<T> = [[T; 4]; 4];

/// A number, exact or not.
pub(crate) trait Number: Num + Neg<Output = Self> + Clone {}
impl<T: Num + Neg<Output = T> + Clone> Number for T {}

/// A link in Denavit-Hartenberg parameters: lengths in the unit of the table, cosine and sine of the twist.
#[derive(Clone)]
pub(crate) struct Link<T> {
    pub length: T,
    pub offset: T,
    pub twist: [T; 2],
}

/// Table I: lengths, offsets and twists in degrees of the six links.
const TABLE: [(&str, &str, f64); 6] =
    [("3/10", "0", 90.0), ("1", "0", 1.0), ("0", "1/5", 90.0), ("3/2", "0", 1.0), ("0", "0", 90.0), ("0", "0", 1.0)];

/// Table III: the joint angles in degrees.
pub(crate) const ANGLES: [[f64; 6]; 16] = [
    [-96.28, -6.27, 179.96, 38.48, 52.55, -39.40],
    [-120.78, 172.33, -179.07, 31.33, -146.71, 142.82],
    [88.67, -176.72, -176.72, -63.24, 157.19, 140.43],
    [113.84, 5.30, -177.74, -55.92, -62.98, -43.37],
    [-178.12, 108.19, -147.73, -5.69, -164.67, 179.58],
    [168.32, -103.89, 146.60, -17.24, -171.87, 98.16],
    [-12.94, -105.09, -114.97, 3.02, 7.41, -79.42],
    [2.51, 108.07, 112.04, -10.52, 0.00, -0.10],
    [2.51, 108.07, -67.95, -169.47, 179.99, 179.89],
    [-12.94, -105.09, 65.02, 176.97, 172.58, 100.57],
    [168.32, -103.89, -33.39, -162.75, -8.12, -81.83],
    [-178.12, 108.19, 32.26, -174.30, -15.32, -0.41],
    [88.67, -176.72, 3.27, -116.75, 22.80, -39.56],
    [-96.28, -6.27, -0.03, 141.51, 127.44, 140.59],
    [-120.78, 172.33, 0.92, 148.66, -33.28, -37.17],
    [113.84, 5.30, 2.25, -124.07, -117.01, 136.62],
];

/// Cosine and sine of the angle whose half has the tangent `n / d`.
pub(crate) fn turn((n, d): (i64, i64)) -> [BigRational; 2] {
    [rational(d * d - n * n, d * d + n * n), rational(2 * n * d, d * d + n * n)]
}

/// The six links, with angles within 4e-6 degrees.
pub(crate) fn links() -> [Link<BigRational>; 6] {
    let exact = |text: &str| text.parse().unwrap();
    let twist = |degrees: f64| turn(if degrees == 90.0 { (1, 1) } else { (17, 1948) });
    TABLE.map(|(length, offset, degrees)| Link { length: exact(length), offset: exact(offset), twist: twist(degrees) })
}

/// The pose, exactly orthogonal. Its entries begin with the four printed decimals. The sign of the first coordinate is
/// missing there; the matrix Q on the same page and Table III have it negative.
pub(crate) fn pose() -> Frame<BigRational> {
    let ([c, s], [k, m]) = (turn((69, 190)), turn((14, 209)));
    let (zero, one) = (BigRational::zero(), BigRational::one());
    [
        [-&c * &k, -&s, &c * &m, rational(-122, 107)],
        [m.clone(), zero.clone(), k.clone(), zero.clone()],
        [-&s * &k, c, &s * &m, zero.clone()],
        [zero.clone(), zero.clone(), zero, one],
    ]
}

/// The frame of a link after the rotation of its joint.
fn link<T: Number>([c, s]: &[T; 2], link: &Link<T>) -> Frame<T> {
    let ([u, v], [c, s]) = (link.twist.clone(), [c.clone(), s.clone()]);
    let (a, zero) = (link.length.clone(), T::zero);
    [
        [c.clone(), -s.clone() * u.clone(), s.clone() * v.clone(), a.clone() * c.clone()],
        [s.clone(), c.clone() * u.clone(), -c * v.clone(), a * s],
        [zero(), v, u, link.offset.clone()],
        [zero(), zero(), zero(), T::one()],
    ]
}

pub(crate) fn product<T: Number>(a: &Frame<T>, b: &Frame<T>) -> Frame<T> {
    let entry = |i: usize, j: usize| (0..4).fold(T::zero(), |sum, k| sum + a[i][k].clone() * b[k][j].clone());
    std::array::from_fn(|i| std::array::from_fn(|j| entry(i, j)))
}

pub(crate) fn inverse<T: Number>(a: &Frame<T>) -> Frame<T> {
    let moved = |i: usize| (0..3).fold(T::zero(), |sum, k| sum - a[k][i].clone() * a[k][3].clone());
    std::array::from_fn(|i| {
        std::array::from_fn(|j| match (i, j) {
            (3, _) => a[3][j].clone(),
            (_, 3) => moved(i),
            _ => a[j][i].clone(),
        })
    })
}

pub(crate) fn chain<T: Number>(turns: &[[T; 2]], links: &[Link<T>]) -> Frame<T> {
    let mut frames = turns.iter().zip(links).map(|(turn, row)| link(turn, row));
    let first = frames.next().expect("a link");
    frames.fold(first, |frame, next| product(&frame, &next))
}

/// Raghavan and Roth's functions of the axis `l` and the origin `p` of a frame: p, l, p.p, p.l, p x l and (p.p) l - 2 (p.l) p.
fn invariants(frame: &Frame<BigRational>) -> Vec<BigRational> {
    let [l, p] = [2, 3].map(|column| [0, 1, 2].map(|row: usize| frame[row][column].clone()));
    let dot = |a: &[BigRational; 3], b: &[BigRational; 3]| a.iter().zip(b).map(|(x, y)| x * y).sum::<BigRational>();
    let (square, along) = (dot(&p, &p), dot(&p, &l));
    let cross = |i: usize| &p[(i + 1) % 3] * &l[(i + 2) % 3] - &p[(i + 2) % 3] * &l[(i + 1) % 3];
    let last = |i: usize| &square * &l[i] - rational(2, 1) * &along * &p[i];
    let mut found = [p.clone(), l.clone()].concat();
    found.extend([square.clone(), along.clone()]);
    found.extend([0, 1, 2].map(cross));
    found.extend([0, 1, 2].map(last));
    found
}

/// The coefficients of functions that are affine in the cosine and sine of each of `joints` joints, from their values
/// at quarter turns. The coefficients are those of the products of one of 1, c, s for each joint. The last joint varies
/// fastest.
fn expand(joints: u32, values: impl Fn(&[[BigRational; 2]]) -> Vec<BigRational>) -> Vec<Vec<BigRational>> {
    let places = [(1, 0), (-1, 0), (0, 1)].map(|(c, s)| [rational(c, 1), rational(s, 1)]);
    let count = 3_usize.pow(joints);
    let digit = |index: usize, joint: u32| index / 3_usize.pow(joints - 1 - joint) % 3;
    let turns = |index: usize| (0..joints).map(|joint| places[digit(index, joint)].clone()).collect::<Vec<_>>();
    let mut table: Vec<_> = (0..count).map(|index| values(&turns(index))).collect();
    for joint in 0..joints {
        let step = 3_usize.pow(joints - 1 - joint);
        for index in (0..count).filter(|&index| digit(index, joint) == 0) {
            for row in 0..table[index].len() {
                let [a, b, c] = [0, 1, 2].map(|place| table[index + place * step][row].clone());
                let constant = (&a + &b) / rational(2, 1);
                table[index + step][row] = &a - &constant;
                table[index + 2 * step][row] = &c - &constant;
                table[index][row] = constant;
            }
        }
    }
    (0..table[0].len()).map(|row| table.iter().map(|values| values[row].clone()).collect()).collect()
}

/// Gauss-Jordan elimination on the first `columns` columns. Returns the number of pivots. Their rows are first.
fn reduce(rows: &mut [Vec<BigRational>], columns: usize) -> usize {
    let mut rank = 0;
    for column in 0..columns {
        let Some(pivot) = (rank..rows.len()).find(|&row| !rows[row][column].is_zero()) else { continue };
        rows.swap(rank, pivot);
        let scale = rows[rank][column].recip();
        rows[rank].iter_mut().for_each(|entry| *entry *= &scale);
        let head = rows[rank].clone();
        for row in (0..rows.len()).filter(|&row| row != rank) {
            let factor = rows[row][column].clone();
            rows[row].iter_mut().zip(&head).for_each(|(entry, above)| *entry -= &factor * above);
        }
        rank += 1;
    }
    rank
}

/// The products of cosines and sines of joints 1 and 2, without the constant: c2, s2, c1, c1 c2, c1 s2, s1, s1 c2, s1
/// s2.
const EIGHT: usize = 8;

/// First the eight products of joints 1 and 2, then relations of joints 3, 4 and 5 alone. Each row has the coefficients
/// of the eight products and of the right side, in 1, c, s of joints 3, 4 and 5.
pub(crate) fn eliminate(links: &[Link<BigRational>; 6], pose: &Frame<BigRational>) -> Vec<Vec<BigRational>> {
    let zero = turn((0, 1));
    let without_last = product(pose, &inverse(&link(&zero, &links[5])));
    let left = expand(3, |turns| invariants(&chain(turns, &links[2..5])));
    let right = expand(2, |turns| invariants(&product(&inverse(&chain(turns, &links[..2])), &without_last)));
    let mut rows: Vec<Vec<BigRational>> = left
        .iter()
        .zip(&right)
        .map(|(left, right)| [&right[1..], &[&left[0] - &right[0]], &left[1..]].concat())
        .collect();
    assert_eq!(reduce(&mut rows, EIGHT), EIGHT);
    rows
}

/// The products of one of 1, c, s of joints 3, 4 and 5.
fn products() -> Vec<String> {
    let factors = |joint: usize| ["1".to_owned(), format!("c{joint}"), format!("s{joint}")];
    let mut names = vec![String::from("1")];
    for joint in 3..6 {
        names = names.iter().flat_map(|name| factors(joint).map(|factor| format!("{name}*{factor}"))).collect();
    }
    names
}

/// The polynomials that vanish at the angles of joints 3, 4 and 5.
fn relations(rows: &[Vec<BigRational>]) -> Vec<String> {
    let relation = |row: &Vec<BigRational>| {
        let terms = row[EIGHT..].iter().zip(products()).filter(|(c, _)| !c.is_zero());
        terms.map(|(c, product)| format!("({c})*{product}")).collect::<Vec<_>>().join(" + ")
    };
    let circles = (3..6).map(|joint| format!("c{joint}^2 + s{joint}^2 - 1"));
    rows[EIGHT..].iter().map(relation).chain(circles).collect()
}

/// The real solutions for joints 3, 4 and 5.
pub(crate) fn solutions(rows: &[Vec<BigRational>]) -> Vec<RealSolution> {
    let names = ["c3", "s3", "c4", "s4", "c5", "s5"].map(str::to_owned);
    let (ring, generators) = system(&names, &relations(rows));
    solve(&ring, &generators, &Options::default(), &Watch::none()).unwrap()
}

/// The six joint angles \[rad\] for the cosines and sines of joints 3, 4 and 5.
fn angles(rows: &[Vec<BigRational>], turns: &[f64]) -> [f64; 6] {
    let mut values = vec![1.0];
    for pair in turns.chunks(2) {
        values = values.iter().flat_map(|value| [*value, value * pair[0], value * pair[1]]).collect();
    }
    let value = |row: usize| rows[row][EIGHT..].iter().zip(&values).map(|(c, v)| float(c) * v).sum::<f64>();
    let [c2, s2, c1, s1] = [0, 1, 2, 5].map(value);
    let mut found = [[c1, s1], [c2, s2], [turns[0], turns[1]], [turns[2], turns[3]], [turns[4], turns[5]]];
    for [c, s] in &mut found {
        let length = c.hypot(*s);
        (*c, *s) = (*c / length, *s / length);
    }
    let last = product(&inverse(&chain(&found, &rounded())), &pose().map(|row| row.map(|entry| float(&entry))));
    let q6 = last[1][0].atan2(last[0][0]);
    std::array::from_fn(|joint| found.get(joint).map_or(q6, |[c, s]| s.atan2(*c)))
}

fn float(number: &BigRational) -> f64 {
    number.to_f64().expect("a finite number")
}

/// Same links in doubles.
fn rounded() -> [Link<f64>; 6] {
    links().map(|row| Link {
        length: float(&row.length),
        offset: float(&row.offset),
        twist: row.twist.map(|x| float(&x)),
    })
}

/// The table as printed, in doubles.
fn printed() -> [Link<f64>; 6] {
    let radians = TABLE.map(|(_, _, degrees)| degrees.to_radians());
    let mut links = rounded();
    links.iter_mut().zip(radians).for_each(|(link, twist)| link.twist = [twist.cos(), twist.sin()]);
    links
}

/// The greatest difference between an entry of the pose and of the frame that the joint angles `q` \[rad\] reach.
fn residual(q: &[f64; 6], links: &[Link<f64>; 6]) -> f64 {
    let reached = chain(&q.map(|angle| [angle.cos(), angle.sin()]), links);
    let entries = reached.iter().flatten().zip(pose().into_iter().flatten());
    entries.map(|(entry, wanted)| (entry - float(&wanted)).abs()).fold(0.0, f64::max)
}

/// The greatest difference of two joint vectors, the one in radians, the other in degrees.
fn distance(q: &[f64; 6], degrees: &[f64; 6]) -> f64 {
    let difference = |(a, b): (&f64, &f64)| (a.to_degrees() - b + 180.0).rem_euclid(360.0) - 180.0;
    q.iter().zip(degrees).map(difference).fold(0.0, |most, d: f64| most.max(d.abs()))
}

/// Table I, the pose and Table III agree, so the data are read correctly.
#[test]
fn the_printed_angles_reach_the_printed_pose() {
    for row in &ANGLES {
        let residual = residual(&row.map(f64::to_radians), &printed());
        assert!(residual < 5e-4, "{row:?}: {residual}");
    }
}

#[test]
fn sixteen_real_solutions_at_one_pose() {
    let rows = eliminate(&links(), &pose());
    let solutions = solutions(&rows);
    let complex = solutions[0].representation().polynomial.degree();
    assert_eq!((solutions.len(), complex), (16, Some(16)));
    assert!(solutions.iter().all(|solution| solution.multiplicity == 1));
    let found: Vec<[f64; 6]> = solutions.iter().map(RealSolution::approximate).map(|x| angles(&rows, &x)).collect();
    for q in &found {
        let residual = residual(q, &rounded());
        assert!(residual < 1e-9, "{q:?}: {residual}");
    }
    for row in &ANGLES {
        assert_eq!(found.iter().filter(|q| distance(q, row) < 0.1).count(), 1, "{row:?}");
    }
}
