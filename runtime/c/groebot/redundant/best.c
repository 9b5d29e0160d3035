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
} gb_arm_stretch;

/* Optima in descending order, and what is searched. */
typedef struct {
    const gb_arm_model *model;
    const gb_criterion *criterion;
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

/* The least distance to limits, relative to half the range if requested. */
static gb_real gb_arm_margin(const gb_arm_model *model, const gb_real *x, bool is_relative)
{
    gb_real least = (gb_real)INFINITY;
    for (size_t i = 0; i < model->count; i++) {
        const gb_real low = model->limits[i][0], high = model->limits[i][1];
        if (!model->turns[i]) {
            const gb_real distance = gb_arm_min(x[i] - low, high - x[i]), half = R(0.5) * (high - low);
            const bool is_divided = is_relative && gb_magnitude(half) <= GB_GREATEST && half > R(0.0);
            least = gb_arm_min(least, is_divided ? distance / half : distance);
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

/* Joint values at a length of the arc. */
static void gb_arm_stretch_at(const gb_arm_stretch *stretch, const gb_arm_model *model, gb_real s, gb_real *x)
{
    const int k = s > stretch->before[1] ? 1 : 0;
    const gb_arm_piece *piece = &stretch->pieces[k];
    const gb_real share = piece->length > R(0.0) ? (s - stretch->before[k]) / piece->length : R(0.0);
    gb_arm_curve_at(model, piece, gb_arm_share(share), x);
}

/* The sample at a length of the arc. */
static gb_arm_sample gb_arm_sample_at(const gb_arm_sorted *list, const gb_arm_stretch *stretch, gb_real s)
{
    gb_arm_sample sample;
    gb_real x[GB_MOST_ARM_JOINTS];
    gb_arm_stretch_at(stretch, list->model, s, x);
    sample.s = s;
    sample.value = gb_arm_value(list->criterion, list->model, x);
    return sample;
}

/* Whether an optimum with this value has room. */
static bool gb_arm_has_room(const gb_arm_sorted *list, gb_real value)
{
    return list->count < list->room || (list->count > 0 && value > list->out[list->count - 1].value);
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

/* The optimum between two lengths, by golden section search (J. Kiefer, Proc. AMS 4 (1953) 502-506) and comparison with both ends. */
static gb_arm_sample gb_arm_section(const gb_arm_sorted *list, const gb_arm_stretch *stretch, gb_real low, gb_real high)
{
    const gb_arm_sample first = gb_arm_sample_at(list, stretch, low), last = gb_arm_sample_at(list, stretch, high);
    gb_arm_sample a = gb_arm_sample_at(list, stretch, high - GB_ARM_GOLDEN * (high - low));
    gb_arm_sample b = gb_arm_sample_at(list, stretch, low + GB_ARM_GOLDEN * (high - low));
    for (int k = 0; k < GB_ARM_SECTIONS; k++) {
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

/* Adds the optimum between two lengths, compared with the end of the arc if this is the last search on it. */
static void gb_arm_refine(gb_arm_sorted *list, const gb_arm_stretch *stretch, gb_real low, gb_real high, bool is_last)
{
    const gb_arm_sample top = gb_arm_section(list, stretch, low, high);
    gb_optimum best;
    gb_real x[GB_MOST_ARM_JOINTS];
    best.arc = list->number;
    if (is_last) {
        /* Lengths are not exact: the search may not reach the very end, or pass it, beyond a limit. */
        gb_arm_stretch_at(stretch, list->model, top.s, x);
        const bool is_beyond = gb_arm_lift(list->model, x) != 0;
        gb_arm_scaled(list->model, list->arc->end.q, x);
        best.value = gb_arm_value(list->criterion, list->model, x);
        if (best.value >= top.value || is_beyond) {
            gb_arm_copy(list->arc->end.q, best.q);
            best.s = list->arc->length;
            gb_arm_insert(list, &best);
            return;
        }
    }
    if (gb_arm_has_room(list, top.value)) {
        gb_arm_stretch_at(stretch, list->model, top.s, x);
        gb_arm_unscaled(list->model, x, best.q);
        best.value = top.value;
        best.s = top.s;
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
        if (middle->value >= before->value && middle->value > sample.value) {
            gb_arm_refine(list, stretch, before->s, sample.s, false);
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
    gb_arm_point home;
    gb_arm_journey journey;
    gb_arm_stretch stretch;
    gb_arm_sample before = {R(0.0), -(gb_real)INFINITY}, middle = {R(0.0), R(0.0)};
    memset(&home, 0, sizeof home);
    gb_arm_scaled(model, list->arc->start.q, home.x);
    middle.value = gb_arm_value(list->criterion, model, home.x);
    gb_arm_set_out(&journey, model, list->arc);
    stretch.pieces[0] = stretch.pieces[1] = gb_arm_piece_of(&home, &home);
    stretch.before[0] = stretch.before[1] = R(0.0);
    while (gb_arm_travel(&journey, model, list->arc)) {
        stretch.pieces[0] = stretch.pieces[1];
        stretch.pieces[1] = journey.piece;
        stretch.before[0] = stretch.before[1];
        stretch.before[1] = journey.before;
        gb_arm_sample_piece(list, &journey, &stretch, &before, &middle);
    }
    if (middle.value >= before.value) {
        gb_arm_refine(list, &stretch, before.s, middle.s, true);
    }
}

GB_LINKAGE int gb_optima(const gb_arm *arm, const gb_real *target, const gb_real *limits, const gb_arc *arcs, size_t count,
                         const gb_criterion *criterion, gb_optimum *out, size_t room)
{
    gb_arm_model model;
    gb_arm_sorted list = {&model, criterion, arcs, 0, out, room, 0};
    const int code = gb_arm_set_model(&model, arm, target, limits);
    if (code < 0) {
        return code;
    }
    for (; list.number < count; list.number++) {
        list.arc = &arcs[list.number];
        gb_arm_optima_along(&list, &model);
    }
    return (int)list.count;
}

GB_LINKAGE int gb_best(const gb_arm *arm, const gb_real *target, const gb_real *limits, const gb_arc *arcs, size_t count,
                       const gb_criterion *criterion, gb_optimum *best)
{
    return gb_optima(arm, target, limits, arcs, count, criterion, best, 1);
}
