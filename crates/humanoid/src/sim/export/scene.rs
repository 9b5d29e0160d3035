//! Scenes: trees of nodes that move in time. Main type: [`Scene`].

use nalgebra::{Matrix4, Point3, UnitQuaternion, Vector3};

use crate::{Error, ErrorKind, Result};
use groebot_robot::document::shown;
use groebot_robot::model::{Solid, Surface};
use groebot_robot::spatial::Pose;

/// A tree of nodes that move in time. Metres, radians, seconds; y is up.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Scene {
    /// Its title.
    pub title: String,
    /// The times of the motion's samples: ascending from zero; empty where nothing moves.
    pub times: Vec<f64>,
    /// The nodes in depth-first order, each after its parent.
    pub nodes: Vec<Node>,
    /// The objects that could not be shown, with the reasons.
    pub notes: Vec<String>,
}

/// A frame and the visible parts in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Node {
    /// Its name.
    pub name: String,
    /// Its parent node.
    pub parent: Option<usize>,
    /// Its frame in that of its parent; for a moving node, at the first sample.
    pub pose: Pose,
    /// Factors along x, y and z of all its content.
    pub scale: [f64; 3],
    /// Its rotation at each sample; empty where it does not rotate.
    pub turns: Vec<UnitQuaternion<f64>>,
    /// Its position at each sample; empty where it does not move.
    pub slides: Vec<Vector3<f64>>,
    /// The visible parts.
    pub parts: Vec<Part>,
}

/// A body of one material.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Its frame in that of its node.
    pub pose: Pose,
    /// Its form.
    pub body: Body,
    /// Its appearance.
    pub material: Material,
}

/// A shape.
#[derive(Clone, Debug, PartialEq)]
pub enum Body {
    /// A primitive; no mesh.
    Solid(Solid),
    /// Triangles.
    Surface(Surface),
}

/// A material with the fields and the defaults of VRML97. Colours are red, green and blue from 0 to 1 in sRGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Material {
    /// The reflected fraction of ambient light.
    pub ambient: f64,
    /// The diffuse colour.
    pub diffuse: [f64; 3],
    /// The emissive colour.
    pub emissive: [f64; 3],
    /// The colour of its highlights.
    pub specular: [f64; 3],
    /// 1 for an opaque body.
    pub opacity: f64,
}

impl Default for Material {
    fn default() -> Self {
        Material { ambient: 0.2, diffuse: [0.8; 3], emissive: [0.0; 3], specular: [0.0; 3], opacity: 1.0 }
    }
}

impl Node {
    /// A node with the frames `poses`, one per sample or one for all.
    ///
    /// # Panics
    /// Without a pose.
    pub(super) fn moved(name: &str, parent: Option<usize>, poses: &[Pose]) -> Self {
        let mut node = Node::at(name, parent, poses[0]);
        if poses.iter().any(|pose| pose.rotation != node.pose.rotation) {
            node.turns = poses.iter().map(|pose| pose.rotation).collect();
            // A quaternion and its negative are one rotation; the sign is chosen for the shorter arc between two
            // samples.
            for place in 1..node.turns.len() {
                if node.turns[place - 1].coords.dot(&node.turns[place].coords) < 0.0 {
                    node.turns[place] = UnitQuaternion::new_unchecked(-node.turns[place].into_inner());
                }
            }
        }
        if poses.iter().any(|pose| pose.translation != node.pose.translation) {
            node.slides = poses.iter().map(|pose| pose.translation.vector).collect();
        }
        node
    }

    /// A node that does not move.
    pub(crate) fn at(name: &str, parent: Option<usize>, pose: Pose) -> Self {
        let name = name.to_owned();
        Node { name, parent, pose, scale: [1.0; 3], turns: Vec::new(), slides: Vec::new(), parts: Vec::new() }
    }

    /// Its frame at a sample.
    fn pose_at(&self, sample: usize) -> Pose {
        let rotation = self.turns.get(sample).unwrap_or(&self.pose.rotation);
        let place = self.slides.get(sample).unwrap_or(&self.pose.translation.vector);
        Pose::from_parts((*place).into(), *rotation)
    }

    fn is_finite(&self) -> bool {
        let is_finite = |pose: &Pose| pose.to_homogeneous().iter().all(|x| x.is_finite());
        is_finite(&self.pose)
            && self.scale.iter().all(|x| x.is_finite())
            && self.turns.iter().all(|turn| turn.coords.iter().all(|x| x.is_finite()))
            && self.slides.iter().all(|slide| slide.iter().all(|x| x.is_finite()))
            && self.parts.iter().all(|part| is_finite(&part.pose) && part.body.is_finite() && part.material.is_finite())
    }
}

impl Body {
    /// Points whose convex hull is that of the body, approximately \[m\].
    pub(super) fn points(&self) -> Vec<Point3<f64>> {
        match self {
            Body::Solid(solid) => solid.points(),
            Body::Surface(surface) => surface.points.clone(),
        }
    }

    fn is_finite(&self) -> bool {
        self.points().iter().all(|point| point.iter().all(|x| x.is_finite()))
    }
}

impl Material {
    fn is_finite(&self) -> bool {
        let colours = [self.diffuse, self.emissive, self.specular];
        colours.iter().flatten().chain([&self.ambient, &self.opacity]).all(|x| x.is_finite())
    }
}

impl Scene {
    /// Checks that the nodes are an ordered tree, that each moves at every sample or at none, that times ascend, and
    /// that all numbers are finite.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`].
    pub fn check(&self) -> Result<()> {
        let bad = |text: String| Err(Error::new(ErrorKind::BadValue, text));
        if self.times.iter().any(|time| !(0.0..f64::INFINITY).contains(time)) {
            return bad("a time is not finite or below zero; begin at zero".to_owned());
        }
        if let Some(at) = self.times.windows(2).position(|pair| pair[0] >= pair[1]) {
            return bad(format!("sample {}: its time is not after the previous one; times must ascend", at + 2));
        }
        let mut open = Vec::new();
        for (place, node) in self.nodes.iter().enumerate() {
            let named = |text: &str| bad(format!("node `{}`: {text}", shown(&node.name)));
            while open.last().copied() != node.parent {
                if open.pop().is_none() {
                    return named("it does not follow its parent; give nodes in depth-first order");
                }
            }
            open.push(place);
            let is_whole = |count: usize| count == 0 || count == self.times.len();
            if !is_whole(node.turns.len()) || !is_whole(node.slides.len()) {
                return named(&format!("it moves at another number of samples than {}", self.times.len()));
            }
            if !node.is_finite() {
                return named("a number is not finite");
            }
        }
        Ok(())
    }

    /// The frames of all nodes at a sample.
    pub(super) fn frames(&self, sample: usize) -> Vec<Matrix4<f64>> {
        let mut frames: Vec<Matrix4<f64>> = Vec::with_capacity(self.nodes.len());
        for node in &self.nodes {
            let own = node.pose_at(sample).to_homogeneous() * Matrix4::new_nonuniform_scaling(&node.scale.into());
            frames.push(node.parent.map_or(own, |parent| frames[parent] * own));
        }
        frames
    }

    /// The least and the greatest coordinates of all visible parts, over the whole motion; `None` where nothing is
    /// visible.
    pub(super) fn bounds(&self) -> Option<[Vector3<f64>; 2]> {
        let corners = |part: &Part| part.body.points().iter().map(|point| part.pose * point).collect::<Vec<_>>();
        let seen: Vec<Vec<Point3<f64>>> =
            self.nodes.iter().map(|node| node.parts.iter().flat_map(corners).collect()).collect();
        let count = self.times.len().max(1);
        let mut bounds: Option<[Vector3<f64>; 2]> = None;
        for sample in (0..count).step_by(count.div_ceil(LOOKS)).chain([count - 1]) {
            for (frame, points) in self.frames(sample).iter().zip(&seen) {
                for at in points.iter().map(|point| frame.transform_point(point).coords) {
                    let [low, high] = bounds.unwrap_or([at, at]);
                    bounds = Some([low.inf(&at), high.sup(&at)]);
                }
            }
        }
        bounds
    }
}

/// The number of samples at which the extent of a motion is measured.
const LOOKS: usize = 50;
