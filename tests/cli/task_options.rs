//! The options for a URDF: `--base`, `--tip`, `--task`, `--direction`, `--free` and `--snap`. They are derived and stored in the folder, and the solutions
//! equal those of the screw solver in `groebot ik`.

use std::f64::consts::TAU;
use std::fs;
use std::path::Path;

use serde_json::Value;
use tempfile::{TempDir, tempdir};

use super::{content, refused, root, run, succeed, text};

fn urdf(name: &str) -> String {
    text(&root("tests/corpus/urdf").join(name)).to_owned()
}

/// A seven-joint arm like KUKA's LBR iiwa 14 (R820). Three axes intersect in the shoulder, in the elbow and in the wrist.
const SEVEN: &str = r#"<robot name="seven"><link name="base"/>
<link name="l1"/><joint name="A1" type="continuous"><parent link="base"/><child link="l1"/><origin xyz="0 0 0.36"/><axis xyz="0 0 1"/></joint>
<link name="l2"/><joint name="A2" type="continuous"><parent link="l1"/><child link="l2"/><axis xyz="0 1 0"/></joint>
<link name="l3"/><joint name="A3" type="continuous"><parent link="l2"/><child link="l3"/><axis xyz="0 0 1"/></joint>
<link name="l4"/><joint name="A4" type="continuous"><parent link="l3"/><child link="l4"/><origin xyz="0 0 0.42"/><axis xyz="0 -1 0"/></joint>
<link name="l5"/><joint name="A5" type="continuous"><parent link="l4"/><child link="l5"/><axis xyz="0 0 1"/></joint>
<link name="l6"/><joint name="A6" type="continuous"><parent link="l5"/><child link="l6"/><origin xyz="0 0 0.4"/><axis xyz="0 1 0"/></joint>
<link name="l7"/><joint name="A7" type="continuous"><parent link="l6"/><child link="l7"/><axis xyz="0 0 1"/></joint>
<link name="tool"/><joint name="flange" type="fixed"><parent link="l7"/><child link="tool"/><origin xyz="0 0 0.126"/></joint></robot>"#;

/// The options, as both commands accept them.
struct Requested<'a> {
    robot: &'a str,
    ends: &'a [&'a str],
}

impl Requested<'_> {
    /// Derives into a new folder, and checks it with `groebot check`.
    fn derive(&self) -> TempDir {
        let folder = tempdir().unwrap();
        let out = ["--quiet", "--out", text(folder.path())];
        assert_eq!(succeed(&[&["derive", self.robot], self.ends, &out].concat()), "");
        succeed(&["check", text(folder.path())]);
        folder
    }

    /// Checks that the derived program and the screw solver have the same solutions for `target`, `count` of them.
    fn assert_solves(&self, folder: &Path, target: &str, count: usize) {
        let derived = solutions(&succeed(&["solve", text(folder), "--json", "--target", target]));
        let screw = solutions(&succeed(&[&["ik", self.robot, "--json", "--target", target], self.ends].concat()));
        assert_eq!((derived.len(), screw.len()), (count, count), "{target}");
        for q in &derived {
            assert_eq!(screw.iter().filter(|other| distance(q, other) < 1e-9).count(), 1, "{q:?} in {screw:?}");
        }
    }
}

/// The joint vectors in JSON output \[rad\].
fn solutions(page: &str) -> Vec<Vec<f64>> {
    let answer: Value = serde_json::from_str(page).unwrap();
    let joints = |solution: &Value| solution["q"].as_array().unwrap().iter().map(|q| q.as_f64().unwrap()).collect();
    answer["solutions"].as_array().unwrap().iter().map(joints).collect()
}

/// The largest difference between two joint vectors, modulo whole turns.
fn distance(a: &[f64], b: &[f64]) -> f64 {
    let difference = |(a, b): (&f64, &f64)| (a - b - TAU * ((a - b) / TAU).round()).abs();
    a.iter().zip(b).map(difference).fold(0.0, f64::max)
}

fn task_file(folder: &TempDir) -> String {
    fs::read_to_string(folder.path().join("0_task.toml")).unwrap()
}

#[test]
fn a_leg_between_two_links() {
    let robot = urdf("nao.urdf");
    let leg = Requested { robot: &robot, ends: &["--base", "torso", "--tip", "l_sole"] };
    let folder = leg.derive();
    assert_eq!(task_file(&folder), "base = \"torso\"\ntip = \"l_sole\"\n");
    leg.assert_solves(folder.path(), "0.02,0.06,-0.29,0,0.1,0,0.99498743710662", 8);
    leg.assert_solves(folder.path(), "0,0.05,1,0,0,0,1", 0);
}

#[test]
fn a_robot_of_one_chain_needs_no_task_file() {
    let robot = urdf("ur5.urdf");
    let arm = Requested { robot: &robot, ends: &[] };
    let folder = arm.derive();
    assert!(!content(folder.path()).contains_key("0_task.toml"));
    arm.assert_solves(folder.path(), "0.3,0.2,0.4,0,0.6,0,0.8", 8);
}

/// The robot of [`SEVEN`], in a new folder.
fn seven() -> (TempDir, String) {
    let folder = tempdir().unwrap();
    let file = folder.path().join("seven.urdf");
    fs::write(&file, SEVEN).unwrap();
    let name = text(&file).to_owned();
    (folder, name)
}

#[test]
fn a_ray_along_the_requested_direction() {
    let (_kept, robot) = seven();
    let ends = ["--tip", "l6", "--task", "ray", "--direction", "1/2,0,1", "--free", "A3"];
    let arm = Requested { robot: &robot, ends: &ends };
    let folder = arm.derive();
    let requested = "given = [\"A3\"]\n\n[task]\nkind = \"ray\"\ndirection = [\"1/2\", \"0\", \"1\"]\n";
    assert_eq!(task_file(&folder), format!("tip = \"l6\"\n{requested}"));
    arm.assert_solves(folder.path(), "0.3,0.2,0.7,0.6,0,0.8,0.3", 8);
}

#[test]
fn a_position_with_given_joints() {
    let robot = urdf("nao.urdf");
    let ends =
        ["--base", "torso", "--tip", "l_hand", "--task", "position", "--given", "LElbowYaw", "--given", "LWristYaw"];
    let arm = Requested { robot: &robot, ends: &ends };
    let folder = arm.derive();
    assert!(task_file(&folder).contains("given = [\"LElbowYaw\", \"LWristYaw\"]\n\n[task]\nkind = \"position\"\n"));
    arm.assert_solves(folder.path(), "0.1,0.15,0.1,-0.4,0.2", 4);
}

#[test]
fn seven_joints_with_one_of_them_free() {
    let (_kept, robot) = seven();
    let arm = Requested { robot: &robot, ends: &["--free", "A3"] };
    arm.assert_solves(arm.derive().path(), "0.4,0.1,0.6,0,0.6,0,0.8,0.3", 8);
}

#[test]
fn the_planner_chooses_the_joint_that_is_given() {
    let (_kept, robot) = seven();
    let arm = Requested { robot: &robot, ends: &[] };
    let folder = arm.derive();
    assert_eq!(task_file(&folder), "given = [\"A7\"]\nredundant = true\n");
    Requested { robot: &robot, ends: &["--free", "A7"] }.assert_solves(folder.path(), "0.4,0.1,0.6,0,0.6,0,0.8,0.3", 8);
    let out = tempdir().unwrap();
    let reported = succeed(&["derive", &robot, "--out", text(out.path())]);
    assert!(reported.starts_with("The chain has one joint more than its task determines."), "{reported}");
    assert!(
        reported.lines().any(|line| line.starts_with("  A7: ") && line.ends_with("; the solver of this page")),
        "{reported}"
    );
    let out = tempdir().unwrap();
    let reported = succeed(&["derive", &robot, "--given", "auto", "--out", text(out.path())]);
    assert!(reported.starts_with("Given with each target: the value of `A7`. The planner chose"), "{reported}");
}

/// Names in URDFs may have any characters. Function names in generated solvers may not.
#[test]
fn a_robot_of_any_name_is_derived() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("robot.urdf");
    let text_of = fs::read_to_string(urdf("kr6_r900.urdf")).unwrap();
    fs::write(&file, text_of.replacen("name=\"kr6r900\"", "name=\"6-axis näo.2\"", 1)).unwrap();
    let out = tempdir().unwrap();
    succeed(&["derive", text(&file), "--task", "position", "--tip", "link_4", "--quiet", "--out", text(out.path())]);
    let printed = succeed(&["codegen", text(out.path()), "--lang", "c"]);
    assert!(printed.contains("GB_DECLARE(x6_axis_n_o_2_link_4, "), "{printed}");
}

/// The first five joints of a KUKA KR 6 with the task `pose`, which has six degrees of freedom. Only consistent targets are solved, and special targets may
/// have more solutions than generic ones.
#[test]
fn five_joints_for_a_pose_are_solved_where_it_is_consistent() {
    let arm = Requested { robot: &urdf("kr6_r900.urdf"), ends: &["--tip", "link_5"] };
    let folder = arm.derive();
    // The pose of the tip at 0.3, -0.5, 0.7, 0.4, 0.6 rad, by forward kinematics.
    let reached = "0.8052354099031206,-0.24908850175229894,0.5689998313554302,\
                   -0.13548885178968467,0.4064672926279581,-0.17392426904970276,0.8866664872994451";
    arm.assert_solves(folder.path(), reached, 1);
    arm.assert_solves(folder.path(), "0.5,0.1,0.7,0,0,0,1", 0);
}

/// A UR5 whose elbow axis is rotated by 1e-5 rad has no exact relation to its neighbours. The ideal robot is the UR5
/// itself.
#[test]
fn axes_that_almost_meet_do_so_within_the_tolerance() {
    let folder = tempdir().unwrap();
    let exact = fs::read_to_string(urdf("ur5.urdf")).unwrap();
    let (head, elbow) = exact.split_at(exact.find("name=\"elbow\"").unwrap());
    let file = folder.path().join("rounded.urdf");
    fs::write(&file, head.to_owned() + &elbow.replacen("xyz=\"0 0 1\"", "xyz=\"0 0.00001 1\"", 1)).unwrap();
    // Without a tolerance, or with one that is too small, the robot is solved as described: six general axes.
    let out = tempdir().unwrap();
    let ran = run(&["derive", text(&file), "--quiet", "--out", text(out.path())]);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    let plan = fs::read_to_string(out.path().join("2_plan.txt")).unwrap();
    assert!(plan.contains("16"), "{plan}");
    assert!(!succeed(&["info", text(&file), "--snap", "1e-9"]).contains("parallel axes"));
    let page = succeed(&["info", text(&file), "--snap", "5e-5"]);
    assert!(
        page.contains("axes 2 and 3 are parallel; they are 1.0e-5 rad off")
            && page.contains("2-4  shoulder_lift, elbow, wrist_1  parallel axes"),
        "{page}"
    );
    let robot = urdf("ur5.urdf");
    let arm = Requested { robot: &robot, ends: &["--snap", "5e-5"] };
    let folder = arm.derive();
    assert_eq!(task_file(&folder), "snap = \"1/20000\"\n");
    let solved = solutions(&succeed(&["solve", text(folder.path()), "--json", "--target", "0.3,0.2,0.4,0,0.6,0,0.8"]));
    assert_eq!(solved.len(), 8);
}

/// A folder stores its options. Deriving it again uses the same options, and writes the same bytes.
#[test]
fn the_folder_is_derived_again_with_its_options() {
    let robot = urdf("nao.urdf");
    let folder =
        Requested { robot: &robot, ends: &["--tip", "Head", "--base", "torso", "--task", "direction"] }.derive();
    let before = content(folder.path());
    assert_eq!(succeed(&["derive", text(folder.path()), "--quiet"]), "");
    assert_eq!(content(folder.path()), before);
}

#[test]
fn what_the_robot_does_not_have_is_refused() {
    let robot = urdf("nao.urdf");
    let out = tempdir().unwrap();
    let derive = |ends: &[&str]| refused(&[&["derive", &robot, "--out", text(out.path())], ends].concat());
    let arm = ["--base", "torso", "--tip", "l_hand"];
    let with = |more: &[&str]| derive(&[&arm, more].concat());
    let cases = [
        (derive(&["--tip", "nose"]), &["`nose`"][..]),
        (derive(&["--base", "torso", "--tip", "torso"]), &["torso"]),
        (derive(&[]), &["several leaf links", "choose a tip link"]),
        (with(&["--free", "LElbow"]), &["`LElbow`", "`LElbowYaw`"]),
        (with(&["--free", "LElbowYaw", "--free", "LElbowYaw"]), &["`LElbowYaw`", "twice"]),
        (with(&["--direction", "1,0,0"]), &["`pose`", "orients no direction"]),
        (with(&["--task", "ray", "--direction", "0,0,0"]), &["direction"]),
        (with(&["--task", "planar_pose"]), &["--plane xy, xz or yz"]),
        (with(&["--plane", "xy"]), &["--plane belongs to a planar task"]),
        (with(&["--snap", "0.2"]), &["tolerance", "from 0 to 0.1"]),
        (with(&["--snap=-1"]), &["tolerance", "from 0 to 0.1"]),
    ];
    for (error, words) in cases {
        assert!(words.iter().all(|word| error.contains(word)), "{words:?}: {error}");
    }
    assert!(content(out.path()).is_empty(), "nothing is written");
}

#[test]
fn what_is_no_option_ends_with_the_usage() {
    let robot = urdf("ur5.urdf");
    for wrong in [
        ["--task", "dance"],
        ["--plane", "diagonal"],
        ["--direction", "1,0"],
        ["--direction", "1,0,up"],
        ["--snap", "little"],
        ["--snap", "inf"],
    ] {
        let ran = run(&[&["derive", &robot], &wrong[..]].concat());
        assert!(ran.code == 2 && ran.out.is_empty() && ran.err.contains(wrong[0]), "{wrong:?}: {}", ran.err);
    }
}

#[test]
fn only_a_urdf_has_links_and_a_system_has_its_own_task() {
    let leg = root("derivations/nao_leg_sagittal");
    let error = refused(&["derive", text(&leg), "--tip", "foot"]);
    assert!(error.contains("only a URDF has links"), "{error}");
    let arm = root("derivations/nao_arm_planar");
    let error = refused(&["derive", text(&arm), "--task", "position"]);
    assert!(error.contains("a system of equations has its own"), "{error}");
}
