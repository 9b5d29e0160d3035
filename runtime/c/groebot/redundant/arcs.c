/* Arcs between end points: see arcs.rs */

/* Arcs in the caller's buffer. */
typedef struct {
    gb_arc *out;
    size_t room;
    size_t count;
    bool is_unsure;
} gb_arm_output;

static void gb_arm_push(gb_arm_output *output, const gb_arc *arc)
{
    output->is_unsure = output->is_unsure || arc->is_unsure || output->count >= output->room;
    if (output->count < output->room) {
        output->out[output->count] = *arc;
    }
    output->count++;
}

/* An arc of length zero at a point that is no end point. */
static gb_arc gb_arm_arc_at(const gb_arm_model *model, const gb_real *x)
{
    gb_arc arc;
    memset(&arc, 0, sizeof arc);
    gb_arm_unscaled(model, x, arc.start.q);
    arc.start.joint = -1;
    arc.end = arc.start;
    arc.side = R(1.0);
    return arc;
}

/* The joint that is constant on every curve, which the arm has at most once; -1 if there is none. */
static int gb_arm_constant(const gb_arm *arm)
{
    for (size_t joint = 0; joint < arm->count; joint++) {
        if (arm->given[joint] == GB_ARM_CONSTANT) {
            return (int)joint;
        }
    }
    return -1;
}

/* Whether the equations are regular at a point, so that its solutions are isolated. */
static bool gb_arm_is_regular(const gb_arm_model *model, const gb_real *x)
{
    gb_arm_place place;
    gb_arm_set_place(model, x, &place);
    return place.linear.pivot > GB_PIVOTS_ISOLATED;
}

/* Whether the equations are singular at all solutions, and there are any. */
static bool gb_arm_is_singular(const gb_arm_model *model, const gb_arm_ends *ends, const gb_arm_seeds *seeds)
{
    for (size_t k = 0; k < ends->count; k++) {
        if (gb_arm_is_regular(model, ends->list[k].at.x)) {
            return false;
        }
    }
    for (size_t k = 0; k < ends->touches; k++) {
        if (gb_arm_is_regular(model, ends->touching[k].x)) {
            return false;
        }
    }
    for (size_t number = 0; number < seeds->values; number++) {
        const gb_arm_group *group = &seeds->groups[number];
        for (size_t k = group->first; k < group->first + group->count; k++) {
            if (gb_arm_is_regular(model, seeds->list[k])) {
                return false;
            }
        }
    }
    return ends->count + ends->touches > 0 || gb_arm_first_seed(seeds);
}

/* Where the equations are singular at all solutions, the joint that is constant is left out, as with a straight elbow. Rounding of the target bends a straight
 * elbow, so that all equations whose solutions are not isolated count as singular. */
static void gb_arm_freeze(gb_arm_model *model, gb_arm_ends *ends, const gb_arm_seeds *seeds)
{
    const int joint = gb_arm_constant(model->arm);
    if (joint >= 0 && gb_arm_is_singular(model, ends, seeds)) {
        gb_arm_touch touching[GB_ARM_TOUCHING];
        const size_t touches = ends->touches;
        memcpy(touching, ends->touching, touches * sizeof touching[0]);
        model->frozen = joint;
        /* Of singular equations, no direction is known: an end point may have been taken for a solution that touches a limit. */
        ends->touches = 0;
        for (size_t k = 0; k < touches; k++) {
            (void)gb_arm_add_end(ends, model, touching[k].x);
        }
        gb_arm_classify(ends, model);
    }
}

/* An end point where a curve was lost. */
GB_COLD static size_t gb_arm_add_lost(gb_arm_ends *ends, const gb_arm_model *model, const gb_real *x)
{
    ends->is_unsure = true;
    return gb_arm_add_end(ends, model, x);
}

/* Makes an arc of two end points. */
static void gb_arm_connect(gb_arm_ends *ends, size_t start, size_t end, gb_real length, bool is_unsure)
{
    gb_arm_end *first = &ends->list[start];
    ends->list[end].partner = start;
    ends->list[end].is_start = false;
    first->partner = end;
    first->is_start = true;
    first->length = length;
    first->is_unsure = first->is_unsure || is_unsure;
}

/* A second arc leads to an end point: both are traced again with shorter steps. Returns the first end point to continue with. */
static size_t gb_arm_repeat(gb_arm_ends *ends, size_t k, size_t partner, gb_real length)
{
    const size_t other = ends->list[partner].partner, numbers[3] = {k, partner, other};
    const uint32_t level = ends->list[k].level;
    size_t least = k;
    if (level == GB_ARM_LEVELS) {
        /* Not decided: this arc ends at an end point of another one. */
        gb_arm_end *end = &ends->list[k];
        ends->list[partner].is_unsure = true;
        ends->list[other].is_unsure = true;
        end->partner = partner;
        end->is_start = true;
        end->length = length;
        end->is_unsure = true;
        return k;
    }
    for (int i = 0; i < 3; i++) {
        gb_arm_end *end = &ends->list[numbers[i]];
        end->partner = GB_ARM_FREE;
        end->is_start = false;
        end->level = level + 1;
        least = numbers[i] < least ? numbers[i] : least;
    }
    return least;
}

/* Traces from an end point. Returns the number of the one with which to continue. */
static size_t gb_arm_pair_from(const gb_arm_search *search, size_t k)
{
    gb_arm_ends *ends = search->ends;
    const gb_arm_end *end = &ends->list[k];
    gb_arm_trace_start start = {end->at, end->inward, end->tied, end->level, false};
    for (int i = 0; i < GB_MOST_ARM_JOINTS; i++) {
        start.at.t[i] *= end->inward;
    }
    const gb_arm_trace traced = gb_arm_follow(search, &start);
    const size_t partner = traced.stop == GB_ARM_LOST ? gb_arm_add_lost(ends, search->model, traced.x) : traced.end;
    if (partner == GB_ARM_FREE || partner == k) {
        gb_arm_connect(ends, k, k, traced.length, true);
    } else if (ends->list[partner].partner == GB_ARM_FREE) {
        gb_arm_connect(ends, k, partner, traced.length, traced.is_unsure);
    } else {
        return gb_arm_repeat(ends, k, partner, traced.length);
    }
    return k;
}

/* Traces from each end point to its partner. */
static void gb_arm_pair(const gb_arm_search *search)
{
    for (int pass = 0; pass < 2; pass++) {
        size_t k = 0;
        while (k < search->ends->count) {
            const gb_arm_end *end = &search->ends->list[k];
            if (end->partner != GB_ARM_FREE || end->inward == R(0.0) || end->is_singular != (pass == 1)) {
                k++;
            } else {
                k = gb_arm_pair_from(search, k);
            }
        }
    }
}

static gb_arc_end gb_arm_end_of(const gb_arm_model *model, const gb_arm_end *end)
{
    gb_arc_end out;
    gb_arm_unscaled(model, end->at.x, out.q);
    out.joint = -1;
    for (size_t i = model->count; i-- > 0;) {
        if (((end->sides[0] | end->sides[1]) & gb_arm_bit(i)) != 0) {
            out.joint = (int)i;
        }
    }
    out.is_upper = out.joint >= 0 && (end->sides[1] & gb_arm_bit((size_t)out.joint)) != 0;
    return out;
}

/* Adds the arc that was traced from an end point, or an end point from which no direction leads within limits. */
static void gb_arm_push_end(const gb_arm_model *model, const gb_arm_ends *ends, size_t k, gb_arm_output *output)
{
    const gb_arm_end *start = &ends->list[k];
    const bool is_isolated = start->partner == GB_ARM_FREE;
    if (!start->is_start && !is_isolated) {
        return;
    }
    const gb_arm_end *end = is_isolated ? start : &ends->list[start->partner];
    gb_arc arc;
    arc.start = gb_arm_end_of(model, start);
    arc.end = gb_arm_end_of(model, end);
    arc.length = start->length;
    arc.is_closed = false;
    arc.is_unsure = start->is_unsure || end->is_unsure || start->is_singular;
    arc.side = start->inward;
    arc.tied = start->tied;
    arc.level = start->level;
    arc.is_frozen = model->frozen >= 0;
    gb_arm_push(output, &arc);
}
