//! Printed equations of motion in both languages, compared with the library at random states.

use std::fmt::Write as _;
use std::fs;

use groebot_algebra::number::BigRational;
use groebot_ik::codegen::dynamics::{Form, Function, Printed};
use groebot_robot::dynamics::{Base, Equations, State};
use groebot_robot::model::{Mimic, Robot};

use super::harness::{compile_c, feed, rustc};
use crate::dynamics_samples::{Random, floating};

/// Reads the number of states, and for each its configuration, velocity and acceleration. Prints the results of all functions as bits.
const RUST_DRIVER: &str = r#"
#[path = "motion.rs"]
mod motion;
use std::io::Read;

fn main() {
    let mut text = String::new();
    std::io::stdin().read_to_string(&mut text).unwrap();
    let mut words = text.split_whitespace();
    let count: usize = words.next().unwrap().parse().unwrap();
    for _ in 0..count {
        let mut next = || words.next().unwrap().parse::<f64>().unwrap();
        let (mut q, mut v, mut a) = ([0.0; motion::COORDINATES], [0.0; motion::FREEDOMS], [0.0; motion::FREEDOMS]);
        q.fill_with(&mut next);
        v.fill_with(&mut next);
        a.fill_with(&mut next);
        let mut all = vec![motion::inverse(&q, &v, &a), motion::gravity(&q)];
        all.extend(motion::inertia(&q));
        all.extend(motion::coriolis(&q, &v));
        all.push(motion::forward(&q, &v, &a));
        all.extend(motion::derivatives(&q, &v, &a).as_flattened());
        let words: Vec<String> = all.as_flattened().iter().map(|x| x.to_bits().to_string()).collect();
        println!("{}", words.join(" "));
    }
}
"#;

const C_DRIVER: &str = r#"
#include "motion.h"
#include <inttypes.h>
#include <stdio.h>

enum { Q = UPPER_DYNAMICS_COORDINATES, N = UPPER_DYNAMICS_FREEDOMS };

static int print(const gb_real *numbers, int count)
{
    for (int i = 0; i < count; ++i) {
        printf("%" PRIu64 " ", (uint64_t)gb_bits_of(numbers[i]));
    }
    return 0;
}

int main(void)
{
    int states;
    static gb_real q[Q], v[N], a[N], out[N * N], more[N * N];
    if (scanf("%d", &states) != 1) {
        return 1;
    }
    for (int state = 0; state < states; ++state) {
        gb_real *lists[] = {q, v, a};
        const int counts[] = {Q, N, N};
        for (int list = 0; list < 3; ++list) {
            for (int i = 0; i < counts[list]; ++i) {
                if (scanf("%lf", &lists[list][i]) != 1) {
                    return 1;
                }
            }
        }
        NAME_inverse(q, v, a, out);
        print(out, N);
        NAME_gravity(q, out);
        print(out, N);
        NAME_inertia(q, out);
        print(out, N * N);
        NAME_coriolis(q, v, out);
        print(out, N * N);
        NAME_forward(q, v, a, out);
        print(out, N);
        NAME_derivatives(q, v, a, out, more);
        print(out, N * N);
        print(more, N * N);
        printf("\n");
    }
    return 0;
}
"#;

/// The results of the library, in the order of the drivers.
fn expected(equations: &Equations, [q, v, a]: [&[f64]; 3]) -> Vec<Vec<f64>> {
    let (mut room, state) = (equations.workspace(), State::new(q, v));
    let by_rows = |matrix: &nalgebra::DMatrix<f64>| matrix.transpose().as_slice().to_vec();
    let list = |vector: &nalgebra::DVector<f64>| vector.as_slice().to_vec();
    let mut all = vec![
        list(equations.inverse(&mut room, state, a).unwrap()),
        list(equations.gravity(&mut room, q).unwrap()),
        by_rows(equations.inertia(&mut room, q).unwrap()),
        by_rows(equations.coriolis(&mut room, state).unwrap()),
        list(equations.forward(&mut room, state, a).unwrap()),
    ];
    let [by_q, by_velocity, _] = equations.derivatives(&mut room, state, a).unwrap();
    all.extend([by_rows(by_q), by_rows(by_velocity)]);
    all
}

/// Compares both languages with each other bitwise, and with the library.
fn compare(description: &str, base: Base, rate: f64) {
    [Form::Straight, Form::Recursive].into_iter().for_each(|form| compare_form(description, base, rate, form));
}

fn compare_form(description: &str, base: Base, rate: f64, form: Form) {
    let robot = Robot::from_urdf(description).unwrap().as_meant().unwrap();
    let mut parts = robot.parts().clone();
    // A joint with an armature (inertia of a rotor).
    parts.joints[0].armature = 0.3;
    let robot = Robot::new(parts).unwrap();
    compare_robot(&robot, base, rate, form);
}

fn compare_robot(robot: &Robot, base: Base, rate: f64, form: Form) {
    let equations = Equations::unchecked(robot, base).unwrap().without_friction();
    let functions = Function::ALL.to_vec();
    let printed = Printed { name: robot.name(), equations: &equations, remarks: Vec::new(), functions, form };
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    let [header, source] = printed.c99("motion").unwrap();
    write("motion.rs", &printed.rust().unwrap());
    write("motion.h", &header);
    write("motion.c", &source);
    write("main.rs", RUST_DRIVER);
    let upper = robot.name().to_ascii_uppercase();
    write("main.c", &C_DRIVER.replace("NAME", robot.name()).replace("UPPER", &upper));
    let mut random = Random(21);
    let joints = equations.joints().len();
    let state = || {
        let mut q = if base == Base::Fixed { Vec::new() } else { floating(&mut random, 0) };
        q.extend(random.numbers(joints, 3.0));
        let [v, a] = [rate, 5.0].map(|most| random.numbers(equations.freedoms(), most));
        [q, v, a]
    };
    let states: Vec<[Vec<f64>; 3]> = std::iter::repeat_with(state).take(20).collect();
    let mut text = format!("{}\n", states.len());
    states.iter().flatten().flatten().for_each(|number| write!(text, "{number:e} ").unwrap());
    let compiled = compile_c(folder.path(), &["main.c", "motion.c", "-lm", "-o", "c99"])
        .and_then(|()| rustc(folder.path(), &["-Amissing_docs", "main.rs"]));
    if compiled.is_none() {
        return;
    }
    let [c, rust] = ["c99", "main"].map(|name| feed(&folder.path().join(name), text.clone()));
    let bits = |text: &str| -> Vec<u64> { text.split_whitespace().map(|word| word.parse().unwrap()).collect() };
    assert!(bits(&c) == bits(&rust), "{}: C and Rust differ", robot.name());
    let mut numbers = bits(&rust).into_iter().map(f64::from_bits);
    for [q, v, a] in &states {
        for (which, list) in expected(&equations, [q, v, a]).iter().enumerate() {
            let size = list.iter().fold(1.0, |size: f64, x| size.max(x.abs()));
            let miss = list.iter().fold(0.0, |miss: f64, x| miss.max((x - numbers.next().unwrap()).abs()));
            // Accelerations are the solution of a linear system.
            let least = if which == 4 { 1e-8 } else { 1e-11 };
            assert!(miss <= least * size, "{} {base:?} {form:?}, {which}: off by {miss:e} of {size:e}", robot.name());
        }
    }
    assert_eq!(numbers.next(), None);
}

#[test]
fn printed_motion_of_an_arm_is_that_of_the_library() {
    compare(include_str!("../../../../tests/corpus/dynamics/ur5.urdf"), Base::Fixed, 2.0);
}

#[test]
fn printed_motion_of_joints_that_slide_is_that_of_the_library() {
    compare(include_str!("../../../../tests/corpus/dynamics/stanford.urdf"), Base::Fixed, 2.0);
    compare(include_str!("../../../../tests/corpus/dynamics/rrp.urdf"), Base::Floating, 2.0);
}

/// Loops over tables: for joints that follow others, and for a humanoid with long straight-line code.
#[test]
fn recursive_code_is_that_of_the_library() {
    let panda =
        Robot::from_urdf(include_str!("../../../../tests/corpus/dynamics/panda.urdf")).unwrap().as_meant().unwrap();
    let mut parts = panda.parts().clone();
    let finger = parts.joints.iter_mut().find(|joint| joint.name == "panda_finger_joint2").unwrap();
    let half = BigRational::new(1.into(), 2.into());
    finger.mimic = Some(Mimic { leader: "panda_finger_joint1".to_owned(), multiplier: half.clone(), offset: half });
    compare_robot(&Robot::new(parts).unwrap(), Base::Floating, 2.0, Form::Recursive);
    let humanoid =
        Robot::from_urdf(include_str!("../../../../tests/corpus/dynamics/humanoid.urdf")).unwrap().as_meant().unwrap();
    compare_robot(&humanoid, Base::Floating, 1.0, Form::Recursive);
}

/// Angles beyond a million rad are first reduced by whole turns, each with an error of 2e-16 rad.
#[test]
fn far_angles_lose_whole_turns() {
    for angle in [3e6, -2e7, 1e9, 0.4] {
        let [[cosine], [sine]] = groebot_runtime::dynamics::cosines_and_sines(&[angle]);
        let least = 2.2e-16 + 4e-17 * f64::abs(angle);
        assert!((cosine - angle.cos()).abs() < least && (sine - angle.sin()).abs() < least, "{angle}");
    }
}

/// The gravity torques of a polar arm need few operations.
#[test]
fn what_is_known_beforehand_is_not_printed() {
    let robot = Robot::from_urdf(include_str!("../../../../tests/corpus/dynamics/rrp.urdf")).unwrap();
    let equations = Equations::new(&robot, Base::Fixed).unwrap();
    let functions = vec![Function::Gravity];
    let printed = Printed { name: "rrp", equations: &equations, remarks: Vec::new(), functions, form: Form::Shorter };
    assert!(printed.operations(Function::Gravity).unwrap() < 20);
}

/// Also as straight-line code, where joints follow others: the linear system of the mass matrix is solved.
#[test]
fn forward_dynamics_of_joints_that_follow_others_is_printed() {
    let mut parts =
        Robot::from_urdf(include_str!("../../../../tests/corpus/dynamics/rrp.urdf")).unwrap().parts().clone();
    let leader = parts.joints.iter().position(|joint| joint.kind.is_single()).unwrap();
    let follower = parts.joints.iter().rposition(|joint| joint.kind.is_single()).unwrap();
    let [third, offset] = [BigRational::new((-1).into(), 3.into()), BigRational::new(1.into(), 5.into())];
    let name = parts.joints[leader].name.clone();
    parts.joints[follower].mimic = Some(Mimic { leader: name, multiplier: third, offset });
    compare_robot(&Robot::new(parts).unwrap(), Base::Fixed, 2.0, Form::Straight);
}

/// Forward dynamics is the only function that is not printed for bodies without mass.
#[test]
fn what_cannot_be_printed_is_refused() {
    let mut parts =
        Robot::from_urdf(include_str!("../../../../tests/corpus/dynamics/ur5.urdf")).unwrap().parts().clone();
    parts.links.iter_mut().for_each(|link| link.mass = None);
    let equations = Equations::unchecked(&Robot::new(parts).unwrap(), Base::Fixed).unwrap();
    for function in Function::ALL {
        let functions = vec![function];
        let printed =
            Printed { name: "ur5", equations: &equations, remarks: Vec::new(), functions, form: Form::Shorter };
        assert_eq!(printed.rust().is_err(), function == Function::Forward, "{}", function.name());
    }
}
