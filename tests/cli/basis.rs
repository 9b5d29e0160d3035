//! `groebot basis`: the results equal Singular's in all formats, and an interrupted run writes nothing.

use std::fs;

use groebot::Watch;
use groebot::files::MARK;
use groebot::groebner::verify::{Claim, verify};
use groebot::number::{Field, Rationals, Ring, Zp};
use groebot::poly::system::{Format, PolynomialSystem, parse_order};
use groebot::poly::{Fractions, Polynomial, PolynomialRing, parse};
use serde_json::Value;
use tempfile::tempdir;

use super::{content, refused, run, run_on, text};

/// The basis of `system`, one polynomial per line, and the summary.
fn basis(system: &str, arguments: &[&str]) -> (Vec<String>, String) {
    let ran = run_on(&[&["basis", "-"], arguments].concat(), system.as_bytes());
    assert_eq!(ran.code, 0, "{}", ran.err);
    let lines = ran.out.lines().skip_while(|line| !line.is_empty()).skip(1);
    (lines.map(str::to_owned).collect(), ran.err)
}

const CYCLIC: &str = "order: lex\nx + y + z = 0\nx*y + y*z + z*x\nx*y*z = 1\n";
const CIRCLE: &str = "ring r = (0,a,b),(x,y),lp; ideal i = x2 + y2 - a, xy - b;";

// Results of Singular 4.3.1 for all of them, as in `ring r = 0,(x,y,z),lp; short = 0; option(redSB); ideal i = ...;
// ideal s = simplify(std(i),1); s; dim(s); vdim(s);`
#[test]
fn the_answers_are_those_of_singular() {
    let (list, summary) = basis(CYCLIC, &[]);
    assert_eq!(list, ["z^3 - 1", "y^2 + y*z + z^2", "x + y + z"]);
    assert!(summary.starts_with("3 elements over Q, lex; dimension 0, degree 6; "), "{summary}");

    let modular = "x, y, z\n0\nx^2 + y^2 - z, x*y - 3*z + 1,\nz^2 - 1/2*x";
    let (list, summary) = basis(modular, &["--characteristic", "32003", "--output-format", "plain"]);
    let expected = ["z^2 + 16001*x", "x*y + 32000*z + 1", "x^2 + y^2 + 32002*z", "y^3 + 3*x*z + 32002*y*z + 32002*x"];
    assert_eq!(list, expected);
    assert!(summary.starts_with("4 elements over GF(32003), grevlex; dimension 0, degree 8; "), "{summary}");

    let blocks = "variables: x, y, z\nx^2 = y*z\nx*y = z";
    let expected = ["y^3*z - z^2", "x*z - y^2*z", "x*y - z", "x^2 - y*z"];
    let (list, summary) = basis(blocks, &["--order", "block:1,2"]);
    assert_eq!(list, expected);
    assert!(summary.contains("over Q, grevlex(1) > grevlex(2); dimension 1, free: "), "{summary}");
    assert_eq!(basis(blocks, &["--order", "grevlex(1),grevlex(2)"]).0, expected);
}

#[test]
fn parameters_are_coefficients() {
    let (list, summary) = basis(CIRCLE, &["--output-format", "plain"]);
    assert_eq!(list, ["y^4 - a*y^2 + b^2", "x + (1)/(b)*y^3 + (-a)/(b)*y"]);
    assert!(summary.starts_with("2 elements over Q(a, b), lex; dimension 0, degree 4; "), "{summary}");
    let (modular, summary) = basis(CIRCLE, &["--output-format", "plain", "--characteristic", "7"]);
    assert_eq!(modular, ["y^4 + 6*a*y^2 + b^2", "x + (1)/(b)*y^3 + (6*a)/(b)*y"]);
    assert!(summary.contains("over GF(7)(a, b)"), "{summary}");
}

#[test]
fn variables_are_eliminated() {
    let cubic = "x = t\ny = t^2\nz = t^3\n";
    let (list, summary) = basis(cubic, &["--eliminate", "t"]);
    assert_eq!(list, ["y^2 - x*z", "x*y - z", "x^2 - y"]);
    assert!(summary.contains("3 elements over Q, grevlex; dimension 1"), "{summary}");
    // Of y = t^2 and z = t^3 only the cusp remains.
    assert_eq!(basis(cubic, &["--eliminate", "t,x"]).0, ["y^3 - z^2"]);
    let cubic = format!("order: block:1,3\n{cubic}");
    assert_eq!(basis(&cubic, &["--eliminate", "t,x", "--order", "lex"]).0, ["y^3 - z^2"]);
}

#[test]
fn zero_and_unit_ideals() {
    let (list, summary) = basis("variables: x, y\n0\nx - x", &[]);
    assert_eq!(list, ["0"]);
    assert!(summary.starts_with("0 elements over Q, grevlex; dimension 2, free: x, y"), "{summary}");
    let (list, summary) = basis("x - 1\nx - 2", &[]);
    assert_eq!(list, ["1"]);
    assert!(summary.starts_with("1 element over Q, grevlex; no solution"), "{summary}");
}

#[test]
fn a_degree_beyond_counting_is_reported() {
    let (_, summary) = basis("x^1000 - 1\ny^1000 - 1\nz^1000 - 1", &[]);
    assert!(summary.contains("dimension 0, degree over 1000000"), "{summary}");
}

#[test]
fn every_format_reports_the_same_and_is_read_again() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("basis");
    let (plain, _) = basis(CYCLIC, &[]);
    for format in ["plain", "singular", "msolve"] {
        let ran = run_on(&["basis", "-", "--quiet", "-o", text(&file), "--output-format", format], CYCLIC.as_bytes());
        assert_eq!((ran.code, ran.out.as_str(), ran.err.as_str()), (0, "", ""));
        let again = run(&["basis", text(&file), "--order", "lex", "--output-format", "plain"]);
        let lines: Vec<&str> = again.out.lines().skip_while(|line| !line.is_empty()).skip(1).collect();
        assert_eq!(lines, plain, "a basis is its own basis");
        let written = fs::read_to_string(&file).unwrap();
        let unmarked: String =
            written.lines().filter(|line| !line.contains(MARK)).map(|line| format!("{line}\n")).collect();
        assert_eq!(run(&["basis", text(&file), "--order", "lex"]).out, unmarked, "the same format");
        assert_eq!(written == unmarked, format == "msolve", "its format has no comments");
    }
}

/// Checks the claims of the certificate `json` over `field`.
fn check_certificate<F: Field>(json: &Value, field: F) -> groebot::Result<()> {
    let list = |value: &Value| -> Vec<String> {
        value.as_array().unwrap().iter().map(|text| text.as_str().unwrap().to_owned()).collect()
    };
    let order = parse_order(json["order"].as_str().unwrap())?;
    let ring = PolynomialRing::new(field, &list(&json["variables"]), order)?;
    let read = |value: &Value| -> Vec<Polynomial<F::Element>> {
        list(value).iter().map(|text| parse(text).unwrap().evaluate(&ring).unwrap()).collect()
    };
    let (generators, basis) = (read(&json["generators"]), read(&json["basis"]));
    let cofactors: Vec<_> = json["cofactors"].as_array().unwrap().iter().map(read).collect();
    for (g, row) in basis.iter().zip(&cofactors) {
        let products = row.iter().zip(&generators).map(|(c, f)| ring.mul(c, f));
        assert_eq!(products.fold(ring.zero(), |sum, product| ring.add(&sum, &product)), *g);
    }
    verify(&ring, &Claim { generators: &generators, basis: &basis, cofactors: &cofactors }, &Watch::none()).map(drop)
}

#[test]
fn a_certificate_proves_the_basis() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("system.txt");
    let json =
        || serde_json::from_str::<Value>(&fs::read_to_string(folder.path().join("system.certificate.json")).unwrap());
    let prove = |system: &str, more: &[&str]| {
        fs::write(&file, system).unwrap();
        let ran = run(&[&["basis", text(&file), "--certificate"], more].concat());
        assert_eq!(ran.code, 0, "{}", ran.err);
        assert!(ran.err.contains("; proved; "), "{}", ran.err);
        json().unwrap()
    };
    check_certificate(&prove(CYCLIC, &[]), Rationals).unwrap();
    check_certificate(&prove(CYCLIC, &["--characteristic", "101"]), Zp::new(101).unwrap()).unwrap();
    check_certificate(&prove(CIRCLE, &[]), Fractions::new(Rationals, &["a", "b"]).unwrap()).unwrap();
    let eliminated = prove("x = t^2\ny = t^3", &["--eliminate", "t"]);
    assert_eq!(eliminated["eliminated"], serde_json::json!(["t"]));
    check_certificate(&eliminated, Rationals).unwrap();
    let named = folder.path().join("proof");
    let ran = run_on(&["basis", "-", &format!("--certificate={}", text(&named))], CYCLIC.as_bytes());
    assert_eq!((ran.code, named.exists()), (0, true), "{}", ran.err);
}

#[test]
fn bad_files_are_refused_with_line_and_column() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("bad");
    let cases: [(&[u8], &str); 9] = [
        (b"", "line 1: column 1: there is no polynomial"),
        (b"x + y\nx*(y + 1\n", "line 2: column 9: `)` expected"),
        (b"variables: x\r\nx + y\r\n", "line 2: column 5: `y` is not declared"),
        (b"ring r = 0,(x,y),ws(1,2);\nideal i = x;", "line 1: column 18: the order `ws`"),
        (b"ring r = 0,(x,y),dp;\nideal i = x,\n3xz;", "line 3: column 1: `3xz` is not declared"),
        (b"x, y\n0\nx + 0.5,\ny", "line 3: column 6: `.` is not allowed"),
        (b"x + \xff", "line 1: column 5: the text is not UTF-8"),
        (b"x + y\n\0", "line 2: column 1: `\\0` is not allowed"),
        (b"x\n(x + y + z + w + v)^1000", "line 2: column 1: the expansion"),
    ];
    for (bytes, words) in cases {
        fs::write(&file, bytes).unwrap();
        let error = refused(&["basis", text(&file), "-o", text(&folder.path().join("out")), "--certificate"]);
        assert!(error.starts_with(&format!("error: {}: {words}", text(&file))), "{error}");
        assert_eq!(content(folder.path()).len(), 1);
    }
    assert!(refused(&["basis", "no/such/file"]).starts_with("error: no/such/file: "));
    refused(&["basis", text(folder.path())]);
}

#[test]
fn wishes_that_do_not_fit_are_refused() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("system");
    let cases: [(&str, &[&str], &str); 10] = [
        (CYCLIC, &["--order", "block:2"], "--order: the blocks of the order grevlex(2) must cover the 3 variables"),
        (CYCLIC, &["--order", "lex(3)", "--eliminate", "x"], "must cover the 2 variables"),
        (CYCLIC, &["--eliminate", "w"], "--eliminate: `w` is not a variable"),
        (CYCLIC, &["--eliminate", "x,x"], "named twice"),
        (CYCLIC, &["--eliminate", "x,y,z"], "no variable would remain"),
        (CYCLIC, &["--characteristic", "9"], "--characteristic: 9 is not a prime"),
        (CYCLIC, &["--format", "msolve"], "line 1: column 6: `:` is not allowed"),
        ("x\n7\nx", &["--characteristic", "11"], "already modulo 7"),
        (CIRCLE, &["--output-format", "msolve"], "no parameters"),
        ("x - 1/7", &["--characteristic", "7"], "line 1: column 1: division by `7`"),
    ];
    for (system, arguments, words) in cases {
        fs::write(&file, system).unwrap();
        let error = refused(&[&["basis", text(&file)], arguments].concat());
        assert!(error.contains(words), "{error}");
    }
    let same = text(&file);
    let error = refused(&["basis", same, "-o", same, &format!("--certificate={same}")]);
    assert!(error.contains("two files"), "{error}");
    let nameless = run_on(&["basis", "-", "--certificate"], CYCLIC.as_bytes());
    assert!(nameless.code == 1 && nameless.err.contains("--certificate=proof.json"), "{}", nameless.err);
    for wrong in [&["--order", "dp"][..], &["--format", "maple"], &["--memory", "0"], &["--output-format", "auto"]] {
        let ran = run(&[&["basis", same], wrong].concat());
        assert_eq!((ran.code, ran.out.as_str()), (2, ""), "{}", ran.err);
    }
}

/// Cyclic 9 over Q in the lexicographic order, which takes hours.
fn endless() -> String {
    let names: Vec<String> = (0..9).map(|k| format!("x{k}")).collect();
    let mut system = "order: lex\n".to_owned();
    for degree in 1..9 {
        let product =
            |start: usize| (0..degree).map(|k: usize| names[(start + k) % 9].as_str()).collect::<Vec<_>>().join("*");
        system += &format!("{}\n", (0..9).map(product).collect::<Vec<_>>().join(" + "));
    }
    system + &names.join("*") + " - 1\n"
}

#[test]
fn a_budget_ends_it_and_leaves_the_old_file() {
    let folder = tempdir().unwrap();
    let (file, out) = (folder.path().join("cyclic9"), folder.path().join("out"));
    fs::write(&file, endless()).unwrap();
    fs::write(&out, "old").unwrap();
    let before = content(folder.path());
    let mut budgets = vec![("--time", "0.1", "time budget")];
    if cfg!(target_os = "linux") {
        budgets.push(("--memory", "1", "MiB of memory are in use, the budget allows 1.0"));
    }
    for (limit, value, word) in budgets {
        let error = refused(&["basis", text(&file), "-o", text(&out), "--certificate", limit, value]);
        assert!(error.contains(word), "{error}");
        assert_eq!(content(folder.path()), before);
    }
}

#[test]
#[cfg(target_os = "linux")]
fn control_c_ends_it_and_leaves_the_old_file() {
    use std::process::Command;
    use std::thread::sleep;
    use std::time::{Duration, Instant};

    let folder = tempdir().unwrap();
    let (file, out) = (folder.path().join("cyclic9"), folder.path().join("out"));
    fs::write(&file, endless()).unwrap();
    fs::write(&out, "old").unwrap();
    let before = content(folder.path());
    let mut child = super::groebot(&["basis", text(&file), "-o", text(&out), "--time", "100"]).spawn().unwrap();
    let start = Instant::now();
    while !super::interrupted::catches_interrupts(child.id()) && start.elapsed() < Duration::from_secs(20) {
        sleep(Duration::from_millis(5));
    }
    sleep(Duration::from_millis(200));
    assert_eq!(child.try_wait().unwrap(), None, "it should still be at work");
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    let error = String::from_utf8(output.stderr).unwrap();
    assert_eq!((output.status.code(), error.as_str()), (Some(130), "error: interrupted; nothing was written\n"));
    assert!(output.stdout.is_empty());
    assert_eq!(content(folder.path()), before);
}

#[test]
fn the_formats_are_those_of_the_library() {
    let ran = run_on(&["basis", "-", "--quiet", "--output-format", "msolve"], CYCLIC.as_bytes());
    let system = PolynomialSystem::read(&ran.out, Some(Format::Msolve)).unwrap();
    assert_eq!((system.heading.variables.len(), system.polynomials.len()), (3, 3));
}
