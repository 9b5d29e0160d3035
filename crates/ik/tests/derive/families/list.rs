//! The families: relations between axes, and tasks.

use groebot_robot::kinematics::{Chain, Plane, Task};

use super::draw::{Draw, Placed, along_the_last_axis, moves_freely};

/// Random chains of one family.
pub struct Family {
    pub name: &'static str,
    make: fn(&mut Draw) -> Chain,
}

impl Family {
    /// Chain `number` of the sequence of `seed`, without the redundant chains.
    pub fn chain(&self, number: usize, seed: u64) -> Chain {
        let mut draw = Draw::new(1000 * number as u64 + seed);
        std::iter::repeat_with(|| (self.make)(&mut draw)).find(moves_freely).expect("most chains move freely")
    }
}

const PLANAR_POSE: Task = Task::PlanarPose { plane: Plane::Xy };
const PLANAR_POSITION: Task = Task::PlanarPosition { plane: Plane::Xy };

const fn family(name: &'static str, make: fn(&mut Draw) -> Chain) -> Family {
    Family { name, make }
}

fn joined(parts: &[&[Placed]]) -> Vec<Placed> {
    parts.concat()
}

/// Joints with arbitrary axes, three joints that meet or are parallel, then joints with arbitrary axes.
fn around(draw: &mut Draw, before: &str, three: fn(&mut Draw, usize) -> Vec<Placed>, behind: &str) -> Chain {
    let joints = joined(&[&draw.anywhere(before), &three(draw, 3), &draw.anywhere(behind)]);
    draw.chain(&joints, Task::Pose, &[])
}

fn simple(draw: &mut Draw, kinds: &str, task: Task) -> Chain {
    let joints = draw.anywhere(kinds);
    draw.chain(&joints, task, &[])
}

fn planar(draw: &mut Draw, kinds: &str, task: Task) -> Chain {
    let joints = draw.planar(kinds);
    draw.chain(&joints, task, &[])
}

/// A humanoid's arm: two axes that meet in the shoulder, two in the elbow, and the forearm's axis through the elbow.
fn arm(draw: &mut Draw) -> Vec<Placed> {
    let (shoulder, elbow) = (draw.meeting(2), draw.meeting(3));
    joined(&[&shoulder, &elbow])
}

pub const FAMILIES: &[Family] = &[
    family("three joints, spherical wrist", |draw| around(draw, "RRR", Draw::meeting, "")),
    family("spherical hip, three joints", |draw| around(draw, "", Draw::meeting, "RRR")),
    family("second to fourth axis meet", |draw| around(draw, "R", Draw::meeting, "RR")),
    family("third to fifth axis meet", |draw| around(draw, "RR", Draw::meeting, "R")),
    family("first to third axis parallel", |draw| around(draw, "", Draw::parallel, "RRR")),
    family("second to fourth axis parallel", |draw| around(draw, "R", Draw::parallel, "RR")),
    family("third to fifth axis parallel", |draw| around(draw, "RR", Draw::parallel, "R")),
    family("fourth to sixth axis parallel", |draw| around(draw, "RRR", Draw::parallel, "")),
    family("RRP, spherical wrist", |draw| around(draw, "RRP", Draw::meeting, "")),
    family("RPR, spherical wrist", |draw| around(draw, "RPR", Draw::meeting, "")),
    family("PRR, spherical wrist", |draw| around(draw, "PRR", Draw::meeting, "")),
    family("PPP, spherical wrist", |draw| around(draw, "PPP", Draw::meeting, "")),
    family("PPR, spherical wrist", |draw| around(draw, "PPR", Draw::meeting, "")),
    family("RRR to a position", |draw| simple(draw, "RRR", Task::Position)),
    family("RRP to a position", |draw| simple(draw, "RRP", Task::Position)),
    family("PRR to a position", |draw| simple(draw, "PRR", Task::Position)),
    family("PPP to a position", |draw| simple(draw, "PPP", Task::Position)),
    family("RRR to a rotation", |draw| simple(draw, "RRR", Task::Rotation)),
    family("RR to a direction", |draw| simple(draw, "RR", Task::Direction)),
    family("arm to a ray along its last axis", |draw| {
        let joints = arm(draw);
        along_the_last_axis(&draw.chain(&joints, Task::Pose, &[]))
    }),
    family("arm to a ray anywhere", |draw| {
        let joints = arm(draw);
        draw.chain(&joints, Task::Ray, &[])
    }),
    family("RR, spherical wrist to a ray", |draw| {
        let joints = joined(&[&draw.anywhere("RR"), &draw.meeting(3)]);
        draw.chain(&joints, Task::Ray, &[])
    }),
    family("spherical shoulder, RR to a ray", |draw| {
        let joints = joined(&[&draw.meeting(3), &draw.anywhere("RR")]);
        draw.chain(&joints, Task::Ray, &[])
    }),
    family("R, three parallel axes, R to a ray", |draw| {
        let joints = joined(&[&draw.anywhere("R"), &draw.parallel(3), &draw.anywhere("R")]);
        draw.chain(&joints, Task::Ray, &[])
    }),
    family("leg: spherical hip, parallel pair, joint", |draw| {
        let joints = joined(&[&draw.meeting(3), &draw.parallel(2), &draw.anywhere("R")]);
        draw.chain(&joints, Task::Pose, &[])
    }),
    family("meeting pair, joint, spherical wrist", |draw| {
        let joints = joined(&[&draw.meeting(2), &draw.anywhere("R"), &draw.meeting(3)]);
        draw.chain(&joints, Task::Pose, &[])
    }),
    family("joint, parallel pair, spherical wrist", |draw| {
        let joints = joined(&[&draw.anywhere("R"), &draw.parallel(2), &draw.meeting(3)]);
        draw.chain(&joints, Task::Pose, &[])
    }),
    family("parallel pair, slide, spherical wrist", |draw| {
        let joints = joined(&[&draw.parallel(2), &draw.anywhere("P"), &draw.meeting(3)]);
        draw.chain(&joints, Task::Pose, &[])
    }),
    family("four joints to a position, one given", |draw| {
        let joints = draw.anywhere("RRRR");
        draw.chain(&joints, Task::Position, &[2])
    }),
    family("seven joints, the elbow given", |draw| {
        let joints = joined(&[&draw.meeting(3), &draw.anywhere("R"), &draw.meeting(3)]);
        draw.chain(&joints, Task::Pose, &[2])
    }),
    family("five joints to a pose", |draw| around(draw, "RR", Draw::meeting, "")),
    family("three joints to a pose", |draw| simple(draw, "RRR", Task::Pose)),
    family("planar RR to a position", |draw| planar(draw, "RR", PLANAR_POSITION)),
    family("planar RRR to a pose", |draw| planar(draw, "RRR", PLANAR_POSE)),
    family("planar PRR to a pose", |draw| planar(draw, "PRR", PLANAR_POSE)),
    family("planar RPR to a pose", |draw| planar(draw, "RPR", PLANAR_POSE)),
    family("SCARA", |draw| {
        let turning = draw.parallel(3);
        let mut slide = turning[0].clone();
        slide.slides();
        draw.chain(&joined(&[&turning, &[slide]]), Task::Pose, &[])
    }),
];
