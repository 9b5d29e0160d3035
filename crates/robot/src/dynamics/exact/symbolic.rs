//! The equations of motion as polynomials. Main type: [`Symbolic`].

use std::fmt::Write;

use super::base_parameters::BaseParameters;
use super::model::ExactModel;
use super::number::Exact;
use crate::dynamics::recursions::{Data, Matrices, Motion, Scalar, Six};
use crate::{Error, ErrorKind, Result};
use groebot_algebra::number::{Ring, Style};

/// Maximum number of terms of M, C and N together.
pub(crate) const MOST_TERMS: usize = groebot_algebra::limits::SYMBOLIC_TERMS;

/// The equations `M q'' + C q' + N = torques` as polynomials in cosines and sines (or displacements) of the joints,
/// their velocities, and the inertial parameters. `M` is symmetric, and `C` has Christoffel symbols, RH0 (2-42).
#[derive(Clone, Debug)]
pub struct Symbolic {
    pub(super) model: ExactModel,
    /// All entries, row by row.
    pub(super) inertia: Vec<Vec<Exact>>,
    pub(super) coriolis: Vec<Vec<Exact>>,
    pub(super) gravity: Vec<Exact>,
    pub(super) potential: Exact,
    /// Base parameters, if masses are symbols and axes are rational.
    pub(super) base: Option<BaseParameters>,
}

impl Symbolic {
    /// Computes the equations of a model: the inertia matrix by CRBA, the Christoffel symbols from its derivatives,
    /// gravity torques by RNEA, and the potential energy. This is zero where the centre of mass is as high as the
    /// origin of the base.
    ///
    /// # Errors
    /// [`ErrorKind::Overflow`] for more than 100,000 terms, with their number.
    pub fn new(model: ExactModel) -> Result<Self> {
        let (tree, count) = (&model.tree, model.joints.len());
        let mut data = Data::new(tree);
        data.place(tree, model.places());
        let mut matrices = Matrices::new(count);
        data.inertia(tree, &mut matrices);
        model.setting.check()?;
        let still = vec![Exact::zero(); count];
        let gravity = model.gravity();
        let mut pull = Six::zero();
        pull.linear = gravity.clone().map(|entry| -entry);
        let motion = Motion { base: Six::zero(), base_acceleration: pull, rates: &still, accelerations: &still };
        let mut torques = still.clone();
        data.inverse(tree, &motion, &[], &mut torques);
        let potential = data.energy(tree, &Six::zero(), &still, &gravity).potential;
        let inertia: Vec<Vec<Exact>> = matrices.inertia.chunks(count).map(<[_]>::to_vec).collect();
        let coriolis = christoffel(&model, &inertia)?;
        model.setting.check()?;
        let base = base_parameters(&model, &inertia, &torques)?;
        let symbolic = Symbolic { inertia, coriolis, gravity: torques, potential, base, model };
        let terms = symbolic.terms();
        if terms > MOST_TERMS {
            let text = format!("M, C and N have {terms} terms; at most {MOST_TERMS} are allowed");
            return Err(Error::new(ErrorKind::Overflow, text));
        }
        Ok(symbolic)
    }

    /// Number of terms of M (its lower triangle), C and N.
    pub fn terms(&self) -> usize {
        let lower = self.inertia.iter().enumerate().flat_map(|(i, row)| &row[..=i]);
        lower.chain(self.coriolis.iter().flatten()).chain(&self.gravity).map(Exact::terms).sum()
    }

    /// The base parameters, where masses are symbols and the joints' axes have rational directions.
    pub fn base_parameters(&self) -> Option<&BaseParameters> {
        self.base.as_ref()
    }

    fn text(&self, number: &Exact, style: Style) -> String {
        let ring = self.model.setting.ring();
        ring.format(&self.model.setting.polynomial(number), style)
    }

    /// Name and text of all entries: `M11` and so on from 1, the lower triangle of M, all of C, N and V.
    pub fn entries(&self) -> Vec<(String, String)> {
        let mut entries = Vec::new();
        let mut entry = |name: String, number: &Exact| entries.push((name, self.text(number, Style::Text)));
        for (i, row) in self.inertia.iter().enumerate() {
            (0..=i).for_each(|j| entry(format!("M{}{}", i + 1, j + 1), &row[j]));
        }
        for (i, row) in self.coriolis.iter().enumerate() {
            (0..row.len()).for_each(|j| entry(format!("C{}{}", i + 1, j + 1), &row[j]));
        }
        for (i, number) in self.gravity.iter().enumerate() {
            entry(format!("N{}", i + 1), number);
        }
        entry("V".to_owned(), &self.potential);
        for (i, form) in self.base.iter().flat_map(|base| &base.forms).enumerate() {
            entry(format!("B{}", i + 1), &self.model.linear(form));
        }
        entries
    }

    /// The meaning of the symbols, one line each, with formulas between dollar signs.
    pub fn legend(&self) -> Vec<String> {
        let mut lines = vec![
            "$M q'' + C q' + N$ are the torques; $M$ is symmetric, $M' - 2*C$ is skew, and $N$ are the derivatives of the potential energy $V$.".to_owned(),
            format!(
                "Gravity is $g$ along $({})$, as of --gravity {}.",
                self.model.down.each_ref().map(|x| self.text(x, Style::Text)).join(", "),
                self.model.given_gravity.each_ref().map(ToString::to_string).join(",")
            ),
        ];
        for (at, joint) in self.model.joints.iter().enumerate() {
            let value = match joint.value.as_slice() {
                [cosine, sine] => format!("turns by an angle with cosine ${cosine}$ and sine ${sine}$"),
                names => format!("slides by ${}$", names[0]),
            };
            let vector = |v: &[Exact; 3]| v.each_ref().map(|x| self.text(x, Style::Decimal)).join(", ");
            lines.push(format!(
                "Joint {}, {}: {value}, rate ${}$, axis $({})$ through $({})$.",
                at + 1,
                joint.name,
                joint.rate,
                vector(&joint.axis),
                vector(&joint.point)
            ));
        }
        lines.push(
            "For the body that a joint moves, $m$ is the mass, $mx$, $my$, $mz$ are the mass times its centre, and $Ixx$ to $Izz$ the inertia tensor, about the joint's point and along the \
             axes of the base where all joints are at zero."
                .to_owned(),
        );
        if let Some(base) = &self.base {
            lines.push(format!(
                "$M$, $C$ and $N$ depend only on {} base parameters, $B1$ and so on; this is the minimal number.",
                base.forms.len()
            ));
        }
        lines
    }

    /// Legend and entries as text that the polynomial parser reads, one line each.
    pub fn to_text(&self) -> String {
        let mut text = String::new();
        for line in self.legend() {
            let _ = writeln!(text, "# {}", line.replace('$', ""));
        }
        for (name, entry) in self.entries() {
            let _ = writeln!(text, "{name} = {entry}");
        }
        text
    }
}

/// The base parameters of M and N, if masses are symbols and axes are rational.
pub(super) fn base_parameters(
    model: &ExactModel,
    inertia: &[Vec<Exact>],
    gravity: &[Exact],
) -> Result<Option<BaseParameters>> {
    let is_rational = model.has_symbols && !model.setting.has_roots();
    is_rational.then(|| BaseParameters::of(model, dependent(inertia, gravity))).transpose()
}

/// The entries that contain inertial parameters.
pub(super) fn dependent<'a>(inertia: &'a [Vec<Exact>], gravity: &'a [Exact]) -> impl Iterator<Item = &'a Exact> {
    inertia.iter().enumerate().flat_map(|(i, row)| &row[..=i]).chain(gravity)
}

/// The Coriolis matrix. Entry (i, j) is the sum over k of half of `dM_ij/dq_k + dM_ik/dq_j - dM_kj/dq_i` times the
/// velocity of k.
pub(super) fn christoffel(model: &ExactModel, inertia: &[Vec<Exact>]) -> Result<Vec<Vec<Exact>>> {
    let count = inertia.len();
    let changes: Vec<_> = (0..count).map(|joint| model.changes(joint)).collect();
    let slope = |i: usize, j: usize, k: usize| model.setting.derivative(&inertia[i.max(j)][i.min(j)], &changes[k]);
    // Derivatives for each entry of the lower triangle and each joint.
    let slopes: Vec<Vec<Vec<Exact>>> =
        (0..count).map(|i| (0..=i).map(|j| (0..count).map(|k| slope(i, j, k)).collect()).collect()).collect();
    let slope = |i: usize, j: usize, k: usize| slopes[i.max(j)][i.min(j)][k].clone();
    let rates: Vec<Exact> = model.joints.iter().map(|joint| model.setting.variable(&joint.rate)).collect();
    let mut rows = Vec::with_capacity(count);
    for i in 0..count {
        let mut row = Vec::with_capacity(count);
        for j in 0..count {
            let term = |k: usize| (slope(i, j, k) + slope(i, k, j) - slope(k, j, i)).half() * rates[k].clone();
            row.push((0..count).map(term).fold(Exact::zero(), |sum, term| sum + term));
            model.setting.check()?;
        }
        rows.push(row);
    }
    Ok(rows)
}
