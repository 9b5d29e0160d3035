//! Imperfect descriptions: almost exact relations are reported and made exact; exact ones are unchanged.

use groebot_algebra::number::BigRational;
use groebot_robot::ErrorKind;
use groebot_robot::kinematics::ideal::RelationKind;
use groebot_robot::kinematics::{Chain, ChainParts, ExactRotation, ExactVector, Geometry, JointKind};
use groebot_robot::robots;
use proptest::prelude::*;

use crate::errors::assert_error;

/// ABB IRB 4600-60/2.05 from the manufacturer's data sheet: 0.175, 0.495, 0.900, 0.175, 0.960 and 0.135 m.
const IRB4600: &str =
    "name = 'irb4600'\ntask = { kind = 'pose' }\ntip = { point = [1.27, 0, 1.57], rpy_deg = [0, 90, 0] }
[[joint]]\nname = '1'\ntype = 'revolute'\naxis = [0, 0, 1]\npoint = [0, 0, 0]
[[joint]]\nname = '2'\ntype = 'revolute'\naxis = [0, 1, 0]\npoint = [0.175, 0, 0.495]
[[joint]]\nname = '3'\ntype = 'revolute'\naxis = [0, 1, 0]\npoint = [0.175, 0, 1.395]
[[joint]]\nname = '4'\ntype = 'revolute'\naxis = [1, 0, 0]\npoint = [0.175, 0, 1.57]
[[joint]]\nname = '5'\ntype = 'revolute'\naxis = [0, 1, 0]\npoint = [1.135, 0, 1.57]
[[joint]]\nname = '6'\ntype = 'revolute'\naxis = [1, 0, 0]\npoint = [1.135, 0, 1.57]";

fn irb4600() -> Chain {
    Chain::from_toml(IRB4600).unwrap()
}

/// `chain` with an error of at most `grain` / 10^7 in each coordinate of every axis and of every step between points.
fn rounded(chain: &Chain, noise: &[i64], grain: i64) -> Chain {
    let mut noise = noise.iter().cycle();
    let mut off = |vector: &ExactVector| -> ExactVector {
        vector.each_ref().map(|x| x + BigRational::new((noise.next().unwrap() % (grain + 1)).into(), 10_000_000.into()))
    };
    let mut parts = chain.parts().clone();
    let mut carried: ExactVector = Default::default();
    for joint in &mut parts.joints {
        joint.axis = off(&joint.axis);
        carried = off(&carried);
        joint.point = std::array::from_fn(|i| &joint.point[i] + &carried[i]);
    }
    parts.tip.point = std::array::from_fn(|i| &parts.tip.point[i] + &carried[i]);
    Chain::new(parts).unwrap()
}

/// `chain` on a base rotated by the quaternion `xyzw`.
fn turned(chain: &Chain, xyzw: [i64; 4]) -> Chain {
    let rotation = ExactRotation::from_quaternion(&xyzw.map(|x| BigRational::from_integer(x.into()))).unwrap();
    let mut parts: ChainParts = chain.parts().clone();
    for joint in &mut parts.joints {
        (joint.axis, joint.point) = (rotation.turn(&joint.axis), rotation.turn(&joint.point));
    }
    parts.tip.point = rotation.turn(&parts.tip.point);
    Chain::new(parts).unwrap()
}

/// No relation almost holds, and the same axes are parallel and intersect as in `exact`.
fn same_structure(ideal: &Chain, exact: &Chain) {
    let left = ideal.ideal_within(1e-2).unwrap().1;
    assert!(left.relations.is_empty(), "{}: {left}\n{ideal}", exact.name());
    let [ideal, exact] = [ideal, exact].map(Geometry::of);
    assert_eq!(ideal.parallel, exact.parallel);
    let joints =
        |geometry: &Geometry| geometry.meeting.iter().map(|meeting| meeting.joints.clone()).collect::<Vec<_>>();
    assert_eq!(joints(&ideal), joints(&exact));
    for (a, b) in ideal.neighbours.iter().zip(&exact.neighbours) {
        assert!((a.angle - b.angle).abs() < 1e-2);
    }
}

/// A tolerance of at least `length` metres.
fn shared(chain: &Chain, length: f64) -> f64 {
    let distance = chain.joints()[0].location().coords.norm();
    length / (chain.reach().max(0.1 * distance) * chain.length_unit().metres()).min(1.0)
}

/// The largest distance of the two tips, with all joints at `q`.
fn apart(a: &Chain, b: &Chain, q: f64) -> f64 {
    let [a, b] = [a, b].map(|chain| chain.forward(&vec![q; chain.joints().len()]).unwrap());
    (a.translation.vector - b.translation.vector).norm()
}

#[test]
fn an_exact_chain_is_not_changed() {
    for robot in robots::ALL {
        let chain = robot.chain();
        for tolerance in [0.0, 1e-9, 1e-5, 1e-3] {
            let (ideal, report) = chain.ideal_within(tolerance).unwrap();
            assert_eq!(ideal, chain, "{report}");
            assert!(report.is_empty() && report.relations.is_empty(), "{}: {report}", robot.name());
        }
    }
}

#[test]
fn almost_exact_relations_are_reported() {
    let text = IRB4600
        .replace("axis = [1, 0, 0]\npoint = [1.135, 0, 1.57]", "axis = [1, 0, 0]\npoint = [1.135, 0.00004, 1.57003]");
    let chain =
        Chain::from_toml(&text.replace(
            "axis = [0, 1, 0]\npoint = [0.175, 0, 1.395]",
            "axis = [0, 1, 0.00002]\npoint = [0.175, 0, 1.395]",
        ))
        .unwrap();
    let near = chain.ideal_within(1e-4).unwrap().1.relations;
    let reported: Vec<_> = near.iter().map(|near| (near.joints.clone(), near.kind)).collect();
    let expected = [(1..3, RelationKind::Parallel), (3..6, RelationKind::Meeting)];
    assert_eq!(reported, expected);
    assert!((near[0].by - 2e-5).abs() < 1e-14);
    // Axis 6 passes the intersection of axes 4 and 5 at 4e-5 m in y and 3e-5 m in z.
    assert!((near[1].by - 5e-5).abs() < 1e-14, "{}", near[1].by);
    let (ideal, report) = chain.ideal_within(1e-4).unwrap();
    same_structure(&ideal, &irb4600());
    for words in [
        "axes 2 and 3 are parallel; they are 2.0e-5 rad off",
        "axes 4 to 6 meet in one point; they miss it by 5.0e-5 m",
        "the axis of 6 is shifted by 5.0e-5 m",
    ] {
        assert!(report.to_string().contains(words), "{report}");
    }
    assert!(!report.to_string().contains("by 0.0e0"), "{report}");
}

/// An axis through the same point with another direction is not shifted; an axis with the same direction is not turned.
#[test]
fn only_what_differs_is_reported_of_an_axis() {
    let described = [
        (
            "axis = [0, 0, 1]\npoint = [0, 0, 0]",
            "axis = [0, 0.00002, 1]\npoint = [0, 0, 0]",
            "the axis of 1 is turned by 2.0e-5 rad",
        ),
        (
            "axis = [1, 0, 0]\npoint = [1.135, 0, 1.57]",
            "axis = [1, 0, 0]\npoint = [1.135, 0.00004, 1.57]",
            "the axis of 6 is shifted by 4.0e-5 m",
        ),
    ];
    for (exact, given, line) in described {
        assert!(IRB4600.contains(exact), "{exact}");
        let chain = Chain::from_toml(&IRB4600.replacen(exact, given, 1)).unwrap();
        let (_, report) = chain.ideal_within(1e-4).unwrap();
        assert!(report.lines().iter().any(|own| own == line), "{report}");
        assert!(!report.to_string().contains("by 0.0e0"), "{report}");
    }
}

#[test]
fn an_offset_beyond_the_tolerance_stays() {
    let chain = Chain::from_toml(&IRB4600.replace("point = [1.135, 0, 1.57]", "point = [1.135, 0, 1.5702]")).unwrap();
    let (ideal, report) = chain.ideal_within(5e-5).unwrap();
    assert!(ideal == chain && report.is_empty());
    let (ideal, _) = chain.ideal_within(1e-3).unwrap();
    same_structure(&ideal, &irb4600());
}

#[test]
fn a_tolerance_out_of_range_is_refused() {
    for tolerance in [-1e-9, 0.2, f64::NAN] {
        assert_error(&irb4600().ideal_within(tolerance).unwrap_err(), ErrorKind::BadValue, None, "0 to 0.1");
    }
}

proptest! {
    #![proptest_config(crate::cases(3))]

    /// Five decimals: an error of at most 5e-6 in each coordinate, so neighbours differ by less than 2e-5.
    #[test]
    fn five_decimals_are_the_exact_robot(noise in prop::collection::vec(-1000i64..1000, 53), xyzw in prop::array::uniform4(-9i64..10)) {
        prop_assume!(xyzw != [0; 4]);
        for exact in robots::ALL.iter().map(|robot| robot.chain()).chain([irb4600()]) {
            for exact in [turned(&exact, xyzw), exact] {
                let given = rounded(&exact, &noise, 50);
                let tolerance = shared(&exact, 3e-5);
                let (ideal, report) = given.ideal_within(tolerance).unwrap();
                same_structure(&ideal, &exact);
                prop_assert!(apart(&ideal, &given, 0.7) < 4e-4, "{}: {report}", exact.name());
                let again = ideal.ideal_within(tolerance).unwrap().0;
                prop_assert!(again == ideal, "{}: {again}\nis not\n{ideal}", exact.name());
            }
        }
    }

    /// A calibrated robot: an error of up to half a milliradian and half a millimetre for every axis.
    #[test]
    fn a_calibrated_robot_is_the_ideal_one(noise in prop::collection::vec(-100_000i64..100_000, 53)) {
        for exact in [irb4600(), robots::ur5(), robots::nao_left_leg(), robots::puma()] {
            let given = rounded(&exact, &noise, 5000);
            let (ideal, report) = given.ideal_within(shared(&exact, 3e-3)).unwrap();
            same_structure(&ideal, &exact);
            prop_assert!(apart(&ideal, &given, 0.7) < 4e-2, "{}: {report}", exact.name());
            for (ideal, exact) in ideal.joints().iter().zip(exact.joints()).filter(|(_, exact)| exact.kind == JointKind::Revolute) {
                prop_assert!((ideal.direction().into_inner() - exact.direction().into_inner()).norm() < 1e-15);
            }
        }
    }
}
