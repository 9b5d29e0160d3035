//! Places, orientations and errors.

use std::f64::consts::FRAC_PI_2;

use groebot_ik::folder;
use groebot_ik::reach::{Axis, Grid, Measure, Request, Survey};
use groebot_ik::{ErrorKind, Watch};
use groebot_robot::kinematics::Chain;

use super::{derivation, grid, map};

#[test]
fn places_are_numbered_with_z_first() {
    let grid = grid([(-1.0, 1.0, 3), (0.0, 3.0, 4), (0.5, 0.5, 1)]);
    assert_eq!(grid.places(), 12);
    assert_eq!((grid.at(0), grid.at(1), grid.at(4)), ([-1.0, 0.0, 0.5], [-1.0, 1.0, 0.5], [0.0, 0.0, 0.5]));
    assert_eq!(grid.at(11), [1.0, 3.0, 0.5]);
    assert!((0..12).all(|place| grid.place(grid.numbers(place)) == place));
    assert_eq!((grid.axes()[1].step(), grid.axes()[2].step()), (1.0, 0.0));
}

#[test]
fn what_is_no_grid_is_refused() {
    for (from, to, count) in
        [(0.0, 1.0, 0), (1.0, 0.0, 2), (0.0, 0.0, 2), (0.0, 1.0, 1), (f64::NAN, 1.0, 2), (0.0, f64::INFINITY, 2)]
    {
        assert_eq!(Axis::new(from, to, count).unwrap_err().kind(), ErrorKind::BadValue, "{from} {to} {count}");
    }
    let long = Axis::new(0.0, 1.0, 1000).unwrap();
    assert_eq!(Grid::new([long; 3]).unwrap_err().kind(), ErrorKind::BadValue);
    let none = Axis { from: 0.0, to: 1.0, count: 0 };
    assert!(Grid::new([none, long, long]).unwrap_err().message().contains("`x`"));
    let vast = Axis::new(0.0, 1.0, usize::MAX).unwrap();
    assert_eq!(Grid::new([vast; 3]).unwrap_err().kind(), ErrorKind::BadValue);
}

#[test]
fn invalid_requests_are_refused() {
    let here = Request::new(grid([(0.3, 0.3, 1), (0.1, 0.1, 1), (0.2, 0.2, 1)]));
    let refused = |name: &str, request: &Request| map(name, request).unwrap_err();
    // The task has no position, or two tips.
    for name in ["wrist_rotation", "nao_head"] {
        assert_eq!(refused(name, &here).kind(), ErrorKind::Unsupported, "{name}");
    }
    let legs = folder::program(concat!(env!("CARGO_MANIFEST_DIR"), "/../../derivations/nao_legs").as_ref()).unwrap();
    assert_eq!(Survey::new(&legs.solver(), &legs, None, &here).err().unwrap().kind(), ErrorKind::Unsupported);
    let line = Request::new(grid([(0.3, 0.3, 1), (0.1, 0.1, 1), (0.0, 1.0, 5)]));
    assert!(refused("planar_2r", &line).message().contains("has no z"));
    for orientations in [0, 1_000_001] {
        assert_eq!(refused("ur5", &Request { orientations, ..here.clone() }).kind(), ErrorKind::BadValue);
    }
    for given in [vec![], vec![0.1, 0.2], vec![f64::NAN]] {
        assert!(refused("iiwa14", &Request { given, ..here.clone() }).message().contains("A3"));
    }
    // The limits are missing or invalid.
    assert_eq!(refused("planar_2r", &Request { measure: Measure::Limits, ..here.clone() }).kind(), ErrorKind::BadValue);
    for limits in [vec![[0.0, 1.0]], vec![[0.0, f64::NAN]; 2], vec![[0.0, 1.0], [1.0, 0.0]]] {
        assert_eq!(refused("planar_2r", &Request { limits: Some(limits), ..here.clone() }).kind(), ErrorKind::BadValue);
    }
    let (_, program) = derivation("planar_2r");
    let request = Request { measure: Measure::Manipulability, ..here };
    let without = Survey::new(&program.solver(), &program, None, &request).err().unwrap();
    assert_eq!(without.kind(), ErrorKind::Unsupported);
}

#[test]
fn orientations_are_spread_evenly_over_all() {
    // An arm whose tip is the centre of its spherical wrist. For each posture of the arm, rotations are evenly distributed, and so is the sine of the wrist's
    // pitch. One of two solutions has its pitch between -90 and 90 degrees. Up to an angle a the share of solutions is (1 + sin a) / 2.
    let text =
        std::fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/../../derivations/puma/0_chain.toml")).unwrap();
    let at_wrist = text.replace("[0, 1.524, 0.15]", "[0, 1.524, 0]");
    assert_ne!(at_wrist, text);
    let chain = Chain::from_toml(&at_wrist).unwrap();
    let proved = groebot_ik::derive(&chain).unwrap();
    let (program, free) = (proved.program(), [f64::NEG_INFINITY, f64::INFINITY]);
    let places = grid([(0.3, 0.3, 1), (0.8, 0.8, 1), (0.4, 0.4, 1)]);
    let orientations = 2000;
    let answers = |seed: Option<u64>, limits: Option<Vec<[f64; 2]>>| {
        let request = Request { orientations, seed, limits, ..Request::new(places) };
        let found =
            Survey::new(&program.solver(), program, Some(&chain), &request).unwrap().map(&Watch::none()).unwrap();
        found.entries[0].answers
    };
    for (most, seed) in [(-1.0, None), (-0.3, None), (0.6, None), (1.2, Some(3)), (0.6, Some(4))] {
        let mut limits = vec![free; 6];
        limits[4] = [-FRAC_PI_2, most];
        let (all, within) = (answers(seed, None), answers(seed, Some(limits)));
        assert_eq!(all as usize, 8 * orientations);
        let share = 2.0 * f64::from(within) / f64::from(all);
        let wanted = (1.0 + f64::sin(most)) / 2.0;
        assert!((share - wanted).abs() < 0.01, "{most}: {share} {wanted}");
    }
}

#[test]
fn a_map_does_not_depend_on_how_it_is_cut() {
    let (chain, program) = derivation("ur5");
    let solver = program.solver();
    let places = grid([(-0.9, 0.9, 5), (0.0, 0.8, 3), (-0.1, 0.9, 4)]);
    for measure in [Measure::Count, Measure::Manipulability] {
        for seed in [None, Some(7)] {
            let request = Request { orientations: 37, measure, seed, ..Request::new(places) };
            let survey = Survey::new(&solver, &program, Some(&chain), &request).unwrap();
            let whole = survey.map(&Watch::none()).unwrap();
            let cuts = [0, 1, 17, 18, 60];
            let parts = cuts.windows(2).flat_map(|ends| survey.entries(ends[0]..ends[1], &Watch::none()).unwrap());
            assert_eq!(whole.entries, parts.collect::<Vec<_>>());
            let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
            assert_eq!(whole, alone.install(|| survey.map(&Watch::none())).unwrap());
            assert!(whole.reached() > 0 && whole.entries.iter().any(|entry| entry.reached == 0));
        }
    }
}

#[test]
fn a_seed_turns_each_place_otherwise() {
    let places = grid([(0.3, 0.6, 4), (0.3, 0.3, 1), (0.4, 0.4, 1)]);
    let reached = |seed: Option<u64>| -> Vec<u32> {
        let map = map("ur5", &Request { orientations: 300, seed, ..Request::new(places) }).unwrap();
        map.entries.iter().map(|entry| entry.answers).collect()
    };
    let (own, one, two) = (reached(None), reached(Some(1)), reached(Some(2)));
    assert!(own != one && one != two && one == reached(Some(1)));
}

#[test]
fn long_maps_can_be_stopped() {
    let (_, program) = derivation("ur5");
    let request =
        Request { orientations: 1000, ..Request::new(grid([(-1.0, 1.0, 100), (-1.0, 1.0, 100), (-1.0, 1.0, 100)])) };
    let solver = program.solver();
    let survey = Survey::new(&solver, &program, None, &request).unwrap();
    let budget = Watch::none().with_time(std::time::Duration::from_millis(30));
    assert_eq!(survey.map(&budget).unwrap_err().kind(), ErrorKind::Budget);
    let flag = std::sync::Arc::new(std::sync::atomic::AtomicBool::new(true));
    assert_eq!(survey.map(&Watch::none().with_cancel(flag)).unwrap_err().kind(), ErrorKind::Cancelled);
}

#[test]
fn given_joints_are_distinguished_from_inputs_of_equal_name() {
    // The upright arm has a joint `roll`, and its task has an input with that name.
    let expected = [
        ("upright_arm", 0),
        ("iiwa14", 1),
        ("nao_left_arm_position", 1),
        ("nao_left_arm", 0),
        ("planar_4r", 1),
        ("ur5", 0),
    ];
    for (name, count) in expected {
        let program = derivation(name).1;
        let given: Vec<usize> = program.given_joints.iter().map(|given| given.input).collect();
        assert_eq!(given, (program.inputs.len() - count..program.inputs.len()).collect::<Vec<_>>(), "{name}");
    }
}
