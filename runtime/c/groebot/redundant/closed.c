/* Closed curves and surfaces, and all arcs: see arcs.rs */

/* The outcome where solutions are surfaces. */
GB_COLD static void gb_arm_surface(const gb_arm_search *search, gb_arm_output *output, gb_arcs_outcome *outcome)
{
    const gb_arm_seeds *seeds = search->seeds;
    const gb_arm_ends *ends = search->ends;
    const gb_real *x = seeds->has_surface ? seeds->surface : gb_arm_first_seed(seeds);
    if (!x && ends->count > 0) {
        x = ends->list[0].at.x;
    }
    if (x) {
        gb_arc arc = gb_arm_arc_at(search->model, x);
        arc.is_unsure = true;
        gb_arm_push(output, &arc);
    }
    outcome->count = output->count;
    outcome->ends = 0;
    outcome->is_unsure = true;
    outcome->closed = 0;
    outcome->is_grid_only = false;
    outcome->is_surface = true;
    outcome->is_reachable = true;
    outcome->beyond = output->count == 0 ? ends->beyond.joints : 0;
}

/* Traces the curve through a solution. If it leads to an end point of a known arc, the solution is on that arc. Returns whether it is closed and not known. */
static bool gb_arm_search_from(const gb_arm_search *search, const gb_real *x, uint32_t tied, gb_arm_output *output)
{
    const gb_arm_model *model = search->model;
    const gb_arm_ends *ends = search->ends;
    const size_t count = ends->count;
    gb_arm_place place;
    gb_real bend[GB_MOST_ARM_JOINTS];
    gb_arm_set_bent(model, x, &place, bend);
    const gb_arm_trace_start start = {gb_arm_point_of(&place, R(1.0), bend), R(1.0), tied, 0, true};
    const gb_arm_trace traced = gb_arm_follow(search, &start);
    gb_arc arc = gb_arm_arc_at(model, x);
    arc.tied = tied;
    arc.is_frozen = model->frozen >= 0;
    if (traced.stop == GB_ARM_AT_START) {
        arc.length = traced.length;
        arc.is_closed = true;
        /* Of singular equations, no direction is known: the solutions may be a surface. */
        arc.is_unsure = traced.is_unsure || place.linear.pivot <= GB_PIVOTS_REGULAR;
        gb_arm_push(output, &arc);
        return true;
    }
    if (traced.stop == GB_ARM_LOST) {
        output->is_unsure = true;
        if (output->count == 0) {
            arc.is_unsure = true;
            gb_arm_push(output, &arc);
        }
        return false;
    }
    if (traced.end >= count) {
        /* The limit of a joint without a solver. */
        gb_arm_pair(search);
        for (size_t k = count; k < ends->count; k++) {
            gb_arm_push_end(model, ends, k, output);
        }
    }
    return false;
}

/* Traces curves from the solutions that are on no arc. Returns the number of closed ones. */
static size_t gb_arm_search_closed(const gb_arm_search *search, gb_arm_output *output)
{
    gb_arm_ends *ends = search->ends;
    gb_real x[GB_MOST_ARM_JOINTS];
    size_t closed = 0;
    while (ends->touches > 0) {
        const gb_arm_touch touch = ends->touching[--ends->touches];
        closed += gb_arm_search_from(search, touch.x, touch.tied, output) ? 1 : 0;
    }
    while (gb_arm_take_seed(search->seeds, x)) {
        closed += gb_arm_search_from(search, x, gb_arm_tied_at(search->model, x), output) ? 1 : 0;
    }
    return closed;
}

/* Finds end points and solutions, and writes arcs. */
static int gb_arm_find_arcs(const gb_redundant *robot, const gb_real *target, gb_arm_model *model, gb_arm_output *output, gb_arcs_outcome *outcome)
{
    gb_arm_ends ends;
    gb_arm_seeds seeds;
    ends.count = ends.touches = 0;
    ends.is_unsure = false;
    ends.beyond = gb_arm_no_beyond;
    seeds.added = seeds.values = seeds.surfaces = 0;
    seeds.is_unsure = seeds.has_surface = false;
    const gb_arm_scan scan = {robot, model, target, &ends.beyond, &ends};
    const gb_arm_search search = {model, &ends, &seeds};
    int code = gb_arm_find_ends(&ends, robot, model, target);
    if (code == 0) {
        code = gb_arm_find_seeds(&seeds, &scan);
    }
    if (code == 0 && !ends.beyond.is_reachable) {
        gb_arm_approach_all(&seeds, model, &ends.beyond);
    }
    if (code < 0) {
        return code;
    }
    if (seeds.surfaces > 1) {
        gb_arm_surface(&search, output, outcome);
        return 0;
    }
    gb_arm_freeze(model, &ends, &seeds);
    gb_arm_pair(&search);
    const size_t count = ends.count;
    for (size_t k = 0; k < count; k++) {
        gb_arm_push_end(model, &ends, k, output);
    }
    outcome->closed = gb_arm_search_closed(&search, output);
    outcome->is_grid_only = true;
    outcome->count = output->count;
    outcome->ends = ends.count;
    outcome->is_unsure = output->is_unsure || ends.is_unsure || seeds.is_unsure;
    outcome->is_surface = false;
    outcome->is_reachable = ends.beyond.is_reachable;
    outcome->beyond = output->count == 0 ? ends.beyond.joints : 0;
    return 0;
}

GB_LINKAGE int gb_arcs(const gb_redundant *robot, const gb_real *target, const gb_real *limits, gb_arc *out, size_t room, gb_arcs_outcome *outcome)
{
    gb_arm_model model;
    gb_arm_output output = {out, room, 0, false};
    const int code = gb_arm_set_model(&model, robot->arm, target, limits);
    return code < 0 ? code : gb_arm_find_arcs(robot, target, &model, &output, outcome);
}
