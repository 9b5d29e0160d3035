//! `groebot track` and `groebot identify`, run as by a user.

use std::fs;

use tempfile::tempdir;

use super::{refused, root, succeed, text};

#[test]
fn an_arm_follows_and_what_it_does_is_written() {
    let folder = tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let (trajectory, out, plot) = (at("t.csv"), at("out.csv"), at("p.svg"));
    let mut rows = "t,q0,q1,q2\n".to_owned();
    (0..=20).for_each(|k| {
        let time = 0.1 * f64::from(k);
        rows += &format!("{time},{},{},{}\n", 0.3 * time.sin(), 0.2 * time.cos(), 0.1 + 0.1 * time);
    });
    fs::write(&trajectory, &rows).unwrap();
    let robot = root("tests/corpus/dynamics/rrp.urdf");
    let [robot, trajectory, out_text, plot_text] = [text(&robot), text(&trajectory), text(&out), text(&plot)];
    let law = ["track", robot, "--law", "computed-torque", "--trajectory", trajectory, "--error", "0.02"];
    let reported = succeed(&[&law[..], &["-o", out_text, "--plot", plot_text]].concat());
    assert!(reported.starts_with("2000 steps") && reported.contains("slide"), "{reported}");
    let table = fs::read_to_string(&out).unwrap();
    assert!(table.starts_with("t,q0,q1,q2,v0,v1,v2,tau0,tau1,tau2,d0,d1,d2\n"));
    assert_eq!(table.lines().count(), 2002);
    let last: Vec<f64> = table.lines().last().unwrap().split(',').map(|word| word.parse().unwrap()).collect();
    (0..3).for_each(|joint| assert!((last[1 + joint] - last[10 + joint]).abs() < 1e-4, "{last:?}"));
    assert!(fs::read_to_string(&plot).unwrap().contains("errors: actual minus desired values"));
    let json: serde_json::Value = serde_json::from_str(&succeed(&[&law[..], &["--json"]].concat())).unwrap();
    assert_eq!(json["joints"][2]["name"], "slide");
    assert!((json["joints"][0]["greatest_error"].as_f64().unwrap() - 0.02).abs() < 1e-12);

    // A log of its motion determines its inertial parameters.
    let states = at("states.csv");
    let mut log = "q0,q1,q2,v0,v1,v2,a0,a1,a2\n".to_owned();
    for k in 1..60 {
        let x = |i: u32| (f64::from(k * i) * 0.7).sin();
        let words: Vec<String> = (1..=9).map(|i| format!("{:?}", 2.0 * x(i))).collect();
        log += &(words.join(",") + "\n");
    }
    fs::write(&states, &log).unwrap();
    let answers = succeed(&["dynamics", robot, "--states", text(&states)]);
    let torques = |line: &str| line.split(',').take(3).collect::<Vec<_>>().join(",");
    let whole: Vec<String> = log.lines().zip(answers.lines()).map(|(a, b)| format!("{a},{}", torques(b))).collect();
    let file = at("log.csv");
    fs::write(&file, whole.join("\n") + "\n").unwrap();
    let reported = succeed(&["identify", robot, text(&file)]);
    assert!(
        reported.contains("12 numbers")
            && reported.contains("1.800000e0  rod.m")
            && reported.contains("physically possible within the noise"),
        "{reported}"
    );
    assert!(refused(&["identify", robot, text(&states)]).contains("tau0.."));
}

#[test]
fn what_cannot_be_followed_is_refused() {
    let folder = tempdir().unwrap();
    let trajectory = folder.path().join("t.csv");
    let robot = root("tests/corpus/dynamics/ur5.urdf");
    let (robot, file) = (text(&robot), text(&trajectory));
    let law = |name: &'static str| vec!["track", robot, "--law", name, "--trajectory", file];
    let write = |rows: &str| fs::write(&trajectory, rows).unwrap();
    write("q0,q1,q2,q3,q4,q5\n0,0,0,0,0,0\n");
    assert!(refused(&law("open-loop")).contains("no column t"));
    write("t,q0,q1,q2,q3,q4,q5\n0,0,0,0,0,0,0\n0,0,0,0,0,0,0\n");
    assert!(refused(&law("open-loop")).contains("is not after"));
    write("t,q0\n0,0\n1,0\n");
    assert!(refused(&law("open-loop")).contains("6 independent joints"));
    write("t,q0,q1,q2,q3,q4,q5\n0,0,0,0,0,0,0\n1,0,0,0,0,0,0\n");
    let refusal = refused(&[&law("operational-space")[..], &["--link", "wrist_3_link"]].concat());
    assert!(refusal.contains("at 0.0000 s") && refusal.contains("singular"), "{refusal}");
    succeed(&[&law("operational-space")[..], &["--link", "wrist_3_link", "--damped", "0.02"]].concat());
    assert!(refused(&[&law("computed-torque")[..], &["--step", "0"]].concat()).contains("positive"));
}
