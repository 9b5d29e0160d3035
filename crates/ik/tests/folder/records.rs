//! Forged records of certificates, where all other files are printed again from the forged certificate.

use std::collections::BTreeMap;

use groebot_ik::derive::Derivation;
use groebot_ik::folder::{CERTIFICATE, prove};
use groebot_ik::solver::Program;
use serde_json::{Value, json};

use super::honest::{self, Honest};

/// Number of forgeries of each kind, spread evenly over the certificate.
const EACH: usize = 10;

/// A forged certificate, and a description of the forgery.
type Forgery = (String, Value);

/// All forgeries of a certificate by kind; `other` is the certificate of another robot.
fn forgeries(whole: &Value, other: &Value) -> BTreeMap<&'static str, Vec<Forgery>> {
    let mut places = Vec::new();
    walk(whole, String::new(), &mut places);
    let mut sorts: BTreeMap<&'static str, Vec<Forgery>> = BTreeMap::new();
    let mut add = |sort: &'static str, place: &str, change: &dyn Fn(&mut Value)| {
        let mut forged = whole.clone();
        change(forged.pointer_mut(place).unwrap());
        if forged != *whole {
            sorts.entry(sort).or_default().push((format!("{sort} at {place}"), forged));
        }
    };
    for place in &places {
        match whole.pointer(place).unwrap() {
            Value::Array(list) => {
                for at in 0..list.len() {
                    add("removed", place, &|value| drop(value.as_array_mut().unwrap().remove(at)));
                    add("doubled", place, &|value| value.as_array_mut().unwrap().insert(at, list[at].clone()));
                    add("exchanged", place, &|value| value.as_array_mut().unwrap().swap(at, (at + 1) % list.len()));
                }
                add("reversed", place, &|value| value.as_array_mut().unwrap().reverse());
            }
            Value::Object(entries) => {
                for key in entries.keys() {
                    add("without a key", place, &|value| drop(value.as_object_mut().unwrap().remove(key)));
                }
                if entries.contains_key("cofactors") && entries.contains_key("kind") {
                    let open = |reason: &str| json!({"kind": "open", "reason": reason, "order": [], "basis": [], "cofactors": []});
                    add("weakened", place, &|value| *value = open("too hard"));
                    add("weakened", place, &|value| {
                        *value = open("");
                        value.as_object_mut().unwrap().remove("reason");
                    });
                    for kind in ["solved", "inconsistent", "self_motion"] {
                        add("of another kind", place, &|value| value["kind"] = kind.into());
                    }
                }
            }
            Value::Number(number) => {
                let number = number.as_u64().unwrap();
                let sort = if place.ends_with("dimension") || place.ends_with("degree") { "counts" } else { "numbers" };
                for forged in [number.saturating_sub(1), number + 1, number / 2, 2 * number, 0] {
                    add(sort, place, &|value| *value = forged.into());
                }
            }
            Value::String(text) => {
                for forged in [format!("{text} + 1"), format!("2*({text})"), "0".to_owned(), String::new()] {
                    add("words", place, &|value| *value = forged.clone().into());
                }
            }
            _ => {}
        }
        if let Some(foreign) = other.pointer(place) {
            add("another robot's", place, &|value| *value = foreign.clone());
        }
    }
    sorts
}

/// The places of all values below one.
fn walk(value: &Value, place: String, places: &mut Vec<String>) {
    match value {
        Value::Array(list) => {
            list.iter().enumerate().for_each(|(at, value)| walk(value, format!("{place}/{at}"), places))
        }
        Value::Object(entries) => entries.iter().for_each(|(key, value)| walk(value, format!("{place}/{key}"), places)),
        _ => {}
    }
    places.push(place);
}

/// `count` elements of a list, at even distances, with the first and the last.
fn evenly<T>(list: Vec<T>, count: usize) -> Vec<T> {
    let length = list.len();
    let taken = |at: usize| length <= count || at * (count - 1) / (length - 1) != (at + 1) * (count - 1) / (length - 1);
    list.into_iter().enumerate().filter(|(at, _)| taken(*at) || at + 1 == length).map(|(_, item)| item).collect()
}

/// The derivation that a forged certificate proves, if it is accepted and written without change.
fn accepted(honest: &mut Honest, forged: &Value) -> Option<Derivation> {
    let mut stored = honest.stored.clone();
    stored.files.insert(CERTIFICATE.to_owned(), forged.to_string().into_bytes());
    let proved = prove(&honest.source, &stored, &mut honest.recount).ok()?;
    // The order of keys and white space have no meaning.
    (serde_json::from_str::<Value>(&proved.certificate().unwrap()).unwrap() == *forged).then_some(proved)
}

/// Whether two solvers have equal solutions at targets, and claim equal numbers of them.
fn agree(honest: &Derivation, forged: &Derivation, targets: &[Vec<f64>]) -> bool {
    let answers = |program: &Program, target: &[f64]| -> Vec<Vec<i64>> {
        let rounded = |q: &f64| (q * 1e6).round() as i64;
        let solutions = program.solve_numbers(target).unwrap();
        let mut rows: Vec<Vec<i64>> = solutions.iter().map(|one| one.q.iter().map(rounded).collect()).collect();
        rows.sort();
        rows
    };
    honest.dimension() == forged.dimension()
        && targets.iter().all(|target| answers(honest.program(), target) == answers(forged.program(), target))
}

/// Reachable targets, from the forward kinematics of the solver itself.
fn targets(program: &Program, stored: &str) -> Vec<Vec<f64>> {
    let rows = stored.lines().skip(1).filter(|row| row.starts_with("random") || row.starts_with("rational"));
    let numbers =
        |row: &str| row.split(',').skip(1).take(program.inputs.len()).map(|cell| cell.parse().unwrap()).collect();
    rows.map(numbers).take(20).collect()
}

/// Forges the certificate by all methods. Returns the number of forgeries.
fn forge_records(mut honest: Honest, other: &Value, table: &str) -> usize {
    let whole = honest.certificate();
    assert!(accepted(&mut honest, &whole).is_some_and(|again| again == honest.proved));
    let targets = targets(honest.proved.program(), table);
    let mut count = 0;
    for (sort, all) in forgeries(&whole, other) {
        let most = if sort == "weakened" || sort == "counts" { usize::MAX } else { EACH };
        for (what, forged) in evenly(all, most) {
            count += 1;
            let Some(proved) = accepted(&mut honest, &forged) else { continue };
            assert!(sort != "weakened" && sort != "counts", "{what}");
            assert!(!targets.is_empty() && agree(&honest.proved, &proved, &targets), "{what}");
            println!("still true: {what}");
        }
    }
    println!("{count} forgeries of `{}`", honest.proved.program().name);
    count
}

#[test]
fn forged_records_of_equations_are_refused() {
    let [leg, arm] = ["nao_leg_sagittal", "nao_arm_planar"].map(honest::certificate);
    assert!(forge_records(Honest::new("nao_arm_planar"), &leg, &honest::text("nao_arm_planar", "6_check.csv")) > 80);
    assert!(
        forge_records(Honest::new("nao_leg_sagittal"), &arm, &honest::text("nao_leg_sagittal", "6_check.csv")) > 90
    );
}

#[test]
fn forged_records_of_a_chain_are_refused() {
    let other = honest::certificate("planar_2r");
    assert!(forge_records(Honest::new("polar"), &other, &honest::text("polar", "6_check.csv")) > 100);
}

#[test]
fn forged_records_of_an_elimination_are_refused() {
    let table = honest::text("spherical_wrist", "6_check.csv");
    assert!(forge_records(Honest::new("spherical_wrist"), &honest::certificate("puma"), &table) > 100);
}

#[test]
fn forged_records_of_an_eigenvalue_problem_are_refused() {
    let table = honest::text("crx_like", "6_check.csv");
    assert!(forge_records(Honest::new("crx_like"), &honest::certificate("xarm6_like"), &table) > 60);
}

#[test]
fn forged_records_of_coupled_chains_are_refused() {
    let honest = Honest::two_arms();
    let (written, _) = honest.written();
    let table = written.iter().find(|file| file.name == "6_check.csv").unwrap();
    let table = String::from_utf8(table.bytes.clone()).unwrap();
    assert!(forge_records(honest, &honest::certificate("nao_legs"), &table) > 100);
}
