/* Selects the next type of number. */

#if !defined(GB_WIDTH)
#define GB_WIDTH 1
#elif GB_WIDTH == 1 && GB_LANES > 1
#undef GB_WIDTH
#define GB_WIDTH 2
#elif GB_WIDTH > 1 && GB_WIDTH < GB_LANES
#undef GB_WIDTH
#define GB_WIDTH GB_LANES
#else
#undef GB_WIDTH
#define GB_WIDTH 0
#endif

#ifndef GB_DEFAULTS
#define GB_DEFAULTS

/* The end of the names of the current solver's functions. It is empty for the first solver of a file. */
#ifdef GB_PART
#define GB_OF_PART GB_JOIN(_given_, GB_PART, )
#else
#define GB_OF_PART
#endif
/* The name of a type or function for the current type of number, and that type. */
#define GB_(name) GB_JOIN(gb_##name##_, GB_WIDTH, GB_OF_PART)
#define T GB_(number)
/* A block that a rare case leads to; it is a function of its own. */
#define GB_RARELY(block, parameters, ...) \
    static GB_COLD void GB_(rarely_##block) parameters { GB_(block)(__VA_ARGS__); }

/* Defaults of facts that a robot's file does not define. */
#ifndef GB_DEGREE
#define GB_DEGREE 2
#endif
#ifndef GB_ISOLATED
#define GB_ISOLATED SIZE_MAX
#endif
#ifndef GB_EXTRAS
#define GB_EXTRAS false
#endif
#ifndef GB_PREFERRED
#define GB_PREFERRED (-1)
#define GB_PREFERS_GREATEST false
#endif
#ifndef GB_TWINS
#define GB_TWINS 1
#endif

GB_ASSERT(joints_have_room_in_groebot_c, GB_JOINTS <= GB_MAX_JOINTS && GB_JOINTS <= 32);
GB_ASSERT(places_have_room_in_groebot_c, GB_PLACES <= GB_MAX_PLACES);
GB_ASSERT(equations_have_room_in_groebot_c, GB_EQUATIONS <= GB_MAX_EQUATIONS);
GB_ASSERT(sizes_have_room_in_groebot_c, GB_SIZES <= GB_MAX_SIZES);
GB_ASSERT(candidates_are_even, GB_CANDIDATES % 2 == 0);

static const gb_joint gb_joints[GB_JOINTS] = {GB_JOINT_LIST};
static const unsigned char gb_last_first[GB_JOINTS] = {GB_LAST_FIRST};
static const unsigned char gb_size_of[GB_EQUATIONS] = {GB_SIZE_OF};
#ifdef GB_TURNED
static const unsigned char gb_turned[] = {GB_TURNED};
#endif
#ifdef GB_COMPARED
static const unsigned char gb_compared[GB_EQUATIONS] = {GB_COMPARED};
#endif
#ifdef GB_CONDITIONS
static const gb_condition gb_conditions[] = {GB_CONDITIONS};
#endif
#ifdef GB_RUNS
GB_UNUSED static const unsigned char gb_runs[GB_JOINTS] = {GB_RUNS};
#endif

#define GB_PUBLIC(name) GB_JOIN(GB_ROBOT, _, name)
#ifndef GB_PART
typedef GB_PUBLIC(solution) gb_solution;
typedef GB_PUBLIC(pairs) gb_pairs;
enum gb_sought { GB_ANSWERS, GB_CLOSEST, GB_MEMBER, GB_OTHERS };
#else
typedef gb_found_1 GB_(found);
typedef gb_polynomial_1 GB_(polynomial);
#endif

/* Two angles differ by more than GB_MERGING_BLUR where the cosine of their difference is below this. */
#define GB_FAR_APART (R(1.0) - R(0.52) * GB_MERGING_BLUR * GB_MERGING_BLUR)

#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-variable"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#ifdef GB_PART
#pragma GCC diagnostic ignored "-Wunused-function"
#endif
#endif
#endif
