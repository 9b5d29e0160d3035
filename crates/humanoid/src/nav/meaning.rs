//! The interpretation of a map image's values, as in ROS' `map_server`. Main type: [`Meaning`].

use super::map::Cell;
use super::yaml::{Entry, Value, entries};
use crate::{Error, ErrorKind, Result};
use groebot_robot::document::shown;

/// The greatest known occupancy of `nav_msgs/OccupancyGrid`: 0 to 100 are percent, other values are unknown.
const FULL: f64 = 100.0;
/// The greatest value of a byte.
const BYTE: f64 = 255.0;

/// The mapping from image values to occupancies, as in `map_server`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// The darkness is compared with the thresholds; values between them are unknown. An alpha channel counts as a
    /// fourth colour.
    #[default]
    Trinary,
    /// Between the thresholds the occupancy grows from 0 to 100 percent; pixels that are not opaque are unknown.
    Scale,
    /// The value of a byte is the occupancy in percent; above 100 it is unknown.
    Raw,
}

impl Mode {
    /// All modes.
    pub const ALL: [Mode; 3] = [Mode::Trinary, Mode::Scale, Mode::Raw];

    /// Its name: `trinary`, `scale` or `raw`.
    pub fn name(self) -> &'static str {
        match self {
            Mode::Trinary => "trinary",
            Mode::Scale => "scale",
            Mode::Raw => "raw",
        }
    }
}

/// The interpretation of an image's values, as in `map_server`.
#[derive(Clone, Debug, PartialEq)]
pub struct Meaning {
    /// The side of a pixel \[m\].
    pub resolution: f64,
    /// The lower left corner in the world: x, y \[m\] and yaw \[rad\].
    pub origin: [f64; 3],
    /// Whether white is occupied; ignored in the mode `raw`.
    pub negate: bool,
    /// The darkness above which a pixel is occupied, and below which it is free; in the mode `raw`, the occupancies.
    pub thresholds: [f64; 2],
    /// The mapping from values to occupancies.
    pub mode: Mode,
}

impl Meaning {
    /// The defaults of `map_server` with the given side of a pixel \[m\]: black is occupied, white is free, and grey is
    /// unknown.
    pub fn new(resolution: f64) -> Self {
        Meaning { resolution, origin: [0.0; 3], negate: false, thresholds: [0.65, 0.196], mode: Mode::Trinary }
    }

    /// Reads a YAML file of `map_server`: the image's name and its interpretation. Block and flow style, comments,
    /// anchors and aliases are supported. Keys that `map_server` does not know are ignored.
    ///
    /// # Errors
    /// All with the line: [`ErrorKind::Syntax`] for invalid YAML, deep nesting or too much repetition;
    /// [`ErrorKind::DuplicateName`] for a key that is given twice; [`ErrorKind::BadValue`] for a value that the key
    /// does not allow. [`ErrorKind::MissingKey`] without image or resolution.
    pub fn from_yaml(text: &str) -> Result<(String, Self)> {
        let (mut image, mut resolution, mut meaning) = (None, None, Meaning::new(1.0));
        for entry in entries(text)? {
            match &*entry.key {
                "image" => image = Some(entry.text()?),
                "resolution" => resolution = Some(entry.positive()?),
                "occupied_thresh" => meaning.thresholds[0] = entry.share()?,
                "free_thresh" => meaning.thresholds[1] = entry.share()?,
                "negate" => meaning.negate = entry.flag()?,
                "origin" => meaning.origin = entry.three()?,
                "mode" => meaning.mode = entry.mode()?,
                _ => {}
            }
        }
        let missing = |key: &str| Error::new(ErrorKind::MissingKey, format!("there is no `{key}`; it is required"));
        meaning.resolution = resolution.ok_or_else(|| missing("resolution"))?;
        Ok((image.ok_or_else(|| missing("image"))?, meaning))
    }

    /// The cell of a pixel by the mean of its colours and its alpha, both from 0 to 1; without alpha it is opaque.
    pub(super) fn cell(&self, mean: f64, alpha: Option<f64>) -> Cell {
        // In this mode `map_server` counts alpha as a colour in addition to red, green and blue.
        let counted = alpha.filter(|_| self.mode == Mode::Trinary);
        let white = counted.map_or(mean, |alpha| (3.0 * mean + alpha) / 4.0);
        match self.mode {
            Mode::Raw => {
                let percent = (white * BYTE).round();
                if percent > FULL { Cell::Unknown } else { self.known(percent / FULL) }
            }
            Mode::Scale if alpha.is_some_and(|alpha| alpha < 1.0) => Cell::Unknown,
            _ => self.known(if self.negate { white } else { 1.0 - white }),
        }
    }

    /// The cell for an occupancy from 0 to 1; between the thresholds it is unknown.
    fn known(&self, occupancy: f64) -> Cell {
        match occupancy {
            share if share > self.thresholds[0] => Cell::Occupied,
            share if share < self.thresholds[1] => Cell::Free,
            _ => Cell::Unknown,
        }
    }
}

/// Readers of values in the forms that `map_server` accepts.
impl Entry {
    fn bad(&self, allowed: &str) -> Error {
        let text = format!("`{}` is `{}`; give {allowed}", shown(&self.key), shown(&self.value.to_string()));
        Error::new(ErrorKind::BadValue, text).at_line(self.line)
    }

    fn text(&self) -> Result<String> {
        match &self.value {
            Value::Text(text) if !text.is_empty() => Ok(text.to_string()),
            _ => Err(self.bad("the name of a file")),
        }
    }

    fn number(&self) -> Option<f64> {
        number(&self.value)
    }

    fn positive(&self) -> Result<f64> {
        self.number().filter(|side| *side > 0.0).ok_or_else(|| self.bad("a positive number of metres"))
    }

    fn share(&self) -> Result<f64> {
        self.number().filter(|share| (0.0..=1.0).contains(share)).ok_or_else(|| self.bad("a fraction from 0 to 1"))
    }

    fn flag(&self) -> Result<bool> {
        let Value::Text(text) = &self.value else { return Err(self.bad("0 or 1")) };
        match text.to_ascii_lowercase().as_str() {
            "0" | "false" | "no" | "off" => Ok(false),
            "1" | "true" | "yes" | "on" => Ok(true),
            _ => Err(self.bad("0 or 1")),
        }
    }

    fn three(&self) -> Result<[f64; 3]> {
        let Value::List(list) = &self.value else { return Err(self.bad("[x, y, yaw]")) };
        let numbers: Option<Vec<f64>> = list.iter().map(number).collect();
        numbers.and_then(|numbers| numbers.try_into().ok()).ok_or_else(|| self.bad("[x, y, yaw]"))
    }

    fn mode(&self) -> Result<Mode> {
        let is_named = |mode: &Mode| matches!(&self.value, Value::Text(text) if **text == *mode.name());
        let names = Mode::ALL.map(Mode::name).join(", ");
        Mode::ALL.into_iter().find(is_named).ok_or_else(|| self.bad(&format!("one of {names}")))
    }
}

/// A finite number.
fn number(value: &Value) -> Option<f64> {
    let Value::Text(text) = value else { return None };
    text.parse().ok().filter(|number: &f64| number.is_finite())
}
