//! SVG pictures: shapes ([`svg`]) and frames with numbers on their axes ([`frame`]).

pub mod frame;
pub mod svg;
