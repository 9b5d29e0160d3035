//! The indices of inputs, parameters and unknowns in the program of a [`Mechanism`] ([`Layout`]).

use num_traits::ToPrimitive;

use super::emit::{Emitted, Emitter};
use super::ray;
use crate::Result;
use crate::derive::closure::{self, Arithmetic, Assignment, Mechanism, ScrewJoint, Target, UprightLoop};
use crate::derive::equations::assemble::Assembler;
use crate::solver::{
    Condition, Following, GivenJoint, Input, Instruction, JointValue, Operand, Operation, ParameterRule, Rule, Unit,
};
use groebot_algebra::number::BigRational;
use groebot_robot::kinematics::upright::GIVEN;
use groebot_robot::kinematics::{BaseAxis, JointKind, LengthUnit, Quantity, TargetNumber, Task};

/// The names and indices of all numbers of a program.
pub(super) struct Layout {
    pub inputs: Vec<Input>,
    pub given_joints: Vec<GivenJoint>,
    pub conditions: Vec<Condition>,
    pub parameters: Vec<ParameterRule>,
    pub unknowns: Vec<String>,
    /// By joint: its unknowns.
    pub joints: Vec<JointValue>,
    /// For a ray, the unknowns that contain two unit vectors perpendicular to it and to each other.
    pub across: Option<[[usize; 3]; 2]>,
    /// By joint: the parameters with its value if it is given: a cosine and a sine, or a length.
    pub given: Vec<Vec<usize>>,
    /// For a target with pitch and roll, the parameters with the cosine and the sine of the roll, and of the pitch.
    pub pitch_roll: Option<[usize; 4]>,
    /// For such a target, the unknowns with the cosine and the sine of the arm's first joint.
    pub swing: Option<[usize; 2]>,
    /// The index of the first parameter of the target.
    pub first: usize,
}

impl Layout {
    /// The layout for `mechanism`, with lengths in `unit`.
    pub fn new(mechanism: &Mechanism, unit: LengthUnit) -> Self {
        let mut layout = Layout {
            inputs: Vec::new(),
            given_joints: Vec::new(),
            conditions: Vec::new(),
            parameters: Vec::new(),
            unknowns: Vec::new(),
            joints: Vec::new(),
            across: None,
            given: vec![Vec::new(); mechanism.joints().len()],
            pitch_roll: None,
            swing: None,
            first: 0,
        };
        layout.target(mechanism, unit);
        for joint in mechanism.joints() {
            let value = match joint.kind {
                JointKind::Revolute => JointValue::Angle {
                    cosine: layout.unknown(&format!("c{}", joint.symbol)),
                    sine: layout.unknown(&format!("s{}", joint.symbol)),
                },
                JointKind::Prismatic => JointValue::Plain(layout.unknown(&format!("d{}", joint.symbol))),
            };
            layout.joints.push(value);
        }
        layout.swing = mechanism.upright_loop().map(|upright_loop| {
            let symbol = &upright_loop.plain.joints()[0].symbol;
            ["c", "s"].map(|letter| layout.unknown(&format!("{letter}{symbol}")))
        });
        layout.across = mechanism
            .hidden()
            .filter(|_| mechanism.upright_loop().is_none())
            .map(|_| ["u", "v"].map(|letter| ["x", "y", "z"].map(|axis| layout.unknown(&format!("{letter}{axis}")))));
        layout.givens(mechanism, unit);
        layout
    }

    /// Adds the inputs and parameters of the given joints. Those that follow others come last.
    fn givens(&mut self, mechanism: &Mechanism, length: LengthUnit) {
        if let Some(upright_loop) = mechanism.upright_loop() {
            return self.upright_givens(mechanism, upright_loop, length);
        }
        let (followers, inputs): (Vec<usize>, Vec<usize>) =
            mechanism.given().iter().partition(|&&index| mechanism.joints()[index].follows.is_some());
        let first = self.inputs.len();
        self.give_inputs(mechanism, &inputs, length);
        for index in followers {
            let joint = &mechanism.joints()[index];
            let law = joint.follows.and_then(|(leader, [factor, offset])| {
                let input = first + inputs.iter().position(|&input| input == leader)?;
                Some(Following { input, factor, offset })
            });
            if let Some(law) = law {
                self.give(joint, index, [Rule::CosineFollowing(law), Rule::SineFollowing(law), Rule::Following(law)]);
            }
        }
    }

    /// Adds the inputs with the values of given joints, and their parameters.
    fn give_inputs(&mut self, mechanism: &Mechanism, given: &[usize], length: LengthUnit) {
        for &index in given {
            let joint = &mechanism.joints()[index];
            let input = self.inputs.len();
            let quantity = if joint.is_revolute() { Quantity::Angle } else { Quantity::Length };
            let unit = Unit::of(quantity, length);
            self.inputs.push(Input { name: joint.name.clone(), unit });
            self.given_joints.push(GivenJoint { joint: index, input });
            self.give(joint, index, [Rule::Cosine(input), Rule::Sine(input), Rule::Input(input)]);
        }
    }

    /// Adds the given joints of a loop that replaces a target with pitch and roll. The loop's own given joints (pitch, roll, distance from the first axis,
    /// height) get their values from the target.
    fn upright_givens(&mut self, mechanism: &Mechanism, upright_loop: &UprightLoop, length: LengthUnit) {
        let (own, of_target) = mechanism.given().split_at(mechanism.given().len() - GIVEN.len());
        self.give_inputs(mechanism, own, length);
        let turn = |input| [Rule::Cosine(input), Rule::Sine(input), Rule::Input(input)];
        let unused = Rule::Root { code: Vec::new(), value: Operand::Constant(0.0) };
        let layout = mechanism.task().layout();
        let number = |number| turn(layout.place(number).unwrap_or(0));
        let height = number(TargetNumber::Position(BaseAxis::Z));
        let distance = [unused.clone(), unused, radius(upright_loop)];
        let rules = [number(TargetNumber::Roll), number(TargetNumber::Pitch), distance, height];
        for (&index, rules) in of_target.iter().zip(rules) {
            self.give(&mechanism.joints()[index], index, rules);
        }
        let of = |k: usize| of_target.get(k).map(|&index| self.given[index].clone()).unwrap_or_default();
        if let (&[cr, sr], &[cp, sp]) = (&of(0)[..], &of(1)[..]) {
            self.pitch_roll = Some([cr, sr, cp, sp]);
        }
    }

    /// Adds the parameters of a given joint, with the rules for its cosine, sine and value.
    fn give(&mut self, joint: &ScrewJoint, index: usize, [cosine, sine, value]: [Rule; 3]) {
        let rules = if joint.is_revolute() { vec![('c', cosine), ('s', sine)] } else { vec![('d', value)] };
        for (letter, rule) in rules {
            self.given[index].push(self.parameters.len());
            self.parameters.push(ParameterRule { name: format!("{letter}{}", joint.symbol), rule });
        }
    }

    /// Adds the inputs and parameters of the task.
    fn target(&mut self, mechanism: &Mechanism, length: LengthUnit) {
        let layout = mechanism.task().layout();
        for number in layout.numbers() {
            let (input, name) = (self.inputs.len(), number.name());
            self.inputs.push(Input { name: name.clone(), unit: Unit::of(number.quantity(), length) });
            match number {
                // The loop has joints for these.
                TargetNumber::Pitch | TargetNumber::Roll => {}
                TargetNumber::PlaneAngle(_) | TargetNumber::Yaw(_) => {
                    self.parameter(format!("c{name}"), Rule::Cosine(input));
                    self.parameter(format!("s{name}"), Rule::Sine(input));
                }
                _ => self.parameter(name, Rule::Input(input)),
            }
        }
        let rotation = layout.rotation().map(Condition::Rotation);
        self.conditions = rotation.or(layout.direction().map(Condition::Unit)).into_iter().collect();
    }

    fn parameter(&mut self, name: String, rule: Rule) {
        self.parameters.push(ParameterRule { name, rule });
    }

    /// Removes the unknowns of all joints after the first `count`.
    pub fn keep_joints(&mut self, count: usize) {
        let last = self.joints[..count].last().map_or(0, |value| match *value {
            JointValue::Angle { cosine, sine } => cosine.max(sine) + 1,
            JointValue::Plain(unknown) => unknown + 1,
        });
        self.unknowns.truncate(last);
    }

    /// Adds an unknown and returns its index.
    pub fn unknown(&mut self, name: &str) -> usize {
        self.unknowns.push(name.to_owned());
        self.unknowns.len() - 1
    }

    /// The values that relations use: those of the target and of the joints in `known`. Other joints remain unknown.
    pub fn assignment(
        &self,
        mechanism: &Mechanism,
        known: &[usize],
        assembler: &mut Assembler,
    ) -> Result<Assignment<Emitted>> {
        let emitter = &mut Emitter(assembler);
        let parameters = match self.across {
            Some(across) => ray::turned(mechanism, across, emitter),
            None if mechanism.upright_loop().is_some() => closed(Emitted::integer),
            None => {
                let square: BigRational = mechanism.aim().iter().map(|entry| entry * entry).sum();
                let factor =
                    if mechanism.task() == Task::Direction { square.to_f64().unwrap_or(1.0).sqrt() } else { 1.0 };
                let parameter = |index| Operand::Parameter(self.first + index);
                let value = |index| Emitted::code(parameter(index)).times(factor);
                let values: Vec<Emitted> = (0..mechanism.parameters().len()).map(value).collect();
                match mechanism.task() {
                    Task::PositionYaw { axis } => turned_since_zero(mechanism, axis, values, emitter),
                    _ => values,
                }
            }
        };
        let target = Target::new(mechanism, &parameters, emitter)?;
        let joints = (0..self.joints.len()).map(|joint| {
            if known.contains(&joint) { self.known(mechanism, joint) } else { closure::JointValue::Unknown }
        });
        Ok(Assignment { joints: joints.collect(), target })
    }

    /// The values of a joint in relations: c and s / sqrt n, or d / sqrt n.
    fn known(&self, mechanism: &Mechanism, joint: usize) -> closure::JointValue<Emitted> {
        let square = &mechanism.joints()[joint].square;
        let factor = 1.0 / square.to_f64().unwrap_or(1.0).sqrt();
        let scaled = |unknown: usize| Emitted::code(Operand::Unknown(unknown)).times(factor);
        match self.joints[joint] {
            JointValue::Angle { cosine, sine } => {
                closure::JointValue::Angle { cosine: Emitted::code(Operand::Unknown(cosine)), sine: scaled(sine) }
            }
            JointValue::Plain(unknown) => closure::JointValue::Length(scaled(unknown)),
        }
    }

    /// Same as [`Layout::assignment`], but with magnitudes. Cosines, sines and rotation entries count as one, lengths as the greatest length.
    pub fn sizes(
        &self,
        mechanism: &Mechanism,
        known: &[usize],
        assembler: &mut Assembler,
    ) -> Result<Assignment<Emitted>> {
        let emitter = &mut super::emit::Sizes(assembler);
        let lengths = mechanism.seen().layout().lengths();
        let size = |index: usize| if index < lengths { Emitted::code(Operand::Magnitude) } else { Emitted::integer(1) };
        let parameters: Vec<Emitted> = match mechanism.upright_loop() {
            Some(_) => closed(Emitted::integer),
            None => (0..mechanism.parameters().len()).map(size).collect(),
        };
        let target = Target::new(mechanism, &parameters, emitter)?;
        let joints = (0..self.joints.len()).map(|joint| match self.joints[joint] {
            _ if !known.contains(&joint) => closure::JointValue::Unknown,
            JointValue::Angle { .. } => {
                closure::JointValue::Angle { cosine: Emitted::integer(1), sine: Emitted::integer(1) }
            }
            JointValue::Plain(unknown) => {
                closure::JointValue::Length(Emitted::code(emitter.0.abs(Operand::Unknown(unknown))))
            }
        });
        let joints = joints.collect();
        Ok(Assignment { joints, target })
    }
}

/// The numbers of a position and an angle about `axis`. The angle's cosine and sine are replaced by those of the rotation since the zero configuration.
fn turned_since_zero(
    mechanism: &Mechanism,
    axis: BaseAxis,
    values: Vec<Emitted>,
    emitter: &mut Emitter<'_>,
) -> Vec<Emitted> {
    let [across, up] = axis.across().map(|k| mechanism.aim()[k].to_f64().unwrap_or(0.0));
    let length = across.hypot(up);
    let [position @ .., c, s] = &values[..] else { return values };
    let turns = [(across, c, up, s), (across, s, -up, c)].map(|(a, x, b, y)| {
        let (first, second) = (x.times(a / length), y.times(b / length));
        emitter.add(&first, &second)
    });
    position.iter().cloned().chain(turns).collect()
}

/// The target numbers of a closed loop: the identity pose.
fn closed(integer: impl Fn(i32) -> Emitted) -> Vec<Emitted> {
    let rotation = (0..9).map(|entry| i32::from(entry / 3 == entry % 3));
    [0; 3].into_iter().chain(rotation).map(integer).collect()
}

/// The rule for the distance of the target from the first axis. The first two parameters are its position seen from above.
fn radius(upright_loop: &UprightLoop) -> Rule {
    let register = Operand::Register;
    let [x, y] = upright_loop.upright.axis.each_ref().map(|x| Operand::Constant(x.to_f64().unwrap_or(0.0)));
    let operations = [
        Operation::Sub(Operand::Parameter(0), x),
        Operation::Sub(Operand::Parameter(1), y),
        Operation::Mul(register(0), register(0)),
        Operation::Mul(register(1), register(1)),
        Operation::Add(register(2), register(3)),
    ];
    let code = operations.into_iter().enumerate().map(|(target, operation)| Instruction { target, operation });
    Rule::Root { code: code.collect(), value: register(4) }
}
