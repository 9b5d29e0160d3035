//! Trajectories as CSV: [`Trajectory::to_csv`], [`Trajectory::from_csv`].
//!
//! The first line is `# groebot trajectory 1`, the second `# robot: NAME`; then a row of names with their units, and
//! one row for each sample:
//!
//! | column | content |
//! | --- | --- |
//! | `time [s]` | the time |
//! | `q:NAME [rad]`, `q:NAME [m]` | a revolute or prismatic joint |
//! | `base_x [m]` .. `base_qw [1]` | the pose of the base in the world, with its quaternion xyzw |
//! | `NAME_x [m]` .. `NAME_qw [1]`, `NAME_stands [1]` | a contact: its pose, and 1 while it is in contact |
//! | `NAME_x [m]`, `NAME_y [m]`, `NAME_z [m]` | a point |
//! | `NAME [UNIT]` | a number |
//!
//! Numbers have nine decimals. A name with a comma or a quotation mark is quoted as in RFC 4180.

use std::fmt::Write;
use std::path::Path;

use nalgebra::{Point3, Quaternion, Translation3, UnitQuaternion};

use super::{Contact, Figure, JointTrack, Track, Trajectory};
use crate::document::{read_text, shown, unix_lines};
use crate::spatial::Pose;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::escape;
use groebot_algebra::limits;

/// The first line of a file.
const MARK: &str = "# groebot trajectory ";
/// The version of the format.
const FORMAT: u32 = 1;
/// Maximum size of a file in bytes.
pub const TABLE_LIMIT: u64 = limits::TABLE_BYTES;
/// Tolerance of the length of a quaternion that is written with nine decimals.
pub(super) const ROUNDING: f64 = 1e-6;
/// The suffixes of the columns of a pose, with their units.
const POSE: [(&str, &str); 7] =
    [("x", "m"), ("y", "m"), ("z", "m"), ("qx", "1"), ("qy", "1"), ("qz", "1"), ("qw", "1")];

impl Trajectory {
    /// Writes the trajectory as CSV in the format of [`table`](self).
    pub fn to_csv(&self) -> String {
        let mut text = format!("{MARK}{FORMAT}\n# robot: {}\n{}\n", escape::line(&self.robot), self.header());
        for sample in 0..self.times.len() {
            let row: Vec<String> = self.row(sample).into_iter().map(decimal).collect();
            // Writing to a string cannot fail.
            let _ = writeln!(text, "{}", row.join(","));
        }
        text
    }

    /// Reads a trajectory from a file.
    ///
    /// # Errors
    /// Those of [`read_text`] and [`Trajectory::from_csv`], with the file.
    pub fn read_csv(path: &Path) -> Result<Self> {
        Trajectory::from_csv(&read_text(path, TABLE_LIMIT)?).map_err(|error| error.in_file(path))
    }

    /// Reads a trajectory from `text` in the format of [`table`](self). The format has no limits and speeds of joints.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] for text that does not begin with `# groebot trajectory 1`, another version of the format,
    /// or a cell that is not a number; [`ErrorKind::MissingKey`] for a column that others require; those of
    /// [`Trajectory::check`]. With the line.
    pub fn from_csv(text: &str) -> Result<Self> {
        let text = unix_lines(text);
        let mut lines = text.lines().enumerate().map(|(place, line)| (place + 1, line));
        let first = lines.next().map_or("", |(_, line)| line);
        check_version(first)?;
        let mut trajectory = Trajectory::default();
        let mut header = None;
        for (place, line) in lines {
            match (line.strip_prefix('#'), &header) {
                (Some(remark), _) => {
                    if let Some(name) = remark.trim().strip_prefix("robot:") {
                        trajectory.robot = name.trim().to_owned();
                    }
                }
                (None, _) if line.trim().is_empty() => {}
                (None, None) => {
                    header = Some(Header::read(line, &mut trajectory).map_err(|error| error.at_line(place))?)
                }
                (None, Some(header)) => {
                    header.row(line, &mut trajectory).map_err(|error| error.at_line(place))?;
                }
            }
        }
        if header.is_none() {
            return Err(Error::new(ErrorKind::MissingKey, "there is no row of names; give `time [s]` and the joints"));
        }
        trajectory.check()?;
        Ok(trajectory)
    }

    /// The row of names.
    fn header(&self) -> String {
        let pose = |name: &str| POSE.map(|(end, unit)| format!("{name}_{end} [{unit}]")).to_vec();
        let mut names = vec!["time [s]".to_owned()];
        names.extend(self.joints.iter().map(|joint| format!("q:{} [{}]", joint.name, joint.unit())));
        if !self.base.is_empty() {
            names.extend(pose("base"));
        }
        for contact in &self.contacts {
            names.extend(pose(&contact.name));
            names.push(format!("{}_stands [1]", contact.name));
        }
        names.extend(
            self.points.iter().flat_map(|track| ["x", "y", "z"].map(|end| format!("{}_{end} [m]", track.name))),
        );
        names.extend(self.figures.iter().map(|figure| format!("{} [{}]", figure.name, figure.unit)));
        names.into_iter().map(quoted).collect::<Vec<_>>().join(",")
    }

    fn row(&self, sample: usize) -> Vec<f64> {
        let mut row = vec![self.times[sample]];
        row.extend(&self.q[sample]);
        row.extend(self.base.get(sample).into_iter().flat_map(pose_numbers));
        for contact in &self.contacts {
            row.extend(pose_numbers(&contact.poses[sample]));
            row.push(f64::from(u8::from(contact.stands[sample])));
        }
        row.extend(self.points.iter().flat_map(|track| track.at[sample].coords.iter().copied().collect::<Vec<_>>()));
        row.extend(self.figures.iter().map(|figure| figure.values[sample]));
        row
    }
}

fn check_version(first: &str) -> Result<()> {
    let version = first.trim_start_matches('\u{feff}').trim_end().strip_prefix(MARK);
    let text = match version {
        Some(version) if version.parse() == Ok(FORMAT) => return Ok(()),
        Some(other) => format!("the file has version `{}` of the format; this groebot reads {FORMAT}", shown(other)),
        None => format!("the first line is `{}`; a trajectory begins with `{MARK}{FORMAT}`", shown(first)),
    };
    Err(Error::new(ErrorKind::Syntax, text).at_line(1))
}

/// A cell of text.
fn quoted(text: String) -> String {
    if text.contains([',', '"']) { format!("\"{}\"", text.replace('"', "\"\"")) } else { text }
}

/// The cells of a row of text.
fn cells(line: &str) -> Vec<String> {
    let (mut cells, mut cell, mut is_quoted) = (Vec::new(), String::new(), false);
    let mut letters = line.chars().peekable();
    while let Some(letter) = letters.next() {
        match letter {
            '"' if is_quoted && letters.next_if_eq(&'"').is_some() => cell.push('"'),
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => cells.push(std::mem::take(&mut cell)),
            _ => cell.push(letter),
        }
    }
    cells.push(cell);
    cells
}

/// Refuses a column with a unit that is not in `allowed`.
fn check_unit((name, unit): (&str, &str), allowed: &[&str]) -> Result<()> {
    if allowed.contains(&unit) {
        return Ok(());
    }
    let text = format!("the column `{}` is in `{}`; give {}", shown(name), shown(unit), allowed.join(" or "));
    Err(Error::new(ErrorKind::BadValue, text))
}

/// The contents of a table's columns.
struct Header {
    columns: usize,
    joints: Vec<usize>,
    base: Option<[usize; 7]>,
    /// The pose and the contact flag of each contact.
    contacts: Vec<([usize; 7], usize)>,
    points: Vec<[usize; 3]>,
    figures: Vec<usize>,
}

impl Header {
    /// Reads the row of names and creates the tracks of `trajectory`.
    fn read(line: &str, trajectory: &mut Trajectory) -> Result<Self> {
        let cells = cells(line);
        limits::check_count("columns", cells.len(), limits::COLUMNS)?;
        let names: Vec<(&str, &str)> = cells.iter().map(|cell| named(cell.trim())).collect::<Result<_>>()?;
        if names[0] != ("time", "s") {
            let text = format!("the first column is `{}`; give `time [s]`", shown(&cells[0]));
            return Err(Error::new(ErrorKind::MissingKey, text));
        }
        let find = |name: &str| names.iter().position(|(own, _)| *own == name);
        let all = |stem: &str, ends: &[&str]| {
            let places: Option<Vec<usize>> = ends.iter().map(|end| find(&format!("{stem}_{end}"))).collect();
            places
        };
        let pose =
            |stem: &str| all(stem, &POSE.map(|(end, _)| end)).and_then(|places| <[usize; 7]>::try_from(places).ok());
        let mut header = Header {
            columns: names.len(),
            joints: Vec::new(),
            base: pose("base"),
            contacts: Vec::new(),
            points: Vec::new(),
            figures: Vec::new(),
        };
        let check_pose = |places: &[usize; 7]| {
            places.iter().zip(POSE).try_for_each(|(at, (_, unit))| check_unit(names[*at], &[unit]))
        };
        header.base.iter().try_for_each(check_pose)?;
        let mut used: Vec<usize> = header.base.into_iter().flatten().collect();
        for (place, (name, unit)) in names.iter().enumerate().skip(1) {
            if used.contains(&place) {
                continue;
            }
            if let Some(joint) = name.strip_prefix("q:") {
                check_unit(names[place], &["rad", "m"])?;
                trajectory.joints.push(JointTrack {
                    name: joint.to_owned(),
                    slides: *unit == "m",
                    limits: None,
                    speed: None,
                });
                header.joints.push(place);
                continue;
            }
            let stem = name.strip_suffix("_x");
            let contact = stem.and_then(|stem| Some((stem, pose(stem)?, find(&format!("{stem}_stands"))?)));
            // Three numbers in another unit, such as a force, are not a point.
            let point = stem.and_then(|stem| Some((stem, all(stem, &["x", "y", "z"])?)));
            let point = point.filter(|(_, places)| places.iter().all(|at| names[*at].1 == "m"));
            match (contact, point) {
                (Some((stem, places, stands)), _) => {
                    check_pose(&places)?;
                    trajectory.contacts.push(Contact { name: stem.to_owned(), poses: Vec::new(), stands: Vec::new() });
                    header.contacts.push((places, stands));
                    used.extend(places);
                    used.push(stands);
                }
                (None, Some((stem, places))) => {
                    trajectory.points.push(Track { name: stem.to_owned(), at: Vec::new() });
                    used.extend(&places);
                    header.points.push([places[0], places[1], places[2]]);
                }
                (None, None) => {
                    let (name, unit) = ((*name).to_owned(), (*unit).to_owned());
                    trajectory.figures.push(Figure { name, unit, values: Vec::new() });
                    header.figures.push(place);
                }
            }
        }
        Ok(header)
    }

    /// Adds a sample.
    fn row(&self, line: &str, trajectory: &mut Trajectory) -> Result<()> {
        let cells: Vec<&str> = line.split(',').collect();
        if cells.len() != self.columns {
            let text = format!("{} cells; there are {} columns", cells.len(), self.columns);
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let number = |cell: &&str| {
            let syntax = |text: String| Error::new(ErrorKind::Syntax, text);
            match cell.trim().parse::<f64>() {
                Ok(value) if value.is_finite() => limits::number(cell).map_err(syntax),
                _ => Err(syntax(format!("`{}` is not a finite number", shown(cell)))),
            }
        };
        let numbers = cells.iter().map(number).collect::<Result<Vec<f64>>>()?;
        trajectory.times.push(numbers[0]);
        trajectory.q.push(self.joints.iter().map(|place| numbers[*place]).collect());
        if let Some(places) = self.base {
            trajectory.base.push(pose_of(places.map(|place| numbers[place]), ROUNDING)?);
        }
        for (contact, (places, stands)) in trajectory.contacts.iter_mut().zip(&self.contacts) {
            contact.poses.push(pose_of(places.map(|place| numbers[place]), ROUNDING)?);
            contact.stands.push(numbers[*stands] != 0.0);
        }
        for (track, places) in trajectory.points.iter_mut().zip(&self.points) {
            track.at.push(Point3::from(places.map(|place| numbers[place])));
        }
        for (figure, place) in trajectory.figures.iter_mut().zip(&self.figures) {
            figure.values.push(numbers[*place]);
        }
        Ok(())
    }
}

/// `time [s]` as name and unit.
fn named(cell: &str) -> Result<(&str, &str)> {
    let parts = cell.strip_suffix(']').and_then(|cell| cell.rsplit_once(" ["));
    parts.ok_or_else(|| {
        let text = format!("the column `{}` has no unit; give a name and a unit such as `time [s]`", shown(cell));
        Error::new(ErrorKind::Syntax, text)
    })
}

/// Position and quaternion xyzw.
pub fn pose_numbers(pose: &Pose) -> [f64; 7] {
    let (p, q) = (pose.translation.vector, pose.rotation.coords);
    [p.x, p.y, p.z, q.x, q.y, q.z, q.w]
}

/// The pose of a position and a quaternion xyzw.
///
/// # Errors
/// [`ErrorKind::BadValue`] for a quaternion whose length is not one within `rounding`.
pub fn pose_of([x, y, z, qx, qy, qz, qw]: [f64; 7], rounding: f64) -> Result<Pose> {
    let quaternion = Quaternion::new(qw, qx, qy, qz);
    let norm = quaternion.norm();
    if norm.is_nan() || (norm - 1.0).abs() > rounding {
        let text = format!("a quaternion has the length {norm}; give one of length one");
        return Err(Error::new(ErrorKind::BadValue, text));
    }
    // A quaternion of length one up to rounding is unchanged.
    let is_unit = (norm - 1.0).abs() < 1e-14;
    let rotation =
        if is_unit { UnitQuaternion::new_unchecked(quaternion) } else { UnitQuaternion::new_normalize(quaternion) };
    Ok(Pose::from_parts(Translation3::new(x, y, z), rotation))
}

/// Nine decimals, without a negative zero.
pub fn decimal(value: f64) -> String {
    let text = format!("{value:.9}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "0".into() } else { text.into() }
}
