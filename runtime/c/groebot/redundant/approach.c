/* Solutions of targets next to the boundary of the workspace: see approach.rs */

/* The start with this number. */
static void gb_arm_set_start(const gb_arm_model *model, int number, gb_real *x)
{
    gb_arm_copy(gb_arm_still, x);
    for (size_t i = 0; i < model->count; i++) {
        const gb_real most = model->arm->slides[i] ? GB_ARM_FARTHEST : GB_PI;
        const gb_real low = gb_arm_max(model->limits[i][0], -most), high = gb_arm_min(model->limits[i][1], most);
        const gb_real share = R(0.5) + (gb_real)number * (GB_ARM_GOLDEN + GB_ARM_STRIDE * (gb_real)i);
        x[i] = low + (share - gb_floor(share)) * (high - low);
    }
}

static gb_real gb_arm_size(const gb_real *values, size_t rows)
{
    gb_real sum = R(0.0);
    for (size_t r = 0; r < rows; r++) {
        sum += values[r] * values[r];
    }
    return gb_square_root(sum);
}

/* One step to a point where the equations' values are less. Writes it, and returns their size. -1 if there is none. */
static gb_real gb_arm_approach_by_step(const gb_arm_model *model, gb_arm_place *place, gb_real left)
{
    gb_real step[GB_MOST_ARM_JOINTS], x[GB_MOST_ARM_JOINTS];
    gb_arm_least(&place->linear, place->values, step);
    const gb_real length = gb_arm_norm(step);
    gb_real share = length > GB_ARM_APPROACH ? GB_ARM_APPROACH / length : R(1.0);
    const bool is_known = length <= GB_ARM_SINGULAR;
    for (int k = 0; is_known && k < GB_ARM_APPROACH_HALVINGS; k++) {
        gb_arm_place next;
        gb_arm_plus(place->x, -share, step, x);
        gb_arm_set_place(model, x, &next);
        const gb_real after = gb_arm_size(next.values, gb_arm_rows_of(&model->goal));
        if (after < left) {
            *place = next;
            return after;
        }
        share *= R(0.5);
    }
    return R(-1.0);
}

/* A solution, within limits or not, by Newton's method with least steps from a start within limits. A step is halved until the equations' values decrease.
 * False where that fails. */
static bool gb_arm_approach(const gb_arm_model *model, int number, gb_real *x)
{
    gb_arm_place place;
    gb_arm_set_start(model, number, x);
    gb_arm_set_place(model, x, &place);
    gb_real left = gb_arm_size(place.values, gb_arm_rows_of(&model->goal));
    for (int k = 0; k < GB_ARM_APPROACH_STEPS && left >= R(0.0); k++) {
        if (left <= GB_ACCEPTANCE_RESIDUAL) {
            for (size_t i = 0; i < GB_MOST_ARM_JOINTS; i++) {
                const bool is_angle = i < model->count && !model->arm->slides[i];
                x[i] = place.x[i] - (is_angle ? GB_TAU * gb_round(place.x[i] / GB_TAU) : R(0.0));
            }
            return gb_arm_reaches(model, x);
        }
        left = gb_arm_approach_by_step(model, &place, left);
    }
    return false;
}

/* Searches solutions by Newton's method, where there is none for any value of a joint. */
GB_COLD static void gb_arm_approach_all(gb_arm_seeds *seeds, const gb_arm_model *model, gb_arm_beyond *beyond)
{
    for (int number = 0; number < GB_ARM_STARTS; number++) {
        gb_real *x = seeds->list[seeds->added];
        if (!gb_arm_approach(model, number, x)) {
            continue;
        }
        const uint32_t joints = gb_arm_lift(model, x);
        gb_arm_pass_beyond(beyond, model, x, joints);
        if (joints == 0) {
            gb_arm_group *group = &seeds->groups[seeds->values++];
            group->joint = model->arm->grid;
            group->value = x[group->joint];
            group->first = seeds->added++;
            group->count = 1;
        }
    }
}
