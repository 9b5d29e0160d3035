//! `docs/robotman.md` lists all 51 functions of RobotMan, and the items that it names exist.

use std::fs;
use std::path::{Path, PathBuf};

/// One row: number, RobotMan's name, the path in groebot, the path of the test.
struct Row {
    number: usize,
    name: String,
    ours: String,
    test: String,
}

fn rows() -> Vec<Row> {
    let page = include_str!("../../../../docs/robotman.md");
    let cells = |line: &str| line.split('|').map(|cell| cell.trim().trim_matches('`').to_owned()).collect::<Vec<_>>();
    let rows = page.lines().filter(|line| line.starts_with("| ")).map(cells);
    let row = |cells: Vec<String>| {
        let number = cells[1].parse().ok()?;
        Some(Row { number, name: cells[2].clone(), ours: cells[4].clone(), test: cells[6].clone() })
    };
    rows.filter_map(row).collect()
}

fn last(path: &str) -> &str {
    path.rsplit("::").next().unwrap()
}

fn text_below(folder: &Path) -> String {
    let entries = fs::read_dir(folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display()));
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.sort();
    let text = |path: &PathBuf| match path.is_dir() {
        true => text_below(path),
        false if path.extension().is_some_and(|end| end == "rs") => fs::read_to_string(path).unwrap(),
        false => String::new(),
    };
    paths.iter().map(text).collect()
}

/// The sources in the folder `root` of the crate, in the module in which `path` starts.
fn sources(root: &str, path: &str) -> String {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join(root);
    let module = path.split("::").next().unwrap();
    if path.contains("::") { text_below(&root.join(module)) } else { text_below(&root) }
}

fn declares(text: &str, name: &str, kinds: &[&str]) -> bool {
    let ends = |rest: &str| !rest.starts_with(|c: char| c.is_alphanumeric() || c == '_');
    kinds.iter().any(|kind| {
        let item = format!("{kind} {name}");
        text.match_indices(&item).any(|(at, _)| ends(&text[at + item.len()..]))
    })
}

#[test]
fn all_51_functions_have_a_row() {
    let rows = rows();
    let numbers: Vec<usize> = rows.iter().map(|row| row.number).collect();
    assert_eq!(numbers, (1..=51).collect::<Vec<_>>());
    let mut names: Vec<&str> = rows.iter().map(|row| row.name.as_str()).collect();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), 51, "each function of RobotMan has its own name");
}

#[test]
fn what_the_rows_name_exists() {
    for Row { number, ours, test, .. } in &rows() {
        let source = sources("src", ours);
        assert!(declares(&source, last(ours), &["fn", "struct", "enum"]), "f({number}): no `{ours}` in src");
        assert!(declares(&sources("tests", test), last(test), &["fn"]), "f({number}): no `{test}` in tests");
    }
}
