//! Computed torque in operational space, RH0 (2-48) to (2-50). Main type: [`OperationalSpace`].

use nalgebra::{DMatrix, DVector, Isometry3, Vector6};

use super::{Desired, fixed};
use crate::dynamics::{Equations, State, Workspace};
use crate::{Error, ErrorKind, Result};

/// Inversion of the Jacobian, which has no inverse near singular configurations, or when the numbers of joints and task
/// directions differ.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Inversion {
    /// Exact inverse. It is refused when the least singular value is below this fraction of the greatest.
    Exact(f64),
    /// Damped least squares: `J' (J J' + d^2)^-1`, where `d` is this fraction of the greatest singular value.
    /// Velocities stay bounded, and errors decrease more slowly. With more joints than directions, the motion has the
    /// least sum of squares.
    Damped(f64),
}

/// Target of a link in the world frame; for a fixed base, in its frame. Velocity and acceleration of its origin and its
/// angular velocity and acceleration are along the world axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    /// The pose.
    pub pose: Isometry3<f64>,
    /// The velocity.
    pub velocity: Vector6<f64>,
    /// The acceleration.
    pub acceleration: Vector6<f64>,
}

/// A law with which a link follows a target, RH0 (2-50). With the effective parameters (2-49), the torques are `J' (M~
/// (x_d'' - Kv e' - Kp e) + C~ x' + N~)`.
#[derive(Clone, Debug)]
pub struct OperationalSpace {
    equations: Equations,
    workspace: Workspace,
    link: usize,
    inversion: Inversion,
    proportional: f64,
    derivative: f64,
    commanded: Vec<f64>,
    /// Damping of the last inversion as a fraction of the greatest singular value.
    damped: f64,
}

/// The effective parameters of RH0 (2-49) at a state: `M~ x'' + C~ x' + N~` is the force at the link, and `M~' - 2 C~`
/// is skew-symmetric.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Effective {
    /// `J^-T M J^-1`.
    pub inertia: DMatrix<f64>,
    /// `J^-T (C J^-1 + M d(J^-1)/dt)`.
    pub coriolis: DMatrix<f64>,
    /// `J^-T N`.
    pub gravity: DVector<f64>,
}

impl OperationalSpace {
    /// Builds the law for the link with the index `link` in a robot. The gains `Kp` \[1/s^2\] and `Kv` \[1/s\] are
    /// those of all directions.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for gains or a fraction that are negative or not finite; [`ErrorKind::Unsupported`] for
    /// a floating base.
    pub fn new(equations: &Equations, link: usize, gains: [f64; 2], inversion: Inversion) -> Result<Self> {
        let count = fixed(equations)?;
        let (Inversion::Exact(share) | Inversion::Damped(share)) = inversion;
        if !gains.iter().chain([&share]).all(|x| x.is_finite() && *x >= 0.0) {
            return Err(Error::new(ErrorKind::BadValue, "give gains and a fraction that are finite and nonnegative"));
        }
        let [proportional, derivative] = gains;
        Ok(OperationalSpace {
            workspace: equations.workspace(),
            equations: equations.clone(),
            link,
            inversion,
            proportional,
            derivative,
            commanded: vec![0.0; count],
            damped: 0.0,
        })
    }

    /// Damping of the last inversion, as a fraction of the Jacobian's greatest singular value; zero for an exact
    /// inversion.
    pub fn damped(&self) -> f64 {
        self.damped
    }

    /// Computes the torques with which the link follows the target.
    ///
    /// # Errors
    /// Those of [`Equations::inverse`]; [`ErrorKind::BadValue`] with the singular values when an exact inverse is
    /// requested and does not exist.
    pub fn torques(&mut self, target: &Target, state: State<'_>) -> Result<&[f64]> {
        let pose = self.equations.pose(&mut self.workspace, state.q, self.link)?;
        let [jacobian, rate] = self.equations.jacobian(&mut self.workspace, state, self.link)?;
        let velocity = DVector::from_column_slice(state.velocity);
        let (moving, drift) = (jacobian * &velocity, rate * &velocity);
        let jacobian = DMatrix::from_column_slice(6, jacobian.ncols(), jacobian.as_slice());
        let mut error = Vector6::zeros();
        error.fixed_rows_mut::<3>(0).copy_from(&(pose.translation.vector - target.pose.translation.vector));
        error.fixed_rows_mut::<3>(3).copy_from(&(pose.rotation * target.pose.rotation.inverse()).scaled_axis());
        let moving = Vector6::from_column_slice(moving.as_slice());
        let desired_acceleration = target.acceleration
            - (moving - target.velocity) * self.derivative
            - error * self.proportional
            - Vector6::from_column_slice(drift.as_slice());
        let inverse = self.inverted(&jacobian)?;
        let commanded = inverse * DVector::from_column_slice(desired_acceleration.as_slice());
        self.commanded.copy_from_slice(commanded.as_slice());
        self.equations.inverse(&mut self.workspace, state, &self.commanded).map(|torques| torques.as_slice())
    }

    /// Computes the effective parameters if the Jacobian has an inverse.
    ///
    /// # Errors
    /// Those of [`OperationalSpace::torques`], and an error unless the robot has six joints.
    pub fn effective(&mut self, state: State<'_>) -> Result<Effective> {
        let [jacobian, rate] = self.equations.jacobian(&mut self.workspace, state, self.link)?;
        let [jacobian, rate] =
            [jacobian, rate].map(|matrix| DMatrix::from_column_slice(6, matrix.ncols(), matrix.as_slice()));
        let (Inversion::Exact(share) | Inversion::Damped(share)) = self.inversion;
        let inverse = exact(&jacobian, share)?;
        let [inertia, coriolis] = self.equations.matrices(&mut self.workspace, state)?.map(Clone::clone);
        let gravity = self.equations.gravity(&mut self.workspace, state.q)?.clone();
        let changing = -(&inverse * rate * &inverse);
        Ok(Effective {
            coriolis: inverse.transpose() * (coriolis * &inverse + &inertia * changing),
            inertia: inverse.transpose() * inertia * &inverse,
            gravity: inverse.transpose() * gravity,
        })
    }

    fn inverted(&mut self, jacobian: &DMatrix<f64>) -> Result<DMatrix<f64>> {
        self.damped = 0.0;
        let share = match self.inversion {
            Inversion::Exact(share) => return exact(jacobian, share),
            Inversion::Damped(share) => share,
        };
        self.damped = share;
        let greatest = jacobian.singular_values().max();
        let square = jacobian * jacobian.transpose();
        let damped = &square + DMatrix::identity(square.nrows(), square.ncols()) * (share * greatest).powi(2);
        let text = "the Jacobian has no damped inverse; give a positive damping";
        let inverse = damped.try_inverse().ok_or_else(|| Error::new(ErrorKind::BadValue, text))?;
        Ok(jacobian.transpose() * inverse)
    }
}

/// The inverse of a Jacobian with similar singular values.
fn exact(jacobian: &DMatrix<f64>, share: f64) -> Result<DMatrix<f64>> {
    if !jacobian.is_square() {
        let text = format!(
            "the robot has {} joints and the task six directions: the Jacobian has no inverse; use a damped inverse",
            jacobian.ncols()
        );
        return Err(Error::new(ErrorKind::Unsupported, text));
    }
    let values = jacobian.singular_values();
    let (least, greatest) = (values.min(), values.max());
    let inverse = if least > share * greatest { jacobian.clone().try_inverse() } else { None };
    inverse.ok_or_else(|| {
        let text = format!(
            "the configuration is singular: the Jacobian's singular values are from {least:e} to {greatest:e}; use a damped inverse, or another path"
        );
        Error::new(ErrorKind::BadValue, text)
    })
}

impl Desired<'_> {
    /// Computes the target of a link for the desired motion of the joints.
    ///
    /// # Errors
    /// Those of [`Equations::inverse`].
    pub fn target(&self, equations: &Equations, workspace: &mut Workspace, link: usize) -> Result<Target> {
        let state = State::new(self.q, self.velocity);
        let pose = equations.pose(workspace, self.q, link)?;
        let [jacobian, rate] = equations.jacobian(workspace, state, link)?;
        let list = |numbers: &[f64]| DVector::from_column_slice(numbers);
        let velocity = jacobian * list(self.velocity);
        let acceleration = jacobian * list(self.acceleration) + rate * list(self.velocity);
        let six = |vector: &[f64]| Vector6::from_column_slice(vector);
        Ok(Target { pose, velocity: six(velocity.as_slice()), acceleration: six(acceleration.as_slice()) })
    }
}
