//! The frames of an SDF: links, joints, models and named frames, each relative to another one. Main type: [`Frames`].

use std::collections::BTreeMap;

use crate::document::shown;
use crate::model::some_among;
use crate::spatial::exact::Placement;
use crate::{Error, ErrorKind, Result};

/// The name of a model's own frame in its scope.
pub const MODEL: &str = "__model__";
/// The frame of the world.
pub const WORLD: &str = "world";
/// The largest number of frames between a frame and the world.
const DEEPEST: usize = 200;

/// What a frame is fixed to.
#[derive(Clone, Debug)]
pub enum Fixed {
    /// It is the frame of a link, or of the world.
    Itself,
    /// The frame with this full name.
    To(String),
    /// Nothing: a model without links.
    Nothing,
}

/// A frame with its reference.
struct Frame {
    /// The full name of its reference; `None` for the world.
    reference: Option<String>,
    /// Its pose in the reference.
    pose: Placement,
    /// The frame in it whose pose is `pose`: the placement frame of a model.
    placed_by: Option<String>,
    fixed: Fixed,
    /// Where it is in the file.
    error: Error,
}

/// All frames by their full names, such as `arm::hand::tip`.
pub struct Frames {
    frames: Vec<Frame>,
    places: BTreeMap<String, usize>,
}

impl Frames {
    /// The frame of the world.
    pub fn new() -> Self {
        let error = Error::new(ErrorKind::BadValue, "the world");
        let world =
            Frame { reference: None, pose: Placement::identity(), placed_by: None, fixed: Fixed::Itself, error };
        Frames { frames: vec![world], places: BTreeMap::from([(WORLD.to_owned(), 0)]) }
    }

    /// Adds the frame `name`. `error` has its place in the file.
    ///
    /// # Errors
    /// [`ErrorKind::DuplicateName`] for a name in use.
    pub fn add(&mut self, name: &str, reference: String, pose: Placement, fixed: Fixed, error: Error) -> Result<()> {
        if self.places.insert(name.to_owned(), self.frames.len()).is_some() {
            let text =
                format!("another link, joint, frame or model is named `{}`; give each a different name", shown(name));
            return Err(like(&error, ErrorKind::DuplicateName, text));
        }
        self.frames.push(Frame { reference: Some(reference), pose, placed_by: None, fixed, error });
        Ok(())
    }

    /// Makes the last frame, a model, have its pose at the frame `name` in it.
    pub fn place_by(&mut self, name: String) {
        if let Some(frame) = self.frames.last_mut() {
            frame.placed_by = Some(name);
        }
    }

    /// The place of the frame `name`; `at` has the place of its use in the file.
    fn place(&self, name: &str, at: &Error) -> Result<usize> {
        let model = || format!("{name}::{MODEL}");
        self.places.get(name).or_else(|| self.places.get(&model())).copied().ok_or_else(|| {
            let text = format!(
                "there is no frame `{}`{}",
                shown(name),
                some_among(name, self.places.keys().map(String::as_str))
            );
            like(at, ErrorKind::UnknownName, text)
        })
    }

    /// The full name of the link that the frame `name` is fixed to.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] for a frame that does not exist; [`ErrorKind::BadValue`] for frames that are fixed to each
    /// other.
    pub fn link_of(&self, name: &str, at: &Error) -> Result<String> {
        let mut name = name.to_owned();
        for _ in 0..DEEPEST {
            let place = self.place(&name, at)?;
            match &self.frames[place].fixed {
                Fixed::Itself => return Ok(name),
                Fixed::To(other) => name.clone_from(other),
                Fixed::Nothing => break,
            }
        }
        Err(like(at, ErrorKind::BadValue, format!("the frame `{}` is fixed to no link", shown(&name))))
    }

    /// The pose of the frame `inner` in the frame `outer`.
    ///
    /// # Errors
    /// [`ErrorKind::UnknownName`] for a frame that does not exist; [`ErrorKind::BadValue`] for frames that refer to each
    /// other.
    pub fn between(&self, outer: &str, inner: &str, at: &Error) -> Result<Placement> {
        let [from, to] = [self.path(self.place(outer, at)?, 0, 0)?, self.path(self.place(inner, at)?, 0, 0)?];
        // Frames above both cancel.
        let shared = from.iter().rev().zip(to.iter().rev()).take_while(|(a, b)| a.0 == b.0).count();
        Ok(compose(&from[..from.len() - shared]).inverse().then(&compose(&to[..to.len() - shared])))
    }

    /// The frames from a frame up to the frame `end`, or to the world, each with its pose in the next.
    fn path(&self, place: usize, end: usize, depth: usize) -> Result<Vec<(usize, Placement)>> {
        let (mut path, mut place) = (Vec::new(), place);
        while let Some(reference) = self.frames[place].reference.as_ref().filter(|_| place != end) {
            let frame = &self.frames[place];
            if path.len() + depth > DEEPEST {
                let text = "the frames refer to each other in a circle, or by more than 200 steps";
                return Err(like(&frame.error, ErrorKind::BadValue, text.to_owned()));
            }
            path.push((place, self.pose(place, depth)?));
            place = self.place(reference, &frame.error)?;
        }
        if place == end || end == 0 {
            return Ok(path);
        }
        let frame = &self.frames[end];
        let text = "its placement frame is not in the model".to_owned();
        Err(like(&frame.error, ErrorKind::BadValue, text))
    }

    /// The pose of a frame in its reference.
    fn pose(&self, place: usize, depth: usize) -> Result<Placement> {
        let frame = &self.frames[place];
        let Some(by) = &frame.placed_by else { return Ok(frame.pose.clone()) };
        let path = self.path(self.place(by, &frame.error)?, place, depth + DEEPEST / 4)?;
        Ok(frame.pose.then(&compose(&path).inverse()))
    }
}

/// The pose of the first frame of a path in the reference of its last one.
fn compose(path: &[(usize, Placement)]) -> Placement {
    path.iter().rev().fold(Placement::identity(), |outer, (_, inner)| {
        let pose = outer.then(inner);
        Placement { rotation: pose.rotation.shortened(), ..pose }
    })
}

/// An error of another kind at the place of `at`.
fn like(at: &Error, kind: ErrorKind, text: String) -> Error {
    let place = at.place();
    let text = if at.message().is_empty() { text } else { format!("{}: {text}", at.message()) };
    let error = Error::new(kind, text);
    let error = place.line.map_or(error.clone(), |line| error.at_line(line));
    place.file.as_ref().map_or(error.clone(), |file| error.in_file(file))
}
