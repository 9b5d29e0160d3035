//! Rust: a file that needs the run time `groebot-runtime`, or includes it.

use groebot_runtime::redundant::Arm;
use groebot_runtime::six_axes::Chain;

use super::dialect::{Applies, Dialect, GuardText, How};
use super::joined::Declaration;
use super::language::{Expressions, number};
use super::outline::Outline;
use super::parts::{PartText, Parts, RedundantText};
use super::printer::{INDENT, spread};
use crate::solver::Program;
use crate::solver::eigenvalue::SixAxes;

const SKELETON: &str = include_str!("skeleton/robot.rs.txt");

const RESERVED: &str = "as async await break const continue crate dyn else enum extern false fn for gen if impl in let \
    loop match mod move mut pub ref return self Self static struct super trait true type unsafe use where while abstract \
    become box do final macro override priv try typeof unsized virtual yield union None Some Ok Err f64 usize u32 bool str \
    core std N C";

const NUMBERS: Declaration = Declaration { head: "let ", glue: "; let " };

/// Prints the solver of a valid program ([`Program::validate`]) as one Rust file that needs the crate `groebot-runtime`
/// (edition 2024, Rust 1.89 or later).
pub fn emit(program: &Program) -> String {
    let parts = Parts::new(program);
    let (number, plain) = (Rust { kind: "N" }, Rust { kind: "f64" });
    let part = |joint: usize, program: &Program| {
        let text = super::fill(SKELETON, &Outline::of_part(&parts, (joint, program), &number, &plain));
        PartText { number: joint, facts: String::new(), program: text.trim().to_owned() }
    };
    let mut outline = Outline::new(&parts, &number, &plain);
    outline.redundant = RedundantText::new(&parts, arm, part);
    NUMBERS.joined(&super::fill(SKELETON, &outline))
}

/// The data of a redundant arm as an expression.
fn arm(arm: &Arm) -> String {
    let Arm { count, directions, points, slides, tip, task, length, limits, .. } = arm;
    let Arm { given, scanned, grid, sections, section_count, .. } = arm;
    let limits = format!("{limits:?}").replace("inf", "f64::INFINITY");
    let given = given.map(|given| format!("redundant::Given::{given:?}")).join(", ");
    let sections = sections.map(|section| format!("redundant::{section:?}")).join(", ");
    format!(
        "Arm {{\n    count: {count},\n    directions: {directions:?},\n    points: {points:?},\n    slides: {slides:?},\n    tip: {tip:?},\n    \
         task: Task::{task:?},\n    length: {length:?},\n    limits: {limits},\n    given: [{given}],\n    scanned: {scanned},\n    grid: {grid},\n    \
         sections: [{sections}],\n    section_count: {section_count},\n}}"
    )
}

/// The language, by the type of numbers in the code.
struct Rust {
    kind: &'static str,
}

impl Expressions for Rust {
    fn is_reserved(&self, word: &str) -> bool {
        RESERVED.split_whitespace().any(|reserved| reserved == word)
    }

    fn call(&self, function: &str, argument: &str) -> String {
        format!("{}::{function}({argument})", self.kind)
    }

    fn root(&self, square: &str) -> String {
        match self.kind {
            "f64" => format!("Number::root({square})"),
            _ => format!("N::root({square})"),
        }
    }

    fn alone(&self, constant: String) -> String {
        if self.kind == "f64" { constant } else { format!("N::of({constant})") }
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

    fn declare_all(&self, names: &[&str], array: &str) -> Vec<String> {
        spread("let [", &names.iter().map(|name| (*name).to_owned()).collect::<Vec<_>>(), &format!("] = *{array};"))
    }

    fn infinity(&self, positive: bool) -> String {
        if positive { "f64::INFINITY" } else { "f64::NEG_INFINITY" }.to_owned()
    }

    fn quote(&self, text: &str) -> String {
        format!("\"{}\"", text.escape_default())
    }
}

impl Dialect for Rust {
    fn find_square_roots(&self, number: usize, constant: &str, typical: &str, grazing: bool) -> String {
        let function = if grazing { "grazing_roots" } else { "square_roots" };
        format!("let roots{number} = N::{function}({constant}, {typical});")
    }

    fn find_roots(
        &self,
        number: usize,
        degree: usize,
        polynomials: &[Vec<String>],
        typical: &str,
        half_angle: bool,
    ) -> Vec<String> {
        if half_angle {
            return spread(
                &format!("let roots{number} = N::half_angle_roots::<{degree}>(&["),
                &polynomials[0],
                &format!("], {typical});"),
            );
        }
        let lists: Vec<String> = polynomials.iter().map(|list| format!("&[{}]", list.join(", "))).collect();
        spread(&format!("let roots{number} = N::real_roots::<{degree}>(&["), &lists, &format!("], {typical});"))
    }

    fn open_roots(&self, number: usize, name: Option<&str>, is_pair: bool) -> Vec<String> {
        let value = name.map_or_else(|| "_".to_owned(), |name| format!("&{name}"));
        if is_pair {
            return vec![format!("if let Some({value}) = roots{number}.as_slice().first() {{")];
        }
        vec![format!("for (i{number}, {value}) in roots{number}.as_slice().iter().enumerate() {{")]
    }

    fn open_samples(&self, _: usize, names: &[Option<&str>], table: usize, _: usize) -> Vec<String> {
        let names: Vec<&str> = names.iter().map(|name| name.unwrap_or("_")).collect();
        vec![format!("for [{}] in SAMPLES_{table}.map(|row| row.map(N::of)) {{", names.join(", "))]
    }

    fn open_six_axes(&self, number: usize, chain: usize, target: &[String], given: usize) -> Vec<String> {
        let solve = match given {
            0 => format!("], |target| CHAIN_{chain}.solve(target));"),
            _ => format!("], |numbers| CHAIN_{chain}.solve_given(&GIVEN_{chain}, numbers));"),
        };
        let mut lines = spread(&format!("let six{number} = N::alone(&["), target, &solve);
        lines.push(format!(
            "for (i{number}, answer{number}) in six{number}.iter().flat_map(|six| six.as_slice()).enumerate() {{"
        ));
        lines
    }

    fn chain(&self, six: &SixAxes) -> String {
        let Chain { directions, points, across, slides, steps, last, back, length, formulations, within } = six.chain();
        let formulations: Vec<String> = formulations.as_slice().iter().map(|one| format!("{one:?}")).collect();
        format!(
            "Chain {{\n    directions: {directions:?},\n    points: {points:?},\n    across: {across:?},\n    slides: {slides:?},\n    \
             steps: {steps:?},\n    last: {last:?},\n    back: {back:?},\n    length: {length:?},\n    \
             formulations: Formulations::new(&[{}]),\n    within: {within:?},\n}}",
            formulations.join(", ")
        )
    }

    fn given_axes(&self, six: &SixAxes) -> String {
        format!("[Given; {}] = {:?}", six.given().len(), six.given())
    }

    fn six_axes_joint(&self, number: usize, joint: usize) -> String {
        format!("N::of(answer{number}.q[{joint}])")
    }

    fn guard(&self, guards: &[GuardText]) -> String {
        let text = |guard: &GuardText| {
            let function = if guard.near { "near" } else { "away" };
            format!("N::{function}({}, {})", guard.value, guard.scale)
        };
        guards.iter().map(text).collect::<Vec<_>>().join(" & ")
    }

    fn open_case(&self, applies: &Applies) -> String {
        match applies {
            Applies::Usually(condition) => format!("if c.is_usual({condition}) {{"),
            Applies::Rarely(condition) => format!("if c.is_rare({condition}) {{"),
            Applies::Near { count, guard } => format!("if c.is_due(before{count}, {guard}) {{"),
        }
    }

    fn is_open(&self, number: usize, condition: &str) -> String {
        format!("c.is_open({number}, {condition});")
    }

    fn claim(&self, number: usize, lines: Vec<String>, pivot: &str, condition: Option<&str>) -> Vec<String> {
        let claim = condition.map_or_else(|| format!("N::abs({pivot})"), |guard| format!("({guard}).claim({pivot})"));
        let lines = lines.into_iter().chain([claim]).map(|line| format!("{INDENT}{line}"));
        [format!("let claim{number} = {{")].into_iter().chain(lines).chain(["};".to_owned()]).collect()
    }

    fn elect(&self, claims: &[usize], bodies: Vec<Vec<String>>) -> Vec<String> {
        let names: Vec<String> = claims.iter().map(|claim| format!("claim{claim}")).collect();
        let mut lines = vec![format!("match c.elect(&[{}]) {{", names.join(", "))];
        for (place, body) in bodies.into_iter().enumerate() {
            lines.push(format!("{INDENT}{place} => {{"));
            lines.extend(body.into_iter().map(|line| format!("{INDENT}{INDENT}{line}")));
            lines.push(format!("{INDENT}}}"));
        }
        lines.extend([format!("{INDENT}_ => {{}}"), "}".to_owned()]);
        lines
    }

    fn magnitude(&self, least: f64, names: &[String]) -> Vec<String> {
        spread(&format!("let magnitude = N::largest({}, &[", number(least)), names, "]);")
    }

    fn row(&self, numbers: &[f64]) -> String {
        format!("{numbers:?}")
    }

    fn count(&self, number: usize) -> String {
        format!("let before{number} = c.count();")
    }

    fn found(&self, before: usize, number: usize, how: &[How]) -> String {
        let mut text = if before > 0 { format!("found{before}") } else { String::new() };
        for how in how {
            text += &match how {
                How::First { branch, last } => format!("Found::first({branch}, {last})"),
                How::Next { radix, branch } => format!(".next({radix}, {branch})"),
                How::Root(number) => format!(".by_root(&roots{number}, i{number})"),
                How::Pair(number) => format!(".by_pair(&roots{number})"),
                How::Free(joints) => format!(".freeing({joints:#b})"),
                How::SixAxes { number, joints } => {
                    let bits: Vec<String> =
                        joints.iter().map(|joint| joint.map_or(0, |joint| 1_u32 << joint).to_string()).collect();
                    format!(".by_answer(&answer{number}.free, answer{number}.lost, [{}])", bits.join(", "))
                }
            };
        }
        format!("let found{number} = {text};")
    }

    fn go_on(&self, block: usize, found: usize, is_rare: bool, known: &[String]) -> Vec<String> {
        let call = format!("block_{block}(p, found{found}, [{}], c)", known.join(", "));
        vec![if is_rare { format!("rarely(|| {call});") } else { format!("{call};") }]
    }

    fn finish(&self, found: usize, at: &[String]) -> Vec<String> {
        spread(&format!("c.finish(&Solver, found{found}, &["), at, "]);")
    }
}
