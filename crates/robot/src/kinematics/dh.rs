//! Denavit-Hartenberg tables and their conversion to screw axes. Main type: [`DhTable`].
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

/// The convention of a table: where its frames are.
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
    /// The suffix of c, s or d in the names of its unknowns.
    pub symbol: String,
    /// The type of the joint.
    pub kind: JointKind,
    /// The angle about z at the joint value zero.
    pub theta: Turn,
    /// The distance along z at the joint value zero.
    pub d: BigRational,
    /// The distance along x; in the modified convention, a_(i-1).
    pub a: BigRational,
    /// The angle about x; in the modified convention, alpha_(i-1).
    pub alpha: Turn,
    /// Minimum and maximum value of the joint, in radians or the table's length unit.
    pub limits: Option<(f64, f64)>,
}

/// A Denavit-Hartenberg table with a base frame and a tool frame.
#[derive(Clone, Debug, PartialEq)]
pub struct DhTable {
    /// The name of the mechanism.
    pub name: String,
    /// Description of the mechanism.
    pub description: Option<String>,
    /// Source of its numbers.
    pub source: Option<String>,
    /// The unit of every length.
    pub length_unit: LengthUnit,
    /// The convention.
    pub convention: DhConvention,
    /// Frame 0 in the base frame.
    pub base: Placement,
    /// The rows from base to tip.
    pub rows: Vec<DhRow>,
    /// The tip in the last frame.
    pub tool: Placement,
    /// The task of the tip.
    pub task: Task,
    /// The direction in the tip frame for the tasks `ray` and `direction`.
    pub direction: ExactVector,
    /// The names of the given joints.
    pub given: Vec<String>,
}

impl DhRow {
    /// Rotation about and translation along z, with the joint at zero.
    fn about_z(&self) -> Placement {
        let turned = Placement::turned([Turn::default(), Turn::default(), self.theta]);
        turned.then(&Placement::shifted(2, self.d.clone()))
    }

    /// Rotation about and translation along x.
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
    /// The reason to suspect that the table in `text` has the other convention, if there is one. Two neighbouring
    /// joints are coaxial, and with the other convention none are. The last row of a standard table has zero `a` and
    /// `alpha`, and so has the first row of a modified one.
    pub fn doubt_of(text: &str) -> Option<String> {
        let table = DhTable::from_toml(text).ok()?;
        let first = table.coincident()?;
        let (own, other) = (table.convention, table.convention.other());
        let names = [first, first + 1].map(|row| shown(&table.rows[row].name));
        if (DhTable { convention: other, ..table }).coincident().is_some() {
            return None;
        }
        Some(format!(
            "joints `{}` and `{}` are coaxial, which is typical of a {} table that is read as {}: try `convention = \"{}\"`",
            names[0],
            names[1],
            other.name(),
            own.name(),
            other.name()
        ))
    }

    /// The index of the first revolute joint that is coaxial with the next one.
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

    /// The joints and the tip, computed from a base frame, and whether the joints' axes are rational.
    fn walk_from(&self, base: Frame) -> ((Vec<Joint>, Frame), Rationality) {
        let (mut joints, mut frame, mut rational) = (Vec::new(), base.then(&self.base), Rationality::default());
        for row in &self.rows {
            if self.convention == DhConvention::Modified {
                frame = frame.then(&row.about_x());
            }
            joints.push(row.joint(&frame));
            rational.add(frame.rationality(&along_z()));
            frame = frame.then(&row.about_z());
            if self.convention == DhConvention::Standard {
                frame = frame.then(&row.about_x());
            }
        }
        ((joints, frame.then(&self.tool)), rational)
    }

    /// Converts the table to a chain with screw axes. Its numbers are those of the description.
    ///
    /// # Errors
    /// Those of [`Chain::new`].
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
            meant: Meant::unless_described(meant, tip_meant, (&joints, &tip)),
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
