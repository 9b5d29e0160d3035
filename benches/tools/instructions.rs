//! Instruction counts of the most frequent calls, by valgrind, compared with the committed counts of `benches/instructions.csv`. Counts are almost independent
//! of the machine; times are not. They depend on the codegen units: the counts are for one unit per crate, as in `.ci/run`.
//!
//!     CARGO_INCREMENTAL=0 CARGO_PROFILE_TEST_CODEGEN_UNITS=1 cargo run --profile test --example instructions [-- --update]

use std::error::Error;
use std::fs;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

use groebot::derive::{Derivation, Source};
use groebot::gait::{Regular, Route, Side, Walker, plan};
use groebot::groebner::{Options, Strategy, basis, modular};
use groebot::kinematics::screw::ScrewSolver;
use groebot::kinematics::{InverseKinematics, Target};
use groebot::model::Robot;
use groebot::number::{Rationals, Zp};
use groebot::poly::{Order, PolynomialRing, parse};
use groebot::robots::{self, NAO_SINE, Outline, nao_walker};
use groebot::solver::Program;
use groebot::{Watch, codegen, dynamics};

type Result<T> = std::result::Result<T, Box<dyn Error>>;

/// Factor of a count's increase that fails. An equally large decrease requires a new table.
const SLACK: f64 = 1.25;

/// A call, with its inputs prepared.
type Call = Box<dyn FnMut()>;

/// A call's name, its number of repetitions, which makes the start negligible, and the function that prepares it.
type Counted = (&'static str, usize, fn() -> Result<Call>);

const CALLS: [Counted; 10] = [
    ("solve puma", 1000, || solve("puma", &[0.3, -0.4, 0.5, -0.6, 0.7, -0.8])),
    ("solve ur5", 1000, || solve("ur5", &[0.3, -0.9, 1.1, 0.4, 0.6, 0.7])),
    ("solve nao_left_leg", 1000, || solve("nao_left_leg", &[-0.2, 0.1, -0.5, 0.9, -0.4, 0.1])),
    ("solve general_6r", 50, || solve("general_6r", &[0.3, -0.4, 0.5, -0.6, 0.7, -0.8])),
    ("screws ur5", 200, screws),
    ("basis katsura-4 modulo 32003", 20, katsura_modulo),
    ("basis katsura-4 over Q", 5, katsura),
    ("derive puma", 1, derive),
    ("walk nao 4 steps", 1, walk),
    ("inertia nao", 1000, inertia),
];

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("derivations").join(name)
}

fn solve(name: &str, q: &[f64]) -> Result<Call> {
    let program = Program::from_json(&fs::read_to_string(folder(name).join("5_program.json"))?)?;
    let solver = program.solver();
    let target = solver.reached(q).ok_or("the program has forward kinematics")?;
    Ok(Box::new(move || drop(black_box(solver.solve_numbers(black_box(&target))))))
}

fn screws() -> Result<Call> {
    let chain = robots::ur5();
    let target = Target::Pose(chain.forward(&[0.3, -0.9, 1.1, 0.4, 0.6, 0.7])?);
    let solver = ScrewSolver::new(&chain)?;
    let mut answers = Vec::new();
    Ok(Box::new(move || drop(black_box(InverseKinematics::solve(&solver, &target, &[], &mut answers)))))
}

const VARIABLES: [&str; 5] = ["x0", "x1", "x2", "x3", "x4"];
const KATSURA: [&str; 5] = [
    "x0+2*x1+2*x2+2*x3+2*x4-1",
    "x0^2+2*x1^2+2*x2^2+2*x3^2+2*x4^2-x0",
    "2*x0*x1+2*x1*x2+2*x2*x3+2*x3*x4-x1",
    "x1^2+2*x0*x2+2*x1*x3+2*x2*x4-x2",
    "2*x1*x2+2*x0*x3+2*x1*x4-x3",
];

fn katsura_modulo() -> Result<Call> {
    let ring = PolynomialRing::new(Zp::new(32003)?, &VARIABLES, Order::GrevLex)?;
    let generators = KATSURA.iter().map(|text| parse(text)?.evaluate(&ring)).collect::<groebot::Result<Vec<_>>>()?;
    let options = Options { strategy: Strategy::Sugar, cofactors: false };
    Ok(Box::new(move || drop(black_box(basis(&ring, black_box(&generators), &options, &Watch::none())))))
}

fn katsura() -> Result<Call> {
    let ring = PolynomialRing::new(Rationals, &VARIABLES, Order::GrevLex)?;
    let generators = KATSURA.iter().map(|text| parse(text)?.evaluate(&ring)).collect::<groebot::Result<Vec<_>>>()?;
    let options = Options { strategy: Strategy::Sugar, cofactors: false };
    Ok(Box::new(move || drop(black_box(modular::basis(&ring, black_box(&generators), &options, &Watch::none())))))
}

fn derive() -> Result<Call> {
    let source = Source::read(&folder("puma"))?;
    Ok(Box::new(move || {
        let proved = Derivation::of(black_box(&source), &Watch::none()).expect("PUMA is derived");
        drop(black_box(codegen::rust::emit(proved.program())));
    }))
}

fn walk() -> Result<Call> {
    let Walker { biped, legs, .. } = nao_walker(Outline::Measured)?;
    let half_width = biped.half_width();
    let steps = Regular { steps: 4, length: 0.04, aside: 0.0, turn: 0.0, half_width, first: Side::Left };
    let request = NAO_SINE.request(&biped, Route::regular(&steps)?, NAO_SINE.hip_heights[0]);
    Ok(Box::new(move || drop(black_box(plan(&biped, &legs, black_box(&request), &Watch::none())))))
}

fn inertia() -> Result<Call> {
    let robot: Robot = robots::robot("nao_v5").ok_or("NAO comes with groebot")?;
    let model = dynamics::Model::new(&robot)?;
    let q = vec![0.1; model.joints().len()];
    Ok(Box::new(move || drop(black_box(model.inertia(black_box(&q))))))
}

/// Number of instructions of a run of this program with `times` repetitions of the call.
fn counted(name: &str, times: usize) -> Result<f64> {
    let output = Command::new("valgrind")
        .args(["--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null"])
        .arg(std::env::current_exe()?)
        .args(["--call", name, &times.to_string()])
        .env("RAYON_NUM_THREADS", "1")
        .output()?;
    let text = String::from_utf8(output.stderr)?;
    let line =
        text.lines().find(|line| line.contains("I refs:") || line.contains("I   refs:")).ok_or_else(|| text.clone())?;
    let digits: String = line.rsplit(':').next().unwrap_or("").chars().filter(char::is_ascii_digit).collect();
    Ok(digits.parse()?)
}

/// Repeats a call `times` times, in the run under valgrind.
fn make(name: &str, times: usize) -> Result<()> {
    let (.., ready) = CALLS.iter().find(|(known, ..)| *known == name).ok_or("no such call")?;
    let mut call = ready()?;
    (0..times).for_each(|_| call());
    Ok(())
}

fn measure() -> Result<Vec<(&'static str, f64)>> {
    let one = |(name, times, _): &Counted| {
        let each = (counted(name, *times)? - counted(name, 0)?) / *times as f64;
        Ok((*name, each.round()))
    };
    CALLS.iter().map(one).collect()
}

fn main() -> Result<ExitCode> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    if let [flag, name, times] = arguments.as_slice()
        && flag == "--call"
    {
        make(name, times.parse()?)?;
        return Ok(ExitCode::SUCCESS);
    }
    let table = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/instructions.csv");
    let measured = measure()?;
    if arguments.iter().any(|argument| argument == "--update") {
        let rows: String = measured.iter().map(|(name, count)| format!("{name},{count}\n")).collect();
        fs::write(&table, format!("call,instructions\n{rows}"))?;
        return Ok(ExitCode::SUCCESS);
    }
    let text = fs::read_to_string(&table)?;
    let known =
        |name: &str| text.lines().find_map(|line| line.strip_prefix(name)?.strip_prefix(',')?.parse::<f64>().ok());
    let mut is_slower = false;
    for (name, count) in measured {
        let ratio = count / known(name).ok_or_else(|| format!("{}: no row `{name}`", table.display()))?;
        is_slower |= ratio > SLACK;
        let word = if ratio > SLACK {
            "  ALARM"
        } else if ratio < 1.0 / SLACK {
            "  less: --update keeps that"
        } else {
            ""
        };
        println!("{name:32} {count:>14} instructions, {ratio:.2} of the table{word}");
    }
    Ok(if is_slower { ExitCode::FAILURE } else { ExitCode::SUCCESS })
}
