//! C++ with the interface of IKFast: included like by MoveIt's plugin, built like by OpenRAVE, and compared with the program.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use groebot_ik::codegen::ikfast::{Options, emit};
use groebot_ik::derive::Derivation;
use groebot_ik::solver::{Instruction, Operand, Operation, Program, Unit};
use groebot_ik::{ErrorKind, Watch};
use groebot_robot::kinematics::Chain;

use super::harness::{SANITIZERS, build, feed, has_sanitizers};
use super::random;
use super::samples::{leg, wrist};
use super::stored::{Stored, all, joint_values, named, reached};

/// A folder with the printed file, a replacement of the header, and the plugin.
pub fn folder(program: &Program, options: &Options) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let options = Options { file: Some("5_ikfast.cpp".into()), ..options.clone() };
    fs::write(folder.path().join("5_ikfast.cpp"), emit(program, &options).unwrap()).unwrap();
    let ours = Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/../..")).join("crates/ik/tests/codegen/ikfast");
    for name in ["ikfast.h", "plugin.cpp"] {
        fs::copy(ours.join(name), folder.path().join(name)).unwrap();
    }
    folder
}

/// Compiles C++; `None` when the compiler is missing.
pub fn compile(folder: &Path, arguments: &[&str]) -> Option<()> {
    let mut command = Command::new("c++");
    command.args(["-Wall", "-Wextra", "-Werror", "-pedantic", "-I."]).args(arguments);
    build(command.current_dir(folder))
}

/// The plugin of a program. `None` when the compiler is missing.
fn plugin(folder: &Path, flags: &[&str]) -> Option<PathBuf> {
    compile(folder, &[flags, &["-std=c++11", "plugin.cpp", "-o", "plugin"]].concat())?;
    Some(folder.join("plugin"))
}

/// Target numbers in the format of IKFast's callers, in metres: position, rotation by rows, free value.
fn line(stored: &Stored, target: &[f64]) -> [f64; 13] {
    let given = stored.chain.as_ref().map_or(0, |chain| chain.given().len());
    let (own, free) = target.split_at(target.len() - given);
    let metres = stored.program.inputs.iter().any(|input| input.unit == Unit::Millimetre);
    let lengths = stored.program.inputs.iter().take_while(|input| input.name.starts_with('p')).count();
    let turned = own.len() > lengths && stored.program.conditions.is_empty();
    let mut line = [0.0; 13];
    let in_translation = if turned { own.len() } else { lengths };
    for (index, &value) in own.iter().enumerate() {
        let value = if metres && index < lengths { value / 1000.0 } else { value };
        line[if index < in_translation { index } else { 3 + index - in_translation }] = value;
    }
    line[12] = free.first().copied().unwrap_or(0.0);
    line
}

/// One solution in the plugin's output.
struct Answer {
    branch: usize,
    q: Vec<f64>,
    reached: Vec<f64>,
}

/// The plugin's solutions at each line.
fn ask(executable: &Path, joints: usize, lines: &[[f64; 13]]) -> (i64, i64, Vec<Vec<Answer>>) {
    let mut text = String::new();
    for line in lines {
        let words: Vec<String> = line.iter().map(|value| format!("{value:e}")).collect();
        writeln!(text, "{}", words.join(" ")).unwrap();
    }
    let output = feed(executable, text);
    let mut words = output.split_whitespace();
    let mut next = || words.next().unwrap().parse::<f64>().unwrap();
    let (kind, free) = (next() as i64, next() as i64);
    let mut answers = Vec::new();
    for _ in lines {
        let count = next() as usize;
        let mut list = Vec::new();
        for _ in 0..count {
            let branch = next() as usize;
            let q = (0..joints).map(|_| next()).collect();
            list.push(Answer { branch, q, reached: (0..12).map(|_| next()).collect() });
        }
        answers.push(list);
    }
    (kind, free, answers)
}

fn compare(stored: &Stored, count: usize) -> Option<usize> {
    let (program, chain) = (&stored.program, stored.chain.as_ref().unwrap());
    let folder = folder(program, &Options::default());
    let executable = plugin(folder.path(), &[])?;
    let joints = joint_values(program, count, random());
    let targets: Vec<Vec<f64>> = joints.iter().map(|q| reached(chain, q)).collect();
    let lines: Vec<[f64; 13]> = targets.iter().map(|target| line(stored, target)).collect();
    let (kind, free, answers) = ask(&executable, program.joints.len(), &lines);
    assert_eq!(free, chain.given().first().map_or(-1, |&joint| joint as i64), "{}", stored.name);
    assert!(kind > 0x2000_0000, "{}", stored.name);
    let mut total = 0;
    let solver = program.solver();
    for (index, ((target, line), answers)) in targets.iter().zip(&lines).zip(&answers).enumerate() {
        let place = format!("{} at {:?}", stored.name, joints[index]);
        assert!(!answers.is_empty(), "{place}: no solution");
        total += answers.len();
        for answer in answers {
            for (value, expected) in answer.reached.iter().zip(&line[..12]) {
                let off = (value - expected).abs();
                let off = off.min((off - std::f64::consts::TAU).abs());
                assert!(off <= 1e-11 * (1.0 + program.scale), "{place}: {value} {expected}");
            }
        }
        if index % 3 == 2 {
            continue;
        }
        let expected = solver.solve_numbers(target).unwrap();
        assert_eq!(answers.len(), expected.len(), "{place}");
        for (answer, expected) in answers.iter().zip(&expected) {
            assert_eq!(answer.branch, expected.branch, "{place}");
            let off = answer.q.iter().zip(&expected.q).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(off <= 1e-9, "{place}: {:?} {:?}", answer.q, expected.q);
        }
    }
    Some(total)
}

/// The tasks of IKFast's types: pose, position with a given joint, planar, rotation; and seven joints with a given one.
#[test]
fn a_plugin_answers_like_the_program() {
    let names = [
        "puma",
        "ur5",
        "iiwa14",
        "nao_left_arm_position",
        "planar_2r",
        "scara",
        "scara_yaw",
        "wrist_rotation",
        "nao_head",
    ];
    for stored in named(&names) {
        if emit(&stored.program, &Options::default()).is_err() {
            continue;
        }
        let Some(total) = compare(&stored, 300) else { return };
        assert!(total >= 300, "{}: {total}", stored.name);
    }
}

/// Six joints at general positions, revolute and prismatic.
#[test]
fn a_plugin_of_six_axes_answers_like_the_program() {
    for stored in named(&["crx_like", "general_4r2p", "general_5r1p", "general_6r", "jaco_like"]) {
        let Some(total) = compare(&stored, 60) else { return };
        assert!(total >= 120, "{}: {total}", stored.name);
    }
}

/// PUMA without its last joint points its tool along a ray.
#[test]
fn a_ray_is_a_translation_and_a_direction() {
    let text =
        fs::read_to_string(concat!(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."), "/derivations/puma/0_chain.toml"))
            .unwrap();
    let (text, _) = text.rsplit_once("[[joint]]").unwrap();
    let chain = Chain::from_toml(&text.replace("\"pose\"", "\"ray\", direction = [0, 0, 1]")).unwrap();
    let program = Derivation::sequentially(&chain, &Watch::none()).unwrap().program().clone();
    assert!(emit(&program, &Options::default()).unwrap().contains("TranslationDirection5D (0x56000007)"));
    let stored = Stored { name: "puma_ray".into(), program, chain: Some(chain) };
    let Some(total) = compare(&stored, 200) else { return };
    assert!(total >= 400, "{total}");
}

/// Callers use metres, and the equations millimetres.
#[test]
fn lengths_are_metres() {
    let mut program = wrist::carried();
    program.inputs[..3].iter_mut().for_each(|input| input.unit = Unit::Millimetre);
    program.joints[..3].iter_mut().for_each(|joint| joint.unit = Unit::Millimetre);
    let folder = folder(&program, &Options::default());
    let Some(executable) = plugin(folder.path(), &[]) else { return };
    let q = [120.0, -340.0, 560.0, 0.1, 0.2, 0.3];
    let stored = Stored { name: "gantry".into(), program, chain: None };
    let line = line(&stored, &stored.program.reached(&q).unwrap());
    assert_eq!(line[..3], [0.12, -0.34, 0.56]);
    let (kind, _, answers) = ask(&executable, 6, &[line]);
    assert_eq!((kind, answers[0].len()), (0x6700_0001, 2));
    for answer in &answers[0] {
        assert!(answer.q.iter().zip(&line).take(3).all(|(a, b)| (a - b).abs() < 1e-15), "{:?}", answer.q);
        assert!(answer.reached.iter().zip(&line).all(|(a, b)| (a - b).abs() < 1e-14), "{:?}", answer.reached);
    }
}

/// Parameters and unknowns may have names that C++ reserves.
#[test]
fn words_of_cpp_are_possible_names() {
    let mut program = named(&["puma"]).remove(0).program;
    let words = "class new delete template typename this namespace operator private public virtual throw try catch using friend \
        explicit export mutable nullptr constexpr and or not xor std UNITS IkReal kept branch joints answer solutions eetrans";
    let parameters = program.parameters.iter_mut().map(|parameter| &mut parameter.name);
    let names = parameters.chain(&mut program.unknowns);
    names.zip(words.split_whitespace()).for_each(|(name, word)| word.clone_into(name));
    let folder = folder(&program, &Options::default());
    compile(folder.path(), &["-std=c++17", "-fsyntax-only", "5_ikfast.cpp"]);
}

#[test]
fn bad_and_unreachable_targets_have_no_solution() {
    let stored = &named(&["puma"])[0];
    let folder = folder(&stored.program, &Options::default());
    let flags = if has_sanitizers(folder.path()) { &SANITIZERS[..] } else { &[] };
    let Some(executable) = plugin(folder.path(), flags) else { return };
    let good = line(stored, &reached(stored.chain.as_ref().unwrap(), &[0.3; 6]));
    let changed = |place: usize, value: f64| {
        let mut line = good;
        line[place] = value;
        line
    };
    let mut mirrored = good;
    (3..12).for_each(|place| mirrored[place] = -mirrored[place]);
    let mut rounded = good;
    (3..12).for_each(|place| rounded[place] = (rounded[place] * 1e5).round() / 1e5);
    let lines =
        [good, changed(0, f64::NAN), changed(4, f64::INFINITY), changed(2, 40.0), changed(3, 2.0), mirrored, rounded];
    let (kind, free, answers) = ask(&executable, 6, &lines);
    assert_eq!((kind, free), (0x6700_0001, -1));
    let counts: Vec<usize> = answers.iter().map(Vec::len).collect();
    assert_eq!(counts, [8, 0, 0, 0, 0, 0, 8], "the rotation of the last one is rounded to five decimals");
}

/// Every stored solver is valid C++11 and C++17, alone and as a library of C functions in a namespace. Its first line has the format that MoveIt's script
/// reads.
#[test]
fn every_stored_solver_is_cpp() {
    let mut printed = 0;
    for stored in all() {
        let Ok(text) = emit(&stored.program, &Options::default()) else { continue };
        printed += 1;
        let head = text.lines().next().unwrap();
        assert!(head.starts_with("/// ikfast version 0x1000004a generated ") && head.matches("generated").count() == 1);
        let folder = folder(&stored.program, &Options::default());
        let alone = ["-std=c++17", "-fsyntax-only", "-x", "c++", "5_ikfast.cpp"];
        // One of each kind is compiled as both versions.
        let is_one = ["puma", "general_6r", "scara"].contains(&stored.name.as_str());
        if is_one && compile(folder.path(), &alone).is_none() {
            return;
        }
        let library =
            ["-std=c++11", "-fsyntax-only", "-DIKFAST_CLIBRARY", "-DIKFAST_NO_MAIN", "-DIKFAST_DOUBLE_OPENRAVE"];
        let arguments = [&library[..], &["-DIKFAST_NAMESPACE=arm", "5_ikfast.cpp"]].concat();
        if compile(folder.path(), &arguments).is_none() {
            return;
        }
    }
    assert!(printed >= 18, "{printed}");
}

#[test]
fn a_file_alone_is_a_program_and_may_be_of_single_precision_in_a_namespace() {
    let stored = &named(&["puma"])[0];
    let folder = folder(
        &stored.program,
        &Options { namespace: Some("puma_arm".into()), single: true, file: Some("5_ikfast.cpp".into()) },
    );
    if compile(folder.path(), &["-std=c++11", "5_ikfast.cpp", "-o", "alone"]).is_none() {
        return;
    }
    let target = reached(stored.chain.as_ref().unwrap(), &[0.3, -0.4, 0.5, -0.6, 0.7, -0.8]);
    let words: Vec<String> = target.iter().map(f64::to_string).collect();
    let output = Command::new(folder.path().join("alone")).args(&words).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success() && text.lines().count() == 8, "{text}");
    let near = |line: &str| {
        let q: Vec<f64> = line.split(' ').map(|word| word.parse().unwrap()).collect();
        q.iter().zip([0.3, -0.4, 0.5, -0.6, 0.7, -0.8]).all(|(a, b)| (a - b).abs() < 1e-5)
    };
    assert!(text.lines().any(near), "{text}");
    let usage = Command::new(folder.path().join("alone")).output().unwrap();
    assert!(!usage.status.success() && String::from_utf8(usage.stdout).unwrap().contains("usage: "));
}

#[test]
fn what_ikfast_has_no_words_for_is_refused() {
    let refused = |program: &Program| emit(program, &Options::default()).err().unwrap();
    let error = refused(&leg::program());
    assert_eq!(error.kind(), ErrorKind::Unsupported);
    assert!(error.message().contains("forward kinematics"), "{error}");
    assert!(emit(&wrist::program(false), &Options::default()).unwrap().contains("Rotation3D (0x34000002)"));
    assert!(emit(&wrist::carried(), &Options::default()).unwrap().contains("Transform6D (0x67000001)"));
    for stored in all().iter().filter(|stored| stored.name == "planar_3r") {
        let plane = stored.chain.as_ref().unwrap().task().plane().unwrap().name();
        assert_eq!(emit(&stored.program, &Options::default()).is_ok(), plane == "xy");
    }
    let puma = &named(&["puma"])[0].program;
    for name in ["", "a b", "namespace", "9"] {
        let options = Options { namespace: Some(name.into()), ..Options::default() };
        assert_eq!(emit(puma, &options).unwrap_err().kind(), ErrorKind::BadValue);
    }
}

/// The tool of a SCARA stays upright. A pose rounded to single precision is tilted by 1e-8 rad, which is unreachable. The solutions are those of the nearest
/// reachable pose, both for a description with all digits and for a rounded one.
#[test]
fn rounded_targets_of_a_task_that_asks_too_much_have_all_answers() {
    let mut programs = vec![named(&["scara"]).remove(0).program];
    programs.extend(crate::derive::described::programs());
    for program in programs.iter().filter(|program| emit(program, &Options::default()).is_ok()) {
        let folder = folder(program, &Options { single: true, ..Options::default() });
        if compile(folder.path(), &["-std=c++11", "5_ikfast.cpp", "-o", "alone"]).is_none() {
            return;
        }
        let solver = program.solver();
        for (k, q) in joint_values(program, 30, random()).iter().enumerate() {
            // Every third configuration may be singular.
            if k % 3 == 2 {
                continue;
            }
            let target = solver.reached(q).unwrap();
            let words: Vec<String> = target.iter().map(|value| (*value as f32).to_string()).collect();
            let output = Command::new(folder.path().join("alone")).args(&words).output().unwrap();
            let text = String::from_utf8(output.stdout).unwrap();
            let expected = solver.solve_numbers(&target).unwrap();
            let place = format!("{} at {q:?}: {text}", program.name);
            assert!(output.status.success() && text.lines().count() == expected.len(), "{place}");
            let off = |a: f64, b: &f64| (a - b).abs().min(((a - b).abs() - std::f64::consts::TAU).abs());
            let near = |line: &str| line.split(' ').zip(q).all(|(word, q)| off(word.parse().unwrap(), q) < 1e-4);
            assert!(text.lines().any(near), "{place}");
        }
    }
}

#[test]
fn single_precision_of_a_task_that_asks_too_much_without_a_comparison_is_refused() {
    let mut scara = named(&["scara"]).remove(0).program;
    // A product of two numbers of one joint: the comparison with a rounded target is then not affine in them.
    let last = scara.checks.code.len();
    let (Operand::Register(register), unknown) = (scara.checks.residuals[0], Operand::Unknown(0)) else { panic!() };
    scara.checks.code.push(Instruction { target: last, operation: Operation::Mul(unknown, unknown) });
    scara.checks.code.push(Instruction {
        target: last + 1,
        operation: Operation::Sub(Operand::Register(last), Operand::Register(register)),
    });
    scara.checks.residuals.push(Operand::Register(last + 1));
    scara.checks.scales.push(Operand::Constant(1.0));
    scara.checks.jacobian.push(scara.checks.jacobian[0].clone());
    let error = emit(&scara, &Options { single: true, ..Options::default() }).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unsupported);
    assert!(error.message().contains("omit --float"), "{error}");
    assert!(emit(&scara, &Options::default()).is_ok());
}
