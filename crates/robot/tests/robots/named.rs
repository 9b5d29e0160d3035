//! The robots of `src/robots/index.toml`: each is a chain with limits.

use std::path::PathBuf;

use groebot_robot::kinematics::Chain;
use groebot_robot::model::Robot;

/// Text of a file of `src/robots`.
fn read(file: &str) -> String {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("src/robots").join(file);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn entries() -> Vec<toml::Table> {
    let index: toml::Table = read("index.toml").parse().unwrap();
    index["robot"].as_array().unwrap().iter().map(|entry| entry.as_table().unwrap().clone()).collect()
}

fn text<'a>(entry: &'a toml::Table, key: &str) -> Option<&'a str> {
    entry.get(key).map(|value| value.as_str().unwrap())
}

fn chain(entry: &toml::Table) -> Chain {
    let name = text(entry, "name").unwrap();
    let file = text(entry, "file").map_or_else(|| format!("named/{name}.toml"), str::to_owned);
    match text(entry, "base") {
        Some(base) => {
            let robot = Robot::from_toml(&read(&file)).unwrap_or_else(|error| panic!("{name}: {error}"));
            robot.chain(Some(base), text(entry, "tip")).unwrap_or_else(|error| panic!("{name}: {error}"))
        }
        None => Chain::from_toml(&read(&file)).unwrap_or_else(|error| panic!("{name}: {error}")),
    }
}

#[test]
fn every_entry_is_a_chain_with_a_source() {
    let entries = entries();
    assert!(entries.len() >= 120, "{} robots", entries.len());
    for entry in &entries {
        assert!(chain(entry).parts().source.is_some(), "{entry:?}");
    }
}

#[test]
fn names_are_unique_and_lower_snake_case() {
    let entries = entries();
    let mut names: Vec<_> = entries.iter().map(|entry| text(entry, "name").unwrap()).collect();
    let is_snake = |name: &str| name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_');
    assert!(names.iter().all(|name| is_snake(name)));
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), entries.len());
}

/// A robot is `checked` when Pinocchio's poses of another description differ by less than a millimetre.
#[test]
fn at_least_eighty_are_checked() {
    let entries = entries();
    let checked = entries.iter().filter(|entry| entry.contains_key("checked"));
    let differences: Vec<_> = checked.map(|entry| entry["difference"].as_float().unwrap()).collect();
    assert!(differences.len() >= 80, "{}", differences.len());
    assert!(differences.iter().all(|difference| *difference < 1e-3));
}
