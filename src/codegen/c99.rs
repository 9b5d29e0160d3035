//! C99: a header and a source file, or one file that is its own header. Main type: [`Pair`].

use super::joined::Declaration;
use super::language::{Finish, Language, State};
use super::outline::Outline;
use super::printer::{INDENT, in_rows, negation, spread};
use super::single::single;
use crate::solver::Program;

const SKELETON: &str = include_str!("skeleton/solver.c.txt");

const RESERVED: &str = "auto break case char const continue default do double else enum extern float for goto if inline int \
    long register restrict return short signed sizeof static struct switch typedef union unsigned void volatile while \
    bool true false asm typeof \
    and and_eq bitand bitor catch char16_t char32_t char8_t class compl concept const_cast consteval constinit co_await co_return \
    co_yield decltype delete dynamic_cast explicit export friend mutable namespace new not not_eq operator or or_eq private \
    protected public reinterpret_cast requires static_cast template this throw try typeid typename using virtual xor xor_eq std UNITS IkReal \
    alignas alignof constexpr nullptr static_assert thread_local noreturn \
    size_t ptrdiff_t wchar_t NULL offsetof NAN INFINITY HUGE_VAL HUGE_VALF HUGE_VALL DECIMAL_DIG errno complex imaginary I \
    float_t double_t math_errhandling signgam linux unix i386 \
    sin cos sqrt fabs fmax fmin atan2 round copysign isfinite isnan free_joints assert";

const CONSTANTS: Declaration = Declaration { head: "const double ", glue: ", " };

const RESERVED_PREFIXES: [&str; 7] = ["FLT_", "DBL_", "LDBL_", "FP_", "MATH_", "M_", "__"];

/// A solver in two files: what it declares, and a translation unit that includes that and is to be linked with `-lm`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pair {
    /// The text of the header, for C99 and C++.
    pub header: String,
    /// The text of the source file, for C99.
    pub source: String,
}

impl Pair {
    /// The solver of a valid program ([`Program::validate`]); `header` is the name of the header's file, which the source file includes. The
    /// code allocates nothing and has no state.
    pub fn new(program: &Program, header: &str) -> Self {
        Pair::of(Outline::new(program, &C99), header, double)
    }

    /// The same in single precision, as [`emit_single`].
    pub fn single(program: &Program, header: &str) -> Self {
        Pair::of(Outline::single(program, &C99), header, in_single)
    }

    fn of(mut outline: Outline, header: &str, text: fn(&Outline) -> String) -> Self {
        let mut part = |part| {
            outline.be_part(part, header);
            text(&outline)
        };
        Pair { header: part("header"), source: part("source") }
    }
}

/// The solver of a valid program ([`Program::validate`]) as one C99 file: a translation unit to be linked with `-lm`.
///
/// With `<NAME>_DECLARATIONS_ONLY` defined it is its own header. It allocates nothing and has no state.
pub fn emit(program: &Program) -> String {
    double(&Outline::new(program, &C99))
}

/// The same in single precision: `float` everywhere, with tolerances to match. The answers are polished to about 1e-6 of their size, and
/// near singular configurations fewer are told apart than in double precision.
pub fn emit_single(program: &Program) -> String {
    in_single(&Outline::single(program, &C99))
}

fn double(outline: &Outline) -> String {
    CONSTANTS.joined(&super::fill(SKELETON, outline))
}

fn in_single(outline: &Outline) -> String {
    single(&double(outline))
}

/// The part of the file that solves, as C++ too: without `#include`, and constants in place of macros.
pub(super) fn engine(program: &Program) -> String {
    let text = double(&Outline::engine(program, &C99));
    let limits = |line: String| {
        line.replace("DBL_MIN", "(std::numeric_limits<double>::min)()")
            .replace("DBL_EPSILON", "std::numeric_limits<double>::epsilon()")
    };
    text.lines().map(|line| limits(constant(line)) + "\n").collect()
}

/// A line, a definition of a macro as one of a constant.
fn constant(line: &str) -> String {
    let Some((name, value)) = line.strip_prefix("#define ").and_then(|rest| rest.split_once(' ')) else {
        return line.to_owned();
    };
    let real = value.contains(['.', 'e']) || value.contains("DBL_");
    format!("static const {} {name} = {value};", if real { "double" } else { "int" })
}

pub(super) struct C99;

impl Language for C99 {
    fn is_reserved(&self, word: &str) -> bool {
        RESERVED.split_whitespace().any(|reserved| reserved == word)
            || RESERVED_PREFIXES.iter().any(|prefix| word.starts_with(prefix))
    }

    fn field(&self, name: &str) -> String {
        format!("p->{name}")
    }

    fn known(&self, name: &str) -> String {
        format!("known->{name}")
    }

    fn shared(&self, name: &str) -> String {
        format!("shared->{name}")
    }

    fn argument(&self, name: &str, kind: &str) -> String {
        format!("const {kind} *{name}")
    }

    fn count(&self, name: &str) -> String {
        format!("size_t {name}")
    }

    fn call(&self, function: &str, argument: &str) -> String {
        let function = if function == "abs" { "fabs" } else { function };
        format!("{function}({argument})")
    }

    fn greater(&self, a: &str, b: &str) -> String {
        format!("larger({a}, {b})")
    }

    fn declare(&self, name: &str, value: &str) -> String {
        format!("const double {name} = {value};")
    }

    fn infinity(&self, positive: bool) -> String {
        if positive { "INFINITY" } else { "-INFINITY" }.to_owned()
    }

    /// All but plain ASCII as octal escapes, `?` too: `??` would begin a trigraph.
    fn quote(&self, text: &str) -> String {
        let body: String = text
            .bytes()
            .map(|byte| match byte {
                b'"' | b'\\' | b'?' | 0..=31 | 127.. => format!("\\{byte:03o}"),
                _ => char::from(byte).to_string(),
            })
            .collect();
        format!("\"{body}\"")
    }

    fn find_square_roots(&self, depth: usize, constant: &str, typical: &str) -> Vec<String> {
        vec![format!("const Roots roots{depth} = square_roots({constant}, {typical});")]
    }

    fn find_roots(&self, depth: usize, polynomials: &[Vec<String>], typical: &str) -> Vec<String> {
        let mut lines = Vec::new();
        for (index, list) in polynomials.iter().enumerate() {
            let head = format!("const double choice{depth}_{index}[{}] = {{", list.len());
            lines.extend(spread(&head, list, "};"));
        }
        let mut head = format!("const Roots roots{depth} =");
        for (index, list) in polynomials.iter().enumerate() {
            let arguments = format!("choice{depth}_{index}, {}", list.len());
            if index + 1 < polynomials.len() {
                lines.push(format!("{head} leads({arguments}) ? real_roots({arguments}, {typical})"));
                head = format!("{INDENT}:");
            } else {
                lines.push(format!("{head} real_roots({arguments}, {typical});"));
            }
        }
        lines
    }

    fn open_loop(&self, depth: usize, name: Option<&str>, first: bool) -> Vec<String> {
        let most = if first { format!(" && i{depth} < 1") } else { String::new() };
        let mut lines = vec![format!("for (size_t i{depth} = 0; i{depth} < roots{depth}.count{most}; i{depth}++) {{")];
        let value = format!("roots{depth}.values[i{depth}]");
        lines.extend(name.map(|name| format!("{INDENT}{}", self.declare(name, &value))));
        lines
    }

    fn only_if(&self, condition: &str) -> String {
        format!("if ({condition}) {{")
    }

    fn leave_unless(&self, condition: &str, _: bool, beside: Option<&str>) -> Vec<String> {
        let far = |beside| format!(" || (suffice_since(answers, before) && {})", negation(beside));
        let is_left = negation(condition) + &beside.map_or_else(String::new, far);
        vec![format!("if ({is_left}) {{"), format!("{INDENT}return;"), "}".to_owned()]
    }

    fn open_samples(&self, depth: usize, names: &[Option<&str>], table: usize, rows: usize) -> Vec<String> {
        let mut lines = vec![format!("for (size_t i{depth} = 0; i{depth} < {rows}; i{depth}++) {{")];
        for (column, name) in names.iter().enumerate() {
            let value = format!("SAMPLES_{table}[i{depth}][{column}]");
            lines.extend(name.map(|name| format!("{INDENT}{}", self.declare(name, &value))));
        }
        lines
    }

    fn six_axes(&self) -> &'static str {
        include_str!("skeleton/six_axes.c.txt")
    }

    fn open_six_axes(&self, depth: usize, chain: usize, target: &[String]) -> Vec<String> {
        let mut lines = spread(&format!("const double target{depth}[12] = {{"), target, "};");
        lines.extend([
            format!("SixAnswers found{depth};"),
            format!("six_solve(&CHAIN_{chain}, target{depth}, &found{depth});"),
            format!("for (size_t i{depth} = 0; i{depth} < found{depth}.count; i{depth}++) {{"),
            format!("{INDENT}const SixAnswer *six{depth} = &found{depth}.list[i{depth}];"),
        ]);
        lines
    }

    fn six_axes_joint(&self, depth: usize, joint: usize) -> String {
        format!("six{depth}->q[{joint}]")
    }

    fn six_axes_lost(&self, depth: usize) -> String {
        format!("six{depth}->lost")
    }

    fn six_axes_free(&self, depth: usize, joint: usize) -> String {
        format!("six{depth}->free[{joint}]")
    }

    fn finish(&self, answer: &Finish<'_>) -> Vec<String> {
        let mut lines = spread("const double at[PLACES] = {", answer.at, "};");
        let q = if answer.q.is_empty() { "" } else { " q," };
        lines.extend(spread("const double q[JOINTS] = {", answer.q, "};").into_iter().filter(|_| !q.is_empty()));
        if !answer.free.is_empty() {
            lines.extend(spread("const bool free_joints[JOINTS] = {", answer.free, "};"));
        }
        if !answer.extra.is_empty() {
            lines.extend(spread("const double extra[EXTRAS] = {", answer.extra, "};"));
        }
        let free = if answer.free.is_empty() { &answer.usual } else { "free_joints" };
        let extra = if answer.extra.is_empty() { "" } else { ", extra" };
        lines.push(format!(
            "finish(p, {}, {}, at,{q} {free}{extra}, answers);",
            answer.branch.join(", "),
            answer.close
        ));
        lines
    }

    fn go_on(&self, state: &State<'_>) -> Vec<String> {
        let [branch, last] = &state.branch;
        let start = if state.goes_on { "*known" } else { "NOTHING_KNOWN" };
        let mut lines = vec![format!("Known next = {start};")];
        for (name, value) in [("branch", branch), ("last", last), ("close", &state.close)] {
            let is_there =
                if state.goes_on { *value == self.known(name) } else { ["0", "false"].contains(&value.as_str()) };
            lines.extend((!is_there).then(|| format!("next.{name} = {value};")));
        }
        lines.extend(state.pair.iter().map(|pair| format!("next.pair = {pair};")));
        let is_usual = |free: &str| free == "false" || free.starts_with("known->") && !free.contains(' ');
        let free = state.free.iter().enumerate().filter(|(_, free)| !is_usual(free));
        lines.extend(free.map(|(joint, free)| format!("next.free[{joint}] = {free};")));
        lines.extend(state.found.iter().map(|name| format!("next.{name} = {name};")));
        let call = format!("{}_{}(p, &next, answers);", if state.is_rare { "again" } else { "block" }, state.next);
        in_rows(lines).into_iter().chain([call]).collect()
    }
}
