//! Relations of random and real chains. They are proved over Q, and they vanish at random joint values by forward kinematics in doubles.

use groebot_algebra::number::BigRational;
use groebot_ik::ErrorKind;
use groebot_ik::derive::closure::{
    Arithmetic, Assignment, JointValue, Mechanism, Object, Relation, Target, evaluate, prove,
};
use groebot_robot::kinematics::{Chain, JointKind, Plane, Task};
use groebot_robot::robots;
use nalgebra::UnitQuaternion;
use num_traits::ToPrimitive;

use super::random_chains::{Draw, Shared, chain, planar_chain};

/// Arithmetic in doubles. Only exact zeros are known to be zero.
struct Doubles;

impl Arithmetic for Doubles {
    type Value = f64;

    fn rational(&mut self, number: &BigRational) -> f64 {
        number.to_f64().unwrap()
    }
    fn add(&mut self, a: &f64, b: &f64) -> f64 {
        a + b
    }
    fn sub(&mut self, a: &f64, b: &f64) -> f64 {
        a - b
    }
    fn mul(&mut self, a: &f64, b: &f64) -> f64 {
        a * b
    }
    fn neg(&mut self, a: &f64) -> f64 {
        -a
    }
    fn is_zero(&self, a: &f64) -> bool {
        *a == 0.0
    }
}

/// The numbers of the target at the joint values `q`, from the chain's numeric forward kinematics. A ray becomes a pose: the last value is its rotation about
/// the ray from the zero configuration.
fn parameters(chain: &Chain, mechanism: &Mechanism, q: &[f64]) -> Vec<f64> {
    let pose = chain.forward(&q[..chain.joints().len()]).unwrap();
    let (p, mut r) = (pose.translation.vector, pose.rotation.to_rotation_matrix());
    if mechanism.hidden().is_some() {
        let zero = chain.base_from_tip().rotation;
        let about = UnitQuaternion::from_axis_angle(&(zero * chain.aim()), q[q.len() - 1]);
        r = (pose.rotation * zero.inverse() * about).to_rotation_matrix();
    }
    let length = mechanism.aim().iter().map(|entry| entry.to_f64().unwrap().powi(2)).sum::<f64>().sqrt();
    let aim = pose.rotation * chain.aim().into_inner() * length;
    // The angle of a planar pose is relative to the zero configuration.
    let turned = pose.rotation * chain.base_from_tip().rotation.inverse();
    let value = |name: &str| -> f64 {
        let axis = |name: &str| "xyz".find(&name[1..]).unwrap();
        match (name, &name[..1]) {
            ("cphi" | "sphi", _) => {
                let normal = chain.task().plane().unwrap().normal();
                let (a, b) = ((normal + 1) % 3, (normal + 2) % 3);
                let matrix = turned.to_rotation_matrix();
                if name == "cphi" { matrix[(a, a)] } else { matrix[(b, a)] }
            }
            (_, "p") => p[axis(name)],
            (_, "d") => aim[axis(name)],
            _ => {
                let digits: Vec<usize> = name[1..].bytes().map(|digit| usize::from(digit - b'1')).collect();
                r[(digits[0], digits[1])]
            }
        }
    };
    mechanism.parameters().iter().map(|name| value(name)).collect()
}

fn values(mechanism: &Mechanism, q: &[f64]) -> Vec<JointValue<f64>> {
    let joints = mechanism.joints().iter().zip(q);
    let value = |(joint, q): (&groebot_ik::derive::closure::ScrewJoint, &f64)| {
        let length = joint.square.to_f64().unwrap().sqrt();
        match joint.kind {
            JointKind::Revolute => JointValue::Angle { cosine: q.cos(), sine: q.sin() / length },
            JointKind::Prismatic => JointValue::Length(q / length),
        }
    };
    joints.map(value).collect()
}

/// Checks that every relation is proved and vanishes at three random configurations.
fn assert_hold(chain: &Chain) -> Vec<Relation> {
    let mechanism = Mechanism::new(chain).unwrap();
    let relations = mechanism.relations();
    for relation in &relations {
        prove(&mechanism, relation).unwrap_or_else(|error| panic!("{}: {error}", chain.name()));
    }
    let mut draw = Draw::new(7);
    // The direction of an axis of irrational length has coprime integer coordinates.
    let square = mechanism.joints().iter().map(|joint| joint.square.to_f64().unwrap()).fold(1.0, f64::max);
    let size = if mechanism.hidden().is_some() { square } else { 1.0 };
    for _ in 0..3 {
        let q: Vec<f64> = mechanism.joints().iter().map(|joint| draw.value(joint.kind)).collect();
        let target = Target::new(&mechanism, &parameters(chain, &mechanism, &q), &mut Doubles).unwrap();
        let assignment = Assignment { joints: values(&mechanism, &q), target };
        for relation in &relations {
            let value = evaluate(&mechanism, relation, &assignment, &mut Doubles).unwrap();
            let value = value.constant_term().copied().unwrap_or(0.0);
            assert!(value.abs() < 1e-9 * size, "{}: {relation} is {value} at {q:?}", chain.name());
        }
    }
    relations
}

#[test]
fn relations_of_the_robots_hold() {
    for robot in robots::ALL {
        let relations = assert_hold(&robot.chain());
        assert!(!relations.is_empty(), "{}", robot.name());
    }
}

#[test]
fn relations_of_every_task_hold_on_random_chains() {
    let wrist = [Shared::Point(3, 5)];
    assert_hold(&chain("RRRRRR", &wrist, Task::Pose, 1));
    assert_hold(&chain("RPRRRR", &wrist, Task::Pose, 2));
    assert_hold(&chain("PRPRRR", &[Shared::Direction(3, 4)], Task::Pose, 3));
    assert_hold(&chain("RRR", &[], Task::Position, 4));
    assert_hold(&chain("RRP", &[], Task::Position, 5));
    assert_hold(&chain("RRRRP", &[Shared::Point(0, 1)], Task::Ray, 6));
    assert_hold(&chain("RRRRR", &[Shared::Direction(2, 3)], Task::Ray, 7));
    assert_hold(&chain("RR", &[], Task::Direction, 8));
    assert_hold(&chain("RPR", &[], Task::Direction, 9));
    assert_hold(&chain("RRR", &[], Task::Rotation, 10));
    let plane = Plane::Xy;
    assert_hold(&planar_chain("RRR", Task::PlanarPose { plane }, 11));
    assert_hold(&planar_chain("RPR", Task::PlanarPose { plane }, 12));
    assert_hold(&planar_chain("PR", Task::PlanarPosition { plane }, 13));
}

#[test]
fn a_relation_with_another_point_is_refuted() {
    let chain = chain("RRRRRR", &[Shared::Point(3, 5)], Task::Pose, 1);
    let mechanism = Mechanism::new(&chain).unwrap();
    let mut relation = mechanism.relations()[0].clone();
    let (Object::Point(point) | Object::Direction(point) | Object::Line { point, .. }) = &mut relation.moved;
    point[0] += BigRational::new(1.into(), 1_000_000.into());
    assert_eq!(prove(&mechanism, &relation).unwrap_err().kind(), ErrorKind::Certificate);
}

#[test]
fn relations_print_and_travel() {
    let mechanism = Mechanism::new(&robots::irb120()).unwrap();
    let relations = mechanism.relations();
    let shown: Vec<String> = relations.iter().map(Relation::to_string).collect();
    // The distance between wrist centre and shoulder depends only on the elbow.
    let elbow = "|E3 (0.302, 0, 0.63) - (0, 0, 0.29)|^2 = |G (0.302, 0, 0.63) - (0, 0, 0.29)|^2";
    let at = shown.iter().position(|text| text == elbow).unwrap_or_else(|| panic!("{shown:#?}"));
    let meaning = "distance between the point (0, 0, 0.29), which joints 1, 2 leave in place, and the point \
                   (0.302, 0, 0.63), which joints 4, 5, 6 leave in place";
    assert_eq!(relations[at].meaning(&mechanism), meaning);
    let text = serde_json::to_string(&relations).unwrap();
    assert_eq!(serde_json::from_str::<Vec<Relation>>(&text).unwrap(), relations);
}
