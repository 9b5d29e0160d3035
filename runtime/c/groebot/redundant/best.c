/* The best solution within limits by a criterion, over all arcs: see best.rs */

/* A sample on an arc. */
typedef struct {
    gb_real s;
    gb_real value;
} gb_arm_sample;

/* The two latest pieces of an arc, with the length before each. */
typedef struct {
    gb_arm_piece pieces[2];
    gb_real before[2];
    /* Whether samples are on the curve, and not only on the cubics. */
    bool is_exact;
} gb_arm_stretch;

/* Optima in descending order, and what is searched. */
typedef struct {
    const gb_arm_model *model;
    const gb_criterion *criterion;
    /* The greatest rate of the criterion along an arc. */
    gb_real rate;
    /* An upper bound of the criterion along the arc. */
    gb_real ceiling;
    /* The arc and its number. */
    const gb_arc *arc;
    size_t number;
    gb_optimum *out;
    size_t room;
    size_t count;
} gb_arm_sorted;

/* A difference of joint values in their own units. */
static gb_real gb_arm_change(const gb_arm_model *model, const gb_real *x, size_t joint, gb_real value)
{
    const gb_real d = x[joint] * model->units[joint] - value;
    return model->turns[joint] ? d - GB_TAU * gb_round(d / GB_TAU) : d;
}

/* The distance of a joint to its limits, relative to half the range if requested. */
GB_INLINE gb_real gb_arm_distance_to_limits(const gb_arm_model *model, const gb_real *x, size_t joint, bool is_relative)
{
    const gb_real low = model->limits[joint][0], high = model->limits[joint][1];
    const gb_real distance = gb_arm_min(x[joint] - low, high - x[joint]), half = R(0.5) * (high - low);
    const bool is_divided = is_relative && gb_magnitude(half) <= GB_GREATEST && half > R(0.0);
    return is_divided ? distance / half : distance;
}

/* The least distance to limits. */
static gb_real gb_arm_margin(const gb_arm_model *model, const gb_real *x, bool is_relative)
{
    gb_real least = (gb_real)INFINITY;
    for (size_t i = 0; i < model->count; i++) {
        if (!model->turns[i]) {
            least = gb_arm_min(least, gb_arm_distance_to_limits(model, x, i, is_relative));
        }
    }
    return least;
}

/* The value of a criterion at scaled joint values. */
static gb_real gb_arm_value(const gb_criterion *criterion, const gb_arm_model *model, const gb_real *x)
{
    gb_real sum = R(0.0);
    gb_arm_place place;
    switch (criterion->kind) {
    case GB_CRITERION_MARGIN:
        return gb_arm_margin(model, x, criterion->is_relative);
    case GB_CRITERION_NEAREST:
        for (size_t i = 0; i < model->count; i++) {
            const gb_real d = gb_arm_change(model, x, i, criterion->q0[i]);
            sum += criterion->weights[i] * d * d;
        }
        return -gb_square_root(sum);
    case GB_CRITERION_MANIPULABILITY:
        gb_arm_set_place(model, x, &place);
        return place.linear.volume;
    case GB_CRITERION_CHANGE:
        break;
    }
    return -gb_magnitude(gb_arm_change(model, x, criterion->joint, criterion->value));
}

/* The greatest rate of the value along an arc. */
static gb_real gb_arm_rate(const gb_criterion *criterion, const gb_arm_model *model)
{
    gb_real greatest = R(0.0);
    switch (criterion->kind) {
    case GB_CRITERION_MARGIN:
        return criterion->is_relative ? (gb_real)INFINITY : R(1.0);
    case GB_CRITERION_NEAREST:
        for (size_t i = 0; i < model->count; i++) {
            greatest = gb_arm_max(greatest, gb_square_root(criterion->weights[i]) * model->units[i]);
        }
        return greatest;
    case GB_CRITERION_MANIPULABILITY:
        return (gb_real)INFINITY;
    case GB_CRITERION_CHANGE:
        break;
    }
    return model->units[criterion->joint];
}

/* An upper bound of the value along an arc: a joint that is constant keeps its distance to the limits, and elsewhere the value changes with the rate. */
static gb_real gb_arm_ceiling(const gb_criterion *criterion, const gb_arm_model *model, const gb_arc *arc)
{
    gb_real start[GB_MOST_ARM_JOINTS], end[GB_MOST_ARM_JOINTS];
    gb_arm_scaled(model, arc->start.q, start);
    gb_arm_scaled(model, arc->end.q, end);
    const gb_real both = gb_arm_value(criterion, model, start) + gb_arm_value(criterion, model, end);
    const gb_real ceiling = R(0.5) * (both + gb_arm_rate(criterion, model) * (arc->length + GB_ARM_SAMPLED));
    const int constant = gb_arm_constant(model->arm);
    if (criterion->kind != GB_CRITERION_MARGIN || constant < 0 || model->turns[constant]) {
        return ceiling;
    }
    return gb_arm_min(ceiling, gb_arm_distance_to_limits(model, start, (size_t)constant, criterion->is_relative));
}

/* The piece at a length of the arc, and the share of its length. */
static const gb_arm_piece *gb_arm_stretch_piece(const gb_arm_stretch *stretch, gb_real s, gb_real *share)
{
    const int k = s > stretch->before[1] ? 1 : 0;
    const gb_arm_piece *piece = &stretch->pieces[k];
    *share = gb_arm_share(piece->length > R(0.0) ? (s - stretch->before[k]) / piece->length : R(0.0));
    return piece;
}

/* The point of the curve at a length of the arc. */
static gb_arm_point gb_arm_stretch_point(const gb_arm_stretch *stretch, const gb_arm_model *model, gb_real s)
{
    gb_real share;
    const gb_arm_piece *piece = gb_arm_stretch_piece(stretch, s, &share);
    return gb_arm_curve_point(model, piece, share);
}

/* The sample at a length of the arc: on the curve, or by the cubic of the piece. */
static gb_arm_sample gb_arm_sample_at(const gb_arm_sorted *list, const gb_arm_stretch *stretch, gb_real s)
{
    gb_arm_sample sample;
    gb_real x[GB_MOST_ARM_JOINTS], share;
    const gb_arm_piece *piece = gb_arm_stretch_piece(stretch, s, &share);
    if (stretch->is_exact) {
        gb_arm_curve_at(list->model, piece, share, x);
    } else {
        gb_arm_piece_at(piece, share, x);
    }
    sample.s = s;
    sample.value = gb_arm_value(list->criterion, list->model, x);
    return sample;
}

/* Whether an optimum with this value has room. */
static bool gb_arm_has_room(const gb_arm_sorted *list, gb_real value)
{
    return list->count < list->room || (list->count > 0 && value > list->out[list->count - 1].value);
}

/* Whether an optimum with at most this value may have room. Where the value is constant, as of a joint that is, rounding makes no optima. */
static bool gb_arm_may_have_room(const gb_arm_sorted *list, gb_real most)
{
    return gb_arm_has_room(list, gb_arm_min(most, list->ceiling) - GB_ACCEPTANCE_RESIDUAL);
}

static void gb_arm_insert(gb_arm_sorted *list, const gb_optimum *best)
{
    if (!gb_arm_has_room(list, best->value)) {
        return;
    }
    if (list->count < list->room) {
        list->count++;
    }
    size_t k = list->count - 1;
    for (; k > 0 && list->out[k - 1].value < best->value; k--) {
        list->out[k] = list->out[k - 1];
    }
    list->out[k] = *best;
}

/* The better sample; the first if they are equal. */
static gb_arm_sample gb_arm_better(gb_arm_sample a, gb_arm_sample b)
{
    return b.value > a.value ? b : a;
}

/* The optimum between two lengths, both ends included, by golden section search (J. Kiefer, Proc. AMS 4 (1953) 502-506). */
static gb_arm_sample gb_arm_golden(const gb_arm_sorted *list, const gb_arm_stretch *stretch, gb_real low, gb_real high, int count)
{
    const gb_arm_sample first = gb_arm_sample_at(list, stretch, low), last = gb_arm_sample_at(list, stretch, high);
    gb_arm_sample a = gb_arm_sample_at(list, stretch, high - GB_ARM_GOLDEN * (high - low));
    gb_arm_sample b = gb_arm_sample_at(list, stretch, low + GB_ARM_GOLDEN * (high - low));
    for (int k = 0; k < count; k++) {
        if (a.value >= b.value) {
            high = b.s;
            b = a;
            a = gb_arm_sample_at(list, stretch, high - GB_ARM_GOLDEN * (high - low));
        } else {
            low = a.s;
            a = b;
            b = gb_arm_sample_at(list, stretch, low + GB_ARM_GOLDEN * (high - low));
        }
    }
    return gb_arm_better(gb_arm_better(gb_arm_better(first, last), a), b);
}

/* The optimum between two lengths: on the cubics of the pieces first, and then on the cubic between two points of the curve that are close to it. Writes its
 * joint values and returns its length. */
static gb_real gb_arm_optimum(const gb_arm_sorted *list, const gb_arm_stretch *stretch, gb_real low, gb_real high, gb_real *x)
{
    const gb_real width = GB_ARM_CLOSE_OPTIMUM * (high - low);
    gb_real s = gb_arm_golden(list, stretch, low, high, GB_ARM_COARSE).s;
    for (int k = 0; k < GB_ARM_MOVES; k++) {
        const gb_real from = gb_arm_max(low, s - width), to = gb_arm_min(high, s + width);
        const gb_arm_point first = gb_arm_stretch_point(stretch, list->model, from), second = gb_arm_stretch_point(stretch, list->model, to);
        gb_real share;
        gb_arm_stretch close;
        close.pieces[0] = close.pieces[1] = gb_arm_piece_of(&first, &second);
        close.before[0] = close.before[1] = from;
        close.is_exact = false;
        const gb_real last = from + close.pieces[0].length;
        s = gb_arm_golden(list, &close, from, last, GB_ARM_FINE).s;
        gb_arm_point top = gb_arm_stretch_point(&close, list->model, s);
        const gb_arm_piece *piece = gb_arm_stretch_piece(&close, s, &share);
        gb_arm_piece_at(piece, share, x);
        if (gb_arm_distance(list->model, top.x, x) > GB_MERGING_JOINTS) {
            /* Next to a singular point the curve is no cubic. */
            close = *stretch;
            close.is_exact = true;
            s = gb_arm_golden(list, &close, low, high, GB_ARM_FINE).s;
            top = gb_arm_stretch_point(stretch, list->model, s);
            gb_arm_copy(top.x, x);
            break;
        }
        gb_arm_copy(top.x, x);
        if ((s > from && s < last) || (s == from && from == low) || (s == last && to == high)) {
            break;
        }
    }
    return s;
}

/* Adds the optimum between two lengths, compared with the end of the arc if this is the last search on it, else `end` is NULL. */
static void gb_arm_refine(gb_arm_sorted *list, const gb_arm_stretch *stretch, gb_real low, gb_real high, const gb_arm_sample *end)
{
    gb_real x[GB_MOST_ARM_JOINTS], away[GB_MOST_ARM_JOINTS];
    const gb_real s = gb_arm_optimum(list, stretch, low, high, x), value = gb_arm_value(list->criterion, list->model, x);
    gb_optimum best;
    best.arc = list->number;
    gb_arm_copy(x, away);
    if (end && (end->value >= value || gb_arm_lift(list->model, away) != 0)) {
        /* Lengths are not exact: the search may not reach the very end, or pass it, beyond a limit. */
        gb_arm_copy(list->arc->end.q, best.q);
        best.value = end->value;
        best.s = end->s;
        gb_arm_insert(list, &best);
        return;
    }
    if (gb_arm_has_room(list, value)) {
        /* The length on the pieces of the arc. */
        const gb_arm_point point = gb_arm_stretch_point(stretch, list->model, s);
        gb_arm_plus(x, R(-1.0), point.x, away);
        best.s = gb_arm_min(gb_arm_max(s + gb_arm_dot(away, point.t), low), high);
        gb_arm_unscaled(list->model, x, best.q);
        best.value = value;
        gb_arm_insert(list, &best);
    }
}

/* The samples of the latest piece; `before` and `middle` are the last two. */
static void gb_arm_sample_piece(gb_arm_sorted *list, const gb_arm_journey *journey, const gb_arm_stretch *stretch, gb_arm_sample *before,
                                gb_arm_sample *middle)
{
    const gb_real length = list->arc->length;
    for (int k = 1; k <= GB_ARM_SAMPLES; k++) {
        const gb_real share = (gb_real)k / (gb_real)GB_ARM_SAMPLES;
        gb_real x[GB_MOST_ARM_JOINTS];
        gb_arm_sample sample;
        sample.s = gb_arm_min(journey->before + share * journey->piece.length, length);
        gb_arm_piece_at(&journey->piece, gb_arm_share_at(journey, sample.s), x);
        sample.value = gb_arm_value(list->criterion, list->model, x);
        const gb_real most = middle->value + list->rate * (sample.s - before->s + GB_ARM_SAMPLED);
        if (middle->value >= before->value && middle->value > sample.value && gb_arm_may_have_room(list, most)) {
            gb_arm_refine(list, stretch, before->s, sample.s, NULL);
        }
        *before = *middle;
        *middle = sample;
        if (sample.s >= length) {
            break;
        }
    }
}

/* The optima on one arc. */
static void gb_arm_optima_along(gb_arm_sorted *list, gb_arm_model *model)
{
    gb_real x[GB_MOST_ARM_JOINTS];
    gb_arm_journey journey;
    gb_arm_stretch stretch;
    gb_arm_sample before = {R(0.0), -(gb_real)INFINITY}, middle = {R(0.0), R(0.0)};
    gb_arm_scaled(model, list->arc->start.q, x);
    middle.value = gb_arm_value(list->criterion, model, x);
    gb_arm_set_out(&journey, model, list->arc);
    stretch.pieces[0] = stretch.pieces[1] = journey.piece;
    stretch.before[0] = stretch.before[1] = R(0.0);
    stretch.is_exact = false;
    while (gb_arm_travel(&journey, model, list->arc)) {
        stretch.pieces[0] = stretch.pieces[1];
        stretch.pieces[1] = journey.piece;
        stretch.before[0] = stretch.before[1];
        stretch.before[1] = journey.before;
        gb_arm_sample_piece(list, &journey, &stretch, &before, &middle);
    }
    gb_arm_scaled(model, list->arc->end.q, x);
    const gb_arm_sample end = {list->arc->length, gb_arm_value(list->criterion, model, x)};
    const gb_real most = gb_arm_max(end.value, middle.value + list->rate * (middle.s - before.s + GB_ARM_SAMPLED));
    if (middle.value >= before.value && gb_arm_may_have_room(list, most)) {
        gb_arm_refine(list, &stretch, before.s, middle.s, &end);
    }
}

GB_LINKAGE int gb_optima(const gb_arm *arm, const gb_real *target, const gb_real *limits, const gb_arc *arcs, size_t count,
                         const gb_criterion *criterion, gb_optimum *out, size_t room)
{
    gb_arm_model model;
    gb_arm_sorted list = {&model, criterion, R(0.0), R(0.0), arcs, 0, out, room, 0};
    gb_real highest = -(gb_real)INFINITY;
    size_t first = 0;
    const int code = gb_arm_set_model(&model, arm, target, limits);
    if (code < 0) {
        return code;
    }
    list.rate = gb_arm_rate(criterion, &model);
    for (size_t k = 0; k < count; k++) {
        const gb_real ceiling = gb_arm_ceiling(criterion, &model, &arcs[k]);
        first = ceiling > highest ? k : first;
        highest = gb_arm_max(highest, ceiling);
    }
    /* The most promising arc comes first, so that others need not be searched. */
    for (size_t k = 0; k < count; k++) {
        list.number = k == 0 ? first : k <= first ? k - 1 : k;
        list.arc = &arcs[list.number];
        list.ceiling = gb_arm_ceiling(criterion, &model, list.arc);
        if (gb_arm_may_have_room(&list, list.ceiling)) {
            gb_arm_optima_along(&list, &model);
        }
    }
    return (int)list.count;
}

GB_LINKAGE int gb_best(const gb_arm *arm, const gb_real *target, const gb_real *limits, const gb_arc *arcs, size_t count,
                       const gb_criterion *criterion, gb_optimum *best)
{
    return gb_optima(arm, target, limits, arcs, count, criterion, best, 1);
}
