//! Invalid systems: each is refused with its line and column, and with the allowed values.

use groebot_algebra::ErrorKind::{
    self, BadValue, DuplicateName, MissingKey, Syntax, UnknownKey, UnknownName, Unsupported,
};
use groebot_algebra::Watch;
use groebot_algebra::number::Rationals;
use groebot_algebra::poly::Fractions;
use groebot_algebra::poly::system::{Format, MAX_SYSTEM_LENGTH, PolynomialSystem};

/// Text, kind, line, column, and a word of the message.
type Case<'a> = (&'a str, ErrorKind, usize, usize, &'a str);

fn refuse(format: Format, cases: &[Case<'_>]) {
    for &(text, kind, line, column, word) in cases {
        let error = PolynomialSystem::read(text, Some(format)).expect_err(text);
        let start = format!("line {line}: column {column}: ");
        assert!(error.to_string().starts_with(&start), "{text:?}: {error}");
        assert!(error.message().contains(word), "{text:?}: {error}");
        assert_eq!(error.kind(), kind, "{text:?}: {error}");
    }
}

#[test]
fn plain_text() {
    refuse(
        Format::Plain,
        &[
            ("", Syntax, 1, 1, "no polynomial"),
            ("variables: x\n# nothing\n", Syntax, 3, 1, "no polynomial"),
            ("x + (y", Syntax, 1, 7, "`)` expected"),
            ("x\ny + (z\nx", Syntax, 2, 7, "found `the end of the line`"),
            ("x\r\n  y z\r\n", Syntax, 2, 5, "write `y*z`"),
            ("x = y = z", Syntax, 1, 7, "once"),
            ("x^1001", Syntax, 1, 3, "from 0 to 1000"),
            ("x^99999999999999999999999", Syntax, 1, 3, "from 0 to 1000"),
            ("x\n\u{0}", Syntax, 2, 1, "`\\0` is not allowed"),
            ("x\ny + é", Syntax, 2, 5, "allowed are numbers, names"),
            ("x; y", Syntax, 1, 2, "`;`"),
            ("x, y", Syntax, 1, 2, "found `,`"),
            ("order: dp\nx", Syntax, 1, 8, "`lex`"),
            ("order: block:2\nx + y + z", BadValue, 1, 8, "cover the 3 variables"),
            ("order: block:1000,1000\nx + y", BadValue, 1, 8, "cover the 2 variables"),
            ("order: lex lex\nx", Syntax, 1, 12, "the end of the line expected"),
            ("characteristic: 9\nx", BadValue, 1, 17, "not a prime"),
            ("characteristic: 2305843009213693967\nx", BadValue, 1, 17, "not a prime"),
            ("characteristic: 99999999999999999999\nx", Syntax, 1, 17, "0 or a prime"),
            ("characteristic: -7\nx", Syntax, 1, 17, "0 or a prime"),
            ("variables: x, y, x\nx", DuplicateName, 1, 18, "`x`"),
            ("variables: x, y\nparameters: y\nx", DuplicateName, 2, 13, "`y`"),
            ("variables: x\nvariables: y\nx", DuplicateName, 2, 1, "twice"),
            ("variables: x,\nx", Syntax, 1, 14, "a name expected"),
            ("variables: x\nx*y", UnknownName, 2, 3, "declared are x"),
            ("x\nvariables: x", Syntax, 2, 1, "before the first polynomial"),
            ("name: circle\nx", UnknownKey, 1, 1, "`variables`"),
            ("variables: x\n  1 + 1/x", BadValue, 2, 3, "divides by a variable"),
            ("3", MissingKey, 1, 2, "declare some"),
            ("parameters: a\na + 1", MissingKey, 2, 6, "declare some"),
        ],
    );
}

#[test]
fn singular() {
    refuse(
        Format::Singular,
        &[
            ("", Syntax, 1, 1, "no ring"),
            ("// only a comment", Syntax, 1, 18, "no ring"),
            ("ring r=0,(x,y),dp;", Syntax, 1, 19, "no polynomial"),
            ("ideal i = x;", Syntax, 1, 1, "a ring is required"),
            ("ring r = 0,(x,y),ds; ideal i = x;", Unsupported, 1, 18, "`ds`"),
            ("ring r = 0,(x,y),(dp(1),wp(2)); ideal i = x;", Unsupported, 1, 25, "`wp`"),
            ("ring r = 0,(x,y),(dp(1)); ideal i = x;", BadValue, 1, 18, "cover the 2 variables"),
            ("ring r = 0,(x,y),(dp(2),lp); ideal i = x;", BadValue, 1, 25, "cover all"),
            ("ring r = 8,(x,y),dp; ideal i = x;", BadValue, 1, 10, "not a prime"),
            ("ring r = real,(x,y),dp; ideal i = x;", Syntax, 1, 10, "characteristic"),
            ("ring r = 0,(x,x),dp; ideal i = x;", DuplicateName, 1, 15, "`x`"),
            ("ring r = (0,a),(x,a),dp; ideal i = x;", DuplicateName, 1, 19, "`a`"),
            ("ring r = 0,(x1,x(1..2)),dp; ideal i = x1;", DuplicateName, 1, 16, "`x1`"),
            ("ring r = 0,(x(1..1000000000)),dp; ideal i = x(1);", BadValue, 1, 13, "at most 1000 names"),
            ("ring r = 0,(x(1..600),y(1..600)),dp; ideal i = x(1);", BadValue, 1, 23, "more than 1000"),
            ("ring r = 0,(x(3..1)),dp; ideal i = x(1);", BadValue, 1, 13, "must increase"),
            ("ring r = 0,(x,y),dp;\nideal i = x,\n  y + w;", UnknownName, 3, 7, "`w`"),
            ("ring r = 0,(x,y),dp; ideal i = 3xz;", UnknownName, 1, 32, "`3xz`"),
            ("ring r = 0,(x1,x2),dp; ideal i = x1x2;", UnknownName, 1, 34, "`x1x2`"),
            ("ring r = 0,(x(1..2)),dp; ideal i = x(3);", UnknownName, 1, 36, "`x3`"),
            ("ring r = 0,(x,y),dp; ideal i = 2(x+y);", Syntax, 1, 33, "`2*(`"),
            ("ring r = 0,(x,y),dp; ideal i = x9999;", Syntax, 1, 32, "from 0 to 1000"),
            ("ring r = 0,(x,y),dp; ideal i = x + 1.5;", Syntax, 1, 37, "found `.`"),
            ("ring r = 0,(x,y),dp; ideal i = 1/x;", BadValue, 1, 32, "divides by a variable"),
            ("ring r = 0,(x,y),dp; ideal i = 1/3/x;", BadValue, 1, 32, "divides by a variable"),
            ("ring r = 0,(x,y),dp; ideal i = x, y", Syntax, 1, 36, "`;` expected"),
            ("ring r = 0,(x,y),dp; ideal i = x, ;", Syntax, 1, 35, "found `;`"),
            ("ring r = 0,(x,y),dp; ideal i = (x, y);", Syntax, 1, 34, "`)` expected, found `,`"),
            ("ring r = 0,(x,y),dp; ideal i = x; ideal j = y;", Unsupported, 1, 35, "second ideal"),
            ("ring r = 0,(x,y),dp; ring s = 0,x,dp;", Unsupported, 1, 22, "second ring"),
            ("ring r = 0,(x,y),dp; poly f = x; poly f = y;", DuplicateName, 1, 39, "`f`"),
            ("ring r = 0,(x,y),dp; poly f = x; ideal i = f^2;", Unsupported, 1, 44, "element of the ideal"),
            ("ring r = 0,(x,y),dp; ideal i = x;\nideal j = std(i);", Unsupported, 2, 1, "second ideal"),
            ("LIB \"primdec.lib\";\nring r = 0,(x,y),dp;", Syntax, 1, 5, "`\\\"`"),
            ("option(redSB);\nring r = 0,(x,y),dp;", Unsupported, 1, 1, "`option`"),
            ("ring r = 0,(x,y),dp;\n/* never closed\nideal i = x;", Syntax, 2, 1, "`*/`"),
            ("ring r = 0,(x,y),dp; ideal i = x; $", Syntax, 1, 35, "`$`"),
        ],
    );
}

#[test]
fn msolve() {
    refuse(
        Format::Msolve,
        &[
            ("", Syntax, 1, 1, "a variable expected"),
            ("x, y\n", Syntax, 2, 1, "characteristic"),
            ("x, y\n0\n", Syntax, 3, 1, "no polynomial"),
            ("x, x\n0\nx", DuplicateName, 1, 4, "`x`"),
            ("x, y\n10\nx", BadValue, 2, 1, "not a prime"),
            ("x, y\n0\nx + y,\nx*z", UnknownName, 4, 3, "`z`"),
            ("x, y\n0\nx + y,,\nx", Syntax, 3, 7, "found `,`"),
            ("x, y\n0\nx = y", Syntax, 3, 3, "`=`"),
            ("x, y\n0\nx + 0.5", Syntax, 3, 6, "`.`"),
            ("x, y\n0\nx\ny", Syntax, 4, 1, "write `x*y`"),
            ("x, y\n0\nx^", Syntax, 3, 3, "exponent"),
        ],
    );
}

#[test]
fn deep_and_long_texts() {
    let deep = format!("x\n{}y{}\n", "(".repeat(201), ")".repeat(201));
    refuse(Format::Plain, &[(&deep, Syntax, 2, 200, "nested deeper than 200")]);
    let signs = format!("x, y\n0\n{}", "-".repeat(100_000));
    refuse(Format::Msolve, &[(&signs, Syntax, 3, 202, "nested")]);
    let many = format!("x\n{}", "x+".repeat(600_000));
    refuse(Format::Plain, &[(&many, Syntax, 2, 1_000_001, "more than 1000000 words")]);
    let names = (0..1001).map(|k| format!("x{k}")).collect::<Vec<_>>().join("+");
    refuse(Format::Plain, &[(&names, BadValue, 1, 1, "more than 1000 variables")]);
    let long = " ".repeat(MAX_SYSTEM_LENGTH + 1);
    let error = PolynomialSystem::read(&long, None).unwrap_err();
    assert!(error.to_string().contains("16000001 bytes long"), "{error}");
}

#[test]
fn bytes_that_are_no_text() {
    let error = PolynomialSystem::read_bytes(b"x + y\n\xc3\xa9 + \xff", None).unwrap_err();
    assert_eq!(
        (error.kind(), error.to_string().as_str()),
        (Syntax, "line 2: column 5: the text is not UTF-8; save the file as UTF-8")
    );
}

#[test]
fn expansions_without_end() {
    let cases = [
        ("x\n (x + y + z + w)^1000", 2, 2),
        ("x\ny\n(1e4000*x)^1000", 3, 1),
        ("((x^1000)^1000)^1000", 1, 1),
        ("x + 1/(1 - 1)", 1, 1),
    ];
    for (text, line, column) in cases {
        let system = PolynomialSystem::read(text, None).unwrap();
        let ring = system.heading.ring(Rationals).unwrap();
        let error = system.expand(&ring, &Watch::none()).unwrap_err();
        assert!(error.to_string().starts_with(&format!("line {line}: column {column}: ")), "{error}");
        assert_eq!(error.kind(), BadValue);
    }
    for text in ["x\n 1/(a^60 + 1)^2", "x + a^101", "x + y/(a - a)"] {
        let system = PolynomialSystem::read(&format!("parameters: a\nvariables: x, y\n{text}"), None).unwrap();
        let ring = system.heading.ring(Fractions::new(Rationals, &["a"]).unwrap()).unwrap();
        assert_eq!(system.expand(&ring, &Watch::none()).unwrap_err().kind(), BadValue, "{text}");
    }
    let modulo = PolynomialSystem::read("characteristic: 7\nx\nx - 1/14", None).unwrap();
    let error = modulo.print(Format::Plain).unwrap_err();
    assert!(error.to_string().starts_with("line 3: column 1: division by `14`"), "{error}");
}

#[test]
fn formats_without_a_place_for_it() {
    let parametric = PolynomialSystem::read("parameters: a\nx + a", None).unwrap();
    assert_eq!(parametric.print(Format::Msolve).unwrap_err().kind(), Unsupported);
    let underscore = PolynomialSystem::read("_x + y", None).unwrap();
    assert_eq!(underscore.print(Format::Singular).unwrap_err().kind(), Unsupported);
}
