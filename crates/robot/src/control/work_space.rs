//! Computed torque in work space, RH0 (2-48) to (2-50). Main type: [`WorkSpace`].

use nalgebra::{DMatrix, DVector, Isometry3, Vector6};

use super::{Desired, fixed};
use crate::dynamics::{Equations, State, Workspace};
use crate::{Error, ErrorKind, Result};

/// What is done where the Jacobian has no inverse: where the robot has more or fewer joints than the task has directions, or stands next to a singular configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Inversion {
    /// It is refused where its least singular value is below this share of its greatest.
    Exact(f64),
    /// `J' (J J' + d^2)^-1` is taken for its inverse, `d` this share of its greatest singular value: rates stay bounded, and errors die out more slowly. Where there
    /// are more joints than directions, the motion that is least in the sum of its squares is taken.
    Damped(f64),
}

/// Where a link should be in the world (of a fixed base: in its frame), and how it should move: velocity of its origin and angular velocity, and what these change by, along the world's axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Target {
    /// Where.
    pub pose: Isometry3<f64>,
    /// How fast.
    pub velocity: Vector6<f64>,
    /// As told.
    pub acceleration: Vector6<f64>,
}

/// A law that lets a link follow a target, RH0 (2-50): with effective parameters (2-49) the torques are `J' (M~ (x_d'' - Kv e' - Kp e) + C~ x' + N~)`.
#[derive(Clone, Debug)]
pub struct WorkSpace {
    equations: Equations,
    room: Workspace,
    link: usize,
    inversion: Inversion,
    proportional: f64,
    derivative: f64,
    commanded: Vec<f64>,
    /// By how much the last inversion was damped, as a share of the greatest singular value.
    damped: f64,
}

/// The effective parameters of RH0 (2-49) at a state: `M~ x'' + C~ x' + N~` is the force at the link, and `M~' - 2 C~` is skew.
#[derive(Clone, Debug, PartialEq)]
pub struct Effective {
    /// `J^-T M J^-1`.
    pub inertia: DMatrix<f64>,
    /// `J^-T (C J^-1 + M d(J^-1)/dt)`.
    pub coriolis: DMatrix<f64>,
    /// `J^-T N`.
    pub gravity: DVector<f64>,
}

impl WorkSpace {
    /// That of the link with this place in a robot, with the gains `Kp` \[1/s^2\] and `Kv` \[1/s\] of all directions.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] for gains or a share that are not finite, or below zero; [`ErrorKind::Unsupported`] for a base that moves freely.
    pub fn new(equations: &Equations, link: usize, gains: [f64; 2], inversion: Inversion) -> Result<Self> {
        let count = fixed(equations)?;
        let (Inversion::Exact(share) | Inversion::Damped(share)) = inversion;
        if !gains.iter().chain([&share]).all(|x| x.is_finite() && *x >= 0.0) {
            return Err(Error::new(ErrorKind::BadValue, "give gains and a share that are finite and not below zero"));
        }
        let [proportional, derivative] = gains;
        Ok(WorkSpace {
            room: equations.workspace(),
            equations: equations.clone(),
            link,
            inversion,
            proportional,
            derivative,
            commanded: vec![0.0; count],
            damped: 0.0,
        })
    }

    /// By how much the last inversion was damped, as a share of the Jacobian's greatest singular value; nought where it was exact.
    pub fn damped(&self) -> f64 {
        self.damped
    }

    /// The torques that let the link follow.
    ///
    /// # Errors
    /// As [`Equations::inverse`], and [`ErrorKind::BadValue`] where an exact inverse is asked for and there is none, with what the singular values are.
    pub fn torques(&mut self, target: &Target, state: State<'_>) -> Result<&[f64]> {
        let pose = self.equations.pose(&mut self.room, state.q, self.link)?;
        let [jacobian, rate] = self.equations.jacobian(&mut self.room, state, self.link)?;
        let velocity = DVector::from_column_slice(state.velocity);
        let (moving, drift) = (jacobian * &velocity, rate * &velocity);
        let jacobian = DMatrix::from_column_slice(6, jacobian.ncols(), jacobian.as_slice());
        let mut error = Vector6::zeros();
        error.fixed_rows_mut::<3>(0).copy_from(&(pose.translation.vector - target.pose.translation.vector));
        error.fixed_rows_mut::<3>(3).copy_from(&(pose.rotation * target.pose.rotation.inverse()).scaled_axis());
        let moving = Vector6::from_column_slice(moving.as_slice());
        let asked = target.acceleration
            - (moving - target.velocity) * self.derivative
            - error * self.proportional
            - Vector6::from_column_slice(drift.as_slice());
        let inverse = self.inverted(&jacobian)?;
        let commanded = inverse * DVector::from_column_slice(asked.as_slice());
        self.commanded.copy_from_slice(commanded.as_slice());
        self.equations.inverse(&mut self.room, state, &self.commanded).map(|torques| torques.as_slice())
    }

    /// The effective parameters where the Jacobian has an inverse.
    ///
    /// # Errors
    /// As [`WorkSpace::torques`], and where the robot has not six joints.
    pub fn effective(&mut self, state: State<'_>) -> Result<Effective> {
        let [jacobian, rate] = self.equations.jacobian(&mut self.room, state, self.link)?;
        let [jacobian, rate] =
            [jacobian, rate].map(|matrix| DMatrix::from_column_slice(6, matrix.ncols(), matrix.as_slice()));
        let (Inversion::Exact(share) | Inversion::Damped(share)) = self.inversion;
        let inverse = exact(&jacobian, share)?;
        let [inertia, coriolis] = self.equations.matrices(&mut self.room, state)?.map(Clone::clone);
        let gravity = self.equations.gravity(&mut self.room, state.q)?.clone();
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
        let text = "the Jacobian has no damped inverse; damp by more than nothing";
        let inverse = damped.try_inverse().ok_or_else(|| Error::new(ErrorKind::BadValue, text))?;
        Ok(jacobian.transpose() * inverse)
    }
}

/// The inverse of a Jacobian whose singular values are not far apart.
fn exact(jacobian: &DMatrix<f64>, share: f64) -> Result<DMatrix<f64>> {
    if !jacobian.is_square() {
        let text = format!(
            "the robot has {} joints and the task six directions: there is no inverse of the Jacobian; take a damped one",
            jacobian.ncols()
        );
        return Err(Error::new(ErrorKind::Unsupported, text));
    }
    let values = jacobian.singular_values();
    let (least, greatest) = (values.min(), values.max());
    let inverse = if least > share * greatest { jacobian.clone().try_inverse() } else { None };
    inverse.ok_or_else(|| {
        let text = format!(
            "the configuration is singular: the Jacobian's singular values are from {least:e} to {greatest:e}; take a damped inverse, or go another way"
        );
        Error::new(ErrorKind::BadValue, text)
    })
}

impl Desired<'_> {
    /// Where a link is and how it moves when joints do what is desired.
    ///
    /// # Errors
    /// As [`Equations::inverse`].
    pub fn target(&self, equations: &Equations, room: &mut Workspace, link: usize) -> Result<Target> {
        let state = State::new(self.q, self.velocity);
        let pose = equations.pose(room, self.q, link)?;
        let [jacobian, rate] = equations.jacobian(room, state, link)?;
        let list = |numbers: &[f64]| DVector::from_column_slice(numbers);
        let velocity = jacobian * list(self.velocity);
        let acceleration = jacobian * list(self.acceleration) + rate * list(self.velocity);
        let six = |vector: &[f64]| Vector6::from_column_slice(vector);
        Ok(Target { pose, velocity: six(velocity.as_slice()), acceleration: six(acceleration.as_slice()) })
    }
}
