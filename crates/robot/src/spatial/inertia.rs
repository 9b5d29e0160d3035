//! The inertia of one rigid body, RH0 (2-40).

use nalgebra::{Matrix3, Matrix6, Point3};

use super::Pose;
use super::matrix::skew;
use crate::{Error, ErrorKind, Result};

/// Tolerance of the checks of an inertia tensor, relative to its trace, because numbers in data sheets are rounded.
pub(crate) const ROUNDING: f64 = 1e-4;

/// Threshold for a moment that is zero up to rounding, relative to the mass times one square metre. CAD programs write
/// 1e-20 and 1e-35 kg m^2 for zero.
pub(crate) const NEGLIGIBLE: f64 = 1e-12;

/// Tolerance of the symmetry of a given tensor, relative to its norm.
pub(crate) const ASYMMETRY: f64 = 1e-9;

/// Mass, centre of mass and rotational inertia of a rigid body, in the frame of its link.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Inertia {
    mass: f64,
    centre_of_mass: Point3<f64>,
    rotational: Matrix3<f64>,
}

impl Inertia {
    /// Builds the inertia of a body of `mass` \[kg\] with its centre of mass at `centre_of_mass` \[m\] in the link's
    /// frame. `rotational` \[kg m^2\] is the inertia tensor about that centre along the axes of the link's frame.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] when the mass is not positive, a number is not finite, the tensor is not symmetric (to
    /// 1e-9 of its norm), or it is physically impossible: each principal moment must be at least zero and at most the sum
    /// of the other two (to 1e-4 of the trace).
    pub fn new(mass: f64, centre_of_mass: Point3<f64>, rotational: Matrix3<f64>) -> Result<Self> {
        let rows: [[f64; 3]; 3] = rotational.transpose().into();
        let fault = if !(mass.is_finite() && mass > 0.0) {
            format!("mass {mass} kg: give a positive number")
        } else if !centre_of_mass.iter().chain(&rotational).all(|x| x.is_finite()) {
            "centre of mass or inertia: give finite numbers".to_owned()
        } else if (rotational - rotational.transpose()).norm() > ASYMMETRY * rotational.norm() {
            format!("inertia {rows:?}: give a symmetric matrix")
        } else if !is_distribution_of_mass(&rotational) {
            format!(
                "inertia {rows:?} is physically impossible; each principal moment is at most the sum of the other two"
            )
        } else {
            return Ok(Inertia { mass, centre_of_mass, rotational: (rotational + rotational.transpose()) / 2.0 });
        };
        Err(Error::new(ErrorKind::BadValue, fault))
    }

    /// Builds the inertia without checks. The tensor is made symmetric.
    pub(crate) fn unchecked(mass: f64, centre_of_mass: Point3<f64>, rotational: Matrix3<f64>) -> Self {
        Inertia { mass, centre_of_mass, rotational: (rotational + rotational.transpose()) / 2.0 }
    }

    /// Checks physical consistency. `least` \[kg m^2\] is the tolerance of the moments for rounding.
    ///
    /// # Errors
    /// Those of [`Inertia::new`].
    pub(crate) fn check(&self, least: f64) -> Result<()> {
        let lifted = self.rotational + Matrix3::from_diagonal_element(least);
        if is_distribution_of_mass(&lifted) && self.mass > 0.0 && self.mass.is_finite() {
            return Ok(());
        }
        Inertia::new(self.mass, self.centre_of_mass, self.rotational).map(|_| ())
    }

    /// Zero inertia.
    pub fn none() -> Self {
        Inertia { mass: 0.0, centre_of_mass: Point3::origin(), rotational: Matrix3::zeros() }
    }

    /// The mass \[kg\].
    pub fn mass(&self) -> f64 {
        self.mass
    }

    /// The centre of mass in the link's frame \[m\].
    pub fn centre_of_mass(&self) -> Point3<f64> {
        self.centre_of_mass
    }

    /// The inertia tensor about the centre of mass, along the axes of the link's frame \[kg m^2\].
    pub fn rotational(&self) -> Matrix3<f64> {
        self.rotational
    }

    /// Transforms the inertia to an outer frame. `outer_from_frame` is the pose of its frame there.
    #[must_use]
    pub(crate) fn placed(&self, outer_from_frame: &Pose) -> Self {
        let turn = outer_from_frame.rotation.to_rotation_matrix().into_inner();
        Inertia {
            mass: self.mass,
            centre_of_mass: outer_from_frame * self.centre_of_mass,
            rotational: turn * self.rotational * turn.transpose(),
        }
    }

    /// The sum of both inertias, in their common frame.
    #[must_use]
    pub fn with(&self, other: &Inertia) -> Self {
        let mass = self.mass + other.mass;
        if mass == 0.0 {
            return Inertia::unchecked(0.0, Point3::origin(), self.rotational + other.rotational);
        }
        let centre = (self.centre_of_mass.coords * self.mass + other.centre_of_mass.coords * other.mass) / mass;
        let about = |body: &Inertia| {
            let lever = skew(&(body.centre_of_mass.coords - centre));
            body.rotational - lever * lever * body.mass
        };
        Inertia { mass, centre_of_mass: centre.into(), rotational: about(self) + about(other) }
    }

    /// The generalised inertia matrix, 6x6: half of `V' mu V` is the kinetic energy at the body velocity `V = (v, w)`
    /// of the link's frame. With the frame at the centre of mass it is RH0 (2-40): block diagonal with the mass and the
    /// tensor.
    pub fn generalised(&self) -> Matrix6<f64> {
        let lever = skew(&self.centre_of_mass.coords) * self.mass;
        let mut matrix = Matrix6::zeros();
        matrix.fixed_view_mut::<3, 3>(0, 0).copy_from(&Matrix3::from_diagonal_element(self.mass));
        matrix.fixed_view_mut::<3, 3>(0, 3).copy_from(&-lever);
        matrix.fixed_view_mut::<3, 3>(3, 0).copy_from(&lever);
        let rotational = self.rotational - lever * skew(&self.centre_of_mass.coords);
        matrix.fixed_view_mut::<3, 3>(3, 3).copy_from(&rotational);
        matrix
    }
}

/// Whether `tensor` is of the form `tr(S) 1 - S` with the positive semidefinite second moments `S` of a mass.
fn is_distribution_of_mass(tensor: &Matrix3<f64>) -> bool {
    let trace = tensor.trace();
    let second_moments = Matrix3::from_diagonal_element((0.5 + ROUNDING) * trace + f64::MIN_POSITIVE) - tensor;
    let lifted = tensor + Matrix3::from_diagonal_element(ROUNDING * trace + f64::MIN_POSITIVE);
    second_moments.cholesky().is_some() && lifted.cholesky().is_some()
}
