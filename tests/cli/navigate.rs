//! `groebot path` and `groebot navigate`.

use std::fs;

use groebot::motion::Trajectory;
use serde_json::Value;
use tempfile::tempdir;

use super::{refused, run, succeed, text};

const ROOM: &str =
    "size = [3.0, 2.0]\nwall = 0.05\n[[furniture]]\nname = \"wall\"\nbox = [0.1, 1.2]\nat = [1.5, 0.6]\n";

#[test]
fn paths_are_reported_as_text_json_and_csv() {
    let folder = tempdir().unwrap();
    let [room, out] = ["room.toml", "way.csv"].map(|name| folder.path().join(name));
    fs::write(&room, ROOM).unwrap();
    let requested = ["path", text(&room), "--start", "0.5,0.5", "--goal", "2.5,0.5"];
    let with = |more: &[&'static str]| [&requested[..], more].concat();
    let reported = succeed(&[&requested[..], &["-o", text(&out)]].concat());
    // The path over both upper corners of the wall, at (1.45, 1.2) and (1.55, 1.2).
    let length = 2.0 * 0.95f64.hypot(0.7) + 0.1;
    assert!(reported.contains(&format!("path of {length:.4} m, proved to be the shortest, 4 points")), "{reported}");
    assert_eq!(fs::read_to_string(&out).unwrap().lines().count(), 5);
    let json = |more: &[&'static str]| -> Value { serde_json::from_str(&succeed(&with(more))).unwrap() };
    let exact = json(&["--json"]);
    assert!(
        (exact["length"].as_f64().unwrap() - length).abs() < 1e-12 && exact["points"].as_array().unwrap().len() == 4
    );
    assert_eq!(exact["length"], exact["lower_bound"]);
    for method in ["fmm", "m3r", "octile"] {
        let found = json(&["--json", "--method", method]);
        assert!(
            found["method"] == method && found["length"].as_f64().unwrap() > length && found["lower_bound"].is_null()
        );
        let taut = json(&["--json", "--method", method, "--taut"]);
        assert!((taut["length"].as_f64().unwrap() - length).abs() < 0.06, "{taut}");
    }
    let grown = json(&["--json", "--radius", "0.2"]);
    assert!(grown["length"].as_f64().unwrap() > length + 0.1);
    let smooth = json(&["--json", "--radius", "0.2", "--smooth", "0.1"]);
    assert!(smooth["points"].as_array().unwrap().len() > 20);
    // The wall is removed.
    assert!(succeed(&with(&["--furniture", "wall=none"])).contains("path of 2.0000 m"));
    assert!(succeed(&with(&["--furniture", "wall=1.5,1.4"])).contains("path of 2.0000 m"));
}

#[test]
fn every_point_of_a_path_keeps_the_radius() {
    let folder = tempdir().unwrap();
    let [room, out] = ["room.toml", "path.csv"].map(|name| folder.path().join(name));
    fs::write(&room, ROOM).unwrap();
    let (radius, cell) = (0.2, 0.05);
    for method in ["exact", "fmm", "m3r", "octile"] {
        let requested = ["path", text(&room), "--start", "0.5,0.5", "--goal", "2.5,0.5", "--method", method];
        succeed(&[&requested[..], &["--radius", "0.2", "-o", text(&out), "--force"]].concat());
        let content = fs::read_to_string(&out).unwrap();
        let corners: Vec<[f64; 2]> = content
            .lines()
            .skip(1)
            .map(|line| line.split(',').map(|number| number.parse().unwrap()).collect::<Vec<f64>>().try_into().unwrap())
            .collect();
        // The wall covers x 1.45..1.55 m and y up to 1.2 m.
        let away = |[x, y]: [f64; 2]| ((1.45 - x).max(x - 1.55).max(0.0)).hypot((y - 1.2).max(0.0));
        let mut least = f64::INFINITY;
        for ends in corners.windows(2) {
            for share in (0..=1000).map(|share| f64::from(share) / 1000.0) {
                least = least.min(away([0, 1].map(|axis| ends[0][axis] + share * (ends[1][axis] - ends[0][axis]))));
            }
        }
        assert!(least >= radius - 1e-9, "{method}: {least}");
        if method == "exact" {
            // The shortest path is not farther away than the cells' diagonals.
            assert!(least <= radius + 2.0 * cell * std::f64::consts::SQRT_2, "{least}");
        }
    }
}

#[test]
fn the_quickest_path_is_reported_where_speeds_differ() {
    let folder = tempdir().unwrap();
    let room = folder.path().join("room.toml");
    fs::write(&room, "size = [2, 2]\n[[slow]]\nname = \"mud\"\nbox = [2, 1]\nat = [1, 0.5]\nspeed = 0.5\n").unwrap();
    let reported = succeed(&["path", text(&room), "--start", "0.5,0.2", "--goal", "1.5,1.8", "--json"]);
    let reported: Value = serde_json::from_str(&reported).unwrap();
    // Snell's law: the minimum over the crossing point of the times of both segments.
    let time = |x: f64| 2.0 * (x - 0.5).hypot(0.8) + (1.5 - x).hypot(0.8);
    let least = (0..=100_000).map(|x| time(0.5 + 1e-5 * f64::from(x))).fold(f64::INFINITY, f64::min);
    assert!((reported["seconds"].as_f64().unwrap() / least - 1.0).abs() < 1e-4, "{reported} {least}");
    assert!(reported["lower_bound"].as_f64().unwrap() <= least);
}

#[test]
fn where_there_is_no_path_the_exit_status_is_four() {
    let folder = tempdir().unwrap();
    let room = folder.path().join("room.txt");
    fs::write(&room, "#######\n#..#..#\n#..#..#\n#######\n").unwrap();
    for method in ["exact", "fmm", "m3r", "octile"] {
        let requested = ["path", text(&room), "--start", "0.1,0.1", "--goal", "0.28,0.1", "--json", "--method", method];
        let output = run(&requested);
        assert_eq!(output.code, 4, "{}", output.err);
        let reported: Value = serde_json::from_str(&output.out).unwrap();
        assert!(reported["points"].is_null() && reported["enclosure"].as_array().unwrap().len() == 4, "{reported}");
    }
    let requested =
        ["navigate", "rh0", "--map", text(&room), "--start", "1,1", "--goal", "3.5,1", "--resolution", "0.6"];
    let plot = folder.path().join("plan.svg");
    let output = run(&[&requested[..], &["--json", "--plot", text(&plot)]].concat());
    assert_eq!(output.code, 4, "{}", output.err);
    assert!(output.err.contains("there is no path: "), "{}", output.err);
    // The two cells on that side with space for a body, or one of them and its part that is nearer to the walls.
    let reported: Value = serde_json::from_str(&output.out).unwrap();
    let cells = reported["enclosure"].as_array().unwrap();
    assert!(reported["points"].is_null() && !cells.is_empty() && cells.len() <= 4, "{reported}");
    assert!(cells.iter().all(|at| at[0].as_f64().unwrap() < 1.8 || at[0].as_f64().unwrap() > 2.4), "{reported}");
    let drawn = fs::read_to_string(&plot).unwrap();
    assert!(drawn.contains("no path from (1.00, 1.00) to (3.50, 1.00)") && drawn.contains("class=\"closed\""));
}

#[test]
fn a_humanoid_walks_over_a_map() {
    let folder = tempdir().unwrap();
    let [room, csv, svg] = ["room.toml", "walk.csv", "plan.svg"].map(|name| folder.path().join(name));
    fs::write(&room, ROOM).unwrap();
    let goal = ["--start", "0.5,0.5,90", "--goal", "0.9,1.3,0"];
    let requested = [&["navigate", "rh0", "--map", text(&room)][..], &goal, &["-o", text(&csv), "--plot", text(&svg)]];
    let reported = succeed(&requested.concat());
    for word in ["rh0: ", "steps by preview control", "least margin", "course", "steps refused", "planned in"] {
        assert!(reported.contains(word), "{word}: {reported}");
    }
    let walk = Trajectory::read_csv(&csv).unwrap();
    let last = |name: &str| {
        let contact = walk.contacts.iter().find(|contact| contact.name == name).unwrap();
        contact.poses[contact.poses.len() - 1].translation.vector
    };
    let middle = (last("left") + last("right")) / 2.0;
    assert!((middle.x - 0.9).abs() < 2e-3 && (middle.y - 1.3).abs() < 2e-3, "{middle}");
    assert!(fs::read_to_string(&svg).unwrap().contains("too near for the body"));
    let reported: Value = serde_json::from_str(&succeed(&[&requested.concat()[..], &["--json"]].concat())).unwrap();
    assert_eq!(
        (&reported["robot"], &reported["method"], &reported["clear_at_every_heading"]),
        (&"rh0".into(), &"exact".into(), &true.into())
    );
    assert_eq!(
        (&reported["rests_between_steps"], reported["notes"].as_array().unwrap().len()),
        (&false.into(), 0),
        "{reported}"
    );
    let steps = reported["steps"].as_array().unwrap();
    let end = |foot: &str| steps.iter().rfind(|step| step["foot"] == foot).unwrap();
    let middle = (end("left")["x"].as_f64().unwrap() + end("right")["x"].as_f64().unwrap()) / 2.0;
    assert!((middle - 0.9).abs() < 2e-3 && reported["margin"].as_f64().unwrap() > 0.0);
    assert!((reported["length"].as_f64().unwrap() - 0.4f64.hypot(0.8)).abs() < 1e-9);
    let seconds = walk.times[walk.times.len() - 1];
    assert!((reported["seconds"].as_f64().unwrap() - seconds).abs() < 0.05, "{} {seconds}", reported["seconds"]);
}

/// Any description with two legs: they are derived by the command. The size of its body is that of its shapes, or
/// given.
#[test]
fn a_robot_from_a_file_walks_over_a_map() {
    let folder = tempdir().unwrap();
    let [urdf, room] = ["robot.urdf", "room.toml"].map(|name| folder.path().join(name));
    succeed(&["export", "teo", "--format", "urdf", "-o", text(&urdf)]);
    fs::write(&room, ROOM).unwrap();
    let soles = ["--left", "l_sole", "--right", "r_sole", "--start", "0.5,0.6,80", "--goal", "0.6,1.1"];
    let requested = [&["navigate", text(&urdf), "--map", text(&room)][..], &soles].concat();
    let reported = succeed(&requested);
    assert!(
        reported.contains("steps by preview control") && reported.contains("course          0.510 m"),
        "{reported}"
    );
    let reported = succeed(&[&requested[..], &["--gait", "osg"]].concat());
    assert!(reported.contains("steps by one step goal") && reported.contains("course          0.510 m"), "{reported}");
    let reported = succeed(&[&requested[..], &["--body", "0.2,0.4", "--crouched", "--apart", "0.05"]].concat());
    assert!(reported.contains("course          0.510 m"), "{reported}");
    assert!(refused(&[&requested[..], &["--body", "0.2"]].concat()).contains("--body takes two numbers"));
}

#[test]
fn bad_input_of_paths_is_refused() {
    let folder = tempdir().unwrap();
    let [room, walls] = ["room.toml", "walls.txt"].map(|name| folder.path().join(name));
    fs::write(&room, ROOM).unwrap();
    fs::write(&walls, "...\n.#.\n...\n").unwrap();
    let path = |more: &[&str]| refused(&[&["path", text(&room), "--start", "0.5,0.5"][..], more].concat());
    for (more, words) in [
        (&["--goal", "1.5,0.5"][..], "(1.5, 0.5) is occupied; the nearest free place is (1.425, 0.475)"),
        (&["--goal", "9,9"], "(9, 9) is not on the map"),
        (&["--goal", "1"], "--goal takes two numbers"),
        (&["--goal", "2.5,0.5", "--radius", "-1"], "a radius of -1 m"),
        (&["--goal", "2.5,0.5", "--smooth", "0"], "a radius of 0 m"),
        (&["--goal", "2.5,0.5", "--furniture", "walls=none"], "did you mean `wall`"),
        (&["--goal", "2.5,0.5", "--furniture", "wall"], "give NAME=X,Y"),
        (&["--goal", "2.5,0.5", "--method", "potential"], "a local minimum at ("),
    ] {
        let reported = path(more);
        assert!(reported.contains(words), "{words}: {reported}");
    }
    let reported = refused(&["path", text(&walls), "--start", "0,0", "--goal", "0.1,0.1", "--furniture", "a=none"]);
    assert!(reported.contains("--furniture needs a room"), "{reported}");
    let reported = refused(&["navigate", "nao", "--map", text(&room), "--start", "1.5,0.5", "--goal", "0.5,0.5"]);
    assert!(reported.contains("the nearest free place is ("), "{reported}");
    let reported = refused(&["navigate", "nao", "--map", text(&room), "--start", "0.5", "--goal", "0.5,0.5"]);
    assert!(reported.contains("--start takes two or three numbers"), "{reported}");
}
