//! Goals with headings: each is reached by a walk that fulfils all conditions.

use groebot_humanoid::Watch;
use groebot_humanoid::gait::{Measures, Route, Side, Walk, Walker, plan_at};
use groebot_humanoid::walkers::{self, Outline};
use nalgebra::Point2;

/// Random goals within five metres, by a fixed sequence (Knuth's linear congruential generator).
struct Goals(u64);

impl Iterator for Goals {
    type Item = (f64, f64, f64);

    fn next(&mut self) -> Option<Self::Item> {
        let mut share = || {
            self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            (self.0 >> 11) as f64 / (1u64 << 53) as f64
        };
        let (radius, bearing, heading) = (5.0 * share().sqrt(), share(), share());
        let turn = |share: f64| (2.0 * share - 1.0) * std::f64::consts::PI;
        Some((radius * turn(bearing).cos(), radius * turn(bearing).sin(), turn(heading)))
    }
}

fn walk(walker: &Walker, (x, y, heading): (f64, f64, f64)) -> groebot_humanoid::Result<Walk> {
    let Walker { biped, legs, gaits, .. } = walker;
    let defaults = &gaits[0].1;
    let request = |height, ease| {
        let defaults = defaults.clone().eased(ease);
        let half_width = defaults.half_width(biped);
        let measures = Measures { length: defaults.length, half_width, most_turn: defaults.most_turn };
        let route = Route::towards(&Point2::new(x, y), Some(heading), Side::Left, &measures)?;
        Ok(defaults.from_upright(biped).request(biped, route, height))
    };
    plan_at((biped, legs), None, &defaults.hip_heights, request, &Watch::none())
}

fn arrives(name: &str, count: usize) {
    let walker = walkers::walker(name, Outline::Measured).unwrap().unwrap();
    for goal in Goals(7).take(count) {
        let walk = walk(&walker, goal).unwrap_or_else(|error| panic!("{name} {goal:?}: {error}"));
        let [left, right] = walk.schedule.route.stands().pop().unwrap();
        let middle = left.middle(&right);
        assert!((middle.point() - Point2::new(goal.0, goal.1)).norm() < 2e-3, "{name} {goal:?}");
        let off = groebot_robot::spatial::angle::difference(middle.yaw, goal.2);
        assert!(off.abs() < 1e-9, "{name} {goal:?}: off by {off}");
        assert!(walk.balances.iter().all(|balance| balance.margin >= walk.request.margin), "{name} {goal:?}");
    }
}

#[test]
fn goals_with_headings_are_reached() {
    arrives("nao", 2);
    arrives("rh0", 6);
    arrives("teo", 2);
}

/// 200 goals for each robot, none of which is rejected.
#[test]
#[ignore = "minutes: 600 walks of up to five metres"]
fn two_hundred_goals_with_headings_are_reached_by_each_robot() {
    for name in ["rh0", "teo", "nao"] {
        arrives(name, 200);
        println!("{name}: 200 of 200 goals");
    }
}
