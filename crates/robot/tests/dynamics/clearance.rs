//! Links that touch: distances of segments compared with a search, and robots in postures that are known to touch or
//! not.

use groebot_robot::dynamics::{Clearance, Model};
use groebot_robot::model::Robot;
use groebot_robot::robots;
use groebot_robot::spatial::Pose;
use nalgebra::{Point3, Vector3};
use proptest::prelude::*;

/// Two capsules on two prismatic arms of one base, with an arm between.
fn pair(ends: [[f64; 3]; 4], radii: [f64; 2]) -> Robot {
    let capsule = |from: [f64; 3], to: [f64; 3], radius: f64| {
        format!("collision = [{{ capsule = {{ radius = {radius:?}, from = {from:?}, to = {to:?} }} }}]")
    };
    let joint = |name: &str, child: &str| {
        format!(
            "[[joint]]\nname = \"{name}\"\ntype = \"continuous\"\nparent = \"base\"\nchild = \"{child}\"\naxis = [0, 0, 1]\n"
        )
    };
    let [a, b, c, d] = ends;
    let text = format!(
        "name = \"pair\"\n[[link]]\nname = \"base\"\ncollision = [{{ sphere = 1e-6, xyz = [50, 0, 0] }}]\n[[link]]\nname = \"one\"\n{}\n[[link]]\nname = \"other\"\n{}\n{}{}",
        capsule(a, b, radii[0]),
        capsule(c, d, radii[1]),
        joint("a", "one"),
        joint("b", "other")
    );
    Robot::from_toml(&text).unwrap()
}

fn depth(robot: &Robot, q: &[f64]) -> Option<f64> {
    let model = Model::new(robot).unwrap();
    let placed = model.place(&Pose::identity(), q).unwrap();
    Clearance::new(robot, &model).touching(&placed).first().map(|touch| touch.depth)
}

proptest! {
    #![proptest_config(crate::cases(256))]

    /// The distance of two segments compared with the least distance of their points on a fine grid.
    #[test]
    fn capsules_are_as_deep_as_their_segments_are_near(
        ends in prop::array::uniform4(prop::array::uniform3(-1.0..1.0f64)), radii in prop::array::uniform2(0.8..1.5f64),
    ) {
        let points = ends.map(Point3::from);
        let grid = 200;
        let along = |a: usize, k: usize| points[a] + (points[a + 1] - points[a]) * (k as f64 / grid as f64);
        let mut least = f64::INFINITY;
        for i in 0..=grid {
            for j in 0..=grid {
                least = f64::min(least, (along(0, i) - along(2, j)).norm());
            }
        }
        let expected = radii[0] + radii[1] - least;
        // The grid is at most half a step of both segments away from the nearest points.
        let coarse = ((points[1] - points[0]).norm() + (points[3] - points[2]).norm()) / 2.0 / grid as f64;
        match depth(&pair(ends, radii), &[0.0, 0.0]) {
            Some(found) => prop_assert!(found >= expected - 1e-12 && found <= expected + coarse, "{found} {expected}"),
            None => prop_assert!(expected <= 0.0),
        }
    }
}

#[test]
fn parallel_and_pointlike_capsules_are_measured() {
    let up = |x: f64| [[x, 0.0, 0.0], [x, 0.0, 1.0]];
    let at = |x: f64| [up(0.0), up(x)].concat().try_into().unwrap();
    assert!((depth(&pair(at(0.5), [0.3, 0.3]), &[0.0; 2]).unwrap() - 0.1).abs() < 1e-12);
    assert_eq!(depth(&pair(at(0.7), [0.3, 0.3]), &[0.0; 2]), None);
    let points = [[0.0; 3], [0.0; 3], [0.4, 0.0, 0.0], [0.4, 0.0, 0.0]];
    assert!((depth(&pair(points, [0.3, 0.3]), &[0.0; 2]).unwrap() - 0.2).abs() < 1e-12);
    // A half turn moves one capsule away.
    assert_eq!(depth(&pair(points, [0.3, 0.3]), &[0.0, std::f64::consts::PI]), Some(0.6 - 0.4));
}

/// NAO upright has no contact; with both legs crossed by the hip rolls the shanks touch.
#[test]
fn naos_legs_touch_where_they_cross() {
    let robot = robots::nao_v5();
    let model = Model::new(&robot).unwrap();
    let clearance = Clearance::new(&robot, &model);
    let mut q = vec![0.0; model.joints().len()];
    let name = |link: usize| robot.links()[link].name.as_str();
    let touching = |q: &[f64]| clearance.touching(&model.place(&Pose::translation(1.0, 2.0, 3.0), q).unwrap());
    assert!(touching(&q).is_empty(), "{:?}", touching(&q));
    q[model.joint("LHipRoll").unwrap()] = -0.35;
    q[model.joint("RHipRoll").unwrap()] = 0.35;
    let names: Vec<[&str; 2]> = touching(&q).iter().map(|touch| touch.links.map(name)).collect();
    assert!(names.contains(&["LTibia", "RTibia"]) && names.iter().all(|pair| !pair.contains(&"Torso")), "{names:?}");
    let deepest = touching(&q)[0];
    let tibia = |side: &str| {
        let placed = model.place(&Pose::identity(), &q).unwrap();
        placed.world_from_link(robot.link(&format!("{side}Tibia")).unwrap()) * Point3::from(Vector3::z() * -0.08)
    };
    assert!(deepest.depth > 0.0 && (tibia("L") - tibia("R")).norm() < 0.1);
}
