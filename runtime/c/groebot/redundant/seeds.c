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
        if (seeds->added + 2 * GB_MOST_MEMBERS > GB_ARM_SEEDS || !(differ || (low.has_close && high.has_close))) {
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
    int code = gb_arm_find_sections(seeds, scan);
    gb_arm_range(scan->model, joint, range);
    const gb_real width = (range[1] - range[0]) / (gb_real)GB_ARM_SCANNED;
    for (int k = 0; k < GB_ARM_SCANNED && code == 0; k++) {
        code = gb_arm_add_level(seeds, scan, joint, range[0] + ((gb_real)k + R(0.5)) * width, &level);
        if (code == 0 && k > 0) {
            code = gb_arm_between(seeds, scan, before, level);
        }
        before = level;
    }
    return code;
}

/* Bounds of a joint's values on a piece: those of the control points of its cubic. */
static void gb_arm_bounds(const gb_arm_piece *piece, size_t joint, gb_real *bounds)
{
    const gb_real share = piece->length / R(3.0), first = piece->from.x[joint], last = piece->to.x[joint];
    const gb_real second = first + share * piece->from.t[joint], third = last - share * piece->to.t[joint];
    const gb_real low = gb_arm_min(gb_arm_min(second, third), last), high = gb_arm_max(gb_arm_max(second, third), last);
    bounds[0] = gb_arm_min(first, low) - GB_ACCEPTANCE_INPUT;
    bounds[1] = gb_arm_max(first, high) + GB_ACCEPTANCE_INPUT;
}

/* The joint's value at a share of the piece, from a certain one; the cubic is without its constant coefficient. */
GB_INLINE gb_real gb_arm_seed_miss(const gb_real *c, gb_real from, gb_real value, gb_real share)
{
    return from + share * (c[0] + share * (c[1] + share * c[2])) - value;
}

/* The share of a part of the piece, from `low` to `high`, along which a joint increases or decreases, where the joint has a certain value; else an end of the
 * part. */
static gb_real gb_arm_seed_share(const gb_real *c, gb_real from, gb_real value, gb_real low, gb_real high)
{
    const gb_real first = gb_arm_seed_miss(c, from, value, low), last = gb_arm_seed_miss(c, from, value, high);
    gb_real share = R(0.5) * (low + high);
    if (first != last) {
        share = gb_arm_min(gb_arm_max(low - first * (high - low) / (last - first), low), high);
    }
    for (int k = 0; k < GB_ARM_SEED_STEPS; k++) {
        const gb_real slope = c[0] + share * (R(2.0) * c[1] + share * R(3.0) * c[2]);
        if (slope != R(0.0)) {
            share = gb_arm_min(gb_arm_max(share - gb_arm_seed_miss(c, from, value, share) / slope, low), high);
        }
    }
    return share;
}

/* Removes the solutions of a group on a piece of a curve, which may pass the value several times. */
static void gb_arm_pass_group(gb_arm_seeds *seeds, const gb_arm_model *model, const gb_arm_piece *piece, gb_real value, gb_arm_group *group)
{
    gb_real c[3], ends[3], x[GB_MOST_ARM_JOINTS], low = R(0.0);
    gb_arm_cubic(piece, group->joint, c);
    gb_arm_extrema(c[2], c[1], c[0], ends);
    for (int part = 0; part < 3; part++) {
        size_t k = group->first;
        if (ends[part] <= low) {
            continue;
        }
        gb_arm_piece_at(piece, gb_arm_seed_share(c, piece->from.x[group->joint], value, low, ends[part]), x);
        while (k < group->first + group->count) {
            if (gb_arm_are_close(model, x, seeds->list[k], GB_ARM_ON * piece->length + GB_MERGING_JOINTS)) {
                group->count--;
                memmove(seeds->list[k], seeds->list[group->first + group->count], sizeof seeds->list[k]);
            } else {
                k++;
            }
        }
        low = ends[part];
    }
}

/* Removes the solutions on a piece of a curve. */
static void gb_arm_pass_seeds(gb_arm_seeds *seeds, const gb_arm_model *model, const gb_arm_piece *piece)
{
    for (size_t number = 0; number < seeds->values; number++) {
        const size_t joint = seeds->groups[number].joint;
        gb_real value = seeds->groups[number].value, bounds[2];
        if (seeds->groups[number].count == 0) {
            continue;
        }
        gb_arm_bounds(piece, joint, bounds);
        if (model->turns[joint]) {
            value += GB_TAU * gb_ceiling((bounds[0] - value) / GB_TAU);
        }
        if (value >= bounds[0] && value <= bounds[1]) {
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
