//! `sim::Comparison` with simulation results made by hand.

use groebot_humanoid::ErrorKind;
use groebot_humanoid::sim::{Comparison, Quantity};
use groebot_robot::motion::{Contact, Figure, JointTrack, Track, Trajectory};
use groebot_robot::spatial::Pose;
use nalgebra::{Point3, Translation3, UnitQuaternion, Vector3};

fn pose(x: f64, y: f64, yaw: f64) -> Pose {
    Pose::from_parts(Translation3::new(x, y, 0.0), UnitQuaternion::from_axis_angle(&Vector3::z_axis(), yaw))
}

/// Two feet 0.2 m apart. The left one steps from the first to the third sample, by `ahead` and with a turn. The zero moment point (ZMP) is at `aside` of the
/// right foot.
fn walk(ahead: f64, aside: f64, knee: f64, torque: f64) -> Trajectory {
    let contact = |name: &str, poses: [Pose; 3], stands: [bool; 3]| Contact {
        name: name.to_owned(),
        poses: poses.to_vec(),
        stands: stands.to_vec(),
    };
    let figure = |name: &str, unit: &str, values: [f64; 3]| Figure {
        name: name.to_owned(),
        unit: unit.to_owned(),
        values: values.to_vec(),
    };
    let joint = |name: &str| JointTrack { name: name.to_owned(), slides: false, limits: None, speed: None };
    Trajectory {
        robot: "two feet".to_owned(),
        joints: vec![joint("Knee"), joint("Neck")],
        times: vec![0.0, 0.1, 0.2],
        q: vec![vec![0.0, 0.3], vec![knee, 0.3], vec![0.1, 0.3]],
        base: vec![pose(0.0, 0.0, 0.0); 3],
        contacts: vec![
            contact(
                "left",
                [pose(0.0, 0.1, 0.0), pose(ahead / 2.0, 0.1, 0.0), pose(ahead, 0.1, 0.2)],
                [true, false, true],
            ),
            contact("right", [pose(0.0, -0.1, 0.0); 3], [true; 3]),
        ],
        points: vec![Track { name: "zmp".to_owned(), at: vec![Point3::new(0.0, -0.1 + aside, 0.0); 3] }],
        figures: vec![
            figure("tau:Knee", "N m", [0.0, torque, 0.0]),
            figure("tau:Neck", "N m", [0.0; 3]),
            figure("left_clearance", "m", [0.0, 0.02, 0.0]),
            figure("right_clearance", "m", [0.0; 3]),
        ],
    }
}

#[test]
fn an_answer_is_seen_beside_its_plan() {
    let (plan, answer) = (walk(0.2, 0.0, 0.5, 10.0), walk(0.16, 0.004, 0.48, 12.0));
    let compared = Comparison::of(&plan, &answer, |_| 500.0).unwrap();
    let near = |value: f64, wanted: f64| assert!((value - wanted).abs() < 1e-12, "{value} for {wanted}");
    assert_eq!(compared.joints.len(), 1, "the neck does not move");
    let knee = &compared.joints[0];
    near(knee.greatest, -0.02);
    near(knee.time, 0.1);
    near(knee.rms, (0.0004_f64 / 3.0).sqrt());
    near(knee.torque, 12.0);
    // 10 N m at a stiffness of 500 N m/rad.
    near(knee.sag.unwrap(), -0.02);
    near(knee.unpredicted.unwrap(), 0.0);
    near(compared.planned.ahead, 0.1);
    near(compared.walked.ahead, 0.08);
    near(compared.walked.turn, 0.1);
    near(compared.off(), 0.02);
    assert_eq!(compared.landings, [1, 1]);
    near(compared.lift, 0.02);
    // Relative to the left foot in the last sample, the planned ZMP is 0.2 m behind this foot, and the simulated one 0.16 m.
    assert!(compared.zmp[0] > 0.03 && compared.zmp[1] < compared.zmp[0], "{:?}", compared.zmp);
    let picture = Quantity::Torque.picture(&plan, &answer, &[vec!["Knee".to_owned()], vec!["Neck".to_owned()]]);
    assert_eq!(picture.matches("class=\"right-path\"").count(), 3, "two lines and the legend's");
}

#[test]
fn missing_tracks_are_reported() {
    let plan = walk(0.2, 0.0, 0.5, 10.0);
    let of = |answer: &Trajectory| Comparison::of(&plan, answer, |_| 500.0).unwrap_err();
    let mut lame = plan.clone();
    lame.contacts.pop();
    assert_eq!(of(&lame).kind(), ErrorKind::MissingKey);
    let mut blind = plan.clone();
    blind.figures.remove(0);
    assert!(of(&blind).to_string().contains("tau:Knee"));
    let mut without = plan.clone();
    without.figures.retain(|figure| !figure.name.starts_with("tau:"));
    let compared = Comparison::of(&without, &plan, |_| 500.0).unwrap();
    assert_eq!(compared.joints[0].sag, None, "the plan tells no torques");
}
