//! Manipulator Jacobians of serial chains, computed from their screws: spatial RH0 (2-21), (2-22), body (2-23), (2-24).
//!
//! Rows are (v, w), columns the joints from base to tip. `v` is in the length unit of the screws per unit of the joint.

use nalgebra::{DMatrix, Matrix6xX, Vector3};

use super::{Chain, Task};
use crate::spatial::{Pose, Screw, Twist};
use crate::{Error, ErrorKind, Result};

/// Six rows (v, w), one column for each joint.
pub type Jacobian = Matrix6xX<f64>;

/// Computes the spatial Jacobian at `q`, RH0 (2-22). Column i is the twist of joint i in the base frame, moved by the
/// joints before it. Multiplied by the joint velocities it is the tip's spatial velocity `g' g^-1`, RH0 (2-21).
///
/// # Errors
/// [`ErrorKind::BadValue`] unless `q` has one finite value per screw.
pub fn spatial(screws: &[Screw], q: &[f64]) -> Result<Jacobian> {
    check(screws, q)?;
    let mut base_from_moved = Pose::identity();
    let mut twists = Vec::with_capacity(q.len());
    for (screw, &q) in screws.iter().zip(q) {
        twists.push(screw.twist().transform(&base_from_moved));
        base_from_moved *= screw.exp(q);
    }
    Ok(columns(&twists))
}

/// Computes the body Jacobian at `q`, RH0 (2-24). Column i is the twist of joint i in the tip frame. Multiplied by the
/// joint velocities it is the tip's body velocity `g^-1 g'`, RH0 (2-23).
///
/// `base_from_tip` is the pose of the tip at the zero configuration.
///
/// # Errors
/// Those of [`spatial`].
pub fn body(screws: &[Screw], base_from_tip: &Pose, q: &[f64]) -> Result<Jacobian> {
    check(screws, q)?;
    let mut moved_from_tip = *base_from_tip;
    let mut twists = Vec::with_capacity(q.len());
    for (screw, &q) in screws.iter().zip(q).rev() {
        moved_from_tip = screw.exp(q) * moved_from_tip;
        twists.push(screw.twist().transform(&moved_from_tip.inverse()));
    }
    twists.reverse();
    Ok(columns(&twists))
}

impl Chain {
    /// The spatial Jacobian at the joint values `q`, 6 x n with rows (v, w) in the base frame: [`spatial`].
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] unless `q` has one finite value per joint.
    pub fn spatial_jacobian(&self, q: &[f64]) -> Result<Jacobian> {
        spatial(self.screws(), q)
    }

    /// The body Jacobian at the joint values `q`, 6 x n with rows (v, w) in the tip frame: [`body`].
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] unless `q` has one finite value per joint.
    pub fn body_jacobian(&self, q: &[f64]) -> Result<Jacobian> {
        body(self.screws(), &self.base_from_tip(), q)
    }
}

impl Chain {
    /// Computes the Jacobian of the chain's task at `q`. It has one row for each number that the task determines,
    /// positions first, then rotations, and one column for each joint. Positions and displacements are in units of the
    /// reach, angles in radians. A direction has two rows, perpendicular to it. The columns of the joints `held` are
    /// zero.
    ///
    /// # Panics
    /// When `q` has fewer values than the chain has joints.
    pub fn task_jacobian(&self, q: &[f64], held: &[usize]) -> DMatrix<f64> {
        let length = if self.reach() > 0.0 { self.reach() } else { 1.0 };
        let screws = self.screws();
        let mut befores = vec![Pose::identity()];
        screws.iter().zip(q).for_each(|(screw, q)| befores.push(befores[befores.len() - 1] * screw.exp(*q)));
        let pose = befores[screws.len()] * self.base_from_tip();
        let aim = pose.rotation * self.aim().into_inner();
        let column = |(joint, (screw, before)): (usize, (&Screw, &Pose))| {
            let (v, w) = match screw.moved(before) {
                _ if held.contains(&joint) => (Vector3::zeros(), Vector3::zeros()),
                Screw::Revolute(axis) => {
                    let w = axis.direction().into_inner();
                    (w.cross(&(pose.translation.vector - axis.point().coords)) / length, w)
                }
                Screw::Prismatic(direction) => (direction.into_inner(), Vector3::zeros()),
            };
            self.task().components(&v, &w, &aim)
        };
        let entries: Vec<f64> = screws.iter().zip(&befores).enumerate().flat_map(column).collect();
        DMatrix::from_vec(self.task().freedoms(), screws.len(), entries)
    }
}

impl Chain {
    /// Same as [`Chain::task_jacobian`], but mimic joints move with their leaders: their columns are added to those of
    /// the leaders and set to zero.
    ///
    /// # Panics
    /// When `q` has fewer values than the chain has joints.
    #[doc(hidden)]
    pub fn coupled_jacobian(&self, q: &[f64], held: &[usize]) -> DMatrix<f64> {
        let mut jacobian = self.task_jacobian(q, &[]);
        self.fold_followers(&mut jacobian, |_| 1.0);
        held.iter().for_each(|&joint| jacobian.column_mut(joint).fill(0.0));
        jacobian
    }

    /// Adds the columns of mimic joints to those of their leaders and sets them to zero. `unit` is the unit of a
    /// joint's column.
    fn fold_followers(&self, jacobian: &mut DMatrix<f64>, unit: impl Fn(usize) -> f64) {
        for joint in 0..jacobian.ncols() {
            let Some((leader, mimic)) = self.leader(joint) else { continue };
            let moved = jacobian.column(joint) * (mimic.law()[0] * unit(joint) / unit(leader));
            let mut column = jacobian.column_mut(leader);
            column += moved;
            jacobian.column_mut(joint).fill(0.0);
        }
    }

    /// Yoshikawa's manipulability `sqrt(det(J J'))` of the task at the joint values `q` (Manipulability of robotic
    /// mechanisms, IJRR 4, 1985), in metres and radians. With fewer joints than task numbers it is `sqrt(det(J' J))`.
    /// Mimic joints move with their leaders.
    ///
    /// # Panics
    /// When `q` has fewer values than the chain has joints.
    pub fn manipulability(&self, q: &[f64]) -> f64 {
        let mut jacobian = self.task_jacobian(q, &[]);
        let unit = self.length_unit().metres();
        let reach = if self.reach() > 0.0 { unit * self.reach() } else { 1.0 };
        jacobian.rows_mut(0, self.task().layout().lengths()).scale_mut(reach);
        let slides = |joint: usize| matches!(self.screws()[joint], Screw::Prismatic(_));
        for joint in (0..jacobian.ncols()).filter(|joint| slides(*joint)) {
            // A displacement is in units of the reach too.
            jacobian.column_mut(joint).unscale_mut(reach);
        }
        // A mimic joint moves with its leader and has no column of its own.
        let followers: Vec<usize> = (0..jacobian.ncols()).filter(|joint| self.leader(*joint).is_some()).collect();
        self.fold_followers(&mut jacobian, |joint| if slides(joint) { unit } else { 1.0 });
        let jacobian = jacobian.remove_columns_at(&followers);
        if jacobian.is_square() {
            return jacobian.determinant().abs();
        }
        let gram = match jacobian.nrows() < jacobian.ncols() {
            true => &jacobian * jacobian.transpose(),
            false => jacobian.transpose() * &jacobian,
        };
        gram.determinant().max(0.0).sqrt()
    }
}

impl Task {
    /// The task's components of a tip motion with the linear velocity `v` and the angular velocity `w`. `aim` is the
    /// unit vector of the task's direction.
    fn components(self, v: &Vector3<f64>, w: &Vector3<f64>, aim: &Vector3<f64>) -> Vec<f64> {
        let across = || {
            let least = Vector3::ith(aim.iamin(), 1.0);
            let first = aim.cross(&least).normalize();
            let turned = w.cross(aim);
            [turned.dot(&first), turned.dot(&aim.cross(&first))]
        };
        match self {
            Task::Position => v.as_slice().to_vec(),
            Task::PlanarPosition { plane } => plane.coordinates().map(|axis| v[axis]).to_vec(),
            Task::PlanarPose { plane } => {
                [plane.coordinates().map(|axis| v[axis]).as_slice(), &[w[plane.normal()]]].concat()
            }
            Task::Pose => [v.as_slice(), w.as_slice()].concat(),
            Task::Ray => [v.as_slice(), &across()].concat(),
            Task::Direction => across().to_vec(),
            Task::Rotation => w.as_slice().to_vec(),
            Task::PositionYaw { axis } => [v.as_slice(), &[w[axis.coordinate()]]].concat(),
            Task::PositionPitchRoll => [v.as_slice(), &[w.x, w.y]].concat(),
        }
    }
}

fn columns(twists: &[Twist]) -> Jacobian {
    let mut jacobian = Jacobian::zeros(twists.len());
    for (mut column, twist) in jacobian.column_iter_mut().zip(twists) {
        column.copy_from(&twist.to_vector());
    }
    jacobian
}

/// Checks that `q` has one finite value per screw.
pub(crate) fn check(screws: &[Screw], q: &[f64]) -> Result<()> {
    let message = if q.len() != screws.len() {
        format!("{} joint values are given; there are {} joints", q.len(), screws.len())
    } else if let Some(i) = q.iter().position(|value| !value.is_finite()) {
        format!("joint {} of {}: the value {} is not finite", i + 1, q.len(), q[i])
    } else {
        return Ok(());
    };
    Err(Error::new(ErrorKind::BadValue, message))
}
