//! What differs between the languages inside functions ([`Language`]), and what cases hand over in them.

/// What differs between the languages inside functions.
pub(super) trait Language {
    /// Whether the language or its library keeps this word for itself.
    fn is_reserved(&self, word: &str) -> bool;
    /// A field of the parameters `p`.
    fn field(&self, name: &str) -> String;
    /// A field of what earlier blocks found.
    fn known(&self, name: &str) -> String;
    /// A field of what the cases of a block share.
    fn shared(&self, name: &str) -> String;
    /// An argument of a function: a pointer to something of this type.
    fn argument(&self, name: &str, kind: &str) -> String;
    /// An argument that is a count.
    fn count(&self, name: &str) -> String;
    /// `function` (`abs`, `sqrt`, `cos` or `sin`) of an expression; the argument of all but `abs` is typed.
    fn call(&self, function: &str, argument: &str) -> String;
    /// The greater of two typed expressions.
    fn greater(&self, a: &str, b: &str) -> String;
    /// The square root of a typed expression, zero of a number below zero.
    fn root(&self, square: &str) -> String {
        self.call("sqrt", &self.greater(square, "0.0"))
    }
    /// Whether the walk through the blocks is printed for several targets at once, too.
    fn walks_abreast(&self) -> bool {
        false
    }
    /// A constant that stands alone in a case or among the parameters.
    fn alone(&self, constant: String) -> String {
        constant
    }
    /// A new immutable number.
    fn declare(&self, name: &str, value: &str) -> String;
    /// New numbers, of which each is what stands in its place of `at`; those without a name are not read.
    fn declare_places(&self, names: &[Option<&str>]) -> Vec<String> {
        let declared =
            |(place, name): (usize, &Option<&str>)| name.map(|name| self.declare(name, &format!("at[{place}]")));
        names.iter().enumerate().filter_map(declared).collect()
    }
    /// The greatest or least of all numbers, an infinity.
    fn infinity(&self, positive: bool) -> String;
    /// A piece of text in quotation marks.
    fn quote(&self, text: &str) -> String;
    /// Lines that name the roots `roots{depth}` of `x^2 + constant`; `typical` is the unknown's typical size.
    fn find_square_roots(&self, depth: usize, constant: &str, typical: &str) -> Vec<String>;
    /// Lines that name the roots `roots{depth}` of the first polynomial (each a list of coefficients) that leads; `typical` is
    /// the unknown's typical size.
    fn find_roots(&self, depth: usize, polynomials: &[Vec<String>], typical: &str) -> Vec<String>;
    /// Lines that open the loop over `roots{depth}`, or over its `first` alone, with index `i{depth}`, and over its values if they have a
    /// name.
    fn open_loop(&self, depth: usize, name: Option<&str>, first: bool) -> Vec<String>;
    /// The line that opens what is done where a condition holds.
    fn only_if(&self, condition: &str) -> String;
    /// Lines that open the loop with index `i{depth}` over the rows of the table of samples with a number, of which there are `rows`; each
    /// row's numbers are called by `names` where they have one.
    fn open_samples(&self, depth: usize, names: &[Option<&str>], table: usize, rows: usize) -> Vec<String>;
    /// Leaving a case, which hardly ever runs or often, unless a condition holds, and this one `beside` a stratum too where the cases before
    /// have sufficed.
    fn leave_unless(&self, condition: &str, is_rare: bool, beside: Option<&str>) -> Vec<String>;
    /// The skeleton of what finds six joints together.
    fn six_axes(&self) -> &'static str;
    /// Lines that open the loop with index `i{depth}` over the answers of the chain with a number at a target.
    fn open_six_axes(&self, depth: usize, chain: usize, target: &[String]) -> Vec<String>;
    /// The value of the joint with this index in that loop; typed.
    fn six_axes_joint(&self, depth: usize, joint: usize) -> String;
    /// Whether the candidate in that loop is one that was lost.
    fn six_axes_lost(&self, depth: usize) -> String;
    /// Whether that joint is free.
    fn six_axes_free(&self, depth: usize, joint: usize) -> String;
    /// Handing over an answer.
    fn finish(&self, answer: &Finish<'_>) -> Vec<String>;
    /// Going on to a block with what is known now.
    fn go_on(&self, state: &State<'_>) -> Vec<String>;
}

/// What a case of the last block hands over, as expressions.
pub(super) struct Finish<'a> {
    /// The branch number, and the end of those of the first block's case.
    pub branch: [String; 2],
    /// The unknowns that the equations can read.
    pub at: &'a [String],
    /// Whether roots on the way are close to one another.
    pub close: String,
    /// The joints; empty where the file takes them from `at` later.
    pub q: &'a [String],
    /// By joint whether it is free; empty when it is `usual`.
    pub free: &'a [String],
    /// The free joints of a case that adds none.
    pub usual: String,
    /// Values of the unknowns that are no joint's.
    pub extra: &'a [String],
}

/// What a case hands over to the next block, as expressions.
pub(super) struct State<'a> {
    /// Number of the block, from 1.
    pub next: usize,
    /// Whether an earlier block found something too.
    pub goes_on: bool,
    /// The branch number, and the end of those of the first block's case.
    pub branch: [String; 2],
    /// By joint whether it is free; empty when the case adds none.
    pub free: &'a [String],
    /// Names of the unknowns that were found, which are local variables.
    pub found: &'a [String],
    /// Whether roots on the way are close to one another.
    pub close: String,
    /// Whether each candidate behind stands for two, if the case has a say in that.
    pub pair: Option<String>,
    /// Whether the case hardly ever runs.
    pub is_rare: bool,
}
