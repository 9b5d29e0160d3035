//! Problems with published path lengths.

use std::path::Path;

use groebot::nav::{Cell, Map};
use nalgebra::Point2;

/// Start, goal and length in cells.
pub struct Problem {
    pub start: Point2<f64>,
    pub goal: Point2<f64>,
    pub length: f64,
}

/// A scenario of Moving AI: from and to cell centres, with eight neighbours. Row 0 of the map is the uppermost or the lowest one.
pub fn scenario(text: &str, rows: Option<usize>) -> Vec<Problem> {
    let problem = |line: &str| {
        let numbers: Vec<f64> = line.split('\t').skip(4).map(|word| word.trim().parse().expect("a number")).collect();
        let [x, y, to_x, to_y, length] = numbers[..] else { panic!("five numbers in {line}") };
        let middle = |x: f64, y: f64| Point2::new(x + 0.5, rows.map_or(y + 0.5, |rows| rows as f64 - y - 0.5));
        Problem { start: middle(x, y), goal: middle(to_x, to_y), length }
    };
    text.lines().skip(1).filter(|line| !line.is_empty()).map(problem).collect()
}

/// Polyanya's tests: `path(Vec2::new(x, y), Vec2::new(x, y))`, followed by the length.
pub fn tests(text: &str) -> Vec<Problem> {
    let number = |text: &str| text.trim().parse::<f64>().expect("a number");
    let pair = |text: &str| {
        let (x, y) = text.split_once(')').expect("an end").0.split_once(',').expect("two numbers");
        Point2::new(number(x), number(y))
    };
    let problem = |text: &str| {
        let mut points = text.split("Vec2::new(").skip(1);
        let (start, last) = (pair(points.next()?), points.next()?);
        let is_length = |word: &&str| word.contains('.') && word.parse::<f64>().is_ok();
        let words = last.split_once(')')?.1.split(|c: char| !(c.is_ascii_digit() || c == '.'));
        let length = words.into_iter().find(is_length)?;
        Some(Problem { start, goal: pair(last), length: number(length) })
    };
    text.split(".path(").skip(1).filter_map(problem).collect()
}

/// The cells whose centres are in a polygon of a mesh, in Polyanya's format, version 2.
pub fn mesh(path: &Path, columns: usize, rows: usize) -> Map {
    let text = std::fs::read_to_string(path).expect("a mesh");
    let mut lines = text.lines().skip(2).filter(|line| !line.is_empty()).map(numbers);
    let [points, polygons] = lines.next().expect("a head")[..] else { panic!("two counts") };
    let points: Vec<[f64; 2]> = lines.by_ref().take(points as usize).map(|line| [line[0], line[1]]).collect();
    let mut cells = vec![Cell::Occupied; columns * rows];
    for polygon in lines.take(polygons as usize) {
        let corners: Vec<[f64; 2]> = polygon[1..=polygon[0] as usize].iter().map(|at| points[*at as usize]).collect();
        fill(&corners, columns, &mut cells);
    }
    Map::of_cells(columns, rows, 1.0, cells).expect("a map")
}

fn numbers(line: &str) -> Vec<f64> {
    line.split_whitespace().map(|word| word.parse().expect("a number")).collect()
}

/// A convex polygon, anticlockwise.
fn fill(corners: &[[f64; 2]], columns: usize, cells: &mut [Cell]) {
    let range = |axis: usize| {
        let all = corners.iter().map(|corner| corner[axis]);
        all.clone().fold(f64::INFINITY, f64::min) as usize..all.fold(0.0, f64::max).ceil() as usize
    };
    let is_left =
        |(a, b): (&[f64; 2], &[f64; 2]), x: f64, y: f64| (b[0] - a[0]) * (y - a[1]) - (b[1] - a[1]) * (x - a[0]) >= 0.0;
    for (x, y) in range(1).flat_map(|y| range(0).map(move |x| (x, y))) {
        let mut sides = corners.iter().zip(corners.iter().cycle().skip(1));
        if sides.all(|side| is_left(side, x as f64 + 0.5, y as f64 + 0.5)) {
            cells[y * columns + x] = Cell::Free;
        }
    }
}
