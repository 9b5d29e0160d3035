//! Public functions have few positional arguments: more belong in a struct with named fields, or in a builder.

use super::lexer::{Token, tokens};
use super::{Source, runtime, sources};

/// The greatest number of arguments of a public function, without `self`.
const MOST_ARGUMENTS: usize = 5;

/// The signature of a function.
pub struct Signature {
    pub name: String,
    pub line: usize,
    /// The index of its `fn` among the tokens.
    pub at: usize,
    /// The tokens of each argument, without `self`.
    pub arguments: Vec<Vec<String>>,
}

/// The functions that are declared `pub`.
pub fn public_functions(tokens: &[Token]) -> Vec<Signature> {
    let text = |at: usize| tokens.get(at).map_or("", |token| token.text.as_str());
    let starts = (0..tokens.len()).filter(|&at| text(at) == "pub").filter_map(|at| {
        let at = (at + 1..tokens.len()).find(|&next| !["const", "unsafe", "async", "extern"].contains(&text(next)))?;
        (text(at) == "fn").then_some(at)
    });
    starts.filter_map(|start| signature(tokens, start)).collect()
}

/// The signature of the function whose `fn` is at `start`.
fn signature(tokens: &[Token], start: usize) -> Option<Signature> {
    let name = tokens.get(start + 1)?;
    let (mut depth, mut is_open) = (0, false);
    let mut arguments = vec![Vec::new()];
    for (before, token) in tokens[start + 1..].iter().zip(&tokens[start + 2..]) {
        let text = token.text.as_str();
        match text {
            "(" if !is_open && depth == 0 => is_open = true,
            ")" if is_open && depth == 0 => break,
            "," if is_open && depth == 0 => arguments.push(Vec::new()),
            "(" | "[" | "{" | "<" => depth += 1,
            ")" | "]" | "}" => depth -= 1,
            // Not the arrow of a closure's result.
            ">" if before.text != "-" => depth -= 1,
            _ => {}
        }
        if is_open && !(text == "," && depth == 0) && !(text == "(" && depth == 0) {
            arguments.last_mut()?.push(token.text.clone());
        }
    }
    arguments.retain(|argument| !argument.is_empty() && argument.last().is_none_or(|last| last != "self"));
    Some(Signature { name: name.text.clone(), line: name.line, at: start, arguments })
}

fn too_long(source: &Source) -> Vec<String> {
    let line = |function: Signature| {
        let count = function.arguments.len();
        (count > MOST_ARGUMENTS).then(|| format!("{}:{}: `{}` has {count}", source.file, function.line, function.name))
    };
    public_functions(&source.tokens).into_iter().filter_map(line).collect()
}

#[test]
fn public_functions_have_at_most_five_arguments() {
    let found: Vec<String> =
        sources().iter().chain(&runtime()).filter(|source| !source.is_generated()).flat_map(too_long).collect();
    assert!(found.is_empty(), "positional arguments:\n{}", found.join("\n"));
}

#[test]
fn arguments_are_counted_without_self_and_within_brackets() {
    let text = "impl<T: Fn(u8, u8) -> u8> A {
        pub fn none(&mut self) {}
        pub fn two<F: Fn(u8) -> u8, const N: usize>(&'a self, (a, b): (u8, u8), f: impl Fn(u8, u8) -> Vec<u8>,) -> u8 {}
        pub const fn six(a: [u8; 3], b: u8, c: u8, d: u8, e: Map<u8, u8>, f: u8) where T: Fn(u8) {}
        pub(crate) fn inner(a: u8, b: u8, c: u8, d: u8, e: u8, f: u8) {}
    }";
    let counts: Vec<(String, usize)> =
        public_functions(&tokens(text)).into_iter().map(|own| (own.name, own.arguments.len())).collect();
    assert_eq!(counts, [("none".to_owned(), 0), ("two".to_owned(), 2), ("six".to_owned(), 6)]);
}
