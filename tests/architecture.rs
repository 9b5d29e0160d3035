//! The design rules as tests: dependencies between modules, sizes of files and functions, and code that must not
//! remain.

mod copies;
mod cycles;
mod lexer;
mod licences;
mod links;
mod open_structs;
mod phrases;
mod scan;
mod scanner;
mod signatures;
mod table;
mod tolerances;
mod watches;

use std::collections::HashMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use scan::{Function, Reference};

const MAX_FILE_LINES: usize = 800;
const GOOD_FILE_LINES: usize = 400;
const MAX_FUNCTION_LINES: usize = 80;
const GOOD_FUNCTION_LINES: usize = 35;

/// One source file of the library or the run time, scanned.
#[derive(Clone)]
struct Source {
    /// Relative to the root of the repository.
    file: String,
    /// The path of its module; `["main"]` for `main.rs`, empty for `lib.rs`.
    module: Vec<String>,
    text: String,
    tokens: Vec<lexer::Token>,
}

impl Source {
    fn new(file: &str, text: String) -> Self {
        Source { file: file.to_owned(), module: module_of(file), tokens: lexer::tokens(&text), text }
    }

    /// Whether the file is generated, as declared in one of its first lines. Size limits do not apply to it.
    fn is_generated(&self) -> bool {
        self.text.lines().take(5).any(|line| line.contains("@generated"))
    }

    fn references(&self) -> Vec<Reference> {
        scan::references(&self.tokens, &self.module)
    }

    fn functions(&self) -> Vec<Function> {
        if self.is_generated() { Vec::new() } else { scan::functions(&self.tokens) }
    }
}

/// `crates/algebra/src/poly/ring.rs` is `poly::ring`, `src/cli/mod.rs` is `cli`. The root of groebot-solver is `solver`, as the other crates re-export it.
fn module_of(file: &str) -> Vec<String> {
    let path = file.split_once("src/").map_or(file, |(_, path)| path).trim_end_matches(".rs");
    let path = path.strip_suffix("/mod").unwrap_or(path);
    let inside = if path == "lib" { None } else { Some(path.split('/').map(str::to_owned)) };
    let crate_root = file.starts_with("crates/solver/").then(|| scan::SOLVER.to_owned());
    crate_root.into_iter().chain(inside.into_iter().flatten()).collect()
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All files below `folder`, relative to the root, without build output and hidden folders.
fn files_below(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(root().join(folder)).unwrap() {
        let name = entry.as_ref().unwrap().file_name().into_string().unwrap();
        let path = folder.join(&name);
        if entry.unwrap().file_type().unwrap().is_file() {
            files.push(path);
        } else if !name.starts_with('.') && name != "target" && name != "node_modules" {
            files.extend(files_below(&path));
        }
    }
    files
}

/// The crates that solvers do not need at run time, in the order of their dependencies. The facade is last.
const CRATES: [&str; 6] = ["crates/algebra/", "crates/robot/", "crates/solver/", "crates/ik/", "crates/humanoid/", ""];

/// The source files of all crates of the library.
fn sources() -> Vec<Source> {
    CRATES.iter().flat_map(|folder| sources_below(&format!("{folder}src"))).collect()
}

/// The source files of the run time.
fn runtime() -> Vec<Source> {
    sources_below("runtime/src")
}

fn sources_below(folder: &str) -> Vec<Source> {
    texts_below(folder, &["rs"]).into_iter().map(|(file, text)| Source::new(&file, text)).collect()
}

/// The files below a folder whose names end with one of `ends`, with their texts.
fn texts_below(folder: &str, ends: &[&str]) -> Vec<(String, String)> {
    let mut files: Vec<String> = files_below(Path::new(folder)).iter().map(|path| slashed(path)).collect();
    files.retain(|file| file.rsplit_once('.').is_some_and(|(_, end)| ends.contains(&end)));
    files.sort();
    files.into_iter().map(|file| (file.clone(), fs::read_to_string(root().join(file)).unwrap())).collect()
}

/// Other code: the run time in C, and the templates of generated files.
fn other_code() -> Vec<(String, String)> {
    [texts_below("runtime/c", &["c", "h"]), texts_below("crates/ik/src/codegen/skeleton", &["txt"])].concat()
}

fn slashed(path: &Path) -> String {
    path.to_str().unwrap().replace('\\', "/")
}

/// The files that git tracks, or all files if there is no git.
fn tracked_files() -> Vec<PathBuf> {
    match Command::new("git").args(["ls-files", "-z"]).current_dir(root()).output() {
        Ok(output) if output.status.success() => {
            String::from_utf8(output.stdout).unwrap().split_terminator('\0').map(PathBuf::from).collect()
        }
        _ => files_below(Path::new("")),
    }
}

/// The violations of the dependency table in `sources`, one line each.
fn forbidden_uses(sources: &[Source]) -> Vec<String> {
    let exports: HashMap<String, Vec<String>> = (sources.iter().filter(|source| source.module.is_empty()))
        .flat_map(|source| scan::exports(&source.tokens))
        .filter(|(name, path)| path[..] != [name.clone()])
        .collect();
    let mut found = Vec::new();
    for source in sources {
        if source.module.first().is_some_and(|top| top != "main" && !table::knows(top)) {
            let top = &source.module[0];
            found.push(format!("{}: `{top}` is not in the table of tests/architecture/table.rs; add it", source.file));
        }
        for Reference { path, line } in source.references() {
            let target = path.first().and_then(|name| exports.get(name)).unwrap_or(&path);
            if let Some(objection) = table::objection(&source.module, target) {
                found.push(format!("{}:{line}: {objection}", source.file));
            }
        }
    }
    found.dedup();
    found
}

/// Describes the violation of a size limit by a file.
fn oversized_file(file: &str, text: &str) -> Option<String> {
    let lines = text.lines().count();
    if lines > GOOD_FILE_LINES && lines <= MAX_FILE_LINES {
        println!("{file}: {lines} lines, over {GOOD_FILE_LINES}: think of splitting it");
    }
    (lines > MAX_FILE_LINES).then(|| format!("{file}: {lines} lines; at most {MAX_FILE_LINES}"))
}

fn oversized(sources: &[Source]) -> Vec<String> {
    let mut found = Vec::new();
    for source in sources.iter().filter(|source| !source.is_generated()) {
        found.extend(oversized_file(&source.file, &source.text));
        for Function { name, line, lines } in source.functions() {
            if lines > MAX_FUNCTION_LINES {
                found.push(format!("{}:{line}: `{name}` has {lines} lines; at most {MAX_FUNCTION_LINES}", source.file));
            }
        }
    }
    found
}

fn leftovers(sources: &[Source]) -> Vec<String> {
    let mut found = Vec::new();
    for source in sources {
        let mut names = vec!["todo", "unimplemented", "dbg"];
        if !source.module.first().is_some_and(|top| top == "cli" || top == "main") {
            names.extend(["print", "println", "eprint", "eprintln"]);
        }
        for (name, line) in scan::macro_calls(&source.tokens, &names) {
            found.push(format!("{}:{line}: `{name}!` has no place here", source.file));
        }
    }
    found
}

/// The files that contain `needle`.
fn mentions<'a>(files: &'a [(PathBuf, Vec<u8>)], needle: &str) -> Vec<&'a Path> {
    let has_it = |bytes: &[u8]| bytes.windows(needle.len()).any(|window| window == needle.as_bytes());
    files.iter().filter(|(_, bytes)| has_it(bytes)).map(|(path, _)| path.as_path()).collect()
}

fn assert_none(found: &[String]) {
    assert!(found.is_empty(), "{} found:\n{}", found.len(), found.join("\n"));
}

#[test]
fn dependencies_run_one_way() {
    assert_none(&forbidden_uses(&sources()));
}

#[test]
fn no_files_import_each_other() {
    assert_none(&cycles::on_rings(&sources()));
    assert_none(&cycles::on_rings(&runtime()));
}

#[test]
fn files_and_functions_are_small() {
    assert_none(&oversized(&sources()));
    assert_none(&oversized(&runtime()));
    let other: Vec<String> = other_code().iter().filter_map(|(file, text)| oversized_file(file, text)).collect();
    assert_none(&other);
}

#[test]
fn nine_functions_of_ten_are_short() {
    let all = [sources(), runtime()].concat();
    let mut sizes: Vec<usize> = all.iter().flat_map(Source::functions).map(|function| function.lines).collect();
    sizes.sort_unstable();
    let (median, ninth) = (sizes[sizes.len() / 2], sizes[sizes.len() * 9 / 10]);
    println!("{} functions: median {median} lines, nine of ten at most {ninth}", sizes.len());
    assert!(median <= 10 && ninth <= GOOD_FUNCTION_LINES, "median {median}, nine of ten {ninth} lines");
}

#[test]
fn no_stub_and_no_stray_print_is_left() {
    assert_none(&leftovers(&sources()));
    assert_none(&leftovers(&runtime()));
}

#[test]
fn nothing_points_outside_the_repository() {
    let read = |path: PathBuf| fs::read(root().join(&path)).ok().map(|bytes| (path, bytes));
    let files: Vec<_> = tracked_files().into_iter().filter_map(read).collect();
    assert!(files.iter().any(|(path, _)| path == Path::new("Cargo.toml")), "the list of files is wrong");
    for folder in ["..", "/work"] {
        let needle = format!("{folder}/shared");
        assert_eq!(mentions(&files, &needle), [] as [&Path; 0], "no clone has `{needle}`");
    }
}

/// A commit with build output exceeds the size limit of a push, even if a later commit removes it.
#[test]
fn no_build_output_is_tracked() {
    let files: Vec<String> = tracked_files().iter().map(|path| slashed(path)).collect();
    let is_output =
        |file: &&String| file.split('/').any(|part| ["target", "node_modules", "__pycache__"].contains(&part));
    assert_none(&files.iter().filter(is_output).cloned().collect::<Vec<_>>());
    let is_large = |file: &&String| fs::metadata(root().join(file)).is_ok_and(|found| found.len() > 2_500_000);
    assert_none(&files.iter().filter(is_large).cloned().collect::<Vec<_>>());
}

#[test]
fn every_test_module_is_part_of_the_one_binary() {
    // The tests of groebot-solver are with those of groebot-ik, which derive what they evaluate.
    for folder in CRATES.iter().filter(|folder| **folder != "crates/solver/").map(|folder| format!("{folder}tests/")) {
        let main = fs::read_to_string(root().join(&folder).join("main.rs")).unwrap();
        let declared = scan::file_modules(&lexer::tokens(&main));
        for path in files_below(Path::new(&folder)) {
            let file = slashed(&path);
            let name = file.trim_start_matches(&folder).trim_end_matches("/mod.rs").trim_end_matches(".rs");
            let is_module = file.ends_with(".rs") && !name.contains('/') && name != "main";
            assert!(
                !is_module || declared.iter().any(|module| module == name),
                "{folder}main.rs does not declare `{name}`"
            );
        }
    }
}
