//! Soles. Main type: [`Sole`].

use nalgebra::Point2;

/// The contact area of a contact.
#[derive(Clone, Debug, PartialEq)]
pub struct Sole {
    /// The name of the contact, such as `left`.
    pub contact: String,
    /// The corners, in the frame of the contact \[m\].
    pub corners: Vec<Point2<f64>>,
}
