//! The references of a source file and the lengths of its functions, from its tokens.

use super::lexer::Token;

/// A path that starts at the crate root, without `crate`: `crate::poly::Ring` is `["poly", "Ring"]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    pub path: Vec<String>,
    pub line: usize,
}

/// A function with a body.
#[derive(Clone, Debug, PartialEq)]
pub struct Function {
    pub name: String,
    pub line: usize,
    /// Number of lines, from that of `fn` to that of the closing brace.
    pub lines: usize,
}

/// All paths in `tokens` that refer to the crates of this repository: in `use` items and inline, with `crate`, a crate's name, `self` and `super`. `module` is
/// the path of the file's module.
pub fn references(tokens: &[Token], module: &[String]) -> Vec<Reference> {
    let mut scan = Scan { tokens, module, inner: Vec::new(), found: Vec::new() };
    let mut at = 0;
    while at < tokens.len() {
        at = scan.step(at);
    }
    scan.found
}

struct Scan<'a> {
    tokens: &'a [Token],
    module: &'a [String],
    /// One entry for each open brace: the name of the inline module that it opens, if it opens one.
    inner: Vec<Option<String>>,
    found: Vec<Reference>,
}

impl Scan<'_> {
    fn text(&self, at: usize) -> &str {
        text(self.tokens, at)
    }

    /// Handles the token at `at`. Returns the index of the next one.
    fn step(&mut self, at: usize) -> usize {
        match self.text(at) {
            "{" => {
                let opens_module = at >= 2 && self.text(at - 2) == "mod";
                let name = opens_module.then(|| self.text(at - 1).to_owned());
                self.inner.push(name);
            }
            "}" => drop(self.inner.pop()),
            // `use<'a>` in a type captures lifetimes; it imports nothing.
            "use" if self.text(at + 1) != "<" => return self.use_item(at + 1),
            "self" | "super" if self.starts_path(at) => return self.inline_path(at),
            name if is_crate(name) && self.starts_path(at) => return self.inline_path(at),
            _ => {}
        }
        at + 1
    }

    fn starts_path(&self, at: usize) -> bool {
        self.text(at + 1) == "::" && (at == 0 || self.text(at - 1) != "::")
    }

    fn inline_path(&mut self, at: usize) -> usize {
        let (mut end, mut path) = (at + 1, vec![self.text(at).to_owned()]);
        while self.text(end) == "::" && is_name(self.text(end + 1)) {
            path.push(self.text(end + 1).to_owned());
            end += 2;
        }
        self.record(&path, self.tokens[at].line);
        end
    }

    fn use_item(&mut self, at: usize) -> usize {
        let (imports, end) = imports(self.tokens, at, &[]);
        for import in imports {
            self.record(&import.path, import.line);
        }
        end
    }

    fn record(&mut self, path: &[String], line: usize) {
        let here = self.module.iter().chain(self.inner.iter().flatten()).cloned().collect();
        self.found.extend(resolve(path, here).map(|path| Reference { path, line }));
    }
}

/// One leaf of a `use` item, as written.
struct Import {
    path: Vec<String>,
    /// The local name of the import.
    name: String,
    line: usize,
}

/// The leaves of the `use` tree that starts at `start` below the path `prefix`, and the index after the tree.
fn imports(tokens: &[Token], start: usize, prefix: &[String]) -> (Vec<Import>, usize) {
    let (mut at, mut path, mut name) = (start, prefix.to_vec(), None);
    while at < tokens.len() {
        match text(tokens, at) {
            "{" => return import_group(tokens, at + 1, &path),
            "as" => name = tokens.get(at + 1).map(|token| token.text.clone()),
            "," | "}" | ";" => break,
            "::" => {}
            _ if name.is_some() => {}
            segment => path.push(segment.to_owned()),
        }
        at += 1;
    }
    let name = name.or_else(|| path.last().cloned()).unwrap_or_default();
    (vec![Import { path, name, line: tokens[start].line }], at)
}

fn import_group(tokens: &[Token], start: usize, prefix: &[String]) -> (Vec<Import>, usize) {
    let (mut at, mut all) = (start, Vec::new());
    while at < tokens.len() && text(tokens, at) != "}" {
        if text(tokens, at) == "," {
            at += 1;
        } else {
            let (some, end) = imports(tokens, at, prefix);
            all.extend(some);
            at = end;
        }
    }
    (all, at + 1)
}

/// The re-exports of the crate root, as (name, path from the root): `pub use error::Error`.
pub fn exports(root: &[Token]) -> Vec<(String, Vec<String>)> {
    lent(root, &[])
}

/// The re-exports of the module with these tokens, as (name, path from the root).
pub fn lent(tokens: &[Token], module: &[String]) -> Vec<(String, Vec<String>)> {
    let starts = (0..tokens.len()).filter(|&i| text(tokens, i) == "use" && text(tokens, i + 1) != "<");
    let leaves = starts.flat_map(|start| imports(tokens, start + 1, &[]).0).filter(|leaf| leaf.path.len() > 1);
    let local = |path: &[String]| module.iter().chain(path).cloned().collect();
    leaves.map(|leaf| (leaf.name, resolve(&leaf.path, module.to_vec()).unwrap_or_else(|| local(&leaf.path)))).collect()
}

/// The module that the other crates re-export groebot-solver as.
pub const SOLVER: &str = "solver";

/// Whether `name` at the start of a path is a crate of this repository. No two crates have a module with the same name.
fn is_crate(name: &str) -> bool {
    matches!(
        name,
        "crate"
            | "groebot"
            | "groebot_algebra"
            | "groebot_robot"
            | "groebot_solver"
            | "groebot_ik"
            | "groebot_humanoid"
    )
}

/// `path` from the crate root, resolved in the module `here`; `None` if it starts with another crate or a local name.
fn resolve(path: &[String], here: Vec<String>) -> Option<Vec<String>> {
    let in_solver = here.first().is_some_and(|top| top == SOLVER);
    let mut base = match path.first()?.as_str() {
        "groebot_solver" => vec![SOLVER.to_owned()],
        "crate" if in_solver => vec![SOLVER.to_owned()],
        name if is_crate(name) => Vec::new(),
        "self" | "super" => here,
        _ => return None,
    };
    for (i, segment) in path.iter().enumerate() {
        match segment.as_str() {
            "super" => drop(base.pop()),
            name if i == 0 && is_crate(name) => {}
            "self" => {}
            _ => base.push(segment.clone()),
        }
    }
    Some(base)
}

/// All functions of `tokens` with a body. An inner function counts for itself and for the outer one.
pub fn functions(tokens: &[Token]) -> Vec<Function> {
    let starts = (0..tokens.len()).filter(|&i| text(tokens, i) == "fn" && is_name(text(tokens, i + 1)));
    starts.filter_map(|start| function(tokens, start)).collect()
}

fn function(tokens: &[Token], start: usize) -> Option<Function> {
    let (mut brackets, mut braces) = (0, 0);
    for token in &tokens[start..] {
        match token.text.as_str() {
            "(" | "[" => brackets += 1,
            ")" | "]" => brackets -= 1,
            ";" if brackets == 0 && braces == 0 => return None,
            "{" => braces += 1,
            "}" if braces == 1 => {
                let line = tokens[start].line;
                return Some(Function { name: tokens[start + 1].text.clone(), line, lines: token.line - line + 1 });
            }
            "}" => braces -= 1,
            _ => {}
        }
    }
    None
}

/// The calls of the macros `names`, as (name, line).
pub fn macro_calls(tokens: &[Token], names: &[&str]) -> Vec<(String, usize)> {
    let is_call = |i: &usize| {
        names.contains(&text(tokens, *i))
            && text(tokens, i + 1) == "!"
            && matches!(text(tokens, i + 2), "(" | "[" | "{")
    };
    (0..tokens.len()).filter(is_call).map(|i| (tokens[i].text.clone(), tokens[i].line)).collect()
}

/// The modules that `tokens` declare in separate files: `mod name;`.
pub fn file_modules(tokens: &[Token]) -> Vec<String> {
    let is_declared = |i: &usize| text(tokens, *i) == "mod" && text(tokens, i + 2) == ";";
    (0..tokens.len()).filter(is_declared).map(|i| text(tokens, i + 1).to_owned()).collect()
}

fn text(tokens: &[Token], at: usize) -> &str {
    tokens.get(at).map_or("", |token| token.text.as_str())
}

fn is_name(text: &str) -> bool {
    text.chars().next().is_some_and(|c| c.is_alphabetic() || c == '_')
}
