//! What is printed of equations of motion. Main type: [`Function`].

/// A function that can be printed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Function {
    /// Torques of a motion.
    Inverse,
    /// Torques against gravity.
    Gravity,
    /// The inertia matrix.
    Inertia,
    /// The Coriolis matrix of Christoffel's symbols.
    Coriolis,
    /// What torques change the velocity by.
    Forward,
    /// What inverse dynamics changes by with the configuration and the velocity.
    Derivatives,
}

impl Function {
    /// All of them.
    pub const ALL: [Function; 6] = [
        Function::Inverse,
        Function::Gravity,
        Function::Inertia,
        Function::Coriolis,
        Function::Forward,
        Function::Derivatives,
    ];

    /// Its name in code.
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
            Function::Inverse => "The torques that a motion asks for.",
            Function::Gravity => "The torques that hold the robot against gravity.",
            Function::Inertia => "The inertia matrix M, by rows.",
            Function::Coriolis => "The Coriolis matrix C of Christoffel's symbols, by rows: M' - 2 C is skew.",
            Function::Forward => "What torques change the velocity by.",
            Function::Derivatives => {
                "What the torques of a motion change by with the configuration, and with the velocity, by rows."
            }
        }
    }

    /// What it reads beside q.
    pub(super) fn inputs(self) -> &'static [&'static str] {
        match self {
            Function::Gravity | Function::Inertia => &[],
            Function::Coriolis => &["v"],
            Function::Inverse | Function::Derivatives => &["v", "a"],
            Function::Forward => &["v", "tau"],
        }
    }
}
