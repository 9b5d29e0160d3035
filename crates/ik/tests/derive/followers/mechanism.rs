//! Mechanisms with followers, with their own kinematics.

use std::f64::consts::{PI, TAU};

use groebot_algebra::number::BigRational;
use groebot_ik::Watch;
use groebot_ik::derive::Derivation;
use groebot_robot::kinematics::{Chain, ChainParts, Joint, JointKind, Mimic, Task, Tip, along_z};
use groebot_robot::robots;
use nalgebra::{DMatrix, DVector, Isometry3, Point3, Rotation3, Unit, UnitQuaternion, Vector3};

/// The law of a follower: the index of its leader, the multiplier and the offset.
pub(super) type Law = Option<(usize, f64, f64)>;

/// A joint: whether it is revolute, its axis, a point of it in the zero configuration, its law.
pub(super) type Link = (bool, [f64; 3], [f64; 3], Law);

/// A mechanism with this file's own kinematics. By joint: whether it is revolute, its axis and a point of it in the zero configuration, and its law.
pub(super) struct Mechanism {
    pub joints: Vec<Link>,
    pub tip: [f64; 3],
    pub task: Task,
}

pub(super) fn exact(x: f64) -> BigRational {
    groebot_algebra::number::parse_rational(&x.to_string()).unwrap()
}

impl Mechanism {
    pub fn new(task: Task, tip: [f64; 3], joints: &[Link]) -> Self {
        Mechanism { joints: joints.to_vec(), tip, task }
    }

    pub fn chain(&self) -> Chain {
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

    pub fn independent(&self) -> Vec<usize> {
        (0..self.joints.len()).filter(|place| self.joints[*place].3.is_none()).collect()
    }

    /// The values of all joints from those of the independent ones.
    pub fn whole(&self, values: &[f64]) -> Vec<f64> {
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
    pub fn seen(&self, q: &[f64]) -> Vec<f64> {
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

    pub fn missed(&self, target: &[f64], values: &[f64]) -> DVector<f64> {
        DVector::from_vec(self.seen(&self.whole(values))) - DVector::from_row_slice(target)
    }

    pub fn slopes(&self, target: &[f64], values: &[f64]) -> DMatrix<f64> {
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

    pub fn sigma(&self, target: &[f64], values: &[f64]) -> f64 {
        self.slopes(target, values).svd(false, false).singular_values.min()
    }

    /// The joint vectors that Newton's method finds from many starts, angles in (-pi, pi].
    pub fn searched(&self, target: &[f64], random: &mut Random, starts: usize) -> Vec<Vec<f64>> {
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

    pub fn drawn(&self, random: &mut Random) -> Vec<f64> {
        let value = |place: usize| random.next(if self.joints[place].0 { PI } else { 0.3 });
        self.independent().into_iter().map(value).collect()
    }

    pub fn wrapped(&self, values: &[f64]) -> Vec<f64> {
        let wrap = |(place, value): (usize, &f64)| {
            if self.joints[place].0 { value - TAU * (value / TAU).round() } else { *value }
        };
        self.independent().into_iter().zip(values).map(wrap).collect()
    }

    pub fn apart(&self, a: &[f64], b: &[f64]) -> f64 {
        let one = |((place, a), b): ((usize, &f64), &f64)| {
            if self.joints[place].0 { (2.0 * ((a - b) / 2.0).sin()).abs() } else { (a - b).abs() }
        };
        self.independent().into_iter().zip(a).zip(b).map(one).fold(0.0, f64::max)
    }

    /// The solutions of the derived solver for the independent joints. Checks that followers obey their laws and that all reach the target by this file's
    /// kinematics.
    pub fn solved(&self, derived: &Derivation, target: &[f64]) -> Vec<Vec<f64>> {
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
    pub fn agrees(&self, targets: usize, starts: usize) -> Vec<usize> {
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
pub(super) struct Random(pub u64);

impl Random {
    /// A number in (-limit, limit).
    pub fn next(&mut self, limit: f64) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        limit * (2.0 * ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64 - 1.0)
    }
}
