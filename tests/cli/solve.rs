//! `groebot solve`: text, JSON and CSV contain the same solutions, and these are correct.

use std::f64::consts::PI;
use std::io::{BufRead, BufReader, Write};

use serde_json::Value;

use super::{Ran, groebot, leg, root, run_on, succeed, text};
use crate::codegen::wrist;

/// Forward kinematics of the NAO leg, from its drawing: thigh 100 mm, tibia 102.9 mm.
fn ankle(q: &[f64]) -> [f64; 2] {
    let (hip, both) = (q[0], q[0] + q[1]);
    [100.0 * hip.sin() + 102.9 * both.sin(), 100.0 * hip.cos() + 102.9 * both.cos()]
}

fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}

fn json(target: &str, more: &[&str]) -> Value {
    let text = succeed(&[&["solve", leg().path(), "--json", "--target", target], more].concat());
    serde_json::from_str(&text).unwrap()
}

/// Runs `solve` on standard input.
fn stream(input: &str, more: &[&str]) -> Ran {
    run_on(&[&["solve", leg().path()], more].concat(), input.as_bytes())
}

#[test]
fn every_solution_reaches_its_target() {
    for (target, count) in [("60,150", 2), ("-60,-150", 2), ("100,0", 2), ("0,-120.5", 2), ("0,0", 0), ("500,1", 0)] {
        let answer = json(target, &[]);
        let solutions = answer["solutions"].as_array().unwrap();
        assert_eq!(solutions.len(), count, "{target}");
        assert_eq!(answer["settled"], true, "a leg of two joints takes few steps");
        let wanted = numbers(&answer["target"]);
        for solution in solutions {
            let reached = ankle(&numbers(&solution["q"]));
            let off = (reached[0] - wanted[0]).hypot(reached[1] - wanted[1]);
            assert!(off < 1e-10, "{target}: off by {off}");
            assert!(solution["residual"].as_f64().unwrap() < 1e-10 && solution["free"] == Value::Array(Vec::new()));
            assert_eq!(solution["settled"], true, "{target}");
        }
        let chosen: Vec<f64> = solutions
            .iter()
            .filter(|solution| solution["chosen"] == true)
            .map(|solution| numbers(&solution["q"])[0].sin())
            .collect();
        let least = solutions.iter().map(|solution| numbers(&solution["q"])[0].sin()).fold(f64::INFINITY, f64::min);
        assert!(count == 0 || chosen.iter().all(|s3| (s3 - least).abs() < 1e-9) && !chosen.is_empty(), "NAO (6.7.20)");
    }
}

#[test]
fn the_program_file_may_be_given_itself() {
    let file = format!("{}/5_program.json", leg().path());
    let by_file = succeed(&["solve", &file, "--target", "60,150"]);
    assert_eq!(by_file, succeed(&["solve", leg().path(), "--target", "60,150"]));
}

#[test]
fn text_shows_joints_units_and_the_choice() {
    let answer = json("60,150", &[]);
    assert_eq!(answer["format"], 2);
    let text = succeed(&["solve", leg().path(), "--target", "60,150", "--target", "0,0"]);
    assert!(text.contains("px = 60 mm, pz = 150 mm: 2 solutions") && text.contains("HipPitch"), "{text}");
    assert!(text.contains("px = 0 mm, pz = 0 mm: unreachable: no solution"), "{text}");
    for solution in answer["solutions"].as_array().unwrap() {
        let q = numbers(&solution["q"]);
        let line = text.lines().find(|line| line.contains(&format!("({:.9} rad)", q[0]))).unwrap();
        assert!(line.contains(&format!("{:.6} deg", q[1] * 180.0 / PI)), "{line}");
        assert_eq!(line.contains("the published choice"), solution["chosen"] == true, "{line}");
    }
}

/// NAO's elbow has limits of -88.5 and -2 degrees. Solutions with another angle are marked in every format.
#[test]
fn joints_outside_their_limits_are_named() {
    let folder = root("derivations/nao_left_arm");
    let target = "0.17648328015551007,0.07036101008144624,0.017430638031218543,\
                  0.8203490359957188,-0.5332414915294964,-0.20659373381662172";
    let page: Value = serde_json::from_str(&succeed(&["solve", text(&folder), "--json", "--target", target])).unwrap();
    let shown = succeed(&["solve", text(&folder), "--target", target]);
    let csv = run_on(&["solve", text(&folder)], format!("{target}\n").as_bytes()).out;
    let answers = page["solutions"].as_array().unwrap();
    assert!(answers.len() > 1, "{page}");
    for (answer, (line, row)) in answers.iter().zip(shown.lines().skip(2).zip(csv.lines().skip(1))) {
        let elbow = answer["q"][3].as_f64().unwrap().to_degrees();
        let names = answer["outside_limits"].as_array().unwrap();
        assert_eq!(names.contains(&Value::from("ElbowRoll")), !(-88.5..=-2.0).contains(&elbow), "{answer}");
        assert_eq!(line.contains("ElbowRoll outside its limits"), names.contains(&Value::from("ElbowRoll")), "{line}");
        let last = row.rsplit(',').next().unwrap();
        assert_eq!(
            last.split_whitespace().collect::<Vec<_>>(),
            names.iter().map(|n| n.as_str().unwrap()).collect::<Vec<_>>()
        );
    }
}

/// The shoulder of the PUMA 560 has limits of -45 and 225 degrees. Solutions in text, JSON and CSV are moved there by whole turns. The joint values 200, -100,
/// 30 degrees of shoulder, elbow and waist are within limits.
#[test]
fn angles_are_turned_into_their_limits() {
    let folder = root("derivations/puma560");
    let folder = text(&folder);
    let poses = run_on(&["fk", folder, "--degrees"], b"30,200,-100,20,40,50\n").out;
    let csv = run_on(&["solve", folder, "--degrees"], poses.as_bytes()).out;
    let rows: Vec<Vec<&str>> = csv.lines().map(|line| line.split(',').collect()).collect();
    let column = |name: &str| rows[0].iter().position(|cell| *cell == name).unwrap();
    let [shoulder, outside] = ["Shoulder_deg", "outside_limits"].map(column);
    let near = |cell: &str, value: f64| (cell.parse::<f64>().unwrap() - value).abs() < 1e-9;
    assert!(rows[1..].iter().any(|row| near(row[shoulder], 200.0)), "{csv}");
    for row in &rows[1..] {
        let is_within = (-45.0..=225.0).contains(&row[shoulder].parse::<f64>().unwrap());
        assert_eq!(is_within, !row[outside].split(' ').any(|name| name == "Shoulder"), "{csv}");
    }
    let target = rows[1][1..13].join(",");
    let page: Value = serde_json::from_str(&succeed(&["solve", folder, "--json", "--target", &target])).unwrap();
    let shoulders = page["solutions"].as_array().unwrap().iter().map(|found| found["q"][1].as_f64().unwrap());
    for (row, value) in rows[1..].iter().zip(shoulders) {
        assert!(near(row[shoulder], value.to_degrees()), "{page}");
    }
    let shown = succeed(&["solve", folder, "--target", &target]);
    assert!(shown.contains("200.000000 deg (3.490658504 rad)"), "{shown}");
}

#[test]
fn degrees_are_radians_in_degrees() {
    let (radians, degrees) = (json("60,150", &[]), json("60,150", &["--degrees"]));
    assert_eq!(degrees["unit"]["joints"][0], "deg");
    assert_eq!(radians["unit"]["joints"][0], "rad");
    for index in 0..2 {
        let solution = |answer: &Value| numbers(&answer["solutions"][index]["q"]);
        for (a, b) in solution(&radians).iter().zip(solution(&degrees)) {
            assert!((a / PI * 180.0 - b).abs() < 1e-12);
        }
    }
}

#[test]
fn csv_reports_what_json_reports_and_reads_its_own_output() {
    let ran = stream("60,150\n0,0\n -60 , -150 \n", &[]);
    assert_eq!((ran.code, ran.err.as_str()), (0, ""));
    let rows: Vec<Vec<&str>> = ran.out.lines().map(|line| line.split(',').collect()).collect();
    assert_eq!(rows[0][..5], ["target", "px", "pz", "solutions", "branch"]);
    assert_eq!(rows.len(), 1 + 2 + 1 + 2, "{}", ran.out);
    assert_eq!(rows[3], ["2", "0", "0", "0", "", "", "", "", "", "", "", ""]);
    let answer = json("60,150", &[]);
    for (row, solution) in rows[1..3].iter().zip(answer["solutions"].as_array().unwrap()) {
        let q: Vec<f64> = row[5..7].iter().map(|cell| cell.parse().unwrap()).collect();
        assert_eq!(q, numbers(&solution["q"]));
    }
    let again = stream(&ran.out, &[]);
    assert_eq!(again.code, 0, "{}", again.err);
    assert_eq!(again.out.lines().count(), 1 + 2 * 2 + 1 + 2 * 2, "one target a row");
}

#[test]
fn a_row_of_names_orders_the_columns() {
    let (named, plain) = (stream("pz,px\n150,60\n", &["--target", "-"]), stream("60,150\n", &[]));
    assert_eq!((named.code, named.out), (0, plain.out));
}

#[test]
fn lines_end_as_any_program_ends_them() {
    let plain = stream("px,pz\n60,150\n\n0,0\n", &[]);
    for text in [
        "px,pz\r\n60,150\r\n\r\n0,0\r\n",
        "px,pz\r60,150\r\r0,0\r",
        "px,pz\r60,150\r\r0,0",
        "\u{feff}px,pz\n60,150\r0,0\n",
    ] {
        let ran = stream(text, &[]);
        assert_eq!((ran.code, &ran.out), (0, &plain.out), "{text:?}: {}", ran.err);
    }
    let ran = stream("px,pz\r60,150\r\r\n60,x\r", &[]);
    assert!(ran.code == 1 && ran.err.starts_with("error: <stdin>: line 4: cell 2"), "{}", ran.err);
    let ran = stream(&"1".repeat(2_000_000), &[]);
    assert!(ran.code == 1 && ran.err.contains("line 1: the line is too long; at most 1000000 bytes"), "{}", ran.err);
}

#[test]
fn json_of_many_targets_is_one_object_a_line() {
    let ran = stream("60,150\n0,0\n", &["--json"]);
    let answers: Vec<Value> = ran.out.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let counts: Vec<usize> = answers.iter().map(|answer| answer["solutions"].as_array().unwrap().len()).collect();
    assert_eq!((ran.code, counts), (0, vec![2, 0]));
    assert_eq!(answers[0], json("60,150", &[]));
}

#[test]
fn a_bad_row_names_its_line() {
    let cases = [
        ("px,pz\n60,150\n60,x\n", "<stdin>: line 3: cell 2 (`pz`) is `x`"),
        ("60,150\n\n60\n", "<stdin>: line 3: 1 numbers given"),
        ("60,150\n1,NaN\n", "<stdin>: line 2: `pz` is NaN"),
        ("a,b\n1,2\n", "<stdin>: line 1: the first row"),
        (
            "px,pz,weight\n60,150,1\n",
            "<stdin>: line 1: the column `weight` is not known; allowed: px, pz; ignored: joints",
        ),
        ("px,px,pz\n60,60,150\n", "<stdin>: line 1: column 2 of the first row, `px`, is given twice"),
        ("px,pz\n60,150,1\n", "<stdin>: line 2: the row has 3 cells, and the first one 2 names"),
        ("1,x\n", "<stdin>: line 1: cell 2"),
        ("1,1e16\n", "<stdin>: line 1: cell 2 (`pz`) is `1e16`, which is too large; give at most 1e15"),
    ];
    for (input, words) in cases {
        let ran = stream(input, &[]);
        assert_eq!(ran.code, 1, "{input}");
        assert!(ran.err.starts_with(&format!("error: {words}")), "{}", ran.err);
    }
    assert_eq!(run_on(&["solve", leg().path()], &[b'1', b',', 0xff, b'\n']).code, 1);
}

#[test]
fn a_reader_that_goes_away_is_no_error() {
    let mut child = groebot(&["solve", leg().path()]).spawn().unwrap();
    let mut stdin = child.stdin.take().unwrap();
    let feeder = std::thread::spawn(move || {
        for _ in 0..50_000 {
            if stdin.write_all(b"60,150\n").is_err() {
                break;
            }
        }
    });
    let mut first = String::new();
    BufReader::new(child.stdout.take().unwrap()).read_line(&mut first).unwrap();
    assert!(first.starts_with("target,"));
    // The reader is dropped: the pipe is broken from here on.
    let output = child.wait_with_output().unwrap();
    feeder.join().unwrap();
    assert_eq!((output.status.code(), String::from_utf8(output.stderr).unwrap()), (Some(0), String::new()));
}

/// The folder of a gantry with a wrist, whose chain is in this file.
fn gantry() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("5_program.json"), wrist::carried().to_json()).unwrap();
    folder
}

/// A quarter turn about z maps x to y: q1 + q3 is a quarter turn, and the prismatic joints are the position.
#[test]
fn a_pose_is_twelve_numbers_or_seven() {
    let folder = gantry();
    let path = folder.path().to_str().unwrap();
    let half = 0.5_f64.sqrt();
    let seven = format!("0.1,0.2,0.3,0,0,{half},{half}");
    let text = succeed(&["solve", path, "--json", "--target", &seven]);
    let answer: Value = serde_json::from_str(&text).unwrap();
    let solutions = answer["solutions"].as_array().unwrap();
    assert_eq!((solutions.len(), solutions[0]["free"][0].as_str()), (1, Some("q1")), "{text}");
    let q = numbers(&solutions[0]["q"]);
    assert_eq!(q[..3], [0.1, 0.2, 0.3]);
    assert!((q[3] + q[5] - PI / 2.0).abs() < 1e-12 && q[4].abs() < 1e-12, "{q:?}");
    let twelve = "0.1,0.2,0.3,0,-1,0,1,0,0,0,0,1";
    let other: Value = serde_json::from_str(&succeed(&["solve", path, "--json", "--target", twelve])).unwrap();
    assert!((numbers(&other["solutions"][0]["q"])[5] - q[5]).abs() < 1e-12);
    let shown = succeed(&["solve", path, "--target", twelve]);
    assert!(shown.contains("q1 is free"), "{shown}");
}

#[test]
fn quaternions_in_csv_and_what_is_none() {
    let folder = gantry();
    let path = folder.path().to_str().unwrap();
    let named = run_on(&["solve", path], b"qw,qx,qy,qz,pz,py,px\n0,1,0,0,3,2,1\n");
    let plain = run_on(&["solve", path], b"1,2,3,1,0,0,0\n1,2,3,1,0,0,0,-1,0,0,0,-1\n");
    assert_eq!((named.code, plain.code), (0, 0), "{}{}", named.err, plain.err);
    let rows: Vec<&str> = plain.out.lines().collect();
    assert_eq!(named.out.lines().collect::<Vec<_>>(), rows[..2], "{}", plain.out);
    assert_eq!(rows[1].split_once(',').unwrap().1, rows[2].split_once(',').unwrap().1);
    for (input, words) in [
        ("1,2,3,1,0,0,1\n", "line 1: the quaternion `qx` to `qw` has length 1.414"),
        ("1,2,3,4\n", "line 1: 4 numbers given; give 12"),
        ("1,2,3,1,0,0,x\n", "line 1: cell 7 (`qw`) is `x`"),
        ("1,2,3,1,0,0,0,-1,0,0,0,1\n", "line 1: `r11` to `r33` are not a rotation matrix: the determinant is negative"),
    ] {
        let ran = run_on(&["solve", path], input.as_bytes());
        assert!(ran.code == 1 && ran.err.contains(words), "{}", ran.err);
    }
}

/// A planar arm of 0.3 m and 0.25 m with a hand of 0.1 m that a parallelogram rotates back: `hand` is 0.1 rad minus `elbow`.
const PALLETIZER: &str = r#"<robot name="pal"><link name="base"/><link name="upper"/><link name="fore"/><link name="hand"/><link name="tool0"/>
<joint name="shoulder" type="continuous"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/></joint>
<joint name="elbow" type="continuous"><parent link="upper"/><child link="fore"/><origin xyz="0.3 0 0"/><axis xyz="0 0 1"/></joint>
<joint name="back" type="continuous"><parent link="fore"/><child link="hand"/><origin xyz="0.25 0 0"/><axis xyz="0 0 1"/>
<mimic joint="elbow" multiplier="-1" offset="0.1"/></joint>
<joint name="end" type="fixed"><parent link="hand"/><child link="tool0"/><origin xyz="0.1 0 0"/></joint></robot>"#;

#[test]
fn joints_that_follow_others_are_marked() {
    let folder = tempfile::tempdir().unwrap();
    let (file, out) = (folder.path().join("pal.urdf"), folder.path().join("out"));
    std::fs::write(&file, PALLETIZER).unwrap();
    let [file, out] = [text(&file), text(&out)];
    let task = ["--task", "planar_position", "--plane", "xy"];
    let derive = [&["derive", file, "--out", out, "--json"], &task[..]].concat();
    let solve = ["solve", out, "--target", "0.3,0.35"];
    let ik = [&["ik", file, "--numeric", "--target", "0.3,0.35"], &task[..]].concat();
    let leaders = serde_json::json!([null, null, "elbow"]);
    let read = |arguments: &[&str]| -> Value { serde_json::from_str(&succeed(arguments)).unwrap() };
    assert_eq!(read(&derive)["mimics"], leaders);
    for arguments in [&solve[..], &ik] {
        let answer = read(&[arguments, &["--json"]].concat());
        assert_eq!(answer["mimics"], leaders);
        assert_eq!(answer["joints"], serde_json::json!(["shoulder", "elbow", "back"]));
        let solutions = answer["solutions"].as_array().unwrap();
        assert_eq!(solutions.len(), 2, "{answer}");
        for q in solutions.iter().map(|solution| numbers(&solution["q"])) {
            let off = (q[2] - (0.1 - q[1])) / (2.0 * PI);
            assert!((off - off.round()).abs() < 1e-9, "{q:?}");
        }
        let page = succeed(arguments);
        assert!(page.contains("\n  back follows -1 * elbow + 0.1\n"), "{page}");
    }
    // Without such joints there is no line about them.
    let page = succeed(&["solve", leg().path(), "--target", "60,150"]);
    assert!(!page.contains("follows") && json("60,150", &[]).get("mimics").is_none(), "{page}");
}
