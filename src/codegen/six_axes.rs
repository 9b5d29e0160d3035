//! What the kernel of six axes needs in the skeletons `six_axes.*.txt` ([`text`]).

use serde::Serialize;

use super::language::Language;
use super::printer::number;
use crate::solver::eigenvalue::{Constants, Curve, ROOM, Rigid, SixAxes};
use crate::solver::{Program, Step};

/// Everything that the skeletons name.
#[derive(Serialize)]
struct Kernel {
    room: usize,
    #[serde(flatten)]
    constants: Constants,
    chains: Vec<ChainText>,
}

/// The tables of a chain.
#[derive(Serialize)]
struct ChainText {
    directions: Vec<Vec<String>>,
    points: Vec<Vec<String>>,
    across: Vec<Vec<Vec<String>>>,
    slides: [String; 6],
    steps: Vec<MotionText>,
    last: MotionText,
    back: MotionText,
    length: String,
    formulations: Vec<FormulationText>,
}

#[derive(Serialize)]
struct FormulationText {
    hidden: usize,
    second: String,
}

#[derive(Serialize)]
struct MotionText {
    rotation: Vec<Vec<String>>,
    translation: Vec<String>,
}

/// The steps of a program that find six joints together, in the order of their numbers from 1.
pub(super) fn steps(program: &Program) -> Vec<&SixAxes> {
    let steps = program.cases().flat_map(|case| &case.steps);
    steps.filter_map(|step| if let Step::SixAxes(six) = step { Some(six.as_ref()) } else { None }).collect()
}

/// The kernel with the chains of a program, for double or for single precision; empty for a program without.
pub(super) fn text(program: &Program, language: &dyn Language, single: bool) -> String {
    let chains = steps(program);
    if chains.is_empty() {
        return String::new();
    }
    let constants = if single { single_constants() } else { Constants::new() };
    let chains = chains.into_iter().map(ChainText::new).collect();
    super::fill(language.six_axes(), &Kernel { room: ROOM, constants, chains })
}

/// Shares of rounding in double precision become about those of rounding in single precision.
fn single_constants() -> Constants {
    Constants {
        merge: 2e-3,
        accept: 2e-5,
        sound: 1e-4,
        clear: 1e-3,
        accurate: 2e-2,
        unknown: 1e-5,
        off: 1e2,
        far_off: 1e3,
        disturbances: vec![0.0, 0.0, 0.0, 0.0, 1e-2, 1e-2, 3e-2, 3e-2],
        stages: 8,
        sound_origin: 1e-3,
        blurred: 1e-1,
        crowded: 1e-3,
        exact: 5e-7,
        rounding: 1e-5,
        singular: 2e-3,
        weak: 1e-2,
        apart: 2e-2,
        curve: Curve { level: 1e-5, settled: 1e-4, ..Constants::new().curve },
        ..Constants::new()
    }
}

fn numbers(values: &[f64]) -> Vec<String> {
    values.iter().map(|value| number(*value)).collect()
}

impl ChainText {
    fn new(six: &SixAxes) -> Self {
        let (solver, back) = six.tables();
        let across = |side: &[f64; 3]| numbers(side);
        ChainText {
            directions: solver.axes.iter().map(|axis| numbers(&axis.line.direction)).collect(),
            points: solver.axes.iter().map(|axis| numbers(&axis.line.point)).collect(),
            across: solver.frames.iter().map(|frame| frame.across.iter().map(across).collect()).collect(),
            slides: six.parts().slides.map(|slides| slides.to_string()),
            steps: solver.links.steps.iter().map(MotionText::new).collect(),
            last: MotionText::new(&solver.last),
            back: MotionText::new(back),
            length: number(solver.scale),
            formulations: solver
                .formulations()
                .iter()
                .map(|formulation| FormulationText {
                    hidden: formulation.hidden,
                    second: formulation.second.to_string(),
                })
                .collect(),
        }
    }
}

impl MotionText {
    fn new(motion: &Rigid) -> Self {
        MotionText {
            rotation: motion.rotation.iter().map(|row| numbers(row)).collect(),
            translation: numbers(&motion.translation),
        }
    }
}
