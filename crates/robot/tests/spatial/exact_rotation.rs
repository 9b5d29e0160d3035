//! Exactly orthogonal rotations: their matrices compared with sines from power series.

use groebot_algebra::number::{BigInt, BigRational};
use groebot_robot::kinematics::{ExactMatrix, ExactRotation, ExactVector, Placement, Turn};
use num_traits::{One, Signed, Zero};
use proptest::prelude::*;

use crate::kinematics::exact;

fn whole(n: i64) -> BigRational {
    BigRational::from_integer(n.into())
}

/// Cosine and sine by their power series, to about 1e-30.
fn series(angle: &BigRational) -> (BigRational, BigRational) {
    let (mut sums, mut term) = ([BigRational::zero(), BigRational::zero()], BigRational::one());
    for n in 0..45 {
        let sign = if n % 4 < 2 { whole(1) } else { whole(-1) };
        sums[n % 2] += &term * sign;
        term = term * angle / whole(n as i64 + 1);
    }
    let [cosine, sine] = sums;
    (cosine, sine)
}

fn product(a: &ExactMatrix, b: &ExactMatrix) -> ExactMatrix {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..3).map(|k| &a[i][k] * &b[k][j]).sum()))
}

/// The textbook matrix of a rotation about x, y or z.
fn elementary(axis: usize, angle: &BigRational) -> ExactMatrix {
    let (c, s) = series(angle);
    let (o, i) = (BigRational::zero, BigRational::one);
    match axis {
        0 => [[i(), o(), o()], [o(), c.clone(), -s.clone()], [o(), s, c]],
        1 => [[c.clone(), o(), s.clone()], [o(), i(), o()], [-s, o(), c]],
        _ => [[c.clone(), -s.clone(), o()], [s, c, o()], [o(), o(), i()]],
    }
}

fn rpy_matrix(rpy: &[BigRational; 3]) -> ExactMatrix {
    let [x, y, z] = [elementary(0, &rpy[0]), elementary(1, &rpy[1]), elementary(2, &rpy[2])];
    product(&product(&z, &y), &x)
}

fn assert_orthogonal(m: &ExactMatrix) {
    let transposed = std::array::from_fn(|i| std::array::from_fn(|j| m[j][i].clone()));
    assert_eq!(product(m, &transposed), ExactRotation::identity().matrix());
    let minor = |j: usize| &m[1][(j + 1) % 3] * &m[2][(j + 2) % 3] - &m[1][(j + 2) % 3] * &m[2][(j + 1) % 3];
    let determinant: BigRational = (0..3).map(|j| &m[0][j] * minor(j)).sum();
    assert!(determinant.is_one());
}

fn turns(rpy: &[BigRational; 3]) -> [Turn; 3] {
    rpy.each_ref().map(|angle| Turn::from_radians(angle).unwrap())
}

/// Decimals with the given number of digits after the point.
fn decimal(units: i64, digits: u32) -> BigRational {
    BigRational::new(units.into(), BigInt::from(10).pow(digits))
}

#[test]
fn decimals_of_multiples_of_a_quarter_turn_are_these() {
    let exactly = [
        ("0", 0),
        ("1.5708", 1),
        ("1.5707", 1),
        ("1.570796", 1),
        ("1.57079632679", 1),
        ("1.5707963267948966", 1),
        ("1.5707963267948968", 1),
        ("-1.5708", 3),
        ("3.1416", 2),
        ("3.14159", 2),
        ("-3.14159265359", 2),
        ("4.71239", 3),
        ("4.7124", 3),
        ("6.28319", 0),
        ("6.123e-17", 0),
    ];
    for (text, quarters) in exactly {
        let turn = Turn::from_radians(&exact(text)).unwrap().meant();
        let degrees = Turn::from_degrees(&whole(90 * quarters)).unwrap();
        assert_eq!(turn, degrees, "{text}");
        assert!(turn.is_exact(), "{text}");
    }
    for text in [
        "1.57",
        "1.571",
        "1.5706",
        "1.5709",
        "1.5708001",
        "3.1417",
        "0.0001",
        "1e-14",
        "3.14",
        "0.785",
        "0.7855",
        "0.2618",
    ] {
        assert!(!Turn::from_radians(&exact(text)).unwrap().meant().is_exact(), "{text}");
    }
    let thirds = [
        ("0.7854", 45),
        ("-0.785398", 315),
        ("2.35619", 135),
        ("0.5236", 30),
        ("0.5235", 30),
        ("1.0471975512", 60),
        ("-2.0944", 240),
    ];
    for (text, degrees) in thirds {
        let turn = Turn::from_radians(&exact(text)).unwrap().meant();
        assert_eq!(
            (turn, turn.degrees()),
            (Turn::from_degrees(&whole(degrees)).unwrap(), Some(degrees as u16)),
            "{text}"
        );
        assert!(!turn.is_quarter());
    }
    assert!(Turn::from_radians(&exact("1e300")).is_err() && Turn::from_degrees(&exact("-1e12")).is_err());
}

#[test]
fn quarter_turns_are_whole_matrices() {
    for axis in 0..3 {
        for quarters in -4..5 {
            let turn = Turn::from_degrees(&whole(90 * quarters)).unwrap();
            let matrix = ExactRotation::about(axis, turn).matrix();
            assert_orthogonal(&matrix);
            assert!(matrix.iter().flatten().all(|entry| entry.is_integer() && entry.abs() <= whole(1)));
            // The image of the next axis, by the right-hand rule.
            let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
            let image = [[1, 0], [0, 1], [-1, 0], [0, -1]][quarters.rem_euclid(4) as usize];
            assert_eq!([&matrix[u][u], &matrix[v][u]], [&whole(image[0]), &whole(image[1])]);
        }
    }
}

/// Two rotations by 45 degrees are exactly a quarter turn, so are 30 and 60, and -45 is the inverse of 45.
#[test]
fn sums_of_45_and_30_degrees_are_exact() {
    for axis in 0..3 {
        let about = |degrees: i64| ExactRotation::about(axis, Turn::from_degrees(&whole(degrees)).unwrap());
        for (parts, sum) in [
            (vec![45, 45], 90),
            (vec![30, 60], 90),
            (vec![30, 30, 30], 90),
            (vec![45, -45], 0),
            (vec![60, 60, 60], 180),
            (vec![45, 30, -30, 225], 270),
        ] {
            let product = parts.iter().map(|degrees| about(*degrees)).reduce(|a, b| a.then(&b)).unwrap();
            assert_eq!(product, about(sum), "{parts:?}");
        }
    }
}

/// Compared with the power series: the rational matrix of a multiple of 15 degrees is orthogonal and within 1e-16.
#[test]
fn steps_have_their_sines() {
    for axis in 0..3 {
        for degrees in (-360..=360).step_by(15).filter(|degrees| degrees % 30 == 0 || degrees % 45 == 0) {
            let pi = exact("3.14159265358979323846264338327950288");
            let given = ExactRotation::about(axis, Turn::from_degrees(&whole(degrees)).unwrap()).matrix();
            let wanted = elementary(axis, &(pi * whole(degrees) / whole(180)));
            assert_orthogonal(&given);
            for (a, b) in given.iter().flatten().zip(wanted.iter().flatten()) {
                assert!((a - b).abs() < exact("1e-16"), "{degrees}: {}", a - b);
            }
        }
    }
}

#[test]
fn quaternions_of_any_length() {
    let half_turn = ExactRotation::from_quaternion(&[0, 0, 3, 0].map(whole)).unwrap();
    assert_eq!(half_turn, ExactRotation::about(2, Turn::from_degrees(&whole(180)).unwrap()));
    let quarter = ["0.7071068", "0", "0", "0.7071068"].map(exact);
    let quarter = ExactRotation::from_quaternion(&quarter).unwrap();
    assert_eq!(quarter, ExactRotation::about(0, Turn::from_degrees(&whole(90)).unwrap()));
    assert_eq!(ExactRotation::from_quaternion(&[0; 4].map(whole)), None);
}

proptest! {
    #![proptest_config(crate::cases(64))]

    #[test]
    fn any_angles_give_an_orthogonal_matrix_within_1e_15(
        units in prop::array::uniform3(-7_000_000_000i64..7_000_000_000),
        digits in prop::array::uniform3(6u32..10),
    ) {
        let rpy: [BigRational; 3] = std::array::from_fn(|i| decimal(units[i] / 10i64.pow(9 - digits[i]), digits[i]));
        prop_assume!(turns(&rpy).iter().all(|turn| !turn.is_exact()));
        let rotation = ExactRotation::from_rpy(turns(&rpy));
        let (given, wanted) = (rotation.matrix(), rpy_matrix(&rpy));
        assert_orthogonal(&given);
        for (a, b) in given.iter().flatten().zip(wanted.iter().flatten()) {
            prop_assert!((a - b).abs() < exact("1e-15"), "{}", a - b);
        }
    }

    #[test]
    fn placements_are_a_group(
        numbers in prop::array::uniform12(-3000i64..3000),
    ) {
        let value = |i: usize| decimal(numbers[i], 3);
        let placement = |i: usize| Placement {
            meant: None,
            rotation: ExactRotation::from_rpy(turns(&[value(i), value(i + 1), value(i + 2)])),
            origin: [value(i + 3), value(i + 4), value(i + 5)],
        };
        let (a, b) = (placement(0), placement(6));
        prop_assert_eq!(a.then(&a.inverse()), Placement::identity());
        prop_assert_eq!(a.then(&b).inverse(), b.inverse().then(&a.inverse()));
        prop_assert_eq!(product(&a.rotation.matrix(), &b.rotation.matrix()), a.then(&b).rotation.matrix());
        let columns: ExactVector = a.rotation.turn(&b.origin);
        let by_matrix: ExactVector =
            std::array::from_fn(|i| (0..3).map(|k| &a.rotation.matrix()[i][k] * &b.origin[k]).sum());
        prop_assert_eq!(columns, by_matrix);
    }
}
