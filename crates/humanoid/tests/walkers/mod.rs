//! The humanoids as whole robots, compared with the figures of their sources.

use std::sync::Arc;

use groebot_humanoid::gait::{LegSolver, Legs, Mirrored, Side, Walker};
use groebot_humanoid::walkers::{self, Outline, nao_walker, rh0_walker};
use groebot_robot::dynamics::Model;
use groebot_robot::kinematics::{InverseKinematics, Solution, Target};
use groebot_robot::model::Robot;
use groebot_robot::robots::{self, nao_v5, rh0, teo};
use groebot_robot::spatial::Pose;
use nalgebra::{Matrix4, Vector3, Vector4};

#[test]
fn nao_has_24_joints_and_its_documented_mass() {
    let nao = nao_v5();
    assert!((nao.mass() - 5.305).abs() < 5e-4, "{}", nao.mass());
    let names: Vec<&str> = nao.moving().iter().map(|joint| nao.joints()[*joint].name.as_str()).collect();
    assert_eq!((names.len(), &names[..3]), (24, &["HeadYaw", "HeadPitch", "LShoulderPitch"][..]));
    let walker = nao_walker(Outline::Measured).unwrap();
    assert_eq!(
        walker.biped.shared,
        [["LHipYawPitch", "RHipYawPitch"].map(|name| walker.biped.joint(name).unwrap()).into()]
    );
}

/// Masses and centres of mass are mirror images; inertias are nearly so, because the manufacturer measured both sides in its drawings.
#[test]
fn left_and_right_are_mirror_images() {
    let nao = nao_v5();
    let sides = nao.joints().iter().filter(|joint| joint.name.starts_with('L') && joint.kind.is_single());
    for joint in sides {
        let other = &nao.joints()[nao.joint(&joint.name.replacen('L', "R", 1)).unwrap()];
        let [a, b] = [joint, other].map(|joint| nao.links()[nao.link(&joint.child).unwrap()].inertia());
        let [p, r] = [a, b].map(|inertia| inertia.centre_of_mass());
        assert_eq!((a.mass(), p.x, p.y, p.z), (b.mass(), r.x, -r.y, r.z), "{}", joint.name);
        assert_eq!(joint.speed, other.speed);
    }
    let extent = |outline, side: usize| {
        let corners = nao_walker(outline).unwrap().biped.feet[side].corners.clone();
        let range = |values: Vec<f64>| {
            (
                values.iter().copied().fold(f64::INFINITY, f64::min),
                values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
            )
        };
        [range(corners.iter().map(|corner| corner.x).collect()), range(corners.iter().map(|corner| corner.y).collect())]
    };
    let near = |a: [(f64, f64); 2], b: [(f64, f64); 2]| {
        let pairs = a.into_iter().zip(b);
        pairs.flat_map(|(a, b)| [(a.0 - b.0).abs(), (a.1 - b.1).abs()]).fold(0.0, f64::max) < 1e-15
    };
    let left = extent(Outline::Measured, 0);
    assert!(near(left, [(-0.05072, 0.09942), (-0.03877, 0.05002)]), "B-Human, below the axes of the ankle: {left:?}");
    assert!(near(extent(Outline::Measured, 1), [left[0], (-left[1].1, -left[1].0)]));
    let [x, y] = extent(Outline::Published, 0).map(|(low, high)| high - low);
    assert!((x - 0.16).abs() < 1e-15 && (y - 0.09).abs() < 1e-15, "NAO 6.8");
}

/// Forward kinematics of a robot whose base is at the origin: the frame `name`, with the given values of named joints.
fn at(robot: &Robot, values: &[(&str, f64)], name: &str) -> Pose {
    let model = Model::new(robot).unwrap();
    let mut q = vec![0.0; model.joints().len()];
    for (joint, value) in values {
        q[model.joint(joint).unwrap()] = *value;
    }
    model.place(&Pose::identity(), &q).unwrap().world_from_link(robot.link(name).unwrap())
}

fn close(a: &Pose, b: &Pose) -> bool {
    (a.to_homogeneous() - b.to_homogeneous()).amax() < 1e-12
}

/// RH0's data in the thesis' axes, rotated into ours, agree with the chains of its legs, which lead from the foot to the trunk.
#[test]
fn rh0_as_a_whole_is_its_legs() {
    let robot = rh0();
    assert!(rh0_walker().unwrap().biped.is_point_mass && robot.mass() == 40.0);
    let moving: Vec<_> = robot.moving().into_iter().map(|joint| &robot.joints()[joint]).collect();
    let mut symbols: Vec<u32> = moving.iter().map(|joint| joint.symbol.as_ref().unwrap().parse().unwrap()).collect();
    symbols.sort();
    assert_eq!(symbols, (1..=21).collect::<Vec<_>>(), "the joints of RH0 3.4.1");
    assert!(
        moving.iter().all(|joint| (joint.speed.unwrap() - 25.0 * std::f64::consts::TAU / 60.0).abs() < 1e-9),
        "25 rpm"
    );
    let q = [0.1, -0.2, 0.5, -0.4, 0.15, 0.3];
    for (chain, side, prefix) in [(robots::rh0_left_leg(), 1.0, "L"), (robots::rh0_right_leg(), -1.0, "R")] {
        // The trunk relative to S, by the chain; S and the trunk relative to the base, by the whole robot.
        let values: Vec<(&str, f64)> = chain.joints().iter().map(|joint| joint.name.as_str()).zip(q).collect();
        let foot = at(&robot, &values, &format!("{prefix}S"));
        let trunk = at(&robot, &values, "Trunk");
        assert!(close(&foot.inv_mul(&trunk), &chain.forward(&q).unwrap()), "{}", chain.name());
        let sole = at(&robot, &[], &format!("{}_sole", prefix.to_lowercase()));
        assert!((sole.translation.vector - Vector3::new(0.0, side * 0.112, -0.6765)).norm() < 1e-15, "{sole}");
        assert!(sole.rotation.angle() < 1e-12, "x ahead, y left, z up");
    }
}

/// TEO's legs: the left one agrees with its chain, the right one with the manufacturer's table of the right leg.
#[test]
fn teo_as_a_whole_is_its_legs() {
    let robot = teo();
    assert!((robot.mass() - 55.9).abs() < 1e-3, "the sum of the maker's table: {}", robot.mass());
    let chain = robots::teo_leg();
    let names = ["HipYaw", "HipRoll", "HipPitch", "KneePitch", "AnklePitch", "AnkleRoll"];
    let q = [0.1, -0.2, 0.5, -0.4, 0.15, 0.3];
    let named = |prefix: &str, q: [f64; 6]| {
        let names = names.map(|name| format!("{prefix}{name}"));
        let values: Vec<(&str, f64)> = names.iter().map(String::as_str).zip(q).collect();
        at(&robot, &values, if prefix == "L" { "l_sole" } else { "r_sole" })
    };
    let left = named("L", q);
    assert!(close(&left, &chain.forward(&q).unwrap()));
    // Pitches keep their sign in the mirror image; yaw and rolls change it.
    let right = named("R", [-q[0], -q[1], q[2], q[3], q[4], -q[5]]);
    let mirror = Matrix4::from_diagonal(&Vector4::new(1.0, -1.0, 1.0, 1.0));
    assert!((right.to_homogeneous() - mirror * left.to_homogeneous() * mirror).amax() < 1e-12);
}

/// The solvers of each walker reach the sole poses of forward kinematics, with the original joint values among the solutions.
#[test]
fn the_legs_of_all_walkers_are_solved() {
    for name in ["nao", "rh0", "teo"] {
        let walker = walkers::walker(name, Outline::Measured).unwrap().unwrap();
        for (side, foot) in [groebot_humanoid::gait::Side::Left, groebot_humanoid::gait::Side::Right]
            .into_iter()
            .zip(&walker.biped.feet)
        {
            let values = [0.12, -0.1, 0.3, 0.4, -0.35, 0.05];
            let mut q = vec![0.0; walker.biped.joints.len()];
            foot.joints.iter().zip(values).for_each(|(joint, value)| q[*joint] = value);
            let placed = walker.biped.model.place(&Pose::identity(), &q).unwrap();
            let answers = walker.legs.solutions(side, &(placed.motion(foot.body) * foot.torso_from_sole));
            let off = |answer: &Vec<f64>| answer.iter().zip(values).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(answers.iter().any(|answer| off(answer) < 1e-9), "{name}: {answers:?}");
        }
    }
    assert!(walkers::walker("c3po", Outline::Measured).is_none());
}

/// The right leg of NAO by the solver of the left one: the postures of its own derived solver, and by forward kinematics.
#[test]
fn a_leg_is_solved_by_its_mirror_image() {
    let Walker { biped, legs, .. } = nao_walker(Outline::Measured).unwrap();
    let (_, torso_from_link) = biped.model.link(biped.feet[0].link);
    let link_from_sole = torso_from_link.inv_mul(&biped.feet[0].torso_from_sole);
    let left: LegSolver = Arc::new(Leg { legs: legs.clone(), link_from_sole });
    let mirrored = Mirrored::right(&biped, &left).expect("NAO's legs are mirror images");
    let foot = &biped.feet[1];
    let mut solved = 0;
    for case in 0..200 {
        let mut q = vec![0.0; biped.joints.len()];
        for (place, joint) in foot.joints.iter().enumerate() {
            let (low, high) = biped.joints[*joint].limits;
            // A sequence of low discrepancy for each joint.
            q[*joint] =
                low + (high - low) * (0.37 + case as f64 * [2f64, 3.0, 5.0, 7.0, 11.0, 13.0][place].sqrt()).fract();
        }
        let reached = biped.model.place(&Pose::identity(), &q).unwrap().world_from_link(foot.link);
        let mut found = Vec::new();
        mirrored.solve(&Target::Pose(reached), &[], &mut found).unwrap();
        let own: Vec<f64> = foot.joints.iter().map(|joint| q[*joint]).collect();
        let away = |answer: &Solution| answer.q.iter().zip(&own).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        solved += usize::from(found.iter().any(|answer| away(answer) < 1e-6));
        for answer in &found {
            foot.joints.iter().zip(&answer.q).for_each(|(joint, value)| q[*joint] = *value);
            let again = biped.model.place(&Pose::identity(), &q).unwrap().world_from_link(foot.link);
            assert!((again.to_homogeneous() - reached.to_homogeneous()).norm() < 1e-9, "case {case}");
        }
    }
    assert_eq!(solved, 200);
}

/// The solver of the left leg.
#[derive(Debug)]
struct Leg {
    legs: Legs,
    link_from_sole: Pose,
}

impl InverseKinematics for Leg {
    fn solve(&self, target: &Target, _given: &[f64], out: &mut Vec<Solution>) -> groebot_humanoid::Result<()> {
        let Target::Pose(pose) = target else { unreachable!("a pose") };
        let answers = self.legs.solutions(Side::Left, &(pose * self.link_from_sole)).into_iter();
        *out = answers.map(|q| Solution { q, ..Solution::default() }).collect();
        Ok(())
    }
}
