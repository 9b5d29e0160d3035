//! The first joint of an arm with a vertical first axis, from the last joint of the loop that replaces it. The loop's joint is relative to the target's
//! azimuth.

use num_traits::ToPrimitive;

use super::layout::Layout;
use crate::derive::closure::UprightLoop;
use crate::derive::equations::assemble::Assembler;
use crate::solver::{Block, Case, Guard, JointValue, Operand, Step};

/// Makes `layout` that of the arm itself, and adds the block of its first joint to those of the loop. `reach` is the size of its positions.
pub(super) fn close(upright_loop: &UprightLoop, layout: &mut Layout, blocks: &mut Vec<Block>, reach: f64) {
    let count = upright_loop.plain.joints().len();
    let Some(first) = layout.swing else { return };
    for case in blocks.iter_mut().flat_map(|block| &mut block.cases) {
        case.free = case.free.iter().filter_map(|&joint| upright_loop.upright.place(joint)).collect();
    }
    for given in &mut layout.given_joints {
        given.joint = upright_loop.upright.place(given.joint).unwrap_or(0);
    }
    let radius = upright_loop
        .upright
        .chain
        .given()
        .get(count_of_own(upright_loop) + 2)
        .map_or(0, |&joint| layout.given[joint][0]);
    if let Some(JointValue::Angle { cosine, sine }) = layout.joints.last().copied() {
        blocks.push(block(upright_loop, [cosine, sine], first, radius, reach));
    }
    let place = |place: usize| {
        if place == 0 { JointValue::Angle { cosine: first[0], sine: first[1] } } else { layout.joints[place - 1] }
    };
    let given = |place: usize| place.checked_sub(1).map_or_else(Vec::new, |place| layout.given[place].clone());
    let (joints, given) = ((0..count).map(place).collect(), (0..count).map(given).collect());
    (layout.joints, layout.given) = (joints, given);
}

/// The number of the loop's given joints that are given joints of the arm.
fn count_of_own(upright_loop: &UprightLoop) -> usize {
    upright_loop.plain.given().len()
}

/// The block of the first joint: `q1 = q + azimuth`. The azimuth of a target on the first axis is zero.
fn block(upright_loop: &UprightLoop, [c, s]: [usize; 2], first: [usize; 2], radius: usize, reach: f64) -> Block {
    let mut assembler = Assembler::default();
    let axis = upright_loop.upright.axis.each_ref().map(|x| Operand::Constant(x.to_f64().unwrap_or(0.0)));
    let [x, y] = [0, 1].map(|k| assembler.sub(Operand::Parameter(k), axis[k]));
    let radius = Operand::Parameter(radius);
    let [across, up] = [x, y].map(|coordinate| assembler.div(coordinate, radius));
    let [c, s] = [c, s].map(Operand::Unknown);
    let [cc, ss, sc, cs] = [(c, across), (s, up), (s, across), (c, up)].map(|(a, b)| assembler.mul(a, b));
    let (cosine, sine) = (assembler.sub(cc, ss), assembler.add(sc, cs));
    let turned = |assembler: &mut Assembler, sine: Operand| {
        if upright_loop.upright.is_down { assembler.mul(Operand::Constant(-1.0), sine) } else { sine }
    };
    let sine = turned(&mut assembler, sine);
    let code = assembler.take();
    let mut assembler = Assembler::default();
    let straight = turned(&mut assembler, s);
    let still = assembler.take();
    let guard = |near: bool| Guard { text: "radius".to_owned(), value: radius, scale: Operand::Constant(reach), near };
    let case = |label: &str, near: bool, code: Vec<_>, values: [Operand; 2]| {
        let set = first.into_iter().zip(values).map(|(unknown, value)| Step::Set { unknown, value });
        let compute = (!code.is_empty()).then_some(Step::Compute(code));
        Case {
            label: label.to_owned(),
            guards: vec![guard(near)],
            steps: compute.into_iter().chain(set).collect(),
            ..Case::default()
        }
    };
    let cases = vec![case("generic", false, code, [cosine, sine]), case("radius = 0", true, still, [c, straight])];
    Block::numbered(&upright_loop.plain.joints()[0].name, Vec::new(), cases)
}
