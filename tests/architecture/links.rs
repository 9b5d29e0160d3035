//! Links and paths in the documentation must refer to existing files and headings of the repository.

use std::fs;

use super::{assert_none, root, tracked_files};

/// Folders whose files are named by their paths.
const FOLDERS: [&str; 10] =
    ["benches/", "crates/", "docs/", "examples/", "fuzz/", "python/", "runtime/", "scripts/", "src/", "tests/"];

/// The Markdown pages that are checked. Derivations, records of changes and corpora are excluded.
fn pages() -> Vec<(String, String)> {
    let is_page = |file: &String| {
        file.ends_with(".md")
            && (!file.contains('/') || ["docs/", "crates/", "benches/"].iter().any(|folder| file.starts_with(folder)))
    };
    let files = tracked_files().into_iter().map(|path| super::slashed(&path));
    (files.filter(|file| {
        is_page(file)
            && file != "CHANGELOG.md"
            && !file.starts_with("crates/robot/docs/")
            && !file.starts_with("crates/ik/docs/")
    }))
    .map(|file| (file.clone(), fs::read_to_string(root().join(file)).unwrap()))
    .collect()
}

/// The text between each `start` and the `end` that follows it.
fn between<'a>(text: &'a str, start: &str, end: char) -> Vec<&'a str> {
    text.split(start).skip(1).filter_map(|rest| rest.split_once(end)).map(|(inner, _)| inner).collect()
}

/// The anchors of a page's headings, as GitHub makes them.
fn anchors(text: &str) -> Vec<String> {
    let headings = text.lines().filter(|line| line.starts_with('#')).map(|line| line.trim_start_matches('#').trim());
    let kept = |letter: char| letter.is_alphanumeric() || matches!(letter, ' ' | '-' | '_');
    headings
        .map(|heading| {
            heading.to_lowercase().chars().filter(|&letter| kept(letter)).collect::<String>().replace(' ', "-")
        })
        .collect()
}

/// `docs/../a/b` without `..`.
fn shortened(path: &str) -> String {
    let mut parts: Vec<&str> = Vec::new();
    for part in path.split('/').filter(|part| !part.is_empty() && *part != ".") {
        if part == ".." && parts.pop().is_some() {
            continue;
        }
        parts.push(part);
    }
    parts.join("/")
}

/// Describes the error in a link of a page.
fn broken_link(file: &str, link: &str) -> Option<String> {
    if link.contains("://") || link.contains(char::is_whitespace) {
        return None;
    }
    let (path, anchor) = link.split_once('#').map_or((link, None), |(path, anchor)| (path, Some(anchor)));
    let folder = file.rsplit_once('/').map_or("", |(folder, _)| folder);
    let target = if path.is_empty() { file.to_owned() } else { shortened(&format!("{folder}/{path}")) };
    let Ok(found) = fs::metadata(root().join(&target)) else { return Some(format!("{file}: no file {target}")) };
    let anchor = anchor.filter(|_| found.is_file() && target.ends_with(".md"))?;
    let headings = anchors(&fs::read_to_string(root().join(&target)).unwrap());
    (!headings.iter().any(|heading| heading == anchor)).then(|| format!("{file}: no heading #{anchor} in {target}"))
}

/// Describes the error in a word in backquotes, if it is a path. Names in capitals are placeholders.
fn broken_path(file: &str, word: &str) -> Option<String> {
    let is_path = FOLDERS.iter().any(|folder| word.starts_with(folder))
        && word.chars().all(|letter| letter.is_ascii_lowercase() || letter.is_ascii_digit() || "/_.-".contains(letter));
    (is_path && !root().join(word).exists()).then(|| format!("{file}: no file {word}"))
}

#[test]
fn links_and_paths_lead_somewhere() {
    let pages = pages();
    assert!(pages.len() > 30, "only {} pages are read", pages.len());
    let mut found = Vec::new();
    for (file, text) in &pages {
        found.extend(between(text, "](", ')').into_iter().filter_map(|link| broken_link(file, link)));
        // The commit of these files is named next to them.
        if file != "benches/six_axes/formulations.md" {
            found.extend(text.split('`').skip(1).step_by(2).filter_map(|word| broken_path(file, word)));
        }
    }
    assert_none(&found);
}

#[test]
fn a_broken_link_is_found() {
    assert_eq!(
        broken_link("docs/README.md", "no_such_page.md"),
        Some("docs/README.md: no file docs/no_such_page.md".into())
    );
    assert!(broken_link("docs/README.md", "files.md#no-such-heading").is_some());
    assert_eq!(broken_link("docs/README.md", "../README.md#licence"), None);
    assert!(broken_path("README.md", "src/no_such_file.rs").is_some());
}

#[test]
fn the_readme_stays_short() {
    let text = fs::read_to_string(root().join("README.md")).unwrap();
    assert!(text.lines().count() <= 150, "README.md has {} lines; at most 150", text.lines().count());
    assert!(text.lines().take(5).any(|line| line.starts_with("![")), "README.md begins with a picture");
    let picture = fs::metadata(root().join("docs/readme.png")).unwrap();
    assert!(picture.len() < 300_000, "docs/readme.png has {} bytes; at most 300,000", picture.len());
}
