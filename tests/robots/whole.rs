//! NAO as a whole, against the figures of its documentation.

use groebot::ErrorKind;
use groebot::robots::{self, Whole, nao_v5, rh0, teo};
use groebot::spatial::Pose;

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

/// RH0's data in the thesis' axes, turned into ours, against the chains of its legs, which lead from the foot to the trunk.
#[test]
fn rh0_as_a_whole_is_its_legs() {
    let whole = rh0();
    assert!(whole.is_point_mass && whole.links.iter().all(|link| link.weight.is_none()));
    assert_eq!(whole.links.len(), 21, "the joints of RH0 3.4.1");
    let mut symbols: Vec<u32> = whole.links.iter().map(|link| link.symbol.parse().unwrap()).collect();
    symbols.sort();
    assert_eq!(symbols, (1..=21).collect::<Vec<_>>());
    assert!(whole.links.iter().all(|link| (link.speed - 25.0 * std::f64::consts::TAU / 60.0).abs() < 1e-9), "25 rpm");
    let q = [0.1, -0.2, 0.5, -0.4, 0.15, 0.3];
    for (chain, sole) in [(robots::rh0_left_leg(), whole.soles[0]), (robots::rh0_right_leg(), whole.soles[1])] {
        let limb = whole.limbs.iter().find(|limb| limb.chain == chain.name()).unwrap();
        // The trunk seen from S, by the chain; S seen from the trunk, by the links of the whole.
        let root_from_tip = chain.forward(&q).unwrap();
        let mut value = vec![0.0; whole.links.len()];
        for (joint, q) in limb.joints.iter().zip(q) {
            value[*joint] = q;
        }
        let mut path: Vec<usize> = limb.joints.clone();
        path.sort();
        let moved = path.iter().fold(Pose::identity(), |pose, link| pose * whole.links[*link].screw.exp(value[*link]));
        let base_from_root = moved * limb.base_from_root;
        let expected = limb.base_from_tip * root_from_tip.inverse();
        assert!((base_from_root.to_homogeneous() - expected.to_homogeneous()).amax() < 1e-12, "{}", chain.name());
        let at = sole.base_from_sole.translation.vector;
        let side = if chain.name() == "rh0_left_leg" { 1.0 } else { -1.0 };
        assert!((at - nalgebra::Vector3::new(0.0, side * 0.112, -0.6765)).norm() < 1e-15, "{at}");
    }
}

/// TEO's legs: the left one as its chain, the right one as the maker's table of the right leg has it.
#[test]
fn teo_as_a_whole_is_its_legs() {
    let whole = teo();
    let mass: f64 = whole.base.mass + whole.links.iter().map(|link| link.weight.unwrap().mass).sum::<f64>();
    assert!((mass - 55.9).abs() < 1e-3, "the sum of the maker's table: {mass}");
    let chain = robots::teo_leg();
    let q = [0.1, -0.2, 0.5, -0.4, 0.15, 0.3];
    let tip = |mirrored: bool, q: &[f64]| {
        let limb = whole.limbs.iter().find(|limb| limb.mirrored == mirrored).unwrap();
        let moved =
            limb.joints.iter().zip(q).fold(Pose::identity(), |pose, (link, q)| pose * whole.links[*link].screw.exp(*q));
        moved * limb.base_from_tip
    };
    let left = tip(false, &q);
    assert!((left.to_homogeneous() - chain.forward(&q).unwrap().to_homogeneous()).amax() < 1e-12);
    // Pitches keep their sense in the mirror, yaw and rolls turn round.
    let right = tip(true, &[-q[0], -q[1], q[2], q[3], q[4], -q[5]]);
    let mirror = nalgebra::Matrix4::from_diagonal(&nalgebra::Vector4::new(1.0, -1.0, 1.0, 1.0));
    assert!((right.to_homogeneous() - mirror * left.to_homogeneous() * mirror).amax() < 1e-12);
}
