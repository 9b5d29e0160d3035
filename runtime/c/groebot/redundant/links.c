/* Positions of the axes and of the tip: see links.rs */

/* From one joint to the next. The frame of a joint has z along its axis and x orthogonal to the next axis, too. The frame is turned about z by the joint's
 * angle, moved, and then turned about x, so that z is along the next axis. */
typedef struct {
    /* The next point in the turned frame. */
    gb_real shift[3];
    /* The cosine and the sine of the angle about x. */
    gb_real twist[2];
} gb_arm_link;

/* A frame: x, y, z, and the origin. */
typedef struct {
    gb_real x[3];
    gb_real y[3];
    gb_real z[3];
    gb_real p[3];
} gb_arm_frame;

/* An arm by links. Lengths are relative to the arm's. */
typedef struct {
    /* The first joint's frame at zero. */
    gb_arm_frame base;
    gb_arm_link list[GB_MOST_ARM_JOINTS];
    /* The angles at zero (rad), and 1 for a joint that turns, 0 for a prismatic one. */
    gb_real offsets[GB_ARM_ANGLES];
    gb_real turns[GB_ARM_ANGLES];
    /* The columns of the tip's rotation in the last frame. */
    gb_real tip[3][3];
} gb_arm_links;

/* Axes, points on them, and the tip at joint values, in the base frame. */
typedef struct {
    gb_real directions[GB_MOST_ARM_JOINTS][3];
    gb_real points[GB_MOST_ARM_JOINTS][3];
    gb_rigid tip;
} gb_arm_axes;

/* Writes `a x + b y`; the output is none of them. */
GB_INLINE void gb_arm_mix(gb_real a, const gb_real *x, gb_real b, const gb_real *y, gb_real *out)
{
    GB_UNROLL
    for (int i = 0; i < 3; i++) {
        out[i] = a * x[i] + b * y[i];
    }
}

/* A unit vector orthogonal to two axes; to the first one if they are parallel. */
static void gb_arm_normal(const gb_real *first, const gb_real *second, gb_real *out)
{
    gb_six_cross(first, second, out);
    const gb_real square = gb_six_dot(out, out);
    if (square < GB_LEAST_POSITIVE) {
        gb_real both[2][3];
        gb_arm_across(first, both);
        memcpy(out, both[0], sizeof both[0]);
    } else {
        gb_arm_scale(out, R(1.0) / gb_square_root(square), out);
    }
}

/* The point on an axis, or that of the tip after the last axis. */
static void gb_arm_point_on(const gb_arm *arm, size_t joint, gb_real *out)
{
    const bool is_tip = joint == arm->count || arm->slides[joint];
    gb_arm_scale(is_tip ? arm->tip.translation : arm->points[joint], R(1.0) / arm->length, out);
}

/* The components of a vector along x, y, z. */
static void gb_arm_components(const gb_arm_frame *frame, const gb_real *v, gb_real *out)
{
    out[0] = gb_six_dot(frame->x, v);
    out[1] = gb_six_dot(frame->y, v);
    out[2] = gb_six_dot(frame->z, v);
}

static void gb_arm_set_links(gb_arm_links *links, const gb_arm *arm)
{
    gb_arm_frame frame = {{R(0.0)}, {R(0.0)}, {R(0.0)}, {R(0.0)}};
    gb_real before[3] = {R(0.0), R(0.0), R(0.0)}, next_point[3], r[3], product[3];
    memset(links, 0, sizeof *links);
    for (size_t i = 0; i < arm->count; i++) {
        gb_arm_link *link = &links->list[i];
        const gb_real *next = arm->directions[i + 1 == arm->count ? i : i + 1];
        memcpy(frame.z, arm->directions[i], sizeof frame.z);
        gb_arm_normal(frame.z, next, frame.x);
        gb_six_cross(frame.z, frame.x, frame.y);
        gb_arm_point_on(arm, i, frame.p);
        if (i == 0) {
            links->base = frame;
            memcpy(before, frame.x, sizeof before);
        }
        gb_arm_point_on(arm, i + 1, next_point);
        gb_arm_sub(next_point, frame.p, r);
        gb_six_cross(before, frame.x, product);
        links->offsets[i] = gb_angle(gb_six_dot(before, frame.x), gb_six_dot(frame.z, product));
        links->turns[i] = arm->slides[i] ? R(0.0) : R(1.0);
        gb_arm_components(&frame, r, link->shift);
        link->twist[0] = gb_six_dot(frame.z, next);
        gb_six_cross(frame.z, next, product);
        link->twist[1] = gb_six_dot(frame.x, product);
        memcpy(before, frame.x, sizeof before);
    }
    for (int k = 0; k < 3; k++) {
        const gb_real column[3] = {arm->tip.rotation[0][k], arm->tip.rotation[1][k], arm->tip.rotation[2][k]};
        gb_arm_components(&frame, column, links->tip[k]);
    }
}

/* The cosines and the sines of the angles between the frames. */
GB_INLINE void gb_arm_turned(const gb_arm_links *links, const gb_real *x, gb_real *cosines, gb_real *sines)
{
    gb_real angles[GB_ARM_ANGLES];
    memcpy(angles, links->offsets, sizeof angles);
    GB_UNROLL
    for (int i = 0; i < GB_MOST_ARM_JOINTS; i++) {
        angles[i] += links->turns[i] * x[i];
    }
    gb_six_turns(angles, GB_ARM_ANGLES, cosines, sines);
}

/* Moves a frame along its z axis. */
GB_INLINE void gb_arm_slide(gb_arm_frame *at, gb_real value)
{
    gb_real moved[3];
    gb_arm_scale(at->z, value, moved);
    gb_arm_add(at->p, moved, at->p);
}

/* Moves by one joint, whose angle has this cosine and sine, to the next frame. */
GB_INLINE void gb_arm_next_frame(gb_arm_frame *at, const gb_arm_link *link, gb_real c, gb_real s)
{
    gb_real x[3], y[3], moved[3];
    gb_arm_mix(c, at->x, s, at->y, x);
    gb_arm_mix(c, at->y, -s, at->x, y);
    gb_arm_scale(at->z, link->shift[2], moved);
    gb_arm_add(at->p, moved, at->p);
    gb_arm_mix(link->shift[0], x, link->shift[1], y, moved);
    gb_arm_add(at->p, moved, at->p);
    memcpy(at->x, x, sizeof x);
    gb_arm_mix(link->twist[0], y, link->twist[1], at->z, at->y);
    gb_arm_mix(link->twist[0], at->z, -link->twist[1], y, moved);
    memcpy(at->z, moved, sizeof moved);
}

/* The tip of the last frame. */
GB_INLINE void gb_arm_set_tip(const gb_arm_links *links, const gb_arm_frame *at, gb_rigid *tip)
{
    memcpy(tip->translation, at->p, sizeof tip->translation);
    for (int k = 0; k < 3; k++) {
        gb_real column[3], along[3];
        gb_arm_mix(links->tip[k][0], at->x, links->tip[k][1], at->y, column);
        gb_arm_scale(at->z, links->tip[k][2], along);
        for (int i = 0; i < 3; i++) {
            tip->rotation[i][k] = column[i] + along[i];
        }
    }
}

/* Axes and tip at joint values. */
static void gb_arm_set_axes(const gb_arm_links *links, const gb_arm *arm, const gb_real *x, gb_arm_axes *axes)
{
    gb_arm_frame at = links->base;
    gb_real cosines[GB_ARM_ANGLES], sines[GB_ARM_ANGLES];
    gb_arm_turned(links, x, cosines, sines);
    for (size_t i = 0; i < arm->count; i++) {
        memcpy(axes->directions[i], at.z, sizeof at.z);
        memcpy(axes->points[i], at.p, sizeof at.p);
        if (arm->slides[i]) {
            gb_arm_slide(&at, x[i]);
        }
        gb_arm_next_frame(&at, &links->list[i], cosines[i], sines[i]);
    }
    gb_arm_set_tip(links, &at, &axes->tip);
}
