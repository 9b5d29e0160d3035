//! `groebot dynamics` on arms of rods whose equations of motion are in textbooks.

use std::fs;
use std::path::PathBuf;

use tempfile::{TempDir, tempdir};

use super::{refused, run, succeed, text};

/// Two rods in series, of 2 kg and 1 m, that rotate about y. Their inertia about their centres is 0.2 kg m^2. The elbow has friction.
const ARM: &str = r#"<robot name="arm">
  <link name="world"><inertial><mass value="4"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
  <link name="upper"><inertial><origin xyz="0.5 0 0"/><mass value="2"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.2" iyz="0" izz="0.2"/></inertial></link>
  <link name="lower"><inertial><origin xyz="0.5 0 0"/><mass value="2"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.2" iyz="0" izz="0.2"/></inertial></link>
  <link name="tool"/>
  <joint name="shoulder" type="continuous"><parent link="world"/><child link="upper"/><axis xyz="0 1 0"/></joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/><origin xyz="1 0 0"/><axis xyz="0 1 0"/><dynamics damping="3" friction="0.5"/></joint>
  <joint name="tip" type="fixed"><parent link="lower"/><child link="tool"/><origin xyz="1 0 0"/></joint>
</robot>"#;

struct Files {
    _folder: TempDir,
    robot: PathBuf,
    states: PathBuf,
}

fn files(robot: &str, states: &str) -> Files {
    let folder = tempdir().unwrap();
    let files =
        Files { robot: folder.path().join("robot.urdf"), states: folder.path().join("states.csv"), _folder: folder };
    fs::write(&files.robot, robot).unwrap();
    fs::write(&files.states, states).unwrap();
    files
}

/// The rows of the table as numbers, by name.
fn table(text: &str) -> Vec<Vec<(String, f64)>> {
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let row = |line: &str| {
        names.iter().map(|name| (*name).to_owned()).zip(line.split(',').map(|x| x.parse().unwrap())).collect()
    };
    lines.map(row).collect()
}

fn at(row: &[(String, f64)], name: &str) -> f64 {
    row.iter().find(|(other, _)| other == name).unwrap_or_else(|| panic!("{name}")).1
}

/// The planar arm of two rods: M. W. Spong, S. Hutchinson and M. Vidyasagar, Robot Modeling and Control (2006), section 7.4.
#[test]
fn two_rods_move_as_in_the_textbook() {
    let files = files(ARM, "q0,q1,v0,v1,a0,a1\n0.3,0.7,0.5,-0.4,1.5,2.5\n");
    let [robot, states] = [text(&files.robot), text(&files.states)];
    let rows = table(&succeed(&["dynamics", robot, "--states", states, "--no-friction"]));
    let row = &rows[0];
    let (c, s) = (0.7_f64.cos(), 0.7_f64.sin());
    let corner = 2.0 * 0.25 + 0.2;
    let inertia = [corner + corner + 2.0 * (1.0 + c), corner + c, corner];
    // Gravity is along -z. A rotation about y by q maps x towards -z: the height of a point at x is -x sin q.
    let pull = 2.0 * 9.81;
    let gravity = [-pull * (1.5 * 0.3_f64.cos() + 0.5 * 1.0_f64.cos()), -pull * 0.5 * 1.0_f64.cos()];
    let coriolis = [[-s * -0.4, -s * (0.5 - 0.4)], [s * 0.5, 0.0]];
    let near = |name: &str, expected: f64| {
        let found = at(row, name);
        assert!((found - expected).abs() < 1e-12, "{name}: {found}, {expected}");
    };
    ["M0_0", "M1_0", "M1_1"].iter().zip(inertia).for_each(|(name, expected)| near(name, expected));
    ["C0_0", "C0_1", "C1_0", "C1_1"].iter().zip(coriolis.concat()).for_each(|(name, expected)| near(name, expected));
    ["g0", "g1"].iter().zip(gravity).for_each(|(name, expected)| near(name, expected));
    let torque = |i: usize| {
        let [m00, m10, m11] = inertia;
        let m = [[m00, m10], [m10, m11]][i];
        m[0] * 1.5 + m[1] * 2.5 + coriolis[i][0] * 0.5 + coriolis[i][1] * -0.4 + gravity[i]
    };
    ["tau0", "tau1"].iter().zip([torque(0), torque(1)]).for_each(|(name, expected)| near(name, expected));
    ["qdd0", "qdd1"].iter().zip([1.5, 2.5]).for_each(|(name, expected)| near(name, expected));

    // Friction opposes the elbow's motion. The given torques cause the motion.
    let row = &table(&succeed(&["dynamics", robot, "--states", states]))[0];
    assert!((at(row, "tau1") - (torque(1) - 3.0 * 0.4 - 0.5)).abs() < 1e-12);
    assert!((at(row, "qdd1") - 2.5).abs() < 1e-12);
}

#[test]
fn given_torques_a_free_root_and_a_part_of_the_robot() {
    // At rest, without gravity, a force of 8 N along x accelerates the 8 kg of a straight arm and its root.
    let free =
        "q0,q1,q2,q3,q4,q5,q6,q7,q8,tau0,tau1,tau2,tau3,tau4,tau5,tau6,tau7\n1,2,3,0,0,0,1,0,0,8,0,0,0,0,0,0,0\n";
    let files_free = files(ARM, free);
    let [robot, states] = [text(&files_free.robot), text(&files_free.states)];
    let json = succeed(&["dynamics", robot, "--states", states, "--gravity", "0,0,0", "--json"]);
    let report: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!((&report["format"], &report["floating"]), (&2.into(), &true.into()));
    assert_eq!(report["joints"], serde_json::json!(["shoulder", "elbow"]));
    assert!((report["states"][0]["qdd"][0].as_f64().unwrap() - 1.0).abs() < 1e-12);

    // The elbow alone, relative to the upper rod: a rod about its end.
    let part = files(ARM, "q0\n0\n");
    let [robot, states] = [text(&part.robot), text(&part.states)];
    let rows = table(&succeed(&["dynamics", robot, "--base", "upper", "--tip", "tool", "--states", states]));
    assert_eq!(rows[0].len(), 5);
    assert!((at(&rows[0], "M0_0") - 0.7).abs() < 1e-12 && (at(&rows[0], "g0") + 9.81).abs() < 1e-12);
}

#[test]
fn what_is_no_table_of_states_is_refused() {
    let refuse = |states: &str| {
        let files = files(ARM, states);
        refused(&["dynamics", text(&files.robot), "--states", text(&files.states)])
    };
    assert!(refuse("q0,q1,w0\n0,0,0\n").contains("give the names q0, q1"));
    assert!(refuse("q0,q2\n0,0\n").contains("each list whole"));
    assert!(refuse("q0,q1,q2\n0,0,0\n").contains("the robot has 2 independent joints (shoulder, elbow)"));
    assert!(refuse("q0,q1\n0,zero\n").contains("`zero` is not a number"));
    assert!(refuse("q0,q1\n0,inf\n").contains("line 2: column `q1`: `inf` is too large"));
    assert!(refuse("q0,q1\n0\n").contains("states.csv"));
    assert!(refuse("q0,q1,v0\n0,0,1\n").contains("velocity: 1 numbers are given, the robot has 2"));
    let files = files(ARM, "q0,q1\n0,0\n");
    let ends = ["--base", "lower", "--tip", "upper"];
    let reported = refused(&[&["dynamics", text(&files.robot), "--states", text(&files.states)][..], &ends].concat());
    assert!(reported.contains("link `lower` is not above link `upper`"), "{reported}");
    let gravity = ["dynamics", text(&files.robot), "--states", text(&files.states), "--gravity", "0,1"];
    let usage = run(&gravity);
    assert!(usage.code == 2 && usage.err.contains("three finite numbers"), "{}", usage.err);
}

/// The planar two-link arm of textbooks, and its files.
#[test]
fn polynomials_are_printed_written_and_proved_again() {
    let folder = tempdir().unwrap();
    let (arm, out) = (folder.path().join("arm.urdf"), folder.path().join("out"));
    fs::write(&arm, ARM).unwrap();
    let [arm, out_text] = [text(&arm), text(&out)];
    let reported = succeed(&["dynamics", "--symbolic", arm, "--numbers"]);
    // Both rods have 0.7 kg m^2 about their joints, and 2 kg at a distance of one metre: Spong, Hutchinson and
    // Vidyasagar as above.
    assert!(reported.contains("\nM11 = 2*c2 + 17/5\n") && reported.contains("\nM21 = c2 + 7/10\n"), "{reported}");
    assert!(reported.contains("\nC21 = v1*s2\n"), "{reported}");
    let latex = succeed(&["dynamics", "--symbolic", arm, "--latex"]);
    assert!(latex.contains("M_{22} = \\mathit{Iyy}_{2}") && latex.ends_with("\\end{document}\n"), "{latex}");
    let printed = succeed(&["dynamics", "--symbolic", arm, "--numbers", "-o", out_text]);
    assert!(printed.contains("2 joints") && printed.contains("proved"), "{printed}");
    assert!(succeed(&["check", out_text]).contains("M' - 2 C is skew"));
    // The inertial parameters are those of the description.
    let robot = out.join("0_robot.urdf");
    fs::write(&robot, ARM.replacen("mass value=\"2\"", "mass value=\"3\"", 1)).unwrap();
    assert!(run(&["check", out_text]).err.contains("mass parameters differ"));
    fs::write(&robot, ARM).unwrap();
    let file = out.join("7_dynamics.txt");
    fs::write(&file, fs::read_to_string(&file).unwrap().replace("M22 = 7/10", "M22 = 7/9")).unwrap();
    let ran = run(&["check", out_text]);
    assert!(ran.code == 1 && ran.err.contains("`M22` differs from that of the chain"), "{}", ran.err);
    let chain = super::root("derivations/scara");
    assert!(refused(&["dynamics", "--symbolic", text(&chain), "--numbers"]).contains("has no masses"));
    assert!(refused(&["dynamics", "--symbolic", "nao_v5", "-o", out_text]).contains("several leaf links"));
}

#[test]
fn code_is_printed_in_both_languages() {
    let files = files(ARM, "q0\n0\n");
    let robot = text(&files.robot);
    let rust = succeed(&["dynamics", robot, "--lang", "rust", "--functions", "gravity,inertia"]);
    assert!(rust.contains("pub fn gravity(q: &[f64; COORDINATES]) -> Row {") && !rust.contains("fn inverse"), "{rust}");
    let c = files.robot.with_file_name("arm_dynamics.c");
    assert_eq!(succeed(&["dynamics", robot, "--lang", "c", "-o", text(&c)]), "");
    let header = fs::read_to_string(c.with_extension("h")).unwrap();
    assert!(
        header
            .contains("void arm_inverse(const gb_real q[2], const gb_real v[2], const gb_real a[2], gb_real out[2]);")
    );
    assert!(fs::read_to_string(&c).unwrap().contains("#include \"arm_dynamics.h\""));
    fs::write(&c, "somebody's\n").unwrap();
    assert!(refused(&["dynamics", robot, "--lang", "c", "-o", text(&c)]).contains("groebot did not write it"));
    assert!(refused(&["dynamics", robot, "--lang", "c"]).contains("give the name of the source file"));
}
