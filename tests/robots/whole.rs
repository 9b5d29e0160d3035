//! NAO as a whole, against the figures of its documentation.

use groebot::ErrorKind;
use groebot::robots::{Whole, nao_v5};

#[test]
fn nao_has_24_joints_and_weighs_what_its_documentation_says() {
    let nao = nao_v5();
    assert_eq!(nao.links.len(), 24);
    let mass: f64 = nao.base.mass + nao.links.iter().map(|link| link.weight.unwrap().mass).sum::<f64>();
    assert!((mass - 5.305).abs() < 5e-4, "{mass}");
    let names: Vec<&str> = nao.links.iter().map(|link| link.joint.as_str()).collect();
    assert_eq!(names[..3], ["HeadYaw", "HeadPitch", "LShoulderPitch"]);
    assert_eq!(nao.shared, [(nao.joint("LHipYawPitch").unwrap(), nao.joint("RHipYawPitch").unwrap())]);
}

/// Masses and centres of mass are mirrored, inertias nearly so: the maker measured both sides of its drawings.
#[test]
fn left_and_right_are_mirror_images() {
    let nao = nao_v5();
    for link in nao.links.iter().filter(|link| link.joint.starts_with('L')) {
        let other = &nao.links[nao.joint(&link.joint.replacen('L', "R", 1)).unwrap()];
        let (a, b) = (link.weight.unwrap(), other.weight.unwrap());
        assert_eq!((a.mass, a.centre.x, a.centre.z), (b.mass, b.centre.x, b.centre.z), "{}", link.name);
        assert_eq!(a.centre.y, -b.centre.y, "{}", link.name);
        assert_eq!(link.speed, other.speed);
    }
    let [left, right] = nao.soles;
    assert_eq!(left.measured[0], right.measured[0]);
    assert_eq!(left.measured[1], (-right.measured[1].1, -right.measured[1].0));
    let size = |(low, high): (f64, f64)| high - low;
    assert!((size(left.seed[0]) - 0.16).abs() < 1e-15 && (size(left.seed[1]) - 0.09).abs() < 1e-15, "NAO 6.8");
}

#[test]
fn mistakes_in_a_file_are_told_with_their_line() {
    let text = include_str!("../../src/robots/whole/nao_v5.toml");
    let refused = [
        (text.replacen("speed = 8.26797", "speeds = 8.26797", 1), ErrorKind::UnknownKey),
        (text.replacen("joint = \"HeadPitch\"", "joint = \"HeadRoll\"", 1), ErrorKind::UnknownName),
        (text.replacen("chain = \"nao_head\"", "chain = \"nao_tail\"", 1), ErrorKind::UnknownName),
        (text.replacen("limb = \"nao_left_leg\"", "limb = \"nao_tail\"", 1), ErrorKind::UnknownName),
        (text.replacen("\"LHipYawPitch\"", "\"LHipYaw\"", 1), ErrorKind::UnknownName),
        (text.replacen("[[sole]]", "[[shoe]]", 1), ErrorKind::UnknownKey),
    ];
    for (text, kind) in refused {
        let error = Whole::from_toml(&text).unwrap_err();
        assert_eq!(error.kind(), kind, "{error}");
        assert!(error.place().line.is_some(), "{error}");
    }
}
