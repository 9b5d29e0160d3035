/* Forward kinematics of the chain, and its solution by Newton's method: see polish.rs */

/* Forward kinematics of a joint vector. */
typedef struct {
    gb_real axes[6][3];
    gb_real origins[6][3];
    gb_rigid end;
} gb_six_reach;

/* A joint vector and its pose error. */
typedef struct {
    gb_real q[6];
    gb_six_reach reach;
    gb_real miss[6];
    /* The largest component of the error. */
    gb_real residual;
} gb_six_trial;

/* The cosines and the sines of the joints. */
typedef struct {
    gb_real c[GB_SIX_PADDED(6)];
    gb_real s[GB_SIX_PADDED(6)];
} gb_six_moves;

GB_INLINE void gb_six_find_moves(const gb_real *q, gb_six_moves *moves)
{
    gb_real angles[GB_SIX_PADDED(6)] = {R(0.0)};
    memcpy(angles, q, 6 * sizeof *angles);
    gb_six_turns(angles, 6, moves->c, moves->s);
}

/* Moves a frame by a joint, given all cosines and sines. */
GB_INLINE void gb_six_move(const gb_chain *chain, size_t joint, const gb_real *q, const gb_six_moves *moves, gb_rigid *frame)
{
    if (chain->slides[joint]) {
        gb_six_then_slide(frame, q[joint]);
    } else {
        gb_six_then_turn(frame, moves->c[joint], moves->s[joint]);
    }
}

static void gb_six_find_reach(const gb_chain *chain, const gb_real *q, gb_six_reach *reach)
{
    gb_rigid frame = chain->steps[0];
    gb_six_moves moves;
    gb_six_find_moves(q, &moves);
    for (size_t joint = 0; joint < 6; joint++) {
        if (joint > 0) {
            frame = gb_six_after(&frame, &chain->steps[joint]);
        }
        for (int i = 0; i < 3; i++) {
            reach->axes[joint][i] = frame.rotation[i][2];
            reach->origins[joint][i] = frame.translation[i];
        }
        gb_six_move(chain, joint, q, &moves, &frame);
    }
    reach->end = frame;
}

/* The error for a rotation by more than a right angle, given its sine along its axis. Its length is two minus the sine, which is not zero at half a turn
 * either. */
static GB_COLD void gb_six_make_obtuse(gb_real *turn)
{
    const gb_real sine = gb_square_root(gb_six_dot(turn, turn));
    for (int k = 0; k < 3; k++) {
        turn[k] = sine > GB_PIVOTS_REGULAR_SIX ? turn[k] * ((R(2.0) - sine) / sine) : (k == 0 ? R(2.0) : R(0.0));
    }
}

/* The pose error to a target: translation relative to the length scale, and rotation (rad). */
GB_INLINE void gb_six_find_miss(const gb_six_reach *reach, const gb_rigid *target, gb_real *miss)
{
    gb_real turns[3][3], cosines[3];
    GB_UNROLL
    for (int index = 0; index < 3; index++) {
        gb_real is[3], wanted[3];
        GB_UNROLL
        for (int i = 0; i < 3; i++) {
            is[i] = reach->end.rotation[i][index];
            wanted[i] = target->rotation[i][index];
        }
        gb_six_cross(is, wanted, turns[index]);
        cosines[index] = gb_six_dot(is, wanted);
    }
    GB_UNROLL
    for (int k = 0; k < 3; k++) {
        miss[k] = target->translation[k] - reach->end.translation[k];
        miss[3 + k] = (turns[0][k] + turns[1][k] + turns[2][k]) * R(0.5);
    }
    if (cosines[0] + cosines[1] + cosines[2] < R(1.0)) {
        gb_six_make_obtuse(miss + 3);
    }
}

/* The value of a joint that brings the last joint's frame nearest to a target, given the other joints. */
static gb_real gb_six_closing(const gb_chain *chain, const gb_real *q, size_t joint, const gb_rigid *target)
{
    gb_rigid before = chain->steps[0], behind = gb_six_none;
    gb_six_moves moves;
    gb_six_find_moves(q, &moves);
    for (size_t k = 0; k < joint; k++) {
        gb_six_move(chain, k, q, &moves, &before);
        before = gb_six_after(&before, &chain->steps[k + 1]);
    }
    for (size_t k = joint + 1; k < 6; k++) {
        behind = gb_six_after(&behind, &chain->steps[k]);
        gb_six_move(chain, k, q, &moves, &behind);
    }
    before = gb_six_inverse(&before);
    behind = gb_six_inverse(&behind);
    before = gb_six_after(&before, target);
    const gb_rigid motion = gb_six_after(&before, &behind);
    const gb_real c = motion.rotation[0][0] + motion.rotation[1][1], s = motion.rotation[1][0] - motion.rotation[0][1];
    return chain->slides[joint] ? motion.translation[2] : gb_six_turn(c, s);
}

/* The column of the Jacobian for a joint: derivatives of the last frame's position and rotation. */
GB_INLINE void gb_six_derivatives(const gb_chain *chain, const gb_six_reach *reach, size_t joint, gb_real *column)
{
    const gb_real *axis = reach->axes[joint];
    gb_real arm[3], position[3];
    GB_UNROLL
    for (int k = 0; k < 3; k++) {
        arm[k] = reach->end.translation[k] - reach->origins[joint][k];
    }
    gb_six_cross(axis, arm, position);
    GB_UNROLL
    for (int k = 0; k < 3; k++) {
        column[k] = chain->slides[joint] ? axis[k] : position[k];
        column[3 + k] = chain->slides[joint] ? R(0.0) : axis[k];
    }
}

/* A Newton step, at most GB_SIX_LONGEST long; false where there is none. */
static bool gb_six_newton(const gb_chain *chain, const gb_six_trial *at, gb_real *step)
{
    gb_real rows[6][8], largest = R(0.0);
    for (size_t joint = 0; joint < 6; joint++) {
        gb_real column[6];
        gb_six_derivatives(chain, &at->reach, joint, column);
        GB_UNROLL
        for (int k = 0; k < 6; k++) {
            rows[k][joint] = column[k];
            largest = gb_larger(largest, gb_magnitude(column[k]));
        }
        rows[joint][6] = at->miss[joint];
        rows[joint][7] = R(0.0);
    }
    if (gb_six_solve(rows[0], 6, 8, largest) <= R(0.0)) {
        return false;
    }
    GB_UNROLL
    for (int k = 0; k < 6; k++) {
        step[k] = rows[k][6];
    }
    const gb_real longest = gb_six_size(step), share = longest > GB_SIX_LONGEST ? GB_SIX_LONGEST / longest : R(1.0);
    GB_UNROLL
    for (int k = 0; k < 6; k++) {
        step[k] = share * step[k];
    }
    return gb_six_is_finite(longest);
}

static void gb_six_try(const gb_chain *chain, const gb_rigid *target, gb_six_trial *trial)
{
    gb_six_find_reach(chain, trial->q, &trial->reach);
    gb_six_find_miss(&trial->reach, target, trial->miss);
    trial->residual = gb_six_size(trial->miss);
}

/* The end of a step, shortened until its residual is smaller. */
static void gb_six_follow_step(const gb_chain *chain, const gb_six_trial *at, const gb_real *step, const gb_rigid *target, int *shortened, gb_six_trial *next)
{
    gb_real share = R(1.0);
    for (;;) {
        GB_UNROLL
        for (int joint = 0; joint < 6; joint++) {
            next->q[joint] = at->q[joint] + share * step[joint];
        }
        gb_six_try(chain, target, next);
        if (next->residual < at->residual || at->residual <= GB_SELF_MOTIONS_MEMBER_SIX || *shortened >= GB_SIX_SHORTENED) {
            return;
        }
        share = R(0.25) * share;
        ++*shortened;
    }
}

/* Takes Newton steps from q to a target, shortened where the residual increases. Returns the residual after them; `start` receives the one before them. */
static gb_real gb_six_polish(const gb_chain *chain, gb_real *q, const gb_rigid *target, gb_real *start)
{
    gb_six_trial trials[2], *at = &trials[0], *next = &trials[1];
    int shortened = 0;
    memcpy(at->q, q, sizeof at->q);
    gb_six_try(chain, target, at);
    *start = at->residual;
    for (int count = 0; count < GB_SIX_STEPS; count++) {
        const gb_real known = at->residual;
        gb_real step[6];
        if (known <= GB_SIX_EXACT || !gb_six_is_finite(known) || !gb_six_newton(chain, at, step)) {
            break;
        }
        gb_six_follow_step(chain, at, step, target, &shortened, next);
        if (next->residual >= known) {
            break;
        }
        gb_six_trial *const other = at;
        at = next;
        next = other;
        if (at->residual > R(0.5) * known && at->residual <= GB_SELF_MOTIONS_MEMBER_SIX) {
            break;
        }
    }
    memcpy(q, at->q, sizeof at->q);
    return at->residual;
}

/* Joints whose motion the joints after them compensate, to first order: their columns of the Jacobian depend on the later columns. */
static void gb_six_find_free(const gb_chain *chain, const gb_real *q, bool *is_free)
{
    gb_six_reach reach;
    gb_real kept[6][6];
    int count = 0;
    gb_six_find_reach(chain, q, &reach);
    for (size_t joint = 6; joint-- > 0;) {
        gb_real column[6];
        gb_six_derivatives(chain, &reach, joint, column);
        const gb_real whole = gb_six_norm(column);
        for (int round = 0; round < 2; round++) {
            for (int i = 0; i < count; i++) {
                const gb_real share = gb_six_product(kept[i], column, 6);
                for (int k = 0; k < 6; k++) {
                    column[k] -= share * kept[i][k];
                }
            }
        }
        const gb_real left = gb_six_norm(column);
        is_free[joint] = left <= GB_PIVOTS_REGULAR_COLUMNS * whole;
        if (!is_free[joint]) {
            for (int k = 0; k < 6; k++) {
                kept[count][k] = column[k] / left;
            }
            count++;
        }
    }
}
