//! C99: a header and a source file of a robot that need the run time `groebot.h` and `groebot.c`. Main type: [`Pair`].

use groebot_runtime::redundant::{Arm, Given as RunTimeGiven, Task};
use groebot_runtime::six_axes::{Chain, Given, Rigid};

use super::dialect::{Applies, Dialect, GuardText, How};
use super::joined::Declaration;
use super::language::{Expressions, number};
use super::outline::Outline;
use super::parts::{PartText, Parts, RedundantText};
use super::printer::{INDENT, spread};
use super::reserved::is_reserved;
use crate::solver::Program;
use crate::solver::eigenvalue::SixAxes;

const HEADER: &str = include_str!("skeleton/robot.h.txt");
const SOURCE: &str = concat!(
    include_str!("skeleton/macros.c.txt"),
    include_str!("skeleton/begin.c.txt"),
    include_str!("skeleton/facts.c.txt"),
    include_str!("skeleton/middle.c.txt"),
    include_str!("skeleton/program.c.txt"),
    include_str!("skeleton/end.c.txt"),
);
const FACTS: &str = concat!(include_str!("skeleton/macros.c.txt"), include_str!("skeleton/facts.c.txt"));
const PROGRAM: &str = concat!(include_str!("skeleton/macros.c.txt"), include_str!("skeleton/program.c.txt"));

const NUMBERS: Declaration = Declaration { head: "const T ", glue: ", " };

/// A solver in two files: a header, and a translation unit that includes it. It is linked with `groebot.c` and `-lm`.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Pair {
    /// The text of the header, for C99 and C++.
    pub header: String,
    /// The text of the source file, for C99 and C++.
    pub source: String,
}

impl Pair {
    /// Prints the solver of a valid program ([`Program::validate`]); `stem` is the name of both files without `.h` and
    /// `.c`. The code allocates no memory and has no state. With `GB_FLOAT` defined all numbers are `float`.
    pub fn new(program: &Program, stem: &str) -> Self {
        let mut outline = outline(program);
        stem.clone_into(&mut outline.stem);
        let text = |skeleton| NUMBERS.joined(&super::fill(skeleton, &outline));
        Pair { header: super::fill(HEADER, &outline), source: text(SOURCE) }
    }
}

/// The values of a program for the skeleton.
pub(super) fn outline(program: &Program) -> Outline {
    let (parts, plain) = (Parts::new(program), C { kind: Kind::One });
    let part = |number: usize, program: &Program| {
        let outline = Outline::of_part(&parts, (number, program), &WORDS, &plain);
        let text = |skeleton| super::fill(skeleton, &outline).trim().to_owned();
        PartText { number, facts: text(FACTS), program: text(PROGRAM) }
    };
    let mut outline = Outline::new(&parts, &WORDS, &plain);
    outline.redundant = RedundantText::new(&parts, arm, part);
    outline
}

/// The data of a redundant arm as an initialiser.
fn arm(arm: &Arm) -> String {
    let Arm { count, directions, points, slides, tip, task, length, limits, .. } = arm;
    let Arm { given, scanned, grid, sections, section_count, .. } = arm;
    let (kind, direction, axis, coordinates) = match task {
        Task::Pose => ("POSE", [0.0; 3], 0, [0; 2]),
        Task::Position => ("POSITION", [0.0; 3], 0, [0; 2]),
        Task::Rotation => ("ROTATION", [0.0; 3], 0, [0; 2]),
        Task::Ray { direction } => ("RAY", *direction, 0, [0; 2]),
        Task::Direction { direction } => ("DIRECTION", *direction, 0, [0; 2]),
        Task::PositionPitchRoll => ("POSITION_PITCH_ROLL", [0.0; 3], 0, [0; 2]),
        Task::PositionYaw { axis, direction } => ("POSITION_YAW", *direction, *axis, [0; 2]),
        Task::PlanarPosition { coordinates } => ("PLANAR_POSITION", [0.0; 3], 0, *coordinates),
        Task::PlanarPose { coordinates } => ("PLANAR_POSE", [0.0; 3], 0, *coordinates),
        other => unreachable!("a redundant arm has a task of the run time, not {other:?}"),
    };
    let limits = braces(&limits.as_flattened()).replace("inf", "INFINITY");
    let sections = sections.map(|section| format!("{{{}, {:?}}}", section.joint, section.value)).join(", ");
    let given = given.map(|given| match given {
        RunTimeGiven::Solved => "GB_ARM_SOLVED",
        RunTimeGiven::Constant => "GB_ARM_CONSTANT",
        RunTimeGiven::Unsolved => "GB_ARM_UNSOLVED",
    });
    format!(
        "{{\n    {count},\n    {},\n    {},\n    {slides},\n    {},\n    {{GB_TASK_{kind}, {}, {axis}, {{{}, {}}}}},\n    {length:?},\n    \
         {limits},\n    {{{}}},\n    {scanned},\n    {grid},\n    {{{sections}}},\n    {section_count},\n}}",
        braces(directions),
        braces(points),
        rigid(tip),
        braces(&direction),
        coordinates[0],
        coordinates[1],
        given.join(", "),
        slides = braces(slides),
    )
}

/// The number type of the code: the type of the run time, or a single number.
#[derive(Clone, Copy, PartialEq)]
enum Kind {
    Any,
    One,
}

pub(super) struct C {
    kind: Kind,
}

/// The language for checks of reserved words.
pub(super) const WORDS: C = C { kind: Kind::Any };

impl Expressions for C {
    fn is_reserved(&self, word: &str) -> bool {
        is_reserved(word) || word.starts_with("all")
    }

    fn call(&self, function: &str, argument: &str) -> String {
        format!("GB_({function})({argument})")
    }

    fn root(&self, square: &str) -> String {
        format!("GB_(root)({square})")
    }

    fn literal(&self, value: f64) -> String {
        let text = number(value);
        text.strip_prefix('-').map_or_else(|| format!("R({text})"), |size| format!("-R({size})"))
    }

    fn given(&self, value: f64) -> String {
        format!("(gb_real){}", number(value))
    }

    fn alone(&self, constant: String) -> String {
        if self.kind == Kind::One { constant } else { format!("GB_(of)({constant})") }
    }

    fn declare(&self, name: &str, value: &str) -> String {
        format!("const T {name} = {value};")
    }

    fn declare_all(&self, names: &[&str], array: &str) -> Vec<String> {
        names.iter().enumerate().map(|(place, name)| self.declare(name, &format!("{array}[{place}]"))).collect()
    }

    fn infinity(&self, positive: bool) -> String {
        if positive { "INFINITY" } else { "-INFINITY" }.to_owned()
    }

    /// Quotes text with octal escapes for all but plain ASCII, and for `?`, because `??` would begin a trigraph.
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
}

impl Dialect for C {
    fn comment(&self, text: &str) -> String {
        format!("/* {text} */")
    }

    fn needs_scopes(&self) -> bool {
        true
    }

    fn find_square_roots(&self, number: usize, constant: &str, typical: &str, grazing: bool) -> String {
        let function = if grazing { "grazing_roots" } else { "square_roots" };
        format!("const GB_(roots) roots{number} = GB_({function})({constant}, {typical});")
    }

    fn find_roots(
        &self,
        number: usize,
        _: usize,
        polynomials: &[Vec<String>],
        typical: &str,
        half_angle: bool,
    ) -> Vec<String> {
        let function = if half_angle { "half_angle_roots" } else { "polynomial_roots" };
        let mut lines = Vec::new();
        for (index, list) in polynomials.iter().enumerate() {
            lines.extend(spread(&format!("const T choice{number}_{index}[] = {{"), list, "};"));
        }
        let of = |(index, list): (usize, &Vec<String>)| format!("{{choice{number}_{index}, {}}}", list.len());
        let lists: Vec<String> = polynomials.iter().enumerate().map(of).collect();
        lines.push(format!("const GB_(polynomial) choices{number}[] = {{{}}};", lists.join(", ")));
        let count = polynomials.len();
        lines.push(format!("const GB_(roots) roots{number} = GB_({function})(choices{number}, {count}, {typical});"));
        lines
    }

    fn open_roots(&self, number: usize, name: Option<&str>, is_pair: bool) -> Vec<String> {
        let (head, index) = if is_pair {
            (format!("if (roots{number}.count > 0) {{"), "0".to_owned())
        } else {
            (
                format!("for (size_t i{number} = 0; i{number} < roots{number}.count; i{number}++) {{"),
                format!("i{number}"),
            )
        };
        let value =
            name.map(|name| format!("{INDENT}{}", self.declare(name, &format!("roots{number}.values[{index}]"))));
        [head].into_iter().chain(value).collect()
    }

    fn open_samples(&self, number: usize, names: &[Option<&str>], table: usize, rows: usize) -> Vec<String> {
        let head = format!("for (size_t i{number} = 0; i{number} < {rows}; i{number}++) {{");
        let width = names.len();
        let value = |(place, name): (usize, &Option<&str>)| {
            let cell = if width > 1 { format!("[{place}]") } else { "[0]".to_owned() };
            name.map(|name| {
                format!("{INDENT}{}", self.declare(name, &format!("GB_(of)(samples_{table}[i{number}]{cell})")))
            })
        };
        [head].into_iter().chain(names.iter().enumerate().filter_map(value)).collect()
    }

    fn open_six_axes(&self, number: usize, chain: usize, target: &[String], given: usize) -> Vec<String> {
        let mut lines = spread(&format!("const T six{number}[] = {{"), target, "};");
        lines.push(format!("gb_six_answer answers{number}[GB_SIX_ROOM];"));
        let call = match given {
            0 => format!("GB_(six_axes)(&chain_{chain}"),
            _ => format!("GB_(six_axes_given)(&chain_{chain}, given_{chain}, {given}"),
        };
        lines.push(format!("const size_t count{number} = {call}, six{number}, answers{number});"));
        lines.push(format!("for (size_t i{number} = 0; i{number} < count{number}; i{number}++) {{"));
        lines
    }

    fn chain(&self, six: &SixAxes) -> String {
        let Chain { directions, points, across, slides, steps, last, back, length, formulations, within } = six.chain();
        let steps: Vec<String> = steps.iter().map(rigid).collect();
        let list = formulations.as_slice();
        let formulation = |one: &groebot_runtime::six_axes::Formulation| format!("{{{}, {}}}", one.hidden, one.second);
        let formulations: Vec<String> = list.iter().map(formulation).collect();
        format!(
            "{{\n    {},\n    {},\n    {},\n    {},\n    {{{}}},\n    {},\n    {},\n    {},\n    {{{}}},\n    {},\n    {},\n}}",
            braces(&directions),
            braces(&points),
            braces(&across),
            braces(&slides),
            steps.join(", "),
            rigid(&last),
            rigid(&back),
            self.literal(length),
            formulations.join(", "),
            list.len(),
            self.literal(within)
        )
    }

    fn given_axes(&self, six: &SixAxes) -> String {
        let axis = |Given { before, direction, point, slides }: &Given| {
            format!("{{{before}, {}, {}, {slides}}}", braces(direction), braces(point))
        };
        let axes: Vec<String> = six.given().iter().map(axis).collect();
        format!("{{{}}}", axes.join(", "))
    }

    fn six_axes_joint(&self, number: usize, joint: usize) -> String {
        format!("GB_(of)(answers{number}[i{number}].q[{joint}])")
    }

    fn guard(&self, guards: &[GuardText]) -> String {
        let text = |guard: &GuardText| {
            let function = if guard.near { "near" } else { "away" };
            format!("GB_({function})({}, {})", guard.value, guard.scale)
        };
        let all = guards.iter().map(text).reduce(|all, guard| format!("GB_(both)({all}, {guard})"));
        all.unwrap_or_else(|| "GB_(always)()".to_owned())
    }

    fn open_case(&self, applies: &Applies) -> String {
        match applies {
            Applies::Usually(guard) => format!("if (GB_(is_usual)(c, {guard})) {{"),
            Applies::Rarely(guard) => format!("if (GB_(is_rare)(c, {guard})) {{"),
            Applies::Near { count, guard } => format!("if (GB_(is_due)(c, before{count}, {guard})) {{"),
        }
    }

    fn is_open(&self, _: usize, guard: &str) -> String {
        format!("GB_(is_open)(c, {guard});")
    }

    fn claim(&self, number: usize, lines: Vec<String>, pivot: &str, guard: Option<&str>) -> Vec<String> {
        let claim = guard.map_or_else(|| self.call("abs", pivot), |guard| format!("GB_(claim)({guard}, {pivot})"));
        let lines =
            lines.into_iter().chain([format!("claim{number} = {claim};")]).map(|line| format!("{INDENT}{line}"));
        [format!("T claim{number};"), "{".to_owned()].into_iter().chain(lines).chain(["}".to_owned()]).collect()
    }

    fn elect(&self, claims: &[usize], bodies: Vec<Vec<String>>) -> Vec<String> {
        let names: Vec<String> = claims.iter().map(|claim| format!("claim{claim}")).collect();
        let list = format!("claims{}", claims.first().copied().unwrap_or(0));
        let mut lines = vec![
            format!("const T {list}[] = {{{}}};", names.join(", ")),
            format!("switch (GB_(elect)(c, {list}, {})) {{", names.len()),
        ];
        for (place, body) in bodies.into_iter().enumerate() {
            lines.push(format!("case {place}: {{"));
            lines.extend(body.into_iter().map(|line| format!("{INDENT}{line}")));
            lines.extend([format!("{INDENT}break;"), "}".to_owned()]);
        }
        lines.extend(["default:".to_owned(), format!("{INDENT}break;"), "}".to_owned()]);
        lines
    }

    fn magnitude(&self, least: f64, names: &[String]) -> Vec<String> {
        let mut lines = spread("const T all[] = {", names, "};");
        let value = format!("GB_(largest)({}, all, {})", self.literal(least), names.len());
        lines.push(self.declare("magnitude", &value));
        lines
    }

    fn row(&self, numbers: &[f64]) -> String {
        let numbers: Vec<String> = numbers.iter().map(|&number| self.literal(number)).collect();
        format!("{{{}}}", numbers.join(", "))
    }

    fn count(&self, number: usize) -> String {
        format!("const size_t before{number} = GB_(count)(c);")
    }

    fn found(&self, before: usize, number: usize, how: &[How]) -> String {
        let mut text = format!("found{before}");
        for how in how {
            text = match how {
                How::First { branch, last } => format!("GB_(first)({branch}, {last})"),
                How::Next { radix, branch } => format!("GB_(next)({text}, {radix}, {branch})"),
                How::Root(number) => format!("GB_(by_root)({text}, &roots{number}, i{number})"),
                How::Pair(number) => format!("GB_(by_pair)({text}, &roots{number})"),
                How::Free(joints) => format!("GB_(freeing)({text}, {joints:#x}u)"),
                How::SixAxes { number, joints } => {
                    let bits: Vec<String> =
                        joints.iter().map(|joint| joint.map_or(0, |joint| 1_u32 << joint).to_string()).collect();
                    format!("GB_(by_answer)({text}, &answers{number}[i{number}], {})", bits.join(", "))
                }
            };
        }
        format!("const GB_(found) found{number} = {text};")
    }

    fn go_on(&self, block: usize, found: usize, is_rare: bool, known: &[String]) -> Vec<String> {
        let how = if is_rare { "rarely_block" } else { "block" };
        let arguments: Vec<String> = ["p".to_owned(), format!("found{found}")]
            .into_iter()
            .chain(known.iter().cloned())
            .chain(["c".to_owned()])
            .collect();
        vec![format!("GB_({how}_{block})({});", arguments.join(", "))]
    }

    fn finish(&self, found: usize, at: &[String]) -> Vec<String> {
        let mut lines = spread("const T at[] = {", at, "};");
        lines.push(format!("GB_(finish)(c, found{found}, at);"));
        lines
    }
}

/// A rigid motion as an initialiser.
fn rigid(motion: &Rigid) -> String {
    format!("{{{}, {}}}", braces(&motion.rotation), braces(&motion.translation))
}

/// Formats numbers as a C initialiser, from Rust's notation in brackets.
fn braces(numbers: &impl std::fmt::Debug) -> String {
    let text = format!("{numbers:?}").replace('[', "{").replace(']', "}");
    let mut out = String::with_capacity(text.len() * 2);
    let mut rest = text.as_str();
    while let Some(start) = rest.find(|c: char| c.is_ascii_digit()) {
        let length = number_length(&rest[start..]);
        out += &rest[..start];
        out += &format!("R({})", &rest[start..start + length]);
        rest = &rest[start + length..];
    }
    out + rest
}

/// The length of the number at the start.
fn number_length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let is_part = |at: &usize| {
        let byte = bytes[*at];
        byte.is_ascii_digit() || byte == b'.' || byte == b'e' || (byte == b'-' && *at > 0 && bytes[at - 1] == b'e')
    };
    (0..bytes.len()).take_while(is_part).count()
}
