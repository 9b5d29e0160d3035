//! Denavit-Hartenberg tables, turned into screw axes at the door. Main type: [`DhTable`].
//!
//! Standard: Denavit and Hartenberg 1955, as in Paul 1981. Modified: Craig 1986.

use std::convert::Infallible;

use super::frame::{Frame, Rationality, Reading};
use super::ideal::TOLERANCE;
use super::parts::{Meant, along_z};
use super::validate::{Fault, check_count};
use super::{Chain, ChainParts, ExactVector, Joint, JointKind, LengthUnit, Placement, Task, Turn};
use crate::Result;
use crate::document::shown;
use crate::spatial::{Axis, Relation, Screw};
use groebot_algebra::number::BigRational;

/// Where the frames of a table are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum DhConvention {
    /// Frame i is at the far end of link i: A_i = Rz(theta_i) Tz(d_i) Tx(a_i) Rx(alpha_i).
    Standard,
    /// Frame i is on joint i: A_i = Rx(alpha_(i-1)) Tx(a_(i-1)) Rz(theta_i) Tz(d_i).
    Modified,
}

/// One row: a joint and the four parameters. The joint's value is added to `theta` (revolute) or to `d` (prismatic).
#[derive(Clone, Debug, PartialEq)]
pub struct DhRow {
    /// The name of the joint.
    pub name: String,
    /// What follows c, s or d in the names of its unknowns.
    pub symbol: String,
    /// How the joint moves.
    pub kind: JointKind,
    /// The angle about z at the joint value zero.
    pub theta: Turn,
    /// The distance along z at the joint value zero.
    pub d: BigRational,
    /// The distance along x; in the modified convention, a_(i-1).
    pub a: BigRational,
    /// The angle about x; in the modified convention, alpha_(i-1).
    pub alpha: Turn,
    /// Least and greatest value of the joint, in radians or the table's length unit.
    pub limits: Option<(f64, f64)>,
}

/// A Denavit-Hartenberg table with a frame before it and one behind it.
#[derive(Clone, Debug, PartialEq)]
pub struct DhTable {
    /// The name of the mechanism.
    pub name: String,
    /// What it is.
    pub description: Option<String>,
    /// Where its figures come from.
    pub source: Option<String>,
    /// The unit of every length.
    pub length_unit: LengthUnit,
    /// Where the frames are.
    pub convention: DhConvention,
    /// Frame 0 in the base frame.
    pub base: Placement,
    /// The rows from base to tip.
    pub rows: Vec<DhRow>,
    /// The tip in the last frame.
    pub tool: Placement,
    /// What is asked of the tip.
    pub task: Task,
    /// The direction in the tip frame that the tasks `ray` and `direction` aim.
    pub direction: ExactVector,
    /// The names of the joints whose values the user gives.
    pub given: Vec<String>,
}

impl DhRow {
    /// The rotation and shift about z, with the joint at zero.
    fn about_z(&self) -> Placement {
        let turned = Placement::turned([Turn::default(), Turn::default(), self.theta]);
        turned.then(&Placement::shifted(2, self.d.clone()))
    }

    /// The rotation and shift about x.
    fn about_x(&self) -> Placement {
        let turned = Placement::turned([self.alpha, Turn::default(), Turn::default()]);
        turned.then(&Placement::shifted(0, self.a.clone()))
    }

    /// The joint whose axis is the z axis of `frame`.
    fn joint(&self, frame: &Frame) -> Joint {
        Joint {
            name: self.name.clone(),
            symbol: self.symbol.clone(),
            kind: self.kind,
            axis: frame.direction(&along_z()),
            point: frame.point(),
            limits: self.limits,
            mimic: None,
        }
    }
}

impl DhConvention {
    /// Its name in a file.
    pub fn name(self) -> &'static str {
        match self {
            DhConvention::Standard => "standard",
            DhConvention::Modified => "modified",
        }
    }

    fn other(self) -> DhConvention {
        match self {
            DhConvention::Standard => DhConvention::Modified,
            DhConvention::Modified => DhConvention::Standard,
        }
    }
}

impl DhTable {
    /// Why the table that `text` holds may be one of the other convention: two neighbouring joints turn about one line, and with the other
    /// convention none do. The last row of a standard table has `a` and `alpha` zero, as the first row of a modified one has.
    pub fn doubt_of(text: &str) -> Option<String> {
        let table = DhTable::from_toml(text).ok()?;
        let first = table.coincident()?;
        let (own, other) = (table.convention, table.convention.other());
        let names = [first, first + 1].map(|row| shown(&table.rows[row].name));
        if (DhTable { convention: other, ..table }).coincident().is_some() {
            return None;
        }
        Some(format!(
            "joints `{}` and `{}` turn about the same line, as they do where a {} table is read as {}: try `convention = \"{}\"`",
            names[0],
            names[1],
            other.name(),
            own.name(),
            other.name()
        ))
    }

    /// The place of the first joint that turns about the same line as the next one.
    fn coincident(&self) -> Option<usize> {
        let chain = self.chain().ok()?;
        let tolerance = TOLERANCE * chain.reach();
        let axes: Vec<_> = chain.screws().iter().map(Screw::axis).collect();
        let is_one = |pair: &[Option<&Axis>]| match pair {
            [Some(one), Some(other)] => one.relation(other, tolerance) == Relation::Coincident,
            _ => false,
        };
        axes.windows(2).position(is_one)
    }

    /// The joints and the tip from a base frame, and whether the joints' axes are rational.
    fn walk_from(&self, base: Frame) -> ((Vec<Joint>, Frame), Rationality) {
        let (mut joints, mut frame, mut told) = (Vec::new(), base.then(&self.base), Rationality::default());
        for row in &self.rows {
            if self.convention == DhConvention::Modified {
                frame = frame.then(&row.about_x());
            }
            joints.push(row.joint(&frame));
            told.add(frame.rationality(&along_z()));
            frame = frame.then(&row.about_z());
            if self.convention == DhConvention::Standard {
                frame = frame.then(&row.about_x());
            }
        }
        ((joints, frame.then(&self.tool)), told)
    }

    /// Same mechanism in screw axes, its numbers as described.
    ///
    /// # Errors
    /// As [`Chain::new`].
    pub fn chain(&self) -> Result<Chain> {
        self.assemble().map_err(|fault| fault.error)
    }

    pub(super) fn assemble(&self) -> std::result::Result<Chain, Fault> {
        check_count(self.rows.len())?;
        let walked = |reading| {
            let Ok((joints, tip)) = Frame::walked(reading, |base| Ok::<_, Infallible>(self.walk_from(base)));
            (joints, tip.tip())
        };
        let ((joints, tip), (meant, tip_meant)) = (walked(Reading::AsDescribed), walked(Reading::AsMeant));
        Chain::assemble(ChainParts {
            name: self.name.clone(),
            description: self.description.clone(),
            source: self.source.clone(),
            length_unit: self.length_unit,
            meant: Meant::unless_told(meant, tip_meant, (&joints, &tip)),
            joints,
            tip,
            task: self.task,
            direction: self.direction.clone(),
            given: self.given.clone(),
            order: None,
            choice: None,
        })
    }
}
