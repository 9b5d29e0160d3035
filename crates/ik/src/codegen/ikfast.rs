//! C++ with the interface of IKFast, for MoveIt's plugin template and OpenRAVE: `docs/ikfast.md`.
//!
//! The solver is that of [`super::c99`].

use serde::Serialize;

use super::c99::WORDS;
use super::language::{Expressions, number};
use super::names::is_word;
use super::outline::Outline;
use super::reserved::prefix;
use super::single_file;
use crate::solver::{Forward, GivenJoint, JointValue, Program, Reached, Unit};
use crate::tolerances::IKFAST;
use crate::{Error, ErrorKind, Result};
use groebot_robot::document::shown;
use groebot_robot::kinematics::{Plane, Task};

const SKELETON: &str = include_str!("skeleton/ikfast.cpp.txt");

/// The upper bound of a digit of a branch number. A solution's indices are bytes, and the greatest byte means none.
const MOST_DIGITS: usize = 250;

/// Options of the file.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// The namespace of its functions, a word; `None` uses the enclosing namespace.
    pub namespace: Option<String>,
    /// Whether the interface is in single precision; the solver computes in double precision.
    pub single: bool,
    /// The name of the file, by which it includes itself; by default the mechanism's name and `_ikfast.cpp`.
    pub file: Option<String>,
}

/// Prints the solver of a valid program ([`Program::validate`]) as one C++11 file that needs only `ikfast.h`.
///
/// # Errors
/// Same as [`emit_beside`].
pub fn emit(program: &Program, options: &Options) -> Result<String> {
    file(program, options, None)
}

/// Prints only the interface, for `ikfast.h` and the C solver whose files have the name `stem` ([`super::c99::Pair`]).
///
/// # Errors
/// [`ErrorKind::Unsupported`] in these cases: the program has no forward kinematics, more than one given joint, or a task without a type in IKFast; or the
/// interface is in single precision and the equations accept no rounded target. [`ErrorKind::BadValue`] for a namespace that is not a word.
pub fn emit_beside(program: &Program, options: &Options, stem: &str) -> Result<String> {
    file(program, options, Some(stem))
}

/// The text of the file: it includes the solver, or the header of a solver with this stem.
fn file(program: &Program, options: &Options, stem: Option<&str>) -> Result<String> {
    let refuse = |text: String| Error::new(ErrorKind::Unsupported, format!("`{}`: {text}", program.name));
    let forward = program.forward().filter(|_| program.cases().any(|case| !case.open)).ok_or_else(|| {
        refuse(
            "this solver has no forward kinematics, which IKFast's ComputeFk needs; derive it from a chain".to_owned(),
        )
    })?;
    let kind = Kind::of(program, &forward).map_err(refuse)?;
    let program = &*single_file::alone_of(program);
    let program = &if options.single { program.tolerant(IKFAST.single) } else { Some(program.clone()) }.ok_or_else(|| {
        let text = "the task has more numbers than the joints can reach, and no target that is rounded to single precision is consistent; omit --float, so that \
                    callers use double precision";
        refuse(text.to_owned())
    })?;
    if let Some(name) = options.namespace.as_ref().filter(|name| !is_word(name) || WORDS.is_reserved(name)) {
        return Err(Error::new(
            ErrorKind::BadValue,
            format!("namespace `{}`: give a word of letters, digits and `_` that is not reserved in C++", shown(name)),
        ));
    }
    let mut outline = super::c99::outline(program);
    stem.unwrap_or_default().clone_into(&mut outline.stem);
    let own = format!("{}_ikfast.cpp", prefix(&program.name));
    let own = options.file.as_deref().unwrap_or(&own);
    let is_kept = |line: &&str| !line.starts_with("#include <");
    let bare = |text: String| text.lines().filter(is_kept).map(|line| format!("{line}\n")).collect::<String>();
    let solver = stem.is_none().then(|| bare(single_file::c(program, own, false)));
    Ok(super::fill(SKELETON, &File::new(program, outline, (solver, own), &kind, options)))
}

/// A task type of IKFast.
struct Type {
    name: &'static str,
    code: &'static str,
    meaning: &'static str,
    /// The numbers of values in `eetrans` and in `eerot`.
    numbers: [usize; 2],
    usage: &'static str,
}

const TRANSFORM: Type = Type {
    name: "Transform6D",
    code: "0x67000001",
    meaning: "eetrans: the tip's position; eerot: its rotation matrix by rows.",
    numbers: [3, 9],
    usage: "x y z r00 r01 r02 r10 r11 r12 r20 r21 r22",
};
const ROTATION: Type = Type {
    name: "Rotation3D",
    code: "0x34000002",
    meaning: "eerot: the tip's rotation matrix by rows.",
    numbers: [0, 9],
    usage: "r00 r01 r02 r10 r11 r12 r20 r21 r22",
};
const TRANSLATION: Type = Type {
    name: "Translation3D",
    code: "0x33000003",
    meaning: "eetrans: the tip's position.",
    numbers: [3, 0],
    usage: "x y z",
};
const DIRECTION: Type = Type {
    name: "Direction3D",
    code: "0x23000004",
    meaning: "eerot: the direction that the tip aims, of any length.",
    numbers: [0, 3],
    usage: "dx dy dz",
};
const RAY: Type = Type {
    name: "TranslationDirection5D",
    code: "0x56000007",
    meaning: "eetrans: the tip's position; eerot: the direction that it aims, of any length.",
    numbers: [3, 3],
    usage: "x y z dx dy dz",
};
const PLANAR: Type = Type {
    name: "TranslationXY2D",
    code: "0x22000008",
    meaning: "eetrans: the tip's position, x and y.",
    numbers: [2, 0],
    usage: "x y",
};
const PLANAR_POSE: Type = Type {
    name: "TranslationXYOrientation3D",
    code: "0x33000009",
    meaning: "eetrans: the tip's position, x and y, and its turn about z.",
    numbers: [3, 0],
    usage: "x y angle",
};

/// The task types by coordinate of the rotation axis.
const ABOUT: [Type; 3] = [
    Type {
        name: "TranslationYAxisAngleXNorm4D",
        code: "0x4400000f",
        meaning: "eetrans: the tip's position; eerot[0]: the angle about x, counted from y, at which its direction points.",
        numbers: [3, 1],
        usage: "x y z angle",
    },
    Type {
        name: "TranslationZAxisAngleYNorm4D",
        code: "0x44000010",
        meaning: "eetrans: the tip's position; eerot[0]: the angle about y, counted from z, at which its direction points.",
        numbers: [3, 1],
        usage: "x y z angle",
    },
    Type {
        name: "TranslationXAxisAngleZNorm4D",
        code: "0x4400000e",
        meaning: "eetrans: the tip's position; eerot[0]: the angle about z, counted from x, at which its direction points.",
        numbers: [3, 1],
        usage: "x y z angle",
    },
];

/// The type of a program, and the joint whose value the user provides.
struct Kind {
    ikfast: &'static Type,
    /// The given joint, and the input that is its value.
    free: Option<(usize, usize)>,
}

impl Kind {
    fn of(program: &Program, forward: &Forward) -> std::result::Result<Self, String> {
        let is_given = |given: &&GivenJoint| forward.inputs[given.input] == Reached::Joint(given.joint);
        let free = program.given_joints.iter().filter(is_given).map(|given| (given.joint, given.input));
        let free: Vec<(usize, usize)> = free.collect();
        if free.len() > 1 {
            return Err(format!("{} joints are given; IKFast has at most one free joint", free.len()));
        }
        let own = program.inputs.len() - free.len();
        let first_given = free.first().map_or(own, |(_, input)| *input);
        if first_given != own {
            return Err("the value of the given joint is not the last number of the target".to_owned());
        }
        let ikfast = program.tip().and_then(|tip| ikfast_type(tip.task)).ok_or_else(|| {
            let names: Vec<&str> = program.inputs[..own].iter().map(|input| input.name.as_str()).collect();
            format!("IKFast has no type for a target of {}", names.join(", "))
        })?;
        Ok(Kind { ikfast, free: free.first().copied() })
    }
}

/// The type of a task.
fn ikfast_type(task: Task) -> Option<&'static Type> {
    match task {
        Task::Pose => Some(&TRANSFORM),
        Task::Rotation => Some(&ROTATION),
        Task::Ray => Some(&RAY),
        Task::Direction => Some(&DIRECTION),
        Task::Position => Some(&TRANSLATION),
        Task::PositionYaw { axis } => Some(&ABOUT[axis.coordinate()]),
        Task::PlanarPosition { plane: Plane::Xy } => Some(&PLANAR),
        Task::PlanarPose { plane: Plane::Xy } => Some(&PLANAR_POSE),
        Task::PlanarPosition { .. } | Task::PlanarPose { .. } | Task::PositionPitchRoll => None,
    }
}

/// The values that the skeleton uses in addition to the outline.
#[derive(Serialize)]
struct File<'a> {
    #[serde(flatten)]
    outline: Outline,
    solver: Option<String>,
    file: &'a str,
    engine_name: String,
    namespace: Option<&'a str>,
    single: bool,
    kind: KindText,
    free_joint: Option<usize>,
    /// Number of length units of the equations per metre.
    units: String,
    reading: Vec<String>,
    writing: Vec<String>,
    conform: &'static str,
    joint_kinds: Vec<&'static str>,
    bases: Vec<usize>,
    hash: String,
    usage: String,
    usage_count: usize,
}

#[derive(Serialize)]
struct KindText {
    name: &'static str,
    code: &'static str,
    meaning: &'static str,
    rotation: bool,
    direction: bool,
    uses_translation: bool,
    uses_rotation: bool,
    /// The number of values in `eetrans`.
    translation: usize,
}

impl<'a> File<'a> {
    fn new(
        program: &Program,
        outline: Outline,
        (solver, file): (Option<String>, &'a str),
        kind: &Kind,
        options: &'a Options,
    ) -> Self {
        let [translation, rotation] = kind.ikfast.numbers;
        let joint_kinds = program.joints.iter().map(|joint| match joint.value {
            JointValue::Angle { .. } => "0x01",
            JointValue::Plain(_) => "0x11",
        });
        let hash = program.about.as_ref().map_or("", |about| about.hash.as_str());
        let free = kind.free.map_or("", |_| " free");
        File {
            solver,
            file,
            engine_name: format!("{}_solver", prefix(&program.name)),
            namespace: options.namespace.as_deref(),
            single: options.single,
            kind: KindText {
                name: kind.ikfast.name,
                code: kind.ikfast.code,
                meaning: kind.ikfast.meaning,
                rotation: rotation == 9,
                direction: rotation == 3,
                uses_translation: translation > 0,
                uses_rotation: rotation > 0,
                translation,
            },
            free_joint: kind.free.map(|(joint, _)| joint),
            units: number(if in_millimetres(program) { 1000.0 } else { 1.0 }),
            reading: transfers(program, kind, |to, number, factor| {
                format!("target[{to}] = static_cast<double>({number}){factor};")
            }),
            writing: transfers(program, &Kind { free: None, ..*kind }, |from, number, factor| {
                let divisor = factor.replace('*', "/");
                format!("{number} = static_cast<IkReal>(target[{from}]{divisor});")
            }),
            conform: match (rotation, translation) {
                (9, 0) => "onto_rotation(target)",
                (9, _) => "onto_rotation(target + 3)",
                (3, 0) => "onto_sphere(target)",
                (3, _) => "onto_sphere(target + 3)",
                _ => "true",
            },
            joint_kinds: joint_kinds.collect(),
            bases: bases(program, kind.free.map(|(joint, _)| joint)),
            hash: WORDS.quote(hash),
            usage: format!("{}{free}", kind.ikfast.usage),
            usage_count: translation + rotation + kind.free.iter().count(),
            outline,
        }
    }
}

fn in_millimetres(program: &Program) -> bool {
    let inputs = program.inputs.iter().map(|input| input.unit);
    inputs.chain(program.joints.iter().map(|joint| joint.unit)).any(|unit| unit == Unit::Millimetre)
}

/// A line for each target number, from its index, IKFast's name for it, and its unit factor if it is a length.
fn transfers(program: &Program, kind: &Kind, line: impl Fn(usize, String, &str) -> String) -> Vec<String> {
    let [translation, rotation] = kind.ikfast.numbers;
    let own = (0..translation + rotation).map(|index| match index.checked_sub(translation) {
        None => (index, format!("eetrans[{index}]")),
        Some(place) => (index, format!("eerot[{place}]")),
    });
    let free = kind.free.map(|(_, input)| (input, "pfree[0]".to_owned()));
    let is_length = |index: usize| matches!(program.inputs[index].unit, Unit::Metre | Unit::Millimetre);
    own.chain(free).map(|(index, name)| line(index, name, if is_length(index) { " * UNITS" } else { "" })).collect()
}

/// By joint, the base of its digit of the branch number, the first joint's being the lowest. 0 for the given joint.
fn bases(program: &Program, free: Option<usize>) -> Vec<usize> {
    let mut left = program.blocks.iter().map(|block| block.branches()).fold(1, usize::saturating_mul);
    let mut base = |joint: usize| {
        if free == Some(joint) {
            return 0;
        }
        let base = left.clamp(1, MOST_DIGITS);
        left = left.div_ceil(base);
        base
    };
    (0..program.joints.len()).map(&mut base).collect()
}
