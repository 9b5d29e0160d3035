//! Random joints with rational coordinates: axes of any direction, length and sign, and arbitrary points.

use groebot_algebra::number::BigRational;
use groebot_robot::kinematics::{
    Chain, ChainParts, ExactRotation, ExactVector, Joint, JointKind, LengthUnit, Task, Tip, along_z,
};

/// A stream of small random numbers, by SplitMix64 (Steele, Lea and Flood 2014).
pub struct Draw(u64);

/// A joint: its type, axis and a point.
#[derive(Clone)]
pub struct Placed {
    kind: JointKind,
    axis: [i64; 3],
    point: [i64; 3],
}

impl Placed {
    /// Makes the joint prismatic.
    pub fn slides(&mut self) {
        self.kind = JointKind::Prismatic;
    }
}

impl Draw {
    pub fn new(seed: u64) -> Self {
        Draw(seed)
    }

    /// An integer from `low` to `high`.
    fn integer(&mut self, low: i64, high: i64) -> i64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        low + ((z ^ (z >> 31)) % (high - low + 1) as u64) as i64
    }

    /// A point within a cube of two units.
    fn point(&mut self) -> [i64; 3] {
        [0; 3].map(|_| self.integer(-100, 100))
    }

    /// An axis of small integers. Its norm is in general irrational.
    fn axis(&mut self) -> [i64; 3] {
        loop {
            let axis = [0; 3].map(|_| self.integer(-5, 5));
            if axis.iter().filter(|x| **x != 0).count() >= 2 {
                return axis;
            }
        }
    }

    /// Revolute (`R`) or prismatic (`P`) joints with arbitrary axes.
    pub fn anywhere(&mut self, kinds: &str) -> Vec<Placed> {
        kinds.chars().map(|kind| Placed { kind: kind_of(kind), axis: self.axis(), point: self.point() }).collect()
    }

    /// `count` revolute joints whose axes meet in one point. Neighbouring axes are not parallel.
    pub fn meeting(&mut self, count: usize) -> Vec<Placed> {
        let centre = self.point();
        let mut joints: Vec<Placed> = Vec::new();
        while joints.len() < count {
            let axis = self.axis();
            if joints.last().is_some_and(|last| !apart(&last.axis, &axis)) {
                continue;
            }
            let along = self.integer(-12, 12);
            let point = [0, 1, 2].map(|k| centre[k] + along * axis[k]);
            joints.push(Placed { kind: JointKind::Revolute, axis, point });
        }
        joints
    }

    /// `count` revolute joints with parallel axes, some of them in the opposite direction.
    pub fn parallel(&mut self, count: usize) -> Vec<Placed> {
        let axis = self.axis();
        let joint = |draw: &mut Draw| {
            let sign = if draw.integer(0, 1) == 0 { 1 } else { -1 };
            Placed { kind: JointKind::Revolute, axis: axis.map(|x| sign * x), point: draw.point() }
        };
        (0..count).map(|_| joint(self)).collect()
    }

    /// Planar joints in xy: `R` rotates about z, `P` is prismatic in the plane.
    pub fn planar(&mut self, kinds: &str) -> Vec<Placed> {
        let joint = |(draw, kind): (&mut Draw, char)| {
            let sign = if draw.integer(0, 1) == 0 { 1 } else { -1 };
            let [x, y, _] = draw.axis();
            let axis = if kind == 'P' { [x, y + 7, 0] } else { [0, 0, sign] };
            Placed { kind: kind_of(kind), axis, point: draw.point() }
        };
        kinds.chars().map(|kind| joint((self, kind))).collect()
    }

    /// A chain of these joints. The tip has an arbitrary position, rotation and direction.
    pub fn chain(&mut self, joints: &[Placed], task: Task, given: &[usize]) -> Chain {
        let joint = |(place, placed): (usize, &Placed)| Joint {
            mimic: None,
            name: format!("joint{}", place + 1),
            symbol: (place + 1).to_string(),
            kind: placed.kind,
            axis: hundredths(&placed.axis),
            point: hundredths(&placed.point),
            limits: None,
        };
        let quaternion = [3, 2, 3, 2].map(|bound| BigRational::from_integer(self.integer(1, bound).into()));
        let rotation = ExactRotation::from_quaternion(&quaternion).expect("no part is zero");
        let direction = if task.aims() { hundredths(&self.axis()) } else { along_z() };
        Chain::new(ChainParts {
            name: "random".into(),
            description: None,
            source: None,
            length_unit: LengthUnit::Metre,
            joints: joints.iter().enumerate().map(joint).collect(),
            tip: Tip { point: hundredths(&self.point()), rotation: rotation.matrix() },
            task,
            direction,
            given: given.iter().map(|place| format!("joint{}", place + 1)).collect(),
            order: None,
            choice: None,
            meant: None,
        })
        .expect("a chain")
    }
}

/// Whether the unknown joints move the tip independently, as the task measures it, at generic joint values. Prismatic joints in one plane for a point in space
/// do not, nor do four parallel axes for a pose. Such chains have self-motions everywhere.
pub fn moves_freely(chain: &Chain) -> bool {
    let given = chain.given();
    let unknown: Vec<usize> = (0..chain.joints().len()).filter(|joint| !given.contains(joint)).collect();
    let q: Vec<f64> = (0..chain.joints().len()).map(|joint| 0.3 + 0.7 * joint as f64).collect();
    let twists = chain.body_jacobian(&q).expect("a value for each joint").select_columns(&unknown);
    let seen = match chain.task() {
        Task::Position | Task::PlanarPosition { .. } => twists.rows(0, 3).into_owned(),
        Task::Direction | Task::Rotation => twists.rows(3, 3).into_owned(),
        Task::Pose | Task::PlanarPose { .. } | Task::Ray | Task::PositionPitchRoll | Task::PositionYaw { .. } => {
            twists.rows(0, 6).into_owned()
        }
    };
    let values = seen.singular_values();
    seen.nrows() >= seen.ncols() && values.min() > 1e-9 * values.max()
}

/// Same chain, but with the task of a ray along the axis of its last joint.
pub fn along_the_last_axis(chain: &Chain) -> Chain {
    let axis = &chain.joints()[chain.joints().len() - 1].axis;
    let rotation = &chain.tip().rotation;
    let direction = [0, 1, 2].map(|j| (0..3).map(|i| &rotation[i][j] * &axis[i]).sum());
    chain.with_task(Task::Ray, direction, Vec::new()).expect("the task of an arm")
}

fn kind_of(letter: char) -> JointKind {
    if letter == 'P' { JointKind::Prismatic } else { JointKind::Revolute }
}

fn hundredths(vector: &[i64; 3]) -> ExactVector {
    vector.map(|x| BigRational::new(x.into(), 100.into()))
}

/// Whether the angle between two directions is at least some degrees.
fn apart(a: &[i64; 3], b: &[i64; 3]) -> bool {
    let dot = |a: &[i64; 3], b: &[i64; 3]| a.iter().zip(b).map(|(x, y)| x * y).sum::<i64>();
    10 * dot(a, b).pow(2) < 9 * dot(a, a) * dot(b, b)
}
