//! Compiles the printed solvers of a program, runs them, and compares each solution with [`Program::solve`].

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::io::Write as _;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::{LazyLock, Mutex, OnceLock, PoisonError};

use groebot_ik::ErrorKind;
use groebot_ik::codegen::{self, c99::Pair};
use groebot_ik::solver::{Condition, Program};
use groebot_robot::kinematics::Solution;

/// Absolute tolerance for joint values, because elementary functions of the languages may round differently.
const TOLERANCE: f64 = 1e-12;

/// Results of a comparison.
#[derive(Debug, Default)]
pub struct Report {
    /// Number of solutions of the evaluator.
    pub answers: usize,
    /// Number of these with a free joint.
    pub self_motions: usize,
    /// Number of targets that are an error.
    pub refused: usize,
    /// The largest difference of a joint value in any language.
    pub largest: f64,
    /// Number of solutions, over all languages, with a joint value that is not bitwise equal.
    pub unequal: usize,
}

/// Compares the C99 file and both variants of the Rust file with the evaluator at every target. Panics if they differ. `None` when a compiler is missing (an
/// error with `GROEBOT_REQUIRE_TOOLS=1`).
pub fn compare(program: &Program, targets: &[Vec<f64>]) -> Option<Report> {
    let folder = tempfile::tempdir().unwrap();
    let mut executables = hosted(program, folder.path())?;
    executables.push(without_std(program, folder.path())?);
    answers_are_equal(program, targets, &executables)
}

/// Same as [`compare`], without the variant that needs no standard library.
pub fn compare_hosted(program: &Program, targets: &[Vec<f64>]) -> Option<Report> {
    let folder = tempfile::tempdir().unwrap();
    let executables = hosted(program, folder.path())?;
    answers_are_equal(program, targets, &executables)
}

fn answers_are_equal(program: &Program, targets: &[Vec<f64>], executables: &[Executable]) -> Option<Report> {
    program.validate().unwrap();
    let solver = program.solver();
    let expected: Vec<_> = targets.iter().map(|target| solver.solve_numbers(target)).collect();
    let mut report = Report::default();
    for solution in &expected {
        match solution {
            Ok(answers) => {
                report.answers += answers.len();
                report.self_motions += answers.iter().filter(|answer| !answer.free.is_empty()).count();
            }
            Err(_) => report.refused += 1,
        }
    }
    for (language, executable) in executables {
        let output = run(executable, targets);
        let mut numbers = output.split_whitespace().map(|word| word.parse::<f64>().unwrap());
        for (target, expected) in targets.iter().zip(&expected) {
            let place = format!("{} in {language} at {target:?}", program.name);
            check(program, target, expected, &mut numbers, &place, &mut report);
        }
        assert_eq!(numbers.next(), None, "{language} prints more numbers than expected");
    }
    println!("{}: {} targets, {report:?}", program.name, targets.len());
    Some(report)
}

/// Compares the solutions of one target, read from a solver's output.
fn check(
    program: &Program,
    target: &[f64],
    expected: &groebot_ik::Result<Vec<Solution>>,
    numbers: &mut impl Iterator<Item = f64>,
    place: &str,
    report: &mut Report,
) {
    let mut next = || numbers.next().unwrap_or_else(|| panic!("{place}: no more output"));
    let count = next();
    let answers = match expected {
        Ok(answers) => answers,
        Err(error) => {
            let codes = codes(program, target, error);
            assert!(codes.contains(&count), "{place}: {count} instead of {codes:?}: {error}");
            return;
        }
    };
    assert_eq!(count, answers.len() as f64, "{place}: number of solutions, {answers:?}");
    for answer in answers {
        assert_eq!(next(), answer.branch as f64, "{place}: branch");
        assert_eq!(next() == 1.0, answer.chosen, "{place}: choice");
        let (residual, again) = (next(), next());
        let slack = 1e-13 * program.scale.max(1.0) + 8.0 * answer.residual;
        assert!(residual <= slack, "{place}: residual {residual}, {}", answer.residual);
        // The solver measures the residual at cosines and sines, the test at joint values.
        assert!((residual - again).abs() <= slack, "{place}: residual {residual} of the answer, {again} of its joints");
        let free: Vec<usize> = (0..answer.q.len()).filter(|_| next() == 1.0).collect();
        assert_eq!(free, answer.free, "{place}: free joints");
        let q: Vec<f64> = answer.q.iter().map(|_| next()).collect();
        let difference = q.iter().zip(&answer.q).fold(0.0, |most: f64, (a, b)| most.max((a - b).abs()));
        assert!(difference <= TOLERANCE, "{place}: {q:?} instead of {:?}", answer.q);
        report.largest = report.largest.max(difference);
        report.unequal += usize::from(difference > 0.0);
    }
}

/// The codes that the printed solvers may return for an error of the evaluator.
fn codes(program: &Program, target: &[f64], error: &groebot_ik::Error) -> Vec<f64> {
    if error.kind() != ErrorKind::BadValue {
        return vec![-2.0];
    }
    if !target.iter().all(|number| number.is_finite()) {
        return vec![-1.0];
    }
    let code = |condition: &Condition| if matches!(condition, Condition::Rotation(_)) { -3.0 } else { -4.0 };
    program.conditions.iter().map(code).collect()
}

fn run(executable: &Path, targets: &[Vec<f64>]) -> String {
    let mut text = format!("{}\n", targets.len());
    for target in targets {
        let words: Vec<String> = target.iter().map(|value| format!("{value:e}")).collect();
        writeln!(text, "{}", words.join(" ")).unwrap();
    }
    feed(executable, text)
}

/// The output of a program with this text as input.
pub fn feed(executable: &Path, text: String) -> String {
    let mut child = Command::new(executable).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    let mut input = child.stdin.take().unwrap();
    let writer = std::thread::spawn(move || input.write_all(text.as_bytes()));
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap().unwrap();
    assert!(output.status.success(), "{} ends with {}", executable.display(), output.status);
    String::from_utf8(output.stdout).unwrap()
}

/// Writes a solver in C as `5_solver.h` and `5_solver.c`.
pub fn write_pair(folder: &Path, pair: &Pair) {
    fs::write(folder.join("5_solver.h"), &pair.header).unwrap();
    fs::write(folder.join("5_solver.c"), &pair.source).unwrap();
}

/// Compiles a solver in C with its driver `main.c`; `None` when the compiler is missing.
pub fn compile_solver(program: &Program, folder: &Path, flags: &[&str], name: &str) -> Option<()> {
    let parts = if codegen::has_six_axes(program) { &["groebot.c", "groebot_six_axes.c"][..] } else { &["groebot.c"] };
    let objects = parts.iter().map(|part| runtime_object(part, flags)).collect::<Option<Vec<_>>>()?;
    let objects: Vec<&str> = objects.iter().map(String::as_str).collect();
    compile_c(folder, &[flags, &["main.c", "5_solver.c"], &objects, &["-lm", "-o", name]].concat())
}

/// The object file of a part of the C run time, compiled once for each set of flags.
fn runtime_object(part: &str, flags: &[&str]) -> Option<String> {
    static FOLDER: LazyLock<tempfile::TempDir> = LazyLock::new(|| tempfile::tempdir().unwrap());
    static KNOWN: Mutex<BTreeMap<String, String>> = Mutex::new(BTreeMap::new());
    let mut known = KNOWN.lock().unwrap_or_else(PoisonError::into_inner);
    let own = format!("{part} {}", flags.join(" "));
    if !known.contains_key(&own) {
        let object = FOLDER.path().join(format!("{}.o", known.len())).to_str().unwrap().to_owned();
        let source = c_runtime().join(part);
        compile_c(FOLDER.path(), &[flags, &["-c", source.to_str().unwrap(), "-o", &object]].concat())?;
        known.insert(own.clone(), object);
    }
    known.get(&own).cloned()
}

/// The folder of the C run time.
pub fn c_runtime() -> PathBuf {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("runtime/c")
}

/// Writes a solver in C, and `main.c`, which solves the targets that it reads.
pub fn write_c(program: &Program, folder: &Path) {
    let pair = Pair::new(program, "5_solver");
    write_pair(folder, &pair);
    let has_extra = pair.source.contains("GB_EXTRAS true");
    fs::write(folder.join("main.c"), c_driver(&program.name, has_extra)).unwrap();
}

/// A compiled solver with the name of its language.
type Executable = (&'static str, PathBuf);

/// A Rust program that reads targets and prints the solutions.
fn rust_driver(program: &Program) -> String {
    let has_extra = codegen::rust::emit(program).contains("has_extras: true");
    RUST_DRIVER.replace("AGAIN", if has_extra { "answer.residual" } else { "Solver.residual(&target, &answer.q)" })
}

/// The Rust solver as a module next to the run time, and the C solver. `None` when a compiler is missing.
fn hosted(program: &Program, folder: &Path) -> Option<Vec<Executable>> {
    fs::write(folder.join("5_solver.rs"), codegen::rust::emit(program)).unwrap();
    let driver = rust_driver(program);
    fs::write(folder.join("module.rs"), format!("#[path = \"5_solver.rs\"]\nmod solver;\n{driver}")).unwrap();
    write_c(program, folder);
    rustc(folder, &["module.rs"])?;
    compile_solver(program, folder, &["-DGB_MAX_PLACES=1000"], "c99")?;
    Some(vec![("Rust", folder.join("module")), ("C99", folder.join("c99"))])
}

/// The solver in one Rust file without the standard library. `None` when the compiler is missing.
fn without_std(program: &Program, folder: &Path) -> Option<Executable> {
    fs::write(folder.join("single.rs"), codegen::single_file::rust(program)).unwrap();
    fs::write(folder.join("root.rs"), "#![no_std]\n#[path = \"single.rs\"]\npub mod solver;\n").unwrap();
    fs::write(folder.join("crate.rs"), format!("use no_std_root::solver;\n{}", rust_driver(program))).unwrap();
    rustc(folder, &["--crate-type=lib", "--crate-name=no_std_root", "--cfg=feature=\"libm\"", "root.rs"])?;
    rustc(folder, &["--extern=no_std_root=libno_std_root.rlib", "crate.rs"])?;
    Some(("Rust without std", folder.join("crate")))
}

/// Compiles all files of a solver without warnings and does not link them.
pub fn compiles(program: &Program) {
    program.validate().unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    write_c(program, path);
    fs::write(path.join("5_solver.rs"), codegen::rust::emit(program)).unwrap();
    fs::write(path.join("single.rs"), codegen::single_file::rust(program)).unwrap();
    let library = ["--crate-type=lib", "--emit=metadata"];
    let _ = rustc(path, &[&library[..], &["5_solver.rs"]].concat())
        .and_then(|()| rustc(path, &[&library[..], &["--cfg=feature=\"libm\"", "single.rs"]].concat()))
        .and_then(|()| compile_c(path, &["-c", "5_solver.c"]));
}

/// The compiled crate `groebot-runtime`; `None` when the compiler is missing.
fn runtime() -> Option<&'static Path> {
    static RUNTIME: OnceLock<Option<(tempfile::TempDir, PathBuf)>> = OnceLock::new();
    let compiled = RUNTIME.get_or_init(|| {
        let folder = tempfile::tempdir().unwrap();
        let root = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("runtime/src/lib.rs");
        let (library, root) = (folder.path().join("libgroebot_runtime.rlib"), root.to_str().unwrap().to_owned());
        let mut command = Command::new(std::env::var("RUSTC").unwrap_or_else(|_| "rustc".to_owned()));
        command.args(["--edition=2024", "-Dwarnings", "-Copt-level=1", "-Cdebug-assertions=on", "--crate-type=lib"]);
        command.args(["--crate-name=groebot_runtime", "--cfg=feature=\"std\"", &root]).current_dir(folder.path());
        build(&mut command)?;
        Some((folder, library))
    });
    compiled.as_ref().map(|(_, library)| library.as_path())
}

/// Compiles Rust, by default without optimisation: that is fast, and overflow is checked.
pub fn rustc(folder: &Path, arguments: &[&str]) -> Option<()> {
    let name = std::env::var("RUSTC").unwrap_or_else(|_| "rustc".to_owned());
    let mut command = Command::new(name);
    command.args(["--edition=2024", "-Dwarnings", "-Dmissing_docs"]).args(arguments);
    command.arg(format!("--extern=groebot_runtime={}", runtime()?.display()));
    if arguments.iter().any(|name| ["module.rs", "crate.rs", "root.rs"].contains(name)) {
        command.arg("-Amissing_docs");
    }
    build(command.current_dir(folder))
}

/// Compiles C without warnings, by default without optimisation: that is three times as fast, and the results are the same to the last bit.
pub fn compile_c(folder: &Path, arguments: &[&str]) -> Option<()> {
    let mut command = Command::new("cc");
    command.args("-std=c99 -O0 -Wall -Wextra -Werror -pedantic".split(' '));
    command.arg("-I").arg(c_runtime());
    build(command.args(arguments).current_dir(folder))
}

/// Options with which a C or C++ program stops at the first access out of bounds or undefined operation.
pub const SANITIZERS: [&str; 2] = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"];

/// Whether the C compiler has the libraries of the sanitizers.
pub fn has_sanitizers(folder: &Path) -> bool {
    fs::write(folder.join("empty.c"), "int main(void) { return 0; }\n").unwrap();
    let command = Command::new("cc").args(SANITIZERS).args(["empty.c", "-o", "empty"]).current_dir(folder).output();
    command.is_ok_and(|output| output.status.success())
}

/// Runs a compiler, which must succeed. `None` if it is not installed.
pub fn build(command: &mut Command) -> Option<()> {
    match command.output() {
        Ok(output) => {
            let text = String::from_utf8_lossy(&output.stderr);
            assert!(output.status.success() && text.is_empty(), "{command:?}\n{text}");
            Some(())
        }
        Err(error) => {
            let required = std::env::var("GROEBOT_REQUIRE_TOOLS").is_ok_and(|value| value == "1");
            assert!(!required, "{command:?}: {error}");
            println!("skipped, a compiler is missing: {command:?}: {error}");
            None
        }
    }
}

/// Reads the number of targets and the targets. For each it prints the number of solutions or the error code, then each solution.
const RUST_DRIVER: &str = r#"
use solver::{Solve, Solver};
use std::io::Read;

fn main() {
    let mut text = String::new();
    std::io::stdin().read_to_string(&mut text).unwrap();
    let mut words = text.split_whitespace();
    let count: usize = words.next().unwrap().parse().unwrap();
    let mut out = [solver::EMPTY; solver::CAPACITY];
    for _ in 0..count {
        let mut target = [0.0; solver::INPUTS];
        target.fill_with(|| words.next().unwrap().parse().unwrap());
        let count = match Solver.solve(&target, &mut out) {
            Ok(count) => count,
            Err(error) => {
                let code = match error {
                    solver::Error::NotFinite => -1,
                    solver::Error::OpenStratum(_) => -2,
                    solver::Error::NotRotation => -3,
                    solver::Error::NotUnit => -4,
                    _ => -5,
                };
                println!("{code}");
                continue;
            }
        };
        println!("{count}");
        for answer in &out[..count] {
            print!("{} {} {:e} {:e}", answer.branch, u8::from(answer.chosen), answer.residual, AGAIN);
            (0..solver::JOINTS).for_each(|joint| print!(" {}", u8::from(answer.is_free(joint))));
            answer.q.iter().for_each(|value| print!(" {value:e}"));
            println!();
        }
    }
}
"#;

fn c_driver(name: &str, has_extra: bool) -> String {
    let again = if has_extra { "answer->residual" } else { "NAME_residual(target, answer->q)" };
    C_DRIVER.replace("AGAIN", again).replace("NAME", name).replace("UPPER", &name.to_ascii_uppercase())
}

const C_DRIVER: &str = r#"
#include "5_solver.h"
#include <stdio.h>

int main(void)
{
    int targets;
    double target[UPPER_INPUTS + 1];
    NAME_solution out[UPPER_CAPACITY + 1];
    if (scanf("%d", &targets) != 1) {
        return 1;
    }
    for (int line = 0; line < targets; line++) {
        for (int i = 0; i < UPPER_INPUTS; i++) {
            if (scanf("%lf", &target[i]) != 1) {
                return 1;
            }
        }
        const int count = NAME_solve(target, out);
        printf("%d\n", count);
        for (int k = 0; k < count; k++) {
            const NAME_solution *answer = &out[k];
            printf("%zu %d %.17g %.17g", answer->branch, answer->chosen, answer->residual, AGAIN);
            for (int i = 0; i < UPPER_JOINTS; i++) {
                printf(" %d", (int)(answer->free >> i & 1));
            }
            for (int i = 0; i < UPPER_JOINTS; i++) {
                printf(" %.17g", answer->q[i]);
            }
            printf("\n");
        }
    }
    return 0;
}
"#;
