//! Chains whose leaders are found together with their followers: palletizers, lifters, fingers, rolling joints, hollow wrists. Expected solutions come from
//! independent forward kinematics and Newton's method from many starts on the independent joints.

use std::f64::consts::{PI, TAU};

use groebot_algebra::number::BigRational;
use groebot_ik::derive::Derivation;
use groebot_ik::{ErrorKind, Watch};
use groebot_robot::kinematics::{Chain, ChainParts, Joint, JointKind, Mimic, Plane, Task, Tip, along_z};
use groebot_robot::model::Robot;
use groebot_robot::robots;
use nalgebra::{DMatrix, DVector, Isometry3, Point3, Rotation3, Unit, UnitQuaternion, Vector3};

const X: [f64; 3] = [1.0, 0.0, 0.0];
const Y: [f64; 3] = [0.0, 1.0, 0.0];
const Z: [f64; 3] = [0.0, 0.0, 1.0];

/// The law of a follower: the index of its leader, the multiplier and the offset.
type Law = Option<(usize, f64, f64)>;

/// A joint: whether it is revolute, its axis, a point of it in the zero configuration, its law.
type Link = (bool, [f64; 3], [f64; 3], Law);

/// A mechanism with this file's own kinematics. By joint: whether it is revolute, its axis and a point of it in the zero configuration, and its law.
struct Mechanism {
    joints: Vec<Link>,
    tip: [f64; 3],
    task: Task,
}

fn exact(x: f64) -> BigRational {
    groebot_algebra::number::parse_rational(&x.to_string()).unwrap()
}

impl Mechanism {
    fn new(task: Task, tip: [f64; 3], joints: &[Link]) -> Self {
        Mechanism { joints: joints.to_vec(), tip, task }
    }

    fn chain(&self) -> Chain {
        let joint = |(place, (turns, axis, point, law)): (usize, &Link)| Joint {
            name: format!("j{place}"),
            symbol: (place + 1).to_string(),
            kind: if *turns { JointKind::Revolute } else { JointKind::Prismatic },
            axis: axis.map(exact),
            point: point.map(exact),
            limits: None,
            mimic: law.map(|(leader, multiplier, offset)| Mimic {
                leader: format!("j{leader}"),
                multiplier: exact(multiplier),
                offset: exact(offset),
            }),
        };
        let plain = ChainParts::from(robots::puma());
        let rotation = std::array::from_fn(|i| std::array::from_fn(|j| exact(f64::from(i8::from(i == j)))));
        Chain::new(ChainParts {
            name: "followers".into(),
            joints: self.joints.iter().enumerate().map(joint).collect(),
            tip: Tip { point: self.tip.map(exact), rotation },
            task: self.task,
            direction: along_z(),
            given: Vec::new(),
            order: None,
            choice: None,
            meant: None,
            ..plain
        })
        .unwrap()
    }

    fn independent(&self) -> Vec<usize> {
        (0..self.joints.len()).filter(|place| self.joints[*place].3.is_none()).collect()
    }

    /// The values of all joints from those of the independent ones.
    fn whole(&self, values: &[f64]) -> Vec<f64> {
        let mut q = vec![0.0; self.joints.len()];
        self.independent().iter().zip(values).for_each(|(&place, value)| q[place] = *value);
        for (place, (_, _, _, law)) in self.joints.iter().enumerate() {
            if let Some((leader, multiplier, offset)) = law {
                q[place] = multiplier * q[*leader] + offset;
            }
        }
        q
    }

    /// The numbers of the target that the joint values `q` reach.
    fn seen(&self, q: &[f64]) -> Vec<f64> {
        let motion = |(&(turns, axis, point, _), q): (&Link, &f64)| {
            let axis = Unit::new_normalize(Vector3::from(axis));
            if !turns {
                return Isometry3::translation(axis.x * q, axis.y * q, axis.z * q);
            }
            let rotation = UnitQuaternion::from_axis_angle(&axis, *q);
            let point = Vector3::from(point);
            Isometry3::from_parts((point - rotation * point).into(), rotation)
        };
        let pose = self.joints.iter().zip(q).map(motion).fold(Isometry3::identity(), |pose, next| pose * next);
        let tip = pose * Point3::from(self.tip);
        let rotation: Rotation3<f64> = pose.rotation.to_rotation_matrix();
        match self.task {
            Task::PlanarPosition { plane } => plane.coordinates().map(|k| tip[k]).to_vec(),
            Task::Position => tip.iter().copied().collect(),
            _ => tip.iter().copied().chain((0..9).map(|k| rotation[(k / 3, k % 3)])).collect(),
        }
    }

    fn missed(&self, target: &[f64], values: &[f64]) -> DVector<f64> {
        DVector::from_vec(self.seen(&self.whole(values))) - DVector::from_row_slice(target)
    }

    fn slopes(&self, target: &[f64], values: &[f64]) -> DMatrix<f64> {
        let column = |k: usize| {
            let at = |by: f64| {
                let mut moved = values.to_vec();
                moved[k] += by;
                self.missed(target, &moved)
            };
            (at(1e-6) - at(-1e-6)) / 2e-6
        };
        DMatrix::from_columns(&(0..values.len()).map(column).collect::<Vec<_>>())
    }

    fn sigma(&self, target: &[f64], values: &[f64]) -> f64 {
        self.slopes(target, values).svd(false, false).singular_values.min()
    }

    /// The joint vectors that Newton's method finds from many starts, angles in (-pi, pi].
    fn searched(&self, target: &[f64], random: &mut Random, starts: usize) -> Vec<Vec<f64>> {
        let mut found: Vec<Vec<f64>> = Vec::new();
        for _ in 0..starts {
            let mut values = self.drawn(random);
            for _ in 0..40 {
                let (slopes, missed) = (self.slopes(target, &values), self.missed(target, &values));
                let Ok(step) = slopes.svd(true, true).solve(&missed, 1e-9) else { break };
                let length = f64::min(1.0, 0.7 / step.norm().max(1e-300));
                values.iter_mut().zip(step.iter()).for_each(|(value, step)| *value -= length * step);
            }
            if self.missed(target, &values).norm() < 1e-11 {
                let values: Vec<f64> = self.wrapped(&values);
                if !found.iter().any(|other| self.apart(other, &values) < 1e-6) {
                    found.push(values);
                }
            }
        }
        found
    }

    fn drawn(&self, random: &mut Random) -> Vec<f64> {
        let value = |place: usize| random.next(if self.joints[place].0 { PI } else { 0.3 });
        self.independent().into_iter().map(value).collect()
    }

    fn wrapped(&self, values: &[f64]) -> Vec<f64> {
        let wrap = |(place, value): (usize, &f64)| {
            if self.joints[place].0 { value - TAU * (value / TAU).round() } else { *value }
        };
        self.independent().into_iter().zip(values).map(wrap).collect()
    }

    fn apart(&self, a: &[f64], b: &[f64]) -> f64 {
        let one = |((place, a), b): ((usize, &f64), &f64)| {
            if self.joints[place].0 { (2.0 * ((a - b) / 2.0).sin()).abs() } else { (a - b).abs() }
        };
        self.independent().into_iter().zip(a).zip(b).map(one).fold(0.0, f64::max)
    }

    /// The solutions of the derived solver for the independent joints. Checks that followers obey their laws and that all reach the target by this file's
    /// kinematics.
    fn solved(&self, derived: &Derivation, target: &[f64]) -> Vec<Vec<f64>> {
        let answers = derived.program().solve_numbers(target).unwrap();
        let part = |q: &[f64]| self.independent().into_iter().map(|place| q[place]).collect::<Vec<f64>>();
        answers
            .iter()
            .filter(|answer| answer.free.is_empty())
            .map(|answer| {
                let values = part(&answer.q);
                let whole = self.whole(&values);
                let strays = (0..whole.len()).map(|place| match self.joints[place].0 {
                    true => (2.0 * ((whole[place] - answer.q[place]) / 2.0).sin()).abs(),
                    false => (whole[place] - answer.q[place]).abs(),
                });
                assert!(strays.fold(0.0, f64::max) < 1e-10, "{:?}", answer.q);
                assert!(self.missed(target, &values).norm() < 1e-9, "{target:?}: {values:?}");
                values
            })
            .collect()
    }

    /// Checks at targets of random joint values and multiples of 15 degrees that the solver has exactly the solutions of the search.
    fn agrees(&self, targets: usize, starts: usize) -> Vec<usize> {
        let derived = Derivation::sequentially(&self.chain(), &Watch::none()).unwrap();
        assert_eq!(derived.program().inputs.len(), self.seen(&vec![0.0; self.joints.len()]).len(), "no joint is given");
        let mut random = Random(7);
        let mut counts = Vec::new();
        for number in 0..targets {
            let mut values = self.drawn(&mut random);
            if number % 3 == 2 {
                values.iter_mut().for_each(|value| *value = (*value / (PI / 12.0)).round() * PI / 12.0);
            }
            let target = self.seen(&self.whole(&values));
            let mut wanted = self.searched(&target, &mut random, starts);
            wanted.push(self.wrapped(&values));
            let answers = self.solved(&derived, &target);
            let ordinary = |values: &&Vec<f64>| self.sigma(&target, values) > 1e-3;
            for wanted in wanted.iter().filter(ordinary) {
                assert!(answers.iter().any(|own| self.apart(own, wanted) < 1e-7), "{target:?}: {wanted:?} is missing");
            }
            for own in answers.iter().filter(ordinary) {
                assert!(wanted.iter().any(|other| self.apart(own, other) < 1e-6), "{target:?}: {own:?} is not found");
            }
            counts.push(answers.len());
        }
        counts
    }
}

/// A random generator: SplitMix64.
struct Random(u64);

impl Random {
    /// A number in (-limit, limit).
    fn next(&mut self, limit: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        limit * (2.0 * ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64 - 1.0)
    }
}

const PLANE: Task = Task::PlanarPosition { plane: Plane::Xz };

/// A base, an arm whose end keeps its orientation by two followers, and a wrist about the vertical.
fn palletizer() -> Mechanism {
    let joints = [
        (true, Z, [0.0; 3], None),
        (true, Y, [0.1, 0.0, 0.3], None),
        (true, Y, [0.1, 0.0, 0.8], Some((1, -1.0, 0.0))),
        (true, Y, [0.17, 0.0, 0.83], None),
        (true, Y, [0.7, 0.0, 0.8], Some((3, -1.0, 0.0))),
        (true, Z, [0.8, 0.0, 0.8], None),
    ];
    Mechanism::new(Task::Pose, [0.8, 0.0, 0.6], &joints)
}

#[test]
fn a_parallelogram_arm_reaches_a_place_in_four_postures() {
    let joints = [
        (true, Z, [0.0; 3], None),
        (true, Y, [0.0; 3], None),
        (true, Y, [0.2, 0.0, 0.0], Some((1, -1.0, 0.0))),
        (true, Y, [0.2, 0.0, 0.0], None),
    ];
    let arm = Mechanism::new(Task::Position, [0.35, 0.0, 0.0], &joints);
    let derived = Derivation::sequentially(&arm.chain(), &Watch::none()).unwrap();
    let target = arm.seen(&arm.whole(&[0.1, 0.3, 0.4]));
    assert_eq!(arm.solved(&derived, &target).len(), 4);
    arm.agrees(9, 60);
}

#[test]
fn a_palletizer_with_a_wrist_keeps_its_tool_level() {
    palletizer().agrees(6, 80);
}

#[test]
fn two_leaders_of_a_lifter_are_a_two_link_arm() {
    let joints = [
        (true, Y, [0.0, 0.0, 0.15], None),
        (true, Y, [0.0, 0.0, 0.4], Some((0, -1.0, 0.0))),
        (true, Y, [0.0, 0.0, 0.45], Some((3, -1.0, 0.0))),
        (true, Y, [0.0, 0.0, 0.7], None),
    ];
    let counts = Mechanism::new(PLANE, [0.02, 0.0, 0.8], &joints).agrees(9, 60);
    assert!(counts.iter().all(|count| *count <= 2) && counts.contains(&2), "{counts:?}");
}

#[test]
fn a_finger_with_one_tendon_has_one_unknown() {
    let joints = [(true, Y, [0.0; 3], None), (true, Y, [0.04, 0.0, 0.0], Some((0, 1.0, 0.0)))];
    let finger = Mechanism::new(Task::Position, [0.07, 0.0, 0.005], &joints);
    assert_eq!(finger.agrees(6, 40), [1; 6]);
}

#[test]
fn a_rolling_joint_is_an_equation_of_degree_four() {
    let joints = [
        (true, Z, [0.0; 3], None),
        (true, Y, [0.02, 0.0, 0.0], None),
        (true, Y, [0.03, 0.0, 0.0], Some((1, 1.0, 0.0))),
        (true, Y, [0.07, 0.0, 0.0], None),
    ];
    Mechanism::new(Task::Position, [0.1, 0.0, 0.0], &joints).agrees(6, 150);
}

#[test]
fn multipliers_and_offsets_are_whole_numbers_and_any_angle() {
    for (leader, multiplier, offset) in [(1, 1.0, 0.3), (0, -2.0, 0.0), (1, -1.0, PI / 2.0), (0, 2.0, -1.1)] {
        let joints = [
            (true, Y, [0.0; 3], None),
            (true, Y, [0.2, 0.0, 0.0], None),
            (true, Y, [0.35, 0.0, 0.05], Some((leader, multiplier, offset))),
        ];
        let arm = Mechanism::new(PLANE, [0.5, 0.0, 0.02], &joints);
        arm.agrees(3, 80);
    }
}

#[test]
fn on_one_axis_each_answer_of_the_sum_is_several_of_the_leader() {
    // The sum is 2 q, or 3 q: elbow up and elbow down, with two or three values of q each.
    for (multiplier, count) in [(1.0, 4), (2.0, 6)] {
        let joints = [
            (true, Y, [0.0; 3], None),
            (true, Y, [0.0; 3], Some((0, multiplier, 0.0))),
            (true, Y, [0.2, 0.0, 0.0], None),
        ];
        let counts = Mechanism::new(PLANE, [0.35, 0.0, 0.0], &joints).agrees(3, 100);
        assert!(counts.iter().all(|own| *own <= count) && counts.contains(&count), "{counts:?}");
    }
}

#[test]
fn a_slide_follows_a_slide_by_any_factor() {
    let joints =
        [(false, Y, [0.0; 3], None), (true, Z, [0.0; 3], None), (false, X, [0.1, 0.0, 0.0], Some((0, 0.5, 0.1)))];
    Mechanism::new(Task::PlanarPosition { plane: Plane::Xy }, [0.3, 0.0, 0.0], &joints).agrees(6, 80);
}

#[test]
fn a_hollow_wrist_bends_by_two_joints_that_turn_against_each_other() {
    for multiplier in [-1.0, 1.0] {
        let centre = [0.9, 0.0, 1.3];
        let joints = [
            (true, Z, [0.0; 3], None),
            (true, Y, [0.2, 0.0, 0.5], None),
            (true, Y, [0.2, 0.0, 1.2], None),
            (true, X, centre, None),
            (true, [0.8, 0.0, 0.6], centre, None),
            (true, [0.8, 0.0, -0.6], centre, Some((4, multiplier, 0.0))),
            (true, X, centre, None),
        ];
        Mechanism::new(Task::Pose, [1.0, 0.0, 1.3], &joints).agrees(1, 250);
    }
}

#[test]
fn a_fraction_of_a_turn_is_left_to_the_search() {
    let joints = [(true, Y, [0.0; 3], None), (true, Y, [0.04, 0.0, 0.0], Some((0, 0.5, 0.0)))];
    let finger = Mechanism::new(Task::Position, [0.07, 0.0, 0.005], &joints);
    let error = Derivation::sequentially(&finger.chain(), &Watch::none()).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unsupported);
    assert!(error.message().contains("`j1` is 0.5 * j0") && error.message().contains("--numeric"), "{error}");
}

#[test]
fn equations_that_are_solved_together_take_no_followers() {
    let joints = [(true, Y, [0.0; 3], None), (true, Y, [0.04, 0.0, 0.0], Some((0, 1.0, 0.0)))];
    let chain = Mechanism::new(PLANE, [0.07, 0.0, 0.005], &joints).chain();
    let error = groebot_ik::derive::formulate(&chain).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Unsupported);
    assert!(error.message().contains("`j1` follows another one") && error.message().contains("`order`"), "{error}");
}

#[test]
fn what_is_derived_is_proved_again_and_a_forged_law_is_refused() {
    let chain = palletizer().chain();
    let derived = Derivation::sequentially(&chain, &Watch::none()).unwrap();
    let text = derived.certificate().unwrap();
    let again = Derivation::prove(&chain, &text).unwrap();
    assert_eq!(again.program(), derived.program());
    let other = Mechanism {
        joints: palletizer()
            .joints
            .into_iter()
            .map(|(turns, axis, point, law)| (turns, axis, point, law.map(|(leader, _, offset)| (leader, 1.0, offset))))
            .collect(),
        ..palletizer()
    };
    let error = Derivation::prove(&other.chain(), &text).unwrap_err();
    assert_eq!(error.kind(), ErrorKind::Certificate, "{error}");
}

#[test]
fn a_multiplier_of_zero_fixes_a_joint_at_its_offset() {
    let urdf = |mimic: &str| {
        format!(
            "<robot name=\"r\"><link name=\"b\"/><link name=\"u\"/><link name=\"v\"/><link name=\"t\"/>\
             <joint name=\"a\" type=\"continuous\"><parent link=\"b\"/><child link=\"u\"/><axis xyz=\"0 0 1\"/></joint>\
             <joint name=\"f\" type=\"continuous\"><parent link=\"u\"/><child link=\"v\"/><origin xyz=\"0.3 0 0\"/><axis xyz=\"0 2 1\"/>\
             {mimic}</joint>\
             <joint name=\"e\" type=\"fixed\"><parent link=\"v\"/><child link=\"t\"/><origin xyz=\"0.2 0.1 0\"/></joint></robot>"
        )
    };
    let chain = |mimic: &str| Robot::from_urdf(&urdf(mimic)).unwrap().chain(None, Some("t")).unwrap();
    let (held, free) = (chain("<mimic joint=\"a\" multiplier=\"0\" offset=\"0.7\"/>"), chain(""));
    assert_eq!((held.joints().len(), free.joints().len()), (1, 2));
    for q in [-2.0, 0.0, 1.3] {
        let [a, b] = [held.forward(&[q]).unwrap(), free.forward(&[q, 0.7]).unwrap()];
        assert!((a.to_homogeneous() - b.to_homogeneous()).norm() < 1e-14);
    }
}
