//! Robots and motions as animated scenes: glTF 2.0 ([`Scene::to_glb`]), X3D 4.0 ([`Scene::to_x3d`]) and VRML97
//! ([`Scene::to_wrl`]).
//!
//! A [`Scene`] is a tree of nodes, one per link. It is made from a robot and a trajectory ([`Scene::of_robot`]), or
//! read from VRML ([`Scene::from_vrml`]). All formats have y up: a node above the robot rotates its z axis to y.

mod bones;
mod gltf;
mod markup;
mod names;
mod robot;
mod scene;
mod skin;
mod vrml;
mod x3d;

pub use scene::{Body, Material, Node, Part, Scene};
