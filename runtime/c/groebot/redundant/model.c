/* Kinematics of an arm, and the equations of a target: see model.rs */

/* An arm and a target. Joint values `x` are scaled: a length is relative to the arm's length, which all lengths are. */
typedef struct {
    const gb_arm *arm;
    size_t count;
    gb_arm_links links;
    gb_arm_goal goal;
    /* Limits of the scaled values, as given. */
    gb_real limits[GB_MOST_ARM_JOINTS][2];
    /* Whether a joint is revolute and its range is at least one turn: its limits are reached by no curve, and values are compared up to whole turns. */
    bool turns[GB_MOST_ARM_JOINTS];
    /* The unit of the scaled values: 1 for an angle. */
    gb_real units[GB_MOST_ARM_JOINTS];
    /* A joint that is constant along the curve, where the equations are singular along the whole curve with this joint, and regular without it; or -1. */
    int frozen;
} gb_arm_model;

/* The equations at joint values. */
typedef struct {
    gb_real x[GB_MOST_ARM_JOINTS];
    gb_real values[GB_ARM_ROWS];
    gb_arm_elimination linear;
} gb_arm_place;

/* Returns 0, or GB_NOT_LIMITS. */
static int gb_arm_set_model(gb_arm_model *model, const gb_arm *arm, const gb_real *target, const gb_real *limits)
{
    model->arm = arm;
    model->count = arm->count;
    model->frozen = -1;
    gb_arm_set_links(&model->links, arm);
    gb_arm_set_goal(&model->goal, arm, target);
    for (size_t i = 0; i < arm->count; i++) {
        const gb_real low = limits[2 * i], high = limits[2 * i + 1];
        const bool is_ordered = low <= high;
        if (!is_ordered) {
            return GB_NOT_LIMITS;
        }
        model->turns[i] = !arm->slides[i] && high - low >= GB_TAU - GB_ACCEPTANCE_INPUT;
        model->units[i] = arm->slides[i] ? arm->length : R(1.0);
        model->limits[i][0] = low / model->units[i];
        model->limits[i][1] = high / model->units[i];
    }
    return 0;
}

/* The second derivatives of the equations where the joints move with constant rates `t`. */
static void gb_arm_second(const gb_arm_model *model, const gb_arm_axes *axes, gb_real (*images)[3], const gb_real *t, gb_real *second)
{
    gb_real velocity[3] = {R(0.0), R(0.0), R(0.0)}, angular[3] = {R(0.0), R(0.0), R(0.0)}, linear[3] = {R(0.0), R(0.0), R(0.0)};
    for (size_t i = 0; i < model->count; i++) {
        gb_real motion[3], product[3], r[3];
        gb_arm_scale(axes->directions[i], t[i], motion);
        gb_six_cross(velocity, motion, product);
        if (model->arm->slides[i]) {
            gb_arm_scale(product, R(2.0), product);
            gb_arm_add(linear, product, linear);
        } else {
            gb_arm_add(angular, product, angular);
            gb_arm_add(velocity, motion, velocity);
        }
        gb_arm_sub(i + 1 < model->count ? axes->points[i + 1] : axes->tip.translation, axes->points[i], r);
        gb_arm_carried(r, angular, velocity, product);
        gb_arm_add(linear, product, linear);
    }
    gb_arm_rates(&model->goal, images, linear, angular, second);
    gb_arm_add_centripetal(&model->goal, images, velocity, second);
}

/* The factors of the equations' derivatives. */
GB_INLINE void gb_arm_set_factors(const gb_arm_model *model, const gb_arm_axes *axes, gb_real (*images)[3], gb_arm_elimination *linear)
{
    static const gb_real still[3] = {R(0.0), R(0.0), R(0.0)};
    for (size_t i = 0; i < model->count; i++) {
        const gb_real *axis = axes->directions[i];
        if (model->arm->slides[i]) {
            gb_arm_rates(&model->goal, images, axis, still, linear->columns[i]);
        } else {
            gb_real lever[3], moved[3];
            gb_arm_sub(axes->tip.translation, axes->points[i], lever);
            gb_six_cross(axis, lever, moved);
            gb_arm_rates(&model->goal, images, moved, axis, linear->columns[i]);
        }
    }
    const size_t rows = gb_arm_rows_of(&model->goal);
    if (model->frozen < 0) {
        gb_arm_factor(linear, rows);
    } else {
        gb_arm_factor_without(linear, rows - 1, (size_t)model->frozen);
    }
}

/* Whether joint values that fulfil the equations reach the target, and not an orientation that is turned by half a turn. */
static bool gb_arm_reaches(const gb_arm_model *model, const gb_real *x)
{
    gb_arm_axes axes;
    gb_arm_set_axes(&model->links, model->arm, x, &axes);
    return gb_arm_is_toward(&model->goal, &axes.tip);
}

/* The equations, their derivatives, and the curve's direction. */
static void gb_arm_set_place(const gb_arm_model *model, const gb_real *x, gb_arm_place *place)
{
    gb_arm_axes axes;
    gb_real images[2][3];
    gb_arm_set_axes(&model->links, model->arm, x, &axes);
    gb_arm_images(&model->goal, &axes.tip, images);
    gb_arm_set_factors(model, &axes, images, &place->linear);
    gb_arm_copy(x, place->x);
    gb_arm_goal_values(&model->goal, &axes.tip, place->values);
}

/* A place, and the second derivative of the curve by its length. */
static void gb_arm_set_bent(const gb_arm_model *model, const gb_real *x, gb_arm_place *place, gb_real *bend)
{
    gb_arm_axes axes;
    gb_real images[2][3], second[GB_ARM_ROWS];
    gb_arm_set_place(model, x, place);
    gb_arm_set_axes(&model->links, model->arm, x, &axes);
    gb_arm_images(&model->goal, &axes.tip, images);
    gb_arm_second(model, &axes, images, place->linear.tangent, second);
    gb_arm_least(&place->linear, second, bend);
    gb_arm_reverse(bend);
}

/* The values of the equations, and their rates where the joints move with rates `t`. */
static void gb_arm_moving(const gb_arm_model *model, const gb_real *x, const gb_real *t, gb_real *values, gb_real *rates)
{
    gb_arm_axes axes;
    gb_real images[2][3], linear[3] = {R(0.0), R(0.0), R(0.0)}, angular[3] = {R(0.0), R(0.0), R(0.0)};
    gb_arm_set_axes(&model->links, model->arm, x, &axes);
    for (size_t i = 0; i < model->count; i++) {
        gb_real motion[3], lever[3], moved[3];
        gb_arm_scale(axes.directions[i], t[i], motion);
        if (model->arm->slides[i]) {
            gb_arm_add(linear, motion, linear);
        } else {
            gb_arm_sub(axes.tip.translation, axes.points[i], lever);
            gb_six_cross(motion, lever, moved);
            gb_arm_add(linear, moved, linear);
            gb_arm_add(angular, motion, angular);
        }
    }
    gb_arm_images(&model->goal, &axes.tip, images);
    gb_arm_goal_values(&model->goal, &axes.tip, values);
    gb_arm_rates(&model->goal, images, linear, angular, rates);
}

/* The angle moved by as few turns as possible within limits. Where that is impossible, it is moved to where it exceeds them least. */
static gb_real gb_arm_shifted(gb_real angle, const gb_real *limits)
{
    const gb_real low = limits[0], high = limits[1];
    if (angle >= low && angle <= high) {
        /* Without the sign of a zero. */
        return angle + R(0.0);
    }
    const gb_real up = gb_ceiling((low - GB_ACCEPTANCE_INPUT - angle) / GB_TAU);
    const gb_real down = gb_floor((high + GB_ACCEPTANCE_INPUT - angle) / GB_TAU);
    if (up <= down) {
        return angle + GB_TAU * gb_arm_min(gb_arm_max(R(0.0), up), down);
    }
    /* `up` is the first turn above the lower limit, and beyond the upper one; `down` is the last turn below. */
    const gb_real above = angle + GB_TAU * up, below = angle + GB_TAU * down;
    return above - high < low - below ? above : below;
}

/* Scaled joint values. */
static void gb_arm_scaled(const gb_arm_model *model, const gb_real *q, gb_real *x)
{
    for (size_t i = 0; i < GB_MOST_ARM_JOINTS; i++) {
        x[i] = i < model->count ? q[i] / model->units[i] : R(0.0);
    }
}

/* Joint values of scaled ones. An angle whose range is at least one turn is moved within its limits. */
static void gb_arm_unscaled(const gb_arm_model *model, const gb_real *x, gb_real *q)
{
    for (size_t i = 0; i < GB_MOST_ARM_JOINTS; i++) {
        q[i] = i < model->count ? x[i] * model->units[i] : R(0.0);
        if (i < model->count && model->turns[i]) {
            q[i] = gb_arm_shifted(q[i], model->limits[i]);
        }
    }
}

/* Whether limits of the joint are reached along curves. */
static bool gb_arm_is_limited(const gb_arm_model *model, size_t joint)
{
    return !model->turns[joint] && model->arm->given[joint] != GB_ARM_CONSTANT;
}

/* Moves angles by whole turns within limits, or next to them. Returns the joints that are beyond their limits by more than the tolerance, as bits. */
static uint32_t gb_arm_lift(const gb_arm_model *model, gb_real *x)
{
    uint32_t beyond = 0;
    for (size_t i = 0; i < model->count; i++) {
        if (model->turns[i]) {
            continue;
        }
        if (!model->arm->slides[i]) {
            x[i] = gb_arm_shifted(x[i], model->limits[i]);
        }
        if (x[i] < model->limits[i][0] - GB_ACCEPTANCE_INPUT || x[i] > model->limits[i][1] + GB_ACCEPTANCE_INPUT) {
            beyond |= gb_arm_bit(i);
        }
    }
    return beyond;
}

/* The difference `a - b`; angles whose range is at least one turn are compared up to whole turns. */
static void gb_arm_difference(const gb_arm_model *model, const gb_real *a, const gb_real *b, gb_real *d)
{
    for (size_t i = 0; i < GB_MOST_ARM_JOINTS; i++) {
        d[i] = i < model->count ? a[i] - b[i] : R(0.0);
        if (i < model->count && model->turns[i]) {
            d[i] -= GB_TAU * gb_round(d[i] / GB_TAU);
        }
    }
}

/* Whether no joint differs by more than `most`; angles whose range is at least one turn are compared up to whole turns. */
static bool gb_arm_are_close(const gb_arm_model *model, const gb_real *a, const gb_real *b, gb_real most)
{
    for (size_t i = 0; i < model->count; i++) {
        gb_real d = a[i] - b[i];
        if (model->turns[i] && gb_magnitude(d) > most) {
            d -= GB_TAU * gb_round(d / GB_TAU);
        }
        if (gb_magnitude(d) > most) {
            return false;
        }
    }
    return true;
}

/* The largest difference of a joint. */
static gb_real gb_arm_distance(const gb_arm_model *model, const gb_real *a, const gb_real *b)
{
    gb_real d[GB_MOST_ARM_JOINTS];
    gb_arm_difference(model, a, b, d);
    return gb_arm_farthest(d);
}
