//! `groebot walk`.

use std::fs;

use groebot::motion::Trajectory;
use tempfile::tempdir;

use super::{refused, run, succeed, text};

#[test]
fn eight_steps_are_written_as_csv_json_and_svg() {
    let folder = tempdir().unwrap();
    let [csv, json, svg] = ["walk.csv", "walk.json", "walk.svg"].map(|name| folder.path().join(name));
    let reported = succeed(&["walk", "nao", "--steps", "8", "-o", text(&csv), "--plot", text(&svg)]);
    succeed(&["walk", "nao", "--steps", "8", "-o", text(&json), "--quiet"]);
    for word in ["8 steps", "0.280 m", "least margin", "joint limits", "none had to be slowed down"] {
        assert!(reported.contains(word), "{word}: {reported}");
    }
    assert!(
        fs::read_to_string(&csv)
            .unwrap()
            .starts_with("# groebot trajectory 1\n# robot: nao_v5\ntime [s],q:HeadYaw [rad],")
    );
    let walk = Trajectory::read_csv(&csv).unwrap();
    let column = |name: &str| walk.joints.iter().position(|joint| joint.name == name).unwrap();
    let (left, right) = (column("LHipYawPitch"), column("RHipYawPitch"));
    for (row, q) in walk.q.iter().enumerate() {
        assert_eq!(walk.times[row], row as f64 / 100.0);
        assert_eq!(q[left], q[right]);
    }
    let margin = walk.figures.iter().find(|figure| figure.name == "margin").unwrap();
    assert!(margin.values.iter().all(|margin| *margin >= 0.01));
    let again = Trajectory::from_json(&fs::read_to_string(&json).unwrap()).unwrap();
    assert_eq!(again.times, walk.times);
    assert!(fs::read_to_string(&svg).unwrap().contains("zero moment point"));
}

/// The summary of a motion file has the keys and values of the report of `--json`, which is validated with the schema.
#[test]
fn a_motion_has_the_summary_that_is_reported() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("walk.json");
    for walk in [&["walk", "nao", "--steps", "2"][..], &["walk", "rh0", "--plan", "out right, in left"]] {
        let printed = succeed(&[walk, &["--json", "-o", text(&out)]].concat());
        let mut reported: serde_json::Value = serde_json::from_str(&printed).unwrap();
        for key in ["format", "notes"] {
            reported.as_object_mut().unwrap().remove(key).unwrap();
        }
        let motion: serde_json::Value = serde_json::from_str(&fs::read_to_string(&out).unwrap()).unwrap();
        assert_eq!((&motion["format"], &motion["walk"]["summary"]), (&2.into(), &reported));
    }
}

#[test]
fn turns_files_of_footsteps_and_preview_control_are_walked() {
    let reported = succeed(&["walk", "nao", "--length", "0", "--turn=-40", "--first", "right"]);
    assert!(reported.contains("turn -40.0 deg"), "{reported}");
    let reported = succeed(&["walk", "nao", "--gait", "preview"]);
    assert!(reported.contains("preview control") && reported.contains("8.4 cm/s"), "{reported}");
    let reported = succeed(&["walk", "nao", "--sole", "published", "--steps", "2"]);
    assert!(reported.contains("2 steps"), "{reported}");
    assert_eq!(succeed(&["walk", "nao", "--steps", "1", "--quiet"]), "");
    let folder = tempdir().unwrap();
    let (steps, out) = (folder.path().join("steps.csv"), folder.path().join("out.json"));
    fs::write(&steps, "foot,x,y,yaw\nleft,0.03,0.05,0.05\nright,0.05,-0.05,0.05\nleft,0.05,0.05,0.05\n").unwrap();
    assert!(succeed(&["walk", "nao", "--footsteps", text(&steps), "-o", text(&out)]).contains("3 steps"));
    let walk: serde_json::Value = serde_json::from_str(&fs::read_to_string(&out).unwrap()).unwrap();
    assert_eq!(walk["walk"]["steps"][2]["foot"], "left");
}

#[test]
fn what_cannot_be_walked_is_refused_and_writes_nothing() {
    let folder = tempdir().unwrap();
    let out = folder.path().join("walk.csv");
    let refusals = [
        (&["--hip-height", "0.3"][..], "out of reach"),
        (&["--amplitude", "0.01"], "the soles allow an amplitude of"),
        (&["--lift", "0.06"], "`LAnkleRoll`"),
        (&["--steps", "0"], "give 1 to 10000"),
        (&["--double-support", "1"], "between 0 and 1"),
        (&["--footsteps", "/nowhere.csv"], "/nowhere.csv"),
    ];
    for (arguments, word) in refusals {
        let mut all = vec!["walk", "nao", "-o", text(&out)];
        all.extend(arguments);
        let reported = refused(&all);
        assert!(reported.contains(word), "{word}: {reported}");
        assert!(!out.exists());
    }
    assert!(refused(&["walk", "teapot"]).contains("`nao`, `rh0` or `teo`"));
    for wrong in [&["walk"][..], &["walk", "nao", "--footsteps", "a.csv", "--steps", "3"]] {
        assert_eq!(run(wrong).code, 2, "{wrong:?}");
    }
}

#[test]
fn rh0_walks_in_words_and_in_the_thesis_columns() {
    let folder = tempdir().unwrap();
    let [csv, thesis, svg] = ["walk.csv", "thesis.csv", "walk.svg"].map(|name| folder.path().join(name));
    let plan = "out right, stride left, stride right, in left";
    let reported =
        succeed(&["walk", "rh0", "--plan", plan, "-o", text(&csv), "--thesis", text(&thesis), "--plot", text(&svg)]);
    for word in ["rh0: 4 steps", "17.50 s", "0.480 m", "a point at the trunk", "none had to be slowed down"] {
        assert!(reported.contains(word), "{word}: {reported}");
    }
    let table = fs::read_to_string(&thesis).unwrap();
    let header = table.lines().next().unwrap();
    assert!(header.starts_with("t,q1,q2,q3,q4,q5,q6,q12,q11,q10,q9,q8,q7,X_right_foot,"), "{header}");
    assert_eq!(table.lines().count(), 1 + 1 + 6 * 81);
    assert!(table.lines().nth(3).unwrap().starts_with("0.072,"));
    assert_eq!(Trajectory::read_csv(&csv).unwrap().times.len(), table.lines().count() - 1);
    assert!(fs::read_to_string(&svg).unwrap().contains("ankles, oblique view"));
    let reported = succeed(&["walk", "rh0", "--gait", "rh0-sim", "--plan", "turn left 90"]);
    assert!(
        reported.contains("12 steps")
            && reported.contains("34.99 s of them stepping")
            && reported.contains("turn 90.0 deg"),
        "{reported}"
    );
    let reported = succeed(&["walk", "rh0", "--gait", "rh0-real", "--crouched", "--plan", "turn right 20"]);
    assert!(reported.contains("4 steps") && reported.contains("turn -20.0 deg"), "{reported}");
}

#[test]
fn three_robots_walk_by_one_step_goal() {
    for arguments in [
        &["walk", "teo", "--goal", "0.3,0.1"][..],
        &["walk", "teo", "--plan", "out left, stride right, in left"],
        &["walk", "nao", "--gait", "osg", "--goal=0.1,-0.05"],
        &["walk", "rh0", "--gait", "osg", "--steps", "3"],
    ] {
        assert!(succeed(arguments).contains("by one step goal"), "{arguments:?}");
    }
    for (arguments, word) in [
        (&["walk", "nao", "--plan", "hop left"][..], "`hop left`"),
        (&["walk", "rh0", "--plan", "stride left"], "command 1"),
        (&["walk", "rh0", "--gait", "seed"], "give one of `rh0`, `rh0-sim`, `rh0-real`, `osg`"),
        (&["walk", "nao", "--dip", "0.01"], "--gait osg"),
        (&["walk", "teo", "--power", "2"], "--power is for RH0's laws"),
        (&["walk", "nao", "--steps", "1", "--thesis", "/nowhere/t.csv"], "its tables are for rh0"),
        (&["walk", "rh0", "--plan", "out left", "--length", "0.5"], "out of reach"),
        (&["walk", "teo", "--goal", "1"], "two or three numbers"),
    ] {
        let reported = refused(arguments);
        assert!(reported.contains(word), "{word}: {reported}");
    }
    assert!(refused(&["walk", "teapot"]).contains("`nao`, `rh0` or `teo`"));
    for wrong in [
        &["walk", "rh0", "--plan", "out left", "--steps", "3"][..],
        &["walk", "rh0", "--thesis", "t.csv", "--repair"],
        &["walk", "teo", "--goal", "1,0", "--plan", "in left"],
    ] {
        assert_eq!(run(wrong).code, 2, "{wrong:?}");
    }
}

/// The poses of the soles at the end of a walk, left and right: x, y and heading.
fn last_soles(file: &std::path::Path) -> [[f64; 3]; 2] {
    let walk = Trajectory::read_csv(file).unwrap();
    [0, 1].map(|side| {
        let sole = walk.contacts[side].poses[walk.times.len() - 1];
        [sole.translation.x, sole.translation.y, sole.rotation.euler_angles().2]
    })
}

#[test]
fn nao_walks_to_a_goal_without_further_options() {
    let folder = tempdir().unwrap();
    let [csv, svg] = ["goal.csv", "goal.svg"].map(|name| folder.path().join(name));
    let reported = succeed(&["walk", "nao", "--goal", "2,0", "-o", text(&csv), "--plot", text(&svg)]);
    for word in ["51 steps by the sine", "2.000 m, turn 0.0 deg", "none had to be slowed down"] {
        assert!(reported.contains(word), "{word}: {reported}");
    }
    let feet = last_soles(&csv).concat();
    for (value, wanted) in feet.iter().zip([2.0, 0.05, 0.0, 2.0, -0.05, 0.0]) {
        assert!((value - wanted).abs() < 1e-9, "{feet:?}");
    }
    // The picture, the summary and the table have the same smallest margin.
    let walk = Trajectory::read_csv(&csv).unwrap();
    let margin = walk.figures.iter().find(|figure| figure.name == "margin").unwrap();
    let least = format!("{:.1} mm at", 1e3 * margin.values.iter().copied().fold(f64::INFINITY, f64::min));
    assert!(reported.contains(&format!("least margin    {least}")), "{least}: {reported}");
    assert!(fs::read_to_string(&svg).unwrap().contains(&format!("least: {least}")), "{least}");
}

#[test]
fn every_gait_of_nao_reaches_goals_on_all_sides() {
    let folder = tempdir().unwrap();
    let csv = folder.path().join("goal.csv");
    for gait in ["sine", "preview", "osg"] {
        for (x, y) in [(0.3, 0.1), (0.0, -0.2), (-0.4, 0.05), (0.02, 0.0)] {
            let goal = format!("--goal={x},{y}");
            succeed(&["walk", "nao", "--gait", gait, &goal, "-o", text(&csv)]);
            let [[left_x, left_y, _], [right_x, right_y, _]] = last_soles(&csv);
            let miss = ((left_x + right_x) / 2.0 - x).hypot((left_y + right_y) / 2.0 - y);
            assert!(miss < 1e-3, "{gait} {goal}: {miss}");
        }
    }
}

#[test]
fn a_goal_that_is_refused_names_the_option_that_helps() {
    for (arguments, cause, option) in [
        (&["--goal", "2,0", "--max-turn", "0"][..], "error: the greatest turn of a step is 0", "--max-turn"),
        (&["--goal", "2,0", "--length", "0"], "error: the length of a step is 0", "--length"),
        (&["--goal", "0,1", "--half-width", "0.03"], "error: the feet come within", "--max-turn"),
        (&["--goal", "2,0", "--length", "0.15"], "error: the ", "--length"),
        (&["--goal", "100,0"], "error: the walk would last", "--goal"),
        (&["--goal", "nan,0"], "error: the goal is not finite", "--goal"),
        (&["--goal", "2,0", "--lift", "0.05"], "error: joint `", "--lift"),
    ] {
        let mut all = vec!["walk", "nao"];
        all.extend(arguments);
        let reported = refused(&all);
        assert!(reported.starts_with(cause) && reported.contains(option), "{arguments:?}: {reported}");
    }
    // A rotation in which the feet would touch is reduced.
    assert!(succeed(&["walk", "nao", "--goal", "0,1", "--max-turn", "15"]).contains("1.000 m, turn 97.7 deg"));
}

/// Torques are in both tables, and the largest ones are next to the effort limits.
#[test]
fn a_walk_has_joint_torques_and_floor_forces() {
    let folder = tempdir().unwrap();
    let [csv, json] = ["walk.csv", "walk.json"].map(|name| folder.path().join(name));
    let [csv_text, json_text] = [&csv, &json].map(|file| text(file));
    let ran = run(&["walk", "nao", "--steps", "2", "--torques", "-o", csv_text]);
    succeed(&["walk", "nao", "--steps", "2", "--torques", "-o", json_text, "--quiet"]);
    assert!(ran.code == 0 && ran.out.contains("greatest torques") && ran.out.contains("LKneePitch: "), "{}", ran.out);
    let head = fs::read_to_string(&csv).unwrap();
    assert!(head.lines().nth(2).unwrap().ends_with("right_my [N m],right_mz [N m]"));
    let reported: serde_json::Value = serde_json::from_str(&fs::read_to_string(&json).unwrap()).unwrap();
    let figures = reported["figures"].as_array().unwrap();
    assert!(figures.iter().any(|figure| figure["name"] == "tau:LKneePitch"));
    assert_eq!(reported["walk"]["steps"].as_array().unwrap().len(), 2);
}
