//! Batches in printed Rust: each answer is that of `solve` to the last bit, in lanes of every width, with `std` and without.

use std::f64::consts::FRAC_PI_2;
use std::fmt::Write as _;
use std::fs;

use groebot::codegen::rust;
use groebot::solver::Program;

use super::harness::{feed, rustc};
use super::stored::{all, named};
use super::{odd, random};

/// What random joints reach; at and next to singular places, out of reach, where numbers of the target are zero, and what is no target.
fn targets(program: &Program, count: usize) -> Vec<Vec<f64>> {
    let mut next = random();
    let mut targets = odd(program.inputs.len());
    for k in 0..count {
        // Few of the singular ones: they take a thousand times as long.
        let kind = if k % 10 == 0 { k / 10 % 20 } else { 20 + k % 10 };
        let joint = |_| if kind == 1 { next(-2.0, 2.0).round() * FRAC_PI_2 } else { next(-3.2, 3.2) };
        let mut q: Vec<f64> = (0..program.joints.len()).map(joint).collect();
        let place = k / 200 % q.len();
        match kind {
            3 => q[place] = 0.0,
            5 => q[place] = 1e-3 * next(-1.0, 1.0),
            _ => {}
        }
        let mut target = program.reached(&q).unwrap();
        match kind {
            2 | 22 => target[k / 10 % 3 % program.inputs.len()] *= 1.0 + next(0.0, 2.0),
            4 => target[k / 200 % 2] = 0.0,
            7 | 27 => target[k / 10 % program.inputs.len()] += 1e-8 * next(-1.0, 1.0),
            _ => {}
        }
        targets.push(target);
    }
    targets
}

/// Compiles the printed file as a module and as a crate without `std`, each with a driver that compares batches with single targets;
/// `None` when the compiler is missing.
fn check(program: &Program, count: usize) -> Option<()> {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    let text = rust::emit_batch(program).unwrap();
    write("5_solver.rs", &text);
    rustc(folder.path(), &["--crate-type=lib", "--crate-name=printed", "--emit=metadata", "5_solver.rs"])?;
    // The driver calls the function of each width.
    let open =
        |text: String, item: &str| text.replace(&format!("\n{item}"), &format!("\n#[allow(missing_docs)]\npub {item}"));
    write("5_solver.rs", &["fn solve_by", "trait Answer"].into_iter().fold(text, open));
    write("root.rs", "#![no_std]\n#[path = \"5_solver.rs\"]\npub mod solver;\n");
    write("module.rs", &format!("#[path = \"5_solver.rs\"]\nmod solver;\n{DRIVER}"));
    write("crate.rs", &format!("use no_std_root::solver;\n{DRIVER}"));
    let library = ["--crate-type=lib", "--crate-name=no_std_root", "--cfg=feature=\"libm\"", "root.rs"];
    let compile = |arguments: &[&str]| rustc(folder.path(), &[&["-Copt-level=1"], arguments].concat());
    compile(&library)?;
    compile(&["--cfg=with_std", "--check-cfg=cfg(with_std)", "module.rs"])?;
    compile(&["--check-cfg=cfg(with_std)", "--extern=no_std_root=libno_std_root.rlib", "crate.rs"])?;
    let targets = targets(program, count);
    let mut text = String::new();
    for number in targets.iter().flatten() {
        write!(text, "{number:e} ").unwrap();
    }
    for name in ["module", "crate"] {
        let output = feed(&folder.path().join(name), text.clone());
        let answers: usize = output.trim().parse().unwrap();
        assert!(answers > count, "{}: {answers} answers of {} targets", program.name, targets.len());
    }
    Some(())
}

fn check_all(names: &[&str], count: usize) {
    let stored = named(names);
    assert_eq!(stored.len(), names.len());
    let is_checked = stored.iter().all(|stored| check(&stored.program, count).is_some());
    assert!(is_checked || std::env::var("GROEBOT_REQUIRE_TOOLS").is_err(), "a compiler is missing");
}

#[test]
fn batches_are_single_targets_to_the_last_bit() {
    check_all(&["puma"], 500);
}

#[test]
#[ignore = "minutes: ten thousand targets of each robot"]
fn batches_of_more_robots_are_single_targets_to_the_last_bit() {
    check_all(&["puma", "ur5", "stanford", "nao_left_leg"], 10_000);
    check_all(&["scara", "polar", "wrist_rotation", "planar_2r", "rh0_arm"], 1000);
}

#[test]
fn batches_are_for_solvers_by_square_roots() {
    let has_batch = |name: &str| rust::emit_batch(&named(&[name])[0].program).is_some();
    assert!(["teo_leg", "irb120", "gantry", "offset_wrist"].into_iter().all(has_batch));
    assert!(!["general_6r", "spherical_wrist", "nao_left_arm", "nao_leg_sagittal"].into_iter().any(has_batch));
    for stored in all() {
        assert!(!rust::emit(&stored.program).contains("solve_batch"), "{}: only where it is asked for", stored.name);
    }
}

/// Reads targets; compares all, in one batch by each width, then the first few of them with little room: solutions, then cosines and sines.
const DRIVER: &str = r#"
use solver::{Answer, Error, INPUTS, JOINTS, Pairs, Solution};
use std::io::Read;

type Count = Result<usize, Error>;
type Batch<A> = fn(&[[f64; INPUTS]], &mut [A], &mut [Count]) -> usize;

/// What must be the same to the last bit.
#[derive(Debug, PartialEq)]
struct Bits(Vec<u64>, usize, bool, [bool; JOINTS]);

trait Told: Answer {
    fn bits(&self) -> Bits;
}

impl Told for Solution {
    fn bits(&self) -> Bits {
        let numbers = self.q.iter().chain([&self.residual]).map(|x| x.to_bits()).collect();
        Bits(numbers, self.branch, self.chosen, self.free)
    }
}

impl Told for Pairs {
    fn bits(&self) -> Bits {
        let numbers = self.joints.iter().flatten().chain([&self.residual]).map(|x| x.to_bits()).collect();
        Bits(numbers, self.branch, false, self.free)
    }
}

fn batches<A: Answer>(first: Batch<A>) -> Vec<Batch<A>> {
    #[allow(unused_mut)]
    let mut batches: Vec<Batch<A>> =
        vec![first, solver::solve_by::<2, A>, solver::solve_by::<3, A>, solver::solve_by::<4, A>, solver::solve_by::<8, A>];
    #[cfg(all(target_arch = "x86_64", with_std))]
    {
        if std::is_x86_feature_detected!("avx2") {
            batches.push(|targets, out, counts| unsafe { solver::solve_by_4(targets, out, counts) });
        }
        if std::is_x86_feature_detected!("avx512f") {
            batches.push(|targets, out, counts| unsafe { solver::solve_by_8(targets, out, counts) });
        }
    }
    batches
}

/// How many targets are solved, which must be all that there is room for, with the answers of `singles`.
fn check<A: Told>(batch: Batch<A>, targets: &[[f64; INPUTS]], singles: &[(Count, Vec<A>)], room: usize) -> usize {
    let mut out = vec![A::NONE; room];
    let mut counts = vec![Err(Error::NotFinite); targets.len()];
    let done = batch(targets, &mut out, &mut counts);
    let mut filled = 0;
    for (i, (count, answers)) in singles.iter().enumerate().take(targets.len()) {
        if filled + answers.len() > room {
            assert_eq!(done, i, "{room}");
            return done;
        }
        assert_eq!(counts[i], *count, "{:?}", targets[i]);
        for (k, answer) in answers.iter().enumerate() {
            assert_eq!(out[filled + k].bits(), answer.bits(), "{:?}", targets[i]);
        }
        filled += answers.len();
    }
    assert_eq!(done, targets.len());
    done
}

/// How many answers there are.
fn check_all<A: Told>(first: Batch<A>, targets: &[[f64; INPUTS]]) -> usize {
    let single = |target: &[f64; INPUTS]| {
        let mut out = [A::NONE; solver::CAPACITY];
        let count = A::solve(target, &mut out);
        (count, out[..count.unwrap_or(0)].to_vec())
    };
    let singles: Vec<(Count, Vec<A>)> = targets.iter().map(single).collect();
    let answers: usize = singles.iter().map(|(_, answers)| answers.len()).sum();
    for batch in batches(first) {
        check(batch, targets, &singles, answers);
        let (some, singles) = (&targets[100..], &singles[100..]);
        for count in 0..20 {
            check(batch, &some[..count], singles, 200);
            check(batch, &some[..20], singles, count);
            assert_eq!(batch(&some[..20], &mut vec![A::NONE; 1000], &mut vec![Ok(0); count]), count);
        }
    }
    answers
}

fn main() {
    let mut text = String::new();
    std::io::stdin().read_to_string(&mut text).unwrap();
    let numbers: Vec<f64> = text.split_whitespace().map(|word| word.parse().unwrap()).collect();
    let targets: Vec<[f64; INPUTS]> = numbers.chunks(INPUTS).map(|target| target.try_into().unwrap()).collect();
    let answers = check_all::<Solution>(solver::solve_batch, &targets);
    assert_eq!(check_all::<Pairs>(solver::solve_pairs_batch, &targets), answers);
    println!("{answers}");
}
"#;
