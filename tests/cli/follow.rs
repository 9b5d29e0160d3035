//! `groebot follow`.

use std::fs;

use groebot::motion::Trajectory;
use groebot::robots;
use tempfile::tempdir;

use super::{refused, succeed, text};

/// Poses of UR5's tip on a quarter circle about its base.
fn poses(with_time: bool) -> String {
    let chain = robots::ur5();
    let mut table = if with_time { "time,x,y,z,qx,qy,qz,qw\n" } else { "x,y,z,qx,qy,qz,qw\n" }.to_owned();
    for k in 0..20 {
        let pose = chain.forward(&[0.08 * f64::from(k), -1.2, 1.4, -0.5, 1.0, -0.7]).unwrap();
        let (p, q) = (pose.translation.vector, pose.rotation.coords);
        if with_time {
            table += &format!("{},", 0.1 * f64::from(k));
        }
        table += &format!("{},{},{},{},{},{},{}\n", p.x, p.y, p.z, q.x, q.y, q.z, q.w);
    }
    table
}

#[test]
fn an_arm_follows_poses() {
    let folder = tempdir().unwrap();
    let [input, csv, json] = ["poses.csv", "path.csv", "path.json"].map(|name| folder.path().join(name));
    for (with_time, step) in [(true, 0.1), (false, 1.0)] {
        fs::write(&input, poses(with_time)).unwrap();
        let reported = succeed(&["follow", "derivations/ur5", "--poses", text(&input), "-o", text(&csv)]);
        succeed(&["follow", "derivations/ur5", "--poses", text(&input), "-o", text(&json), "--quiet"]);
        assert_eq!(reported, "ur5: 20 poses, without a jump\n");
        let path = Trajectory::read_csv(&csv).unwrap();
        assert!((path.times[19] - 19.0 * step).abs() < 1e-9);
        assert!(path.q.windows(2).all(|pair| (pair[1][0] - pair[0][0] - 0.08).abs() < 1e-8));
        let again = Trajectory::from_json(&fs::read_to_string(&json).unwrap()).unwrap();
        assert!(again.times.iter().zip(&path.times).all(|(a, b)| (a - b).abs() < 1e-9));
    }
}

#[test]
fn a_jump_is_reported_or_refused() {
    let folder = tempdir().unwrap();
    let [input, out] = ["poses.csv", "path.csv"].map(|name| folder.path().join(name));
    let mut rows: Vec<String> = poses(false).lines().map(str::to_owned).collect();
    rows.drain(3..17);
    fs::write(&input, rows.join("\n")).unwrap();
    let all = ["follow", "derivations/ur5", "--poses", text(&input), "-o", text(&out)];
    let reported = succeed(&all);
    assert!(reported.starts_with("ur5: 6 poses, one jump\n  pose 3: "), "{reported}");
    fs::remove_file(&out).unwrap();
    assert!(refused(&[&all[..], &["--strict"]].concat()).contains("must jump at pose 3"));
    assert!(!out.exists());
    for (text_of, words) in [
        ("x,y,z\n1,2,3\n", "`qx` is missing"),
        ("1,2,3,0,0,0,2\n", "the length 2"),
        ("9,9,9,0,0,0,1\n", "pose 1: it is out of reach"),
        ("0,1,2,3,0,0,0,1\n1,2,3,0,0,0,1\n", "some rows have a time"),
        ("", "there is no pose"),
    ] {
        fs::write(&input, text_of).unwrap();
        let reported = refused(&all);
        assert!(reported.contains(words) && reported.contains(text(&input)), "{reported}");
    }
    assert!(refused(&["follow", "derivations/ur5", "--poses", "/nowhere.csv"]).contains("/nowhere.csv"));
}
