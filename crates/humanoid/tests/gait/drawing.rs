//! The picture of a walk, parsed again: its axes agree with the table.

use std::collections::BTreeMap;

use groebot_humanoid::Watch;
use groebot_humanoid::gait::{Biped, Gait, Measures, Regular, Route, Side, Walk, plan};
use groebot_humanoid::walkers::{NAO_SINE, Outline};
use groebot_robot::motion::Trajectory;
use nalgebra::Point2;
use quick_xml::events::Event;

use super::{regular, request, robot, walk};

/// An element of a picture: name, attributes, text.
#[derive(Clone, Debug, Default)]
struct Element {
    name: String,
    attributes: BTreeMap<String, String>,
    text: String,
}

impl Element {
    fn is(&self, class: &str) -> bool {
        self.attributes.get("class").is_some_and(|classes| classes.split(' ').any(|other| other == class))
    }

    fn number(&self, attribute: &str) -> f64 {
        self.attributes[attribute].parse().unwrap()
    }

    fn points(&self) -> Vec<(f64, f64)> {
        let point = |text: &str| text.split_once(',').map(|(x, y)| (x.parse().unwrap(), y.parse().unwrap())).unwrap();
        self.attributes["points"].split(' ').map(point).collect()
    }
}

/// The elements of a picture in order. Fails if it is not XML.
fn elements(svg: &str) -> Vec<Element> {
    let mut reader = quick_xml::Reader::from_str(svg);
    let mut all: Vec<Element> = Vec::new();
    loop {
        match reader.read_event().unwrap() {
            Event::Start(tag) | Event::Empty(tag) => {
                let attributes = tag.attributes().map(|attribute| {
                    let attribute = attribute.unwrap();
                    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
                    (text(attribute.key.as_ref()), text(&attribute.value))
                });
                let name = String::from_utf8(tag.name().as_ref().to_vec()).unwrap();
                all.push(Element { name, attributes: attributes.collect(), text: String::new() });
            }
            Event::Text(text) => {
                if let Some(element) = all.last_mut() {
                    element.text += text.decode().unwrap().trim();
                }
            }
            Event::Eof => return all,
            _ => {}
        }
    }
}

/// The elements below the title that contains `from`, up to the next title.
fn panel<'e>(all: &'e [Element], from: &str) -> &'e [Element] {
    let start = all.iter().position(|element| element.is("title") && element.text.contains(from)).unwrap();
    let rest = &all[start + 1..];
    &rest[..rest.iter().position(|element| element.is("title")).unwrap_or(rest.len())]
}

/// Maps a pixel of an axis to its value, by the first and the last of its ticks. `along` is `x` or `y`.
fn axis(panel: &[Element], along: &str) -> impl Fn(f64) -> f64 {
    let ticks: Vec<(f64, f64)> = panel
        .iter()
        .filter(|element| element.is("tick") && element.is(along))
        .map(|tick| (tick.number(along), tick.text.split(' ').next().unwrap().parse().unwrap()))
        .collect();
    assert!(ticks.len() >= 3, "{along}: {ticks:?}");
    let ((from, low), (to, high)) = (ticks[0], ticks[ticks.len() - 1]);
    // The numbers of the left axis are four pixels below their ticks.
    let lower = if along == "y" { 4.0 } else { 0.0 };
    move |pixel: f64| low + (pixel - (from - lower)) / (to - from) * (high - low)
}

/// The margins in a walk's table with their times \[m\], \[s\].
fn margins_of_table(humanoid: &Biped, walk: &Walk) -> Vec<(f64, f64)> {
    let read = Trajectory::from_csv(&walk.to_csv(humanoid)).unwrap();
    let margin = read.figures.iter().find(|figure| figure.name == "margin").unwrap();
    margin.values.iter().copied().zip(read.times).collect()
}

fn on_the_spot(turn: f64) -> Walk {
    let route = Route::regular(&Regular { steps: 8, length: 0.0, turn, ..regular() }).unwrap();
    walk(&groebot_humanoid::gait::Request { route, ..request(&regular()) }).unwrap()
}

fn by_goal(walker: &str, goal: (f64, f64)) -> (Biped, Walk) {
    let (humanoid, legs) = super::built(walker);
    let defaults = &groebot_humanoid::walkers::walker(walker, Outline::Measured).unwrap().unwrap().gaits[0].1;
    let measures =
        Measures { length: defaults.length, half_width: defaults.half_width(&humanoid), most_turn: defaults.most_turn };
    let route = Route::towards(&Point2::new(goal.0, goal.1), None, Side::Left, &measures).unwrap();
    let request = defaults.request(&humanoid, route, defaults.hip_heights[0]);
    let walk = plan(&humanoid, &legs, &request, &Watch::none()).unwrap();
    (humanoid, walk)
}

#[test]
fn the_least_margin_is_marked_with_the_value_of_the_table() {
    let (teo, far) = by_goal("teo", (0.3, 0.1));
    let preview = walk(&groebot_humanoid::gait::Request { gait: Gait::Preview, ..request(&regular()) }).unwrap();
    for (humanoid, walk) in [(&robot().0, &on_the_spot(0.6)), (&robot().0, &preview), (&teo, &far)] {
        let all = elements(&walk.to_svg(humanoid));
        let panel = panel(&all, "margin of the zero moment point");
        let table = margins_of_table(humanoid, walk);
        let least = table.iter().map(|(margin, _)| *margin).fold(f64::INFINITY, f64::min);
        let labels = table
            .iter()
            .filter(|(margin, _)| margin - least < 2e-9)
            .map(|(_, time)| (*time, format!("least: {:.1} mm at {time:.2} s", 1e3 * least)));
        let label = panel.iter().find(|element| element.name == "text" && element.is("least")).unwrap();
        let mut alike = labels.filter(|(_, text)| *text == label.text);
        let (when, _) = alike.next().unwrap_or_else(|| panic!("{}: {least}", label.text));
        let (time, margin) = (axis(panel, "x"), axis(panel, "y"));
        let mark = panel.iter().find(|element| element.name == "circle").unwrap();
        let marked = (time(mark.number("cx")), margin(mark.number("cy")));
        assert!((marked.0 - when).abs() < 0.1 && (marked.1 - 1e3 * least).abs() < 0.5, "{marked:?} {when} {least}");
        let curve = panel.iter().rfind(|element| element.is("margin")).unwrap().points();
        assert_eq!(curve.len(), walk.balances.len());
        for (balance, point) in walk.balances.iter().zip(&curve).step_by(7) {
            assert!((margin(point.1) - 1e3 * balance.margin).abs() < 0.5);
        }
        let zero = panel.iter().find(|element| element.is("zero")).unwrap().points();
        assert!(margin(zero[0].1).abs() < 0.5 && zero[0].1 == zero[1].1);
        assert!(zero[0].1 > mark.number("cy"), "a walk that stands is above the zero line");
    }
}

#[test]
fn the_times_on_one_foot_are_shaded() {
    let walk = walk(&request(&regular())).unwrap();
    let all = elements(&walk.to_svg(&robot().0));
    let panel = panel(&all, "margin of the zero moment point");
    let time = axis(panel, "x");
    let height = panel.iter().rfind(|element| element.is("frame")).unwrap().number("height");
    let shaded: Vec<&Element> = panel
        .iter()
        .filter(|element| {
            (element.is("left-stands") || element.is("right-stands")) && element.number("height") == height
        })
        .collect();
    assert_eq!(shaded.len(), 4);
    for (place, area) in shaded.iter().enumerate() {
        // When the left foot swings first, the right foot supports.
        assert!(area.is(["right-stands", "left-stands"][place % 2]));
        let (from, to) = (time(area.number("x")), time(area.number("x") + area.number("width")));
        let start = 0.3 + 0.96 + 1.5 * place as f64;
        assert!((from - start).abs() < 0.02 && (to - start - 0.54).abs() < 0.02, "{place}: {from} {to}");
    }
}

#[test]
fn the_axes_of_the_view_are_in_metres() {
    let (teo, far) = by_goal("teo", (0.3, 0.1));
    let (nao, _) = robot();
    for (humanoid, walk) in [(nao, &walk(&request(&regular())).unwrap()), (nao, &on_the_spot(0.6)), (&teo, &far)] {
        let all = elements(&walk.to_svg(humanoid));
        let panel = panel(&all, "steps from above");
        let (x, y) = (axis(panel, "x"), axis(panel, "y"));
        let soles: Vec<&Element> = panel.iter().filter(|element| element.name == "polygon").collect();
        let step = walk.schedule.route.steps.last().unwrap();
        let last = soles.iter().rfind(|sole| sole.is(step.side.name())).unwrap().points();
        for (corner, at) in humanoid.sole_at(step.side, &step.print).corners().iter().zip(last) {
            assert!((corner - Point2::new(x(at.0), y(at.1))).norm() < 2e-3, "{corner} {at:?}");
        }
    }
}

/// The steps whose numbers are drawn, with the centres of their boxes.
fn numbers(svg: &str) -> Vec<(String, (f64, f64))> {
    let all = elements(svg);
    let written = panel(&all, "steps from above").iter().filter(|element| element.is("number"));
    written.map(|text| (text.text.clone(), (text.number("x"), text.number("y")))).collect()
}

fn keep_apart(numbers: &[(String, (f64, f64))]) -> bool {
    let letters = |text: &str| text.chars().count() as f64;
    numbers.iter().enumerate().all(|(place, (a, at))| {
        numbers[..place].iter().all(|(b, other)| {
            (at.0 - other.0).abs() >= 3.3 * (letters(a) + letters(b)) || (at.1 - other.1).abs() >= 11.0
        })
    })
}

#[test]
fn every_sole_has_its_number_and_no_number_covers_another() {
    let (nao, _) = robot();
    let (teo, far) = by_goal("teo", (1.0, 0.5));
    for (humanoid, walk) in [(nao, &walk(&request(&regular())).unwrap()), (nao, &on_the_spot(0.6)), (&teo, &far)] {
        let numbers = numbers(&walk.to_svg(humanoid));
        let mut steps: Vec<usize> =
            numbers.iter().flat_map(|(text, _)| text.split(',')).map(|step| step.parse().unwrap()).collect();
        steps.sort_unstable();
        let all: Vec<usize> = [0].into_iter().chain(0..=walk.schedule.route.steps.len()).collect();
        assert_eq!(steps, all, "{numbers:?}");
        assert!(keep_apart(&numbers), "{numbers:?}");
    }
}

#[test]
fn soles_on_one_place_are_one_with_all_its_steps() {
    let svg = on_the_spot(0.0).to_svg(&robot().0);
    assert_eq!(svg.matches("<polygon").count(), 2);
    let mut written: Vec<String> = numbers(&svg).into_iter().map(|(text, _)| text).collect();
    written.sort();
    assert_eq!(written, ["0,1,3,5,7", "0,2,4,6,8"]);
    let route = Route::regular(&Regular { steps: 13, length: 0.0, ..regular() }).unwrap();
    let many = walk(&groebot_humanoid::gait::Request { route, ..request(&regular()) }).unwrap();
    assert!(numbers(&many.to_svg(&robot().0)).iter().any(|(text, _)| text == "0,1,3..13"));
}

#[test]
fn a_walk_of_many_steps_leaves_out_what_has_no_room() {
    let measures = Measures { length: NAO_SINE.length, half_width: 0.05, most_turn: NAO_SINE.most_turn };
    let route = Route::towards(&Point2::new(8.0, 0.0), None, Side::Left, &measures).unwrap();
    let count = route.steps.len();
    let far = walk(&groebot_humanoid::gait::Request { route, ..request(&regular()) }).unwrap();
    let numbers = numbers(&far.to_svg(&robot().0));
    assert!(keep_apart(&numbers));
    for step in [count - 1, count] {
        assert!(numbers.iter().any(|(text, _)| *text == step.to_string()), "{step}");
    }
}
