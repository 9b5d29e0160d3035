//! Public structs are `#[non_exhaustive]` or have private fields, so that a field can be added without breaking callers. Exceptions have a reason.

use std::collections::HashMap;

use super::lexer::Token;
use super::{Source, root, sources};

/// The structs that callers build by literal, with the reason: module of the definition and name.
const OPEN: [(&str, &[&str]); 10] = [
    ("a measurement, which callers fill in", &["stabilizer::state::SoleForce", "stabilizer::state::State"]),
    (
        "a mathematical value, complete as it is",
        &[
            "derive::report::explain::document::Line",
            "dynamics::momentum::Momentum",
            "gait::footprint::Footprint",
            "groebner::cover::region::Region",
            "groebner::cover::space::Space",
            "groebner::hilbert::HilbertSeries",
            "groebner::reduced::Basis",
            "nav::grid::Window",
            "nav::path::Path",
            "poly::order::Block",
            "poly::ring::Term",
            "reach::grid::Axis",
            "spatial::exact::placement::Placement",
            "spatial::roll_pitch_yaw::RollPitchYaw",
            "spatial::twist::Twist",
            "spatial::wrench::Wrench",
            "walkers::skd::Real",
        ],
    ),
    (
        "part of a robot or a chain, which callers build by hand",
        &[
            "kinematics::dh::DhRow",
            "kinematics::dh::DhTable",
            "kinematics::parts::ChainParts",
            "kinematics::parts::Choice",
            "kinematics::parts::Joint",
            "kinematics::parts::Meant",
            "kinematics::parts::Tip",
            "kinematics::turns::Placed",
            "model::joint::Actuator",
            "model::joint::Joint",
            "model::joint::Mimic",
            "model::joint::Origin",
            "model::link::Link",
            "model::link::Mass",
            "model::link::Shape",
            "model::mesh::Surface",
            "model::parts::RobotParts",
        ],
    ),
    (
        "part of a motion, which callers build by hand",
        &[
            "motion::trajectory::Contact",
            "motion::trajectory::Figure",
            "motion::trajectory::JointTrack",
            "motion::trajectory::Track",
            "motion::trajectory::Trajectory",
        ],
    ),
    (
        "part of a solver's program, the format of `5_program.json`, which callers build by hand",
        &[
            "solver::about::About",
            "solver::forward::Forward",
            "solver::instruction::Instruction",
            "solver::joint::Joint",
            "solver::program::Block",
            "solver::program::Case",
            "solver::program::Checks",
            "solver::program::Described",
            "solver::program::Guard",
            "solver::program::Input",
            "solver::program::Pivot",
            "solver::program::Preference",
            "solver::program::Program",
            "solver::program::Short",
            "solver::program::redundancy::ClosedSearch",
            "solver::program::redundancy::Redundancy",
            "solver::program::redundancy::Section",
            "solver::rule::Following",
            "solver::rule::ParameterRule",
            "solver::tips::GivenJoint",
            "solver::tips::TipTask",
        ],
    ),
    (
        "part of a problem, which callers build by hand",
        &[
            "derive::coupled::model::Actuator",
            "derive::coupled::model::CoupledChain",
            "derive::coupled::model::CoupledParts",
            "derive::coupled::model::JointPlace",
            "derive::problem::input::InputFile",
            "derive::problem::system_parts::Equation",
            "derive::problem::system_parts::Input",
            "derive::problem::system_parts::JointUnknown",
            "derive::problem::system_parts::Parameter",
            "derive::problem::system_parts::SystemParts",
            "poly::system::Heading",
        ],
    ),
    (
        "a document or a scene, which callers build to write it",
        &[
            "derive::report::explain::document::Document",
            "folder::stored::Stored",
            "nav::room::Piece",
            "nav::room::Room",
            "sim::export::scene::Material",
            "sim::export::scene::Node",
            "sim::export::scene::Part",
            "sim::export::scene::Scene",
            "task::plan::Plan",
            "view::sole::Sole",
        ],
    ),
    (
        "options: callers name those that differ from `Default::default()` or from others, with `..`",
        &[
            "codegen::ikfast::Options",
            "control::closed_loop::Disturbance",
            "derive::problem::ends::Ends",
            "gait::footprint::Regular",
            "gait::one_step::OneStep",
            "gait::reference::Style",
            "gait::request::Request",
            "gait::schedule::Durations",
            "gait::defaults::GaitDefaults",
            "groebner::engine::Options",
            "groebner::f4::Settings",
            "groebner::parametric::Options",
            "nav::meaning::Meaning",
            "real::Options",
            "witness::Options",
        ],
    ),
    (
        "named arguments of a function: a literal needs each of them",
        &[
            "codegen::dynamics::Printed",
            "control::joint_space::Gains",
            "control::reference::Desired",
            "control::operational_space::Target",
            "dynamics::equations::State",
            "dynamics::equations::identify::Logged",
            "gait::one_step::Instant",
            "gait::step_commands::Measures",
            "gait::zmp::Configuration",
            "groebner::verify::Claim",
            "nav::exact::Guide",
            "nav::potential::Forces",
            "reach::request::Request",
            "sim::full_task::Change",
            "sim::run::Start",
            "task::course::Goal",
            "view::run::RunRequest",
        ],
    ),
    (
        "result of solvers in several crates, each of which builds it",
        &["kinematics::inverse::Solution", "kinematics::screw::plan::PlanStep"],
    ),
];

fn text(tokens: &[Token], at: usize) -> &str {
    tokens.get(at).map_or("", |token| token.text.as_str())
}

/// The index after the bracket that closes the one at `open`.
fn closed(tokens: &[Token], open: usize) -> usize {
    let (mut depth, mut at) = (0, open);
    while at < tokens.len() {
        match text(tokens, at) {
            "(" | "[" | "{" | "<" => depth += 1,
            ")" | "]" | "}" => depth -= 1,
            // Not the arrow of a function's result.
            ">" if text(tokens, at - 1) != "-" => depth -= 1,
            _ => {}
        }
        at += 1;
        if depth == 0 {
            break;
        }
    }
    at
}

/// Whether an attribute before the item at `start` is `#[non_exhaustive]`.
fn is_non_exhaustive(tokens: &[Token], start: usize) -> bool {
    let before = (0..start).rev().take_while(|&at| !matches!(text(tokens, at), ";" | "}" | "{"));
    before.into_iter().any(|at| text(tokens, at) == "non_exhaustive" && text(tokens, at - 1) == "[")
}

/// Whether the first field, element or item at `at` is public in all crates; attributes are skipped.
fn is_public(tokens: &[Token], mut at: usize) -> bool {
    while text(tokens, at) == "#" {
        at = closed(tokens, at + 1);
    }
    text(tokens, at) == "pub"
        && !(text(tokens, at + 1) == "(" && matches!(text(tokens, at + 2), "crate" | "super" | "in" | "self"))
}

/// The first tokens of the fields between the brackets that open at `open`.
fn fields(tokens: &[Token], open: usize) -> Vec<usize> {
    let (end, mut at, mut starts) = (closed(tokens, open) - 1, open + 1, vec![open + 1]);
    while at < end {
        if matches!(text(tokens, at), "(" | "[" | "{" | "<") {
            at = closed(tokens, at);
        } else {
            at += 1;
            if text(tokens, at - 1) == "," {
                starts.push(at);
            }
        }
    }
    starts.retain(|&start| start < end);
    starts
}

/// The names of the structs of a file that are `pub`, have only public fields and are not `#[non_exhaustive]`.
fn open_structs(tokens: &[Token]) -> Vec<String> {
    let is_start = |at: &usize| text(tokens, *at) == "pub" && text(tokens, at + 1) == "struct";
    let is_open = |at: &usize| {
        let mut body = at + 3;
        if text(tokens, body) == "<" {
            body = closed(tokens, body);
        }
        while !matches!(text(tokens, body), "{" | "(" | ";" | "") {
            body += 1;
        }
        let fields = if matches!(text(tokens, body), "{" | "(") { fields(tokens, body) } else { Vec::new() };
        !is_non_exhaustive(tokens, *at) && !fields.is_empty() && fields.iter().all(|&field| is_public(tokens, field))
    };
    (0..tokens.len()).filter(is_start).filter(is_open).map(|at| text(tokens, at + 2).to_owned()).collect()
}

/// The length of the common start of two paths.
fn common(a: &[&str], b: &[String]) -> usize {
    a.iter().zip(b).take_while(|(a, b)| *a == b).count()
}

/// The open structs that the list of public items has, as module of the definition and name. A name that several modules define is the definition
/// that shares most modules with its public path, or each of them if several do.
fn public_open_structs(list: &str, sources: &[Source]) -> Vec<String> {
    let mut defined: HashMap<&str, Vec<&Source>> = HashMap::new();
    for source in sources {
        for own in source.tokens.windows(3).filter(|own| own[0].text == "pub" && own[1].text == "struct") {
            defined.entry(&own[2].text).or_default().push(source);
        }
    }
    let mut found = Vec::new();
    for path in list.lines().filter_map(|line| line.strip_prefix("groebot::")?.strip_suffix(" struct")) {
        let path: Vec<&str> = path.split("::").collect();
        let (name, modules) = path.split_last().unwrap();
        let Some(candidates) = defined.get(name) else { continue };
        let most = candidates.iter().map(|source| common(modules, &source.module)).max().unwrap_or(0);
        let nearest = candidates.iter().filter(|source| common(modules, &source.module) == most);
        let open = nearest.filter(|source| open_structs(&source.tokens).iter().any(|open| open == name));
        found.extend(open.map(|source| format!("{}::{name}", source.module.join("::"))));
    }
    found.sort();
    found.dedup();
    found
}

#[test]
fn public_structs_are_non_exhaustive_or_have_a_reason() {
    let list = std::fs::read_to_string(root().join("tests/architecture/public_items.txt")).unwrap();
    let found = public_open_structs(&list, &sources());
    let mut allowed: Vec<&str> = OPEN.iter().flat_map(|(_, names)| *names).copied().collect();
    allowed.sort_unstable();
    let new: Vec<&String> = found.iter().filter(|name| allowed.binary_search(&name.as_str()).is_err()).collect();
    let former: Vec<&&str> = allowed.iter().filter(|name| !found.iter().any(|open| open == **name)).collect();
    assert!(new.is_empty(), "add `#[non_exhaustive]`, private fields, or a line with a reason in `OPEN`: {new:#?}");
    assert!(former.is_empty(), "these are not open any more; remove them from `OPEN`: {former:#?}");
}

#[test]
fn open_structs_are_found() {
    let text =
        "#[derive(Debug)] pub struct Open<'a, T: Fn(u8) -> u8> { #[serde(default)] pub a: Map<u8, u8>, pub b: &'a T, }
        #[derive(Debug)] #[non_exhaustive] pub struct Marked { pub a: u8 }
        pub struct Private { pub a: u8, b: u8 }
        pub struct Inner { pub(crate) a: u8 }
        pub struct Pair(pub u8, pub (u8, u8)); pub struct Unit; pub(crate) struct Own { pub a: u8 }";
    let tokens = super::lexer::tokens(text);
    assert_eq!(open_structs(&tokens), ["Open", "Pair"]);
}

#[test]
fn a_name_means_the_definition_with_the_nearest_module() {
    let source = |file: &str, text: &str| Source::new(file, text.to_owned());
    let open = "pub struct Joint { pub a: u8 }";
    let sources = [
        source("src/model/joint.rs", open),
        source("src/solver/joint.rs", "#[non_exhaustive] pub struct Joint { pub a: u8 }"),
        source("src/view/joint.rs", open),
    ];
    let list = "groebot::model::Joint struct\ngroebot::solver::Joint struct\ngroebot::model::Joint::a fn\n";
    assert_eq!(public_open_structs(list, &sources), ["model::joint::Joint"]);
}
