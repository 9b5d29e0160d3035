//! A chain of joints as the recursions take it, exactly. Main type: [`ExactModel`].

use std::sync::Arc;

use num_bigint::BigInt;
use num_traits::{One, Signed, ToPrimitive, Zero};

use super::number::{Exact, Setting, root_name};
use crate::dynamics::recursions::{Body, Frame, Freedom, Mass, Matrix, Place, Scalar, Tree};
use crate::kinematics::{Chain, Joint, JointKind};
use crate::number::BigRational;
use crate::spatial::exact::ExactVector;
use crate::{Error, ErrorKind, Result};

/// The ten numbers of a body, by their names: the mass, the mass times its centre, the tensor.
pub const NUMBERS: [&str; 10] = ["m", "mx", "my", "mz", "Ixx", "Ixy", "Iyy", "Ixz", "Iyz", "Izz"];

/// The greatest prime of which roots are taken.
const MOST_PRIME: u32 = 1000;

/// A chain whose bodies have symbols or numbers for masses. Each body's frame stands at its joint's point, and at zero along the axes of the base; the recursions have frames
/// of their own there.
#[derive(Clone, Debug)]
pub struct ExactModel {
    pub(super) setting: Arc<Setting>,
    /// Whether masses are symbols, which are then the first variables.
    pub(super) has_symbols: bool,
    pub(super) tree: Tree<Exact>,
    pub(super) joints: Vec<ExactJoint>,
    /// The direction of gravity, whose size is `g`.
    pub(super) down: [Exact; 3],
    /// Gravity as it was given.
    pub(super) given_gravity: ExactVector,
}

/// A joint of an exact model.
#[derive(Clone, Debug)]
pub(super) struct ExactJoint {
    pub name: String,
    pub kind: JointKind,
    /// The unit vector of its axis, in the base frame at zero, and a point on it.
    pub axis: [Exact; 3],
    pub point: [Exact; 3],
    /// What its body weighs, in its frame.
    pub mass: Mass<Exact>,
    /// The variables of its value: a cosine and a sine, or a way; and that of its rate.
    pub value: Vec<String>,
    pub rate: String,
}

/// What is known of the bodies of a chain.
#[derive(Clone, Copy, Debug)]
pub enum Masses<'a> {
    /// Ten symbols each: `m1`, `mx1` and so on.
    Symbols,
    /// Ten numbers each, in the frames of [`ExactModel`].
    Numbers(&'a [[BigRational; 10]]),
}

impl ExactModel {
    /// That of a chain under gravity in a direction of its base, of which no sum has more terms than are allowed.
    ///
    /// # Errors
    /// [`ErrorKind::Unsupported`] for axes and directions of gravity whose lengths are no roots of numbers with small prime factors, and joints that follow others; [`ErrorKind::DuplicateName`] where
    /// a joint's symbol makes a name that something else has.
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
                    "joint `{}` follows another one; choose links between which each joint is on its own",
                    joint.name
                );
                return Err(Error::new(ErrorKind::Unsupported, text));
            }
            let numbers = match masses {
                Masses::Symbols => NUMBERS.map(|number| setting.variable(&format!("{number}{}", joint.symbol))),
                Masses::Numbers(told) => told[at].clone().map(Exact::from),
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

    /// The places of the joints.
    pub(super) fn places(&self) -> Vec<Place<Exact>> {
        let variable = |name: &String| self.setting.variable(name);
        let place = |joint: &ExactJoint| match joint.value.as_slice() {
            [cosine, sine] => Place::Turn([variable(cosine), variable(sine)]),
            ways => Place::Slide(variable(&ways[0])),
        };
        self.joints.iter().map(place).collect()
    }

    /// A linear form in what bodies weigh as a number.
    pub(super) fn linear(&self, form: &[BigRational]) -> Exact {
        let terms = form.iter().zip(self.setting.ring().variables()).filter(|(coefficient, _)| !coefficient.is_zero());
        let term = |(coefficient, name): (&BigRational, &String)| {
            Exact::from(coefficient.clone()) * self.setting.variable(name)
        };
        terms.map(term).fold(Exact::zero(), |sum, term| sum + term)
    }

    /// The coefficients of a number that is a linear form in what bodies weigh.
    pub(super) fn coefficients(&self, number: &Exact) -> Option<Vec<BigRational>> {
        let layout = self.setting.ring().layout();
        let mut form = vec![BigRational::zero(); NUMBERS.len() * self.joints.len()];
        for term in self.setting.polynomial(number).terms() {
            let (place, 1) = layout.pure_power(&term.monomial)? else { return None };
            *form.get_mut(place)? = term.coefficient.clone();
        }
        Some(form)
    }

    /// How a joint changes the variables: by minus the sine and by the cosine, or by one.
    pub(super) fn changes(&self, joint: usize) -> Vec<(usize, Exact)> {
        let index = |name: &String| self.setting.ring().index_of(name).expect("a variable of the setting");
        let variable = |name: &String| self.setting.variable(name);
        match self.joints[joint].value.as_slice() {
            [cosine, sine] => vec![(index(cosine), -variable(sine)), (index(sine), variable(cosine))],
            ways => vec![(index(&ways[0]), Exact::one())],
        }
    }

    /// The acceleration of gravity.
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

/// The variables: what the bodies weigh, gravity, rates, roots, and the joints' values.
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

/// A direction as its vector over its length, and a direction across it.
struct Direction {
    vector: ExactVector,
    length: Root,
    /// A direction across, and its length; none along a coordinate axis.
    across: Option<(ExactVector, Root)>,
}

impl Direction {
    fn of(vector: &ExactVector, name: &str) -> Result<Self> {
        let fault = |error: Error| error.with_context(format!("`{name}`"));
        let norm = |v: &ExactVector| Root::of(&v.iter().map(|x| x * x).sum());
        let length = norm(vector).map_err(fault)?;
        let zeros = vector.iter().filter(|x| x.is_zero()).count();
        if zeros == 2 {
            return Ok(Direction { vector: vector.clone(), length, across: None });
        }
        // Across the vector lies what stands across two of its coordinates; where one of those is nought, a coordinate axis.
        let last = (0..3).find(|&i| vector[i].is_zero()).unwrap_or(2);
        let mut across: ExactVector = std::array::from_fn(|_| BigRational::zero());
        if vector[last].is_zero() {
            across[last] = BigRational::one();
        } else {
            (across[0], across[1]) = (-vector[1].clone(), vector[0].clone());
        }
        let other = norm(&across).map_err(fault)?;
        Ok(Direction { vector: vector.clone(), length, across: Some((across, other)) })
    }

    fn primes(&self) -> impl Iterator<Item = u32> {
        let across = self.across.iter().flat_map(|(_, length)| &length.primes);
        self.length.primes.iter().chain(across).copied()
    }

    fn unit(&self, setting: &Arc<Setting>) -> [Exact; 3] {
        over(&self.vector, &self.length, setting)
    }

    /// A rotation whose last column is the direction.
    fn upright(&self, setting: &Arc<Setting>) -> Matrix<Exact> {
        let z = self.unit(setting);
        let x = match &self.across {
            Some((across, length)) => over(across, length, setting),
            None => {
                let along = self.vector.iter().position(|x| !x.is_zero()).unwrap_or(2);
                std::array::from_fn(|i| if i == (along + 1) % 3 { Exact::one() } else { Exact::zero() })
            }
        };
        let y: [Exact; 3] = std::array::from_fn(|i| {
            let (j, k) = ((i + 1) % 3, (i + 2) % 3);
            z[j].clone() * x[k].clone() - z[k].clone() * x[j].clone()
        });
        std::array::from_fn(|i| [x[i].clone(), y[i].clone(), z[i].clone()])
    }
}

fn over(vector: &ExactVector, length: &Root, setting: &Arc<Setting>) -> [Exact; 3] {
    let inverse = length.inverse(setting);
    vector.clone().map(|entry| Exact::from(entry) * inverse.clone())
}

/// The positive root of a rational number: a rational times roots of primes.
struct Root {
    rational: BigRational,
    primes: Vec<u32>,
}

impl Root {
    fn of(square: &BigRational) -> Result<Self> {
        let unsupported = || {
            let length = square.to_f64().unwrap_or(f64::NAN).sqrt();
            let text = format!(
                "its length {length} is not a rational number times roots of primes up to {MOST_PRIME}; give a simpler direction"
            );
            Error::new(ErrorKind::Unsupported, text)
        };
        if !square.is_positive() {
            return Err(Error::new(ErrorKind::BadValue, "a direction of length zero; give another one"));
        }
        // sqrt(n / d) = sqrt(n d) / d
        let mut left = square.numer() * square.denom();
        let (mut whole, mut primes) = (BigInt::one(), Vec::new());
        for prime in crate::number::primes_below(u64::from(MOST_PRIME) + 1) {
            let prime = u32::try_from(prime).map_err(|_| unsupported())?;
            while (&left % (prime * prime)).is_zero() {
                left /= prime * prime;
                whole *= prime;
            }
            if (&left % prime).is_zero() {
                left /= prime;
                primes.push(prime);
            }
        }
        let root = left.sqrt();
        if &root * &root != left {
            return Err(unsupported());
        }
        primes.sort_unstable();
        Ok(Root { rational: BigRational::new(whole * root, square.denom().clone()), primes })
    }

    /// One over it.
    fn inverse(&self, setting: &Arc<Setting>) -> Exact {
        let product = self.primes.iter().fold(BigInt::one(), |product, prime| product * prime);
        let rational = (&self.rational * BigRational::from_integer(product)).recip();
        let roots = self.primes.iter().map(|prime| setting.variable(&root_name(*prime)));
        roots.fold(Exact::from(rational), |product, root| product * root)
    }
}
