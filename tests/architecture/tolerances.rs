//! Numerical tolerances: all of them are in the modules for them, there are few, each has a test, and the run times in Rust and C have equal values.

use std::fs;

use super::lexer::{self, Token};
use super::{assert_none, root, texts_below};

/// The tolerances of the run time, and those of derived programs and their check.
const RUNTIME: &str = "runtime/src/tolerances.rs";
const IK: &str = "crates/ik/src/tolerances.rs";
/// Those of the closest joint values.
const SOLVER: &str = "crates/solver/src/tolerances.rs";
/// The tolerances of the run time in C.
const C: &str = "runtime/c/groebot/tolerances.h";

/// The largest number of tolerances of the solution of targets, with those of derived programs.
const MOST_OF_SOLUTION: usize = 40;
/// The largest number of tolerances of checks, maps and closest joint values.
const MOST_OF_CHECK: usize = 18;
/// The tests that fail without one tolerance: those of stored solvers, and those that need a derivation or another description.
const TESTS: [&str; 2] = ["runtime/tests/tolerances.rs", "crates/ik/tests/tolerances.rs"];
/// The structs that solutions do not depend on.
const OF_CHECK: [&str; 3] = ["WITNESS", "REACH", "CLOSEST"];

/// A numeric literal below this, apart from zero, is a tolerance.
const SMALL: f64 = 1e-3;

/// Files whose small literals are no tolerances, with the reason.
const EXEMPT: [(&str, &str); 11] = [
    ("runtime/src/tolerances.rs", "the tolerances"),
    ("crates/ik/src/tolerances.rs", "the tolerances"),
    ("crates/solver/src/tolerances.rs", "the tolerances"),
    ("runtime/c/groebot/tolerances.h", "the tolerances"),
    ("runtime/src/trigonometry.rs", "coefficients of cosine and sine, and the rest of pi/2"),
    ("runtime/c/groebot/trigonometry.c", "coefficients of cosine and sine, and the rest of pi/2"),
    ("runtime/c/groebot/six_axes/vector.c", "coefficients of cosine and sine, and the rest of pi/2"),
    ("runtime/c/groebot_dynamics.h", "coefficients of cosine and sine, and the rest of pi/2"),
    ("runtime/src/angles.rs", "the rest of pi/4"),
    ("runtime/src/redundant/checks.rs", "tests: differences that replace derivatives"),
    ("runtime/c/groebot/shared.h", "the rest of pi/4"),
];

/// A tolerance: its struct's constant, its field, and its value as it is written.
#[derive(Clone, Debug, PartialEq)]
struct Tolerance {
    group: String,
    field: String,
    value: String,
}

/// The fields of the constants in a module of tolerances.
fn tolerances(text: &str) -> Vec<Tolerance> {
    let mut list = Vec::new();
    for part in text.split("const ").skip(1) {
        let (Some((head, _)), Some((_, body))) = (part.split_once(':'), part.split_once('{')) else { continue };
        let body = body.split_once("};").map_or(body, |(body, _)| body).replace('\n', " ");
        for entry in body.split(": ").collect::<Vec<_>>().windows(2) {
            let field = entry[0].rsplit([' ', ',']).find(|word| !word.is_empty()).unwrap_or_default().to_owned();
            let end = if entry[1].starts_with('[') { entry[1].find(']') } else { entry[1].find([',', ' ']) };
            let value = entry[1][..end.unwrap_or(entry[1].len())].trim_start_matches('[').to_owned();
            list.push(Tolerance { group: head.to_owned(), field, value });
        }
    }
    list
}

fn read(file: &str) -> String {
    fs::read_to_string(root().join(file)).unwrap()
}

/// Numeric literals with a point or an exponent, each with its line.
fn literals(tokens: &[Token]) -> Vec<(f64, usize)> {
    let text = |at: usize| tokens.get(at).map_or("", |token| token.text.as_str());
    let is_number = |word: &str| word.starts_with(|c: char| c.is_ascii_digit());
    let mut list = Vec::new();
    let mut at = 0;
    while at < tokens.len() {
        let start = at;
        at += 1;
        if !is_number(text(start)) || text(start).starts_with("0x") {
            continue;
        }
        let mut number = text(start).to_owned();
        if text(at) == "." && is_number(text(at + 1)) {
            number += &format!(".{}", text(at + 1));
            at += 2;
        }
        if number.ends_with(['e', 'E']) {
            number += &format!("{}{}", text(at), text(at + 1));
            at += 2;
        }
        let number = number.replace('_', "");
        let number = number.trim_end_matches("f64").trim_end_matches(['f', 'u', 'L', 'U']);
        list.extend(number.parse().ok().map(|value: f64| (value, tokens[start].line)));
    }
    list
}

#[test]
fn small_literals_are_tolerances_with_a_name() {
    let folders =
        ["runtime/src", "runtime/c/groebot", "crates/ik/src", "crates/solver/src", "crates/algebra/src/roots"];
    let mut files: Vec<(String, String)> =
        folders.iter().flat_map(|folder| texts_below(folder, &["rs", "c", "h"])).collect();
    let names =
        ["groebot", "groebot_six_axes", "groebot_redundant"].map(|name| [format!("{name}.c"), format!("{name}.h")]);
    files.extend(names.into_iter().flatten().chain(["groebot_dynamics.h".to_owned()]).map(|name| {
        let file = format!("runtime/c/{name}");
        (file.clone(), read(&file))
    }));
    files.retain(|(file, _)| !EXEMPT.iter().any(|(exempt, _)| exempt == file));
    let small = |(file, text): &(String, String)| -> Vec<String> {
        let found = literals(&lexer::tokens(text)).into_iter().filter(|(value, _)| 0.0 < *value && *value < SMALL);
        found.map(|(value, line)| format!("{file}:{line}: {value:e} has no name in {RUNTIME} or {IK}")).collect()
    };
    assert_none(&files.iter().flat_map(small).collect::<Vec<_>>());
    for (file, reason) in EXEMPT {
        assert!(!small(&(file.to_owned(), read(file))).is_empty(), "{file} has no small literal: {reason}");
    }
}

#[test]
fn tolerances_are_few() {
    let all = [RUNTIME, IK, SOLVER].map(|file| tolerances(&read(file))).concat();
    let (of_check, of_solution): (Vec<_>, Vec<_>) = all.iter().partition(|one| OF_CHECK.contains(&one.group.as_str()));
    println!("{} tolerances of solutions, {} of checks", of_solution.len(), of_check.len());
    assert!(of_solution.len() <= MOST_OF_SOLUTION, "{of_solution:?}");
    assert!(of_check.len() <= MOST_OF_CHECK, "{of_check:?}");
}

/// The values of the macros in C in double precision: name and list of numbers.
fn macros(text: &str) -> Vec<(String, String)> {
    let definition = |line: &str| -> Option<(String, String)> {
        let (name, value) = line.strip_prefix("#define GB_")?.split_once(' ')?;
        let numbers: Vec<String> = value
            .split("R(")
            .skip(1)
            .map(|part| part.split([')', ',']).next().unwrap_or_default().to_owned())
            .collect();
        Some((name.to_owned(), numbers.join(", ")))
    };
    text.lines().filter_map(definition).collect()
}

/// In C a name may have a further word, for another value in single precision. Where a name is defined twice, the first one is in single precision.
#[test]
fn tolerances_in_c_are_those_in_rust() {
    let rust = tolerances(&read(RUNTIME));
    let name_of = |one: &Tolerance| format!("{}_{}", one.group, one.field.to_ascii_uppercase());
    let macros = macros(&read(C));
    for (index, (name, value)) in macros.iter().enumerate() {
        if macros[index + 1..].iter().any(|(other, _)| other == name) {
            continue;
        }
        let is_of = |one: &&Tolerance| {
            name.strip_prefix(&name_of(one)).is_some_and(|rest| rest.is_empty() || rest.starts_with('_'))
        };
        let one = rust.iter().find(is_of).unwrap_or_else(|| panic!("{RUNTIME} has no field for GB_{name}"));
        assert_eq!(*value, one.value, "GB_{name} in {C} differs from {RUNTIME}");
    }
    let missing = |one: &&Tolerance| !macros.iter().any(|(name, _)| *name == name_of(one));
    assert_none(&rust.iter().filter(missing).map(|one| format!("{C} lacks GB_{}", name_of(one))).collect::<Vec<_>>());
}

/// The fields of the structs in a module of tolerances: the declaration, and the test that the last line of its documentation names.
fn named_tests(text: &str) -> Vec<(String, String)> {
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let is_field = |pair: &&[&str]| pair[1].starts_with("pub ") && pair[1].ends_with(',');
    let test_of = |line: &str| {
        line.strip_prefix("/// Test: ").unwrap_or_default().trim_end_matches('.').trim_matches('`').to_owned()
    };
    lines.windows(2).filter(is_field).map(|pair| (pair[1].to_owned(), test_of(pair[0]))).collect()
}

#[test]
fn tolerances_name_a_test_that_fails_without_them() {
    let (tests, ik) = (TESTS.map(read).concat(), read(IK));
    let of_solution = ik.split("/// Maps of the workspace.").next().unwrap_or_default();
    let fields = [named_tests(&read(RUNTIME)), named_tests(of_solution)].concat();
    assert!(!fields.is_empty(), "no field is found");
    let exists = |test: &str| tests.contains(&format!("    {test}: ")) || tests.contains(&format!("fn {test}()"));
    let missing = fields.iter().filter(|(_, test)| test.is_empty() || !exists(test));
    assert_none(
        &missing.map(|(field, test)| format!("`{field}`: {TESTS:?} have no test `{test}`")).collect::<Vec<_>>(),
    );
}
