//! The robots of `src/robots/index.toml`: each is a chain with a source.

use std::collections::HashSet;
use std::path::PathBuf;

use groebot_robot::Error;
use groebot_robot::document::{Document, Table};
use groebot_robot::kinematics::Chain;
use groebot_robot::model::Robot;

/// Text of a file of `src/robots`.
fn read(file: &str) -> String {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("src/robots").join(file);
    std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

fn entries<'d>(index: &'d Document<'_>) -> Vec<Table<'d>> {
    index.root().required("robot").unwrap().tables().unwrap()
}

fn text<'a>(entry: Table<'a>, key: &str) -> Option<&'a str> {
    entry.optional(key).map(|node| node.text().unwrap())
}

/// The chain of an entry and the source of its file.
fn chain(entry: Table<'_>) -> (Chain, Option<String>) {
    let name = text(entry, "name").unwrap();
    let file = text(entry, "file").map_or_else(|| format!("named/{name}.toml"), str::to_owned);
    let read = || match text(entry, "base") {
        Some(base) => {
            let robot = Robot::from_toml(&read(&file))?;
            Ok((robot.chain(Some(base), text(entry, "tip"))?, robot.parts().source.clone()))
        }
        None => Chain::from_toml(&read(&file)).map(|chain| (chain.clone(), chain.parts().source.clone())),
    };
    read().unwrap_or_else(|error: Error| panic!("{name}: {error}"))
}

#[test]
fn every_entry_is_a_chain_with_a_source() {
    let source = read("index.toml");
    let index = Document::parse(&source).unwrap();
    let entries = entries(&index);
    assert!(entries.len() >= 120, "{} robots", entries.len());
    for entry in entries {
        let (chain, source) = chain(entry);
        assert!(source.is_some() && !chain.joints().is_empty(), "{:?}", text(entry, "name"));
    }
}

#[test]
fn names_are_unique_and_lower_snake_case() {
    let source = read("index.toml");
    let index = Document::parse(&source).unwrap();
    let entries = entries(&index);
    let names: HashSet<_> = entries.iter().map(|entry| text(*entry, "name").unwrap()).collect();
    assert_eq!(names.len(), entries.len());
    let is_snake = |name: &str| name.chars().all(|c| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_');
    assert!(names.into_iter().all(is_snake));
}

#[test]
fn every_file_is_in_the_index() {
    let source = read("index.toml");
    let index = Document::parse(&source).unwrap();
    let names: HashSet<_> = entries(&index).iter().map(|entry| text(*entry, "name").unwrap().to_owned()).collect();
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("src/robots/named");
    for file in std::fs::read_dir(folder).unwrap() {
        let file = file.unwrap().file_name().into_string().unwrap();
        assert!(names.contains(file.strip_suffix(".toml").unwrap()), "{file}");
    }
}

/// A robot is `checked` when Pinocchio's poses of another description differ by less than a millimetre.
#[test]
fn at_least_eighty_are_checked() {
    let source = read("index.toml");
    let index = Document::parse(&source).unwrap();
    let checked: Vec<_> = entries(&index).into_iter().filter(|entry| entry.optional("checked").is_some()).collect();
    assert!(checked.len() >= 80, "{}", checked.len());
    for entry in checked {
        let difference = entry.required("difference").unwrap().float().unwrap();
        assert!(difference < 1e-3, "{:?}", text(entry, "name"));
    }
}
