//! The printable functions of equations of motion. Main type: [`Function`].

/// A printable function.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Function {
    /// Inverse dynamics (RNEA): the torques of a motion.
    Inverse,
    /// The gravity torques.
    Gravity,
    /// The mass matrix (CRBA).
    Inertia,
    /// The Coriolis matrix from Christoffel symbols.
    Coriolis,
    /// Forward dynamics (ABA): the accelerations from torques.
    Forward,
    /// The derivatives of inverse dynamics with respect to the configuration and the velocity.
    Derivatives,
}

impl Function {
    /// All functions.
    pub const ALL: [Function; 6] = [
        Function::Inverse,
        Function::Gravity,
        Function::Inertia,
        Function::Coriolis,
        Function::Forward,
        Function::Derivatives,
    ];

    /// Its name in printed code.
    pub fn name(self) -> &'static str {
        match self {
            Function::Inverse => "inverse",
            Function::Gravity => "gravity",
            Function::Inertia => "inertia",
            Function::Coriolis => "coriolis",
            Function::Forward => "forward",
            Function::Derivatives => "derivatives",
        }
    }

    pub(super) fn about(self) -> &'static str {
        match self {
            Function::Inverse => "Inverse dynamics (RNEA): the torques of a motion.",
            Function::Gravity => "The gravity torques.",
            Function::Inertia => "The mass matrix M (CRBA), by rows.",
            Function::Coriolis => {
                "The Coriolis matrix C from Christoffel symbols, by rows: M' - 2 C is skew-symmetric."
            }
            Function::Forward => "Forward dynamics (ABA): the accelerations from torques.",
            Function::Derivatives => {
                "The derivatives of inverse dynamics (RNEA) with respect to the configuration and the velocity, by rows."
            }
        }
    }

    /// Its inputs in addition to q.
    pub(super) fn inputs(self) -> &'static [&'static str] {
        match self {
            Function::Gravity | Function::Inertia => &[],
            Function::Coriolis => &["v"],
            Function::Inverse | Function::Derivatives => &["v", "a"],
            Function::Forward => &["v", "tau"],
        }
    }
}
