//! Base and tool given at run time: [`Placement`].

/// Where the base is in the world, and where the tool is on the tip. A pose is 12 numbers, as at the front of a target: a position, and a rotation by rows.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// The pose world_from_base.
    pub base: [f64; 12],
    /// The pose tip_from_tool.
    pub tool: [f64; 12],
}

impl Placement {
    /// The pose without translation and rotation.
    pub const IDENTITY: [f64; 12] = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    /// The base in the origin of the world, the tool in the origin of the tip.
    pub const NONE: Placement = Placement { base: Placement::IDENTITY, tool: Placement::IDENTITY };

    /// The target base_from_tip for a pose world_from_tool.
    pub fn target(&self, world_from_tool: &[f64; 12]) -> [f64; 12] {
        target_of(&self.base, &self.tool, world_from_tool)
    }
}

impl Default for Placement {
    fn default() -> Self {
        Placement::NONE
    }
}

/// The target base_from_tip, its first 12 numbers, with which the tool is at a pose world_from_tool: `base^-1 pose tool^-1`, where `base` is world_from_base and
/// `tool` is tip_from_tool.
pub fn target_of(base: &[f64; 12], tool: &[f64; 12], pose: &[f64; 12]) -> [f64; 12] {
    let mut target = [0.0; 12];
    for i in 0..3 {
        for j in 0..3 {
            for k in 0..9 {
                target[3 + 3 * i + j] += base[3 + 3 * (k / 3) + i] * pose[3 + k] * tool[3 + 3 * j + k % 3];
            }
        }
    }
    for i in 0..3 {
        for k in 0..3 {
            target[i] += base[3 + 3 * k + i] * (pose[k] - base[k]) - target[3 + 3 * i + k] * tool[k];
        }
    }
    target
}
