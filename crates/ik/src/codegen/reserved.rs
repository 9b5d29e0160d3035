//! Names that printed code cannot have.

use groebot_algebra::limits::RUN_TIME_FILES;
use groebot_robot::document::word;

/// Words that C, C++, their libraries and the run time keep for themselves.
const RESERVED: &str = "auto break case char const continue default do double else enum extern float for goto if inline int \
    long register restrict return short signed sizeof static struct switch typedef union unsigned void volatile while \
    bool true false asm typeof \
    and and_eq bitand bitor catch char16_t char32_t char8_t class compl concept const_cast consteval constinit co_await co_return \
    co_yield decltype delete dynamic_cast explicit export friend mutable namespace new not not_eq operator or or_eq private \
    protected public reinterpret_cast requires static_cast template this throw try typeid typename using virtual xor xor_eq std UNITS IkReal \
    alignas alignof constexpr nullptr static_assert thread_local noreturn \
    size_t ptrdiff_t wchar_t NULL offsetof NAN INFINITY HUGE_VAL HUGE_VALF HUGE_VALL DECIMAL_DIG errno complex imaginary I \
    float_t double_t math_errhandling signgam linux unix i386 T R GROEBOT_H \
    sin cos sqrt fabs fmax fmin atan2 round copysign isfinite isnan free_joints assert";

/// How other such words begin.
const PREFIXES: [&str; 9] = ["FLT_", "DBL_", "LDBL_", "FP_", "MATH_", "M_", "__", "gb_", "GB_"];

/// Whether C or C++ keeps this word.
pub(super) fn is_reserved(word: &str) -> bool {
    RESERVED.split_whitespace().any(|reserved| reserved == word)
        || PREFIXES.iter().any(|prefix| word.starts_with(prefix))
}

/// Whether a file called so would stand in the place of one of the run time.
pub fn is_run_time(stem: &str) -> bool {
    RUN_TIME_FILES.iter().any(|own| stem.eq_ignore_ascii_case(own))
}

/// A program's or robot's name as what the names of its functions and, in capitals, of its constants begin with: a word that no language and not the run
/// time has, nor with which their names begin.
pub(super) fn prefix(name: &str) -> String {
    let name = word(name);
    let begun = format!("{name}_");
    let is_taken = [&name, &begun, &begun.to_ascii_uppercase()].into_iter().any(|word| is_reserved(word));
    if is_taken || is_run_time(&name) { format!("robot_{name}") } else { name }
}
