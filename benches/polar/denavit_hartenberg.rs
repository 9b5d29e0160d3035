//! The polar robot by Denavit-Hartenberg parameters, as in RH0 2.7.2: joint axes along y, homogeneous matrices.

use std::f64::consts::FRAC_PI_2;

use nalgebra::{Matrix3, Matrix4, Matrix6x3, Vector3};

/// k - S of RH0 Fig. 2-7: the height of the intersection of the first two axes \[m\].
pub const HEIGHT: f64 = 0.66;
/// H - k of RH0 Fig. 2-7: the length of the arm at the zero configuration \[m\].
pub const LENGTH: f64 = 0.20;

/// One row of the table: RH0 Fig. 2-7.
struct Row {
    theta: f64,
    d: f64,
    a: f64,
    alpha: f64,
}

/// RH0 Fig. 2-7 at the joint values `q`: radians, radians, metres.
fn table(q: &[f64; 3]) -> [Row; 3] {
    let [q1, q2, q3] = *q;
    [
        Row { theta: q1, d: HEIGHT, a: 0.0, alpha: FRAC_PI_2 },
        Row { theta: q2 - FRAC_PI_2, d: 0.0, a: 0.0, alpha: -FRAC_PI_2 },
        Row { theta: 0.0, d: q3 + LENGTH, a: 0.0, alpha: 0.0 },
    ]
}

/// RH0 (2-63): a rotation about y, a translation along y, a translation along x, a rotation about x.
fn link(row: &Row) -> Matrix4<f64> {
    about_y(row.theta) * shift(0.0, row.d) * shift(row.a, 0.0) * about_x(row.alpha)
}

/// The derivative of [`link`] by theta, or by d for a prismatic joint.
fn link_derivative(row: &Row, slides: bool) -> Matrix4<f64> {
    if slides {
        return about_y(row.theta) * along_y() * about_x(row.alpha);
    }
    about_y_derivative(row.theta) * shift(0.0, row.d) * shift(row.a, 0.0) * about_x(row.alpha)
}

/// base_from_tool, RH0 (2-65).
pub fn forward(q: &[f64; 3]) -> Matrix4<f64> {
    let [first, second, third] = table(q);
    link(&first) * link(&second) * link(&third) * tool()
}

/// Same as [`forward`], but with all products expanded by hand. The exponentials of RH0 (2-54) give the same entries.
pub fn forward_by_hand(q: &[f64; 3]) -> Matrix4<f64> {
    let ((s1, c1), (s2, c2), length) = (q[0].sin_cos(), q[1].sin_cos(), q[2] + LENGTH);
    let ahead = length * c2;
    Matrix4::from([
        [c1 * c2, s2, -s1 * c2, 0.0],
        [-c1 * s2, c2, s1 * s2, 0.0],
        [s1, 0.0, c1, 0.0],
        [ahead * c1, HEIGHT + length * s2, -ahead * s1, 1.0],
    ])
}

/// The joint values of RH0 (2-66) as printed, from the position of the tool: one of up to four solutions. Its second value has another zero than the table: see
/// [`inverse`].
pub fn inverse_as_printed(base_from_tool: &Matrix4<f64>) -> [f64; 3] {
    let position = base_from_tool.fixed_view::<3, 1>(0, 3);
    let (x, y, z) = (position[0], position[1], position[2]);
    let radius = (z * z + x * x).sqrt();
    let q1 = (-z).atan2(x);
    let q2 = radius.atan2(HEIGHT - y);
    let q3 = q2.sin() * radius - q2.cos() * (y - HEIGHT) - LENGTH;
    [q1, q2, q3]
}

/// Same as RH0 (2-66), but with the second value as in the table: the printed one is a quarter turn too large.
pub fn inverse(base_from_tool: &Matrix4<f64>) -> [f64; 3] {
    let [q1, q2, q3] = inverse_as_printed(base_from_tool);
    [q1, q2 - FRAC_PI_2, q3]
}

/// The Jacobian by derivatives, RH0 (2-68): rows are the velocity of the tool's origin and the angular velocity, both in the base frame, per unit of each
/// joint's velocity. The thesis does not say to which angles its last three rows belong. The angular velocity needs no choice of angles.
pub fn jacobian(q: &[f64; 3]) -> Matrix6x3<f64> {
    let rows = table(q);
    let links = [link(&rows[0]), link(&rows[1]), link(&rows[2])];
    let turned = (links[0] * links[1] * links[2] * tool()).fixed_view::<3, 3>(0, 0).transpose();
    let columns = [0, 1, 2].map(|j| {
        let factor = |i: usize| if i == j { link_derivative(&rows[i], i == 2) } else { links[i] };
        let derivative = factor(0) * factor(1) * factor(2) * tool();
        let spin: Matrix3<f64> = derivative.fixed_view::<3, 3>(0, 0) * turned;
        let velocity = derivative.fixed_view::<3, 1>(0, 3);
        [velocity[0], velocity[1], velocity[2], spin[(2, 1)], spin[(0, 2)], spin[(1, 0)]]
    });
    Matrix6x3::from_fn(|i, j| columns[j][i])
}

/// RH0 (2-64): the tool's axes in the last frame of the table.
fn tool() -> Matrix4<f64> {
    let (s, c) = FRAC_PI_2.sin_cos();
    Matrix4::new(c, -s, 0., 0., s, c, 0., 0., 0., 0., 1., 0., 0., 0., 0., 1.)
}

fn about_y(angle: f64) -> Matrix4<f64> {
    let (s, c) = angle.sin_cos();
    Matrix4::new(c, 0., s, 0., 0., 1., 0., 0., -s, 0., c, 0., 0., 0., 0., 1.)
}

fn about_y_derivative(angle: f64) -> Matrix4<f64> {
    let (s, c) = angle.sin_cos();
    Matrix4::new(-s, 0., c, 0., 0., 0., 0., 0., -c, 0., -s, 0., 0., 0., 0., 0.)
}

fn about_x(angle: f64) -> Matrix4<f64> {
    let (s, c) = angle.sin_cos();
    Matrix4::new(1., 0., 0., 0., 0., c, -s, 0., 0., s, c, 0., 0., 0., 0., 1.)
}

fn shift(along_x: f64, along_y: f64) -> Matrix4<f64> {
    Matrix4::new_translation(&Vector3::new(along_x, along_y, 0.0))
}

/// The derivative of a translation along y by its length.
fn along_y() -> Matrix4<f64> {
    Matrix4::new(0., 0., 0., 0., 0., 0., 0., 1., 0., 0., 0., 0., 0., 0., 0., 0.)
}
