//! Pictures in SVG: shapes ([`svg`]) and frames with numbers on their axes ([`frame`]).

pub(crate) mod frame;
pub(crate) mod svg;
