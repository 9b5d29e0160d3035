//! From limbs to one solver: [`DerivedLimbs`].

use super::model::{JointPlace, Limb, Limbs};
use crate::derive::lift::Derived;
use crate::kinematics::Chain;
use crate::solver::{MAX_JOINTS, Program};
use crate::{Error, ErrorKind, Result, Watch};

/// A limb's derivation, and its place in the solver of all.
#[derive(Clone, Debug, PartialEq)]
pub struct LimbStage {
    /// Index of the limb.
    pub limb: usize,
    /// Its derivation as a chain, with the joints given that limbs before have found.
    pub derived: Derived,
    /// The solver of this limb and all before it.
    pub program: Program,
    /// By joint of the limb: its place among the joints of the solver.
    pub joints: Vec<usize>,
    /// By input of the limb's own solver: where its value comes from.
    pub(super) inputs: Vec<Origin>,
}

/// Where the value of a limb's input comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Origin {
    /// The input of the whole solver with this index.
    Target(usize),
    /// The joint of the whole solver with this index.
    Joint(usize),
}

/// Gives the derivation of a limb's chain.
pub(super) type Derive<'a> = dyn FnMut(usize, &Chain) -> Result<Derived> + 'a;

/// The derivation of a solver of several limbs.
#[derive(Clone, Debug, PartialEq)]
pub struct DerivedLimbs {
    /// The limbs.
    pub limbs: Limbs,
    /// The limbs' derivations, in the order in which they are solved.
    pub stages: Vec<LimbStage>,
    /// The solver.
    pub program: Program,
}

impl DerivedLimbs {
    /// Orders the limbs, derives each as a chain with the joints given that are found before it, and composes their solvers. Of the
    /// limbs that can be solved next, the first is taken.
    ///
    /// # Errors
    /// [`ErrorKind::PositiveDimensional`] when the tasks leave joints of the limbs that are left undetermined;
    /// [`ErrorKind::BadValue`] for a given joint that another limb finds; as [`Derived::of_chain`], with the limb.
    pub fn of_limbs(limbs: &Limbs, watch: &Watch) -> Result<Self> {
        DerivedLimbs::assemble(limbs, &mut |_, chain| Derived::of_chain(chain, watch))
    }

    /// Composes the solvers that `derive` gives of the chains of limbs, which it gets in their order with the limbs' indices.
    pub(super) fn assemble(limbs: &Limbs, derive: &mut Derive<'_>) -> Result<Self> {
        let mut stages: Vec<LimbStage> = Vec::new();
        while stages.len() < limbs.limbs().len() {
            let limb = next_limb(limbs, &stages)?;
            let named = |error: Error| error.with_context(format_args!("limb `{}`", limbs.limbs()[limb].name));
            let stage = LimbStage::derive(limbs, limb, &stages, derive).map_err(named)?;
            stages.push(stage);
        }
        let last = stages.last().map(|stage| stage.program.clone());
        let program = last.ok_or_else(|| Error::new(ErrorKind::BadValue, "there is no limb"))?;
        let mut all = DerivedLimbs { limbs: limbs.clone(), stages, program };
        all.name_motors();
        Ok(all)
    }

    /// The motors' names in place of the joints'.
    fn name_motors(&mut self) {
        self.program.name.clone_from(&self.limbs.parts().name);
        for stage in &self.stages {
            for (joint, &place) in stage.joints.iter().enumerate() {
                let motor = self.limbs.motor_of(JointPlace { limb: stage.limb, joint });
                self.program.joints[place].name =
                    motor.map(|motor| self.limbs.motors()[motor].name.clone()).unwrap_or_default();
            }
        }
    }

    /// The values of a limb's joints, of the limb's index, in an answer `q` of the solver.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for no such limb or another number of joints.
    pub fn joints_of(&self, limb: usize, q: &[f64]) -> Result<Vec<f64>> {
        let stage = self.stages.iter().find(|stage| stage.limb == limb);
        match stage {
            Some(stage) if q.len() == self.program.joints.len() => {
                Ok(stage.joints.iter().map(|&place| q[place]).collect())
            }
            _ => {
                let (limbs, joints) = (self.stages.len(), self.program.joints.len());
                Err(Error::new(
                    ErrorKind::BadValue,
                    format!("limb {limb} of {limbs}, {} joint values of {joints}", q.len()),
                ))
            }
        }
    }

    /// The target, as the solver takes it, that the limbs reach with the solver's joints at `q`.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for another number of joints.
    pub fn reached(&self, q: &[f64]) -> Result<Vec<f64>> {
        let mut target = vec![0.0; self.program.inputs.len()];
        for stage in &self.stages {
            let reached = stage.derived.reached(&self.joints_of(stage.limb, q)?)?;
            for (value, origin) in reached.into_iter().zip(&stage.inputs) {
                if let Origin::Target(index) = *origin {
                    target[index] = value;
                }
            }
        }
        Ok(target)
    }
}

impl LimbStage {
    /// The limb's derivation behind those of `before`.
    fn derive(limbs: &Limbs, limb: usize, before: &[LimbStage], derive: &mut Derive<'_>) -> Result<Self> {
        let Limb { prefix, chain, .. } = &limbs.limbs()[limb];
        let found: Vec<Option<usize>> =
            (0..chain.joints().len()).map(|joint| found(limbs, before, limb, joint)).collect();
        let mut given = chain.parts().given.clone();
        for (joint, _) in chain.joints().iter().zip(&found).filter(|(_, found)| found.is_some()) {
            if given.contains(&joint.name) {
                let text = format!("`{}` is given, but a limb before it finds its motor; leave it out", joint.name);
                return Err(Error::new(ErrorKind::BadValue, text));
            }
            given.push(joint.name.clone());
        }
        let chain = chain.with_task(chain.task(), chain.direction().clone(), given)?;
        let derived = derive(limb, &chain)?;
        let own = derived.program.prefixed(prefix);
        let shared: Vec<(usize, usize)> =
            found.iter().enumerate().filter_map(|(joint, &found)| found.map(|place| (place, joint))).collect();
        let last = before.last().map(|stage| &stage.program);
        let program = last.map_or_else(|| Ok(own.clone()), |last| last.followed_by(&own, &shared))?;
        let mut fresh = last.map_or(0, |last| last.joints.len())..MAX_JOINTS;
        let joints: Vec<usize> = found.iter().filter_map(|found| found.or_else(|| fresh.next())).collect();
        let inputs = origins(&derived, &found, last.map_or(0, |last| last.inputs.len()));
        Ok(LimbStage { limb, derived, program, joints, inputs })
    }

    /// What the limb's own solver is asked, for a target of the solver and its joints.
    pub(super) fn target(&self, target: &[f64], q: &[f64]) -> Vec<f64> {
        let value = |origin: &Origin| match *origin {
            Origin::Target(index) => target[index],
            Origin::Joint(index) => q[index],
        };
        self.inputs.iter().map(value).collect()
    }
}

/// Where the limb's inputs come from: the target, and behind it the given joints from the base, of which those already `found` are
/// joints of limbs before.
fn origins(derived: &Derived, found: &[Option<usize>], first: usize) -> Vec<Origin> {
    let given = &derived.plan.given;
    let target = derived.program.inputs.len() - given.len();
    let joint = |&joint: &usize| found[joint].map(Origin::Joint);
    let mut next = first..;
    let known = std::iter::repeat_n(None, target).chain(given.iter().map(joint));
    known.filter_map(|known| known.or_else(|| next.next().map(Origin::Target))).collect()
}

/// The place among the solver's joints of a joint whose motor a limb before has found.
fn found(limbs: &Limbs, before: &[LimbStage], limb: usize, joint: usize) -> Option<usize> {
    let motor = &limbs.motors()[limbs.motor_of(JointPlace { limb, joint })?];
    let place = |stage: &LimbStage| {
        let twin = motor.joints.iter().find(|place| place.limb == stage.limb)?;
        Some(stage.joints[twin.joint])
    };
    before.iter().find_map(place)
}

/// The first limb whose task can determine what is not found yet of its joints.
fn next_limb(limbs: &Limbs, before: &[LimbStage]) -> Result<usize> {
    let left = |limb: &usize| before.iter().all(|stage| stage.limb != *limb);
    let open = |limb: usize| {
        let chain = &limbs.limbs()[limb].chain;
        let given = chain.given();
        let is_open = |joint: &usize| !given.contains(joint) && found(limbs, before, limb, *joint).is_none();
        (0..chain.joints().len()).filter(is_open).count()
    };
    let freedoms = |limb: usize| limbs.limbs()[limb].chain.task().freedoms();
    let remaining: Vec<usize> = (0..limbs.limbs().len()).filter(left).collect();
    remaining.iter().copied().find(|&limb| open(limb) <= freedoms(limb)).ok_or_else(|| {
        let told = |&limb: &usize| {
            let Limb { name, chain, .. } = &limbs.limbs()[limb];
            format!(
                "`{name}` has {} joints to find, its task `{}` determines {}",
                open(limb),
                chain.task().name(),
                freedoms(limb)
            )
        };
        let list: Vec<String> = remaining.iter().map(told).collect();
        let text = format!("no limb can be solved next: {}; ask more of one, or give a joint", list.join("; "));
        Error::new(ErrorKind::PositiveDimensional, text)
    })
}
