//! A chain in exact numbers, as input of the recursions. Main type: [`ExactModel`].

use std::sync::Arc;

use num_traits::Zero;

use super::direction::Direction;
use super::number::{Exact, Setting, root_name};
use crate::dynamics::recursions::{Body, Frame, Freedom, Mass, Place, Scalar, Tree};
use crate::kinematics::{Chain, Joint, JointKind};
use crate::spatial::exact::ExactVector;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::BigRational;

/// The names of a body's ten inertial parameters: the mass, the first moments, the inertia tensor.
pub(crate) const NUMBERS: [&str; 10] = ["m", "mx", "my", "mz", "Ixx", "Ixy", "Iyy", "Ixz", "Iyz", "Izz"];

/// A chain whose inertial parameters are symbols or numbers. The frame of each body has its origin at the joint's
/// point, and at the zero configuration the axes of the base. The recursions use their own frames.
#[derive(Clone, Debug)]
pub struct ExactModel {
    pub(super) setting: Arc<Setting>,
    /// Whether the inertial parameters are symbols. Then they are the first variables.
    pub(super) has_symbols: bool,
    pub(super) tree: Tree<Exact>,
    pub(super) joints: Vec<ExactJoint>,
    /// The direction of gravity. Its magnitude is `g`.
    pub(super) down: [Exact; 3],
    /// Gravity as given.
    pub(super) given_gravity: ExactVector,
}

/// A joint of an exact model.
#[derive(Clone, Debug)]
pub(super) struct ExactJoint {
    pub name: String,
    pub kind: JointKind,
    /// The unit vector of its axis in the base frame at the zero configuration, and a point on it.
    pub axis: [Exact; 3],
    pub point: [Exact; 3],
    /// The inertial parameters of its body, in the body's frame.
    pub mass: Mass<Exact>,
    /// The variables of its value: a cosine and a sine, or a displacement; and the variable of its velocity.
    pub value: Vec<String>,
    pub rate: String,
}

/// Inertial parameters of a chain's bodies.
#[derive(Clone, Copy, Debug)]
pub enum Masses<'a> {
    /// Ten symbols for each body: `m1`, `mx1` and so on.
    Symbols,
    /// Ten numbers for each body, in the frames of [`ExactModel`].
    Numbers(&'a [[BigRational; 10]]),
}

impl ExactModel {
    /// Builds the model of a chain under gravity, given in the base frame. `most` is the maximum number of terms of a
    /// sum.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for axes and gravity vectors whose squared lengths have large prime factors, and for
    /// mimic joints; [`ErrorKind::DuplicateName`] where a joint's symbol gives a name that is already used.
    pub fn new(chain: &Chain, masses: Masses<'_>, gravity: &ExactVector, most: usize) -> Result<Self> {
        let directions: Vec<Direction> =
            chain.joints().iter().map(|joint| Direction::of(&joint.axis, &joint.name)).collect::<Result<_>>()?;
        let down = Direction::of(gravity, "gravity")?;
        let mut primes: Vec<u32> = directions.iter().chain([&down]).flat_map(Direction::primes).collect();
        primes.sort_unstable();
        primes.dedup();
        let setting = setting(chain, masses, &primes, most)?;
        let place = |(at, (joint, direction)): (usize, (&Joint, &Direction))| {
            if joint.mimic.is_some() {
                let text = format!(
                    "joint `{}` is a mimic joint; choose links with independent joints between them",
                    joint.name
                );
                return Err(Error::new(ErrorKind::Unsupported, text));
            }
            let numbers = match masses {
                Masses::Symbols => NUMBERS.map(|number| setting.variable(&format!("{number}{}", joint.symbol))),
                Masses::Numbers(numbers) => numbers[at].clone().map(Exact::from),
            };
            Ok(ExactJoint {
                name: joint.name.clone(),
                kind: joint.kind,
                axis: direction.unit(&setting),
                point: joint.point.clone().map(Exact::from),
                mass: Mass::of(numbers),
                value: joint.unknowns(),
                rate: rate_name(joint),
            })
        };
        let joints: Vec<_> = chain.joints().iter().zip(&directions).enumerate().map(place).collect::<Result<_>>()?;
        let frames: Vec<Frame<Exact>> = joints
            .iter()
            .zip(&directions)
            .map(|(joint, direction)| Frame { rotation: direction.upright(&setting), position: joint.point.clone() })
            .collect();
        let body = |(at, joint): (usize, &ExactJoint)| {
            let parent = at.checked_sub(1);
            let frame = parent.map_or_else(|| frames[at].clone(), |up| frames[up].inverse().then(&frames[at]));
            let freedom = if joint.kind == JointKind::Revolute { Freedom::Turn } else { Freedom::Slide };
            let turned = Frame { rotation: frames[at].rotation.clone(), position: Exact::zeros() };
            Body { parent, freedom, frame, mass: joint.mass.inward(&turned) }
        };
        let bodies = joints.iter().enumerate().map(body).collect();
        let tree = Tree { base: Mass::zero(), bodies, order: (0..joints.len()).collect() };
        let down = down.unit(&setting);
        setting.check()?;
        Ok(ExactModel {
            setting,
            has_symbols: matches!(masses, Masses::Symbols),
            tree,
            joints,
            down,
            given_gravity: gravity.clone(),
        })
    }

    /// The positions of the joints.
    pub(super) fn places(&self) -> Vec<Place<Exact>> {
        let variable = |name: &String| self.setting.variable(name);
        let place = |joint: &ExactJoint| match joint.value.as_slice() {
            [cosine, sine] => Place::Turn([variable(cosine), variable(sine)]),
            names => Place::Slide(variable(&names[0])),
        };
        self.joints.iter().map(place).collect()
    }

    /// A linear form in the inertial parameters as an exact number.
    pub(super) fn linear(&self, form: &[BigRational]) -> Exact {
        let terms = form.iter().zip(self.setting.ring().variables()).filter(|(coefficient, _)| !coefficient.is_zero());
        let term = |(coefficient, name): (&BigRational, &String)| {
            Exact::from(coefficient.clone()) * self.setting.variable(name)
        };
        terms.map(term).fold(Exact::zero(), |sum, term| sum + term)
    }

    /// The coefficients of a number that is a linear form in the inertial parameters.
    pub(super) fn coefficients(&self, number: &Exact) -> Option<Vec<BigRational>> {
        let layout = self.setting.ring().layout();
        let mut form = vec![BigRational::zero(); NUMBERS.len() * self.joints.len()];
        for term in self.setting.polynomial(number).terms() {
            let (place, 1) = layout.pure_power(&term.monomial)? else { return None };
            *form.get_mut(place)? = term.coefficient.clone();
        }
        Some(form)
    }

    /// The derivatives of the variables by a joint's value: minus the sine and the cosine, or one.
    pub(super) fn changes(&self, joint: usize) -> Vec<(usize, Exact)> {
        let index = |name: &String| self.setting.ring().index_of(name).expect("a variable of the setting");
        let variable = |name: &String| self.setting.variable(name);
        match self.joints[joint].value.as_slice() {
            [cosine, sine] => vec![(index(cosine), -variable(sine)), (index(sine), variable(cosine))],
            names => vec![(index(&names[0]), Exact::one())],
        }
    }

    /// The gravity vector.
    pub(super) fn gravity(&self) -> [Exact; 3] {
        let size = self.setting.variable("g");
        self.down.clone().map(|entry| entry * size.clone())
    }
}

impl Exact {
    fn zeros() -> [Exact; 3] {
        std::array::from_fn(|_| Exact::zero())
    }
}

fn rate_name(joint: &Joint) -> String {
    format!("v{}", joint.symbol)
}

/// The variables: inertial parameters, gravity, velocities, square roots, and the joints' values.
fn setting(chain: &Chain, masses: Masses<'_>, primes: &[u32], most: usize) -> Result<Arc<Setting>> {
    let joints = chain.joints();
    let symbols = |joint: &Joint| NUMBERS.map(|number| format!("{number}{}", joint.symbol));
    let mut variables: Vec<String> = match masses {
        Masses::Symbols => joints.iter().flat_map(symbols).collect(),
        Masses::Numbers(_) => Vec::new(),
    };
    variables.push("g".to_owned());
    variables.extend(joints.iter().map(rate_name));
    variables.extend(primes.iter().map(|prime| root_name(*prime)));
    variables.extend(joints.iter().flat_map(Joint::unknowns));
    let circles: Vec<[String; 2]> = joints
        .iter()
        .filter(|joint| joint.kind == JointKind::Revolute)
        .map(|joint| joint.unknowns().try_into().map(|[cosine, sine]: [String; 2]| [sine, cosine]))
        .collect::<std::result::Result<_, _>>()
        .expect("a joint that turns has a cosine and a sine");
    Setting::new(&variables, &circles, primes, most)
}
