/* Joint values and arcs that differ by whole turns: see turns.rs */

/* The turns of a joint within limits: their number, and the first one. */
static size_t gb_arm_turns(const gb_arm *arm, const gb_real *limits, const gb_arm_span *span, size_t joint, gb_real *first)
{
    gb_real last;
    *first = R(0.0);
    if (arm->slides[joint]) {
        return 1;
    }
    *first = gb_ceiling((limits[2 * joint] - GB_ACCEPTANCE_INPUT - span->low[joint]) / GB_TAU);
    last = gb_floor((limits[2 * joint + 1] + GB_ACCEPTANCE_INPUT - span->high[joint]) / GB_TAU);
    if (!(*first <= last)) {
        *first = R(0.0);
        return 0;
    }
    if (gb_magnitude(*first) > GB_GREATEST || gb_magnitude(last) > GB_GREATEST) {
        *first = last = gb_arm_min(gb_arm_max(R(0.0), *first), last) + R(0.0);
    }
    last = gb_arm_min(last, *first + (gb_real)GB_MOST_TURNS);
    return (size_t)(last - *first) + 1;
}

GB_LINKAGE size_t gb_span_turns(const gb_arm *arm, const gb_real *limits, const gb_arm_span *span)
{
    gb_real count = R(1.0), first;
    for (size_t joint = 0; joint < arm->count; joint++) {
        count = gb_arm_min(count * (gb_real)gb_arm_turns(arm, limits, span, joint, &first), (gb_real)GB_MOST_TURNS);
    }
    return (size_t)count;
}

GB_LINKAGE void gb_span_turn(const gb_arm *arm, const gb_real *limits, const gb_arm_span *span, size_t index, gb_real *start)
{
    gb_arm_copy(span->start, start);
    for (size_t joint = arm->count; joint-- > 0;) {
        gb_real first;
        const size_t turns = gb_arm_turns(arm, limits, span, joint, &first), count = turns > 0 ? turns : 1;
        if (!arm->slides[joint]) {
            start[joint] += GB_TAU * (first + (gb_real)(index % count));
        }
        index /= count;
    }
}

static void gb_arm_extend(gb_arm_span *span, size_t joint, gb_real value)
{
    span->low[joint] = gb_arm_min(span->low[joint], value);
    span->high[joint] = gb_arm_max(span->high[joint], value);
}

/* Extends the span to the extrema of the joints' cubics on the present piece before a share of its length. Writes the values at the end of the piece. */
static void gb_arm_extend_by_piece(gb_arm_span *span, const gb_arm_model *model, const gb_arm_journey *journey, gb_real end, gb_real *last)
{
    for (size_t joint = 0; joint < model->count; joint++) {
        gb_real c[3], shares[3], x[GB_MOST_ARM_JOINTS];
        gb_arm_cubic(&journey->piece, joint, c);
        gb_arm_extrema(c[2], c[1], c[0], shares);
        for (int k = 0; k < 2; k++) {
            if (shares[k] > R(0.0) && shares[k] < end) {
                gb_arm_curve_at(model, &journey->piece, shares[k], x);
                gb_arm_extend(span, joint, x[joint] * model->units[joint]);
            }
        }
        last[joint] = journey->piece.to.x[joint] * model->units[joint];
        if (end == R(1.0)) {
            gb_arm_extend(span, joint, last[joint]);
        }
    }
}

GB_LINKAGE int gb_arc_span(const gb_arm *arm, const gb_real *target, const gb_real *limits, const gb_arc *arc, gb_arm_span *span)
{
    gb_arm_model model;
    gb_arm_journey journey;
    gb_real last[GB_MOST_ARM_JOINTS], turns[GB_MOST_ARM_JOINTS];
    const int code = gb_arm_set_model(&model, arm, target, limits);
    if (code < 0) {
        return code;
    }
    gb_arm_copy(arc->start.q, span->start);
    gb_arm_copy(arc->start.q, span->low);
    gb_arm_copy(arc->start.q, span->high);
    gb_arm_copy(arc->start.q, last);
    gb_arm_set_out(&journey, &model, arc);
    while (gb_arm_travel(&journey, &model, arc)) {
        gb_arm_extend_by_piece(span, &model, &journey, gb_arm_share_at(&journey, arc->length), last);
    }
    gb_arm_turns_to(arm, last, arc->end.q, turns);
    for (size_t joint = 0; joint < model.count; joint++) {
        gb_arm_extend(span, joint, arc->end.q[joint] + turns[joint]);
    }
    return 0;
}
