//! What the values of a map's image mean, as ROS' `map_server` has it. Main type: [`Meaning`].

use super::map::Cell;
use super::yaml::{Entry, Value, entries};
use crate::{Error, ErrorKind, Result};
use groebot_robot::document::shown;

/// From which occupancy of `nav_msgs/OccupancyGrid` on there is none: 0 to 100 are percent, others have not been seen.
const FULL: f64 = 100.0;
/// The greatest value of a byte.
const BYTE: f64 = 255.0;

/// How the values of an image become occupancies, as `map_server` has it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mode {
    /// The share of black is compared with the thresholds; what is between them has not been seen. An alpha channel counts as a fourth colour.
    #[default]
    Trinary,
    /// Between the thresholds the occupancy grows from 0 to 100 percent; what is not opaque has not been seen.
    Scale,
    /// The value of a byte is the occupancy in percent; above 100 it has not been seen.
    Raw,
}

impl Mode {
    /// All of them.
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

/// What an image's values mean, as `map_server` has it.
#[derive(Clone, Debug, PartialEq)]
pub struct Meaning {
    /// The side of a pixel \[m\].
    pub resolution: f64,
    /// The lower left corner in the world: x, y \[m\] and yaw \[rad\].
    pub origin: [f64; 3],
    /// Whether white is occupied; not looked at in the mode `raw`.
    pub negate: bool,
    /// Above which share of black a pixel is occupied, and below which it is free; in the mode `raw`, above and below which occupancy.
    pub thresholds: [f64; 2],
    /// How values become occupancies.
    pub mode: Mode,
}

impl Meaning {
    /// That of a side of a pixel \[m\], all else as `map_server` has it: black is occupied, white is free, and grey has not been seen.
    pub fn new(resolution: f64) -> Self {
        Meaning { resolution, origin: [0.0; 3], negate: false, thresholds: [0.65, 0.196], mode: Mode::Trinary }
    }

    /// The image's name and what it means, of a YAML that `map_server` reads: block or flow style, comments, anchors and aliases. Keys that `map_server` does
    /// not know are ignored.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] for what is no YAML, is nested more than a few levels or repeats too much; [`ErrorKind::DuplicateName`] for a key that stands
    /// twice; [`ErrorKind::BadValue`] for another value than the key allows; all with the line. [`ErrorKind::MissingKey`] without image or resolution.
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
        // In this mode `map_server` takes alpha for one colour more beside red, green and blue.
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

    /// The cell of an occupancy from 0 to 1. Between the thresholds nobody knows whether it is free.
    fn known(&self, occupancy: f64) -> Cell {
        match occupancy {
            share if share > self.thresholds[0] => Cell::Occupied,
            share if share < self.thresholds[1] => Cell::Free,
            _ => Cell::Unknown,
        }
    }
}

/// Values as `map_server` reads them.
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
        self.number().filter(|share| (0.0..=1.0).contains(share)).ok_or_else(|| self.bad("a share from 0 to 1"))
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
