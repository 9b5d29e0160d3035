//! The limits of included XML files. Main type: [`IncludeBudget`].

use std::path::Path;
use std::sync::Arc;

use crate::document::{read_xml, shown};
use crate::model::urdf::xml::Element;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::limits;

/// The number and the size of the files that a description has included.
#[derive(Default)]
pub struct IncludeBudget {
    count: usize,
    bytes: u64,
}

impl IncludeBudget {
    /// The root element of the `file` that the element `include` names; its elements know the file.
    ///
    /// # Errors
    /// [`ErrorKind::BadValue`] at `include` beyond the limits; [`ErrorKind::Io`] at `include` for a file that cannot be read; others of
    /// [`read_xml`], and those of [`Element::parse_whole`], with the included file.
    pub fn read(&mut self, include: &Element, file: &Path) -> Result<Element> {
        self.count += 1;
        if self.count > limits::XML_INCLUDES {
            let text = format!("is one include too many; at most {} are read", limits::XML_INCLUDES);
            return Err(include.error(ErrorKind::BadValue, &text));
        }
        let at_include = |error: Error| match error.kind() {
            ErrorKind::Io => include
                .error(ErrorKind::Io, &format!("names `{}`: {}", shown(&file.to_string_lossy()), error.message())),
            _ => error,
        };
        let text = read_xml(file, limits::XML_BYTES).map_err(at_include)?.text;
        self.bytes += text.len() as u64;
        if self.bytes > limits::XML_INCLUDED_BYTES {
            let text = format!("exceeds the limit of {} bytes of included files", limits::XML_INCLUDED_BYTES);
            return Err(include.error(ErrorKind::BadValue, &text));
        }
        let mut root = Element::parse_whole(&text).map_err(|error| error.in_file(file))?;
        root.mark(&Arc::from(file));
        Ok(root)
    }
}
