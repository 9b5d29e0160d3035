/* The equations of a task at a target: see goal.rs */

/* The equations: coordinates of the position, a rotation, and scalar products of a vector that is fixed in the base with one that is fixed on the tip. Lengths
 * are relative to the arm's. */
typedef struct {
    gb_real position[3];
    /* The coordinates that are compared, and their number. */
    size_t coordinates[3];
    size_t positions;
    /* The columns of the rotation. */
    gb_real columns[3][3];
    bool has_rotation;
    /* The most frequent case: the equations are three coordinates and a rotation. */
    bool is_pose;
    gb_real fixed[2][3];
    gb_real moving[2][3];
    size_t products;
} gb_arm_goal;

/* Two unit vectors that are orthogonal to a unit vector and to each other. */
static void gb_arm_across(const gb_real *v, gb_real (*out)[3])
{
    int least = 0;
    for (int k = 1; k < 3; k++) {
        if (gb_magnitude(v[k]) < gb_magnitude(v[least])) {
            least = k;
        }
    }
    gb_six_cross(v, gb_six_none.rotation[least], out[0]);
    gb_arm_scale(out[0], R(1.0) / gb_square_root(gb_six_dot(out[0], out[0])), out[0]);
    gb_six_cross(v, out[0], out[1]);
}

/* Compares the rotation, given by rows. */
static void gb_arm_rotate(gb_arm_goal *goal, const gb_real *rows)
{
    for (int k = 0; k < 3; k++) {
        for (int i = 0; i < 3; i++) {
            goal->columns[k][i] = rows[3 * i + k];
        }
    }
    goal->has_rotation = true;
}

/* Compares the direction of the tip with one in the base. */
static void gb_arm_aim(gb_arm_goal *goal, const gb_real *at, const gb_real *direction)
{
    gb_arm_across(at, goal->fixed);
    memcpy(goal->moving[0], direction, sizeof goal->moving[0]);
    memcpy(goal->moving[1], direction, sizeof goal->moving[1]);
    goal->products = 2;
}

/* Compares pitch and roll. */
static void gb_arm_tilt(gb_arm_goal *goal, gb_real pitch, gb_real roll)
{
    const gb_real up[3] = {-gb_sine(pitch), gb_cosine(pitch) * gb_sine(roll), gb_cosine(pitch) * gb_cosine(roll)};
    memcpy(goal->fixed[0], gb_six_none.rotation[2], sizeof goal->fixed[0]);
    memcpy(goal->fixed[1], gb_six_none.rotation[2], sizeof goal->fixed[1]);
    gb_arm_across(up, goal->moving);
    goal->products = 2;
}

/* Compares the angle of a direction about a coordinate axis. */
static void gb_arm_yaw(gb_arm_goal *goal, size_t axis, gb_real angle, const gb_real *direction)
{
    goal->fixed[0][axis] = R(0.0);
    goal->fixed[0][(axis + 1) % 3] = -gb_sine(angle);
    goal->fixed[0][(axis + 2) % 3] = gb_cosine(angle);
    memcpy(goal->moving[0], direction, sizeof goal->moving[0]);
    goal->products = 1;
}

/* Compares two coordinates of the position, and with an angle also the rotation about the third one's axis. */
static void gb_arm_plane(gb_arm_goal *goal, const gb_arm *arm, const gb_real *angle)
{
    const size_t a = arm->task.coordinates[0], b = arm->task.coordinates[1], normal = 3 - a - b;
    const gb_real first = goal->position[0], second = goal->position[1];
    goal->position[normal] = R(0.0);
    goal->position[a] = first;
    goal->position[b] = second;
    goal->positions = 2;
    goal->coordinates[0] = a;
    goal->coordinates[1] = b;
    goal->coordinates[2] = normal;
    if (angle) {
        const gb_rigid back = gb_six_inverse(&arm->tip);
        gb_real direction[3];
        gb_six_turned(&back, gb_six_none.rotation[(normal + 1) % 3], direction);
        gb_arm_yaw(goal, normal, *angle, direction);
    }
}

/* The equations of the arm's task at a target. */
static void gb_arm_set_goal(gb_arm_goal *goal, const gb_arm *arm, const gb_real *target)
{
    const gb_task *task = &arm->task;
    memset(goal, 0, sizeof *goal);
    for (size_t k = 0; k < 3; k++) {
        goal->coordinates[k] = k;
    }
    gb_arm_scale(target, R(1.0) / arm->length, goal->position);
    goal->positions = 3;
    switch (task->kind) {
    case GB_TASK_POSE:
        gb_arm_rotate(goal, target + 3);
        goal->is_pose = true;
        break;
    case GB_TASK_POSITION:
        break;
    case GB_TASK_ROTATION:
        goal->positions = 0;
        gb_arm_rotate(goal, target);
        break;
    case GB_TASK_RAY:
        gb_arm_aim(goal, target + 3, task->direction);
        break;
    case GB_TASK_DIRECTION:
        goal->positions = 0;
        gb_arm_aim(goal, target, task->direction);
        break;
    case GB_TASK_POSITION_PITCH_ROLL:
        gb_arm_tilt(goal, target[3], target[4]);
        break;
    case GB_TASK_POSITION_YAW:
        gb_arm_yaw(goal, task->axis, target[3], task->direction);
        break;
    case GB_TASK_PLANAR_POSITION:
        gb_arm_plane(goal, arm, NULL);
        break;
    case GB_TASK_PLANAR_POSE:
        gb_arm_plane(goal, arm, target + 2);
        break;
    }
}

/* The number of equations. */
static size_t gb_arm_rows_of(const gb_arm_goal *goal)
{
    return goal->positions + (goal->has_rotation ? 3 : 0) + goal->products;
}

/* The values of the equations at a pose of the tip. Near the target, those of the rotation are the components of the rotation vector. */
static void gb_arm_goal_values(const gb_arm_goal *goal, const gb_rigid *tip, gb_real *values)
{
    gb_real turned[3];
    for (int k = 0; k < GB_ARM_ROWS; k++) {
        values[k] = R(0.0);
    }
    for (size_t k = 0; k < goal->positions; k++) {
        const size_t c = goal->coordinates[k];
        values[k] = tip->translation[c] - goal->position[c];
    }
    for (size_t k = 0; goal->has_rotation && k < 3; k++) {
        const gb_real column[3] = {tip->rotation[0][k], tip->rotation[1][k], tip->rotation[2][k]};
        gb_six_cross(goal->columns[k], column, turned);
        for (size_t c = 0; c < 3; c++) {
            values[goal->positions + c] += R(0.5) * turned[c];
        }
    }
    for (size_t k = 0; k < goal->products; k++) {
        gb_six_turned(tip, goal->moving[k], turned);
        values[goal->positions + k] = gb_six_dot(goal->fixed[k], turned);
    }
}

/* The images of the vectors that are fixed on the tip. */
static void gb_arm_images(const gb_arm_goal *goal, const gb_rigid *tip, gb_real (*images)[3])
{
    for (size_t k = 0; k < goal->products; k++) {
        gb_six_turned(tip, goal->moving[k], images[k]);
    }
}

/* The rates of the equations for a linear velocity of the tip's origin and an angular velocity. */
GB_INLINE void gb_arm_rates(const gb_arm_goal *goal, gb_real (*images)[3], const gb_real *linear, const gb_real *angular, gb_real *rates)
{
    gb_real turned[3];
    if (goal->is_pose) {
        memcpy(rates, linear, sizeof turned);
        memcpy(rates + 3, angular, sizeof turned);
        return;
    }
    for (int k = 0; k < GB_ARM_ROWS; k++) {
        rates[k] = R(0.0);
    }
    for (size_t k = 0; k < goal->positions; k++) {
        rates[k] = linear[goal->coordinates[k]];
    }
    for (size_t k = 0; goal->has_rotation && k < 3; k++) {
        rates[goal->positions + k] = angular[k];
    }
    for (size_t k = 0; k < goal->products; k++) {
        gb_six_cross(angular, images[k], turned);
        rates[goal->positions + k] = gb_six_dot(goal->fixed[k], turned);
    }
}

/* Adds the second derivatives of the scalar products for an angular velocity of the tip. */
static void gb_arm_add_centripetal(const gb_arm_goal *goal, gb_real (*images)[3], const gb_real *velocity, gb_real *rates)
{
    for (size_t k = 0; k < goal->products; k++) {
        gb_real once[3], twice[3];
        gb_six_cross(velocity, images[k], once);
        gb_six_cross(velocity, once, twice);
        rates[goal->positions + k] += gb_six_dot(goal->fixed[k], twice);
    }
}

/* The centripetal and tangential acceleration of a point at `r` from another one of its body. */
static void gb_arm_carried(const gb_real *r, const gb_real *angular, const gb_real *velocity, gb_real *out)
{
    gb_real once[3], inward[3], tangential[3];
    gb_six_cross(angular, r, tangential);
    gb_six_cross(velocity, r, once);
    gb_six_cross(velocity, once, inward);
    gb_arm_add(tangential, inward, out);
}
