//! A chain over Q: forward kinematics at rational joint values, and the equations of all joint vectors with the same target.
//!
//! The base frame is moved so that the numbers become simple. If the task uses the whole pose of the last link, any point and frame of it may replace the tip.
//! So a base rotated by 0.3 rad, or a tool, does not change the number of solutions.
//!
//! Rodrigues' formula is used with an axis `w` of any length, `n = |w|^2`. The unknowns of a revolute joint are `c = cos q` and `s = sin q / sqrt(n)` with `c^2
//! + n s^2 = 1`. That of a prismatic one is `d / sqrt(n)`. No square root is needed.

use num_traits::{One, ToPrimitive, Zero};

use super::form::{Form, Forms, constant, cross, dot, sum};
use groebot_algebra::number::BigRational;
use groebot_algebra::poly::rational_root;
use groebot_robot::kinematics::{Chain, ExactVector, Joint, JointKind, Task};
use groebot_robot::spatial::exact::vector;

/// The values of a joint's unknowns.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Value {
    /// `c` and `s`.
    Revolute([Form; 2]),
    /// `d / sqrt(n)`.
    Prismatic(Form),
}

/// The type of an object that the joints move.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Moved {
    Point,
    Direction,
}

/// The direction of a product of joint motions.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Sense {
    Forward,
    Backward,
}

/// One joint over Q.
struct Axis {
    kind: JointKind,
    direction: ExactVector,
    point: ExactVector,
    square: BigRational,
}

/// A chain over Q.
pub(super) struct ExactChain {
    axes: Vec<Axis>,
    /// The objects of the task, in the zero configuration.
    objects: Vec<(Moved, ExactVector)>,
}

/// The positions of a task's objects: one vector each.
pub(super) type Reached = Vec<ExactVector>;

impl ExactChain {
    pub fn new(chain: &Chain) -> Self {
        let frame = Frame::of(chain);
        let axis = |joint: &Joint| {
            let direction = frame.direction(&unit(&joint.axis).unwrap_or_else(|| joint.axis.clone()));
            Axis { kind: joint.kind, square: square(&direction), direction, point: frame.point(&joint.point) }
        };
        ExactChain { axes: chain.joints().iter().map(axis).collect(), objects: objects(chain, &frame) }
    }

    pub fn joints(&self) -> usize {
        self.axes.len()
    }

    /// Whether joint `index` is revolute.
    pub fn turns(&self, index: usize) -> bool {
        self.axes[index].kind == JointKind::Revolute
    }

    /// The joint at the rational point of its circle (or line) with parameter `t`: `t = tan(q/2) / sqrt(n)`, or `d / sqrt(n)`.
    pub fn value(&self, index: usize, t: &BigRational) -> Value {
        if !self.turns(index) {
            return Value::Prismatic(Form::constant(t.clone()));
        }
        let square = &self.axes[index].square * t * t;
        let below = BigRational::one() + &square;
        let (c, s) = ((BigRational::one() - square) / &below, (t + t) / below);
        Value::Revolute([Form::constant(c), Form::constant(s)])
    }

    /// The unknowns of joint `index`. The first of them has the index `first`.
    pub fn unknown(&self, index: usize, first: usize) -> Value {
        if !self.turns(index) {
            return Value::Prismatic(Form::unknown(first));
        }
        Value::Revolute([Form::unknown(first), Form::unknown(first + 1)])
    }

    /// `n` of joint `index`.
    pub fn square(&self, index: usize) -> &BigRational {
        &self.axes[index].square
    }

    /// The joint value as a double: radians, or the chain's length unit.
    pub fn double(&self, index: usize, value: &Value) -> f64 {
        let root = number(&self.axes[index].square).sqrt();
        match value {
            Value::Revolute([c, s]) => (root * number(&s.value())).atan2(number(&c.value())),
            Value::Prismatic(d) => root * number(&d.value()),
        }
    }

    /// The positions of the task's objects at known joint values.
    pub fn reached(&self, values: &[Value]) -> Reached {
        let order: Vec<usize> = (0..self.joints()).collect();
        let place = |(kind, zero): &(Moved, ExactVector)| {
            self.moved(&order, values, Sense::Forward, *kind, constant(zero)).each_ref().map(Form::value)
        };
        self.objects.iter().map(place).collect()
    }

    /// The equations `E_k^-1 .. E_1^-1 (reached) = E_(k+1) .. E_n (zero)` of all objects, for both cuts next to the middle.
    pub fn equations(&self, reached: &Reached, values: &[Value]) -> Vec<Form> {
        let n = self.joints();
        let cuts = if n.is_multiple_of(2) { vec![n / 2] } else { vec![n / 2, n / 2 + 1] };
        cuts.into_iter().flat_map(|cut| self.cut(cut, reached, values)).filter(|f| !f.is_zero()).collect()
    }

    fn cut(&self, cut: usize, reached: &Reached, values: &[Value]) -> Vec<Form> {
        let first: Vec<usize> = (0..cut).collect();
        let second: Vec<usize> = (cut..self.joints()).collect();
        let mut equations = Vec::new();
        for ((kind, zero), there) in self.objects.iter().zip(reached) {
            let left = self.moved(&first, values, Sense::Backward, *kind, constant(there));
            let right = self.moved(&second, values, Sense::Forward, *kind, constant(zero));
            equations.extend(left.iter().zip(&right).map(|(left, right)| left.minus(right)));
        }
        equations
    }

    /// `x` moved by the joints `joints` (ascending): from the last to the first, or by the inverse motions from the first to the last.
    fn moved(&self, joints: &[usize], values: &[Value], sense: Sense, kind: Moved, x: Forms) -> Forms {
        let step = |x: Forms, &joint: &usize| self.axes[joint].apply(&values[joint], sense, kind, x);
        match sense {
            Sense::Forward => joints.iter().rev().fold(x, step),
            Sense::Backward => joints.iter().fold(x, step),
        }
    }
}

impl Axis {
    fn apply(&self, value: &Value, sense: Sense, kind: Moved, x: Forms) -> Forms {
        let sign = if sense == Sense::Forward { BigRational::one() } else { -BigRational::one() };
        match value {
            Value::Prismatic(d) if kind == Moved::Point => {
                sum(&x, &Form::default().with_multiple(d, &sign), &constant(&self.direction))
            }
            Value::Prismatic(_) => x,
            Value::Revolute([c, s]) => {
                let s = Form::default().with_multiple(s, &sign);
                let centre = if kind == Moved::Point { constant(&self.point) } else { Forms::default() };
                let z = [0, 1, 2].map(|i| x[i].minus(&centre[i]));
                let along = dot(&self.direction, &z);
                let kept =
                    [0, 1, 2].map(|i| Form::default().with_multiple(&along, &(&self.direction[i] / &self.square)));
                let across = [0, 1, 2].map(|i| z[i].minus(&kept[i]));
                let still = [0, 1, 2].map(|i| centre[i].plus(&kept[i]));
                sum(&sum(&still, c, &across), &s, &cross(&self.direction, &z))
            }
        }
    }
}

/// The objects of the task of `chain` in the zero configuration, in `frame`.
fn objects(chain: &Chain, frame: &Frame) -> Vec<(Moved, ExactVector)> {
    let tip = chain.tip();
    let points = |point: &ExactVector| vec![(Moved::Point, frame.point(point))];
    let columns = || vector::identity().map(|direction| (Moved::Direction, direction)).to_vec();
    let aimed = chain.direction();
    let aim = || {
        let entry = |row: &ExactVector| vector::dot(row, aimed);
        vec![(Moved::Direction, frame.direction(&tip.rotation.each_ref().map(entry)))]
    };
    match chain.task() {
        Task::Position | Task::PlanarPosition { .. } => points(&tip.point),
        Task::Pose | Task::PlanarPose { .. } => {
            let last = chain.joints().iter().rfind(|joint| joint.kind == JointKind::Revolute);
            [points(last.map_or(&tip.point, |joint| &joint.point)), columns()].concat()
        }
        // Tasks without the whole pose need the tip itself.
        Task::Ray | Task::PositionPitchRoll | Task::PositionYaw { .. } => [points(&tip.point), aim()].concat(),
        Task::Direction => aim(),
        Task::Rotation => columns(),
    }
}

/// A frame over Q: its origin, and its unit axes.
struct Frame {
    origin: ExactVector,
    axes: [ExactVector; 3],
}

impl Frame {
    /// The frame at the first revolute axis, along two perpendicular axes of `chain` with directions of rational length. Without such axes, it is parallel to
    /// the base frame.
    fn of(chain: &Chain) -> Frame {
        let joints = chain.joints();
        let origin = joints.iter().find(|joint| joint.kind == JointKind::Revolute);
        let origin = origin.map_or_else(|| chain.tip().point.clone(), |joint| joint.point.clone());
        let units: Vec<ExactVector> = joints.iter().filter_map(|joint| unit(&joint.axis)).collect();
        let pairs = units.iter().enumerate().flat_map(|(i, a)| units[i + 1..].iter().map(move |b| (a, b)));
        let pair = pairs.into_iter().find(|(a, b)| vector::dot(a, b).is_zero());
        let axes = pair.map_or_else(vector::identity, |(a, b)| [a.clone(), b.clone(), vector::cross(a, b)]);
        Frame { origin, axes }
    }

    fn direction(&self, v: &ExactVector) -> ExactVector {
        self.axes.each_ref().map(|axis| vector::dot(axis, v))
    }

    fn point(&self, p: &ExactVector) -> ExactVector {
        self.direction(&vector::sub(p, &self.origin))
    }
}

fn square(v: &ExactVector) -> BigRational {
    vector::dot(v, v)
}

/// The vector scaled to length one. `None` if its length is irrational.
fn unit(v: &ExactVector) -> Option<ExactVector> {
    let length = rational_root(&square(v)).filter(|length| !length.is_zero())?;
    Some(v.each_ref().map(|x| x / &length))
}

fn number(exact: &BigRational) -> f64 {
    exact.to_f64().unwrap_or(f64::NAN)
}
