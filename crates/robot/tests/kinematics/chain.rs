//! Chains built by hand: the same validation as for files.

use groebot_robot::ErrorKind;
use groebot_robot::kinematics::{
    Chain, ChainParts, Choice, ExactMatrix, Joint, JointKind, LengthUnit, Plane, Root, Task, Tip, along_z,
};

use super::{documented_example, exact};

fn rotation(rows: [[&str; 3]; 3]) -> ExactMatrix {
    rows.map(|row| row.map(exact))
}

fn parts() -> ChainParts {
    let joint = |name: &str, symbol: &str, kind, axis: [&str; 3]| Joint {
        mimic: None,
        name: name.into(),
        symbol: symbol.into(),
        kind,
        axis: axis.map(exact),
        point: ["0", "0", "1/3"].map(exact),
        limits: Some((-1.0, 1.5)),
    };
    ChainParts {
        name: "swing and slide".into(),
        description: None,
        source: None,
        length_unit: LengthUnit::Metre,
        joints: vec![
            joint("swing", "1", JointKind::Revolute, ["0", "-2", "0"]),
            joint("slide", "x", JointKind::Prismatic, ["3", "0", "4"]),
        ],
        tip: Tip {
            point: ["0.5", "0", "0.1029"].map(exact),
            rotation: rotation([["3/5", "-4/5", "0"], ["4/5", "3/5", "0"], ["0", "0", "1"]]),
        },
        task: Task::PlanarPosition { plane: Plane::Xz },
        direction: along_z(),
        given: Vec::new(),
        order: Some(["dx", "c1", "s1"].map(String::from).to_vec()),
        meant: None,
        choice: Some(Choice { unknown: "dx".into(), root: Root::Plus }),
    }
}

#[test]
fn a_chain_gives_back_its_parts() {
    let chain = Chain::new(parts()).unwrap();
    assert_eq!(chain.parts(), &parts());
    assert_eq!(chain.unknowns(), ["c1", "s1", "dx"]);
    assert_eq!(chain.name(), "swing and slide");
    assert_eq!(chain.order().unwrap(), ["dx", "c1", "s1"]);
    assert_eq!(chain.choice().unwrap().root, Root::Plus);
    assert_eq!(chain.joints()[1].axis, ["3", "0", "4"].map(exact));
}

#[test]
fn a_chain_survives_json() {
    let chain = Chain::new(parts()).unwrap();
    let json = serde_json::to_string(&chain).unwrap();
    assert!(json.contains("\"1029/10000\""), "{json}");
    assert_eq!(serde_json::from_str::<Chain>(&json).unwrap(), chain);
    let zero = json.replace("[\"0\",\"-2\",\"0\"]", "[\"0\",\"0\",\"0\"]");
    assert!(serde_json::from_str::<Chain>(&zero).unwrap_err().to_string().contains("no direction"));
    assert!(serde_json::from_str::<Chain>(&json.replace("1029/10000", "nan")).is_err());
}

#[test]
fn the_table_shows_what_matters() {
    let shown = Chain::from_toml(&documented_example()).unwrap().to_string();
    for part in ["nao_leg_sagittal", "planar_position in xz", "mm", "c3 s3", "KneePitch", "-88.00..27.73", "2029/10"] {
        assert!(shown.contains(part), "`{part}` is not in:\n{shown}");
    }
    assert_eq!(shown.lines().count(), 4);
}

#[test]
fn a_chain_takes_another_task() {
    let direction = ["1", "0", "-1/2"].map(exact);
    let chain = Chain::new(parts()).unwrap();
    let ray = chain.with_task(Task::Ray, direction.clone(), vec!["slide".into()]).unwrap();
    assert_eq!((ray.task(), ray.direction(), ray.given()), (Task::Ray, &direction, vec![1]));
    assert_eq!((ray.joints(), ray.tip()), (chain.joints(), chain.tip()));
    assert!(ray.to_string().contains("ray of [1, 0, -1/2], slide given"), "{ray}");
    let json = serde_json::to_string(&ray).unwrap();
    assert_eq!(serde_json::from_str::<Chain>(&json).unwrap(), ray);
    assert!((ray.aim().into_inner() * 5f64.sqrt() - nalgebra::Vector3::new(2.0, 0.0, -1.0)).norm() < 1e-15);
}

#[test]
fn every_fault_is_refused() {
    type Break = fn(&mut ChainParts);
    let cases: [(Break, ErrorKind, &str); 26] = [
        (|p| p.name = " ".into(), ErrorKind::BadValue, "chain's name"),
        (|p| p.name = "a\u{1b}[31m".into(), ErrorKind::BadValue, "chain's name"),
        (|p| p.source = Some("\0".into()), ErrorKind::BadValue, "`source`"),
        (|p| p.joints.clear(), ErrorKind::BadValue, "0 joints; give 1 to 12"),
        (|p| p.joints = vec![p.joints[0].clone(); 13], ErrorKind::BadValue, "13 joints"),
        (|p| p.joints[1].name = String::new(), ErrorKind::BadValue, "not a name"),
        (|p| p.joints[1].name = "swing".into(), ErrorKind::DuplicateName, "joint `swing`"),
        (|p| p.joints[1].symbol = "1".into(), ErrorKind::DuplicateName, "joint `swing` has the symbol"),
        (|p| p.joints[1].symbol = "a_b".into(), ErrorKind::BadValue, "letters and digits"),
        (|p| p.joints[1].symbol = "1".repeat(17), ErrorKind::BadValue, "1 to 16"),
        (|p| p.joints[0].axis = ["0"; 3].map(exact), ErrorKind::BadValue, "joint `swing`: axis [0, 0, 0]"),
        (|p| p.joints[0].point[1] = exact("1e13"), ErrorKind::BadValue, "10^12"),
        (|p| p.joints[0].limits = Some((f64::NAN, 1.0)), ErrorKind::BadValue, "not finite"),
        (|p| p.joints[0].limits = Some((0.0, f64::INFINITY)), ErrorKind::BadValue, "not finite"),
        (|p| p.joints[0].limits = Some((1.0, -1.0)), ErrorKind::BadValue, "inverted"),
        (|p| p.joints[0].axis[0] = exact("0.5"), ErrorKind::BadValue, "parallel to y"),
        (|p| p.joints[1].axis[1] = exact("1"), ErrorKind::BadValue, "must have y = 0"),
        (|p| p.tip.point[0] = exact("-1e13"), ErrorKind::BadValue, "tip is beyond 10^12"),
        (|p| p.tip.rotation[2][2] = exact("-1"), ErrorKind::BadValue, "not a rotation"),
        (|p| p.tip.rotation[0][0] = exact("0.6000001"), ErrorKind::BadValue, "not a rotation"),
        (|p| p.order.as_mut().unwrap().push("dx".into()), ErrorKind::DuplicateName, "is given twice"),
        (|p| p.direction = ["0"; 3].map(exact), ErrorKind::BadValue, "direction is [0, 0, 0]"),
        (|p| p.given = vec!["swong".into()], ErrorKind::UnknownName, "`swing`"),
        (|p| p.given = vec!["swing".into(); 2], ErrorKind::DuplicateName, "is given twice"),
        (|p| p.given = vec!["slide".into(), "swing".into()], ErrorKind::BadValue, "every joint is given"),
        (|p| p.choice.as_mut().unwrap().unknown = "d1".into(), ErrorKind::UnknownName, "`c1`, `s1`, `dx`"),
    ];
    for (damage, kind, word) in cases {
        let mut parts = parts();
        damage(&mut parts);
        crate::errors::assert_error(&Chain::new(parts).unwrap_err(), kind, None, word);
    }
}
