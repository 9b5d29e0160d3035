//! The columns of tables that are piped from one command into another: `fk`, `ik` and `solve` write them and read each
//! other's tables. Main type: [`Columns`].
//!
//! A column is found by its name. A name may end in the unit of its numbers (`x_mm`, `A1_deg`); without one they are in
//! the reader's default unit. Other columns of these commands are ignored; unknown columns are errors.

use csv::StringRecord;

use crate::{Error, ErrorKind, Result};
use groebot_robot::document::shown;
use groebot_robot::kinematics::{Joint, JointKind, Quantity, TargetNumber, Task};

/// Units at the end of a column's name.
const UNITS: [&str; 4] = ["_mm", "_m", "_rad", "_deg"];
/// Columns that the commands write in addition to targets and joints.
const BESIDE: [&str; 13] = [
    "target",
    "solutions",
    "branch",
    "residual",
    "position_residual",
    "rotation_residual",
    "chosen",
    "settled",
    "free",
    "outside_limits",
    "closest_distance",
    "closest_angle",
    "time",
];
/// Numbers of poses that are numbers of no task, without units.
const POSES: [&str; 7] = ["x", "y", "z", "qx", "qy", "qz", "qw"];

/// A number that a reader needs.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    /// Its name, such as `px` or that of a joint.
    pub name: String,
    /// Its quantity.
    pub quantity: Quantity,
    /// The number of a target that it is; `None` for a joint and others.
    pub number: Option<TargetNumber>,
}

impl Field {
    /// The field with this name and quantity.
    pub fn new(name: &str, quantity: Quantity) -> Field {
        Field { name: name.to_owned(), quantity, number: None }
    }

    /// The field of a number of a target.
    pub fn of_target(number: TargetNumber) -> Field {
        Field { number: Some(number), ..Field::new(&number.name(), number.quantity()) }
    }

    /// Another name of its column, without unit: `x` for `px`.
    fn short(&self) -> Option<&'static str> {
        match self.number {
            Some(TargetNumber::Position(axis)) => Some(axis.name()),
            _ => None,
        }
    }
}

/// The columns that a reader of a table takes, and those that it ignores.
#[derive(Clone, Debug)]
pub struct Columns {
    /// The numbers of a row, in each permitted form. A row without names has the first form if its number of cells fits
    /// no other.
    pub forms: Vec<Vec<Field>>,
    /// Joints whose columns are ignored.
    pub joints: Vec<String>,
    /// Whether lengths without a unit are in millimetres; else metres.
    pub millimetres: bool,
    /// Whether angles without a unit are in degrees; else radians.
    pub degrees: bool,
    /// Whether a row of a target without a solution (`solutions` is 0) is ignored: it has no joint values.
    pub skips_unsolved: bool,
}

/// The columns of a form's numbers in a row.
#[derive(Clone, Debug, PartialEq)]
pub struct Found {
    /// The index of the form.
    pub form: usize,
    /// The column of each number, and the conversion of its unit.
    columns: Vec<(usize, Scale)>,
    /// The number of columns with names.
    pub count: usize,
    /// The column with the number of solutions, where a row may have none.
    solutions: Option<usize>,
}

/// The conversion from the unit of a column to that of the reader.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Scale {
    Same,
    Times(f64),
    Over(f64),
    ToRadians,
    ToDegrees,
}

impl Scale {
    fn of(self, value: f64) -> f64 {
        match self {
            Scale::Same => value,
            Scale::Times(factor) => value * factor,
            Scale::Over(factor) => value / factor,
            Scale::ToRadians => value.to_radians(),
            Scale::ToDegrees => value.to_degrees(),
        }
    }
}

impl Columns {
    /// The names of a form.
    pub fn names(&self, form: usize) -> Vec<&str> {
        self.forms[form].iter().map(|field| field.name.as_str()).collect()
    }

    /// The form of a row of `count` cells without names.
    pub fn form_of(&self, count: usize) -> usize {
        self.forms.iter().position(|form| form.len() == count).unwrap_or(0)
    }

    /// The columns of the first form that is complete under these names.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] when every form lacks a number, and for a name that is neither read nor ignored.
    pub fn find(&self, names: &StringRecord) -> Result<Found> {
        let places =
            |form: &Vec<Field>| (0..form.len()).map(|index| self.place(form, index, names)).collect::<Option<Vec<_>>>();
        let found = self.forms.iter().enumerate().find_map(|(form, fields)| Some((form, places(fields)?)));
        let (form, columns) = found.ok_or_else(|| self.missing(names))?;
        if let Some(unknown) = names.iter().find(|name| !self.is_known(name)) {
            return Err(self.unknown(unknown));
        }
        // In tables of these commands, a joint may have the same name as a number of the pose, and a given joint has
        // two columns.
        let is_written = names.iter().any(|name| name == "outside_limits");
        let room = |name: &str| self.forms[form].iter().filter(|field| field.name == name).count().max(1);
        let is_repeated = |(place, name): &(usize, &str)| {
            !is_written && names.iter().take(*place).filter(|before| before == name).count() >= room(name)
        };
        if let Some((place, name)) = names.iter().enumerate().find(is_repeated) {
            let text =
                format!("column {} of the first row, `{}`, is given twice; give it once", place + 1, shown(name));
            return Err(Error::new(ErrorKind::UnknownName, text));
        }
        let solutions = names.iter().position(|name| name == "solutions");
        Ok(Found { form, columns, count: names.len(), solutions: solutions.filter(|_| self.skips_unsolved) })
    }

    /// The column of a number of a form: the one with its own name, else the first with its name in some unit. Of
    /// several numbers with one name each has a column, in order. `fk` writes joints before poses: in its tables a
    /// number of a target with the name of a joint has the last column with its name in some unit.
    fn place(&self, form: &[Field], index: usize, names: &StringRecord) -> Option<(usize, Scale)> {
        let field = &form[index];
        let with_name = |fields: &[Field]| fields.iter().filter(|other| other.name == field.name).count();
        let (rank, twins) = (with_name(&form[..index]), with_name(form));
        let own: Vec<usize> = (0..names.len()).filter(|place| names[*place] == field.name).collect();
        let all: Vec<(usize, &str)> = names.iter().enumerate().collect();
        let scaled = |&(place, name): &(usize, &str)| Some((place, self.scale(field, name)?));
        let has = |name: &str| names.iter().any(|own| own == name);
        let is_joint = self.joints.contains(&field.name);
        if field.number.is_some() && is_joint && has("outside_limits") && !has("solutions") {
            return all.iter().rev().find_map(scaled);
        }
        let own = if own.len() >= twins {
            return Some((own[rank], Scale::Same));
        } else if field.number.is_some() {
            own.first()
        } else {
            own.last()
        };
        all.iter().find_map(scaled).or(own.map(|place| (*place, Scale::Same)))
    }

    /// The conversion of the numbers under `name`, if they are those of `field`.
    fn scale(&self, field: &Field, name: &str) -> Option<Scale> {
        let (bare, unit) = split(name);
        let position = field.short() == Some(bare);
        if bare != field.name && !position || unit.is_empty() && self.joints.iter().any(|joint| joint == name) {
            return None;
        }
        match (field.quantity, unit) {
            (_, "") => Some(Scale::Same),
            (Quantity::Length, "_m") => Some(if self.millimetres { Scale::Times(1000.0) } else { Scale::Same }),
            (Quantity::Length, "_mm") => Some(if self.millimetres { Scale::Same } else { Scale::Over(1000.0) }),
            (Quantity::Angle, "_rad") => Some(if self.degrees { Scale::ToDegrees } else { Scale::Same }),
            (Quantity::Angle, "_deg") => Some(if self.degrees { Scale::Same } else { Scale::ToRadians }),
            _ => None,
        }
    }

    /// Whether a column of this name is read or ignored.
    fn is_known(&self, name: &str) -> bool {
        let bare = split(name).0;
        let own = self.forms.iter().flatten().map(|field| field.name.as_str());
        let mut known = own.chain(self.joints.iter().map(String::as_str)).chain(BESIDE).chain(POSES);
        let mut numbers = Task::all().into_iter().flat_map(|task| task.layout().numbers());
        known.any(|known| known == name || known == bare)
            || numbers.any(|number| [name, bare].contains(&&*number.name()))
    }

    fn missing(&self, names: &StringRecord) -> Error {
        let fewest = self.forms.iter().min_by_key(|form| form.len()).map_or(&[][..], Vec::as_slice);
        let lacking = (0..fewest.len()).find(|index| self.place(fewest, *index, names).is_none());
        let found: Vec<String> = names.iter().take(8).map(shown).collect();
        let wanted: Vec<&str> = fewest.iter().map(|field| field.name.as_str()).collect();
        let text = format!(
            "the first row (`{}`) has neither numbers nor the names of the inputs: `{}` is missing; {} are allowed",
            found.join(","),
            lacking.map_or("", |index| &fewest[index].name),
            wanted.join(", ")
        );
        Error::new(ErrorKind::UnknownName, text)
    }

    fn unknown(&self, name: &str) -> Error {
        let mut read: Vec<&str> = Vec::new();
        for name in self.forms.iter().flatten().map(|field| field.name.as_str()) {
            if !read.contains(&name) {
                read.push(name);
            }
        }
        let text = format!(
            "the column `{}` is not known; allowed: {}; ignored: joints, poses and {}",
            shown(name),
            read.join(", "),
            BESIDE.join(", ")
        );
        Error::new(ErrorKind::UnknownName, text)
    }
}

impl Found {
    /// The cells of a row with its numbers, each with the index of its column.
    pub fn cells<'r>(&'r self, record: &'r StringRecord) -> impl Iterator<Item = (usize, &'r str)> {
        self.columns.iter().map(|(column, _)| (*column, record.get(*column).unwrap_or("").trim()))
    }

    /// Converts the numbers of those cells to the reader's units.
    pub fn scaled(&self, numbers: Vec<f64>) -> Vec<f64> {
        numbers.into_iter().zip(&self.columns).map(|(number, (_, scale))| scale.of(number)).collect()
    }

    /// Whether a row is that of a target without a solution.
    pub fn is_unsolved(&self, record: &StringRecord) -> bool {
        self.solutions.is_some_and(|column| record.get(column).is_some_and(|cell| cell.trim() == "0"))
    }
}

/// The name of an output column, with the suffix for an angle in degrees.
pub fn heading(name: &str, is_angle: bool, degrees: bool) -> String {
    if is_angle && degrees { format!("{name}_deg") } else { name.to_owned() }
}

/// The fields of a chain's joints.
pub fn of_joints(joints: &[Joint]) -> Vec<Field> {
    let quantity = |kind| if kind == JointKind::Revolute { Quantity::Angle } else { Quantity::Length };
    joints.iter().map(|joint| Field::new(&joint.name, quantity(joint.kind))).collect()
}

/// A column's name without its unit, and the unit.
fn split(name: &str) -> (&str, &str) {
    let unit = UNITS.iter().find(|unit| name.len() > unit.len() && name.ends_with(*unit));
    unit.map_or((name, ""), |unit| name.split_at(name.len() - unit.len()))
}
