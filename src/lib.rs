//! Closed-form inverse kinematics that is complete and proven: from a description of a mechanism to a solver of all solutions.
//!
//! The modules are in the order of the data flow. Each stage is a plain struct that implements `Display`.
//!
//! ```
//! use groebot::codegen;
//! use groebot::kinematics::Target;
//! use groebot::model::Robot;
//!
//! // A robot from its description, here with angles of 1.5708, and the chain from its root to its tip.
//! let robot = Robot::read("tests/corpus/urdf/ur5.urdf")?;
//! let chain = robot.chain(None, None)?;
//!
//! // Its solver: the order of the joints, a Groebner basis for each step with its proof, a program.
//! let derivation = groebot::derive(&chain)?;
//! let solver = derivation.solver();
//!
//! // All solutions of a pose, checked by forward kinematics.
//! let pose = chain.forward(&[0.1, -1.2, 1.4, -0.3, 0.8, 0.5])?;
//! let solutions = solver.solve(&pose)?;
//! assert_eq!(solutions.len(), 8);
//! for solution in &solutions {
//!     let [distance, angle] = Target::Pose(pose).missed(&chain, &solution.q);
//!     assert!(distance < 1e-12 && angle < 1e-12);
//! }
//!
//! // The same solver as source code.
//! assert!(codegen::rust::emit(derivation.program()).contains("shoulder_pan"));
//! # Ok::<(), groebot::Error>(())
//! ```
//!
//! A mechanism may have one block of equations, such as NAO's leg in its sagittal plane. [`derive::Derivation`] displays its polynomials:
//! `examples/02_planar_leg.rs`.
#![cfg_attr(test, allow(missing_docs))]

pub use groebot_algebra::{Error, ErrorKind, Result, Watch};
pub use groebot_ik::derive::derive;
/// Version of nalgebra whose types the interface has.
pub use nalgebra;

pub use groebot_algebra::real;
pub use groebot_humanoid::{gait, nav, sim, view};
pub use groebot_ik::{codegen, reach};

/// Control laws: torques of a robot that follows a trajectory, and feedback of a walk.
pub mod control {
    pub use groebot_humanoid::stabilizer::{JointTargets, SoleForce, Stabilizer, StabilizerGains, State};
    pub use groebot_robot::control::*;
}

// Shared by the command line, the wheel and the fuzz targets; not part of the interface.
#[doc(hidden)]
pub use groebot_algebra::{escape, limits, random};
#[doc(hidden)]
pub use groebot_robot::{document, files};

/// Exact numbers: rings and fields as values.
pub mod number {
    pub use groebot_algebra::number::{
        BigInt, BigRational, Extension, Field, PrimeElement, Rationals, Ring, Style, Zp, parse_rational,
    };
}

/// Polynomials over any field: parser, printer, orders, gcd, factorization, rational functions.
pub mod poly {
    pub use groebot_algebra::poly::{
        Block, ExpansionBound, Expression, Factorisation, Fraction, Fractions, Layout, Monomial, Order, Polynomial,
        PolynomialRing, Term, factor, gcd, parse, parse_equation, parse_latex, system,
    };
}

/// Groebner bases: F4, FGLM, modular, parametric.
pub mod groebner {
    pub use groebot_algebra::groebner::{
        Basis, Division, HilbertSeries, Options, Quotient, Settings, Strategy, System, UnivariateRepresentation, basis,
        basis_modulo_prime, change_order, cover, dehomogenise, divide, f4_with, homogenise, ideal, modular,
        normal_form, parametric, reduced_basis, s_polynomial, univariate_representation, verify,
    };
}

/// Real roots of univariate polynomials: exact over Q, and in `f64` as in the run time.
pub mod roots {
    pub use groebot_algebra::roots::{Interval, real_roots};
}

/// Rigid motions: poses, twists, wrenches, screws, inertias.
pub mod spatial {
    pub use groebot_robot::spatial::{
        Axis, Inertia, Pose, RollPitchYaw, Screw, ScrewCoordinates, Twist, Wrench, angle, intersection, matrix, pose,
        roll_pitch_yaw, rotation,
    };
}

/// Robots as described: a tree of links and joints with masses, shapes and limits.
pub mod model {
    pub use groebot_robot::model::{
        Actuator, Fault, Joint, JointType, LengthUnit, Link, Mass, Meshes, Mimic, Origin, Part, ReadOptions, Robot,
        RobotParts, Shape, Solid, Surface,
    };
    /// Expansion of descriptions in xacro.
    pub mod xacro {
        pub use groebot_robot::model::xacro::{Expanded, expand};
    }
}

/// Serial chains: forward kinematics, Jacobians, screw theory, and the interface of all solvers.
pub mod kinematics {
    pub use groebot_robot::kinematics::{
        BaseAxis, Chain, ChainParts, Choice, DhConvention, DhRow, DhTable, ExactMatrix, ExactRotation, ExactVector,
        Geometry, InverseKinematics, Joint, JointKind, Layout, LengthUnit, LinkPath, Meant, Mimic, Placed, Placement,
        Plane, Quantity, Root, Solution, Target, TargetNumber, Task, Tip, TipChoice, Turn, jacobian, numeric, screw,
    };
    /// The nearest ideal robot, and what it changes.
    pub mod ideal {
        pub use groebot_robot::kinematics::ideal::Report;
    }
}

/// Robots by name: chains and descriptions, and humanoids with their walks.
pub mod robots {
    pub use groebot_humanoid::walkers::*;
    pub use groebot_robot::robots::*;
}

/// Motions in time: trajectories, tables of states, and paths of a chain's tip.
pub mod motion {
    pub use groebot_robot::motion::{
        Contact, Figure, Followed, JointTrack, Jump, Pace, PathRequest, Spline, StateRow, StateTable, Track,
        Trajectory, follow,
    };
}

/// Rigid-body dynamics: RNEA, CRBA, ABA, regressor, identification.
pub mod dynamics {
    pub use groebot_robot::dynamics::{
        Base, Clearance, Consistency, Equations, Estimate, Finding, FindingKind, Identification, Logged, Model,
        ModelJoint, Momentum, Placed, State, Touch, Workspace,
    };
    /// Polynomial equations of motion with a certificate.
    pub mod exact {
        pub use groebot_robot::dynamics::exact::{Certificate, ExactModel, Masses, Symbolic};
    }
}

/// Derived solvers: their programs, targets in batches, and solutions.
pub mod solver {
    pub use groebot_ik::solver::{
        About, Batch, Block, Case, Checks, ClosedSearch, Closest, ClosestOptions, Condition, Described, ErrorWeights,
        Following, Forward, GivenJoint, Guard, Input, Instruction, Joint, JointValue, MAX_JOINTS, Nearest, Operand,
        Operation, Pairs, ParameterRule, Pivot, PlacedSolver, Placement, Preference, Program, Reached, Redundancy,
        RedundantPart, Rule, Section, Short, Solved, Solver, Step, TaskPlacement, TipTask, Unit,
    };
    /// All solutions within limits of a chain with one joint more than its task determines.
    pub mod redundant {
        pub use groebot_ik::solver::redundant::{
            Absence, Arc, ArcEnd, Arcs, ArmJump, ArmPath, ArmTarget, Best, BestByArc, Criterion, JointLimits,
            PathOptions, RedundantSolver, Scanned, ScanningSolver, Turns, Within,
        };
    }
}

/// From a description to a proved solver.
pub mod derive {
    pub use groebot_ik::derive::{
        Choice, Derivation, Description, Ends, Equation, Input, InputFile, JointKindUnknown, JointUnknown, LengthUnit,
        Method, Options, Parameter, ParameterSource, Quantity, Recount, Root, Source, System, SystemParts, derive,
        formulate,
    };
    /// Chains whose joints share actuators.
    pub mod coupled {
        pub use groebot_ik::derive::coupled::{Actuator, CoupledChain, CoupledChains, CoupledParts, JointPlace};
    }
    /// The solvers of a chain with one joint more than its task determines, one for each joint as the given one.
    pub mod redundant {
        pub use groebot_ik::derive::planner::is_redundant;
        pub use groebot_ik::derive::redundant::{Part, RedundantChain};
    }
    /// Reports of derivations.
    pub mod report {
        pub use groebot_ik::derive::report::explain;
    }
}

/// From a map to a path, to footsteps, to joint angles: the whole task of a walking robot.
pub mod task {
    pub use groebot_humanoid::task::{
        Blocked, Body, Floor, Goal, Method, Navigator, Obstacle, Pilot, Plan, Reach, Reason, Refusal,
    };
}

/// Numeric checks of derived solvers by independent witnesses.
pub mod witness {
    pub use groebot_ik::witness::{Accuracy, Class, Draws, Fault, Kind, Options, Report, Row, Summary, Verdict, check};
}

/// Folders of mechanisms: their files, and the check of a stored folder.
pub mod folder {
    pub use groebot_ik::folder::{
        CERTIFICATE, CHECKS, DYNAMICS, DYNAMICS_TEXT, Finding, PROGRAM, SolverCache, Stored, Verdict, check, check_by,
        derived, program, prove_text, reprove,
    };
}

#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod cli;
