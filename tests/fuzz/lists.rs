//! The lists of targets are equal: in the library, `Cargo.toml`, `fuzz_targets/`, `seeds/` and the README.

use std::collections::BTreeSet;
use std::fs;

use super::{all, root, seeds};

/// Maximum size of all seeds together \[bytes\].
const SEEDS: usize = 300_000;

/// The names of the entries of a folder of `fuzz/`, without extensions.
fn entries(folder: &str) -> BTreeSet<String> {
    let names = fs::read_dir(root().join("fuzz").join(folder)).unwrap().map(|entry| entry.unwrap().file_name());
    names.map(|name| name.into_string().unwrap().trim_end_matches(".rs").to_owned()).collect()
}

fn text(file: &str) -> String {
    fs::read_to_string(root().join("fuzz").join(file)).unwrap()
}

#[test]
fn no_list_of_targets_forgets_one() {
    let names: BTreeSet<String> = all().map(|target| target.name.to_owned()).collect();
    assert_eq!(names.len(), all().count(), "a name is given twice");
    assert!(names.len() >= 26);
    assert_eq!(entries("fuzz_targets"), names);
    assert_eq!(entries("seeds"), names);
    let manifest = text("Cargo.toml");
    let bins = manifest.lines().filter_map(|line| line.strip_prefix("path = \"fuzz_targets/"));
    assert_eq!(bins.map(|line| line.trim_end_matches(".rs\"").to_owned()).collect::<BTreeSet<_>>(), names);
    let page = text("README.md");
    for target in all() {
        let row = format!("| `{}` | {} |", target.name, target.about);
        assert!(page.lines().any(|line| line == row), "README.md lacks: {row}");
    }
}

/// Each file calls its own target.
#[test]
fn each_target_runs_itself() {
    for target in all() {
        let own = text(&format!("fuzz_targets/{}.rs", target.name));
        assert!(own.contains(&format!("groebot_fuzz::run(\"{}\", bytes)", target.name)), "{}", target.name);
        assert!(
            text("Cargo.toml")
                .contains(&format!("name = \"{}\"\npath = \"fuzz_targets/{}.rs\"", target.name, target.name))
        );
    }
}

#[test]
fn seeds_are_few_and_small() {
    let sizes = all().map(|target| {
        let seeds = seeds(target);
        assert!((2..=8).contains(&seeds.len()), "{}: {} seeds", target.name, seeds.len());
        seeds.iter().map(|(_, bytes)| bytes.len()).sum::<usize>()
    });
    let total: usize = sizes.sum();
    assert!(total <= SEEDS, "the seeds take {total} bytes");
}

/// Inputs that failed in the past belong to a target.
#[test]
fn regressions_belong_to_targets() {
    let names: BTreeSet<&str> = all().map(|target| target.name).collect();
    let kept = fs::read_dir(root().join("tests/regressions/fuzz")).unwrap();
    for folder in kept.map(|entry| entry.unwrap().file_name().into_string().unwrap()) {
        assert!(names.contains(folder.as_str()), "tests/regressions/fuzz/{folder} is of no target");
    }
}
