//! Further functions of printed solvers in C and Rust: forward kinematics, solutions within limits and their whole turns, and the nearest solution. They are
//! compared with a search over all turns.

use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use groebot_ik::codegen::c99::Pair;
use groebot_ik::codegen::rust;
use groebot_ik::solver::{About, JointValue, Program, Solver};
use groebot_robot::kinematics::Solution;

use super::harness::{SANITIZERS, compile_solver, feed, has_sanitizers, rustc, write_c};
use super::random;
use super::stored::{joint_values, named};

const C_DRIVER: &str = include_str!("drivers/turns.c.txt");
const RUST_DRIVER: &str = include_str!("drivers/turns.rs.txt");

/// Inputs of a solver.
struct Question {
    target: Vec<f64>,
    limits: Vec<[f64; 2]>,
    reference: Vec<f64>,
    weights: Vec<f64>,
}

/// The numbers of whole turns with which a joint's value is within its limits, by a search. Empty represents an infinite list.
fn turns(program: &Program, joint: usize, value: f64, [low, high]: [f64; 2]) -> Vec<i32> {
    let inside = |turn: &i32| {
        let place = value + TAU * f64::from(*turn);
        low - 1e-9 <= place && place <= high + 1e-9
    };
    let all = if matches!(program.joints[joint].value, JointValue::Angle { .. }) { -12..=12 } else { 0..=0 };
    all.filter(inside).collect()
}

fn placed(program: &Program, joint: usize, value: f64, turn: i32) -> f64 {
    match program.joints[joint].value {
        JointValue::Angle { .. } => value + TAU * f64::from(turn),
        JointValue::Plain(_) => value,
    }
}

/// The least of some turns by a measure, the first of equals.
fn least(turns: &[i32], measure: impl Fn(i32) -> f64) -> i32 {
    *turns.iter().min_by(|a, b| measure(**a).total_cmp(&measure(**b))).unwrap()
}

/// All results of one solver, read from its output.
struct Output<'a> {
    numbers: Box<dyn Iterator<Item = f64> + 'a>,
    joints: usize,
}

impl Output<'_> {
    fn next(&mut self) -> f64 {
        self.numbers.next().expect("there is more output")
    }

    fn joints(&mut self) -> Vec<f64> {
        (0..self.joints).map(|_| self.next()).collect()
    }
}

#[track_caller]
fn assert_close(a: &[f64], b: &[f64], place: &str) {
    assert!(a.len() == b.len() && a.iter().zip(b).all(|(a, b)| (a - b).abs() <= 1e-11), "{place}: {a:?} {b:?}");
}

fn check((program, solver): (&Program, &Solver), question: &Question, output: &mut Output<'_>, place: &str) {
    let answers = solver.solve_numbers(&question.target).unwrap();
    let joints = program.joints.len();
    let turned = |answer: &Solution| -> Vec<Vec<i32>> {
        (0..joints).map(|joint| turns(program, joint, answer.q[joint], question.limits[joint])).collect()
    };
    let endless = |joint: usize| question.limits[joint].iter().any(|limit| limit.is_infinite());
    assert_eq!(output.next(), answers.len() as f64, "{place}");
    for answer in &answers {
        let lists = turned(answer);
        let single = |joint: usize| {
            let list = &lists[joint];
            if endless(joint) && !list.is_empty() {
                vec![least(list, |turn| f64::from(turn.abs()))]
            } else {
                list.clone()
            }
        };
        let lists: Vec<Vec<i32>> = (0..joints).map(single).collect();
        let count: usize = lists.iter().map(Vec::len).product();
        assert_eq!(output.next(), count as f64, "{place}: turns of {:?}", answer.q);
        for index in 0..count.min(100) {
            let mut rest = index;
            let mut expected = answer.q.clone();
            for joint in (0..joints).rev() {
                expected[joint] = placed(program, joint, answer.q[joint], lists[joint][rest % lists[joint].len()]);
                rest /= lists[joint].len();
            }
            assert_close(&output.joints(), &expected, place);
        }
        let reached: Vec<f64> = program.inputs.iter().map(|_| output.next()).collect();
        assert_close(&reached, &solver.reached(&answer.q).unwrap(), place);
    }
    let within: Vec<&Solution> =
        answers.iter().filter(|answer| turned(answer).iter().all(|list| !list.is_empty())).collect();
    assert_eq!(output.next(), within.len() as f64, "{place}: within limits");
    for answer in within {
        let lists = turned(answer);
        let expected: Vec<f64> = (0..joints)
            .map(|joint| placed(program, joint, answer.q[joint], least(&lists[joint], |turn| f64::from(turn.abs()))))
            .collect();
        assert_close(&output.joints(), &expected, place);
    }
    check_nearest_to(solver, question, output, place);
    check_nearest(program, question, &answers, output, place);
}

/// Equal to the last bit to the interpreted program.
fn check_nearest_to(solver: &Solver, question: &Question, output: &mut Output<'_>, place: &str) {
    let Question { target, limits, reference, weights } = question;
    let found = solver.nearest_to(target, reference, Some(weights), Some(limits)).unwrap();
    assert_eq!(output.next(), f64::from(u8::from(found.is_some())), "{place}: nearest on self-motions");
    if let Some(found) = found {
        let free = found.free.iter().fold(0, |bits, joint| bits | 1_u32 << joint);
        let head = [found.branch as f64, found.residual, f64::from(free)];
        assert_eq!([output.next(), output.next(), output.next()], head, "{place}: nearest on self-motions");
        assert_eq!(output.joints(), found.q, "{place}: nearest on self-motions");
    }
}

fn check_nearest(program: &Program, question: &Question, answers: &[Solution], output: &mut Output<'_>, place: &str) {
    let mut best: Option<(usize, Vec<f64>, f64)> = None;
    for (index, answer) in answers.iter().enumerate() {
        let mut q = Vec::new();
        for joint in 0..program.joints.len() {
            let list = turns(program, joint, answer.q[joint], question.limits[joint]);
            if list.is_empty() {
                break;
            }
            let far = |turn: i32| (placed(program, joint, answer.q[joint], turn) - question.reference[joint]).abs();
            q.push(placed(program, joint, answer.q[joint], least(&list, far)));
        }
        if q.len() < program.joints.len() {
            continue;
        }
        let distance =
            q.iter().zip(&question.reference).zip(&question.weights).map(|((a, b), w)| w * (a - b) * (a - b)).sum();
        if best.as_ref().is_none_or(|(_, _, least)| distance < *least) {
            best = Some((index, q, distance));
        }
    }
    let index = output.next();
    match best {
        None => assert_eq!(index, -1.0, "{place}: nearest"),
        Some((expected, q, _)) => {
            assert_eq!(index, expected as f64, "{place}: nearest");
            assert_close(&output.joints(), &q, place);
        }
    }
}

/// Limits of all kinds: none, on one side, narrow, several turns, and at the solution itself.
fn limits(kind: usize, q: f64) -> [f64; 2] {
    match kind % 6 {
        0 => [f64::NEG_INFINITY, f64::INFINITY],
        1 => [-TAU, TAU],
        2 => [-1.5, f64::INFINITY],
        3 => [q, q + 3.0 * PI],
        4 => [-0.5 * PI, 0.75 * PI],
        _ => [f64::NEG_INFINITY, 9.0],
    }
}

fn questions(program: &Program) -> Vec<Question> {
    let mut between = random();
    let joints = joint_values(program, 120, random());
    joints
        .iter()
        .enumerate()
        .filter(|(index, _)| index % 3 < 2)
        .map(|(index, q)| Question {
            target: program.reached(q).unwrap(),
            limits: q
                .iter()
                .enumerate()
                .map(|(joint, q)| limits(if index % 5 < 3 { index + joint } else { 1 }, *q))
                .collect(),
            reference: q.iter().map(|q| q + between(-6.0, 6.0)).collect(),
            weights: q.iter().enumerate().map(|(joint, _)| if joint == 1 { 0.0 } else { between(0.1, 2.0) }).collect(),
        })
        .collect()
}

fn text(questions: &[Question]) -> String {
    let mut text = format!("{}\n", questions.len());
    for question in questions {
        let limits = question.limits.iter().flatten();
        let numbers = question.target.iter().chain(limits).chain(&question.reference).chain(&question.weights);
        let words: Vec<String> = numbers.map(|value| format!("{value:e}")).collect();
        writeln!(text, "{}", words.join(" ")).unwrap();
    }
    text
}

/// The compiled C driver. `None` without a compiler.
fn c_program(program: &Program, folder: &Path, flags: &[&str]) -> Option<()> {
    let upper = program.name.to_ascii_uppercase();
    write_c(program, folder);
    fs::write(folder.join("main.c"), C_DRIVER.replace("NAME", &program.name).replace("UPPER", &upper)).unwrap();
    compile_solver(program, folder, flags, "c99")
}

fn executables(program: &Program, folder: &Path) -> Option<Vec<(&'static str, PathBuf)>> {
    c_program(program, folder, &[])?;
    fs::write(folder.join("5_solver.rs"), rust::emit(program)).unwrap();
    fs::write(folder.join("module.rs"), RUST_DRIVER).unwrap();
    rustc(folder, &["module.rs"])?;
    Some(vec![("C99", folder.join("c99")), ("Rust", folder.join("module"))])
}

/// Checks the printed solvers of a program. `None` without a compiler.
pub fn check_program(program: &Program) -> Option<()> {
    let folder = tempfile::tempdir().unwrap();
    let (solver, questions) = (program.solver(), questions(program));
    for (language, executable) in executables(program, folder.path())? {
        let output = feed(&executable, text(&questions));
        let numbers = Box::new(output.split_whitespace().map(|word| word.parse::<f64>().unwrap()));
        let mut output = Output { numbers, joints: program.joints.len() };
        for (index, question) in questions.iter().enumerate() {
            let place = format!("{} in {language}, question {index}", program.name);
            check((program, &solver), question, &mut output, &place);
        }
    }
    Some(())
}

/// Questions at poses with a singular wrist or next to it. Limits of the fourth joint exclude the values that made the pose, or there are none.
fn singular_questions(program: &Program, q5: f64) -> Vec<Question> {
    let mut between = random();
    let made = (0..60).map(|index| {
        let mut q: Vec<f64> = (0..6).map(|_| between(-3.0, 3.0)).collect();
        q[4] = q5 + if index % 4 == 3 { 1e-8 } else { 0.0 };
        let mut limits = vec![[-TAU, TAU]; 6];
        if index % 5 == 2 {
            limits[3] = [q[3] + 0.1, q[3] + 0.15];
        }
        let off = if index % 2 == 0 { 0.0 } else { 0.3 };
        Question {
            target: program.reached(&q).unwrap(),
            limits,
            reference: q.iter().map(|q| q + between(-off, off)).collect(),
            weights: q.iter().map(|_| between(0.3, 2.0)).collect(),
        }
    });
    made.collect()
}

/// Along self-motions the printed solvers are equal to the interpreted program to the last bit.
#[test]
fn nearest_members_of_self_motions_are_equal_in_all_languages() {
    for (name, q5) in [("puma", PI / 2.0), ("ur5", 0.0), ("irb4600_rounded", 0.0)] {
        let program = named(&[name]).remove(0).program;
        let folder = tempfile::tempdir().unwrap();
        let Some(executables) = executables(&program, folder.path()) else { return };
        let (solver, questions) = (program.solver(), singular_questions(&program, q5));
        for (language, executable) in executables {
            let output = feed(&executable, text(&questions));
            let numbers = Box::new(output.split_whitespace().map(|word| word.parse::<f64>().unwrap()));
            let mut output = Output { numbers, joints: 6 };
            for (index, question) in questions.iter().enumerate() {
                let place = format!("{name} in {language}, question {index}");
                skip_to_nearest(program.inputs.len(), &mut output);
                check_nearest_to(&solver, question, &mut output, &place);
                if output.next() >= 0.0 {
                    output.joints();
                }
            }
        }
    }
}

/// Skips solutions, their turns, and those within limits.
fn skip_to_nearest(inputs: usize, output: &mut Output<'_>) {
    let answers = output.next() as usize;
    for _ in 0..answers {
        let turns = output.next() as usize;
        (0..turns.min(100) * 6 + inputs).for_each(|_| _ = output.next());
    }
    let within = output.next() as usize;
    (0..within).for_each(|_| _ = output.joints());
}

#[test]
fn turns_limits_and_nearest_solutions_are_those_of_a_search() {
    for stored in named(&["ur5", "scara", "iiwa14", "planar_3r"]) {
        if check_program(&stored.program).is_none() {
            return;
        }
    }
}

/// Where a joint of the wrist is free, a member of the self-motion is within the limits, although the listed one is not.
#[test]
fn self_motions_reach_into_limits() {
    for (name, q, joint) in
        [("puma", [0.3, -0.4, 0.5, -0.6, PI / 2.0, -0.8], 3), ("ur5", [0.3, -0.9, 1.1, 0.4, 0.0, 0.7], 5)]
    {
        let program = named(&[name]).remove(0).program;
        let folder = tempfile::tempdir().unwrap();
        let Some(executables) = executables(&program, folder.path()) else { return };
        let target = program.reached(&q).unwrap();
        let self_motions = program
            .solve_numbers(&target)
            .unwrap()
            .iter()
            .filter(|answer| answer.free == [joint] || answer.free.len() == 1)
            .count();
        assert!(self_motions > 0, "{name}");
        for low in [-2.9, -1.0, 0.15, 1.3, 2.6] {
            let mut limits = vec![[-TAU, TAU]; 6];
            limits[joint] = [low, low + 0.25];
            let question = [Question {
                target: target.clone(),
                limits: limits.clone(),
                reference: q.to_vec(),
                weights: vec![1.0; 6],
            }];
            for (language, executable) in &executables {
                let place = format!("{name} in {language} from {low}");
                let output = feed(executable, text(&question));
                let lines: Vec<Vec<f64>> = output
                    .lines()
                    .map(|line| line.split_whitespace().map(|word| word.parse().unwrap()).collect())
                    .collect();
                // The nearest member of all, after a one, follows the rows.
                let end = lines.iter().rposition(|line| line.len() == 9).unwrap() - 1;
                let rows: Vec<&Vec<f64>> = lines[..end].iter().rev().take_while(|line| line.len() == 6).collect();
                assert_eq!(lines[end - rows.len() - 1], [rows.len() as f64], "{place}");
                assert!(!rows.is_empty(), "{place}: nothing within limits");
                for row in rows {
                    assert!(low - 1e-9 <= row[joint] && row[joint] <= low + 0.25 + 1e-9, "{place}: {row:?}");
                    assert_close(&program.reached(row).unwrap(), &target, &place);
                }
            }
        }
    }
}

/// The inputs above, and invalid targets and limits: there is no access out of bounds and no undefined operation.
#[test]
fn sanitizers_find_nothing() {
    let program = named(&["puma"]).remove(0).program;
    let folder = tempfile::tempdir().unwrap();
    if !has_sanitizers(folder.path()) || c_program(&program, folder.path(), &SANITIZERS).is_none() {
        println!("skipped: there are no sanitizers");
        return;
    }
    let mut questions = questions(&program);
    let odd = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e300, 0.0, 1e-300];
    for k in 0..120 {
        let mut question = Question {
            target: questions[k % 40].target.clone(),
            limits: vec![[odd[k % 7], odd[(k / 7) % 7]]; 6],
            reference: vec![odd[(k + 3) % 7]; 6],
            weights: vec![odd[(k + 5) % 7]; 6],
        };
        if k % 2 == 0 {
            question.target[k % 12] = odd[k % 5];
        }
        questions.push(question);
    }
    assert!(feed(&folder.path().join("c99"), text(&questions)).lines().count() > questions.len());
}

#[test]
fn limits_and_the_source_stand_in_the_file() {
    let mut program = named(&["scara"]).remove(0).program;
    let limits = vec![Some((-1.25, 2.5)), None, Some((0.0, 0.25)), None];
    let [base, tip] = ["base_link", "tool0"].map(|name| Some(name.to_owned()));
    let hash = "0123456789abcdef".into();
    program.about = Some(About { base, tip, solutions: None, hash, limits, follows: Vec::new() });
    let (pair, rust) = (Pair::new(&program, "scara"), rust::emit(&program));
    for text in [&pair.header, &rust] {
        let head: Vec<&str> = text.lines().take(12).collect();
        let head = head.join("\n");
        for part in ["Task: pose", "Base link: base_link", "Tip link: tool0", "Hash of the input: 0123456789abcdef"] {
            assert!(head.contains(part), "{part} is missing in\n{head}");
        }
    }
    let limits =
        "{(gb_real)-1.25, (gb_real)2.5, -INFINITY, INFINITY, (gb_real)0.0, (gb_real)0.25, -INFINITY, INFINITY};";
    assert!(pair.source.contains(&format!("_limits[2 * SCARA_JOINTS] = {limits}")), "{}", pair.source);
    let none = "[f64::NEG_INFINITY, f64::INFINITY]";
    assert!(rust.contains(&format!("[[-1.25, 2.5], {none}, [0.0, 0.25], {none}];")));
}
