//! Every dependency comes from crates.io under a licence that `deny.toml` allows.

use std::collections::HashSet;
use std::fs;
use std::process::Command;

use serde_json::Value;

/// Whether the SPDX expression `text` can be met with the licences of `allowed`.
fn is_allowed(text: &str, allowed: &HashSet<String>) -> bool {
    let spaced = text.replace('(', " ( ").replace(')', " ) ").replace('/', " OR ");
    let words: Vec<&str> = spaced.split_whitespace().collect();
    matches!(either(&words, allowed), Some((true, [])))
}

type Parsed<'a> = Option<(bool, &'a [&'a str])>;

fn either<'a>(words: &'a [&'a str], allowed: &HashSet<String>) -> Parsed<'a> {
    let (mut value, mut rest) = both(words, allowed)?;
    while let ["OR", tail @ ..] = rest {
        let (next, tail) = both(tail, allowed)?;
        (value, rest) = (value | next, tail);
    }
    Some((value, rest))
}

fn both<'a>(words: &'a [&'a str], allowed: &HashSet<String>) -> Parsed<'a> {
    let (mut value, mut rest) = one(words, allowed)?;
    while let ["AND", tail @ ..] = rest {
        let (next, tail) = one(tail, allowed)?;
        (value, rest) = (value & next, tail);
    }
    Some((value, rest))
}

fn one<'a>(words: &'a [&'a str], allowed: &HashSet<String>) -> Parsed<'a> {
    match words {
        ["(", inner @ ..] => match either(inner, allowed)? {
            (value, [")", rest @ ..]) => Some((value, rest)),
            _ => None,
        },
        [licence, "WITH", exception, rest @ ..] => {
            Some((allowed.contains(&format!("{licence} WITH {exception}")), rest))
        }
        [licence, rest @ ..] => Some((allowed.contains(*licence), rest)),
        [] => None,
    }
}

/// The list `licenses.allow` of `deny.toml`.
fn allowed_licences() -> HashSet<String> {
    let text = fs::read_to_string(super::root().join("deny.toml")).unwrap();
    let document = toml::de::DeTable::parse(&text).unwrap();
    let names = document.get_ref()["licenses"].get_ref()["allow"].get_ref().as_array().unwrap();
    names.iter().map(|name| name.get_ref().as_str().unwrap().to_owned()).collect()
}

/// The violation by `package`, an entry of `cargo metadata`.
fn objection(package: &Value, allowed: &HashSet<String>) -> Option<String> {
    let name = format!("{} {}", package["name"], package["version"]);
    let licence = package["license"].as_str().unwrap_or("no licence");
    let source = package["source"].as_str();
    if source.is_some_and(|source| !source.starts_with("registry+") || !source.ends_with("/crates.io-index")) {
        return Some(format!("{name} does not come from crates.io"));
    }
    (!is_allowed(licence, allowed)).then(|| format!("{name}: `{licence}` is not allowed by deny.toml"))
}

/// The packages of all features on all platforms; `None` if some were never downloaded to this machine.
fn packages() -> Option<Vec<Value>> {
    let arguments = ["metadata", "--format-version=1", "--all-features", "--locked", "--offline"];
    let output = Command::new(env!("CARGO")).args(arguments).current_dir(super::root()).output().unwrap();
    let metadata: Option<Value> = output.status.success().then(|| serde_json::from_slice(&output.stdout).unwrap());
    metadata.map(|metadata| metadata["packages"].as_array().unwrap().clone())
}

#[test]
fn every_dependency_may_be_used() {
    let Some(packages) = packages() else {
        let required = std::env::var_os("GROEBOT_REQUIRE_TOOLS").is_some();
        assert!(!required, "`cargo metadata --offline` fails: run `cargo fetch --locked` first");
        return println!("not checked: some packages were never downloaded; `cargo fetch` brings them");
    };
    assert!(packages.iter().any(|package| package["name"] == "groebot"));
    let allowed = allowed_licences();
    let found: Vec<String> = packages.iter().filter_map(|package| objection(package, &allowed)).collect();
    super::assert_none(&found);
}

#[test]
fn copyleft_is_not_on_the_list() {
    let allowed = allowed_licences();
    assert!(!allowed.iter().any(|licence| licence.contains("GPL")));
    assert!(allowed.contains("MIT") && allowed.contains("Apache-2.0"));
}

#[test]
fn expressions_are_read_as_the_spdx_rules_say() {
    let allowed: HashSet<String> = ["MIT", "Zlib", "A WITH e"].map(str::to_owned).into();
    for text in
        ["MIT", "GPL-3.0 OR MIT", "MIT/X", "(X OR MIT) AND Zlib", "A WITH e", "X AND X OR MIT", "MIT OR X AND X"]
    {
        assert!(is_allowed(text, &allowed), "{text}");
    }
    for text in ["", "GPL-3.0", "MIT AND GPL-3.0", "A", "A WITH f", "MIT OR", "(MIT", "MIT MIT", "(MIT OR Zlib) AND X"]
    {
        assert!(!is_allowed(text, &allowed), "{text}");
    }
}

#[test]
fn a_package_from_elsewhere_is_refused() {
    let allowed = HashSet::from(["MIT".to_owned()]);
    let package = |licence: &str, source: Value| serde_json::json!({"name": "p", "version": "1", "license": licence, "source": source});
    assert_eq!(objection(&package("MIT", Value::Null), &allowed), None);
    assert!(objection(&package("GPL-3.0", Value::Null), &allowed).is_some());
    assert!(objection(&package("MIT", "git+file:///p".into()), &allowed).is_some());
}
