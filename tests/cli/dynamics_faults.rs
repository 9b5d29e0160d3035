//! Robots and tables for which `groebot dynamics` once returned wrong results without an error. Expected values are those of Pinocchio 4.1.0, with mimic joints
//! added to their leaders, unless another source is given.

use std::fs;
use std::path::{Path, PathBuf};

use tempfile::{TempDir, tempdir};

use super::{refused, root, run, succeed, text};

fn corpus(name: &str) -> PathBuf {
    root("tests/corpus/dynamics/faults").join(name)
}

fn written(name: &str, content: &str) -> (TempDir, PathBuf) {
    let folder = tempdir().unwrap();
    let file = folder.path().join(name);
    fs::write(&file, content).unwrap();
    (folder, file)
}

/// The first row of the printed table, by name, and the notes.
fn first(robot: &Path, states: &str, more: &[&str]) -> (Vec<(String, String)>, String) {
    let (_folder, states) = written("states.csv", states);
    let ran = run(&[&["dynamics", text(robot), "--states", text(&states)], more].concat());
    assert_eq!(ran.code, 0, "{}", ran.err);
    let mut lines = ran.out.lines().map(|line| line.split(',').map(str::to_owned));
    let (names, cells) = (lines.next().unwrap(), lines.next().unwrap());
    (names.zip(cells).collect(), ran.err)
}

fn refuse(robot: &Path, states: &str, more: &[&str]) -> String {
    let (_folder, states) = written("states.csv", states);
    refused(&[&["dynamics", text(robot), "--states", text(&states)], more].concat())
}

fn near(row: &[(String, String)], expected: &[(&str, f64)]) {
    for (name, value) in expected {
        let cell = &row.iter().find(|(other, _)| other == name).unwrap_or_else(|| panic!("{name}")).1;
        let found: f64 = cell.parse().unwrap();
        assert!((found - value).abs() <= 1e-12 * value.abs().max(1.0), "{name}: {found} beside {value}");
    }
}

/// I + m c^2 + ratio^2 rotor = 0.1 + 2 * 0.25 + 2500 * 1e-4.
#[test]
fn rotors_of_transmissions_count() {
    let (row, _) = first(&corpus("rotor.urdf"), "q0\n0\n", &[]);
    near(&row, &[("M0_0", 0.85), ("g0", -9.81)]);
    // A fault of a transmission is reported with its actuator, and does not affect chains.
    let right = fs::read_to_string(corpus("rotor.urdf")).unwrap();
    for (from, to, words) in [
        ("value=\"50\"", "value=\"fifty\"", "`fifty` is not a number"),
        ("value=\"50\"", "value=\"1e200\"", "exceeds the range of doubles"),
        ("<joint name=\"j\"/>", "<joint name=\"k\"/>", "is not a joint of the robot"),
    ] {
        let (_folder, robot) = written("r.urdf", &right.replacen(from, to, 1));
        let reported = refuse(&robot, "q0\n0\n", &[]);
        assert!(
            reported.contains("actuator `m`") && reported.contains(words) && reported.contains("line 3"),
            "{reported}"
        );
        assert_eq!(run(&["fk", text(&robot), "--tip", "b", "--q", "0.5"]).code, 0);
    }
}

#[test]
fn followers_with_multiplier_zero_are_constant() {
    let robot = corpus("constant_follower.urdf");
    let expected = [("M0_0", 2.6210609940028853), ("g0", -19.232804175584153)];
    for states in ["q0\n0\n", "q:p\n0\n"] {
        near(&first(&robot, states, &[]).0, &expected);
    }
    assert!(refuse(&robot, "q0,q1\n0,0\n", &[]).contains("1 independent joints (p)"));
    let rust = succeed(&["dynamics", text(&robot), "--lang", "rust"]);
    assert!(rust.contains("COORDINATES: usize = 1;") && rust.contains("fn forward"), "{rust}");
    // As polynomials: the bent arm of two rods is one body.
    let reported = succeed(&["dynamics", "--symbolic", text(&robot), "--numbers", "--tip", "b"]);
    let inertia = reported.lines().find_map(|line| line.strip_prefix("M11 = ")).unwrap();
    let (top, bottom) = inertia.split_once('/').unwrap();
    let found = top.parse::<f64>().unwrap() / bottom.parse::<f64>().unwrap();
    assert!((found - expected[0].1).abs() < 1e-12, "{inertia}");
}

/// Joints at the root are held with a note. Others are refused, because their degrees of freedom would be missing.
#[test]
fn planar_and_floating_joints_are_reported() {
    let planar = fs::read_to_string(corpus("planar.urdf")).unwrap();
    for kind in ["planar", "floating"] {
        let at_root = planar.replace("\"planar\"", &format!("\"{kind}\""));
        let (_folder, robot) = written("r.urdf", &at_root);
        let (row, reported) = first(&robot, "q0\n0\n", &[]);
        assert!(reported.contains(&format!("joint `p` of the type `{kind}` is held at zero")), "{reported}");
        near(&row, &[("M0_0", 1.25)]);
        let above = "<link name=\"v\"/><joint name=\"turn\" type=\"continuous\"><parent link=\"v\"/><child link=\"w\"/></joint>";
        let (_folder, robot) =
            written("r.urdf", &at_root.replacen("<link name=\"w\"/>", &format!("<link name=\"w\"/>{above}"), 1));
        let reported = refuse(&robot, "q0,q1\n0,0\n", &[]);
        assert!(
            reported.contains("joint `p`")
                && reported.contains(kind)
                && reported.contains("several degrees of freedom"),
            "{reported}"
        );
        assert_eq!(run(&["dynamics", text(&robot), "--lang", "rust"]).code, 1);
        // Above the base the joint does not move.
        let (row, reported) = first(&robot, "q0\n0\n", &["--base", "a"]);
        assert_eq!(reported, "");
        near(&row, &[("M0_0", 1.25)]);
    }
}

#[test]
fn bodies_without_mass_have_all_but_accelerations() {
    let robot = corpus("massless_tip.urdf");
    let (row, reported) = first(&robot, "q0,q1\n0,0\n", &[]);
    near(&row, &[("M0_0", 0.35), ("M1_0", 0.0), ("M1_1", 0.0), ("tau0", -4.905), ("tau1", 0.0), ("g0", -4.905)]);
    let empty = |name: &str| row.iter().any(|(other, cell)| other == name && cell.is_empty());
    assert!(empty("qdd0") && empty("qdd1"), "{row:?}");
    assert!(
        reported.contains("qdd is empty in 1 of 1 rows") && reported.contains("link `b` of joint `j2`"),
        "{reported}"
    );
    let (_folder, states) = written("s.csv", "q0,q1\n0,0\n");
    let json = succeed(&["dynamics", text(&robot), "--states", text(&states), "--json"]);
    let report: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(report["states"][0]["qdd"], serde_json::json!([]));
    assert!(report["notes"][0].as_str().unwrap().contains("qdd is empty"));
    // A point mass on the axis of its joint has no inertia about it, except for rounding errors.
    let heavy = "<link name=\"b\"><inertial><origin xyz=\"0 0.3 0\"/><mass value=\"0.7\"/></inertial></link>";
    let slanted = fs::read_to_string(&robot).unwrap().replacen("<link name=\"b\"/>", heavy, 1).replacen(
        "<origin xyz=\"1 0 0\"/>",
        "<origin xyz=\"1 0.1 0.3\" rpy=\"0.3 0.2 0.7\"/>",
        1,
    );
    let (_folder, robot) = written("r.urdf", &slanted);
    // The option name of earlier versions.
    let (row, _) = first(&robot, "q0,q1\n0.4,0.9\n", &["--as-told"]);
    assert!(row.iter().all(|(name, cell)| !name.starts_with("qdd") || cell.is_empty()), "{row:?}");
    // The other functions are printed, and the file names the missing ones.
    let tip = corpus("massless_tip.urdf");
    let ran = run(&["dynamics", text(&tip), "--lang", "rust"]);
    assert!(ran.code == 0 && ran.err.contains("forward dynamics is omitted"), "{}", ran.err);
    assert!(ran.out.contains("fn inverse") && !ran.out.contains("fn forward") && ran.out.contains("omitted"));
    assert!(refused(&["dynamics", text(&tip), "--lang", "rust", "--functions", "forward"]).contains("give masses"));
}

#[test]
fn unit_axes_on_mounts_with_two_angles_have_polynomials() {
    let robot = corpus("two_angles.urdf");
    let folder = tempdir().unwrap();
    let out = folder.path().join("out");
    let printed = succeed(&["dynamics", "--symbolic", text(&robot), "--tip", "l2", "--numbers", "-o", text(&out)]);
    assert!(printed.contains("proved"), "{printed}");
    assert_eq!(run(&["check", text(&out)]).code, 0);
    // Both axes are parallel: the second link's inertia about its own axis, 0.03 + 0.1^2, is constant.
    let reported = fs::read_to_string(out.join("7_dynamics.txt")).unwrap();
    let entry = reported.lines().find_map(|line| line.strip_prefix("M22 = ")).unwrap();
    assert_eq!(entry, "1/25", "{entry}");
}

const NINE: [f64; 9] = [
    -2.508973586035653,
    0.3429724631106068,
    119.45689092018688,
    0.1570444054801351,
    -109.25742114327362,
    0.4547433247540718,
    -194.23056036328137,
    -70.44887053777352,
    -53.864161902344456,
];

#[test]
fn a_free_root_is_an_option_or_follows_from_the_columns() {
    let robot = corpus("seven_followers.urdf");
    let list = |name: &str, count: usize| (0..count).map(|at| format!("{name}{at}")).collect::<Vec<_>>().join(",");
    let place = "0,0,0,0,0,0,1,0.1,0.1,0.1";
    let bare = format!("{}\n{place}\n", list("q", 10));
    let reported = refuse(&robot, &bare, &[]);
    assert!(reported.contains("10 joints, all independent, or 3 independent joints of a free root"), "{reported}");
    assert!(reported.contains("give --floating, or name the joints"), "{reported}");
    let (row, reported) = first(&robot, &bare, &["--floating"]);
    assert_eq!(reported, "");
    near(
        &row,
        &[("M0_0", 12.0), ("M6_6", 102.86834919573565), ("g6", -193.80935836732078), ("g8", -53.58990127150631)],
    );
    // Nine velocities for ten coordinates: the root is free.
    let names = ["tau0", "tau1", "tau2", "tau3", "tau4", "tau5", "tau6", "tau7", "tau8"];
    let expected: Vec<(&str, f64)> = names.into_iter().zip(NINE).collect();
    let rates = ["0.1"; 9].join(",");
    let moving = format!("{},{}\n{place},{rates}\n", list("q", 10), list("v", 9));
    near(&first(&robot, &moving, &[]).0, &expected);
    // Columns by joint name, in another order than that of the description.
    let rates_of = "v:j1,v:j2,v:j0";
    let named =
        format!("q:j2,q:j1,q:j0,{},{},{rates_of}\n0.1,0.1,0.1,0,0,0,0,0,0,1,{rates}\n", list("q", 7), list("v", 6));
    near(&first(&robot, &named, &[]).0, &expected);
    // Each joint is reported separately.
    let all: Vec<String> = (0..10).map(|joint| format!("q:j{joint}")).collect();
    let (row, reported) = first(&robot, &format!("{}\n{}\n", all.join(","), ["0.1"; 10].join(",")), &[]);
    assert!(
        reported.contains("they are taken as independent: j3, j4") && row.iter().any(|(name, _)| name == "tau9"),
        "{reported}"
    );
    assert!(refuse(&robot, "q:j0,q:j1,q:elbow\n0,0,0\n", &[]).contains("3 independent joints (j0, j1, j2)"));
}

#[test]
fn negative_damping_and_empty_tables_are_refused() {
    let robot = fs::read_to_string(corpus("hinge.urdf")).unwrap();
    for (name, words) in
        [("damping", "damping is -0.01"), ("friction", "friction is -0.01"), ("armature", "rotor inertia is -0.01")]
    {
        let pushed = robot.replacen("<axis", &format!("<dynamics {name}=\"-0.01\"/><axis"), 1);
        let (_folder, pushed) = written("r.urdf", &pushed);
        let reported = refuse(&pushed, "q0\n0\n", &[]);
        assert!(
            reported.contains("joint `j1`") && reported.contains(words) && reported.contains("--as-given"),
            "{reported}"
        );
        assert_eq!(first(&pushed, "q0\n0\n", &["--as-given"]).1, "");
        let log = corpus("hinge_of_100_kg.csv");
        assert!(refused(&["identify", text(&pushed), text(&log)]).contains("nonnegative"));
    }
    assert!(refuse(&corpus("hinge.urdf"), "q0\n", &[]).contains("no row of numbers"));
}

/// 2.4e-35 kg m^2 for 1.3 kg, as in an iCub's head, is a zero with rounding errors of an exporter.
#[test]
fn dust_in_inertias_is_rounding() {
    let robot = |entry: &str| {
        let inertia = format!("ixx=\"0\" ixy=\"0\" ixz=\"{entry}\" iyy=\"0\" iyz=\"0\" izz=\"0\"");
        format!(
            "<robot name=\"r\"><link name=\"w\"/><link name=\"head\"><inertial><origin xyz=\"0.1 0 0\"/><mass value=\"1.33687\"/><inertia {inertia}/></inertial></link>\
             <joint name=\"neck\" type=\"continuous\"><parent link=\"w\"/><child link=\"head\"/><axis xyz=\"0 1 0\"/></joint></robot>"
        )
    };
    let (_folder, dusty) = written("r.urdf", &robot("2.40741e-35"));
    let (row, reported) = first(&dusty, "q0\n0\n", &[]);
    near(&row, &[("M0_0", 0.0133687)]);
    assert!(reported.contains("link `head`") && reported.contains("treated as a rounding error"), "{reported}");
    let (_folder, wrong) = written("r.urdf", &robot("2e-5"));
    let reported = refuse(&wrong, "q0\n0\n", &[]);
    assert!(
        reported.contains("physically impossible") && reported.contains("`--as-given` takes the numbers unchanged"),
        "{reported}"
    );
    near(&first(&wrong, "q0\n0\n", &["--as-given"]).0, &[("M0_0", 0.0133687)]);
}

/// The entries of a seven-joint arm with the numbers of its description have over 400,000 characters. They are read
/// again.
#[test]
fn long_polynomials_are_read_back() {
    let sum = |terms: usize| (0..terms).map(|at| format!("{at}*c1")).collect::<Vec<_>>().join(" + ");
    let folder = tempdir().unwrap();
    let (arm, out) = (corpus("hinge.urdf"), folder.path().join("out"));
    assert_eq!(run(&["dynamics", "--symbolic", text(&arm), "--tip", "l1", "--numbers", "-o", text(&out)]).code, 0);
    let file = out.join("7_dynamics.txt");
    let reported = fs::read_to_string(&file).unwrap();
    // The same polynomial as a long sum: an added term is subtracted again.
    let long = sum(40_000);
    assert!(long.len() > 400_000);
    let entry = reported.lines().find(|line| line.starts_with("N1 = ")).unwrap();
    fs::write(&file, reported.replacen(entry, &format!("{entry} + ({long}) - ({long})"), 1)).unwrap();
    let ran = run(&["check", text(&out)]);
    assert!(!ran.err.contains("bytes long"), "{}", ran.err);
}
