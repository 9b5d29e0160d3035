//! The nine parameters of a walk that may change during the walk, RH0 5.2.3. Main type: [`Figures`].

use crate::gait::{Biped, Gait, GaitDefaults, Laws};
use crate::{Error, ErrorKind, Result};
use groebot_robot::document::{one_among, shown};

/// A parameter by its name in the thesis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Figure {
    /// Its name in the thesis.
    pub name: &'static str,
    /// Its description.
    pub what: &'static str,
    /// The unit of its value.
    pub unit: &'static str,
}

/// The parameters in the order of [`Figures::values`].
pub const FIGURES: [Figure; 9] = [
    Figure { name: "Lp", what: "step length", unit: "m" },
    Figure { name: "Hp", what: "step height", unit: "m" },
    Figure { name: "Wp", what: "step width: half of the distance between the feet", unit: "m" },
    Figure { name: "Gcm", what: "greatest turn of a step", unit: "deg" },
    Figure { name: "Hcm", what: "height of the trunk above the ankles", unit: "m" },
    Figure { name: "Kcm", what: "half of the trunk's rise and fall", unit: "m" },
    Figure { name: "RAas", what: "distance of the centre of mass from the middle of a sole", unit: "m" },
    Figure { name: "Pocm", what: "exponent of the lateral trajectory", unit: "1" },
    Figure { name: "Ca", what: "cadence", unit: "steps/s" },
];

/// Options of `groebot walk`, with the parameters that stand for them in a page.
const FIELDS: [(&str, &str); 9] = [
    ("--length", "Lp"),
    ("--lift", "Hp"),
    ("--half-width", "Wp"),
    ("--max-turn", "Gcm"),
    ("--hip-height", "Hcm"),
    ("--dip", "Kcm"),
    ("--amplitude", "RAas"),
    ("--power", "Pocm"),
    ("--period", "1/Ca"),
];

/// A message with the names of a page's fields instead of the options of the command line. An option without a field
/// becomes its words.
pub fn with_fields(message: &str) -> String {
    let named = FIELDS.iter().fold(message.to_owned(), |text, (option, field)| text.replace(option, field));
    named.replace(" --", " ").replace("(--", "(")
}

/// The lowest cadence \[steps/s\]; that of the experiments is 0.043.
const SLOWEST: f64 = 0.01;

/// Values of all parameters in their units.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Figures {
    /// In the order of [`FIGURES`]; the power is NaN for laws without one.
    pub values: [f64; 9],
}

/// Parameters of the thesis under the title of their section.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Preset {
    /// The section.
    pub name: &'static str,
    /// The parameters.
    pub figures: Figures,
}

/// RH0's parameters that all sections share, with the turn, the radius and the cadence that differ.
const fn rh0(most_turn: f64, support_radius: f64, cadence: f64) -> Figures {
    Figures { values: [0.16, 0.1, 0.112, most_turn, 0.58, 0.004, support_radius, 4.0, cadence] }
}

/// The parameters of the thesis. Where a section does not give one (the turn in 5.3.1, length and width in 5.3.2) it is
/// that of 5.5.
pub const PRESETS: [Preset; 5] = [
    Preset { name: "5.3.1 four steps", figures: rh0(15.0, 0.06, 0.3429) },
    Preset { name: "5.3.2 turn", figures: rh0(15.0, 0.06, 0.3429) },
    Preset { name: "5.5 whole task", figures: rh0(15.0, 0.06, 0.3429) },
    Preset { name: "6.2.1 four steps, experiment", figures: rh0(15.0, 0.03, 0.043) },
    Preset { name: "6.2.2 turn, experiment", figures: rh0(10.0, 0.03, 0.043) },
];

impl Figures {
    /// The parameters of a gait by one step goal at a hip height \[m\].
    pub fn of(biped: &Biped, defaults: &GaitDefaults, hip_height: f64) -> Self {
        let (dip, power) = match defaults.gait {
            Gait::OneStep(own) => (own.dip, if let Laws::Rh0 { power } = own.laws { power } else { f64::NAN }),
            _ => (0.0, f64::NAN),
        };
        let half_width = defaults.half_width(biped);
        Figures {
            values: [
                defaults.length,
                defaults.lift,
                half_width,
                defaults.most_turn.to_degrees(),
                hip_height + over_ankles(biped),
                dip,
                half_width - defaults.amplitude,
                power,
                1.0 / defaults.period,
            ],
        }
    }

    /// Sets these parameters in a gait. The fraction of double support in a step stays.
    pub fn put(&self, biped: &Biped, defaults: &GaitDefaults) -> GaitDefaults {
        let [length, lift, half_width, turn, height, own_dip, radius, own_power, cadence] = self.values;
        let mut defaults = defaults.clone();
        (defaults.length, defaults.lift, defaults.half_width) = (length, lift, Some(half_width));
        (defaults.most_turn, defaults.amplitude, defaults.period) =
            (turn.to_radians(), half_width - radius, 1.0 / cadence);
        defaults.hip_heights = vec![height - over_ankles(biped)].into();
        if let Gait::OneStep(one_step) = &mut defaults.gait {
            one_step.dip = own_dip;
            if let Laws::Rh0 { power } = &mut one_step.laws {
                *power = own_power;
            }
        }
        defaults
    }

    /// Sets one of the values.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] for a name that is not in [`FIGURES`]; [`ErrorKind::Unsupported`] for a power where
    /// the laws have none; [`ErrorKind::BadValue`] for a value that is not finite and positive (the rise and fall may
    /// be zero), or a cadence below 0.01.
    pub fn with(mut self, name: &str, value: f64) -> Result<Self> {
        let names = FIGURES.map(|figure| figure.name);
        let place = names.iter().position(|own| *own == name).ok_or_else(|| {
            let text = format!("there is no parameter `{}`{}", shown(name), one_among(name, &names));
            Error::new(ErrorKind::UnknownName, text)
        })?;
        if self.values[place].is_nan() {
            let text = format!("{name}: the laws of this gait have no power");
            return Err(Error::new(ErrorKind::Unsupported, text));
        }
        if !(value.is_finite() && (value > 0.0 || name == "Kcm" && value == 0.0)) {
            let text = format!("{name} is {value} {}; give a positive number", FIGURES[place].unit);
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        if name == "Ca" && value < SLOWEST {
            let text = format!("Ca is {value} steps/s; give at least {SLOWEST}");
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        self.values[place] = value;
        Ok(self)
    }
}

/// The height of the trunk's frame above the ankles minus that of the hips above the floor.
fn over_ankles(biped: &Biped) -> f64 {
    biped.hip_to_torso() - biped.feet[0].ankle_height
}
