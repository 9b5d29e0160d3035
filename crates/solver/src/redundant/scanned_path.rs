//! A path of an arm with scanned joints: [`ScanningSolver::path`].
//!
//! The scanned joints come first. They move through a grid of their values, one step of one joint at a time, as fast as their maximum velocities permit. The
//! path through the grid has the fewest targets without a solution and, of those, the least sum of costs (dynamic programming). A node costs more the less
//! manipulable the other joints are. With the scanned joints held at the values of this path, the others move along arcs.

use rayon::prelude::*;

use super::path::{ArmJump, ArmPath, PathOptions};
use super::scan_samples::ScanLimits;
use super::{ArmTarget, Criterion, ScanningSolver};
use crate::Unit;
use crate::{Error, ErrorKind, Result, Watch};

/// The number of values of a scanned joint in the grid, by the number of scanned joints.
const VALUES: [usize; 3] = [17, 7, 5];
/// The maximum step of a scanned joint without a maximum velocity: an angle in rad, a length relative to the scale of the program.
const STEP: f64 = 0.1;
/// The costs of a target without a solution, of a start elsewhere, of a step, and at most of a solution.
const MISS: usize = 1_000_000;
const ELSEWHERE: usize = 10_000;
const MOVE: usize = 50;
const MOST: f64 = 100.0;

/// A grid of values of the scanned joints, and the costs of its nodes.
struct Grid {
    /// By scanned joint, its values in ascending order.
    axes: Vec<Vec<f64>>,
    /// By target and scanned joint, the maximum step from the target before.
    steps: Vec<Vec<f64>>,
    /// By target and node, the cost.
    costs: Vec<Vec<usize>>,
}

/// The cheapest path to a node at a target: its cost, and the target and the node before.
#[derive(Clone, Copy)]
struct CheapestPath {
    cost: usize,
    from: (usize, usize),
}

impl ScanningSolver {
    /// Joint values of the chain along `targets` within limits. As [`super::RedundantSolver::path`], with the scanned joints at rest or in motion between two
    /// values of a grid. `limits` is that of [`ScanningSolver::any_within`]; those of `options` are not used. Other values of `options` have one entry for each joint of
    /// the chain.
    ///
    /// # Errors
    /// As [`super::RedundantSolver::path`] and [`ScanningSolver::any_within`].
    pub fn path<'w>(
        &self,
        targets: &[ArmTarget],
        limits: Option<&[[f64; 2]]>,
        options: &PathOptions<'_>,
        watch: impl Into<Option<&'w Watch>>,
    ) -> Result<ArmPath> {
        let watch = Watch::or_none(watch);
        let limits = self.scan_limits(limits)?;
        let count = self.joints().len();
        if let Some(start) = options.start.filter(|start| start.len() != count || !start.iter().all(|q| q.is_finite()))
        {
            let text = format!("{} joint values given; give {count} finite ones", start.len());
            return Err(Error::new(ErrorKind::BadValue, text));
        }
        let own = |all: &[f64]| -> Vec<f64> { self.zero.own.iter().map(|&joint| all[joint]).collect() };
        let start = options.start.map(own);
        let speeds: Vec<Option<f64>> =
            self.zero.own.iter().map(|&joint| options.speeds.get(joint).copied().flatten()).collect();
        let inner = PathOptions { limits: Some(limits.own), start: start.as_deref(), speeds: &speeds, ..*options };
        self.zero.check_path(targets.len(), &inner)?;
        let grid = Grid::new(self, targets, &limits, options, watch)?;
        let from = options.start.map(|start| self.scanned.iter().map(|&joint| start[joint]).collect::<Vec<_>>());
        let held = grid.path(from.as_deref());
        let solver_at = |sample: usize| self.at(&held[sample]);
        let found = self.zero.path_by(targets, &inner, Some(&solver_at), watch)?;
        let q = found.q.iter().zip(&held).map(|(q, values)| self.at(values).all_joints(q)).collect();
        let own_jump = |jump: ArmJump| ArmJump { joint: self.zero.own[jump.joint], ..jump };
        let mut jumps = self.first_jump(&grid, from.as_deref(), &held[0]);
        jumps.extend(found.jumps.into_iter().map(own_jump));
        Ok(ArmPath { q, jumps, ..found })
    }

    /// The jump of a scanned joint to the first target, if it is one.
    fn first_jump(&self, grid: &Grid, from: Option<&[f64]>, to: &[f64]) -> Vec<ArmJump> {
        let steps = from.into_iter().flatten().zip(to).enumerate();
        let jump = steps.map(|(k, (from, to))| (k, to - from)).find(|(k, step)| step.abs() > grid.steps[0][*k]);
        let why = "the path does not begin at the current joint values".to_owned();
        jump.map(|(k, step)| ArmJump { sample: 0, joint: self.scanned[k], step, why }).into_iter().collect()
    }

    /// The maximum step of a scanned joint to a target.
    fn most(&self, options: &PathOptions<'_>, sample: usize, joint: usize) -> f64 {
        let time = options.times.filter(|_| sample > 0).map(|times| times[sample] - times[sample - 1]);
        match options.speeds.get(joint).copied().flatten().zip(time) {
            Some((speed, time)) => speed * time,
            None if self.joints()[joint].unit == Unit::Radian => STEP,
            None => STEP * self.zero.arm.length,
        }
    }
}

impl Grid {
    fn new(
        solver: &ScanningSolver,
        targets: &[ArmTarget],
        limits: &ScanLimits,
        options: &PathOptions<'_>,
        watch: &Watch,
    ) -> Result<Grid> {
        let count = VALUES[limits.ranges.len() - 1];
        let axis = |(&joint, [low, high]): (&usize, &[f64; 2])| {
            let mut axis: Vec<f64> = (0..count).map(|k| low + (high - low) * k as f64 / (count - 1) as f64).collect();
            axis.extend(options.start.map(|start| start[joint].clamp(*low, *high)));
            axis.sort_by(f64::total_cmp);
            axis.dedup();
            axis
        };
        let axes: Vec<Vec<f64>> = solver.scanned.iter().zip(&limits.ranges).map(axis).collect();
        let step = |sample: usize| solver.scanned.iter().map(|&joint| solver.most(options, sample, joint)).collect();
        let mut grid = Grid { axes, steps: (0..targets.len()).map(step).collect(), costs: Vec::new() };
        let at_target = |(sample, target): (usize, &ArmTarget)| {
            watch.check()?;
            watch.report("values of the scanned joints along the path", sample, targets.len() - sample);
            let best = |node| solver.at(&grid.values(node)).best(target, &limits.own, &Criterion::Manipulability);
            let best = (0..grid.nodes()).map(best).collect::<Result<Vec<_>>>()?;
            Ok(costs(&best.into_iter().map(|best| best.map(|best| best.value)).collect::<Vec<_>>()))
        };
        grid.costs = targets.par_iter().enumerate().map(at_target).collect::<Result<_>>()?;
        Ok(grid)
    }

    fn nodes(&self) -> usize {
        self.axes.iter().map(Vec::len).product()
    }

    /// The index of a node on each axis. The first axis changes fastest.
    fn places(&self, mut node: usize) -> Vec<usize> {
        let mut place = |axis: &Vec<f64>| {
            let place = node % axis.len();
            node /= axis.len();
            place
        };
        self.axes.iter().map(&mut place).collect()
    }

    fn values(&self, node: usize) -> Vec<f64> {
        self.axes.iter().zip(self.places(node)).map(|(axis, place)| axis[place]).collect()
    }

    /// The neighbours of a node, each with the number of its axis.
    fn neighbours(&self, node: usize) -> Vec<(usize, usize)> {
        let (mut list, mut stride) = (Vec::new(), 1);
        for (k, (axis, place)) in self.axes.iter().zip(self.places(node)).enumerate() {
            list.extend((place > 0).then(|| (k, node - stride)));
            list.extend((place + 1 < axis.len()).then(|| (k, node + stride)));
            stride *= axis.len();
        }
        list
    }

    /// The shares of a step of an axis at the targets after `sample`, the last of which is 1. `None` if the targets end before.
    fn shares(&self, sample: usize, axis: usize, distance: f64) -> Option<Vec<f64>> {
        let (mut shares, mut gone) = (Vec::new(), 0.0);
        for steps in &self.steps[sample + 1..] {
            gone += steps[axis];
            if gone >= distance {
                shares.push(1.0);
                return Some(shares);
            }
            shares.push(gone / distance);
        }
        None
    }

    /// The step between two nodes of an axis from a target on: the shares of the distance at the targets after it.
    fn step(&self, sample: usize, axis: usize, [from, to]: [usize; 2]) -> Option<Vec<f64>> {
        let distance = (self.values(to)[axis] - self.values(from)[axis]).abs();
        self.shares(sample, axis, distance)
    }

    /// By target, the values of the scanned joints. `from` are those before the first target.
    fn path(&self, from: Option<&[f64]>) -> Vec<Vec<f64>> {
        let (targets, nodes) = (self.steps.len(), self.nodes());
        let never = CheapestPath { cost: usize::MAX, from: (0, 0) };
        let mut paths = vec![vec![never; nodes]; targets];
        paths[0] = (0..nodes).map(|node| self.start(from, node)).collect();
        for sample in 0..targets - 1 {
            for node in 0..nodes {
                let CheapestPath { cost, .. } = paths[sample][node];
                if cost == usize::MAX {
                    continue;
                }
                let mut relax = |(to_sample, to): (usize, usize), cost: usize| {
                    if cost < paths[to_sample][to].cost {
                        paths[to_sample][to] = CheapestPath { cost, from: (sample, node) };
                    }
                };
                relax((sample + 1, node), cost + self.costs[sample + 1][node]);
                for (axis, to) in self.neighbours(node) {
                    let Some(shares) = self.step(sample, axis, [node, to]) else { continue };
                    let passed = shares.iter().enumerate().map(|(k, share)| {
                        let nearer = if *share < 0.5 { node } else { to };
                        self.costs[sample + 1 + k][nearer]
                    });
                    relax((sample + shares.len(), to), cost + MOVE + passed.sum::<usize>());
                }
            }
        }
        self.traced(&paths)
    }

    /// The path to a node at the first target.
    fn start(&self, from: Option<&[f64]>, node: usize) -> CheapestPath {
        let is_start = from.is_none_or(|from| self.values(node).iter().zip(from).all(|(a, b)| a == b));
        let start = if is_start { 0 } else { ELSEWHERE };
        CheapestPath { cost: start + self.costs[0][node], from: (0, node) }
    }

    /// The values along the cheapest path, from its end.
    fn traced(&self, paths: &[Vec<CheapestPath>]) -> Vec<Vec<f64>> {
        let mut sample = paths.len() - 1;
        let mut node = (0..self.nodes()).min_by_key(|&node| paths[sample][node].cost).unwrap_or(0);
        let mut path = vec![self.values(node); paths.len()];
        while sample > 0 {
            let (before, origin) = paths[sample][node].from;
            let [first, last] = [origin, node].map(|node| self.values(node));
            path[before].clone_from(&first);
            for (axis, (a, b)) in first.iter().zip(&last).enumerate().filter(|(_, (a, b))| a != b) {
                for (k, share) in self.shares(before, axis, (b - a).abs()).into_iter().flatten().enumerate() {
                    path[before + 1 + k].clone_from(&first);
                    path[before + 1 + k][axis] = a + share * (b - a);
                }
            }
            if origin == node {
                path[sample].clone_from(&last);
            }
            (sample, node) = (before, origin);
        }
        path
    }
}

/// The costs of nodes by the greatest manipulability of their solutions, which is `None` without one.
fn costs(manipulability: &[Option<f64>]) -> Vec<usize> {
    let most = manipulability.iter().flatten().copied().fold(0.0, f64::max);
    let cost = |value: &Option<f64>| value.map_or(MISS, |value| (MOST * (1.0 - value / most.max(value))) as usize);
    manipulability.iter().map(cost).collect()
}
