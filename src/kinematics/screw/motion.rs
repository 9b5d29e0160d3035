//! The position equation of `N` screws, `exp(S1 q1) .. exp(SN qN) p = k`, in coordinates of size one: [`Motion`].

use std::f64::consts::{PI, TAU};

use nalgebra::{Point3, SMatrix, SVector, Vector3};
use smallvec::SmallVec;

use super::descent::{Miss, descend};
use super::values::{Answers, Reach, TOLERANCE};
use crate::spatial::{Axis, Screw, angle};

/// Candidates that miss by more than this share of the size are not polished.
const NEAR: f64 = 0.2;

/// A joint whose lever arm is shorter than this, as a share of the size, may be free: see [`Motion::released`].
const NEARLY_FREE: f64 = 1e-6;

/// Answers farther apart than this are never merged \[rad, sizes\].
const MERGED: f64 = 1e-3;

/// Answers are merged when the miss half-way between them exceeds theirs by no more than this.
const INDISTINGUISHABLE: f64 = 16.0 * f64::EPSILON;

/// The steps that polish a candidate, and those that look for the nearest values.
const STEPS: [usize; 2] = [40, 200];

/// Values of the joints in a [`Motion`]'s unit.
pub(super) type Point<const N: usize> = [f64; N];

/// Candidates for solutions.
pub(super) type Candidates<const N: usize> = SmallVec<[Point<N>; 16]>;

/// `exp(S1 q1) .. exp(SN qN) p = k`, measured from `p` in units of the problem's size.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion<const N: usize> {
    pub screws: [Screw; N],
    pub p: Point3<f64>,
    pub k: Point3<f64>,
    unit: f64,
}

/// A solution with its miss.
struct Found<const N: usize> {
    q: Point<N>,
    miss: f64,
}

impl<const N: usize> Motion<N> {
    /// Rescales; `None` when a coordinate is not finite.
    ///
    /// The size is the largest distance of `p` from `k` and from the axes, and at least a hundredth of the coordinates, whose
    /// rounding the tolerance has to cover.
    pub fn new(screws: [&Screw; N], p: &Point3<f64>, k: &Point3<f64>) -> Option<Self> {
        let arms = screws.iter().map(|screw| match screw {
            Screw::Revolute(axis) => (axis.foot(p) - p).norm(),
            Screw::Prismatic(_) => 0.0,
        });
        let coordinates = 1e-2 * p.coords.norm().max(k.coords.norm());
        let size = arms.fold((k - p).norm().max(coordinates), f64::max);
        let unit = if size > 0.0 { size } else { 1.0 };
        let rescaled = |screw: &Screw| match screw {
            Screw::Revolute(axis) => {
                let point = Point3::from((axis.foot(p) - p) / unit);
                Axis::new(axis.direction().into_inner(), point).ok().map(Screw::Revolute)
            }
            screw => Some(*screw),
        };
        let mut list = [*screws[0]; N];
        for (target, screw) in list.iter_mut().zip(screws) {
            *target = rescaled(screw)?;
        }
        let k = Point3::from((k - p) / unit);
        (unit.is_finite() && k.iter().all(|x| x.is_finite())).then_some(Motion {
            screws: list,
            p: Point3::origin(),
            k,
            unit,
        })
    }

    /// The same equation for fewer or other joints, from `p` to `k`, in the same unit.
    pub fn with<const M: usize>(&self, screws: [Screw; M], p: Point3<f64>, k: Point3<f64>) -> Motion<M> {
        Motion { screws, p, k, unit: self.unit }
    }

    /// The inverse motion from `k` to `p`: its joints are the opposite ones in the opposite order.
    pub fn reversed(&self) -> Self {
        let mut screws = self.screws;
        screws.reverse();
        self.with(screws, self.k, self.p)
    }

    /// How far the joints miss the target.
    pub fn size(&self, q: &Point<N>) -> f64 {
        let moved = self.screws.iter().zip(q).rev().fold(self.p, |x, (screw, &q)| moved(screw, q, &x));
        (moved - self.k).norm()
    }

    /// The miss with its derivatives: of two joints, the second derivative is the earlier one's axis times the later
    /// one's velocity.
    fn miss(&self, q: &SVector<f64, N>) -> Miss<N> {
        let (mut velocity, mut axis) = ([Vector3::zeros(); N], [Vector3::zeros(); N]);
        let mut x = self.p.coords;
        for i in (0..N).rev() {
            match &self.screws[i] {
                Screw::Revolute(line) => {
                    let (w, r) = (line.direction().into_inner(), line.point().coords);
                    let (sine, versine) = (q[i].sin(), 2.0 * (0.5 * q[i]).sin().powi(2));
                    let turned = |v: Vector3<f64>| {
                        let tangent = w.cross(&v);
                        v + tangent * sine + w.cross(&tangent) * versine
                    };
                    x = r + turned(x - r);
                    for j in i + 1..N {
                        (velocity[j], axis[j]) = (turned(velocity[j]), turned(axis[j]));
                    }
                    (velocity[i], axis[i]) = (w.cross(&(x - r)), w);
                }
                Screw::Prismatic(direction) => {
                    x += direction.scale(q[i]);
                    velocity[i] = direction.into_inner();
                }
            }
        }
        let f = x - self.k.coords;
        let hessian =
            SMatrix::from_fn(|i, j| velocity[i].dot(&velocity[j]) + f.dot(&axis[i.min(j)].cross(&velocity[i.max(j)])));
        Miss { size: f.norm(), gradient: SVector::from_fn(|i, _| velocity[i].dot(&f)), hessian }
    }

    fn descend(&self, start: &Point<N>, steps: usize) -> Found<N> {
        let (q, miss) = descend(SVector::from(*start), steps, |q| self.miss(q));
        let q = std::array::from_fn(|i| if self.is_revolute(i) { angle::wrap(q[i]) } else { q[i] });
        Found { q, miss }
    }

    fn is_revolute(&self, joint: usize) -> bool {
        matches!(self.screws[joint], Screw::Revolute(_))
    }

    /// The candidates that polishing makes solutions, each once; the nearest values when there are none and `reach` allows it.
    pub fn settle(&self, candidates: impl IntoIterator<Item = Point<N>>, reach: Reach) -> Answers<N> {
        let exact = match reach {
            Reach::Within(_) => reach,
            Reach::Closest => Reach::EXACT,
        };
        let mut found = SmallVec::<[Found<N>; 8]>::new();
        for start in candidates {
            if self.size(&start) <= NEAR {
                self.add(&mut found, self.descend(&start, STEPS[0]), exact);
            }
        }
        if found.is_empty() && reach != Reach::EXACT {
            found = self.nearest(reach);
        }
        found.iter().map(|found| self.released(&found.q, reach)).collect()
    }

    /// Adds a solution unless it is out of reach or known.
    fn add(&self, found: &mut SmallVec<[Found<N>; 8]>, new: Found<N>, reach: Reach) {
        if !reach.covers(new.miss) {
            return;
        }
        match found.iter_mut().find(|old| self.is_same(old, &new)) {
            None => found.push(new),
            Some(old) if new.miss < old.miss => *old = new,
            Some(_) => {}
        }
    }

    /// Whether rounding cannot tell two solutions apart: half-way between them the miss is the same.
    fn is_same(&self, a: &Found<N>, b: &Found<N>) -> bool {
        let apart: Point<N> = std::array::from_fn(|i| match self.is_revolute(i) {
            true => angle::difference(b.q[i], a.q[i]),
            false => b.q[i] - a.q[i],
        });
        let between = std::array::from_fn(|i| a.q[i] + 0.5 * apart[i]);
        let limit = a.miss.max(b.miss) + INDISTINGUISHABLE;
        apart.iter().all(|x| x.abs() <= MERGED) && self.size(&between) <= limit
    }

    /// The best local minima of the miss that descents from a grid of starts reach.
    fn nearest(&self, reach: Reach) -> SmallVec<[Found<N>; 8]> {
        let mut found = SmallVec::new();
        let per_joint = if N == 2 { 8 } else { 5 };
        for index in 0..per_joint_power(per_joint, N) {
            let start = std::array::from_fn(|i| {
                let step = index / per_joint_power(per_joint, i) % per_joint;
                if self.is_revolute(i) { TAU * step as f64 / per_joint as f64 } else { step as f64 - 2.0 }
            });
            self.add(&mut found, self.descend(&start, STEPS[1]), reach);
        }
        let best = found.iter().fold(f64::INFINITY, |best: f64, found: &Found<N>| best.min(found.miss));
        found.retain(|found| reach != Reach::Closest || found.miss <= best + 1e-9);
        found
    }

    /// The solution with its free joints released: those that no value of which moves the target, the others polished with
    /// them at zero.
    fn released(&self, q: &Point<N>, reach: Reach) -> [Option<f64>; N] {
        let velocities = self.miss(&SVector::from(*q)).hessian;
        let mut answer = q.map(Some);
        let mut kept = *q;
        for i in 0..N {
            if !self.is_revolute(i) || velocities[(i, i)].abs() > NEARLY_FREE {
                continue;
            }
            let mut rest = kept;
            rest[i] = 0.0;
            let rest = self.polished_without(i, rest);
            let turned = |by: f64| self.size(&std::array::from_fn(|j| if j == i { by } else { rest[j] }));
            let limit = TOLERANCE.max(self.size(q) + TOLERANCE);
            if [0.0, 2.0, -2.0].iter().all(|&by| turned(by) <= limit && reach.covers(turned(by))) {
                (kept, answer[i]) = (rest, None);
            }
        }
        std::array::from_fn(|i| answer[i].map(|_| kept[i]))
    }

    /// The point polished with one joint held.
    fn polished_without(&self, held: usize, start: Point<N>) -> Point<N> {
        let (q, _) = descend(SVector::from(start), STEPS[0], |q| {
            let mut miss = self.miss(q);
            miss.gradient[held] = 0.0;
            miss.hessian.row_mut(held).fill(0.0);
            miss.hessian.column_mut(held).fill(0.0);
            miss.hessian[(held, held)] = 1.0;
            miss
        });
        std::array::from_fn(|i| if self.is_revolute(i) { angle::wrap(q[i]) } else { q[i] })
    }

    /// The answers in metres.
    pub fn to_metres(&self, answers: Answers<N>) -> Answers<N> {
        answers.map(|q| std::array::from_fn(|i| q[i].map(|q| if self.is_revolute(i) { q } else { q * self.unit })))
    }
}

fn per_joint_power(base: usize, exponent: usize) -> usize {
    (0..exponent).fold(1, |power, _| power * base)
}

/// `x` moved by one joint.
pub(super) fn moved(screw: &Screw, q: f64, x: &Point3<f64>) -> Point3<f64> {
    match screw {
        Screw::Revolute(axis) => axis.rotate(q, x),
        Screw::Prismatic(direction) => x + direction.scale(q),
    }
}

/// Whether the joint leaves `x` where it is, to [`TOLERANCE`].
pub(super) fn holds(screw: &Screw, x: &Point3<f64>) -> bool {
    matches!(screw, Screw::Revolute(axis) if axis.distance_to(x) <= TOLERANCE)
}

/// Whether the two joints do the same: coincident axes, or translations along the same direction, to [`TOLERANCE`].
pub(super) fn coincide(first: &Screw, second: &Screw) -> bool {
    match (first, second) {
        (Screw::Revolute(a), Screw::Revolute(b)) => {
            a.direction().cross(&b.direction()).norm() <= TOLERANCE && a.distance_to(&b.point()) <= TOLERANCE
        }
        (Screw::Prismatic(a), Screw::Prismatic(b)) => a.cross(b).norm() <= TOLERANCE,
        _ => false,
    }
}

/// The opposite value of a joint: angles stay in (-pi, pi].
pub(super) fn opposite(screw: &Screw, q: f64) -> f64 {
    if matches!(screw, Screw::Revolute(_)) && q == PI { PI } else { -q }
}
