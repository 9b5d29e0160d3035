//! Rooms by name.

/// Names and texts, TOML: the living room of RH0 5.4 and 5.5, Fig. 5-25, and the same room with its furniture around
/// the robot, Fig. 5-27.
pub const ROOMS: [(&str, &str); 2] = [
    ("living-room", include_str!("../../examples/living_room.toml")),
    ("encirclement", include_str!("../../examples/encirclement.toml")),
];

/// The text of a room by its name.
pub fn room(name: &str) -> Option<&'static str> {
    ROOMS.iter().find(|(own, _)| *own == name).map(|(_, text)| *text)
}
