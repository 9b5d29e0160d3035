//! The nine figures of a walk that may change on the way, RH0 5.2.3. Main type: [`Figures`].

use crate::gait::{Biped, Gait, Laws, Usual};
use crate::{Error, ErrorKind, Result};
use groebot_robot::document::{one_among, shown};

/// A figure by its name in the thesis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Figure {
    /// Its name in the thesis.
    pub name: &'static str,
    /// What it is.
    pub what: &'static str,
    /// The unit in which it is told.
    pub unit: &'static str,
}

/// The figures in the order of [`Figures::values`].
pub const FIGURES: [Figure; 9] = [
    Figure { name: "Lp", what: "step length", unit: "m" },
    Figure { name: "Hp", what: "step height", unit: "m" },
    Figure { name: "Wp", what: "step width: half of the way from foot to foot", unit: "m" },
    Figure { name: "Gcm", what: "greatest turn of a step", unit: "deg" },
    Figure { name: "Hcm", what: "height of the trunk over the ankles", unit: "m" },
    Figure { name: "Kcm", what: "half of the trunk's rise and fall", unit: "m" },
    Figure { name: "RAas", what: "how near to the middle of a sole the centre of mass comes", unit: "m" },
    Figure { name: "Pocm", what: "power of the sideways trajectory", unit: "1" },
    Figure { name: "Ca", what: "cadence", unit: "steps/s" },
];

/// The lowest cadence \[steps/s\]: that of the experiments is 0.043.
const SLOWEST: f64 = 0.01;

/// Values of all figures in their units.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Figures {
    /// In the order of [`FIGURES`]; the power is NaN for laws without one.
    pub values: [f64; 9],
}

/// Figures of the thesis under the title of the section that has them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Preset {
    /// The section.
    pub name: &'static str,
    /// The figures.
    pub figures: Figures,
}

/// RH0's figures that all sections share, with the turn, the radius and the cadence that they do not.
const fn rh0(most_turn: f64, support_radius: f64, cadence: f64) -> Figures {
    Figures { values: [0.16, 0.1, 0.112, most_turn, 0.58, 0.004, support_radius, 4.0, cadence] }
}

/// The figures of the thesis: where a section does not tell one (the turn in 5.3.1, length and width in 5.3.2) it is that of 5.5.
pub const PRESETS: [Preset; 5] = [
    Preset { name: "5.3.1 four steps", figures: rh0(15.0, 0.06, 0.3429) },
    Preset { name: "5.3.2 turn", figures: rh0(15.0, 0.06, 0.3429) },
    Preset { name: "5.5 whole task", figures: rh0(15.0, 0.06, 0.3429) },
    Preset { name: "6.2.1 four steps, experiment", figures: rh0(15.0, 0.03, 0.043) },
    Preset { name: "6.2.2 turn, experiment", figures: rh0(10.0, 0.03, 0.043) },
];

impl Figures {
    /// Those of a gait by one step goal at a height of the hip \[m\].
    pub fn of(biped: &Biped, usual: &Usual, hip_height: f64) -> Self {
        let (dip, power) = match usual.gait {
            Gait::OneStep(own) => (own.dip, if let Laws::Rh0 { power } = own.laws { power } else { f64::NAN }),
            _ => (0.0, f64::NAN),
        };
        let half_width = usual.half_width(biped);
        Figures {
            values: [
                usual.length,
                usual.lift,
                half_width,
                usual.most_turn.to_degrees(),
                hip_height + over_ankles(biped),
                dip,
                half_width - usual.amplitude,
                power,
                1.0 / usual.period,
            ],
        }
    }

    /// The figures of a gait with these in place of its own. How long both feet stand keeps its share of a step.
    pub fn put(&self, biped: &Biped, usual: &Usual) -> Usual {
        let [length, lift, half_width, turn, height, own_dip, radius, own_power, cadence] = self.values;
        let mut usual = usual.clone();
        (usual.length, usual.lift, usual.half_width) = (length, lift, Some(half_width));
        (usual.most_turn, usual.amplitude, usual.period) = (turn.to_radians(), half_width - radius, 1.0 / cadence);
        usual.hip_heights = vec![height - over_ankles(biped)].into();
        if let Gait::OneStep(one_step) = &mut usual.gait {
            one_step.dip = own_dip;
            if let Laws::Rh0 { power } = &mut one_step.laws {
                *power = own_power;
            }
        }
        usual
    }

    /// The same with another value of one of them.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] for a name that is none of [`FIGURES`]; [`ErrorKind::Unsupported`] for a power where the laws have none; [`ErrorKind::BadValue`] for a value that
    /// is not finite and positive (the rise and fall may be zero), or a cadence below 0.01.
    pub fn with(mut self, name: &str, value: f64) -> Result<Self> {
        let names = FIGURES.map(|figure| figure.name);
        let place = names.iter().position(|own| *own == name).ok_or_else(|| {
            let text = format!("there is no figure `{}`{}", shown(name), one_among(name, &names));
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

/// How much higher the trunk's frame is over the ankles than the hips are over the floor.
fn over_ankles(biped: &Biped) -> f64 {
    biped.hip_to_torso() - biped.feet[0].ankle_height
}
