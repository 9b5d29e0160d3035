//! Plans of robots and of random families. The numbers of solutions are those of the literature: at most 16 for a general 6R chain (Lee and Liang 1988), 8 with
//! three axes that meet or are parallel (Pieper 1968), 4 for a general 3R arm's positions, and so on. The planner counts them with a Groebner basis of all
//! equations, and the product of its steps must be equal.

use groebot_algebra::number::BigRational;
use groebot_ik::derive::closure::{Mechanism, prove};
use groebot_ik::derive::planner::{Plan, StepMethod, joints_to_give, plan};
use groebot_ik::{ErrorKind, Watch};
use groebot_robot::kinematics::{Chain, ExactVector, Plane, Task, along_z};
use groebot_robot::robots;

use super::random_chains::{Shared, chain, planar_chain, reversed};

/// The plan of `chain` with these joints given.
fn planned(chain: &Chain, given: &[usize]) -> groebot_ik::Result<(Mechanism, Plan)> {
    let mechanism = Mechanism::new(chain)?.with_given(given)?;
    let plan = plan(&mechanism, &Watch::none())?;
    Ok((mechanism, plan))
}

/// Checks that each joint is found once, from proved relations whose other joints are known or eliminated.
fn assert_sound(mechanism: &Mechanism, plan: &Plan) {
    let mut known = plan.given.clone();
    for step in &plan.steps {
        let away: &[usize] = if let StepMethod::Eliminated { away, .. } = &step.method { away } else { &[] };
        for relation in step.method.relations() {
            prove(mechanism, relation).unwrap();
            let fits = |joint: &usize| *joint == step.joint || known.contains(joint) || away.contains(joint);
            assert!(relation.joints().iter().all(fits), "{plan}");
        }
        assert!(!known.contains(&step.joint) && (1..=4).contains(&step.degree), "{plan}");
        known.push(step.joint);
    }
    assert_eq!(known.len(), mechanism.joints().len(), "{plan}");
    assert_eq!(plan.evidence.len(), 3, "three primes");
    assert!(plan.evidence.iter().all(|evidence| evidence.dimension == plan.dimension), "{:?}", plan.evidence);
}

/// Checks that a sound plan with this number of solutions exists, and that its steps give no more.
fn assert_plan(label: &str, chain: &Chain, given: &[usize], dimension: usize) -> Plan {
    let (mechanism, plan) = planned(chain, given).unwrap_or_else(|error| panic!("{label}: {error}"));
    assert_sound(&mechanism, &plan);
    assert_eq!((plan.dimension, plan.product()), (dimension, dimension), "{label}: {plan}");
    plan
}

fn refusal(chain: &Chain, given: &[usize]) -> groebot_ik::Error {
    planned(chain, given).expect_err("no plan")
}

/// Checks random chains of a geometry, each also from tip to base.
fn assert_family(kinds: &str, shared: &[Shared], task: Task, dimension: usize) {
    for seed in 1..=2 {
        let label = format!("{kinds} {shared:?} {} seed {seed}", task.name());
        let chain = chain(kinds, shared, task, seed);
        assert_plan(&label, &chain, &[], dimension);
        if task == Task::Pose {
            assert_plan(&format!("{label} reversed"), &reversed(&chain), &[], dimension);
        }
    }
}

fn vector(x: i64, y: i64, z: i64) -> ExactVector {
    [x, y, z].map(|entry| BigRational::from_integer(entry.into()))
}

fn with_task(chain: &Chain, task: Task, direction: ExactVector) -> Chain {
    chain.with_task(task, direction, Vec::new()).unwrap()
}

#[test]
fn every_robot_has_a_plan_with_as_many_solutions_as_there_are() {
    let expected = |name: &str| match name {
        "polar" | "nao_left_arm" | "nao_right_arm" => 4,
        "nao_head" => 1,
        _ => 8,
    };
    for robot in robots::ALL {
        assert_plan(robot.name(), &robot.chain(), &[], expected(robot.name()));
    }
}

#[test]
fn limbs_have_plans_for_other_tasks() {
    let (arm, leg) = (robots::nao_left_arm(), robots::nao_left_leg());
    assert_plan("hand and wrist axis", &with_task(&arm, Task::Ray, vector(1, 0, 0)), &[], 8);
    assert_plan("hand, ElbowYaw given", &with_task(&arm, Task::Position, along_z()), &[2, 4], 4);
    assert_plan("view", &with_task(&robots::nao_head(), Task::Direction, vector(1, 2, 3)), &[], 2);
    assert_plan("hip", &with_task(&leg, Task::Rotation, along_z()), &[3, 4, 5], 2);
    assert_plan("HipYawPitch given", &leg, &[0], 4);
    assert_plan("PUMA's wrist axis", &with_task(&robots::puma(), Task::Ray, along_z()), &[5], 8);
}

#[test]
fn three_axes_that_meet_leave_eight() {
    for first in 0..=3 {
        assert_family("RRRRRR", &[Shared::Point(first, first + 2)], Task::Pose, 8);
    }
}

#[test]
fn three_parallel_axes_leave_eight() {
    for first in 0..=3 {
        assert_family("RRRRRR", &[Shared::Direction(first, first + 2)], Task::Pose, 8);
    }
}

#[test]
fn a_wrist_with_pairs_before_it_needs_no_quartic() {
    for pair in [Shared::Point(0, 1), Shared::Direction(0, 1), Shared::Direction(1, 2)] {
        let chain = chain("RRRRRR", &[pair, Shared::Point(3, 5)], Task::Pose, 4);
        let plan = assert_plan(&format!("{pair:?}"), &chain, &[], 8);
        assert!(plan.steps.iter().all(|step| step.degree <= 2), "{plan}");
    }
    let wrist = chain("RRRRRR", &[Shared::Point(3, 5)], Task::Pose, 4);
    let plan = assert_plan("general arm", &wrist, &[], 8);
    assert!(plan.steps.iter().any(|step| step.degree == 4), "{plan}");
}

#[test]
fn slides_before_a_wrist() {
    let dimensions = [("PRR", 8), ("RPR", 8), ("RRP", 8), ("PPR", 4), ("PRP", 4), ("RPP", 4), ("PPP", 2)];
    for (arm, dimension) in dimensions {
        assert_family(&format!("{arm}RRR"), &[Shared::Point(3, 5)], Task::Pose, dimension);
    }
}

#[test]
fn three_slides_anywhere_leave_the_rotation_alone() {
    for kinds in ["PRPRPR", "RRRPPP", "PRRPRP"] {
        assert_family(kinds, &[], Task::Pose, 2);
    }
}

#[test]
fn positions_of_three_joints() {
    let dimensions = [("RRR", 4), ("RRP", 4), ("RPR", 4), ("PRR", 4), ("PPR", 2), ("PRP", 2), ("RPP", 2), ("PPP", 1)];
    for (kinds, dimension) in dimensions {
        assert_family(kinds, &[], Task::Position, dimension);
    }
}

#[test]
fn planar_chains() {
    let plane = Plane::Xy;
    for (kinds, dimension) in [("RRR", 2), ("RRP", 2), ("RPR", 2), ("PRR", 2), ("PPR", 1)] {
        assert_plan(kinds, &planar_chain(kinds, Task::PlanarPose { plane }, 5), &[], dimension);
    }
    for kinds in ["RR", "RP", "PR"] {
        assert_plan(kinds, &planar_chain(kinds, Task::PlanarPosition { plane }, 6), &[], 2);
    }
}

#[test]
fn directions_rotations_and_rays() {
    assert_family("RR", &[], Task::Direction, 2);
    assert_family("RRR", &[], Task::Rotation, 2);
    assert_family("RRRRR", &[Shared::Direction(1, 3)], Task::Ray, 8);
}

/// Two axes that meet, three that meet, and a ray parallel to the last of them at a distance.
#[test]
fn an_arm_with_a_ray_along_its_last_axis() {
    let arm = chain("RRRRR", &[Shared::Point(0, 1), Shared::Point(2, 4)], Task::Pose, 14);
    let (axis, rotation) = (&arm.joints()[4].axis, &arm.tip().rotation);
    let in_tip = [0, 1, 2].map(|j| (0..3).map(|i| &rotation[i][j] * &axis[i]).sum());
    assert_plan("arm", &with_task(&arm, Task::Ray, in_tip), &[], 8);
}

#[test]
fn seven_joints_with_one_given() {
    let spherical = chain("RRRRRRR", &[Shared::Point(0, 2), Shared::Point(4, 6)], Task::Pose, 7);
    assert_plan("anthropomorphic arm", &spherical, &[2], 8);
    assert_plan("one wrist", &chain("RRRRRRR", &[Shared::Point(4, 6)], Task::Pose, 8), &[1], 8);
    // The elbow's angle follows from the distance between shoulder and wrist, so it cannot be given.
    let error = refusal(&spherical, &[]);
    assert_eq!(error.kind(), ErrorKind::PositiveDimensional);
    let others = ["joint1", "joint2", "joint3", "joint5", "joint6", "joint7"];
    assert!(others.iter().all(|name| error.message().contains(&format!("`{name}`"))), "{error}");
    assert!(!error.message().contains("`joint4`"), "{error}");
    assert_eq!(refusal(&spherical, &[3]).kind(), ErrorKind::PositiveDimensional);
}

#[test]
fn a_general_chain_is_refused_with_its_sixteen() {
    for shared in [vec![], vec![Shared::Point(0, 1), Shared::Point(4, 5)]] {
        let error = refusal(&chain("RRRRRR", &shared, Task::Pose, 9), &[]);
        assert_eq!(error.kind(), ErrorKind::Unsupported);
        let message = error.message();
        assert!(message.contains("16 complex solutions") && message.contains("`joint3` 16"), "{message}");
        assert!(message.contains("would have to meet in one point or be parallel"), "{message}");
    }
}

/// Three angles among four axes are independent for free coefficients, but not for those of a target. So no step uses them.
#[test]
fn two_slides_between_pairs_are_refused_with_their_eight() {
    let error = refusal(&chain("RRPPRR", &[Shared::Point(0, 1), Shared::Point(4, 5)], Task::Pose, 3), &[]);
    assert_eq!(error.kind(), ErrorKind::Unsupported);
    assert!(error.message().contains("8 complex solutions"), "{error}");
}

#[test]
fn more_joints_than_the_task_needs_are_free() {
    let error = refusal(&chain("RRRR", &[], Task::Position, 10), &[]);
    assert_eq!(error.kind(), ErrorKind::PositiveDimensional);
    assert!(error.message().contains("`joint1`, `joint2`, `joint3`, `joint4`"), "{error}");
    let error = refusal(&chain("RRRRRRRRRRRR", &[], Task::Pose, 11), &[]);
    assert_eq!(error.kind(), ErrorKind::PositiveDimensional);
    assert!(error.message().contains("at least 6"), "{error}");
    // Two parallel prismatic joints give the same result.
    let twice = planar_chain("PPP", Task::PlanarPosition { plane: Plane::Xy }, 12);
    assert_eq!(refusal(&twice, &[]).kind(), ErrorKind::PositiveDimensional);
}

#[test]
fn fewer_joints_than_the_task_asks_still_have_plans() {
    for kinds in ["R", "P", "RR", "RRR", "RPR"] {
        let (mechanism, plan) = planned(&chain(kinds, &[], Task::Pose, 13), &[]).unwrap();
        assert_sound(&mechanism, &plan);
        assert_eq!(plan.dimension, 1, "{plan}");
    }
}

#[test]
fn plans_print_travel_and_stop() {
    let mechanism = Mechanism::new(&robots::irb120()).unwrap();
    let plan = plan(&mechanism, &Watch::none()).unwrap();
    let text = serde_json::to_string(&plan).unwrap();
    assert_eq!(serde_json::from_str::<Plan>(&text).unwrap(), plan);
    let shown = plan.to_string();
    assert!(shown.starts_with("8 solutions\n1. joint "), "{shown}");
    assert!(shown.contains("|E3 (0.302, 0, 0.63) - (0, 0, 0.29)|^2"), "{shown}");
    let flag = std::sync::Arc::new(std::sync::atomic::AtomicBool::new(true));
    let cancelled = groebot_ik::derive::planner::plan(&mechanism, &Watch::none().with_cancel(flag)).unwrap_err();
    assert_eq!(cancelled.kind(), ErrorKind::Cancelled);
}

/// Of a seven-joint arm, the given joint has solutions on its range, and the others are found by the least degrees.
#[test]
fn the_joint_to_give_has_solutions_on_its_range() {
    let seven = Chain::from_toml(include_str!("../../../../derivations/iiwa14/0_chain.toml")).unwrap();
    let seven = seven.with_task(Task::Pose, along_z(), Vec::new()).unwrap();
    let choice = joints_to_give(&seven, &Watch::none()).unwrap().unwrap();
    let [name] = choice.given.as_slice() else { panic!("{choice:?}") };
    let chosen = choice.candidates.iter().find(|candidate| candidate.joint == *name).unwrap();
    let elbow = &choice.candidates[3];
    assert!(elbow.share < 0.05 && elbow.plan.is_none(), "its angle follows from the distance of shoulder and wrist");
    for other in choice.candidates.iter().filter(|other| other.plan.is_some()) {
        assert!(other.share <= chosen.share / 0.8, "{other} is better than {chosen}");
        assert!(other.share < 0.8 * chosen.share || chosen.plan <= other.plan, "{other} is easier than {chosen}");
    }
    assert_eq!(joints_to_give(&robots::puma(), &Watch::none()).unwrap(), None);
}

/// If the others have no order for any given joint, the last one is given, because the six others can be solved together.
#[test]
fn the_last_joint_is_given_where_there_is_no_order() {
    let seven = Chain::from_toml(include_str!("../../../../derivations/gen3_like/0_chain.toml")).unwrap();
    let seven = seven.with_task(Task::Pose, along_z(), Vec::new()).unwrap();
    assert!((0..7).all(|joint| planned(&seven, &[joint]).is_err()));
    assert_eq!(joints_to_give(&seven, &Watch::none()).unwrap().unwrap().given, ["Joint7"]);
}
