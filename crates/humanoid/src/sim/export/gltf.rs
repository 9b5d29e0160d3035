//! Scenes as binary glTF 2.0 (ISO/IEC 12113): one file with its JSON and one buffer of 32-bit floats.

use nalgebra::UnitQuaternion;
use serde_json::{Map, Value, json};

use super::skin::Skin;
use super::{Material, Node, Part, Scene};
use crate::{Error, ErrorKind, Result};

/// Targets of buffer views and component types of numbers, as OpenGL constants.
const VERTICES: u32 = 34962;
const INDICES: u32 = 34963;
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;

/// The two chunks of a file.
const JSON: &[u8; 4] = b"JSON";
const BINARY: &[u8; 4] = b"BIN\0";

impl Scene {
    /// The scene as a glTF file: `.glb`. Between two samples rotations are interpolated along the shorter arc, and
    /// positions linearly.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] as [`Scene::check`], and for data that 32-bit floats cannot represent: too large
    /// numbers, times too near to each other, more than four gigabytes.
    pub fn to_glb(&self) -> Result<Vec<u8>> {
        self.check()?;
        let mut file = File::default();
        let nodes = self.nodes.iter().map(|node| file.node(node)).collect::<Result<Vec<_>>>()?;
        let mut nodes: Vec<Map<String, Value>> = nodes;
        for (place, parent) in self.nodes.iter().enumerate().filter_map(|(place, node)| Some((place, node.parent?))) {
            let children = nodes[parent].entry("children").or_insert_with(|| json!([]));
            children.as_array_mut().into_iter().for_each(|all| all.push(json!(place)));
        }
        let roots: Vec<usize> = (0..nodes.len()).filter(|place| self.nodes[*place].parent.is_none()).collect();
        let animations = file.animation(self)?;
        let asset = json!({ "version": "2.0", "generator": concat!("groebot ", env!("CARGO_PKG_VERSION")) });
        let mut object = json!({
            "scene": 0,
            "scenes": [{ "name": self.title, "nodes": roots }],
            "nodes": nodes,
            "meshes": file.meshes,
            "materials": file.materials,
            "animations": animations,
            "accessors": file.accessors,
            "bufferViews": file.views,
            "buffers": if file.bytes.is_empty() { json!([]) } else { json!([{ "byteLength": file.bytes.len() }]) },
        });
        drop_empty(&mut object);
        // The generator is at the start of the file, where it is checked before the file is replaced.
        let rest = object.to_string();
        glb(format!("{{\"asset\":{asset},{}", &rest[1..]).into_bytes(), file.bytes)
    }
}

/// Removes empty lists, which glTF does not permit.
fn drop_empty(object: &mut Value) {
    let is_empty = |value: &Value| value.as_array().is_some_and(Vec::is_empty);
    if let Some(fields) = object.as_object_mut() {
        fields.retain(|_, value| !is_empty(value));
        fields.values_mut().for_each(drop_empty);
    }
    object.as_array_mut().into_iter().flatten().for_each(drop_empty);
}

/// The container: a header, then each chunk after its length and name, padded to four bytes.
fn glb(json: Vec<u8>, binary: Vec<u8>) -> Result<Vec<u8>> {
    let mut bytes = b"glTF\x02\0\0\0\0\0\0\0".to_vec();
    for (mut chunk, name, fill) in [(json, JSON, b' '), (binary, BINARY, 0)] {
        chunk.resize(chunk.len().next_multiple_of(4), fill);
        if !chunk.is_empty() {
            bytes.extend((chunk.len() as u32).to_le_bytes());
            bytes.extend(name);
            bytes.extend(chunk);
        }
    }
    let length = u32::try_from(bytes.len());
    let length = length.map_err(|_| bad("the file would have more than four gigabytes; give fewer samples"))?;
    bytes[8..12].copy_from_slice(&length.to_le_bytes());
    Ok(bytes)
}

fn bad(text: &str) -> Error {
    Error::new(ErrorKind::BadValue, text)
}

/// The parts of a file other than its nodes.
#[derive(Default)]
struct File {
    bytes: Vec<u8>,
    views: Vec<Value>,
    accessors: Vec<Value>,
    meshes: Vec<Value>,
    materials: Vec<Value>,
    /// The materials without duplicates.
    known: Vec<Material>,
}

impl File {
    fn node(&mut self, node: &Node) -> Result<Map<String, Value>> {
        let mut object = Map::new();
        object.insert("name".to_owned(), json!(node.name));
        let (turn, place) = (quaternion(&node.pose.rotation), node.pose.translation.vector);
        let mut tell = |field: &str, value: &[f64], usual: &[f64]| {
            if value != usual {
                object.insert(field.to_owned(), json!(value));
            }
        };
        tell("rotation", &turn, &[0.0, 0.0, 0.0, 1.0]);
        tell("translation", place.as_slice(), &[0.0; 3]);
        tell("scale", &node.scale, &[1.0; 3]);
        let primitives = node.parts.iter().map(|part| self.primitive(part)).collect::<Result<Vec<_>>>()?;
        let primitives: Vec<Value> = primitives.into_iter().flatten().collect();
        if !primitives.is_empty() {
            object.insert("mesh".to_owned(), json!(self.meshes.len()));
            self.meshes.push(json!({ "name": node.name, "primitives": primitives }));
        }
        Ok(object)
    }

    /// The triangles of a part in its node's frame; `None` where there are none.
    fn primitive(&mut self, part: &Part) -> Result<Option<Value>> {
        let skin = Skin::of(&part.body);
        if skin.triangles.is_empty() {
            return Ok(None);
        }
        let points: Vec<[f64; 3]> = skin.points.iter().map(|point| (part.pose * point).coords.into()).collect();
        let mut attributes = json!({ "POSITION": self.floats(&points, "VEC3", Some(VERTICES), true)? });
        if !skin.normals.is_empty() {
            let normals: Vec<[f64; 3]> = skin.normals.iter().map(|normal| (part.pose * normal).into()).collect();
            attributes["NORMAL"] = json!(self.floats(&normals, "VEC3", Some(VERTICES), false)?);
        }
        let bytes: Vec<u8> = skin.triangles.iter().flatten().flat_map(|corner| corner.to_le_bytes()).collect();
        let object = json!({ "componentType": UNSIGNED_INT, "count": 3 * skin.triangles.len(), "type": "SCALAR" });
        let indices = self.accessor(&bytes, object, Some(INDICES));
        let material = self.material(&part.material);
        Ok(Some(json!({ "attributes": attributes, "indices": indices, "material": material })))
    }

    fn material(&mut self, own: &Material) -> usize {
        if let Some(place) = self.known.iter().position(|known| known == own) {
            return place;
        }
        let [red, green, blue] = own.diffuse.map(linear);
        let mut object = json!({
            "pbrMetallicRoughness": {
                "baseColorFactor": [red, green, blue, own.opacity.clamp(0.0, 1.0)], "metallicFactor": 0, "roughnessFactor": 0.7,
            },
            "doubleSided": true,
        });
        if own.emissive != [0.0; 3] {
            object["emissiveFactor"] = json!(own.emissive.map(linear));
        }
        if own.opacity < 1.0 {
            object["alphaMode"] = json!("BLEND");
        }
        self.known.push(*own);
        self.materials.push(object);
        self.materials.len() - 1
    }

    /// The motion of all nodes; empty where nothing moves.
    fn animation(&mut self, scene: &Scene) -> Result<Vec<Value>> {
        let (mut channels, mut samplers) = (Vec::new(), Vec::new());
        let mut times = None;
        for (node, own) in scene.nodes.iter().enumerate() {
            let turns: Vec<[f64; 4]> = own.turns.iter().map(quaternion).collect();
            let slides: Vec<[f64; 3]> = own.slides.iter().copied().map(<[f64; 3]>::from).collect();
            if turns.is_empty() && slides.is_empty() {
                continue;
            }
            let input = match times {
                Some(input) => input,
                None => self.times(&scene.times)?,
            };
            times = Some(input);
            let mut moves = |path: &str, output: usize| {
                channels.push(json!({ "sampler": samplers.len(), "target": { "node": node, "path": path } }));
                samplers.push(json!({ "input": input, "output": output, "interpolation": "LINEAR" }));
            };
            if !turns.is_empty() {
                moves("rotation", self.floats(&turns, "VEC4", None, false)?);
            }
            if !slides.is_empty() {
                moves("translation", self.floats(&slides, "VEC3", None, false)?);
            }
        }
        let animation = json!({ "name": "motion", "channels": channels, "samplers": samplers });
        Ok(if times.is_some() { vec![animation] } else { Vec::new() })
    }

    fn times(&mut self, times: &[f64]) -> Result<usize> {
        if let Some(at) = times.windows(2).position(|pair| pair[0] as f32 >= pair[1] as f32) {
            let text = format!("sample {}: its time is the same as the one before in single precision", at + 2);
            return Err(bad(&format!("{text}, which glTF uses; give fewer samples, or use X3D")));
        }
        self.floats(&times.iter().map(|time| [*time]).collect::<Vec<_>>(), "SCALAR", None, true)
    }

    /// Appends rows of 32-bit floats to the buffer, with their least and greatest values if `bounds`; returns the
    /// number of their accessor.
    fn floats<const N: usize>(
        &mut self,
        rows: &[[f64; N]],
        kind: &str,
        target: Option<u32>,
        bounds: bool,
    ) -> Result<usize> {
        let singles: Vec<[f32; N]> = rows.iter().map(|row| row.map(|x| x as f32)).collect();
        if !singles.iter().flatten().all(|x| x.is_finite()) {
            return Err(bad("a number is too large for single precision, which glTF uses"));
        }
        let mut object = json!({ "componentType": FLOAT, "count": rows.len(), "type": kind });
        if bounds {
            let extreme = |pick: fn(f32, f32) -> f32| {
                let each = |place: usize| singles.iter().map(|row| row[place]).reduce(pick).unwrap_or(0.0);
                (0..N).map(|place| f64::from(each(place))).collect::<Vec<_>>()
            };
            object["min"] = json!(extreme(f32::min));
            object["max"] = json!(extreme(f32::max));
        }
        let bytes: Vec<u8> = singles.iter().flatten().flat_map(|x| x.to_le_bytes()).collect();
        Ok(self.accessor(&bytes, object, target))
    }

    /// Appends bytes, a multiple of four, to the buffer.
    fn accessor(&mut self, bytes: &[u8], mut object: Value, target: Option<u32>) -> usize {
        let mut view = json!({ "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len() });
        if let Some(target) = target {
            view["target"] = json!(target);
        }
        object["bufferView"] = json!(self.views.len());
        self.bytes.extend(bytes);
        self.views.push(view);
        self.accessors.push(object);
        self.accessors.len() - 1
    }
}

/// x, y, z and w, without negative zeros.
fn quaternion(rotation: &UnitQuaternion<f64>) -> [f64; 4] {
    rotation.coords.map(|x| x + 0.0).into()
}

/// Converts an sRGB component to linear light (IEC 61966-2-1).
fn linear(share: f64) -> f64 {
    let share = share.clamp(0.0, 1.0);
    if share <= 0.040_45 { share / 12.92 } else { ((share + 0.055) / 1.055).powf(2.4) }
}
