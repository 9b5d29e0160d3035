//! Commands in pipes: `fk`, `ik` and `solve` read each other's output, and descriptions are read from standard input.

use std::collections::BTreeMap;
use std::fs;

use serde_json::Value;
use tempfile::tempdir;

use super::{Ran, refused, root, run_on, succeed, text};

fn derivation(name: &str) -> String {
    text(&root("derivations").join(name)).to_owned()
}

fn urdf(name: &str) -> String {
    text(&root("tests/corpus/urdf").join(name)).to_owned()
}

/// The output of a command for `input`.
fn pipe(arguments: &[&str], input: &str) -> String {
    let ran = run_on(arguments, input.as_bytes());
    assert_eq!((ran.code, ran.err.as_str()), (0, ""), "{arguments:?}: {input}");
    ran.out
}

/// The rows of a table by column name, without columns that are not numeric.
fn table(text: &str) -> Vec<BTreeMap<String, f64>> {
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let row = |line: &str| {
        let cells = names.iter().zip(line.split(','));
        cells.filter_map(|(name, cell)| Some(((*name).to_owned(), cell.parse().ok()?))).collect()
    };
    lines.map(row).collect()
}

/// Joint values through `fk`, then `solve` or `ik`, then `fk`: each solution has the pose of the joint values. `solve` and `ik` also read their own output.
fn assert_comes_back(name: &str, q: &str, solutions: usize) {
    let folder = derivation(name);
    for units in [&[][..], &["--degrees"]] {
        let with = |command| [&[command, folder.as_str()], units].concat();
        let poses = pipe(&with("fk"), &format!("{q}\n"));
        for command in ["solve", "ik"] {
            let answers = pipe(&with(command), &poses);
            assert_eq!(answers.lines().count(), 1 + solutions, "{name} {command}: {answers}");
            // The header has the units, so the last command works without --degrees.
            let back = table(&pipe(&["fk", &folder], &answers));
            let begun = &table(&poses)[0];
            let places = begun.iter().filter(|(column, _)| ["x_", "y_", "z_"].contains(&&column[..2]));
            for (column, value) in places {
                assert!(
                    back.iter().all(|row| (row[column] - value).abs() < 1e-9 * (1.0 + value.abs())),
                    "{name} {column}"
                );
            }
            for again in ["solve", "ik"] {
                let rows = pipe(&with(again), &answers).lines().count();
                assert_eq!(rows, 1 + solutions * solutions, "{name}: {command} | {again}, one target a row");
            }
        }
    }
}

#[test]
fn poses_come_back() {
    assert_comes_back("scara", "0.3,0.8,0.05,0.4", 2);
    assert_comes_back("gantry", "0.1,0.2,0.3,0.4,0.5,0.6", 2);
}

#[test]
fn other_tasks_come_back() {
    assert_comes_back("nao_head", "0.3,0.2", 2);
    assert_comes_back("nao_leg_sagittal", "0.3,0.6", 2);
    assert_comes_back("planar_3r", "0.3,0.6,0.2", 2);
    assert_comes_back("upright_arm", "0.124,0.516,0.47,0.19,0.322", 2);
    assert_comes_back("wrist_rotation", "0.3,0.6,0.2", 2);
}

#[test]
fn given_joints_come_back() {
    assert_comes_back("planar_4r", "0.124,0.516,0.47,0.19", 2);
    assert_comes_back("nao_left_arm_position", "0.124,0.516,0.47,0.19", 4);
}

#[test]
fn units_of_columns_are_converted() {
    let leg = derivation("nao_leg_sagittal");
    let plain = pipe(&["solve", &leg], "px,pz\n60,150\n");
    assert_eq!(pipe(&["solve", &leg], "x_mm,z_mm\n60,150\n"), plain);
    assert_eq!(pipe(&["solve", &leg], "z_m,x_m\n0.150,0.060\n"), plain);
    assert_eq!(pipe(&["ik", &leg], "x_m,z_m\n0.060,0.150\n"), pipe(&["ik", &leg], "60,150\n"));
    let radians = table(&pipe(&["fk", &leg], "HipPitch_deg,KneePitch_rad\n90,0\n"));
    assert!((radians[0]["HipPitch"] - std::f64::consts::FRAC_PI_2).abs() < 1e-15, "{radians:?}");
    assert!((radians[0]["x_mm"] - 202.9).abs() < 1e-12, "thigh and tibia ahead: {radians:?}");
    // A column name with a unit that does not fit is not accepted.
    assert!(run_on(&["solve", &leg], b"x_deg,z_mm\n60,150\n").err.contains("`px` is missing"));
}

#[test]
fn unknown_columns_are_refused_by_name() {
    let leg = derivation("nao_leg_sagittal");
    let cases = [
        (&["solve", &leg][..], "px,pz,color\n60,150,3\n"),
        (&["ik", &leg], "px,pz,color\n60,150,3\n"),
        (&["fk", &leg], "HipPitch,KneePitch,color\n0.1,0.2,3\n"),
    ];
    for (arguments, input) in cases {
        let Ran { code, err, .. } = run_on(arguments, input.as_bytes());
        assert!(code == 1 && err.starts_with("error: <stdin>: line 1: the column `color` is not known"), "{err}");
    }
}

/// A target out of reach has no joint values: `fk` prints no pose for it, and the others are processed.
#[test]
fn a_target_without_a_solution_is_passed_over() {
    let leg = derivation("nao_leg_sagittal");
    let answers = pipe(&["solve", &leg], "60,150\n500,1\n-60,-150\n");
    assert_eq!(answers.lines().count(), 1 + 2 + 1 + 2);
    let back = table(&pipe(&["fk", &leg], &answers));
    let places: Vec<f64> = back.iter().map(|row| row["x_mm"].round()).collect();
    assert_eq!(places, [60.0, 60.0, -60.0, -60.0]);
}

#[test]
fn a_description_comes_from_standard_input() {
    let robot = fs::read_to_string(urdf("ur5.urdf")).unwrap();
    let chain = fs::read_to_string(root("derivations/planar_2r/0_chain.toml")).unwrap();
    let file = urdf("ur5.urdf");
    for arguments in [&["fk", "--q", "0,-1,1,0,0.5,0"][..], &["ik", "--q", "0,-1,1,0,0.5,0"], &["info"], &["plan"]] {
        let (command, rest) = arguments.split_first().unwrap();
        let piped = pipe(&[&[command, "-"], rest].concat(), &robot);
        assert_eq!(piped, succeed(&[&[command, file.as_str()], rest].concat()), "{command}");
    }
    let out = tempdir().unwrap();
    assert_eq!(pipe(&["derive", "-", "--quiet", "--out", text(out.path())], &chain), "");
    assert_eq!(fs::read_to_string(out.path().join("0_chain.toml")).unwrap(), chain);
    let target = ["--target", "0.2,0.1"];
    let program = fs::read_to_string(out.path().join("5_program.json")).unwrap();
    let solved = succeed(&[&["solve", text(out.path())], &target[..]].concat());
    assert_eq!(pipe(&[&["solve", "-"], &target[..]].concat(), &program), solved);
}

#[test]
fn standard_input_is_read_once() {
    let chain = fs::read_to_string(root("derivations/planar_2r/0_chain.toml")).unwrap();
    let refused_on = |arguments: &[&str], input: &str| {
        let ran = run_on(arguments, input.as_bytes());
        assert_eq!(ran.code, 1, "{}", ran.out);
        ran.err
    };
    for arguments in [&["fk", "-"][..], &["ik", "-"], &["fk", "-", "--q", "-"]] {
        assert!(refused_on(arguments, &chain).contains("standard input has the description"), "{arguments:?}");
    }
    assert!(refused_on(&["derive", "-"], &chain).contains("give one by --out"));
    assert!(refused_on(&["info", "-"], "").contains("<stdin>: standard input is empty"));
    let reported = refused_on(&["info", "-"], "<robot name='r'>\n<link name='a'/>\n<link name='a'/></robot>");
    assert!(reported.contains("<stdin>: line 3: link `a`: another link has this name"), "{reported}");
}

/// The default tip is reported in text and in JSON, and stored if the robot has other leaf links.
#[test]
fn the_default_tip_is_reported() {
    let folder = tempdir().unwrap();
    let file = folder.path().join("arm.urdf");
    let arm = fs::read_to_string(root("tests/corpus/urdf/three_joint_leg.urdf")).unwrap();
    fs::write(&file, arm.replace("\"foot\"", "\"robot_tool0\"")).unwrap();
    let (arm, note) = (text(&file), "tip link `robot_tool0`: the only tool0 link; --tip chooses another");
    let task = ["--task", "position"];
    let out = folder.path().join("out");
    let reported = succeed(&[&["derive", arm, "--out", text(&out)], &task[..]].concat());
    assert!(reported.starts_with(note), "{reported}");
    assert!(fs::read_to_string(out.join("0_task.toml")).unwrap().contains("tip = \"robot_tool0\""));
    let q = ["--q", "0.1,0.5,-1"];
    assert!(succeed(&[&["fk", arm], &q[..]].concat()).starts_with(note));
    assert!(succeed(&[&["ik", arm], &q[..], &task].concat()).starts_with(note));
    assert!(succeed(&[&["plan", arm], &task[..]].concat()).starts_with(note));
    assert!(succeed(&[&["info", arm], &task[..]].concat()).contains(note));
    assert!(succeed(&["dynamics", "--symbolic", arm]).starts_with(note));
    let tip = "Tip link `robot_tool0`: the only tool0 link; `--tip` chooses another.";
    assert!(succeed(&[&["explain", arm], &task[..]].concat()).contains(tip));
    let latex = ["dynamics", "--symbolic", arm, "--latex"];
    for command in [[&["explain", arm, "--latex"], &task[..]].concat(), latex.to_vec()] {
        assert!(succeed(&command).contains(" chooses another.\n"), "{command:?}");
    }
    // A derivation belongs to the tip link for which it was made.
    for command in [&["explain", text(&out)][..], &["explain", arm, "--tip", "robot_tool0", "--task", "position"]] {
        assert!(!succeed(command).contains("chooses another"), "{command:?}");
    }
    assert!(succeed(&["info", arm]).contains("--tip (default robot_tool0, the only tool0 link)"));
    for command in [
        [&["fk", arm, "--json"], &q[..]].concat(),
        [&["ik", arm, "--json"], &q[..], &task].concat(),
        [&["plan", arm, "--json"], &task[..]].concat(),
        [&["info", arm, "--json"], &task[..]].concat(),
        vec!["info", arm, "--json"],
    ] {
        let page: Value = serde_json::from_str(&succeed(&command)).unwrap();
        assert_eq!(page["tip_link"]["name"], "robot_tool0", "{command:?}");
        assert_eq!(page["tip_link"]["chosen_by"], "the only tool0 link", "{command:?}");
    }
    assert!(!succeed(&[&["fk", arm, "--tip", "robot_tool0"], &q[..]].concat()).contains("tip link"));
    let leg = refused(&[&["derive", &urdf("three_joint_leg.urdf")], &task[..]].concat());
    assert!(leg.contains("choose a tip link, such as `foot`\n"), "{leg}");
}

/// A given joint with the name of a coordinate: each has its own column.
#[test]
fn a_given_joint_may_have_the_name_of_a_number_of_the_task() {
    let chain = fs::read_to_string(root("derivations/nao_left_arm_position/0_chain.toml")).unwrap();
    let folder = tempdir().unwrap();
    let file = folder.path().join("chain.toml");
    fs::write(&file, chain.replace("ElbowYaw", "px")).unwrap();
    let poses = pipe(&["fk", text(&file)], "0.3,0.2,0.7,-0.6\n");
    let x = table(&poses)[0]["x_m"];
    let mut answers = pipe(&["ik", text(&file)], &poses);
    let own = pipe(&["ik", text(&file)], &format!("x_m,y_m,z_m,px\n{},0.7\n", cells(&poses, ["x_m", "y_m", "z_m"])));
    assert_eq!(own, answers);
    for _ in 0..2 {
        let rows: Vec<Vec<&str>> = answers.lines().map(|line| line.split(',').collect()).collect();
        let places: Vec<usize> = (0..rows[0].len()).filter(|place| rows[0][*place] == "px").collect();
        assert_eq!((places.len(), places[0], rows.len() > 1), (3, 1, true), "{answers}");
        for row in &rows[1..] {
            let [number, given, joint] = [0, 1, 2].map(|k| row[places[k]].parse::<f64>().unwrap());
            assert!((number - x).abs() < 1e-12 && given == 0.7 && (joint - 0.7).abs() < 1e-12, "{answers}");
        }
        answers = pipe(&["ik", text(&file)], &answers);
    }
}

/// The cells of the first row in these columns.
fn cells(table: &str, names: [&str; 3]) -> String {
    let rows: Vec<Vec<&str>> = table.lines().map(|line| line.split(',').collect()).collect();
    let cell = |name: &str| rows[1][rows[0].iter().position(|own| *own == name).unwrap()];
    names.map(cell).join(",")
}

/// Two joints of the upright arm have the names of numbers of its task.
#[test]
fn joints_with_the_names_of_numbers_are_told_from_them() {
    let folder = derivation("upright_arm");
    for units in [&[][..], &["--degrees"]] {
        let with = |command| [&[command, folder.as_str()], units].concat();
        let poses = pipe(&with("fk"), "0.124,0.516,0.47,0.19,0.322\n");
        let unit = if units.is_empty() { "rad" } else { "deg" };
        let pitch =
            cells(&poses, ["x_m", "y_m", "z_m"]) + "," + poses.lines().nth(1).unwrap().split(',').nth(13).unwrap();
        let header: Vec<&str> = poses.lines().next().unwrap().split(',').collect();
        assert_eq!((header[12], header[13]), (&*format!("roll_{unit}"), &*format!("pitch_{unit}")));
        let answers = pipe(&with("solve"), &poses);
        let first: Vec<&str> = answers.lines().nth(1).unwrap().split(',').collect();
        assert_eq!(first[1..5].join(","), pitch, "{answers}");
        assert_eq!(first[5], poses.lines().nth(1).unwrap().split(',').nth(12).unwrap());
    }
}
