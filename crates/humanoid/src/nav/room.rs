//! Rooms: a floor with furniture in metres, read from TOML. Main type: [`Room`].

use nalgebra::{Point2, Vector2};

use super::map::Map;
use super::shape::Shape;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::limits::check_name;
use groebot_robot::document::{Document, Node, Table, one_among, shown};

/// A piece of furniture, or an area of the floor with another speed.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    /// Its name.
    pub name: String,
    /// Its outline in its own frame \[m\].
    pub outline: Shape,
    /// The position of its origin in the world \[m\].
    pub place: Point2<f64>,
    /// Its anticlockwise rotation \[rad\].
    pub yaw: f64,
    /// Its height \[m\], for pictures and distances. No robot walks over or under furniture.
    pub height: f64,
}

/// The default height of furniture \[m\]: that of a table.
const HEIGHT: f64 = 0.75;

impl Piece {
    /// Its outline in the world \[m\].
    pub fn shape(&self) -> Shape {
        let (sine, cosine) = self.yaw.sin_cos();
        let turned = |at: &Point2<f64>| Vector2::new(cosine * at.x - sine * at.y, sine * at.x + cosine * at.y);
        self.outline.moved(&|at| self.place + turned(at), 1.0)
    }
}

/// A rectangular floor with furniture.
#[derive(Clone, Debug, PartialEq)]
pub struct Room {
    /// Its dimensions along x and y \[m\].
    pub size: [f64; 2],
    /// The side of a cell of its map \[m\].
    pub resolution: f64,
    /// The position of its lower left corner \[m\], and its anticlockwise rotation \[rad\].
    pub origin: [f64; 3],
    /// The thickness of its walls, which are inside its borders \[m\].
    pub wall: f64,
    /// The initial position and heading of the robot \[m, rad\], where they are given.
    pub start: Option<[f64; 3]>,
    /// The furniture.
    pub pieces: Vec<Piece>,
    /// Areas with a speed other than 1, F of RH0 (4-7). Where they overlap, the later one counts.
    pub slow: Vec<(Piece, f64)>,
}

impl Room {
    /// Reads a room. The keys are `size`, and optionally `resolution` (0.05), `origin` (x, y and yaw in degrees),
    /// `wall` and `start` (x, y and a heading in degrees). The tables are `[[furniture]]` and `[[slow]]` (with its
    /// `speed`). Each has a `name`, an outline, `at` (x, y, and a yaw in degrees) and a `height` (0.75). An outline is
    /// `box` (length and width), `circle` (radius) or `polygon` (corners).
    ///
    /// # Errors
    /// With the line: those of [`Document`]; [`ErrorKind::DuplicateName`]; [`ErrorKind::BadValue`] as [`Shape::check`].
    pub fn from_toml(text: &str) -> Result<Self> {
        let document = Document::parse(text)?;
        let root = document.root();
        root.deny_unknown(&["size", "resolution", "origin", "wall", "start", "furniture", "slow"])?;
        let number = |key: &str, usual: f64| root.optional(key).map_or(Ok(usual), |node| node.float());
        let origin = root.optional("origin").map_or(Ok([0.0; 3]), |node| placed(&node))?;
        let tables = |key: &str| root.optional(key).map_or(Ok(Vec::new()), |node| node.tables());
        let pieces: Vec<Piece> = tables("furniture")?.iter().map(|table| piece(table, &[])).collect::<Result<_>>()?;
        let twice = |place: &usize| pieces[..*place].iter().any(|piece| piece.name == pieces[*place].name);
        if let Some(place) = (0..pieces.len()).find(twice) {
            let text = format!("`{}` is given twice; give each piece its own name", shown(&pieces[place].name));
            return Err(tables("furniture")?[place].error(ErrorKind::DuplicateName, text));
        }
        let slow = |table: &Table<'_>| Ok((piece(table, &["speed"])?, table.required("speed")?.float()?));
        Ok(Room {
            size: root.required("size")?.float_vector()?,
            resolution: number("resolution", 0.05)?,
            origin,
            wall: number("wall", 0.0)?,
            start: root.optional("start").map(|node| placed(&node)).transpose()?,
            pieces,
            slow: tables("slow")?.iter().map(slow).collect::<Result<_>>()?,
        })
    }

    /// Moves a piece to another position with an anticlockwise rotation \[m, rad\].
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] with the known names.
    pub fn with_moved(mut self, name: &str, place: Point2<f64>, yaw: f64) -> Result<Self> {
        let at = self.find(name)?;
        (self.pieces[at].place, self.pieces[at].yaw) = (place, yaw);
        Ok(self)
    }

    /// Removes a piece.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] with the known names.
    pub fn without(mut self, name: &str) -> Result<Self> {
        let at = self.find(name)?;
        self.pieces.remove(at);
        Ok(self)
    }

    /// A piece by its name.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] with the known names.
    pub fn piece(&self, name: &str) -> Result<&Piece> {
        self.find(name).map(|at| &self.pieces[at])
    }

    fn find(&self, name: &str) -> Result<usize> {
        let names: Vec<&str> = self.pieces.iter().map(|piece| piece.name.as_str()).collect();
        names.iter().position(|own| *own == name).ok_or_else(|| {
            let text = format!("there is no piece `{}`{}", shown(name), one_among(name, &names));
            Error::new(ErrorKind::UnknownName, text)
        })
    }

    /// Its map.
    ///
    /// # Errors
    /// As [`Map::new`], [`Map::placed`], [`Map::with`] and [`Map::with_speed`].
    pub fn map(&self) -> Result<Map> {
        let bad = |text: String| Err(Error::new(ErrorKind::BadValue, text));
        let [length, width] = self.size;
        if !self.size.iter().all(|size| size.is_finite() && *size > 0.0) {
            return bad(format!("a room of {length} x {width} m; give positive numbers"));
        }
        if !(self.wall.is_finite() && self.wall >= 0.0) {
            return bad(format!("walls of {} m; give a number that is not below zero", self.wall));
        }
        let [x, y, yaw] = self.origin;
        let count = |size: f64| (size / self.resolution).round().max(1.0) as usize;
        let mut map = Map::new(count(length), count(width), self.resolution)?
            .placed(Point2::new(x, y), yaw)?
            .with(&self.walls())?;
        for (piece, speed) in &self.slow {
            map = map.with_speed(&piece.shape(), *speed)?;
        }
        let furniture: Vec<Shape> = self.pieces.iter().map(Piece::shape).collect();
        map.with(&furniture)
    }

    /// Four boxes along the borders.
    pub(crate) fn walls(&self) -> Vec<Shape> {
        let ([length, width], thick, [x, y, yaw]) = (self.size, self.wall, self.origin);
        if thick == 0.0 {
            return Vec::new();
        }
        let room = Piece {
            name: String::new(),
            outline: Shape::Polygon(Vec::new()),
            place: Point2::new(x, y),
            yaw,
            height: HEIGHT,
        };
        let along = |x0: f64, y0: f64, x1: f64, y1: f64| {
            let corners = [(x0, y0), (x1, y0), (x1, y1), (x0, y1)].map(|(x, y)| Point2::new(x, y)).to_vec();
            Piece { outline: Shape::Polygon(corners), ..room.clone() }.shape()
        };
        vec![
            along(0.0, 0.0, length, thick),
            along(0.0, width - thick, length, width),
            along(0.0, 0.0, thick, width),
            along(length - thick, 0.0, length, width),
        ]
    }
}

/// x, y, and a yaw in degrees where it is given.
fn placed(node: &Node<'_>) -> Result<[f64; 3]> {
    match node.array()?[..] {
        [x, y] => Ok([x.float()?, y.float()?, 0.0]),
        [x, y, yaw] => Ok([x.float()?, y.float()?, yaw.float()?.to_radians()]),
        _ => Err(node.error(ErrorKind::BadValue, "give x and y in metres, and optionally a yaw in degrees")),
    }
}

fn piece(table: &Table<'_>, more: &[&str]) -> Result<Piece> {
    table.deny_unknown(&[&["name", "box", "circle", "polygon", "at", "height"], more].concat())?;
    let outlines = ["box", "circle", "polygon"].map(|key| table.optional(key));
    let outline = match outlines {
        [Some(size), None, None] => {
            let [length, width] = size.float_vector()?;
            Shape::rectangle(Point2::origin(), length, width, 0.0)
        }
        [None, Some(radius), None] => Shape::Circle { centre: Point2::origin(), radius: radius.float()? },
        [None, None, Some(corners)] => {
            let corner = |node: &Node<'_>| node.float_vector().map(|[x, y]| Point2::new(x, y));
            Shape::Polygon(corners.array()?.iter().map(corner).collect::<Result<_>>()?)
        }
        _ => return Err(table.error(ErrorKind::BadValue, "give one outline: `box`, `circle` or `polygon`")),
    };
    outline.check().map_err(|error| table.error(error.kind(), error.message()))?;
    let [x, y, yaw] = table.optional("at").map_or(Ok([0.0; 3]), |node| placed(&node))?;
    let height = table.optional("height").map_or(Ok(HEIGHT), |node| node.float())?;
    if !(height.is_finite() && height > 0.0) {
        return Err(table.error(ErrorKind::BadValue, format!("a height of {height} m; give a positive number")));
    }
    let node = table.required("name")?;
    let name = node.text()?.to_owned();
    check_name("piece", &name).map_err(|error| node.place(error))?;
    Ok(Piece { name, outline, place: Point2::new(x, y), yaw, height })
}
