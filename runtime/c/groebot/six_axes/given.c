/* Joints with given values between the six of a chain: see given.rs */

/* The motion of a given joint, for the cosine and sine of its angle, or its displacement divided by the chain's `length`. */
static gb_rigid gb_six_given_motion(const gb_given *joint, const gb_real *value)
{
    gb_rigid motion = gb_six_none;
    if (joint->slides) {
        for (int i = 0; i < 3; i++) {
            motion.translation[i] = joint->direction[i] * value[0];
        }
        return motion;
    }
    for (int j = 0; j < 3; j++) {
        gb_real column[3];
        gb_six_turned_about(joint->direction, gb_six_none.rotation[j], value, column);
        for (int i = 0; i < 3; i++) {
            motion.rotation[i][j] = column[i];
        }
    }
    gb_real point[3];
    gb_six_turned(&motion, joint->point, point);
    for (int i = 0; i < 3; i++) {
        motion.translation[i] = joint->point[i] - point[i];
    }
    return motion;
}

/* Moves the axes after a given joint by its motion. Joints closer to the tip have been taken already. */
static void gb_six_take(gb_chain *chain, const gb_given *joint, const gb_real *number)
{
    const gb_real share = R(1.0) / chain->length;
    const gb_real value[2] = {joint->slides ? number[0] * share : number[0], joint->slides ? R(0.0) : number[1]};
    gb_rigid motion = gb_six_given_motion(joint, value);
    gb_rigid frame = chain->steps[0];
    for (size_t place = 1; place < joint->before; place++) {
        frame = gb_six_after(&frame, &chain->steps[place]);
    }
    const gb_rigid back = gb_six_inverse(&frame), last = chain->last, end = chain->back;
    const gb_rigid here = gb_six_after(&frame, &chain->steps[joint->before]), there = gb_six_after(&motion, &here);
    chain->steps[joint->before] = gb_six_after(&back, &there);
    for (size_t place = joint->before; place < 6; place++) {
        gb_real moved[3];
        gb_six_turned(&motion, chain->directions[place], moved);
        memcpy(chain->directions[place], moved, sizeof moved);
        gb_six_moved(&motion, chain->points[place], moved);
        memcpy(chain->points[place], moved, sizeof moved);
        for (int side = 0; side < 2; side++) {
            gb_six_turned(&motion, chain->across[place][side], moved);
            memcpy(chain->across[place][side], moved, sizeof moved);
        }
    }
    chain->last = gb_six_after(&motion, &last);
    for (int i = 0; i < 3; i++) {
        motion.translation[i] = motion.translation[i] * chain->length;
    }
    const gb_rigid inverse = gb_six_inverse(&motion);
    chain->back = gb_six_after(&end, &inverse);
}

GB_LINKAGE size_t gb_six_axes_given(const gb_chain *chain, const gb_given *given, size_t count, const gb_real *numbers, gb_six_answer *out)
{
    gb_chain six = *chain;
    for (size_t k = count; k > 0; k--) {
        gb_six_take(&six, &given[k - 1], numbers + 12 + 2 * (k - 1));
    }
    return gb_six_axes(&six, numbers, out);
}
