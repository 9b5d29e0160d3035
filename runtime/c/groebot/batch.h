/* Many targets, several at once */

/* The numbers of 1 to GB_WIDTH targets. Where one is infinite, NaN, or breaks a condition, all are doubtful. */
GB_INLINE GB_(truth) GB_(gather)(const gb_real *targets, size_t count, T *target)
{
    GB_(truth) fine = ~GB_(nowhere)();
    for (int i = 0; i < GB_INPUTS; i++) {
        T numbers = GB_(of)(targets[i]);
        for (size_t lane = 1; lane < GB_WIDTH; lane++) {
            numbers[lane] = targets[(size_t)((lane < count ? lane : count - 1) * GB_INPUTS + i)];
        }
        target[i] = numbers;
        fine &= GB_(at_most)(GB_(abs)(target[i]), GB_(of)(GB_GREATEST));
    }
#ifdef GB_CONDITIONS
    for (size_t i = 0; i < sizeof gb_conditions / sizeof gb_conditions[0]; i++) {
        fine &= GB_(fulfil)(gb_conditions[i], target);
    }
#endif
    return fine;
}

/* Marks targets with a candidate whose residual is too large. */
GB_INLINE void GB_(measure)(GB_(sink) *c, const T *p)
{
    for (int k = 0; k < GB_CANDIDATES; k += GB_TWINS) {
        T residual, relative;
        GB_(fit)(p, c->at[k], &residual, &relative);
        for (int twin = 0; twin < GB_TWINS; twin++) {
            c->residual[k + twin] = residual;
            c->relative[k + twin] = relative;
        }
        c->doubt |= ~(GB_(exceeds)(GB_(of)(GB_ACCEPTANCE_ROUNDING), relative) | c->dead[k]);
    }
}

/* Whether two candidates are close to each other. */
GB_INLINE GB_(truth) GB_(are_near)(const T *a, const T *b)
{
    GB_(truth) near = ~GB_(nowhere)();
    for (int i = 0; i < GB_JOINTS; i++) {
        const gb_joint joint = gb_joints[gb_last_first[i]];
        const size_t cosine = joint.places[0], sine = joint.places[1];
        if (joint.is_angle) {
            near &= ~GB_(exceeds)(GB_(of)(GB_FAR_APART), a[cosine] * b[cosine] + a[sine] * b[sine]);
            if (!GB_(any)(near)) {
                break;
            }
        }
    }
    return near;
}

/* Marks targets with two candidates close to each other. One of each group of twins is compared: its twins have equal distances. */
GB_INLINE void GB_(tell_apart)(GB_(sink) *c)
{
    for (int k = 0; k < GB_CANDIDATES; k += GB_TWINS) {
        for (int other = 0; other < k + GB_TWINS; other++) {
            const GB_(truth) alive = ~(c->dead[k] | c->dead[other]);
            if (other != k && GB_(any)(alive)) {
                c->doubt |= alive & GB_(are_near)(c->at[k], c->at[other]);
            }
        }
    }
}

/* Computes the joint values, angles only if they are wanted. Marks targets where these are not finite. */
GB_INLINE void GB_(find_joints)(GB_(sink) *c, bool wants_angles)
{
    for (int i = 0; i < GB_JOINTS; i++) {
        const size_t first = gb_joints[i].places[0], second = gb_joints[i].places[1];
        GB_(truth) sound = {0};
        T acute = GB_(of)(R(0.0));
        for (int k = 0; k < GB_CANDIDATES; k++) {
            const T cosine = c->at[k][first], sine = c->at[k][second];
            if (!gb_joints[i].is_angle) {
                c->q[k][i] = cosine;
                sound = GB_(exceeds)(GB_(of)(GB_GREATEST), GB_(abs)(cosine));
            } else {
                if (k % gb_runs[i] == 0) {
                    sound = GB_(exceeds)(GB_(of)(GB_ACCEPTANCE_ROUNDING), GB_(abs)(cosine * cosine + sine * sine - R(1.0)));
                    acute = wants_angles ? GB_(acute)(GB_(abs)(cosine), GB_(abs)(sine)) : acute;
                }
                if (wants_angles) {
                    c->q[k][i] = GB_(unfold)(acute, cosine, sine);
                }
            }
            c->doubt |= ~(sound | c->dead[k]);
        }
    }
}

/* Finds the candidates of up to GB_WIDTH targets. */
GB_INLINE void GB_(find)(GB_(sink) *c, const gb_real *targets, size_t count, bool wants_angles)
{
    T target[GB_INPUTS], p[GB_PARAMETERS];
    c->doubt = ~GB_(gather)(targets, count, target);
    c->count = 0;
    GB_(parameters)(target, p);
    GB_(walk)(p, c);
    GB_(measure)(c, p);
    GB_(tell_apart)(c);
    GB_(find_joints)(c, wants_angles);
}

/* Writes the solutions of the target in a lane and returns their number. `room` must hold all candidates. */
GB_INLINE size_t GB_(write_solutions)(const GB_(sink) *c, size_t lane, gb_solution *room)
{
    size_t count = 0;
    for (int k = 0; k < GB_CANDIDATES; k++) {
        gb_solution *out = &room[count];
        GB_UNROLL
        for (int i = 0; i < GB_JOINTS; i++) {
            out->q[i] = c->q[k][i][lane];
        }
        out->residual = c->residual[k][lane];
        out->relative = c->relative[k][lane];
        out->branch = c->branch[k];
        out->chosen = false;
        out->free = 0;
        out->settled = true;
        count += c->dead[k][lane] == 0;
    }
    return count;
}

/* Writes the solutions of the target in a lane by cosines and sines. */
GB_INLINE size_t GB_(write_pairs)(const GB_(sink) *c, size_t lane, gb_pairs *room)
{
    size_t count = 0;
    for (int k = 0; k < GB_CANDIDATES; k++) {
        gb_pairs *out = &room[count];
        GB_UNROLL
        for (int i = 0; i < GB_JOINTS; i++) {
            const gb_joint joint = gb_joints[i];
            out->joints[i][0] = joint.is_angle ? c->at[k][joint.places[0]][lane] + R(0.0) : c->at[k][joint.places[0]][lane];
            out->joints[i][1] = joint.is_angle ? c->at[k][joint.places[1]][lane] + R(0.0) : R(0.0);
        }
        out->residual = c->residual[k][lane];
        out->branch = c->branch[k];
        out->free = 0;
        out->settled = true;
        count += c->dead[k][lane] == 0;
    }
    return count;
}

static GB_COLD int gb_solve_into(const gb_real *target, gb_solution *solutions, gb_pairs *pairs, size_t room);

/* Implements NAME_solve_batch, or NAME_solve_pairs_batch where `solutions` is null (see GB_DECLARE). */
GB_INLINE size_t GB_(solve_many)(const gb_real *targets, size_t count, gb_solution *solutions, gb_pairs *pairs, size_t room, int *counts)
{
    GB_(sink) c;
    memset(&c, 0, sizeof c);
    size_t filled = 0;
    for (size_t done = 0; done < count; done++) {
        const size_t lane = done % GB_WIDTH;
        const gb_real *target = targets + done * GB_INPUTS;
        gb_solution *solution = solutions ? solutions + filled : NULL;
        gb_pairs *pair = pairs ? pairs + filled : NULL;
        if (lane == 0) {
            GB_(find)(&c, target, count - done, solutions != NULL);
        }
        if (c.doubt[lane] == 0 && room - filled >= GB_CANDIDATES) {
            counts[done] = (int)(solutions ? GB_(write_solutions)(&c, lane, solution) : GB_(write_pairs)(&c, lane, pair));
        } else {
            const int found = gb_solve_into(target, solution, pair, room - filled);
            if (found > 0 && (size_t)found > room - filled) {
                return done;
            }
            counts[done] = found;
        }
        filled += counts[done] > 0 ? (size_t)counts[done] : 0;
    }
    return count;
}
