/* From a point on a curve to where the curve ends: see trace.rs */

/* Where a curve ends: at an end point, at its beginning, or where it could not be followed from there on. */
typedef enum { GB_ARM_AT_END, GB_ARM_AT_START, GB_ARM_LOST } gb_arm_stop;

/* A traced curve. */
typedef struct {
    gb_arm_stop stop;
    /* The number of the end point, or where it was lost. */
    size_t end;
    gb_real x[GB_MOST_ARM_JOINTS];
    gb_real length;
    bool is_unsure;
} gb_arm_trace;

/* The start of a trace: a point, the sign of its direction against the oriented one, and the joints that remain at their limits. */
typedef struct {
    gb_arm_point at;
    gb_real side;
    uint32_t tied;
    uint32_t level;
    /* Whether the curve may be closed: the start is no end point. */
    bool is_inside;
} gb_arm_trace_start;

/* The end points and solutions of a target. */
typedef struct {
    const gb_arm_model *model;
    gb_arm_ends *ends;
    gb_arm_seeds *seeds;
} gb_arm_search;

/* The piece from a point to a known one near `to`, in the direction of travel. */
static gb_arm_piece gb_arm_last_piece(const gb_arm_model *model, const gb_arm_point *from, const gb_arm_point *end, const gb_arm_point *to)
{
    gb_arm_point last = *end;
    gb_real d[GB_MOST_ARM_JOINTS];
    if (gb_arm_dot(end->t, to->t) < R(0.0)) {
        gb_arm_reverse(last.t);
    }
    gb_arm_difference(model, end->x, from->x, d);
    gb_arm_plus(from->x, R(1.0), d, last.x);
    return gb_arm_piece_of(from, &last);
}

/* Writes the piece up to the beginning of the curve. False if the beginning is not on the piece. */
static bool gb_arm_closing(const gb_arm_model *model, const gb_arm_piece *piece, const gb_arm_point *home, gb_arm_piece *last)
{
    gb_arm_point end = *home;
    gb_real d[GB_MOST_ARM_JOINTS];
    if (gb_arm_dot(piece->to.t, home->t) < GB_ARM_ALIGNED || !gb_arm_is_on(model, piece, home->x)) {
        return false;
    }
    gb_arm_difference(model, home->x, piece->from.x, d);
    gb_arm_plus(piece->from.x, R(1.0), d, end.x);
    *last = gb_arm_piece_of(&piece->from, &end);
    return true;
}

/* Makes an end point of the point where a joint reaches its limit. Returns its number, or GB_ARM_FREE if there is none. */
GB_COLD static size_t gb_arm_locate(const gb_arm_model *model, const gb_arm_crossing *crossing, const gb_arm_point *near, gb_real side, gb_arm_ends *ends)
{
    gb_arm_point point = *near;
    gb_real size = (gb_real)INFINITY;
    for (int k = 0; k < GB_ARM_LOCATING && !(size <= GB_ACCEPTANCE_RESIDUAL); k++) {
        gb_real x[GB_MOST_ARM_JOINTS];
        gb_arm_copy(point.x, x);
        size = gb_arm_corrected(model, crossing, x, side, R(0.1), &point);
        if (size < R(0.0)) {
            return GB_ARM_FREE;
        }
    }
    const bool is_located = size <= GB_MERGING_JOINTS;
    const size_t number = is_located ? gb_arm_add_end(ends, model, point.x) : GB_ARM_FREE;
    if (number == GB_ARM_FREE) {
        return number;
    }
    gb_arm_end *end = &ends->list[number];
    if (end->partner == GB_ARM_FREE && end->inward == R(0.0)) {
        gb_arm_place place;
        gb_real bend[GB_MOST_ARM_JOINTS];
        gb_arm_set_bent(model, point.x, &place, bend);
        end->at = gb_arm_point_of(&place, R(1.0), bend);
        end->inward = -side;
        end->sides[crossing->side] |= gb_arm_bit(crossing->joint);
        end->is_unsure = model->arm->given[crossing->joint] == GB_ARM_SOLVED;
    }
    return number;
}

/* The end point with a joint at a limit that is nearest to a point. Returns GB_ARM_FREE if there is none within the distance. */
static size_t gb_arm_nearest_end(const gb_arm_model *model, const gb_arm_crossing *crossing, const gb_real *x, const gb_arm_ends *ends, gb_real most)
{
    size_t nearest = GB_ARM_FREE;
    gb_real least = (gb_real)INFINITY;
    for (size_t k = 0; k < ends->count; k++) {
        const gb_arm_end *end = &ends->list[k];
        if ((end->sides[crossing->side] & gb_arm_bit(crossing->joint)) != 0) {
            const gb_real distance = gb_arm_distance(model, end->at.x, x);
            if (distance < least) {
                nearest = k;
                least = distance;
            }
        }
    }
    return least <= most ? nearest : GB_ARM_FREE;
}

/* The end point at which a curve reaches a limit. GB_ARM_FREE where a shorter step is necessary to decide. Where the joint has no solver, or with the shortest
 * step, an end point is made. */
static size_t gb_arm_arrive(const gb_arm_model *model, const gb_arm_crossing *crossing, const gb_arm_piece *piece, const gb_arm_walk *walk,
                            gb_arm_ends *ends)
{
    gb_arm_point point;
    const bool is_last = piece->length <= GB_ARM_SHORTEST;
    const gb_real size = gb_arm_crossing_point(model, crossing, piece, walk->side, &point);
    if (size < R(0.0)) {
        return GB_ARM_FREE;
    }
    const size_t nearest = gb_arm_nearest_end(model, crossing, point.x, ends, R(0.25) * size + R(10.0) * GB_MERGING_JOINTS);
    if (nearest != GB_ARM_FREE) {
        gb_arm_end *end = &ends->list[nearest];
        const bool is_outward = -end->inward * gb_arm_dot(end->at.t, point.t) >= GB_ARM_ALIGNED;
        const bool is_certain = end->is_singular || model->frozen >= 0 || (is_outward && (-end->inward == walk->side || walk->is_unsure));
        if (is_certain || is_last) {
            end->is_unsure = end->is_unsure || !is_certain;
            return nearest;
        }
        return GB_ARM_FREE;
    }
    if (is_last || model->arm->given[crossing->joint] != GB_ARM_SOLVED) {
        return gb_arm_locate(model, crossing, &point, walk->side, ends);
    }
    return GB_ARM_FREE;
}

/* Removes solutions on a piece. */
static void gb_arm_pass(const gb_arm_search *search, const gb_arm_piece *piece)
{
    gb_arm_pass_seeds(search->seeds, search->model, piece);
    gb_arm_pass_ends(search->ends, search->model, piece);
}

/* What to do after a step: the trace is complete, a shorter step follows, or the next one. */
typedef enum { GB_ARM_COMPLETE, GB_ARM_SHORTER, GB_ARM_NEXT } gb_arm_verdict;

/* Decides where a piece leads; writes the trace if it is complete. */
static gb_arm_verdict gb_arm_judge(const gb_arm_search *search, const gb_arm_trace_start *start, gb_arm_walk *walk, const gb_arm_piece *piece,
                                   gb_arm_trace *trace)
{
    const gb_arm_model *model = search->model;
    gb_arm_crossing crossing = {0, 0, R(0.0)};
    if (!gb_arm_first_crossing(model, piece, start->tied, &crossing)) {
        return GB_ARM_NEXT;
    }
    const bool is_last = piece->length <= GB_ARM_SHORTEST;
    const size_t number = gb_arm_arrive(model, &crossing, piece, walk, search->ends);
    if (number != GB_ARM_FREE) {
        const gb_arm_end *end = &search->ends->list[number];
        const gb_arm_piece last = gb_arm_last_piece(model, &piece->from, &end->at, &piece->to);
        gb_arm_pass(search, &last);
        trace->stop = GB_ARM_AT_END;
        trace->end = number;
        trace->length += last.length;
        trace->is_unsure = walk->is_unsure || (is_last && end->is_unsure);
        return GB_ARM_COMPLETE;
    }
    if (is_last) {
        return GB_ARM_COMPLETE;
    }
    walk->pace = R(0.4) * gb_arm_min(piece->length, walk->pace);
    return GB_ARM_SHORTER;
}

/* Follows a curve. Solutions of the grid on it are removed. */
static gb_arm_trace gb_arm_follow(const gb_arm_search *search, const gb_arm_trace_start *start)
{
    gb_arm_walk walk = gb_arm_walk_from(&start->at, start->side, start->level);
    gb_arm_trace trace;
    gb_arm_piece piece, last;
    trace.stop = GB_ARM_LOST;
    trace.end = GB_ARM_FREE;
    trace.length = R(0.0);
    trace.is_unsure = true;
    for (int count = 0; count < GB_ARM_PIECES && gb_arm_next_piece(&walk, search->model, &piece); count++) {
        if (start->is_inside && count > 0 && gb_arm_closing(search->model, &piece, &start->at, &last)) {
            gb_arm_pass(search, &last);
            trace.stop = GB_ARM_AT_START;
            trace.length += last.length;
            trace.is_unsure = walk.is_unsure;
            break;
        }
        const gb_arm_verdict verdict = gb_arm_judge(search, start, &walk, &piece, &trace);
        if (verdict == GB_ARM_COMPLETE) {
            break;
        }
        if (verdict == GB_ARM_NEXT) {
            gb_arm_pass(search, &piece);
            trace.length += piece.length;
            gb_arm_go(&walk, &piece);
        }
    }
    gb_arm_copy(walk.at.x, trace.x);
    return trace;
}
