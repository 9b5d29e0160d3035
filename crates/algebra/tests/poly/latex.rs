//! LaTeX of names, and the LaTeX parser.

use groebot_algebra::ErrorKind;
use groebot_algebra::number::Rationals;
use groebot_algebra::poly::{Expression, latex_name, parse, parse_latex};
use proptest::prelude::*;

#[test]
fn names_are_written_by_their_form() {
    let written = [
        ("x", "x"),
        ("c4", "c_{4}"),
        ("L12", "L_{12}"),
        ("c04", "c_{04}"),
        ("py", "\\mathit{py}"),
        ("phi2", "\\mathit{phi}_{2}"),
        ("x_1", "\\mathrm{x\\_1}"),
        ("a1b", "\\mathrm{a1b}"),
        ("_", "\\mathrm{\\_}"),
        ("_1", "\\mathrm{\\_1}"),
    ];
    for (name, latex) in written {
        assert_eq!(latex_name(name), latex);
    }
}

#[test]
fn latex_reads_as_its_plain_text() {
    let pairs = [
        (r"\frac{3}{2} x^{2} y", "3/2*x^2*y"),
        (r"-\frac{3}{2} c_{4}^{2} + s_4^2 - 1", "-3/2*c4^2 + s4^2 - 1"),
        (r"\left( x + 1 \right)^{10} \left(y\right)", "(x+1)^10*y"),
        (r"2 \cdot 3 \cdot -x", "2*3*(-x)"),
        (r"xy", "x*y"),
        (r"2x\,y", "2*x*y"),
        (r"\frac{x + y}{\frac{1}{2} - \mathit{py}}^2", "((x+y)/(1/2-py))^2"),
        (r"\mathrm{long\_name}^{2} - \mathit{phi}_{2} e_{1}", "long_name^2 - phi2*e1"),
        (r"102.9 x (y)", "102.9*x*y"),
    ];
    let values =
        |name: &str| Some(groebot_algebra::number::BigRational::from_integer((7 + name.len() as i64 * 3).into()));
    for (latex, text) in pairs {
        let (read, plain) = (parse_latex(latex).unwrap_or_else(|e| panic!("{latex}: {e}")), parse(text).unwrap());
        assert_eq!(read.names(), plain.names(), "{latex}");
        let value = |tree: &Expression| tree.evaluate_with(&Rationals, &values).unwrap();
        assert_eq!(value(&read), value(&plain), "{latex}");
    }
}

#[test]
fn mistakes_name_their_column() {
    let mistakes = [
        (r"\frac{1}2", "column 9"),
        (r"\frac 1 2", "column 7"),
        (r"x^23", "column 3"),
        (r"x^{1001}", "column 4"),
        (r"x^{2", "column 5"),
        (r"x_{ab}", "column 3"),
        (r"x_12", "column 3"),
        (r"x_", "column 3"),
        (r"\sin x", "column 1"),
        (r"\left[ x", "column 6"),
        (r"\mathit{a_1}", "column 8"),
        (r"\mathrm{1a}", "column 1"),
        (r"\mathrm{a_1}", "column 1"),
        (r"2 3", "column 3"),
        (r"x/y", "column 2"),
        (r"x*y", "column 2"),
        (r"{x}", "column 1"),
        (r"\", "column 1"),
        ("", "column 1"),
    ];
    for (latex, column) in mistakes {
        let error = parse_latex(latex).expect_err(latex);
        assert_eq!(error.kind(), ErrorKind::Syntax);
        assert!(error.message().starts_with(&format!("{column}:")), "{latex}: {error}");
    }
}

proptest! {
    #![proptest_config(crate::cases(256))]

    #[test]
    fn names_read_back(name in "[A-Za-z_][A-Za-z0-9_]{0,8}") {
        prop_assert_eq!(parse_latex(&latex_name(&name)).unwrap(), Expression::Name(name));
    }

    #[test]
    fn names_side_by_side_read_back(names in proptest::collection::vec("[A-Za-z_][A-Za-z0-9_]{0,3}", 2..5)) {
        let latex: Vec<String> = names.iter().map(|name| latex_name(name)).collect();
        let read = parse_latex(&latex.join(" ")).unwrap();
        prop_assert_eq!(read, Expression::Product(names.into_iter().map(Expression::Name).collect()));
    }

    #[test]
    fn noise_never_panics(text in "\\PC*", likely in r"[\\{}_^a1. ()+-]{0,20}", word in r"(\\(frac|left|right|mathit|mathrm|cdot|,)|[{}()x_^2]){0,12}") {
        let _ = (parse_latex(&text), parse_latex(&likely), parse_latex(&word));
    }
}
