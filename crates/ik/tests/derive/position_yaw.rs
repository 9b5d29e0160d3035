//! The task `position_yaw`: the position of the tip, and the angle of one of its directions about a base axis.

use groebot_algebra::number::BigRational;
use groebot_ik::Result;
use groebot_ik::solver::Program;
use groebot_robot::kinematics::{BaseAxis, Chain, Target, Task};
use groebot_robot::model::Robot;

use crate::codegen::random;

/// A SCARA with links of 0.3 m and 0.25 m whose quill points down, on a base with this roll, pitch and yaw.
fn scara(base: &str) -> Chain {
    let joint = |place: usize, kind: &str, xyz: &str, rpy: &str| {
        format!(
            "<link name=\"l{place}\"/><joint name=\"j{place}\" type=\"{kind}\"><parent link=\"l{}\"/><child link=\"l{place}\"/>\
             <origin xyz=\"{xyz}\" rpy=\"{rpy}\"/><axis xyz=\"0 0 1\"/><limit lower=\"-3\" upper=\"3\" effort=\"1\" velocity=\"1\"/></joint>",
            place - 1
        )
    };
    let joints = [
        joint(1, "revolute", "0 0 0.1", base),
        joint(2, "revolute", "0.3 0 0", "0 0 0"),
        joint(3, "prismatic", "0.25 0 0", "3.141592653589793 0 0"),
        joint(4, "revolute", "0 0 0.02", "0 0 0"),
    ];
    let text = format!("<robot name=\"scara\"><link name=\"l0\"/>{}</robot>", joints.concat());
    Robot::from_urdf(&text).unwrap().chain(None, None).unwrap()
}

fn with_task(chain: &Chain, axis: BaseAxis, direction: [i32; 3]) -> Chain {
    let direction = direction.map(|x| BigRational::from_integer(x.into()));
    chain.with_task(Task::PositionYaw { axis }, direction, Vec::new()).unwrap()
}

fn derived(chain: &Chain) -> Result<Program> {
    Ok(groebot_ik::derive(chain)?.program().clone())
}

/// Derived by hand: the tip rotates by j1 + j2 - j4 about the vertical, because the quill points down.
#[test]
fn a_scara_has_two_elbows_at_the_angle_that_is_asked() {
    let chain = with_task(&scara("0 0 0"), BaseAxis::Z, [1, 0, 0]);
    let program = derived(&chain).unwrap();
    let names: Vec<&str> = program.inputs.iter().map(|input| input.name.as_str()).collect();
    assert_eq!((names.as_slice(), program.isolated), (&["px", "py", "pz", "yaw"][..], Some(2)));
    let (solver, mut between) = (program.solver(), random());
    for _ in 0..200 {
        let [a, b, d, c] = [between(-3.0, 3.0), between(0.1, 3.0), between(-0.2, 0.2), between(-3.0, 3.0)];
        let place = [0.3 * a.cos() + 0.25 * (a + b).cos(), 0.3 * a.sin() + 0.25 * (a + b).sin(), 0.1 - d - 0.02];
        let target = [place[0], place[1], place[2], a + b - c];
        let answers = solver.solve_numbers(&target).unwrap();
        let elbows: Vec<f64> = answers.iter().map(|answer| answer.q[1]).collect();
        assert_eq!(answers.len(), 2, "{target:?}");
        assert!(elbows.iter().all(|elbow| (elbow.abs() - b).abs() < 1e-9), "{elbows:?} {b}");
        for answer in &answers {
            let turned = answer.q[0] + answer.q[1] - answer.q[3] - target[3];
            assert!(turned.sin().abs() < 1e-12 && turned.cos() > 0.0 && (answer.q[2] - d).abs() < 1e-12);
        }
    }
}

/// A SCARA on a wall: the axis is x or y. The angle about x starts at y, that about y at z. Directions may have any length.
#[test]
fn every_axis_counts_from_the_next_one() {
    let (quarter, robots) = (std::f64::consts::FRAC_PI_2, [BaseAxis::X, BaseAxis::Y, BaseAxis::Z]);
    for (axis, base) in
        robots.into_iter().zip([format!("0 {quarter} 0"), format!("{} 0 0", -quarter), "0 0 0.3".to_owned()])
    {
        for direction in [[1, 0, 0], [0, -2, 0], [1, 1, 0]] {
            let chain = with_task(&scara(&base), axis, direction);
            let (program, mut between) = (derived(&chain).unwrap(), random());
            let solver = program.solver();
            for _ in 0..40 {
                let q = [between(-3.0, 3.0), between(0.1, 3.0), between(-0.2, 0.2), between(-3.0, 3.0)];
                let pose = chain.forward(&q).unwrap();
                let [x, y, z] = direction.map(f64::from);
                let points = pose.rotation * nalgebra::Vector3::new(x, y, z);
                let k = axis.coordinate();
                let yaw = points[(k + 2) % 3].atan2(points[(k + 1) % 3]);
                let target = Target::PositionYaw { point: pose.translation.vector.into(), yaw };
                let answers = solver.solve(target).unwrap();
                assert_eq!(answers.len(), 2, "{axis:?} {direction:?} {q:?}");
                assert!(
                    answers.iter().any(|answer| answer
                        .q
                        .iter()
                        .zip(&q)
                        .all(|(a, b)| ((a - b) / 2.0).sin().abs() < 1e-9))
                );
                assert!(answers.iter().all(|answer| target.missed(&chain, &answer.q).iter().all(|miss| *miss < 1e-12)));
            }
        }
    }
}

#[test]
fn files_for_ikfast_have_the_type_of_the_axis() {
    let quarter = std::f64::consts::FRAC_PI_2;
    let types = [
        (BaseAxis::Z, "0 0 0".to_owned(), "TranslationXAxisAngleZNorm4D", "0x4400000e"),
        (BaseAxis::X, format!("0 {quarter} 0"), "TranslationYAxisAngleXNorm4D", "0x4400000f"),
        (BaseAxis::Y, format!("{} 0 0", -quarter), "TranslationZAxisAngleYNorm4D", "0x44000010"),
    ];
    for (axis, base, name, code) in types {
        let program = derived(&with_task(&scara(&base), axis, [1, 0, 0])).unwrap();
        let text = groebot_ik::codegen::ikfast::emit(&program, &Default::default()).unwrap();
        assert!(
            text.contains(&format!("Type: {name} ({code})")) && text.contains(&format!("return {code};")),
            "{axis:?}"
        );
        assert!(text.contains("target[3] = static_cast<double>(eerot[0]);"), "{axis:?}");
    }
}

#[test]
fn tips_that_tilt_and_directions_along_the_axis_are_refused() {
    let refused = |chain: &Chain| derived(chain).unwrap_err().to_string();
    let along = refused(&with_task(&scara("0 0 0"), BaseAxis::Z, [0, 0, 1]));
    assert!(along.contains("not perpendicular to the base's z") && along.contains("--direction"), "{along}");
    let tilted = refused(&with_task(&scara("0 0 0"), BaseAxis::X, [0, 0, 1]));
    assert!(tilted.contains("`j1` tilts the tip"), "{tilted}");
}

#[test]
fn files_of_chains_have_an_axis_and_a_usual_direction() {
    let text = |task: &str| {
        format!(
            "name = 'lift'\n[[joint]]\nname = 'turn'\ntype = 'revolute'\naxis = [0, 0, 1]\npoint = [0, 0, 0]\n[task]\n{task}\n[tip]\npoint = [1, 0, 0]"
        )
    };
    let chain = Chain::from_toml(&text("kind = 'position_yaw'")).unwrap();
    assert_eq!(chain.task_text(), "position_yaw about z of [1, 0, 0]");
    let chain = Chain::from_toml(&text("kind = 'position_yaw'\naxis = 'x'")).unwrap();
    assert_eq!(chain.task_text(), "position_yaw about x of [0, 1, 0]");
    for (task, what) in [("kind = 'pose'\naxis = 'z'", "no axis"), ("kind = 'position_yaw'\naxis = 'w'", "`z`")] {
        let error = Chain::from_toml(&text(task)).unwrap_err();
        assert!(error.message().contains(what), "{error}");
    }
}
