//! Maps as JSON, CSV and SVG pictures.

use groebot_ik::ErrorKind;
use groebot_ik::reach::{Measure, ReachMap, Request};
use serde_json::{Value, json};

use super::{grid, map};

fn small(measure: Measure) -> ReachMap {
    let places = grid([(-0.8, 0.8, 5), (-0.8, 0.8, 4), (0.2, 0.6, 3)]);
    map("ur5", &Request { orientations: 20, measure, seed: Some(u64::MAX), ..Request::new(places) }).unwrap()
}

#[test]
fn json_is_read_as_it_was_written() {
    for measure in [Measure::Count, Measure::Manipulability] {
        let own = small(measure);
        assert_eq!(ReachMap::from_json(&own.to_json()).unwrap(), own);
    }
}

#[test]
fn csv_has_a_line_a_place() {
    let own = small(Measure::Manipulability);
    let text = own.to_csv();
    let mut lines = text.lines();
    assert_eq!(lines.next(), Some("x,y,z,reached,answers,open,best,mean"));
    for (place, line) in lines.by_ref().enumerate() {
        let numbers: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        let entry = own.entries[place];
        let [x, y, z] = own.grid.at(place);
        assert_eq!(numbers[..5], [x, y, z, entry.reached.into(), entry.answers.into()]);
        assert_eq!([numbers[6] as f32, numbers[7] as f32], [entry.best, entry.mean]);
    }
    assert_eq!(text.lines().count(), 1 + 60);
    assert_eq!(small(Measure::Count).to_csv().lines().next(), Some("x,y,z,reached,answers,open"));
}

#[test]
fn json_that_is_no_map_is_refused() {
    let whole: Value = serde_json::from_str(&small(Measure::Manipulability).to_json()).unwrap();
    let changes = [
        ("format", json!(2), ErrorKind::Unsupported),
        ("measure", json!("weight"), ErrorKind::UnknownName),
        ("x", json!({"from": 0, "to": 1, "count": 0}), ErrorKind::BadValue),
        ("z", json!({"from": 0.2, "to": 0.6, "count": 4}), ErrorKind::BadValue),
        ("x", json!({"from": 0, "to": 1, "count": 18446744073709551615u64}), ErrorKind::BadValue),
        ("orientations", json!(1), ErrorKind::BadValue),
        ("orientations", json!(0), ErrorKind::BadValue),
        ("reached", json!([1, 2]), ErrorKind::BadValue),
        ("reached", json!([-1]), ErrorKind::Syntax),
        ("answers", json!(vec![0; 60]), ErrorKind::BadValue),
        ("open", json!([1]), ErrorKind::BadValue),
        ("open", json!(vec![21; 60]), ErrorKind::BadValue),
        ("mean", json!([]), ErrorKind::BadValue),
        ("mean", json!(vec![-1.0; 60]), ErrorKind::BadValue),
        ("measure", json!("count"), ErrorKind::BadValue),
        ("seed", json!(-3), ErrorKind::Syntax),
    ];
    for (key, value, kind) in changes {
        let mut broken = whole.clone();
        broken[key] = value.clone();
        let error = ReachMap::from_json(&broken.to_string()).unwrap_err();
        assert_eq!(error.kind(), kind, "{key} {value}: {error}");
    }
    for text in ["", "{", "[]", "{\"format\": 1}"] {
        assert!(ReachMap::from_json(text).is_err());
    }
}

#[test]
fn slices_show_what_is_reached() {
    let places = grid([(-1.0, 1.0, 21), (-1.0, 1.0, 21), (0.0, 0.0, 1)]);
    let ring = map("planar_2r", &Request::new(places)).unwrap();
    let svg = ring.to_svg(None);
    // One slice. All reached places have the last colour, so that the area of its paths is that of the places.
    assert!(svg.contains(">z = 0.000 m<") && !svg.contains(">x = "));
    let path = svg.lines().find(|line| line.starts_with("<path class=\"s32\"")).unwrap();
    let widths = path
        .split(" d=")
        .nth(1)
        .unwrap()
        .split('h')
        .skip(1)
        .step_by(2)
        .map(|piece| piece.split('v').next().unwrap().parse::<f64>().unwrap());
    let cell = 300.0 / 21.0;
    assert!((widths.sum::<f64>() / cell - ring.reached() as f64).abs() < 1.0, "{}", ring.reached());
    assert_eq!(svg.matches("<path").count(), 1);
    // An axis too small for numbers next to it.
    let tiny = grid([(0.0, 1e-310, 3), (0.0, 1e-310, 2), (0.0, 0.0, 1)]);
    assert!(map("planar_2r", &Request::new(tiny)).unwrap().to_svg(None).starts_with("<svg"));
    let many = small(Measure::Manipulability);
    assert!(many.to_svg(None).matches(">z = ").count() == 3 && many.to_svg(Some(0)).matches(">x = ").count() == 5);
    assert!(many.to_svg(Some(1)).contains("mean manipulability"));
}
