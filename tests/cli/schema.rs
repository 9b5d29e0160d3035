//! docs/cli_schema.json: the output of each run of these tests with `--json` is validated, and each command has an entry.
//!
//! The validator has the part of JSON Schema 2020-12 that the file uses; another keyword is an error.

use std::fs;
use std::sync::OnceLock;

use serde_json::{Deserializer, Map, Value};
use tempfile::tempdir;

use super::{leg, root, run, succeed, text};

/// Commands whose standard output is a script.
const WITHOUT_JSON: [&str; 2] = ["completions", "help"];

fn schema() -> &'static Value {
    static SCHEMA: OnceLock<Value> = OnceLock::new();
    SCHEMA.get_or_init(|| serde_json::from_str(&fs::read_to_string(root("docs/cli_schema.json")).unwrap()).unwrap())
}

/// The entry of the schema with this name.
fn entry(name: &str) -> Option<&'static Value> {
    schema()["$defs"].get(name)
}

/// Validates the standard output of a run with `--json`.
pub(super) fn validate(arguments: &[&str], out: &str) {
    let Some(command) = arguments.first().filter(|_| arguments.contains(&"--json")) else { return };
    let schema = entry(command).unwrap_or_else(|| panic!("docs/cli_schema.json has no `{command}`"));
    for value in Deserializer::from_str(out).into_iter::<Value>() {
        let value = value.unwrap_or_else(|error| panic!("{arguments:?}: {error}: {out}"));
        let faults = faults(schema, &value, command);
        assert!(faults.is_empty(), "{arguments:?}: {}\n{out}", faults.join("\n"));
    }
}

/// The differences between a value and a schema, each with its place.
fn faults(schema: &Value, value: &Value, place: &str) -> Vec<String> {
    let keywords = schema.as_object().expect("a schema is an object");
    let of_keyword = |(keyword, rule): (&String, &Value)| keyword_faults(keyword, rule, keywords, (value, place));
    keywords.iter().flat_map(of_keyword).collect()
}

fn keyword_faults(
    keyword: &str,
    rule: &Value,
    schema: &Map<String, Value>,
    (value, place): (&Value, &str),
) -> Vec<String> {
    let fault = |text: String| vec![format!("{place}: {text}")];
    let unless = |holds: bool| if holds { Vec::new() } else { fault(format!("{keyword} {rule}, but {value}")) };
    match keyword {
        "description" => Vec::new(),
        "$ref" => {
            let name = rule.as_str().and_then(|path| path.strip_prefix("#/$defs/")).expect("a reference to $defs");
            faults(entry(name).unwrap_or_else(|| panic!("no `{name}` in $defs")), value, place)
        }
        "const" => unless(rule == value),
        "enum" => unless(rule.as_array().unwrap().contains(value)),
        "type" => match rule.as_array() {
            Some(kinds) => unless(kinds.iter().any(|kind| is_of(value, kind.as_str().unwrap()))),
            None => unless(is_of(value, rule.as_str().unwrap())),
        },
        "oneOf" => one_of(rule.as_array().unwrap(), value, place),
        "minItems" => unless(value.as_array().is_none_or(|list| list.len() as u64 >= rule.as_u64().unwrap())),
        "maxItems" => unless(value.as_array().is_none_or(|list| list.len() as u64 <= rule.as_u64().unwrap())),
        "prefixItems" => {
            let pairs = rule.as_array().unwrap().iter().zip(value.as_array().into_iter().flatten());
            pairs.enumerate().flat_map(|(i, (rule, item))| faults(rule, item, &format!("{place}[{i}]"))).collect()
        }
        "items" => {
            let first = schema.get("prefixItems").and_then(Value::as_array).map_or(0, Vec::len);
            let rest = value.as_array().into_iter().flatten().enumerate().skip(first);
            rest.flat_map(|(i, item)| match rule.as_bool() {
                Some(false) => fault(format!("the item {i} is not allowed")),
                _ => faults(rule, item, &format!("{place}[{i}]")),
            })
            .collect()
        }
        "properties" => {
            let known = |(name, item): (&String, &Value)| {
                rule.get(name).map(|rule| faults(rule, item, &format!("{place}.{name}"))).unwrap_or_default()
            };
            value.as_object().into_iter().flatten().flat_map(known).collect()
        }
        "required" => {
            let missing = |name: &&Value| value.is_object() && value.get(name.as_str().unwrap()).is_none();
            let names = rule.as_array().unwrap().iter().filter(missing);
            names.flat_map(|name| fault(format!("{name} is missing"))).collect()
        }
        "additionalProperties" => {
            assert_eq!(rule, &Value::Bool(false));
            let known = |name: &&String| schema["properties"].get(name.as_str()).is_none();
            let names = value.as_object().into_iter().flat_map(Map::keys).filter(known);
            names.flat_map(|name| fault(format!("`{name}` is not documented"))).collect()
        }
        other => panic!("the validator does not know `{other}`"),
    }
}

/// The faults of the best alternative, unless exactly one fits.
fn one_of(alternatives: &[Value], value: &Value, place: &str) -> Vec<String> {
    let all: Vec<Vec<String>> = alternatives.iter().map(|rule| faults(rule, value, place)).collect();
    match all.iter().filter(|faults| faults.is_empty()).count() {
        1 => Vec::new(),
        0 => all.into_iter().min_by_key(Vec::len).unwrap_or_default(),
        count => vec![format!("{place}: {count} alternatives fit")],
    }
}

fn is_of(value: &Value, kind: &str) -> bool {
    match kind {
        "null" => value.is_null(),
        "boolean" => value.is_boolean(),
        "string" => value.is_string(),
        "array" => value.is_array(),
        "object" => value.is_object(),
        "number" => value.is_number(),
        "integer" => value.is_i64() || value.is_u64(),
        other => panic!("no type `{other}`"),
    }
}

#[test]
fn the_validator_finds_each_kind_of_fault() {
    let value = |text: &str| serde_json::from_str::<Value>(text).unwrap();
    let plan = value(&succeed(&["plan", "puma", "--json"]));
    let schema = entry("plan").unwrap();
    assert_eq!(faults(schema, &plan, "plan"), [""; 0]);
    let changed = |change: &dyn Fn(&mut Value)| {
        let mut changed = plan.clone();
        change(&mut changed);
        faults(schema, &changed, "plan")
    };
    type Change<'a> = &'a dyn Fn(&mut Value);
    let cases: [(Change<'_>, &str); 6] = [
        (&|plan| plan["undocumented"] = 1.into(), "plan: `undocumented` is not documented"),
        (&|plan| drop(plan.as_object_mut().unwrap().remove("steps")), "plan: \"steps\" is missing"),
        (&|plan| plan["format"] = 1.into(), "plan.format: const 2, but 1"),
        (&|plan| plan["solutions"] = 7.5.into(), "plan.solutions: type \"integer\", but 7.5"),
        (&|plan| plan["notes"] = value("[3]"), "plan.notes[0]: type \"string\", but 3"),
        (&|plan| plan["tip_link"] = 5.into(), "plan.tip_link: type \"object\", but 5"),
    ];
    for (change, expected) in cases {
        assert!(changed(change).iter().any(|fault| fault == expected), "{expected}: {:?}", changed(change));
    }
    let pair = entry("identify").unwrap()["properties"]["bodies"]["items"].clone();
    assert!(faults(&pair, &value("[\"m\", 1.0]"), "pair").is_empty());
    assert_eq!(faults(&pair, &value("[\"m\", 1.0, 2.0]"), "pair").len(), 1);
    assert_eq!(faults(&pair, &value("[1.0]"), "pair").len(), 2);
}

#[test]
fn each_command_has_an_entry_and_a_row_in_the_documentation() {
    let page = fs::read_to_string(root("docs/json.md")).unwrap();
    let help = succeed(&["--help"]);
    let (commands, _) = help.split_once("Options:").unwrap();
    let commands: Vec<&str> = commands
        .lines()
        .filter(|line| line.starts_with("  "))
        .filter_map(|line| line.split_whitespace().next())
        .collect();
    assert!(commands.len() > 20, "{commands:?}");
    for command in commands.into_iter().filter(|command| !WITHOUT_JSON.contains(command)) {
        let help = succeed(&[command, "--help"]);
        assert!(help.contains("--json"), "{command} has no --json");
        assert!(entry(command).is_some(), "docs/cli_schema.json has no `{command}`");
        assert!(page.contains(&format!("| `{command}`")), "docs/json.md has no row for `{command}`");
    }
}

/// Each object of the schema is closed, and each entry has a description.
#[test]
fn the_schema_is_closed() {
    fn open(value: &Value) -> usize {
        let own = value.get("properties").is_some() && value.get("additionalProperties") != Some(&Value::Bool(false));
        let inner: usize = match value {
            Value::Object(map) => map.values().map(open).sum(),
            Value::Array(list) => list.iter().map(open).sum(),
            _ => 0,
        };
        inner + usize::from(own)
    }
    assert_eq!(open(schema()), 0);
    for (name, entry) in schema()["$defs"].as_object().unwrap() {
        assert!(entry.get("description").is_some(), "{name}");
    }
}

/// Runs of commands that have no other test with `--json`. `run` validates the output.
#[test]
fn reports_of_files_and_derivations_are_valid() {
    let folder = tempdir().unwrap();
    let at = |name: &str| text(&folder.path().join(name)).to_owned();
    let rrp = text(&root("tests/corpus/dynamics/rrp.urdf")).to_owned();
    let json =
        |arguments: &[&str]| -> Value { serde_json::from_str(&succeed(&[arguments, &["--json"]].concat())).unwrap() };
    let (c, page, mjcf, rust) = (at("leg.c"), at("leg.html"), at("rrp.xml"), at("rrp.rs"));
    let written = json(&["codegen", leg().path(), "--lang", "c", "-o", &c]);
    assert_eq!(written["files"], serde_json::json!([at("leg.h"), c]));
    assert_eq!(json(&["view", "derivations/ur5", "-o", &page])["files"], serde_json::json!([page]));
    assert_eq!(json(&["export", &rrp, "--to", "mjcf", "-o", &mjcf])["files"], serde_json::json!([mjcf]));
    let code = json(&["dynamics", &rrp, "--lang", "rust", "--functions", "inverse,gravity", "-o", &rust]);
    assert_eq!(code["functions"], serde_json::json!(["inverse", "gravity"]));
    let symbolic = json(&["dynamics", "--symbolic", "derivations/scara"]);
    assert!(symbolic["entries"][0]["name"] == "M11" && symbolic["files"] == serde_json::json!([]), "{symbolic}");
    let explained = json(&["explain", leg().path()]);
    let kinds: Vec<&str> =
        explained["parts"].as_array().unwrap().iter().filter_map(|part| part["kind"].as_str()).collect();
    assert!(["section", "paragraph", "formula"].iter().all(|kind| kinds.contains(kind)), "{kinds:?}");
    json(&["check", leg().path()]);
    json(&["info", leg().path()]);
    json(&["info", "nao"]);
    let map = json(&["reach", "derivations/ur5", "--x=-0.9:0.9:5", "--y", "0.3", "--z", "0.3", "--orientations", "5"]);
    assert!(map["targets"] == 25 && map["targets_reached"].as_u64().unwrap() > 0, "{map}");
    let walk = json(&["walk", "nao", "--steps", "2", "--torques", "--chains"]);
    assert!(walk["steps"] == 2 && walk["torques"].is_array() && walk["chains"].is_object(), "{walk}");
}

#[test]
fn bases_are_reported_with_properties_of_the_ideal() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("system.txt");
    let json = |system: &str, more: &[&str]| -> Value {
        fs::write(&file, system).unwrap();
        serde_json::from_str(&succeed(&[&["basis", text(&file), "--json"], more].concat())).unwrap()
    };
    // A circle and a line: two points, by hand x = y and 2 y^2 = 1.
    let points = json("variables: x, y\n\nx^2 + y^2 - 1\nx - y\n", &["--order", "lex", "--prove"]);
    assert_eq!((&points["dimension"], &points["degree"], &points["status"]), (&0.into(), &2.into(), &"proved".into()));
    assert_eq!(points["leading_exponents"], serde_json::json!([[0, 2], [1, 0]]), "{points}");
    let empty = json("variables: x\n\nx\nx - 1\n", &[]);
    assert!(empty["dimension"].is_null() && empty["degree"].is_null() && empty["basis"] == serde_json::json!(["1"]));
    let curve = json("variables: x, y\n\nx*y\n", &[]);
    assert!(curve["dimension"] == 1 && curve["degree"].is_null(), "{curve}");
    // a x = 1 has a solution unless a is zero.
    let cover = json("variables: x\nparameters: a\n\na*x - 1\n", &["--cover"]);
    let strata = cover["strata"].as_array().unwrap();
    let solutions = |equations: &[&str]| {
        strata.iter().find(|own| own["equations"] == serde_json::json!(equations)).map(|own| own["solutions"].clone())
    };
    assert_eq!((solutions(&[]), solutions(&["a"])), (Some(1.into()), Some(0.into())), "{cover}");
}

#[test]
fn a_failed_command_prints_no_json() {
    for arguments in [
        &["fk", "ur5", "--q", "1,2", "--json"][..],
        &["ik", "ur5", "--target", "1", "--json"],
        &["info", "nothing.urdf", "--json"],
        &["basis", "nothing.txt", "--json"],
        &["walk", "nao", "--hip-height", "9", "--json"],
        &["explain", "nothing", "--json"],
    ] {
        let ran = run(arguments);
        assert_eq!((ran.code, ran.out.as_str()), (1, ""), "{arguments:?}: {}", ran.err);
        assert!(ran.err.starts_with("error: "), "{}", ran.err);
    }
}
