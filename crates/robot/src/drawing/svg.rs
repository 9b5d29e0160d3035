//! A writer of SVG text. Main type: [`Svg`].

use std::fmt::Write;

/// Symbol before an entry of a legend.
#[derive(Clone, Copy)]
pub enum Swatch {
    /// A line segment.
    Line,
    /// A small rectangle.
    Area,
    /// No symbol.
    None,
}

/// Upper bound of the width of a letter of normal text \[px\].
const LETTER: f64 = 6.7;
/// Width of a swatch with the space on both sides \[px\].
const SWATCH: f64 = 50.0;

/// The elements of a picture, without its header.
#[derive(Default)]
pub struct Svg(String);

impl Svg {
    /// Adds an element.
    pub fn add(&mut self, element: std::fmt::Arguments<'_>) {
        // Writing to a string cannot fail.
        let _ = self.0.write_fmt(element);
        self.0.push('\n');
    }

    /// Adds a line through `points` \[px\].
    pub fn line(&mut self, class: &str, points: impl IntoIterator<Item = (f64, f64)>) {
        self.add(format_args!(r#"<polyline class="{class}" points="{}"/>"#, listed(points)));
    }

    /// Adds a polygon with an opacity up to 1.
    pub fn polygon(&mut self, class: &str, opacity: f64, points: impl IntoIterator<Item = (f64, f64)>) {
        let points = listed(points);
        self.add(format_args!(r#"<polygon class="{class}" opacity="{opacity:.2}" points="{points}"/>"#));
    }

    /// Adds a rectangle from its upper left corner.
    pub fn rectangle(&mut self, class: &str, (x, y): (f64, f64), (width, height): (f64, f64)) {
        self.add(format_args!(
            r#"<rect class="{class}" x="{x:.1}" y="{y:.1}" width="{width:.1}" height="{height:.1}"/>"#
        ));
    }

    /// Adds text at the left end of its baseline. The classes `middle` and `end` centre it at this point or end it
    /// there.
    pub fn text(&mut self, class: &str, (x, y): (f64, f64), text: &str) {
        let text = text.replace('&', "&amp;").replace('<', "&lt;");
        self.add(format_args!(r#"<text class="{class}" x="{x:.1}" y="{y:.1}">{text}</text>"#));
    }

    /// Adds a legend on one line: swatches of a class, each with its text.
    pub fn legend(&mut self, (mut x, y): (f64, f64), entries: &[(Swatch, &str, &str)]) {
        for (swatch, class, words) in entries {
            match swatch {
                Swatch::Line => self.line(class, [(x, y - 4.0), (x + 24.0, y - 4.0)]),
                Swatch::Area => self.rectangle(class, (x, y - 10.0), (24.0, 12.0)),
                Swatch::None => x -= 30.0,
            }
            self.text("", (x + 30.0, y), words);
            x += SWATCH + LETTER * words.chars().count() as f64;
        }
    }

    /// The whole picture with this width and height \[px\].
    pub fn finish(self, width: f64, height: f64) -> String {
        let size = format!(r#"width="{width:.0}" height="{height:.0}" viewBox="0 0 {width:.0} {height:.0}""#);
        format!("<svg xmlns=\"http://www.w3.org/2000/svg\" {size}>\n{STYLE}\n{}</svg>\n", self.0)
    }
}

fn listed(points: impl IntoIterator<Item = (f64, f64)>) -> String {
    points.into_iter().map(|(x, y)| format!("{x:.1},{y:.1}")).collect::<Vec<_>>().join(" ")
}

/// Left is blue and right is orange, which most people with colour blindness can distinguish.
const STYLE: &str = "<style>
text { font: 12px sans-serif; fill: #333 }
polyline { fill: none; stroke-width: 1.5 }
.title { font-weight: bold }
.tick { font-size: 11px; fill: #555 } .middle { text-anchor: middle } .end { text-anchor: end }
.frame { fill: none; stroke: #888 } .grid { stroke: #ddd; stroke-width: 0.7 }
.left { fill: #3b82c4; fill-opacity: 0.22; stroke: #1f5f9e; stroke-width: 1.4 }
.right { fill: #e58a2e; fill-opacity: 0.22; stroke: #b05a00; stroke-width: 1.4 }
.number { font: bold 11px sans-serif; text-anchor: middle; stroke: white; stroke-width: 3; paint-order: stroke }
.left-number { fill: #174a7c } .right-number { fill: #8a4600 }
.leader { stroke: #555; stroke-width: 0.8 }
.com { stroke: #222 } .zmp { stroke: #b0126f }
.left-path { stroke: #1f5f9e } .right-path { stroke: #b05a00 }
.left-stands { fill: #3b82c4; fill-opacity: 0.18 } .right-stands { fill: #e58a2e; fill-opacity: 0.2 }
.both-stand { fill: white; stroke: #888 }
.margin { stroke: #b0126f } .zero { stroke: #333; stroke-width: 1.2 }
.limit { stroke: #c2352b; stroke-dasharray: 4 3; stroke-width: 1 }
.least { fill: #b0126f } text.least { font-weight: bold; stroke: white; stroke-width: 3; paint-order: stroke }
.joint { stroke: #1b4f8a }
</style>
<rect width=\"100%\" height=\"100%\" fill=\"white\"/>";
