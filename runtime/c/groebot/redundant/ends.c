/* End points of arcs: solutions where a joint is at a limit: see ends.rs */

/* A solution within limits that has a joint at a limit. */
typedef struct {
    /* The point with the oriented direction. */
    gb_arm_point at;
    /* The joints that are at their lower and at their upper limits, as bits. */
    uint32_t sides[2];
    /* The sign of the direction that leads along the curve within limits; 0 where none does. */
    gb_real inward;
    /* Joints that remain at their limits along the curve, as bits. */
    uint32_t tied;
    /* Whether the equations are singular here: curves may cross, and the direction is not certain. */
    bool is_singular;
    /* The number of the end point at the other end of the arc. GB_ARM_FREE while there is none. */
    size_t partner;
    /* Whether the arc was traced from here, its length, and whether something about it was not decided. */
    bool is_start;
    gb_real length;
    bool is_unsure;
    /* Steps are divided by four so many times. */
    uint32_t level;
} gb_arm_end;

/* The solution that exceeds limits least: the joints beyond limits, by how much, and whether there is a solution. */
typedef struct {
    uint32_t joints;
    gb_real excess;
    bool is_reachable;
} gb_arm_beyond;

/* A solution with the joints that remain at their limits. */
typedef struct {
    gb_real x[GB_MOST_ARM_JOINTS];
    uint32_t tied;
} gb_arm_touch;

/* The end points of a target. */
typedef struct {
    gb_arm_end list[GB_ARM_ENDS];
    size_t count;
    /* Whether something was not decided, or there was no room. */
    bool is_unsure;
    /* Solutions on curves along which a joint remains at its limit, or that only touch a limit. */
    gb_arm_touch touching[GB_ARM_TOUCHING];
    size_t touches;
    /* For reasons. */
    gb_arm_beyond beyond;
} gb_arm_ends;

static const gb_arm_beyond gb_arm_no_beyond = {0, (gb_real)INFINITY, false};

/* Compares with another solution, whose angles are lifted. */
static void gb_arm_pass_beyond(gb_arm_beyond *beyond, const gb_arm_model *model, const gb_real *x, uint32_t joints)
{
    gb_real excess = R(0.0);
    for (size_t i = 0; i < model->count; i++) {
        if ((joints & gb_arm_bit(i)) != 0) {
            excess += gb_arm_max(model->limits[i][0] - x[i], x[i] - model->limits[i][1]);
        }
    }
    beyond->is_reachable = true;
    if (excess < beyond->excess) {
        beyond->excess = excess;
        beyond->joints = joints;
    }
}

/* Whether the joint is at this limit, and limits of the joint are reached along curves. */
static bool gb_arm_is_at(const gb_arm_model *model, const gb_real *x, size_t joint, int side)
{
    return gb_arm_is_limited(model, joint) && gb_magnitude(x[joint] - model->limits[joint][side]) <= GB_MERGING_JOINTS;
}

/* Adds a solution within limits, unless it is known from another joint. Returns its number, or GB_ARM_FREE if there is no room. */
static size_t gb_arm_add_end(gb_arm_ends *ends, const gb_arm_model *model, const gb_real *x)
{
    uint32_t sides[2] = {0, 0};
    for (size_t i = 0; i < model->count; i++) {
        for (int side = 0; side < 2; side++) {
            sides[side] |= gb_arm_is_at(model, x, i, side) ? gb_arm_bit(i) : 0;
        }
    }
    for (size_t k = 0; k < ends->count; k++) {
        gb_arm_end *end = &ends->list[k];
        if (gb_arm_distance(model, end->at.x, x) <= GB_MERGING_JOINTS) {
            end->sides[0] |= sides[0];
            end->sides[1] |= sides[1];
            return k;
        }
    }
    if (ends->count == GB_ARM_ENDS) {
        ends->is_unsure = true;
        return GB_ARM_FREE;
    }
    gb_arm_end *end = &ends->list[ends->count];
    memset(end, 0, sizeof *end);
    gb_arm_copy(x, end->at.x);
    end->sides[0] = sides[0];
    end->sides[1] = sides[1];
    end->partner = GB_ARM_FREE;
    return ends->count++;
}

/* Stores a solution with joints at limits from which the curve leads within limits in both directions. */
static void gb_arm_add_touch(gb_arm_ends *ends, const gb_arm_model *model, const gb_real *x, uint32_t tied)
{
    for (size_t k = 0; k < ends->touches; k++) {
        if (gb_arm_distance(model, ends->touching[k].x, x) <= GB_MERGING_JOINTS) {
            return;
        }
    }
    if (ends->touches == GB_ARM_TOUCHING) {
        ends->is_unsure = true;
        return;
    }
    gb_arm_copy(x, ends->touching[ends->touches].x);
    ends->touching[ends->touches++].tied = tied;
}

/* Removes the solutions that touch limits on a piece of a curve. */
static void gb_arm_pass_ends(gb_arm_ends *ends, const gb_arm_model *model, const gb_arm_piece *piece)
{
    size_t k = 0;
    while (k < ends->touches) {
        if (gb_arm_is_on(model, piece, ends->touching[k].x)) {
            ends->touches--;
            ends->touching[k] = ends->touching[ends->touches];
        } else {
            k++;
        }
    }
}

/* The joints that remain at their limits along the curve through a point. */
static uint32_t gb_arm_tied_at(const gb_arm_model *model, const gb_real *x)
{
    uint32_t at = 0, tied = 0;
    for (size_t i = 0; i < model->count; i++) {
        at |= gb_arm_is_at(model, x, i, 0) || gb_arm_is_at(model, x, i, 1) ? gb_arm_bit(i) : 0;
    }
    if (at == 0) {
        return 0;
    }
    gb_arm_place place;
    gb_real bend[GB_MOST_ARM_JOINTS];
    gb_arm_set_bent(model, x, &place, bend);
    for (size_t i = 0; i < model->count; i++) {
        if ((at & gb_arm_bit(i)) != 0 && gb_magnitude(place.linear.tangent[i]) <= GB_PIVOTS_REGULAR && gb_magnitude(bend[i]) <= GB_PIVOTS_REGULAR) {
            tied |= gb_arm_bit(i);
        }
    }
    return tied;
}

/* Directions in which a curve leads within limits, and the joints that remain at their limits. */
typedef struct {
    bool forward;
    bool backward;
    uint32_t tied;
} gb_arm_openings;

/* Restricts the directions by one joint at a limit. */
static void gb_arm_restrict(gb_arm_openings *open, const gb_arm_end *end, size_t joint, int side)
{
    const gb_real inward = side == 0 ? R(1.0) : R(-1.0);
    const gb_real rate = inward * end->at.t[joint], bend = inward * end->at.bend[joint];
    if (gb_magnitude(rate) <= GB_PIVOTS_REGULAR && gb_magnitude(bend) <= GB_PIVOTS_REGULAR) {
        open->tied |= gb_arm_bit(joint);
        return;
    }
    if (bend > R(0.0) && rate * rate <= R(2.0) * bend * GB_ACCEPTANCE_INPUT) {
        /* Touches the limit from within, or exceeds it by less than the tolerance. */
        return;
    }
    const bool turns_outward = bend < R(0.0) && gb_magnitude(rate) <= GB_PIVOTS_REGULAR;
    open->forward = open->forward && !turns_outward && rate > R(0.0);
    open->backward = open->backward && !turns_outward && rate < R(0.0);
}

/* Whether the curve leads within limits along the oriented direction and against it, and the joints that remain at their limits. */
static gb_arm_openings gb_arm_openings_of(const gb_arm_model *model, const gb_arm_end *end)
{
    gb_arm_openings open = {true, true, 0};
    for (size_t i = 0; i < model->count; i++) {
        for (int side = 0; side < 2; side++) {
            if ((end->sides[side] & gb_arm_bit(i)) != 0) {
                gb_arm_restrict(&open, end, i, side);
            }
        }
    }
    return open;
}

/* Decides by derivatives in which direction the curve leads within limits. Solutions where both do are no end points. */
static void gb_arm_classify(gb_arm_ends *ends, const gb_arm_model *model)
{
    size_t kept = 0;
    for (size_t k = 0; k < ends->count; k++) {
        gb_arm_end end = ends->list[k];
        gb_arm_place place;
        gb_real bend[GB_MOST_ARM_JOINTS];
        gb_arm_set_bent(model, end.at.x, &place, bend);
        const bool is_solution = gb_arm_largest(place.values, GB_ARM_ROWS) <= R(10.0) * GB_MERGING_JOINTS;
        if (!is_solution) {
            ends->is_unsure = true;
            continue;
        }
        end.at = gb_arm_point_of(&place, R(1.0), bend);
        const gb_arm_openings open = gb_arm_openings_of(model, &end);
        end.tied = open.tied;
        end.is_singular = place.linear.pivot <= GB_PIVOTS_REGULAR;
        if (open.forward && open.backward) {
            gb_arm_add_touch(ends, model, end.at.x, open.tied);
            continue;
        }
        end.inward = open.forward ? R(1.0) : open.backward ? R(-1.0) : R(0.0);
        ends->list[kept++] = end;
    }
    ends->count = kept;
}

/* Adds the solutions with a joint at a limit. */
static void gb_arm_add_all(gb_arm_ends *ends, const gb_arm_model *model, const gb_arm_members *members, size_t joint, gb_real limit)
{
    ends->is_unsure = ends->is_unsure || members->is_short;
    for (size_t k = 0; k < members->count; k++) {
        const gb_arm_member *member = &members->list[k];
        gb_real x[GB_MOST_ARM_JOINTS];
        ends->is_unsure = ends->is_unsure || !member->settled;
        gb_arm_scaled(model, member->q, x);
        x[joint] = limit;
        const uint32_t beyond = gb_arm_lift(model, x);
        gb_arm_pass_beyond(&ends->beyond, model, x, beyond);
        if (beyond == 0 && member->free != 0) {
            /* Along a curve through this solution, the joint remains at its limit. */
            gb_arm_add_touch(ends, model, x, gb_arm_tied_at(model, x));
        } else if (beyond == 0) {
            gb_arm_add_end(ends, model, x);
        }
    }
}

/* The solutions with a joint given, by the robot's solver. Returns its code. */
static int gb_arm_solve(const gb_redundant *robot, const gb_real *target, size_t joint, gb_real value, gb_arm_members *members)
{
    members->count = 0;
    members->is_short = false;
    return robot->solve_given(robot->context, target, joint, value, members);
}

/* Whether the problem with the joint at this limit is solved, and not equal to one before. */
static bool gb_arm_is_tried(const gb_arm_model *model, size_t joint, int side)
{
    const gb_real limit = model->limits[joint][side];
    return gb_magnitude(limit) <= GB_GREATEST && !(side == 1 && limit == model->limits[joint][0]);
}

/* Solves all problems with a joint at a limit. Returns 0 or a code below 0. */
static int gb_arm_find_ends(gb_arm_ends *ends, const gb_redundant *robot, const gb_arm_model *model, const gb_real *target)
{
    gb_arm_members members;
    for (size_t joint = 0; joint < model->count; joint++) {
        for (int side = 0; side < 2; side++) {
            if (model->turns[joint] || model->arm->given[joint] != GB_ARM_SOLVED || !gb_arm_is_tried(model, joint, side)) {
                continue;
            }
            const gb_real limit = model->limits[joint][side];
            const int code = gb_arm_solve(robot, target, joint, limit * model->units[joint], &members);
            if (code < 0) {
                return code;
            }
            gb_arm_add_all(ends, model, &members, joint, limit);
        }
    }
    gb_arm_classify(ends, model);
    return 0;
}
