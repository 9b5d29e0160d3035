//! Rust: a file on `core` alone.

use super::batch;
use super::joined::Declaration;
use super::language::{Finish, Language, State};
use super::outline::Outline;
use super::printer::{INDENT, negation, spread};
use crate::solver::Program;

const SKELETON: &str = concat!(
    include_str!("skeleton/solver.rs.txt"),
    include_str!("skeleton/lanes.rs.txt"),
    include_str!("skeleton/batch.rs.txt"),
    include_str!("skeleton/numbers.rs.txt")
);

const RESERVED: &str = "as async await break const continue crate dyn else enum extern false fn for gen if impl in let \
    loop match mod move mut pub ref return self Self static struct super trait true type unsafe use where while abstract \
    become box do final macro override priv try typeof unsized virtual yield union None Some Ok Err f64 usize bool str \
    core std libm";

const NUMBERS: Declaration = Declaration { head: "let ", glue: "; let " };

/// The solver of a valid program ([`Program::validate`]) as one Rust file (edition 2021 or 2024, Rust 1.89 or later).
///
/// It is a module or the root of a crate, allocates nothing and needs no dependency. Its head says how it is used.
pub fn emit(program: &Program) -> String {
    NUMBERS.joined(&super::fill(SKELETON, &Outline::new(program, &Rust { batch: false })))
}

/// The same with a function `solve_batch` that solves several targets at once, in the lanes of vector registers; none for a program of
/// which the cases that run at ordinary targets take other roots than square roots, or are several in a block.
pub fn emit_batch(program: &Program) -> Option<String> {
    let outline = || Outline::new(program, &Rust { batch: true });
    batch::is_possible(program).then(|| NUMBERS.joined(&super::fill(SKELETON, &outline())))
}

/// The language; where a `batch` of targets is solved at once, the walk is one over numbers of any kind `T`.
struct Rust {
    batch: bool,
}

impl Rust {
    /// The kind of numbers that the walk is computed of.
    fn kind(&self) -> &'static str {
        if self.batch { "T" } else { "f64" }
    }

    /// Whether roots are close, an expression.
    fn close(&self, text: &str) -> String {
        match text {
            "false" if self.batch => "T::SURE".to_owned(),
            _ if self.batch => text.replace(" || ", " | "),
            _ => text.to_owned(),
        }
    }
}

impl Language for Rust {
    fn is_reserved(&self, word: &str) -> bool {
        RESERVED.split_whitespace().any(|reserved| reserved == word)
    }

    fn field(&self, name: &str) -> String {
        format!("p.{name}")
    }

    fn known(&self, name: &str) -> String {
        format!("known.{name}")
    }

    fn shared(&self, name: &str) -> String {
        format!("shared.{name}")
    }

    fn argument(&self, name: &str, kind: &str) -> String {
        format!("{name}: &{kind}{}", if self.batch { "<T>" } else { "" })
    }

    fn count(&self, name: &str) -> String {
        format!("{name}: usize")
    }

    fn call(&self, function: &str, argument: &str) -> String {
        match function {
            "abs" => format!("{}::abs({argument})", self.kind()),
            _ => format!("{argument}.{function}()"),
        }
    }

    fn greater(&self, a: &str, b: &str) -> String {
        format!("{}::max({a}, {b})", self.kind())
    }

    fn walks_abreast(&self) -> bool {
        self.batch
    }

    fn root(&self, square: &str) -> String {
        if self.batch { format!("T::root({square})") } else { self.call("sqrt", &self.greater(square, "0.0")) }
    }

    fn alone(&self, constant: String) -> String {
        if self.batch { format!("T::of({constant})") } else { constant }
    }

    fn declare(&self, name: &str, value: &str) -> String {
        format!("let {name} = {value};")
    }

    fn declare_places(&self, names: &[Option<&str>]) -> Vec<String> {
        if names.iter().all(Option::is_none) {
            return Vec::new();
        }
        let names: Vec<String> = names.iter().map(|name| name.unwrap_or("_").to_owned()).collect();
        spread("let [", &names, "] = *at;")
    }

    fn infinity(&self, positive: bool) -> String {
        if positive { "f64::INFINITY" } else { "f64::NEG_INFINITY" }.to_owned()
    }

    fn quote(&self, text: &str) -> String {
        format!("\"{}\"", text.escape_default())
    }

    fn find_square_roots(&self, depth: usize, constant: &str, typical: &str) -> Vec<String> {
        let kind = if self.batch { "T::" } else { "" };
        vec![format!("let roots{depth} = {kind}square_roots({constant}, {typical});")]
    }

    fn find_roots(&self, depth: usize, polynomials: &[Vec<String>], typical: &str) -> Vec<String> {
        if let [only] = polynomials {
            return spread(&format!("let roots{depth} = real_roots(&["), only, &format!("], {typical});"));
        }
        let mut lines = Vec::new();
        for (index, list) in polynomials.iter().enumerate() {
            let head = format!("let choice{depth}_{index}: [f64; {}] = [", list.len());
            lines.extend(spread(&head, list, "];"));
        }
        let last = polynomials.len() - 1;
        for index in 0..last {
            let open = if index == 0 { format!("let roots{depth} = if") } else { "} else if".to_owned() };
            lines.push(format!("{open} leads(&choice{depth}_{index}) {{"));
            lines.push(format!("{INDENT}real_roots(&choice{depth}_{index}, {typical})"));
        }
        lines.extend([
            "} else {".to_owned(),
            format!("{INDENT}real_roots(&choice{depth}_{last}, {typical})"),
            "};".to_owned(),
        ]);
        lines
    }

    fn open_loop(&self, depth: usize, name: Option<&str>, first: bool) -> Vec<String> {
        let value = name.map_or_else(|| "_".to_owned(), |name| format!("&{name}"));
        let most = if first { ".take(1)" } else { "" };
        vec![format!("for (i{depth}, {value}) in roots{depth}.as_slice().iter().enumerate(){most} {{")]
    }

    fn only_if(&self, condition: &str) -> String {
        format!("if {condition} {{")
    }

    fn leave_unless(&self, condition: &str, is_rare: bool, beside: Option<&str>) -> Vec<String> {
        let together = |condition: &str| condition.replace(" && ", " & ");
        let far = |beside| format!(" || (answers.suffice_since(p, before) && {})", negation(beside));
        let is_left = match (self.batch, beside) {
            (true, Some(beside)) => {
                let (near, beside) = (together(condition), together(beside));
                format!("!T::is_due(answers, p, before, {near}, {beside}) || T::MANY")
            }
            (true, None) if is_rare => format!("!T::is_rare(answers, {}) || T::MANY", together(condition)),
            (true, None) => format!("!T::is_usual(answers, {})", together(condition)),
            (false, _) => negation(condition) + &beside.map_or_else(String::new, far),
        };
        vec![format!("if {is_left} {{"), format!("{INDENT}return;"), "}".to_owned()]
    }

    fn open_samples(&self, _: usize, names: &[Option<&str>], table: usize, _: usize) -> Vec<String> {
        let names: Vec<&str> = names.iter().map(|name| name.unwrap_or("_")).collect();
        let numbers = if self.batch { ".map(|row| row.map(T::of))" } else { "" };
        vec![format!("for [{}] in SAMPLES_{table}{numbers} {{", names.join(", "))]
    }

    fn six_axes(&self) -> &'static str {
        include_str!("skeleton/six_axes.rs.txt")
    }

    fn open_six_axes(&self, depth: usize, chain: usize, target: &[String]) -> Vec<String> {
        let mut lines = spread(&format!("let found{depth} = CHAIN_{chain}.solve(&["), target, "]);");
        lines.push(format!("for (i{depth}, six{depth}) in found{depth}.as_slice().iter().enumerate() {{"));
        lines
    }

    fn six_axes_joint(&self, depth: usize, joint: usize) -> String {
        format!("six{depth}.q[{joint}]")
    }

    fn six_axes_lost(&self, depth: usize) -> String {
        format!("six{depth}.lost")
    }

    fn six_axes_free(&self, depth: usize, joint: usize) -> String {
        format!("six{depth}.free[{joint}]")
    }

    fn finish(&self, answer: &Finish<'_>) -> Vec<String> {
        let mut lines = spread("let at = [", answer.at, "];");
        let q = if answer.q.is_empty() { "" } else { " q," };
        lines.extend(spread("let q = [", answer.q, "];").into_iter().filter(|_| !q.is_empty()));
        let free = list(answer.free).unwrap_or_else(|| answer.usual.clone());
        let extra = list(answer.extra).map(|list| format!(", &{list}")).unwrap_or_default();
        lines.push(format!(
            "{}p, {}, {}, &at,{q} {free}{extra});",
            if self.batch { "T::finish(answers, " } else { "answers.finish(" },
            answer.branch.join(", "),
            self.close(&answer.close)
        ));
        lines
    }

    fn go_on(&self, state: &State<'_>) -> Vec<String> {
        let nothing = if self.batch { "..nothing_known()" } else { "..NOTHING_KNOWN" };
        let [branch, last] = &state.branch;
        let mut fields =
            vec![format!("branch: {branch}"), format!("last: {last}"), format!("close: {}", self.close(&state.close))];
        fields.extend(state.pair.iter().map(|pair| format!("pair: {pair}")));
        fields.extend(list(state.free).map(|list| format!("free: {list}")));
        fields.extend(state.found.iter().cloned());
        fields.push(if state.goes_on { "..*known".to_owned() } else { nothing.to_owned() });
        vec![
            format!("let next = Known {{ {} }};", fields.join(", ")),
            format!("{}_{}(p, &next, answers);", if state.is_rare { "again" } else { "block" }, state.next),
        ]
    }
}

/// The items as an array, if there are any.
fn list(items: &[String]) -> Option<String> {
    (!items.is_empty()).then(|| format!("[{}]", items.join(", ")))
}
