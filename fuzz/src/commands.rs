//! Command lines, lists of options, tables of targets and joint values, and names.

use std::sync::LazyLock;

use groebot::cli::readers;
use groebot::codegen::{c99, is_run_time, is_word, rust};
use groebot::document::word;
use groebot::limits::check_name;
use groebot::solver::Program;
use groebot::{escape, limits};

use super::given::{ARM, CHAIN, SOLVER};
use super::{Target, check_shown, read, text};

pub(super) const TARGETS: [Target; 7] = [
    Target {
        name: "command_line",
        about: "arguments, one per line, `cli::readers::command_line`",
        run: command_line,
        damaged: 200,
    },
    Target { name: "lists", about: "lists of options: targets, joint values, furniture", run: lists, damaged: 300 },
    Target { name: "solver_targets", about: "tables of targets for `solve`", run: solver_targets, damaged: 200 },
    Target { name: "chain_targets", about: "tables of targets for `ik`", run: chain_targets, damaged: 200 },
    Target { name: "joint_values", about: "tables of joint values for `fk`", run: joint_values, damaged: 200 },
    Target { name: "poses", about: "tables of poses for `follow`", run: poses, damaged: 200 },
    Target {
        name: "names",
        about: "names and their escaping, in messages, Markdown and generated code",
        run: names,
        damaged: 100,
    },
];

/// Arguments are parsed, but no command runs. Errors are printable.
fn command_line(bytes: &[u8]) {
    let text = text(bytes);
    let arguments = std::iter::once("groebot").chain(text.lines()).map(Into::into);
    if let Err(words) = readers::command_line(arguments) {
        assert!(!words.trim().is_empty());
        check_shown(&words);
    }
}

fn lists(bytes: &[u8]) {
    let text = text(bytes);
    for (chain, degrees) in [(&*CHAIN, false), (&*ARM, true)] {
        for (target, given) in [readers::listed_target, readers::listed_joints]
            .into_iter()
            .filter_map(|list| read(list(chain, &text, degrees)))
        {
            let numbers = chain.task().layout().values(&target).expect("the target is of the chain's task");
            assert!(numbers.iter().chain(&given).all(|number| !number.is_nan()), "{target:?}");
        }
    }
    if let Some((name, _)) = read(readers::furniture(&text)) {
        assert!(text.starts_with(name));
    }
}

/// Each row has the inputs of the solver, and is solved or refused.
fn solver_targets(bytes: &[u8]) {
    let solver = SOLVER.solver();
    for degrees in [false, true] {
        let Some(rows) = read(readers::solver_targets(&SOLVER, bytes, degrees)) else { continue };
        rows.iter().take(3).for_each(|target| _ = read(solver.solve_numbers(target)));
    }
}

fn chain_targets(bytes: &[u8]) {
    for (chain, degrees) in [(&*CHAIN, false), (&*ARM, true)] {
        let _ = read(readers::chain_targets(chain, bytes, degrees));
    }
}

/// Joint values have a pose, or are refused.
fn joint_values(bytes: &[u8]) {
    for (chain, degrees) in [(&*CHAIN, false), (&*ARM, true)] {
        let rows = read(readers::joint_values(chain, bytes, degrees)).unwrap_or_default();
        for pose in rows.iter().filter_map(|q| read(chain.forward(q))) {
            assert!(pose.to_homogeneous().iter().all(|x| x.is_finite()), "{pose}");
        }
    }
}

/// Quaternions have length one.
fn poses(bytes: &[u8]) {
    if let Some((poses, times)) = read(readers::poses(&ARM, bytes)) {
        assert!(times.is_none_or(|times| times.len() == poses.len()));
        assert!(poses.iter().all(|pose| (pose.rotation.norm() - 1.0).abs() < 1e-9));
    }
}

/// For any name, the shown or generated text stays intact: on one line, inside its comment, without hidden characters.
fn names(bytes: &[u8]) {
    let text = text(bytes);
    check_shown(&escape::message(&text));
    check_shown(&escape::line(&text));
    assert!(!escape::line(&text).contains(['\n', '\t']));
    let markdown = escape::markdown(&text);
    check_shown(&markdown);
    assert!(!markdown.contains('\n') && !markdown.replace("\\<", "").contains('<'), "{markdown}");
    assert!(is_word(&word(&text)), "{}", word(&text));
    let _ = is_run_time(&text);
    if read(check_name("robot", &text)).is_some() {
        assert!(limits::is_name(&text));
        printed(&text);
    }
}

/// Code of a program in C and Rust.
fn code(program: &Program) -> [String; 3] {
    let c99::Pair { header, source, .. } = c99::Pair::new(program, "5_solver");
    [header, source, rust::emit(program)]
}

/// Code of the program with ordinary names.
static CODE: LazyLock<[String; 3]> = LazyLock::new(|| code(&SOLVER));

/// Generated code has the same numbers of lines, comments and strings for any joint name.
fn printed(name: &str) {
    let mut program = SOLVER.clone();
    program.joints[0].name = name.to_owned();
    for (text, own) in code(&program).iter().zip(&*CODE) {
        check_shown(text);
        assert_eq!(shape(text), shape(own), "{text}");
    }
}

/// Numbers of lines, comments and strings of code.
fn shape(code: &str) -> [usize; 3] {
    let (mut comments, mut strings, mut rest) = (0, 0, code);
    while let Some(letter) = rest.chars().next() {
        let end = |sign: &str| rest[2..].find(sign).map_or(rest.len(), |at| at + 2 + sign.len());
        rest = match letter {
            '/' if rest.starts_with("/*") => {
                comments += 1;
                &rest[end("*/")..]
            }
            '/' if rest.starts_with("//") => {
                comments += 1;
                &rest[end("\n")..]
            }
            '"' => {
                strings += 1;
                after_string(rest)
            }
            _ => &rest[letter.len_utf8()..],
        };
    }
    [code.matches('\n').count(), comments, strings]
}

/// The text after the string at the beginning of code.
fn after_string(code: &str) -> &str {
    let mut letters = code[1..].chars();
    while let Some(letter) = letters.next() {
        match letter {
            '\\' => drop(letters.next()),
            '"' => break,
            _ => {}
        }
    }
    letters.as_str()
}
