/* Redundant arms with solvers written by hand, like redundant_arms.rs: a planar arm with three joints, a rail with two joints, and an arm with spherical
 * shoulder and wrist. Only the run time's cosines, sines and angles are used, so that results do not depend on the C library. */

#define PI 3.141592653589793

/* A random number in [0, 1): xorshift64 (G. Marsaglia, "Xorshift RNGs", 2003). */
static double random_number(void)
{
    static uint64_t state = 88172645463325252u;
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return (double)(state >> 11) / 9007199254740992.0;
}

static double between(double low, double high)
{
    return low + random_number() * (high - low);
}

static double atan2_of(double y, double x)
{
    return gb_angle(x, y);
}

static double length_of(double x, double y)
{
    return gb_square_root(x * x + y * y);
}

/* Adds a solution with angles in (-pi, pi], if all numbers are finite. */
static void push(gb_arm_members *members, const double *q, size_t count, size_t given, double value, uint32_t free)
{
    gb_arm_member member;
    memset(&member, 0, sizeof member);
    member.free = free;
    member.settled = true;
    for (size_t i = 0; i < count; i++) {
        member.q[i] = i == given ? value : gb_wrap(q[i]);
        if (!(gb_magnitude(member.q[i]) <= GB_GREATEST)) {
            return;
        }
    }
    gb_add_arm_member(members, &member);
}

/* The square root of a number that may be slightly negative; -1 if it is more. */
static double root(double square)
{
    return square < -1e-13 ? -1.0 : gb_square_root(square > 0.0 ? square : 0.0);
}

/* Both angles `b` and their `a` with e^ia (u + v e^ib) = p for complex `u` and a length `v`. Returns their number. */
static int two_links(const double *p, double ux, double uy, double v, double (*out)[2])
{
    const double square = p[0] * p[0] + p[1] * p[1], first = length_of(ux, uy);
    const double cosine = (square - first * first - v * v) / (2.0 * first * v);
    const double sine = root(1.0 - cosine * cosine);
    if (!(sine >= 0.0)) {
        return 0;
    }
    for (int k = 0; k < 2; k++) {
        const double b = atan2_of(k == 0 ? sine : -sine, cosine) + atan2_of(uy, ux);
        const double x = ux + v * gb_cosine(b), y = uy + v * gb_sine(b);
        out[k][0] = atan2_of(p[1], p[0]) - atan2_of(y, x);
        out[k][1] = b;
    }
    return 2;
}

/* Lengths of the planar arm's links, of the rail's links, and of upper arm, forearm, shoulder and flange (KUKA iiwa 14) in metres. */
static const double planar_links[3] = {1.0, 0.8, 0.5};
static const double rail_links[2] = {1.0, 0.8};
static const double srs_links[2] = {0.42, 0.4};
#define SHOULDER 0.36
#define FLANGE 0.126

static int solve_planar(void *context, const double *target, size_t joint, double value, gb_arm_members *members)
{
    const double *l = planar_links, c = gb_cosine(value), s = gb_sine(value);
    double list[2][2];
    (void)context;
    if (joint == 0) {
        const double p[2] = {target[0] - l[0] * c, target[1] - l[0] * s};
        const int count = two_links(p, l[1], 0.0, l[2], list);
        for (int k = 0; k < count; k++) {
            const double q[3] = {value, list[k][0] - value, list[k][1]};
            push(members, q, 3, joint, value, 0);
        }
    } else if (joint == 1) {
        const int count = two_links(target, l[0] + l[1] * c, l[1] * s, l[2], list);
        for (int k = 0; k < count; k++) {
            const double q[3] = {list[k][0], value, list[k][1] - value};
            push(members, q, 3, joint, value, 0);
        }
    } else {
        const double x = l[1] + l[2] * c, y = l[2] * s, offset = atan2_of(y, x);
        const int count = two_links(target, l[0], 0.0, length_of(x, y), list);
        for (int k = 0; k < count; k++) {
            const double q[3] = {list[k][0], list[k][1] - offset, value};
            push(members, q, 3, joint, value, 0);
        }
    }
    return 0;
}

static int solve_rail(void *context, const double *target, size_t joint, double value, gb_arm_members *members)
{
    const double p[2] = {target[0] - value, target[1]};
    double list[2][2];
    (void)context;
    const int count = two_links(p, rail_links[0], 0.0, rail_links[1], list);
    for (int k = 0; k < count; k++) {
        const double q[3] = {value, list[k][0], list[k][1]};
        push(members, q, 3, joint, value, 0);
    }
    return 0;
}

/* The rotation about a coordinate axis. */
static void about(size_t axis, double angle, double (*out)[3])
{
    const size_t i = (axis + 1) % 3, j = (axis + 2) % 3;
    const double c = gb_cosine(angle), s = gb_sine(angle);
    memset(out, 0, 9 * sizeof(double));
    out[axis][axis] = 1.0;
    out[i][i] = out[j][j] = c;
    out[i][j] = -s;
    out[j][i] = s;
}

/* Multiplies the first matrix by the second one. */
static void multiply(double (*a)[3], double (*b)[3])
{
    for (int i = 0; i < 3; i++) {
        const double x = a[i][0], y = a[i][1], z = a[i][2];
        for (int j = 0; j < 3; j++) {
            a[i][j] = x * b[0][j] + y * b[1][j] + z * b[2][j];
        }
    }
}

static void image(double (*a)[3], const double *v, double *out)
{
    for (int i = 0; i < 3; i++) {
        out[i] = a[i][0] * v[0] + a[i][1] * v[1] + a[i][2] * v[2];
    }
}

static void transpose(double (*a)[3], double (*out)[3])
{
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            out[i][j] = a[j][i];
        }
    }
}

/* Rz(q1) Ry(q2) Rz(q3) Ry(-q4) Rz(q5) Ry(q6) Rz(q7), up to so many joints. */
static void srs_rotation(const double *q, int count, double (*out)[3])
{
    double next[3][3];
    about(2, 0.0, out);
    for (int i = 0; i < count; i++) {
        about(i % 2 == 0 ? 2 : 1, i == 3 ? -q[i] : q[i], next);
        multiply(out, next);
    }
}

static void srs_pose(const double *q, double *target)
{
    double turn[3][3];
    srs_rotation(q, 3, turn);
    for (int i = 0; i < 3; i++) {
        target[i] = turn[i][2] * srs_links[0];
    }
    srs_rotation(q, 5, turn);
    for (int i = 0; i < 3; i++) {
        target[i] += turn[i][2] * srs_links[1];
    }
    srs_rotation(q, 7, turn);
    for (int i = 0; i < 3; i++) {
        target[i] += turn[i][2] * FLANGE;
        memcpy(target + 3 + 3 * i, turn[i], sizeof turn[i]);
    }
    target[2] += SHOULDER;
}

/* Adds the solutions after the first four joints, both angles of the wrist. With `is_back` the arm is seen from its wrist. */
static void push_wrist(double (*turn)[3], const double *q, size_t given, double value, bool is_back, gb_arm_members *members)
{
    double rest[3][3], before[3][3];
    srs_rotation(q, 4, rest);
    transpose(rest, before);
    multiply(before, turn);
    const double sine = length_of(before[0][2], before[1][2]);
    const bool is_straight = sine < 1e-9;
    for (int k = 0; k < (is_straight ? 1 : 2); k++) {
        double all[7] = {q[0], q[1], q[2], q[3], 0.0, 0.0, 0.0}, out[7];
        const double sign = k == 0 ? 1.0 : -1.0;
        if (is_straight) {
            all[5] = before[2][2] > 0.0 ? 0.0 : PI;
            all[6] = atan2_of(before[1][0], before[1][1]);
        } else {
            all[4] = atan2_of(sign * before[1][2], sign * before[0][2]);
            all[5] = atan2_of(sign * sine, before[2][2]);
            all[6] = atan2_of(sign * before[2][1], -sign * before[2][0]);
        }
        for (int i = 0; i < 7; i++) {
            out[i] = is_back ? -all[6 - i] : all[i];
        }
        push(members, out, 7, given, value, is_straight ? (is_back ? 5u : 80u) : 0u);
    }
}

/* Writes the first three joints and the elbow, one of the first three given. The vector to the wrist is Rz(q1) (c2 c3 x + s2 z, s3 x, c2 z - s2 c3 x). */
static bool shoulder(const double *p, double x, double z, int given, double value, double sign, double *q)
{
    const double c = gb_cosine(value), s = gb_sine(value);
    double c3 = c, s3 = s;
    if (given == 0) {
        const double along = c * p[0] + s * p[1];
        s3 = (c * p[1] - s * p[0]) / x;
        c3 = root(1.0 - s3 * s3);
        if (c3 < 0.0) {
            return false;
        }
        c3 = sign * c3;
        q[0] = value;
        q[1] = atan2_of(along, p[2]) - atan2_of(c3 * x, z);
        q[2] = atan2_of(s3, c3);
        return true;
    }
    if (given == 1) {
        c3 = (c * z - p[2]) / (s * x);
        s3 = root(1.0 - c3 * c3);
        if (s3 < 0.0) {
            return false;
        }
        s3 = sign * s3;
        q[1] = value;
        q[2] = atan2_of(s3, c3);
    } else {
        const double size = length_of(c * x, z), up = root(size * size - p[2] * p[2]);
        if (up < 0.0) {
            return false;
        }
        q[1] = atan2_of(sign * up, p[2]) - atan2_of(c * x, z);
        q[2] = value;
    }
    q[0] = atan2_of(p[1], p[0]) - atan2_of(s3 * x, gb_cosine(q[1]) * c3 * x + gb_sine(q[1]) * z);
    return true;
}

static int solve_srs(void *context, const double *target, size_t joint, double value, gb_arm_members *members)
{
    const bool is_back = joint > 3;
    double turn[3][3], back[3][3], p[3], moved[3], flange[3], q[4];
    (void)context;
    memcpy(turn, target + 3, sizeof turn);
    const double tool[3] = {0.0, 0.0, FLANGE};
    image(turn, tool, flange);
    for (int i = 0; i < 3; i++) {
        p[i] = target[i] - flange[i] - (i == 2 ? SHOULDER : 0.0);
    }
    transpose(turn, back);
    image(back, p, moved);
    /* Seen from the wrist, with all axes reversed, the arm has the negative angles in reverse order. */
    const double *at = is_back ? moved : p, upper = srs_links[is_back ? 1 : 0], lower = srs_links[is_back ? 0 : 1];
    const double square = at[0] * at[0] + at[1] * at[1] + at[2] * at[2];
    const double cosine = (square - upper * upper - lower * lower) / (2.0 * upper * lower), sine = root(1.0 - cosine * cosine);
    for (int k = 0; k < 4 && sine >= 0.0; k++) {
        const double s4 = k < 2 ? sine : -sine, x = -s4 * lower, z = upper + cosine * lower;
        const int given = is_back ? 6 - (int)joint : (int)joint;
        q[3] = atan2_of(s4, cosine);
        if (shoulder(at, x, z, given, is_back ? -value : value, k % 2 == 0 ? 1.0 : -1.0, q)) {
            push_wrist(is_back ? back : turn, q, joint, value, is_back, members);
        }
    }
    return 0;
}

/* An arm with unlimited joints along z at the origin, and the tip there. */
static void clear_arm(gb_arm *arm, size_t count, gb_task_kind task, double length)
{
    memset(arm, 0, sizeof *arm);
    arm->count = count;
    arm->task.kind = task;
    arm->length = length;
    arm->task.coordinates[1] = 1;
    for (int i = 0; i < GB_MOST_ARM_JOINTS; i++) {
        arm->directions[i][2] = 1.0;
        arm->limits[2 * i] = -HUGE_VAL;
        arm->limits[2 * i + 1] = HUGE_VAL;
    }
    for (int i = 0; i < 3; i++) {
        arm->tip.rotation[i][i] = 1.0;
    }
}

static void set_planar(gb_arm *arm)
{
    clear_arm(arm, 3, GB_TASK_PLANAR_POSITION, 1.0);
    arm->points[1][0] = 1.0;
    arm->points[2][0] = 1.8;
    arm->tip.translation[0] = 2.3;
    for (int i = 0; i < 3; i++) {
        arm->given[i] = GB_ARM_SOLVED;
    }
}

static void set_rail(gb_arm *arm)
{
    clear_arm(arm, 3, GB_TASK_PLANAR_POSITION, 0.7);
    arm->slides[0] = true;
    arm->directions[0][0] = 1.0;
    arm->directions[0][2] = 0.0;
    arm->points[2][0] = 1.0;
    arm->tip.translation[0] = 1.8;
    arm->given[0] = GB_ARM_SOLVED;
}

static void set_srs(gb_arm *arm)
{
    static const double heights[7] = {0.36, 0.36, 0.36, 0.78, 1.18, 1.18, 1.18};
    static const double limits[7] = {2.967, 2.094, 2.967, 2.094, 2.967, 2.094, 3.054};
    clear_arm(arm, 7, GB_TASK_POSE, 0.82);
    arm->tip.translation[2] = 1.306;
    arm->scanned = arm->grid = 2;
    for (int i = 0; i < 7; i++) {
        arm->directions[i][1] = i % 2 == 0 ? 0.0 : i == 3 ? -1.0 : 1.0;
        arm->directions[i][2] = i % 2 == 0 ? 1.0 : 0.0;
        arm->points[i][2] = heights[i];
        arm->limits[2 * i] = -limits[i];
        arm->limits[2 * i + 1] = limits[i];
        arm->given[i] = i == 3 ? GB_ARM_CONSTANT : GB_ARM_SOLVED;
    }
}
