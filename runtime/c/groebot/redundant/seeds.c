/* Solutions for a grid of values of the scanned joint. Those that are on no traced curve lead to closed curves: see seeds.rs */

/* Solutions of the list that have one value of the scanned joint: from `first` on, so many. */
typedef struct {
    gb_real value;
    size_t first;
    size_t count;
} gb_arm_group;

/* Solutions within limits that are on no known curve. */
typedef struct {
    gb_real list[GB_ARM_SEEDS][GB_MOST_ARM_JOINTS];
    /* The number of solutions that were added; some of them are on known curves by now. */
    size_t added;
    gb_arm_group groups[GB_ARM_GROUPS];
    size_t values;
    size_t joint;
    bool is_unsure;
    /* The number of values for which the problem itself has a self-motion, and one of their solutions within limits. */
    size_t surfaces;
    bool has_surface;
    gb_real surface[GB_MOST_ARM_JOINTS];
    gb_arm_members members;
} gb_arm_seeds;

/* What is compared between neighbouring values. */
typedef struct {
    gb_real value;
    size_t solutions;
    bool has_close;
} gb_arm_level;

/* The problem that is scanned, and where the best reason is kept. */
typedef struct {
    const gb_redundant *robot;
    const gb_arm_model *model;
    const gb_real *target;
    gb_arm_beyond *beyond;
} gb_arm_scan;

/* The range of values that are scanned. */
static void gb_arm_range(const gb_arm_model *model, gb_real *range)
{
    const size_t joint = model->arm->scanned;
    const gb_real low = model->limits[joint][0], high = model->limits[joint][1];
    if (model->turns[joint]) {
        range[0] = gb_magnitude(low) <= GB_GREATEST ? low : -GB_PI;
        range[1] = range[0] + GB_TAU;
    } else {
        range[0] = gb_arm_max(low, -GB_ARM_FARTHEST);
        range[1] = gb_arm_min(high, GB_ARM_FARTHEST);
    }
}

/* Whether two of the solutions from this one on are close to each other. */
static bool gb_arm_has_close(const gb_arm_seeds *seeds, const gb_arm_model *model, size_t first)
{
    for (size_t i = first; i < seeds->added; i++) {
        for (size_t j = first; j < i; j++) {
            if (gb_arm_are_close(model, seeds->list[i], seeds->list[j], GB_ARM_CLOSE)) {
                return true;
            }
        }
    }
    return false;
}

/* Adds a solution within limits. */
static void gb_arm_add_seed(gb_arm_seeds *seeds, const gb_real *x)
{
    if (seeds->added < GB_ARM_SEEDS) {
        gb_arm_copy(x, seeds->list[seeds->added++]);
    } else {
        seeds->is_unsure = true;
    }
}

/* Adds the solutions for a value of the scanned joint. Returns 0 or a code below 0. */
static int gb_arm_add_level(gb_arm_seeds *seeds, const gb_arm_scan *scan, gb_real value, gb_arm_level *level)
{
    const gb_arm_model *model = scan->model;
    const gb_arm_members *members = &seeds->members;
    const size_t first = seeds->added;
    bool is_surface = false;
    const int code = gb_arm_solve(scan->robot, scan->target, seeds->joint, value * model->units[seeds->joint], &seeds->members);
    if (code < 0) {
        return code;
    }
    seeds->is_unsure = seeds->is_unsure || members->is_short;
    for (size_t k = 0; k < members->count; k++) {
        const gb_arm_member *member = &members->list[k];
        gb_real x[GB_MOST_ARM_JOINTS];
        seeds->is_unsure = seeds->is_unsure || !member->settled;
        gb_arm_scaled(model, member->q, x);
        x[seeds->joint] = value;
        const uint32_t beyond = gb_arm_lift(model, x);
        gb_arm_pass_beyond(scan->beyond, model, x, beyond);
        is_surface = is_surface || member->free != 0;
        if (beyond == 0 && member->free != 0) {
            seeds->has_surface = true;
            gb_arm_copy(x, seeds->surface);
        } else if (beyond == 0) {
            gb_arm_add_seed(seeds, x);
        }
    }
    gb_arm_group *group = &seeds->groups[seeds->values++];
    group->value = value;
    group->first = first;
    group->count = seeds->added - first;
    seeds->surfaces += is_surface ? 1 : 0;
    level->value = value;
    level->solutions = members->count;
    level->has_close = gb_arm_has_close(seeds, model, first);
    return 0;
}

/* Adds values between two neighbouring ones, where solutions appear or vanish. Returns 0 or a code below 0. */
static int gb_arm_between(gb_arm_seeds *seeds, const gb_arm_scan *scan, gb_arm_level low, gb_arm_level high)
{
    for (int k = 0; k < GB_ARM_HALVINGS; k++) {
        gb_arm_level middle;
        const bool differ = low.solutions != high.solutions;
        if (seeds->added + GB_MOST_MEMBERS > GB_ARM_SEEDS || !(differ || (low.has_close && high.has_close))) {
            return 0;
        }
        const int code = gb_arm_add_level(seeds, scan, R(0.5) * (low.value + high.value), &middle);
        if (code < 0) {
            return code;
        }
        if (middle.solutions == low.solutions) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return 0;
}

/* Solves the problems with values of the scanned joint. Returns 0 or a code below 0. */
static int gb_arm_find_seeds(gb_arm_seeds *seeds, const gb_arm_scan *scan)
{
    gb_real range[2];
    gb_arm_level before = {R(0.0), 0, false}, level = before;
    seeds->joint = scan->model->arm->scanned;
    gb_arm_range(scan->model, range);
    const gb_real width = (range[1] - range[0]) / (gb_real)GB_ARM_SCANNED;
    for (int k = 0; k < GB_ARM_SCANNED; k++) {
        int code = gb_arm_add_level(seeds, scan, range[0] + ((gb_real)k + R(0.5)) * width, &level);
        if (code == 0 && k > 0) {
            code = gb_arm_between(seeds, scan, before, level);
        }
        if (code < 0) {
            return code;
        }
        before = level;
    }
    return 0;
}

/* The point of the piece where the scanned joint has a certain value. */
static void gb_arm_seed_on(const gb_arm_seeds *seeds, const gb_arm_piece *piece, gb_real value, gb_real *x)
{
    const gb_real from = piece->from.x[seeds->joint], to = piece->to.x[seeds->joint];
    gb_real share = from == to ? R(0.5) : (value - from) / (to - from), c[3];
    gb_arm_cubic(piece, seeds->joint, c);
    for (int k = 0; k < GB_ARM_SEED_STEPS; k++) {
        const gb_real slope = c[0] + share * (R(2.0) * c[1] + share * R(3.0) * c[2]);
        const gb_real miss = from + share * (c[0] + share * (c[1] + share * c[2])) - value;
        if (slope != R(0.0)) {
            share = gb_arm_share(share - miss / slope);
        }
    }
    gb_arm_piece_at(piece, share, x);
}

/* Removes the solutions of a group on a piece of a curve. */
static void gb_arm_pass_group(gb_arm_seeds *seeds, const gb_arm_model *model, const gb_arm_piece *piece, gb_real value, gb_arm_group *group)
{
    gb_real x[GB_MOST_ARM_JOINTS];
    size_t k = group->first;
    gb_arm_seed_on(seeds, piece, value, x);
    while (k < group->first + group->count) {
        if (gb_arm_are_close(model, x, seeds->list[k], GB_ARM_ON * piece->length + GB_MERGING_JOINTS)) {
            group->count--;
            memmove(seeds->list[k], seeds->list[group->first + group->count], sizeof seeds->list[k]);
        } else {
            k++;
        }
    }
}

/* Removes the solutions on a piece of a curve. */
static void gb_arm_pass_seeds(gb_arm_seeds *seeds, const gb_arm_model *model, const gb_arm_piece *piece)
{
    const gb_real from = piece->from.x[seeds->joint], to = piece->to.x[seeds->joint];
    const gb_real least = gb_arm_min(from, to) - GB_ACCEPTANCE_INPUT, greatest = gb_arm_max(from, to) + GB_ACCEPTANCE_INPUT;
    for (size_t number = 0; number < seeds->values; number++) {
        gb_real value = seeds->groups[number].value;
        if (seeds->groups[number].count == 0) {
            continue;
        }
        if (model->turns[seeds->joint]) {
            value += GB_TAU * gb_ceiling((least - value) / GB_TAU);
        }
        if (value >= least && value <= greatest) {
            gb_arm_pass_group(seeds, model, piece, value, &seeds->groups[number]);
        }
    }
}

/* Takes a solution that is on no known curve from the list. False if there is none. */
static bool gb_arm_take_seed(gb_arm_seeds *seeds, gb_real *x)
{
    while (seeds->values > 0) {
        gb_arm_group *group = &seeds->groups[seeds->values - 1];
        if (group->count > 0) {
            group->count--;
            gb_arm_copy(seeds->list[group->first + group->count], x);
            return true;
        }
        seeds->values--;
    }
    return false;
}

/* The first of the solutions that are on no known curve; NULL if there is none. */
static const gb_real *gb_arm_first_seed(const gb_arm_seeds *seeds)
{
    for (size_t number = 0; number < seeds->values; number++) {
        const gb_arm_group *group = &seeds->groups[number];
        if (group->count > 0) {
            return seeds->list[group->first];
        }
    }
    return NULL;
}
