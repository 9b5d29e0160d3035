//! Random chains of a given geometry: rational lengths and rational unit axes, not aligned with the base or the tool.

use groebot_algebra::number::BigRational;
use groebot_robot::kinematics::{
    Chain, ChainParts, ExactRotation, ExactVector, Joint, JointKind, LengthUnit, Plane, Task, Tip, along_z,
};

/// A generator of small random numbers: SplitMix64.
pub struct Draw(u64);

impl Draw {
    pub fn new(seed: u64) -> Self {
        Draw(seed)
    }

    pub fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// A nonzero integer from -`bound` to `bound`.
    fn integer(&mut self, bound: i64) -> i64 {
        let magnitude = (self.next() % bound as u64) as i64 + 1;
        if self.next() & 1 == 0 { magnitude } else { -magnitude }
    }

    /// A nonzero length from -0.9 to 0.9.
    pub fn length(&mut self) -> BigRational {
        BigRational::new(self.integer(45).into(), 50.into())
    }

    pub fn point(&mut self) -> ExactVector {
        std::array::from_fn(|_| self.length())
    }

    pub fn rotation(&mut self) -> ExactRotation {
        let quaternion = std::array::from_fn(|_| BigRational::from_integer(self.integer(9).into()));
        ExactRotation::from_quaternion(&quaternion).expect("no part is zero")
    }

    /// A unit vector with rational coordinates.
    pub fn axis(&mut self) -> ExactVector {
        self.rotation().turn(&along_z())
    }

    /// A joint value: a length, or an angle away from special values.
    pub fn value(&mut self, kind: JointKind) -> f64 {
        let unit = (self.next() >> 11) as f64 / (1_u64 << 53) as f64;
        match kind {
            JointKind::Revolute => (2.0 * unit - 1.0) * 3.0,
            JointKind::Prismatic => unit - 0.5,
        }
    }
}

/// A relation between the axes of a chain.
#[derive(Clone, Copy, Debug)]
pub enum Shared {
    /// The axes of these joints, from first to last index, meet in one point.
    Point(usize, usize),
    /// The axes of these joints are parallel.
    Direction(usize, usize),
}

/// A chain of joints `R` and `P` with exactly these relations between its axes.
pub fn chain(kinds: &str, shared: &[Shared], task: Task, seed: u64) -> Chain {
    let mut draw = Draw::new(seed);
    let mut joints: Vec<Joint> = kinds.chars().enumerate().map(|(place, kind)| joint(&mut draw, place, kind)).collect();
    for group in shared {
        match *group {
            Shared::Point(first, last) => {
                let point = draw.point();
                for joint in &mut joints[first..=last] {
                    let along = draw.length();
                    joint.point = std::array::from_fn(|k| &point[k] + &joint.axis[k] * &along);
                }
            }
            Shared::Direction(first, last) => {
                let axis = draw.axis();
                for joint in &mut joints[first..=last] {
                    let sign = BigRational::from_integer(draw.integer(1).into());
                    joint.axis = axis.clone().map(|entry| entry * &sign);
                }
            }
        }
    }
    let tip = Tip { point: draw.point(), rotation: draw.rotation().matrix() };
    parts(joints, tip, task, draw.point())
}

/// A chain of parallel revolute (`R`) and in-plane prismatic (`P`) joints in the plane xy.
pub fn planar_chain(kinds: &str, task: Task, seed: u64) -> Chain {
    let mut draw = Draw::new(seed);
    let mut joints: Vec<Joint> = kinds.chars().enumerate().map(|(place, kind)| joint(&mut draw, place, kind)).collect();
    for joint in &mut joints {
        joint.axis = match joint.kind {
            JointKind::Revolute => along_z().map(|entry| entry * BigRational::from_integer(draw.integer(1).into())),
            JointKind::Prismatic => [draw.length(), draw.length(), BigRational::from_integer(0.into())],
        };
    }
    let tip = Tip { point: draw.point(), rotation: draw.rotation().matrix() };
    debug_assert_eq!(task.plane(), Some(Plane::Xy));
    parts(joints, tip, task, along_z())
}

fn joint(draw: &mut Draw, place: usize, kind: char) -> Joint {
    let kind = if kind == 'P' { JointKind::Prismatic } else { JointKind::Revolute };
    let symbol = (place + 1).to_string();
    Joint {
        mimic: None,
        name: format!("joint{symbol}"),
        symbol,
        kind,
        axis: draw.axis(),
        point: draw.point(),
        limits: None,
    }
}

fn parts(joints: Vec<Joint>, tip: Tip, task: Task, direction: ExactVector) -> Chain {
    let parts = ChainParts {
        name: "random".into(),
        description: None,
        source: None,
        length_unit: LengthUnit::Metre,
        joints,
        tip,
        task,
        direction,
        given: Vec::new(),
        order: None,
        choice: None,
        meant: None,
    };
    Chain::new(parts).expect("a chain")
}

/// The chain from tip to base: the inverse motions in reverse order, for tasks that specify the whole pose.
pub fn reversed(chain: &Chain) -> Chain {
    let mut parts = chain.parts().clone();
    parts.joints.reverse();
    Chain::new(parts).expect("a chain")
}
