//! What a program puts into the skeleton of a file, in one language.

use serde::Serialize;

use super::about::AboutText;
use super::batch::BatchText;
use super::blocks::{BlockText, ConditionText};
use super::body::Scene;
use super::code::Code;
use super::demand::{Demand, ParameterDemand};
use super::forward::{self, ForwardText, equations, printed_forward};
use super::lanes;
use super::language::Language;
use super::mirror::Mirror;
use super::names::{Names, remark};
use super::needs::{Needs, is_angle};
use super::printer::number;
use super::quartic::Quartic;
use super::samples::Table;
use super::six_axes;
use super::tolerances::{Arc, Tolerances};
use crate::document::word;
use crate::solver::{DAMPINGS, JointValue, LEAPS, Operand, Program, Short, TWINS_AT, Unit};

/// Shares of the squared Jacobian's size that are added where a plain Newton step fails, in single precision.
const SINGLE_DAMPINGS: [f64; 4] = [0.0, 1e-5, 1e-4, 1e-3];

/// Everything that the skeletons name.
#[derive(Serialize)]
pub(super) struct Outline {
    name: String,
    upper: String,
    version: &'static str,
    about: AboutText,
    /// Whether the text goes into another file: without head, declarations and what only serves callers.
    engine: bool,
    /// `whole` for one file, `header` and `source` for the two of a pair.
    part: &'static str,
    /// The name of a pair's header.
    header: String,
    inputs: Vec<Quantity>,
    /// The inputs with their units.
    target: Vec<String>,
    joints: Vec<Quantity>,
    extra: Vec<String>,
    /// Numbers of the arc tangent.
    arc: Arc,
    capacity: usize,
    isolated: Option<usize>,
    equations: usize,
    /// The highest degree of a root step; 0 without one.
    degree: usize,
    /// The quicker way to the roots of a quartic, where there is one to solve.
    quartic: Option<Quartic>,
    scale: String,
    tolerances: Tolerances,
    dampings: Vec<String>,
    leaps: Vec<String>,
    twins_at: Vec<String>,
    parameters: Parameters,
    conditions: Vec<ConditionText>,
    /// Names of the unknowns and the angles that go from block to block.
    passed: Vec<String>,
    /// The joints, those that are found last first.
    last_first: Vec<usize>,
    /// Those of them that are angles.
    last_angles: Vec<usize>,
    blocks: Vec<BlockText>,
    /// Values at which cases put free joints.
    samples: Vec<Table>,
    /// What finds six joints together, if a step does.
    six_axes: String,
    /// By joint that some case frees: by joint, whether it is this one.
    freed: Vec<Vec<String>>,
    /// Forward kinematics, if the program has them.
    forward: Option<ForwardText>,
    checks: Code,
    /// The equations' sizes, each once, and which of them is each equation's.
    sizes: Code,
    size_of: Vec<usize>,
    /// The unknowns that the equations can read, at joint values.
    placed: Vec<String>,
    /// Where cosines and sines stand among them.
    circles: Vec<Vec<usize>>,
    /// By joint: where its cosine and sine, or its value, stand among them.
    stands: Vec<Vec<usize>>,
    /// How many candidates are measured together, if they are.
    room: Option<usize>,
    /// By joint: its value at the candidate with index `k`, as an expression.
    values: Vec<String>,
    /// What the equations compare with the target, as values of any kind of number.
    generic: Vec<String>,
    /// What a batch of targets is solved by, if one is.
    batch: Option<BatchText>,
    /// Whether forward kinematics has an angle.
    aims: bool,
    /// Whether a block hands pairs of candidates on as one.
    pairs: bool,
    jacobian: Code,
    jacobian_rows: Vec<Vec<String>>,
    /// The equations of the short way to a solution nearby: for each its value, what that is a share of, and its derivatives.
    short: Code,
    short_rows: Vec<Vec<String>>,
    /// The same as values of any kind of number.
    short_generic: Vec<Vec<String>>,
    preference: Option<PreferenceText>,
    needs: Needs,
}

/// An input or a joint.
#[derive(Serialize)]
struct Quantity {
    name: String,
    quoted: String,
    unit: &'static str,
    is_angle: bool,
}

#[derive(Serialize)]
struct Parameters {
    lines: Vec<String>,
    fields: Vec<String>,
    /// The expression of the magnitude, if something reads it.
    magnitude: Option<String>,
    reads_target: bool,
}

#[derive(Serialize)]
struct PreferenceText {
    value: String,
    reads_q: bool,
    greatest: bool,
}

impl Outline {
    /// The outline of the part of a file that solves.
    pub fn engine(program: &Program, language: &dyn Language) -> Self {
        Outline { engine: true, ..Outline::new(program, language) }
    }

    /// Makes it that of a part of a pair whose header has the name `header`.
    pub fn be_part(&mut self, part: &'static str, header: &str) {
        (self.part, self.header) = (part, header.to_owned());
    }

    /// The outline of a file that computes in single precision.
    pub fn single(program: &Program, language: &dyn Language) -> Self {
        let dampings = SINGLE_DAMPINGS.iter().map(|&damping| number(damping)).collect();
        let outline = Outline::with(program, language, six_axes::text(program, language, true));
        let about = outline.about.and("Single precision");
        // In single precision hardly any quartic is ordinary.
        Outline { tolerances: Tolerances::single(), quartic: None, dampings, about, ..outline }
    }

    /// The outline of a valid program.
    pub fn new(program: &Program, language: &dyn Language) -> Self {
        Outline::with(program, language, six_axes::text(program, language, false))
    }

    /// The outline with this text of what finds six joints together.
    fn with(program: &Program, language: &dyn Language, six_axes: String) -> Self {
        let (names, tables) = (Names::new(program, language), Table::all(program));
        let (extra, lanes) = (extra_unknowns(program), false);
        let mut scene = Scene { program, language, names, extra, tables, mirror: None, lanes };
        scene.mirror = Mirror::of(program, &scene.wanted()).filter(|_| scene.extra.is_empty());
        let needs = Needs::new(program);
        let forward = printed_forward(&scene).filter(|_| needs.answers);
        let measured: &[Operand] = if needs.answers { &program.checks.scales } else { &[] };
        let (checks, sizes) = equations(&scene, forward.as_ref(), measured);
        let jacobian: Vec<&[Operand]> = program.checks.jacobian.iter().map(Vec::as_slice).collect();
        let aims = forward.as_ref().is_some_and(forward::aims);
        let forward = forward.map(|forward| ForwardText::new(&scene, &forward));
        scene.lanes = needs.answers && program.compares_tip();
        let (jacobian_lines, jacobian_rows) = scene.checks(&jacobian);
        let short: Vec<Vec<Operand>> =
            program.checks.short.iter().map(|one| one.operands().copied().collect()).collect();
        let (short_lines, short_rows) = scene.checks(&short.iter().map(Vec::as_slice).collect::<Vec<_>>());
        let unique = once(&sizes);
        let place = |size: &String| unique.iter().position(|other| other == size).unwrap_or(0);
        let size_of = sizes.iter().map(place).collect();
        let batch = language.walks_abreast().then(|| BatchText::new(&scene));
        let sizes = Code::new(language, checks.lines.clone(), alone(language, unique));
        let name = word(&program.name);
        let generic = forward.as_ref().map_or_else(Vec::new, |forward| lanes::generic(&forward.values));
        Outline {
            upper: name.to_ascii_uppercase(),
            name,
            version: env!("CARGO_PKG_VERSION"),
            about: AboutText::new(program, language),
            engine: false,
            part: "whole",
            header: String::new(),
            inputs: program.inputs.iter().map(|i| Quantity::new(language, &i.name, i.unit, false)).collect(),
            target: program.inputs.iter().map(|i| format!("`{}` ({})", remark(&i.name), unit_text(i.unit))).collect(),
            joints: joints(program, language),
            extra: scene.extra.iter().map(|&unknown| remark(&program.unknowns[unknown])).collect(),
            arc: Arc::new(),
            capacity: program.capacity,
            isolated: program.isolated.filter(|_| needs.answers),
            equations: checks.values.len(),
            degree: program.degree(),
            quartic: Quartic::of(program),
            freed: freed(program),
            scale: number(program.scale),
            tolerances: Tolerances::new(),
            dampings: DAMPINGS.iter().map(|&damping| number(damping)).collect(),
            leaps: LEAPS.iter().map(|&way| number(way)).collect(),
            twins_at: TWINS_AT.iter().map(|&times| number(times)).collect(),
            parameters: Parameters::new(&scene, &needs),
            conditions: program.conditions.iter().map(ConditionText::new).collect(),
            passed: scene.passed_names(),
            last_first: scene.last_first(),
            last_angles: scene.last_first().into_iter().filter(|&i| is_angle(program.joints[i].value)).collect(),
            samples: scene.tables.clone(),
            six_axes,
            blocks: (0..program.blocks.len()).map(|index| BlockText::new(&scene, index)).collect(),
            forward,
            size_of,
            checks,
            sizes,
            placed: scene.placed(),
            circles: scene.circles(),
            stands: scene.stands(),
            values: lanes::values(&scene),
            generic,
            batch,
            aims,
            room: scene.lanes.then(|| lanes::room(program)),
            pairs: scene.mirror.as_ref().is_some_and(|mirror| mirror.block + 1 < program.blocks.len()),
            jacobian: Code::new(language, jacobian_lines, jacobian_rows.concat()),
            jacobian_rows,
            short: Code::new(language, short_lines, short_rows.concat()),
            short_generic: short_rows.iter().map(|row| lanes::generic(row)).collect(),
            short_rows,
            preference: PreferenceText::new(&scene).filter(|_| needs.answers),
            needs,
        }
    }
}

/// Each text once, in the order of their first places.
fn once(list: &[String]) -> Vec<String> {
    let mut unique: Vec<String> = Vec::new();
    for text in list {
        if !unique.contains(text) {
            unique.push(text.clone());
        }
    }
    unique
}

/// Values of which constants are told from others.
fn alone(language: &dyn Language, values: Vec<String>) -> Vec<String> {
    let value = |value: String| if value.parse::<f64>().is_ok() { language.alone(value) } else { value };
    values.into_iter().map(value).collect()
}

impl Quantity {
    fn new(language: &dyn Language, name: &str, unit: Unit, is_angle: bool) -> Self {
        Quantity { name: remark(name), quoted: language.quote(name), unit: unit_text(unit), is_angle }
    }
}

impl Parameters {
    fn new(scene: &Scene<'_>, needs: &Needs) -> Self {
        let program = scene.program;
        let last = program.blocks.len() - 1;
        let mut readers: Vec<Demand> = Vec::new();
        for (index, block) in program.blocks.iter().enumerate() {
            let wanted = if index < last { scene.wanted_of(index) } else { scene.wanted() };
            readers.extend(scene.block_demands(block, &wanted));
        }
        let checks = &program.checks;
        readers.push(Demand::of_code(&checks.code, &checks.residuals));
        if needs.answers {
            readers.push(Demand::of_code(&checks.code, &checks.scales));
        }
        if needs.answers {
            readers.push(Demand::of_code(&checks.code, checks.jacobian.iter().flatten()));
            readers.push(Demand::of_code(&checks.code, checks.short.iter().flat_map(Short::operands)));
        }
        let demand = ParameterDemand::new(program, &readers.iter().collect::<Vec<_>>());
        let lines = scene.parameters(&demand);
        let named = scene.names.parameters.iter().zip(&demand.fields);
        Parameters {
            reads_target: lines.iter().any(|line| line.contains("target[")),
            lines,
            fields: named.filter(|(_, read)| **read).map(|(name, _)| name.clone()).collect(),
            magnitude: demand.magnitude.then(|| scene.magnitude()),
        }
    }
}

impl PreferenceText {
    fn new(scene: &Scene<'_>) -> Option<Self> {
        let preference = scene.program.preference?;
        let value = scene.unknown_at(preference.unknown);
        Some(PreferenceText {
            reads_q: value.is_some(),
            value: value.unwrap_or_else(|| number(0.0)),
            greatest: preference.greatest,
        })
    }
}

fn joints(program: &Program, language: &dyn Language) -> Vec<Quantity> {
    program.joints.iter().map(|j| Quantity::new(language, &j.name, j.unit, is_angle(j.value))).collect()
}

/// By joint that some case frees: by joint, whether it is this one.
fn freed(program: &Program) -> Vec<Vec<String>> {
    let alone = |one: usize| (0..program.joints.len()).map(|joint| (joint == one).to_string()).collect();
    program.freed().map(alone).collect()
}

/// Unknowns that the checks read and that follow from no joint.
fn extra_unknowns(program: &Program) -> Vec<usize> {
    let checks = &program.checks;
    let results = checks.residuals.iter().chain(&checks.scales).chain(checks.jacobian.iter().flatten());
    let demand = Demand::of_code(&checks.code, results);
    let is_joints = |unknown: usize| {
        program.joints.iter().any(|joint| match joint.value {
            JointValue::Angle { cosine, sine } => cosine == unknown || sine == unknown,
            JointValue::Plain(plain) => plain == unknown,
        })
    };
    (0..program.unknowns.len()).filter(|&unknown| demand.wants_unknown(unknown) && !is_joints(unknown)).collect()
}

fn unit_text(unit: Unit) -> &'static str {
    match unit {
        Unit::Metre => "m",
        Unit::Millimetre => "mm",
        Unit::Radian => "rad",
        Unit::One => "1",
    }
}
