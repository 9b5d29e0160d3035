/* Solutions for values of some joints. Those that are on no traced curve lead to closed curves: see seeds.rs */

/* Solutions of the list that have one value of a joint: from `first` on, so many. */
typedef struct {
    size_t joint;
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
    bool is_unsure;
    /* The number of values of the grid for which the problem itself has a self-motion, and one of their solutions within limits. */
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

/* The problem whose solutions are searched, where the best reason is kept, and where solutions on curves along which a joint keeps its value are added. */
typedef struct {
    const gb_redundant *robot;
    const gb_arm_model *model;
    const gb_real *target;
    gb_arm_beyond *beyond;
    gb_arm_ends *ends;
} gb_arm_scan;

/* The range of a joint's values that are tried. */
static void gb_arm_range(const gb_arm_model *model, size_t joint, gb_real *range)
{
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

/* Adds the solutions with a joint at a scaled value. Returns 0 or a code below 0. */
static int gb_arm_add_level(gb_arm_seeds *seeds, const gb_arm_scan *scan, size_t joint, gb_real value, gb_arm_level *level)
{
    const gb_arm_model *model = scan->model;
    const bool is_grid = joint == model->arm->grid;
    const gb_arm_members *members = &seeds->members;
    const size_t first = seeds->added;
    bool is_surface = false;
    const int code = gb_arm_solve(scan->robot, scan->target, joint, value * model->units[joint], &seeds->members);
    if (code < 0) {
        return code;
    }
    seeds->is_unsure = seeds->is_unsure || members->is_short;
    for (size_t k = 0; k < members->count; k++) {
        const gb_arm_member *member = &members->list[k];
        gb_real x[GB_MOST_ARM_JOINTS];
        seeds->is_unsure = seeds->is_unsure || !member->settled;
        gb_arm_scaled(model, member->q, x);
        x[joint] = value;
        const uint32_t beyond = gb_arm_lift(model, x);
        gb_arm_pass_beyond(scan->beyond, model, x, beyond);
        is_surface = is_surface || (is_grid && member->free != 0);
        if (beyond == 0 && member->free != 0 && is_grid) {
            seeds->has_surface = true;
            gb_arm_copy(x, seeds->surface);
        } else if (beyond == 0 && member->free != 0) {
            /* Along a curve through this solution, the joint keeps its value. */
            gb_arm_add_touch(scan->ends, model, x, gb_arm_tied_at(model, x));
        } else if (beyond == 0) {
            gb_arm_add_seed(seeds, x);
        }
    }
    gb_arm_group *group = &seeds->groups[seeds->values++];
    group->joint = joint;
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
        const int code = gb_arm_add_level(seeds, scan, scan->model->arm->grid, R(0.5) * (low.value + high.value), &middle);
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

/* Solves the problems with the sections, and with one value of each unlimited joint. Returns 0 or a code below 0. */
static int gb_arm_find_sections(gb_arm_seeds *seeds, const gb_arm_scan *scan)
{
    const gb_arm_model *model = scan->model;
    const gb_arm *arm = model->arm;
    gb_arm_level level;
    int code = 0;
    for (size_t k = 0; k < arm->section_count && code == 0; k++) {
        const size_t joint = arm->sections[k].joint;
        const gb_real value = arm->sections[k].value / model->units[joint];
        if (model->turns[joint] || (value >= model->limits[joint][0] && value <= model->limits[joint][1])) {
            code = gb_arm_add_level(seeds, scan, joint, value, &level);
        }
    }
    for (size_t joint = 0; joint < model->count && code == 0; joint++) {
        if (model->turns[joint] && arm->given[joint] == GB_ARM_SOLVED && joint != arm->grid) {
            code = gb_arm_add_level(seeds, scan, joint, GB_ARM_ANY_VALUE, &level);
        }
    }
    return code;
}

/* Solves the problems with the values of joints. Returns 0 or a code below 0. */
static int gb_arm_find_seeds(gb_arm_seeds *seeds, const gb_arm_scan *scan)
{
    const size_t joint = scan->model->arm->grid;
    gb_real range[2];
    gb_arm_level before = {R(0.0), 0, false}, level = before;
    gb_arm_range(scan->model, joint, range);
    const gb_real width = (range[1] - range[0]) / (gb_real)GB_ARM_SCANNED;
    for (int k = 0; k < GB_ARM_SCANNED; k++) {
        int code = gb_arm_add_level(seeds, scan, joint, range[0] + ((gb_real)k + R(0.5)) * width, &level);
        if (code == 0 && k > 0) {
            code = gb_arm_between(seeds, scan, before, level);
        }
        if (code < 0) {
            return code;
        }
        before = level;
    }
    return gb_arm_find_sections(seeds, scan);
}

/* The point of the piece where a joint has a certain value. */
static void gb_arm_seed_on(const gb_arm_piece *piece, size_t joint, gb_real value, gb_real *x)
{
    const gb_real from = piece->from.x[joint], to = piece->to.x[joint];
    gb_real share = from == to ? R(0.5) : (value - from) / (to - from), c[3];
    gb_arm_cubic(piece, joint, c);
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
    gb_arm_seed_on(piece, group->joint, value, x);
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
    for (size_t number = 0; number < seeds->values; number++) {
        const size_t joint = seeds->groups[number].joint;
        gb_real value = seeds->groups[number].value;
        if (seeds->groups[number].count == 0) {
            continue;
        }
        const gb_real from = piece->from.x[joint], to = piece->to.x[joint];
        const gb_real least = gb_arm_min(from, to) - GB_ACCEPTANCE_INPUT, greatest = gb_arm_max(from, to) + GB_ACCEPTANCE_INPUT;
        if (model->turns[joint]) {
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
