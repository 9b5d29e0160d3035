//! `groebot plan`: the steps as text, for robots by name and for files.

use std::fs;

use tempfile::tempdir;

use super::{refused, root, succeed, text};

/// The order of RH0 A.2, (A-18)-(A-26).
#[test]
fn the_plan_of_the_thesis_for_puma() {
    let page = succeed(&["plan", "puma"]);
    let steps: Vec<&str> = page.lines().filter(|line| line.contains(" for theta")).collect();
    for (step, end) in steps.iter().zip([
        "PK3 for theta3 (2 values)",
        "PK2 for theta1, theta2 (2 values)",
        "PK2 for theta4, theta5 (2 values)",
        "PK1 for theta6 (1 value)",
    ]) {
        assert!(step.ends_with(end), "{page}");
    }
    assert!(steps.len() == 4 && page.ends_with("at most 2 x 2 x 2 x 1 = 8 solutions\n"), "{page}");
    assert!(steps[0].contains("where axes 4, 5, 6 meet") && steps[0].contains("where axes 1, 2 meet"), "{page}");
}

#[test]
fn a_file_or_a_chain_of_a_urdf() {
    let leg = root("derivations/nao_leg_sagittal");
    assert!(succeed(&["plan", text(&leg)]).contains("PG4 for theta1, theta2"));
    let robot = root("tests/corpus/urdf/ur5.urdf");
    assert!(succeed(&["plan", text(&robot)]).contains("8 solutions"));
}

#[test]
fn what_cannot_be_planned_is_refused() {
    assert!(refused(&["plan", "nosuch"]).contains("no robot is called `nosuch`"));
    let arm = root("derivations/nao_arm_planar");
    assert!(refused(&["plan", text(&arm)]).contains("needs a chain"));
    let folder = tempdir().unwrap();
    let file = folder.path().join("chain.toml");
    let joint = |n: i64| {
        let (axis, point) = ([1, n, n * n], [n * n % 7, 3 * n % 5, n]);
        format!("[[joint]]\nname = \"j{n}\"\ntype = \"revolute\"\naxis = {axis:?}\npoint = {point:?}\n")
    };
    let joints: String = (1..=6).map(joint).collect();
    let head = "name = \"general\"\ntask = { kind = \"pose\" }\ntip = { point = [1, 2, 3] }\n";
    fs::write(&file, format!("{head}{joints}")).unwrap();
    assert!(refused(&["plan", text(&file)]).contains("no order of the known subproblems"));
    let seven: String = (1..=7).map(joint).collect();
    fs::write(&file, format!("{head}{seven}")).unwrap();
    assert!(refused(&["plan", text(&file)]).contains("its 7 joints for the task `pose, j7 given`"));
}
