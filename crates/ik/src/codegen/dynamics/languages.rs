//! Equations of motion in Rust and in C99. Main types: [`Rust`], [`C`].

use super::function::Function;
use super::language::{Language, Table, results, rows};
use crate::codegen::language::{Expressions, number};
use crate::codegen::printer::{INDENT, spread};
use groebot_robot::dynamics::Equations;

/// Rust, with the crate groebot-runtime.
pub(super) struct Rust;

impl Language for Rust {
    fn expressions(&self) -> &dyn Expressions {
        self
    }

    fn answer(&self, function: Function, freedoms: usize, results: Vec<String>) -> (Vec<String>, String) {
        let row = |row: &[String]| spread("[", row, "]").join("\n    ");
        let matrix = |rows: &[String]| {
            let rows: Vec<String> = rows.chunks(freedoms).map(row).collect();
            format!("[\n    {},\n    ]", rows.join(",\n    "))
        };
        let answer = match function {
            Function::Derivatives => {
                let both: Vec<String> = results.chunks(freedoms * freedoms).map(matrix).collect();
                format!("[{}]", both.join(", "))
            }
            Function::Inertia | Function::Coriolis => matrix(&results),
            _ => row(&results),
        };
        (Vec::new(), answer)
    }

    fn parameters(&self, _: Function, _: &Equations) -> String {
        String::new()
    }

    fn start(&self, function: Function) -> Vec<String> {
        let (names, are_matrices) = results(function);
        let zeros = if are_matrices { "[[0.0; FREEDOMS]; FREEDOMS]" } else { "[0.0; FREEDOMS]" };
        names.iter().map(|name| format!("let mut {name} = {zeros};")).collect()
    }

    fn finish(&self, function: Function) -> String {
        match results(function) {
            ([one], _) => (*one).to_owned(),
            (all, _) => format!("[{}]", all.join(", ")),
        }
    }

    fn entry(&self, matrix: &str, row: &str, column: &str) -> String {
        format!("{matrix}[{row}][{column}]")
    }

    fn zeros(&self, name: &str, count: usize) -> String {
        format!("let mut {name} = [[0.0; {count}]; BODIES];")
    }

    fn zero_row(&self, name: &str, count: usize) -> String {
        format!("let mut {name} = [0.0; {count}];")
    }

    fn index(&self, name: &str, value: &str) -> String {
        format!("let {name} = {value};")
    }

    fn bodies(&self, inward: bool) -> &'static str {
        if inward { "for i in (1..BODIES).rev() {" } else { "for i in 1..BODIES {" }
    }

    fn climb(&self) -> [&'static str; 2] {
        ["let mut j = i;", "while j != 0 {"]
    }

    fn when(&self, condition: &str) -> String {
        format!("if {condition} {{")
    }

    fn tables(&self, tables: &[Table]) -> Vec<String> {
        let table = |table: &Table| {
            let rows = rows(table, ["[", "]"], number);
            let (name, kind) = match table {
                Table::Places(name, _) => (name, "usize".to_owned()),
                Table::Numbers(name, all) => (name, format!("[f64; {}]", all[0].len())),
            };
            format!("static {name}: [{kind}; BODIES] = [{rows}];")
        };
        tables.iter().map(table).collect()
    }
}

/// C99, with groebot_dynamics.h.
pub(super) struct C;

impl Language for C {
    fn expressions(&self) -> &dyn Expressions {
        self
    }

    fn answer(&self, function: Function, freedoms: usize, results: Vec<String>) -> (Vec<String>, String) {
        let size = freedoms * freedoms;
        let written = |(at, result): (usize, String)| match function {
            Function::Derivatives if at < size => format!("by_q[{at}] = {result};"),
            Function::Derivatives => format!("by_v[{}] = {result};", at - size),
            _ => format!("out[{at}] = {result};"),
        };
        (results.into_iter().enumerate().map(written).collect(), String::new())
    }

    fn parameters(&self, function: Function, equations: &Equations) -> String {
        let (coordinates, freedoms) = (equations.coordinates(), equations.freedoms());
        let read = |(name, count): (&str, usize)| format!("const gb_real {name}[{count}]");
        let reads = std::iter::once(("q", coordinates)).chain(function.inputs().iter().map(|name| (*name, freedoms)));
        let (names, are_matrices) = results(function);
        let size = if are_matrices { freedoms * freedoms } else { freedoms };
        let writes = names.iter().map(|name| format!("gb_real {name}[{size}]"));
        reads.map(read).chain(writes).collect::<Vec<_>>().join(", ")
    }

    fn start(&self, function: Function) -> Vec<String> {
        let (names, are_matrices) = results(function);
        let count = if are_matrices { "FREEDOMS * FREEDOMS" } else { "FREEDOMS" };
        let zero = |name: &&str| format!("{INDENT}{name}[k] = 0;");
        let head = format!("for (int k = 0; k < {count}; ++k) {{");
        std::iter::once(head).chain(names.iter().map(zero)).chain(["}".to_owned()]).collect()
    }

    fn finish(&self, _: Function) -> String {
        String::new()
    }

    fn entry(&self, matrix: &str, row: &str, column: &str) -> String {
        format!("{matrix}[{row} * FREEDOMS + {column}]")
    }

    fn zeros(&self, name: &str, count: usize) -> String {
        format!("gb_real {name}[BODIES][{count}] = {{{{0}}}};")
    }

    fn zero_row(&self, name: &str, count: usize) -> String {
        format!("gb_real {name}[{count}] = {{0}};")
    }

    fn index(&self, name: &str, value: &str) -> String {
        format!("const int {name} = {value};")
    }

    fn bodies(&self, inward: bool) -> &'static str {
        if inward { "for (int i = BODIES - 1; i > 0; --i) {" } else { "for (int i = 1; i < BODIES; ++i) {" }
    }

    fn climb(&self) -> [&'static str; 2] {
        ["int j = i;", "while (j != 0) {"]
    }

    fn when(&self, condition: &str) -> String {
        format!("if ({condition}) {{")
    }

    fn tables(&self, tables: &[Table]) -> Vec<String> {
        let table = |table: &Table| {
            // Integers are valid in either precision.
            let literal = |value: f64| if value == value.trunc() { value.to_string() } else { self.literal(value) };
            let rows = rows(table, ["{", "}"], literal);
            match table {
                Table::Places(name, _) => format!("static const int {name}[BODIES] = {{{rows}}};"),
                Table::Numbers(name, all) => {
                    format!("static const gb_real {name}[BODIES][{}] = {{{rows}}};", all[0].len())
                }
            }
        };
        tables.iter().map(table).collect()
    }
}

impl Expressions for Rust {
    fn is_reserved(&self, _: &str) -> bool {
        false
    }

    fn call(&self, function: &str, argument: &str) -> String {
        format!("f64::{function}({argument})")
    }

    fn root(&self, square: &str) -> String {
        format!("f64::sqrt({square})")
    }

    fn declare(&self, name: &str, value: &str) -> String {
        format!("let {name} = {value};")
    }

    fn infinity(&self, positive: bool) -> String {
        if positive { "f64::INFINITY" } else { "f64::NEG_INFINITY" }.to_owned()
    }

    fn quote(&self, text: &str) -> String {
        format!("\"{}\"", text.escape_default())
    }
}

impl Expressions for C {
    fn is_reserved(&self, _: &str) -> bool {
        false
    }

    fn call(&self, function: &str, argument: &str) -> String {
        format!("{function}({argument})")
    }

    fn root(&self, square: &str) -> String {
        format!("sqrt({square})")
    }

    fn literal(&self, value: f64) -> String {
        let text = number(value);
        text.strip_prefix('-').map_or_else(|| format!("GB_N({text})"), |size| format!("-GB_N({size})"))
    }

    fn declare(&self, name: &str, value: &str) -> String {
        format!("const gb_real {name} = {value};")
    }

    fn infinity(&self, positive: bool) -> String {
        if positive { "INFINITY" } else { "-INFINITY" }.to_owned()
    }

    fn quote(&self, text: &str) -> String {
        format!("\"{text}\"")
    }
}
