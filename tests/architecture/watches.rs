//! No public function requires a `Watch`: its argument is `impl Into<Option<&Watch>>`, so that `None` is enough.

use std::collections::HashSet;

use super::lexer::Token;
use super::signatures::{Signature, public_functions};
use super::{CRATES, Source, sources_below};

fn text(tokens: &[Token], at: usize) -> &str {
    tokens.get(at).map_or("", |token| token.text.as_str())
}

/// The modules that a file declares as `pub mod name;`.
fn public_modules(tokens: &[Token]) -> impl Iterator<Item = String> + '_ {
    let is_public =
        |at: &usize| text(tokens, *at) == "mod" && text(tokens, at + 2) == ";" && text(tokens, at - 1) == "pub";
    (1..tokens.len()).filter(is_public).map(|at| text(tokens, at + 1).to_owned())
}

/// The names in the `pub use` of a file.
fn exported(tokens: &[Token]) -> impl Iterator<Item = String> + '_ {
    let starts = (0..tokens.len()).filter(|&at| text(tokens, at) == "pub" && text(tokens, at + 1) == "use");
    let words =
        |start: usize| tokens[start + 2..].iter().map(|token| token.text.clone()).take_while(|text| text != ";");
    starts.flat_map(words)
}

/// The type of the `impl` block around each token; empty outside of one.
fn owners(tokens: &[Token]) -> Vec<String> {
    let mut owners = vec![String::new(); tokens.len()];
    let mut at = 0;
    while at < tokens.len() {
        let is_block = text(tokens, at) == "impl" && (at == 0 || matches!(text(tokens, at - 1), "}" | ";" | "]" | "{"));
        if !is_block {
            at += 1;
            continue;
        }
        let (open, name) = implemented(tokens, at);
        let mut depth = 0;
        at = open;
        while at < tokens.len() {
            depth += i32::from(text(tokens, at) == "{") - i32::from(text(tokens, at) == "}");
            owners[at].clone_from(&name);
            at += 1;
            if depth == 0 {
                break;
            }
        }
    }
    owners
}

/// The opening brace of an `impl` block, and the name of its type.
fn implemented(tokens: &[Token], start: usize) -> (usize, String) {
    let (mut depth, mut name, mut at) = (0, String::new(), start + 1);
    while at < tokens.len() && text(tokens, at) != "{" && text(tokens, at) != "where" {
        match text(tokens, at) {
            "<" => depth += 1,
            ">" if text(tokens, at - 1) != "-" => depth -= 1,
            "for" if depth == 0 => name.clear(),
            word if depth == 0 && word.starts_with(|c: char| c.is_alphabetic()) => word.clone_into(&mut name),
            _ => {}
        }
        at += 1;
    }
    let open = (at..tokens.len()).find(|&at| text(tokens, at) == "{").unwrap_or(tokens.len());
    (open, name)
}

/// Whether an argument is a reference to a watch that the caller must have.
fn is_required_watch(argument: &[String]) -> bool {
    let words: Vec<&str> = argument.iter().map(String::as_str).collect();
    let after = words.iter().position(|word| *word == ":").map_or(&words[..], |colon| &words[colon + 1..]);
    matches!(after, ["&", "Watch"] | ["&", _, "Watch"] | ["&", "'", _, "Watch"])
}

/// The public functions of a crate that require a watch.
fn requiring(crate_sources: &[Source]) -> Vec<String> {
    let file_of = |module: &[String]| crate_sources.iter().find(|source| source.module == module);
    let is_public = |module: &[String]| {
        (0..module.len()).all(|depth| {
            let parent = file_of(&module[..depth]);
            parent.is_some_and(|parent| public_modules(&parent.tokens).any(|name| name == module[depth]))
        })
    };
    let public: Vec<&Source> = crate_sources.iter().filter(|source| is_public(&source.module)).collect();
    let names: HashSet<String> = public.iter().flat_map(|source| exported(&source.tokens)).collect();
    let offences = |source: &Source| -> Vec<String> {
        let owners = owners(&source.tokens);
        let is_seen = |function: &Signature| {
            let owner = &owners[function.at];
            is_public(&source.module) || names.contains(if owner.is_empty() { &function.name } else { owner })
        };
        let requires = |function: &Signature| function.arguments.iter().any(|argument| is_required_watch(argument));
        let functions = public_functions(&source.tokens);
        let found = functions.iter().filter(|function| requires(function) && is_seen(function));
        found.map(|function| format!("{}:{}: `{}`", source.file, function.line, function.name)).collect()
    };
    crate_sources.iter().flat_map(offences).collect()
}

#[test]
fn no_public_function_requires_a_watch() {
    let found: Vec<String> =
        CRATES.iter().flat_map(|folder| requiring(&sources_below(&format!("{folder}src")))).collect();
    assert!(found.is_empty(), "give these `watch: impl Into<Option<&Watch>>`:\n{}", found.join("\n"));
}

#[test]
fn public_functions_that_require_a_watch_are_found() {
    let source = |file: &str, text: &str| Source::new(file, text.to_owned());
    let inner = "pub fn seen(watch: &Watch) {} pub fn unseen(watch: &Watch) {} pub struct Own;
        impl<T> Trait<T> for Own { fn not(watch: &Watch) {} }
        impl Own { pub fn method<'a>(&self, watch: &'a Watch) {} pub fn free<'a>(watch: impl Into<Option<&'a Watch>>) {} }
        impl Other { pub fn hidden(watch: &Watch) {} }";
    let sources = [
        source("src/lib.rs", "mod inner; pub mod open; pub use inner::{Own, seen};"),
        source("src/inner.rs", inner),
        source("src/open.rs", "pub fn plain(watch: &Watch, n: usize) {} pub(crate) fn own(watch: &Watch) {}"),
    ];
    let found = requiring(&sources);
    let names: Vec<&str> = found.iter().map(|line| line.split('`').nth(1).unwrap()).collect();
    assert_eq!(names, ["seen", "method", "plain"], "{found:?}");
}
