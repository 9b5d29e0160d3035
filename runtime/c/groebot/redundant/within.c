/* One solution within limits: see within.rs */

/* Solves the problem with a joint given. Returns 1 and writes the first solution within limits if there is one, else 0, or a code below 0. */
static int gb_arm_first_within(const gb_arm_scan *scan, size_t joint, gb_real value, gb_real *q)
{
    const gb_arm_model *model = scan->model;
    gb_arm_members members;
    const int code = gb_arm_solve(scan->robot, scan->target, joint, value * model->units[joint], &members);
    if (code < 0) {
        return code;
    }
    for (size_t k = 0; k < members.count; k++) {
        gb_real x[GB_MOST_ARM_JOINTS];
        gb_arm_scaled(model, members.list[k].q, x);
        x[joint] = value;
        const uint32_t joints = gb_arm_lift(model, x);
        if (joints == 0) {
            gb_arm_unscaled(model, x, q);
            return 1;
        }
        gb_arm_pass_beyond(scan->beyond, model, x, joints);
    }
    return 0;
}

/* Tries a few values of the scanned joint, then the limits of all joints. */
static int gb_arm_try(const gb_arm_scan *scan, const gb_real *range, gb_real *q)
{
    const gb_arm_model *model = scan->model;
    const gb_arm *arm = model->arm;
    int found = 0;
    for (int k = 0; k < GB_ARM_TRIED && found == 0; k++) {
        found = gb_arm_first_within(scan, arm->scanned, range[0] + gb_arm_tried[k] * (range[1] - range[0]), q);
    }
    for (size_t joint = 0; joint < model->count; joint++) {
        for (int side = 0; side < 2 && found == 0; side++) {
            const gb_real limit = model->limits[joint][side];
            if (!model->turns[joint] && arm->given[joint] == GB_ARM_SOLVED && gb_magnitude(limit) <= GB_GREATEST) {
                found = gb_arm_first_within(scan, joint, limit, q);
            }
        }
    }
    return found;
}

/* Decides whether there are solutions beyond the limits of the scanned joint. */
static int gb_arm_try_around(const gb_arm_scan *scan, const gb_real *range)
{
    const gb_arm *arm = scan->model->arm;
    gb_real q[GB_MOST_ARM_JOINTS];
    int code = 0;
    for (int k = 0; k < GB_ARM_AROUND && code >= 0; k++) {
        const gb_real share = ((gb_real)k + R(0.5)) / (gb_real)GB_ARM_AROUND;
        const gb_real value =
            arm->slides[arm->scanned] ? range[0] + (R(3.0) * share - R(1.0)) * (range[1] - range[0]) : GB_TAU * share - GB_PI;
        code = gb_arm_first_within(scan, arm->scanned, value, q);
    }
    return code < 0 ? code : 0;
}

/* A solution on an arc, or the reason why there is none. */
static int gb_arm_search_within(const gb_arm_scan *scan, const gb_real *limits, const gb_real *range, gb_within *within)
{
    gb_arc arc;
    gb_arcs_outcome outcome;
    int code = gb_arcs(scan->robot, scan->target, limits, &arc, 1, &outcome);
    if (code < 0) {
        return code;
    }
    if (outcome.count > 0) {
        gb_arm_copy(arc.start.q, within->q);
        within->is_found = within->is_reachable = true;
        return 1;
    }
    if (!outcome.is_reachable) {
        code = gb_arm_try_around(scan, range);
    }
    if (code < 0) {
        return code;
    }
    within->is_unsure = outcome.is_unsure;
    within->is_reachable = outcome.is_reachable || scan->beyond->is_reachable;
    within->beyond = outcome.is_reachable ? outcome.beyond : scan->beyond->is_reachable ? scan->beyond->joints : 0;
    return 0;
}

GB_LINKAGE int gb_any_within(const gb_redundant *robot, const gb_real *target, const gb_real *limits, gb_within *within)
{
    gb_arm_model model;
    gb_arm_beyond beyond = gb_arm_no_beyond;
    gb_within found;
    gb_real range[2];
    const gb_arm_scan scan = {robot, &model, target, &beyond, NULL};
    int code = gb_arm_set_model(&model, robot->arm, target, limits);
    if (code < 0) {
        return code;
    }
    memset(&found, 0, sizeof found);
    gb_arm_range(&model, robot->arm->scanned, range);
    code = gb_arm_try(&scan, range, found.q);
    found.is_found = found.is_reachable = code > 0;
    if (code == 0) {
        code = gb_arm_search_within(&scan, limits, range, &found);
    }
    if (code >= 0) {
        *within = found;
    }
    return code;
}
