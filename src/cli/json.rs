//! JSON output: its version, the output of `derive`, `info` and `plan`, and reports of written files. docs/cli_schema.json describes the output of all
//! commands.

use std::path::Path;
use std::time::Duration;

use num_traits::ToPrimitive;
use serde_json::{Value, json};

use super::ends::TipLink;
use super::following::leaders;
use groebot_ik::derive::coupled::CoupledChains;
use groebot_ik::derive::planner::{Candidate, Choice};
use groebot_ik::derive::{Derivation, Method, Source, System};
use groebot_ik::witness;
use groebot_robot::kinematics::ideal::{RelationKind, Report};
use groebot_robot::kinematics::screw::Plan;
use groebot_robot::kinematics::{Chain, ExactVector, Geometry, JointKind};

/// The version of docs/cli_schema.json: the key `format` of all commands.
pub const FORMAT: u32 = 2;

/// The result of a derivation.
pub struct Derived<'a> {
    pub source: &'a Source,
    pub derivation: &'a Derivation,
    pub checked: &'a witness::Report,
    pub choice: Option<&'a Choice>,
    pub folder: &'a Path,
    pub files: &'a [&'a str],
    pub laps: &'a [(&'static str, Duration)],
}

impl Derived<'_> {
    /// Name, task, inputs, joints, solutions, ideal robot, notes, checks with their weak spots, files, seconds.
    pub fn json(&self) -> Value {
        let program = self.derivation.program();
        json!({
            "format": FORMAT,
            "name": program.name,
            "task": program.about.as_ref().map(|_| program.task_text()),
            "inputs": program.inputs.iter().map(|input| input.name.as_str()).collect::<Vec<_>>(),
            "joints": program.joints.iter().map(|joint| joint.name.as_str()).collect::<Vec<_>>(),
            "mimics": leaders(program.follows().into_iter()),
            "solutions": self.derivation.dimension(),
            "method": method(self.derivation),
            "ideal": self.source.ideal.as_ref().map(|(_, report)| ideal(report)),
            "given": self.choice.map(given),
            "notes": self.source.notes,
            "tip_link": TipLink::of_source(self.source),
            "checked": checked(self.checked),
            "folder": self.folder.display().to_string(),
            "files": self.files,
            "seconds": self.laps.iter().map(|(_, lap)| lap.as_secs_f64()).sum::<f64>(),
        })
    }
}

/// The joints that the planner gives, and other possible choices.
pub fn given(choice: &Choice) -> Value {
    let candidate = |candidate: &Candidate| {
        let solutions = candidate.plan.map(|[_, count]| count);
        json!({ "joint": candidate.joint, "fraction": candidate.share, "solutions": solutions })
    };
    json!({ "joints": choice.given, "candidates": choice.candidates.iter().map(candidate).collect::<Vec<_>>() })
}

fn method(derivation: &Derivation) -> &'static str {
    match derivation.method() {
        Method::Equations(_) => "one block",
        Method::Sequential(_) => "one joint at a time",
        Method::Eigenvalue(_) => "eigenvalue problem",
        Method::Coupled(_) => "one chain at a time",
    }
}

/// The idealised relations: angles in radians, lengths in the chain's unit.
pub fn ideal(report: &Report) -> Value {
    let relations = report.relations.iter().map(|relation| {
        let kind = match relation.kind {
            RelationKind::Parallel => "parallel",
            RelationKind::Perpendicular => "perpendicular",
            RelationKind::Meeting => "intersecting",
            RelationKind::Coincident => "coincident",
            RelationKind::Level => "zero_offset",
        };
        json!({ "first": relation.joints.start + 1, "last": relation.joints.end, "kind": kind, "deviation": relation.by })
    });
    let moved = report.moved.iter();
    let moved = moved.map(|moved| json!({ "joint": moved.joint, "angle": moved.angle, "distance": moved.distance }));
    json!({
        "tolerance": report.tolerance,
        "deviation": report.deviation(),
        "polishes": !report.is_same(),
        "relations": relations.collect::<Vec<_>>(),
        "corrections": moved.collect::<Vec<_>>(),
    })
}

fn checked(report: &witness::Report) -> Value {
    let summary = report.summary();
    let weak = report.weak_spots().map(|row| {
        let faults: Vec<String> = row.verdict.faults().iter().map(ToString::to_string).collect();
        json!({ "row": row.number, "kind": row.kind.to_string(), "target": row.target, "faults": faults })
    });
    json!({
        "targets": summary.rows,
        "passed": summary.rows - summary.failed,
        "counted_exactly": summary.exact,
        "worst_residual": summary.worst_residual,
        "weak_spots": weak.collect::<Vec<_>>(),
    })
}

/// A chain with its axes, their relations, and the idealisation; lengths in its unit, angles in radians.
pub fn chain(described: &Chain, (meant, report): (&Chain, &Report), notes: &[String], tip: Option<&TipLink>) -> Value {
    let joints = described.joints().iter().map(|joint| {
        let axis = joint.direction().into_inner();
        json!({
            "name": joint.name,
            "kind": if joint.kind == JointKind::Revolute { "revolute" } else { "prismatic" },
            "axis": [axis.x, axis.y, axis.z],
            "point": doubles(&joint.point),
            "limits": joint.limits,
        })
    });
    let geometry = Geometry::of(meant);
    let row = |joints: &std::ops::Range<usize>| [joints.start + 1, joints.end];
    let meeting = geometry.meeting.iter();
    let meeting = meeting
        .map(|group| json!({ "joints": row(&group.joints), "point": [group.point.x, group.point.y, group.point.z] }));
    json!({
        "format": FORMAT,
        "name": described.name(),
        "task": described.task_text(),
        "length_unit": described.length_unit().symbol(),
        "joints": joints.collect::<Vec<_>>(),
        "tip": doubles(&described.tip().point),
        "tip_link": tip,
        "reach": described.reach(),
        "parallel": geometry.parallel.iter().map(row).collect::<Vec<_>>(),
        "intersecting": meeting.collect::<Vec<_>>(),
        "ideal": ideal(report),
        "notes": notes,
    })
}

/// Coupled chains: each chain as by [`chain`], and the joints that each actuator moves, as `chain.joint`.
pub fn coupled(coupled: &CoupledChains) -> Value {
    let actuators = coupled.actuators().iter();
    let actuators = actuators.map(|own| json!({ "name": own.name, "joints": coupled.moved(own) }));
    let chains = coupled.chains().iter().map(|member| {
        let (ideal, report) = member.chain.ideal();
        json!({ "name": member.name, "prefix": member.prefix, "chain": chain(&member.chain, (&ideal, &report), &[], None) })
    });
    json!({
        "format": FORMAT,
        "name": coupled.parts().name,
        "actuators": actuators.collect::<Vec<_>>(),
        "chains": chains.collect::<Vec<_>>(),
    })
}

/// A system of equations, each of which is zero.
pub fn system(system: &System) -> Value {
    json!({
        "format": FORMAT,
        "name": system.name,
        "parameters": system.parameters.iter().map(|parameter| parameter.name.as_str()).collect::<Vec<_>>(),
        "order": system.order,
        "joints": system.joints.iter().map(|joint| joint.name.as_str()).collect::<Vec<_>>(),
        "equations": system.equations.iter().map(|equation| equation.expression.to_string()).collect::<Vec<_>>(),
    })
}

/// The order of subproblems of a chain, and the ignored parts of its robot.
pub fn plan(chain: &Chain, plan: &Plan, notes: &[String], tip: Option<&TipLink>) -> Value {
    let steps = plan.steps.iter().map(|step| {
        let joints: Vec<&str> = step.joints.iter().map(|&joint| chain.joints()[joint].name.as_str()).collect();
        json!({ "subproblem": step.subproblem.name(), "joints": joints, "answers": step.answers, "text": step.text })
    });
    json!({
        "format": FORMAT,
        "name": chain.name(),
        "task": chain.task_text(),
        "tip_link": tip,
        "steps": steps.collect::<Vec<_>>(),
        "solutions": plan.most_solutions(),
        "notes": notes,
    })
}

/// The report of a command whose product is in files: their paths, as given or in the given folder.
pub fn written(files: &[&Path]) -> Value {
    json!({ "format": FORMAT, "files": files.iter().map(|file| file.display().to_string()).collect::<Vec<_>>() })
}

/// `value` as a text of several lines.
pub fn text(value: &Value) -> String {
    format!("{value:#}\n")
}

fn doubles(vector: &ExactVector) -> [f64; 3] {
    vector.each_ref().map(|entry| entry.to_f64().unwrap_or(f64::NAN))
}
