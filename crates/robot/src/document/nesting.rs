//! The nesting depth of TOML. The parser's tables are freed by recursion, so deep ones would overflow the stack.

use toml_parser::decoder::Encoding;
use toml_parser::parser::{EventReceiver, parse_document};
use toml_parser::{ErrorSink, Source, Span};

use groebot_algebra::limits::TOML_DEPTH;

/// The byte at which a document is nested deeper than [`TOML_DEPTH`]: each part of a key with dots, each list and each
/// inline table is a level.
pub(super) fn too_deep(text: &str) -> Option<usize> {
    let mut nesting = Nesting::default();
    let tokens = Source::new(text).lex().into_vec();
    // Other faults are reported by the parser that reads the values.
    parse_document(&tokens, &mut nesting, &mut ());
    nesting.too_deep
}

/// The levels above the part that is read.
#[derive(Default)]
struct Nesting {
    /// The levels of the last header.
    header: usize,
    depth: usize,
    /// The levels above each open list and inline table.
    open: Vec<usize>,
    too_deep: Option<usize>,
}

impl Nesting {
    /// Starts the header of a table.
    fn start(&mut self, depth: usize) {
        self.open.clear();
        self.depth = depth;
    }

    /// Descends by a level; false if it is too deep.
    fn descend(&mut self, span: Span) -> bool {
        self.depth += 1;
        let is_allowed = self.depth <= TOML_DEPTH;
        if !is_allowed {
            self.too_deep.get_or_insert(span.start());
        }
        is_allowed
    }

    fn enter(&mut self, span: Span) -> bool {
        self.open.push(self.depth);
        self.descend(span)
    }

    fn leave(&mut self) {
        self.depth = self.open.pop().unwrap_or(self.header);
    }
}

impl EventReceiver for Nesting {
    fn std_table_open(&mut self, _: Span, _: &mut dyn ErrorSink) {
        self.start(0);
    }

    fn std_table_close(&mut self, _: Span, _: &mut dyn ErrorSink) {
        self.header = self.depth;
    }

    fn array_table_open(&mut self, _: Span, _: &mut dyn ErrorSink) {
        self.start(1);
    }

    fn array_table_close(&mut self, _: Span, _: &mut dyn ErrorSink) {
        self.header = self.depth;
    }

    fn inline_table_open(&mut self, span: Span, _: &mut dyn ErrorSink) -> bool {
        self.enter(span)
    }

    fn inline_table_close(&mut self, _: Span, _: &mut dyn ErrorSink) {
        self.leave();
    }

    fn array_open(&mut self, span: Span, _: &mut dyn ErrorSink) -> bool {
        self.enter(span)
    }

    fn array_close(&mut self, _: Span, _: &mut dyn ErrorSink) {
        self.leave();
    }

    fn simple_key(&mut self, span: Span, _: Option<Encoding>, _: &mut dyn ErrorSink) {
        self.descend(span);
    }

    fn value_sep(&mut self, _: Span, _: &mut dyn ErrorSink) {
        self.depth = self.open.last().map_or(self.header, |above| above + 1);
    }

    fn newline(&mut self, _: Span, _: &mut dyn ErrorSink) {
        if self.open.is_empty() {
            self.depth = self.header;
        }
    }
}
