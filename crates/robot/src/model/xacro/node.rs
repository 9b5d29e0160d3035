//! The elements of a description in xacro, in order with their texts. Main type: [`Element`].

use std::rc::Rc;

use quick_xml::escape::{escape, resolve_predefined_entity};
use quick_xml::events::{BytesStart, Event};
use quick_xml::{Decoder, Reader};

use crate::document::shown;
use crate::{Error, ErrorKind, Result};
use groebot_algebra::limits;

/// The location of an element: the index of its file, and its line from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Location {
    pub file: usize,
    pub line: usize,
}

/// An element or a text.
#[derive(Clone, Debug)]
pub enum Node {
    Element(Rc<Element>),
    Text(String),
}

/// An element with its attributes and children. Comments and processing instructions are left out.
#[derive(Clone, Debug)]
pub struct Element {
    pub name: String,
    pub attributes: Vec<(String, String)>,
    pub children: Vec<Node>,
    pub location: Location,
}

impl Element {
    /// Parses the text of the file with the index `file`.
    ///
    /// # Errors
    /// [`ErrorKind::Syntax`] with the line for text that is not one well-formed element, or is nested too deeply.
    pub fn parse(text: &str, file: usize) -> Result<Element> {
        let newlines: Vec<usize> = text.match_indices('\n').map(|(at, _)| at).collect();
        let line_of = |offset: u64| 1 + newlines.partition_point(|&newline| (newline as u64) < offset);
        let mut reader = Reader::from_str(text.trim_start_matches('\u{feff}'));
        let mut builder = Builder { file, decoder: reader.decoder(), open: Vec::new(), root: None };
        loop {
            let start = reader.buffer_position();
            let event = reader.read_event();
            let event = event.map_err(|error| syntax(&error.to_string()).at_line(line_of(reader.error_position())))?;
            let line = line_of(start);
            if matches!(event, Event::Eof) {
                return builder.finish().map_err(|error| error.at_line(line));
            }
            builder.take(&event, line).map_err(|error| error.at_line(line))?;
        }
    }

    /// The text of the attribute `name`.
    pub fn attribute(&self, name: &str) -> Option<&str> {
        self.attributes.iter().find(|(key, _)| key == name).map(|(_, value)| value.as_str())
    }

    /// The child elements.
    pub fn elements(&self) -> impl Iterator<Item = &Rc<Element>> {
        self.children.iter().filter_map(|child| if let Node::Element(element) = child { Some(element) } else { None })
    }

    /// Writes the element as XML, one element per line, and adds the location of each line.
    pub fn write(&self, depth: usize, out: &mut String, locations: &mut Vec<Location>) {
        out.extend(std::iter::repeat_n("  ", depth));
        *out += "<";
        *out += &self.name;
        for (name, value) in &self.attributes {
            *out += &format!(" {name}=\"{}\"", escape(value).replace('\n', "&#10;"));
        }
        let texts =
            || self.children.iter().filter_map(|node| if let Node::Text(text) = node { Some(text) } else { None });
        let text: String =
            texts().map(|text| text.trim()).filter(|text| !text.is_empty()).collect::<Vec<_>>().join(" ");
        if text.is_empty() && self.elements().next().is_none() {
            *out += "/>\n";
            locations.push(self.location);
            return;
        }
        *out += ">";
        *out += &escape(text.as_str());
        let lines = 1 + text.matches('\n').count();
        locations.extend(std::iter::repeat_n(self.location, lines));
        if self.elements().next().is_some() {
            *out += "\n";
            for child in self.elements() {
                child.write(depth + 1, out, locations);
            }
            out.extend(std::iter::repeat_n("  ", depth));
            locations.push(self.location);
        }
        *out += &format!("</{}>\n", self.name);
    }
}

fn syntax(message: &str) -> Error {
    let message: String = message.chars().take(160).map(|c| if c.is_control() { ' ' } else { c }).collect();
    Error::new(ErrorKind::Syntax, format!("this is not XML: {message}"))
}

/// Builds elements while they open and close.
struct Builder {
    file: usize,
    decoder: Decoder,
    open: Vec<Element>,
    root: Option<Element>,
}

impl Builder {
    fn take(&mut self, event: &Event<'_>, line: usize) -> Result<()> {
        match event {
            Event::Start(start) => self.start(start, line)?,
            Event::Empty(start) => {
                self.start(start, line)?;
                self.end();
            }
            Event::End(_) => self.end(),
            Event::Text(text) => {
                let text = text.decode().map_err(|error| syntax(&error.to_string()))?;
                self.text(&text)?;
            }
            Event::CData(text) => {
                let text = text.decode().map_err(|error| syntax(&error.to_string()))?;
                self.text(&text)?;
            }
            Event::GeneralRef(reference) => {
                let character = reference.resolve_char_ref().map_err(|error| syntax(&error.to_string()))?;
                let name = reference.decode().map_err(|error| syntax(&error.to_string()))?;
                let text = character.map(String::from).or(resolve_predefined_entity(&name).map(str::to_owned));
                let unknown = || syntax(&format!("the entity `{}` is not defined", shown(&name)));
                self.text(&text.ok_or_else(unknown)?)?;
            }
            _ => {}
        }
        Ok(())
    }

    fn text(&mut self, text: &str) -> Result<()> {
        let Some(open) = self.open.last_mut() else {
            let is_blank = text.trim().is_empty();
            return if is_blank { Ok(()) } else { Err(syntax("there is text outside the root element")) };
        };
        if let Some(Node::Text(last)) = open.children.last_mut() {
            last.push_str(text);
        } else {
            open.children.push(Node::Text(text.to_owned()));
        }
        Ok(())
    }

    fn start(&mut self, start: &BytesStart<'_>, line: usize) -> Result<()> {
        if self.open.is_empty() && self.root.is_some() {
            return Err(syntax("a second root element"));
        }
        if self.open.len() >= limits::XML_DEPTH {
            return Err(syntax(&format!("elements are nested deeper than {}", limits::XML_DEPTH)));
        }
        let mut attributes = Vec::new();
        for attribute in start.attributes() {
            if attributes.len() >= limits::XML_ATTRIBUTES {
                return Err(syntax(&format!("an element has more than {} attributes", limits::XML_ATTRIBUTES)));
            }
            let attribute = attribute.map_err(|error| syntax(&error.to_string()))?;
            let value =
                attribute.decode_and_unescape_value(self.decoder).map_err(|error| syntax(&error.to_string()))?;
            // A parser of XML reads blanks in attributes as spaces.
            let value = value.replace("\r\n", " ").replace(['\n', '\r', '\t'], " ");
            attributes.push((String::from_utf8_lossy(attribute.key.as_ref()).into_owned(), value));
        }
        let name = String::from_utf8_lossy(start.name().as_ref()).into_owned();
        let location = Location { file: self.file, line };
        self.open.push(Element { name, attributes, children: Vec::new(), location });
        Ok(())
    }

    fn end(&mut self) {
        let Some(element) = self.open.pop() else { return };
        match self.open.last_mut() {
            Some(parent) => parent.children.push(Node::Element(Rc::new(element))),
            None => self.root = Some(element),
        }
    }

    fn finish(self) -> Result<Element> {
        match (self.open.last(), self.root) {
            (Some(open), _) => {
                Err(syntax(&format!("<{}> of line {} is not closed", shown(&open.name), open.location.line)))
            }
            (None, None) => Err(syntax("there is no element; give a <robot>")),
            (None, Some(root)) => Ok(root),
        }
    }
}
