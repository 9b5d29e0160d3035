//! Names of a program as identifiers of a language: kept where they can be, else changed as little as possible.

use std::collections::HashSet;

use super::language::Language;
use crate::document::word;
use crate::solver::Program;

/// Names that the skeletons and the printed functions use themselves, beside `r0`, `i0`, `roots0` and `choice0`.
const TAKEN: &str = "p q target answers extra magnitude result angle real_roots leads is_near is_away finish \
    INPUTS JOINTS CAPACITY EQUATIONS EXTRAS DEGREE ACCEPT MERGE BLUR RESOLUTION NEAR TINY PIVOT POLISH_STEPS TANGENT GRAZING ROUNDING \
    NEGLIGIBLE MAX_STEPS TAU PI NONE_FREE INPUT_NAMES JOINT_NAMES \
    Parameters Solution Answers Error Fit Equations Jacobian Roots Polynomial Math close blurred differences shorter is_close keep relative doubles has_branch known shared next Known Shared branch free NOTHING_KNOWN ADRIFT FREED is_listed tries ALIKE MEETING ASIDE NARROWS narrow SINGULAR REGULAR regularity regular least most DOUBLINGS leads_aside beyond ahead close_by displaced end ARRIVED STAGES POLISHED CONSISTENT \
    tip reached TIP forward LIMITS limits SLACK TURNS turns turns_within solve_within count_turns turn within nearest at MOST_TURNS nearest_turn finite_turns turned_within strides_within STRIDE STRIDES holds stride frames target_of base tool pose sum \
    held stages greatest conform make_rotation make_unit dot lies_on_self_motion leads_to follow is_one holds_against \
    is_exact worst improve own add is_isolated has_free has_member bound answer make_unit a_isolated b_isolated isolated Rated improved move moved DAMPINGS dampings SPLIT last turn_in substituted triangle squares weights APART way \
    LEVER FARTHER FARTHEST IS_ANGLE ALONE LEAPS RETURNS STIFF spans farthest farthest_of longest longest_way stepped leap leaps copy around keep_member unite doubled leads_back are_joined fault before middle share \
    PLACES SIZES SIZE_OF REST place series square_roots is_round measure_at is_within is_apart keep_one refine PATIENCE INLINE COLD slow place_of low high far steep value ROWS reflect columns mirror half along entry all_real_roots OVERSHOT returned start \
    pair values sizes fits angles acute acutes unfold flush waiting usual found Found NOT_FOUND Fits sound Lanes LANES ROOM POOL ANGLES CIRCLES FAR_APART Number Add Sub Mul Div lane lanes by_lane are_apart tell_apart tells_apart order is_apart Pairs solve_pairs flush_pairs joints usual list of number find unfold joint_angle take_pair which up across is_new size where_below greater take \
    ordinary_roots approximate_roots resolved settled ordinary lead largest size_of_all inverse monic quartic \
    CANDIDATES TWINS ANGLE_OF FIRST TELLING WIDTH T With Truth Doubt Mask Bundle Neg BitAnd BitOr MANY SURE TURNED REST_OF_PI nothing_known walk fit everywhere solve_batch solve_pairs_batch solve_widest Answer NONE IS_BY_ANGLES of wants_angles solve_by solve_by_4 solve_by_8 solve_into is_usual is_rare is_due candidates unsound suffice_since BESIDE DISTINCT SHORT number is_so twin TWIN TWINS_AT times INVERSIONS APPROACHES PLAIN STEEP approached short short_way Short SHORTS TURN step_back turn_back in_turn larger lesser here Approach arrive approach missed_by Ways ways short_abreast normal_step_abreast step_back_abreast turn_back_abreast steps is_done later MILD normal_step square factor jacobi close_by plain stillest norm round side each exceeds at_most dead doubt bundle room done filled counts targets fine sound size limit";

/// Letters that a number follows in the printed functions.
const NUMBERED: [&str; 7] = ["r", "i", "q", "roots", "choice", "SAMPLES_", "Shared"];

/// The identifiers of one program in one language.
pub(super) struct Names {
    /// By parameter.
    pub parameters: Vec<String>,
    /// By unknown; apart from those of the parameters.
    pub unknowns: Vec<String>,
}

impl Names {
    pub fn new(program: &Program, language: &dyn Language) -> Self {
        let mut used = HashSet::new();
        let mut name = |text: &str| unique(text, language, &mut used);
        Names {
            parameters: program.parameters.iter().map(|parameter| name(&parameter.name)).collect(),
            unknowns: program.unknowns.iter().map(|unknown| name(unknown)).collect(),
        }
    }
}

fn unique(text: &str, language: &dyn Language, used: &mut HashSet<String>) -> String {
    let mut name = word(text);
    while is_taken(&name, language) || used.contains(&name) {
        name.push('_');
        if is_taken(&name, language) {
            name.insert(0, 'x');
        }
    }
    used.insert(name.clone());
    name
}

/// Whether a text is a word that every language takes as part of a name: a letter, then letters, digits and `_`.
pub fn is_word(text: &str) -> bool {
    word(text) == text
}

fn is_taken(name: &str, language: &dyn Language) -> bool {
    let is_number = |rest: &str| {
        let (first, last) = (rest.bytes().next(), rest.bytes().last());
        first.zip(last).is_some_and(|(first, last)| first.is_ascii_digit() && last.is_ascii_digit())
    };
    TAKEN.split_whitespace().any(|word| word == name)
        || NUMBERED.iter().any(|letters| name.strip_prefix(letters).is_some_and(is_number))
        || language.is_reserved(name)
}

/// The text fit for a comment of any language: printable ASCII on one line that neither opens nor ends anything.
pub(super) fn remark(text: &str) -> String {
    let printable = |c: char| if c == ' ' || c.is_ascii_graphic() { c } else { '?' };
    let line: String = text.chars().map(printable).collect();
    line.replace('\\', "|").replace("*/", "* /").replace("/*", "/ *").replace("??", "? ?")
}
