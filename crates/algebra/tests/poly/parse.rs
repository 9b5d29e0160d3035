//! The plain-text parser: precedence, limits, and each error with its column.

use groebot_algebra::ErrorKind;
use groebot_algebra::poly::{Expression, MAX_DEPTH, MAX_LENGTH, parse, parse_equation};
use proptest::prelude::*;

fn value(text: &str) -> f64 {
    let values = |name: &str| match name {
        "x" => Some(3.0),
        "y" => Some(-2.0),
        "c_4" => Some(0.5),
        _ => None,
    };
    parse(text).unwrap_or_else(|e| panic!("{text}: {e}")).evaluate_f64(&values).unwrap()
}

#[test]
fn precedence_is_the_usual_one() {
    assert_eq!(value("1 + 2*x"), 7.0);
    assert_eq!(value("-x^2"), -9.0);
    assert_eq!(value("(-x)^2"), 9.0);
    assert_eq!(value("2 - 3 - 4"), -5.0);
    assert_eq!(value("2 - (3 - 4)"), 3.0);
    assert_eq!(value("24/4/3"), 2.0);
    assert_eq!(value("24/(4/2)"), 12.0);
    assert_eq!(value("24/4*3"), 18.0);
    assert_eq!(value("2*-x^2"), -18.0);
    assert_eq!(value("x - -y"), 1.0);
    assert_eq!(value("x--y"), 1.0);
    assert_eq!(value("+x*+y"), -6.0);
    assert_eq!(value("--x"), 3.0);
    assert_eq!(value("2*x^3*c_4"), 27.0);
    assert_eq!(value("x^0 + 0^0"), 2.0);
    assert_eq!(value("\n x\t+\r\n1 "), 4.0);
    assert_eq!(value("1.5e-3*1E3 + .5 + 102.9"), 104.9);
    assert_eq!(value("2/3^2*9"), 2.0);
}

#[test]
fn trees_stay_flat() {
    let sum = parse("x - y*2/3 + 4").unwrap();
    let product = Expression::Product(vec![
        Expression::name("y"),
        Expression::integer(2),
        Expression::Inverse(Box::new(Expression::integer(3))),
    ]);
    assert_eq!(sum, Expression::Sum(vec![Expression::name("x"), product.negated(), Expression::integer(4)]));
}

#[test]
fn equations_are_differences() {
    let same = |equation: &str, expression: &str| {
        assert_eq!(parse_equation(equation).unwrap().to_string(), expression, "{equation}");
    };
    same("L1*c2 + L2*s4 - pz = 0", "L1*c2 + L2*s4 - pz");
    same("L1*c2 + L2*s4", "L1*c2 + L2*s4");
    same("c^2 + s^2 = 1", "c^2 + s^2 - 1");
    same("a = b - c + d", "a - b + c - d");
    same("a = -(b - c)", "a + (b - c)");
    same("0 = a", "0 - a");
}

fn refused(result: groebot_algebra::Result<Expression>, parts: &[&str]) {
    let error = result.expect_err(parts[0]);
    assert_eq!(error.kind(), ErrorKind::Syntax);
    for part in parts {
        assert!(error.to_string().contains(part), "`{error}` lacks `{part}`");
    }
}

#[test]
fn mistakes_name_their_column_and_what_is_allowed() {
    refused(parse("(x + y"), &["column 7", "`)` expected", "end of text"]);
    refused(parse("x)"), &["column 2", "has no matching"]);
    refused(parse(""), &["column 1", "a number, a name"]);
    refused(parse("   "), &["column 4", "a number, a name"]);
    refused(parse("x + "), &["column 5"]);
    refused(parse("x*/y"), &["column 3", "found `/`"]);
    refused(parse("x**2"), &["column 3", "found `*`"]);
    refused(parse("2x"), &["column 2", "write `2*x`"]);
    refused(parse("2e"), &["column 2", "write `2*e`"]);
    refused(parse("2e+x"), &["column 2", "write `2*e`"]);
    refused(parse("x y"), &["column 3", "write `x*y`"]);
    refused(parse("sin(x)"), &["column 4", "write `sin*(`"]);
    refused(parse("(x)(y)"), &["column 4", "write `)*(`"]);
    refused(parse("x^-1"), &["column 3", "from 0 to 1000"]);
    refused(parse("x^y"), &["column 3", "integer exponent"]);
    refused(parse("x^1.0"), &["column 3", "integer exponent"]);
    refused(parse("x^1e2"), &["column 3", "integer exponent"]);
    refused(parse("x^(2)"), &["column 3", "integer exponent"]);
    refused(parse("x^1001"), &["column 3", "from 0 to 1000"]);
    refused(parse("x^99999999999999999999"), &["column 3", "from 0 to 1000"]);
    refused(parse("x^2^3"), &["column 4", "(x^2)^3"]);
    refused(parse("1.2.3"), &["column 1", "not an exact number"]);
    refused(parse("1e5000"), &["column 1", "not an exact number"]);
    refused(parse("."), &["column 1", "not an exact number"]);
    refused(parse("é + 1"), &["column 1", "`é`"]);
    refused(parse("x + ×"), &["column 5", "`×`"]);
    refused(parse("x = 0"), &["column 3", "`=`"]);
    refused(parse_equation("x = y = 0"), &["column 7", "once"]);
    refused(parse_equation("(x = y)"), &["column 4", "`)` expected"]);
    refused(parse_equation("= 0"), &["column 1"]);
    refused(parse_equation("x ="), &["column 4"]);
}

#[test]
fn a_power_of_a_thousand_is_read() {
    assert_eq!(parse("x^1000").unwrap(), Expression::name("x").power(1000));
}

#[test]
fn deep_and_long_texts_are_bounded() {
    let nested = |depth: usize| format!("{}x{}", "(".repeat(depth), ")".repeat(depth));
    assert!(parse(&nested(MAX_DEPTH)).is_ok());
    refused(parse(&nested(MAX_DEPTH + 1)), &["column 201", "nested deeper than 200"]);
    refused(parse(&"-".repeat(100_000)), &["nested"]);
    refused(parse(&"(".repeat(MAX_LENGTH + 1)), &["bytes long"]);
}

#[test]
fn a_long_sum_is_read_printed_and_evaluated() {
    let sum = parse(&vec!["x"; 100_000].join("+")).unwrap();
    assert_eq!(sum.evaluate_f64(&|_| Some(1.0)).unwrap(), 100_000.0);
    assert_eq!(parse(&sum.to_string()).unwrap(), sum);
    let product = parse(&vec!["x"; 100_000].join("/")).unwrap();
    assert_eq!(product.evaluate_f64(&|_| Some(1.0)).unwrap(), 1.0);
    assert_eq!(parse(&product.to_string()).unwrap(), product);
}

#[test]
fn the_deepest_tree_fits_a_small_stack() {
    let text = format!("{}x{}", "1/(2 - 3*(-".repeat(MAX_DEPTH / 2), "))^2".repeat(MAX_DEPTH / 2));
    let work = move || {
        let tree = parse(&text).unwrap();
        assert_eq!(parse(&tree.to_string()).unwrap(), tree);
        assert!(tree.evaluate_f64(&|_| Some(1.0)).is_ok() && tree.expansion_bound().terms > 0.0);
        assert_eq!(tree.clone().names(), ["x"]);
    };
    std::thread::Builder::new().stack_size(1 << 20).spawn(work).unwrap().join().unwrap();
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn noise_never_panics(text in "\\PC*") {
        let _ = (parse(&text), parse_equation(&text));
    }

    #[test]
    fn likely_noise_never_panics_and_what_is_read_prints_as_the_same_tree(text in "[-xy_a2.e0+*/^()= \n]{0,30}") {
        let _ = parse_equation(&text);
        if let Ok(tree) = parse(&text) {
            prop_assert_eq!(parse(&tree.to_string()).unwrap(), tree);
        }
    }
}
