/* The solver: formulations are tried in turn until one is reliable: see solve.rs */

/* A target, and its displaced copy for one attempt. */
typedef struct {
    const gb_chain *chain;
    size_t number;
    /* Size of the displacement. */
    gb_real size;
    /* The rigid motion from the tip's pose at zero to the target. */
    const gb_rigid *goal;
    /* The frame of the last joint at the target, and at the displaced target. */
    const gb_rigid *target;
    gb_rigid near;
    /* The joint whose line is used. */
    size_t missing;
} gb_six_attempt;

/* The result of an attempt. */
typedef struct {
    /* The solutions of this attempt alone. */
    gb_six_distinct own;
    /* Number of candidates from which polishing failed. */
    size_t lost;
    /* The largest residual of a candidate before polishing. */
    gb_real worst;
} gb_six_tally;

/* A small motion by `size` (rad, and relative to the length scale), different for each attempt. */
static gb_rigid gb_six_aside(gb_real size, size_t attempt)
{
    const gb_real sign = attempt % 2 == 0 ? size : -size, c = gb_cosine(sign), s = gb_sine(sign), *w = gb_six_direction;
    gb_rigid motion = gb_six_none;
    for (int j = 0; j < 3; j++) {
        const gb_real *v = gb_six_none.rotation[j], along = gb_six_dot(w, v) * (R(1.0) - c);
        gb_real third[3];
        gb_six_cross(w, v, third);
        for (int i = 0; i < 3; i++) {
            motion.rotation[i][j] = c * v[i] + s * third[i] + along * w[i];
        }
    }
    motion.translation[0] = R(-0.7) * sign;
    motion.translation[1] = R(0.5) * sign;
    motion.translation[2] = R(0.3) * sign;
    return motion;
}

/* Moves joint values from the displaced target to the target in stages, each at a quarter of the distance of the one before. Next to a self-motion the
 * curvature grows with the inverse distance from it, and steps must be shorter. Returns the residual at the target; `last` has the joints of the last stage
 * that succeeded. */
static gb_real gb_six_lead(const gb_six_attempt *attempt, gb_real *q, gb_real *last)
{
    gb_real residual = R(1.0), size = attempt->size, start;
    for (int stage = 0; stage < GB_SIX_STAGES; stage++) {
        size = stage + 1 < GB_SIX_STAGES ? R(0.25) * size : R(0.0);
        const gb_rigid motion = gb_six_aside(size, attempt->number), near = gb_six_after(&motion, attempt->goal);
        const gb_rigid target = gb_six_after(&near, &attempt->chain->last);
        residual = gb_six_polish(attempt->chain, q, &target, &start);
        if (residual > GB_ACCEPTANCE_RESIDUAL_SIX) {
            break;
        }
        memcpy(last, q, 6 * sizeof *last);
    }
    return residual;
}

/* Moves joint values from the displaced target to the target, at once or in stages. Returns the residual; `last` has the last joint values that were
 * reached. */
static GB_APART gb_real gb_six_bring_back(const gb_six_attempt *attempt, gb_real *q, gb_real *last)
{
    gb_real start;
    memcpy(last, q, 6 * sizeof *last);
    const gb_real residual = gb_six_polish(attempt->chain, q, attempt->target, &start);
    if (residual <= GB_ACCEPTANCE_RESIDUAL_SIX) {
        return residual;
    }
    memcpy(q, last, 6 * sizeof *q);
    return gb_six_lead(attempt, q, last);
}

/* The squared depth of complex solutions that may be real for a robot within the tolerance. */
static gb_real gb_six_parted(const gb_chain *chain)
{
    return gb_larger(GB_SIX_OFF * chain->within, gb_smaller(GB_SIX_FAR_OFF * chain->within, GB_EIGENVALUES_BLURRED * GB_EIGENVALUES_BLURRED));
}

/* Polishes a candidate, and keeps or stores it. */
static void gb_six_follow(const gb_six_attempt *attempt, const gb_six_candidate *candidate, gb_six_search *search, gb_six_tally *tally)
{
    const gb_chain *chain = attempt->chain;
    const gb_real deep = candidate->depth * candidate->depth, accuracy = gb_larger(tally->worst, GB_EIGENVALUES_ACCURACY);
    const bool is_far = deep > GB_SIX_FAR_OFF * accuracy, is_aside = attempt->size > R(0.0);
    gb_real q[6], first[6], last[6], start;
    search->is_meeting |= !is_aside && deep > R(0.0) && deep <= gb_six_parted(chain);
    if ((is_far && !is_aside) || gb_six_has_infinite(chain, candidate->q)) {
        return;
    }
    memcpy(q, candidate->q, sizeof q);
    q[attempt->missing] = gb_six_closing(chain, q, attempt->missing, &attempt->near);
    memcpy(first, q, sizeof q);
    if (is_far) {
        gb_six_remember(&search->far, first);
        return;
    }
    gb_real residual = gb_six_polish(chain, q, &attempt->near, &start);
    memcpy(last, q, sizeof q);
    if (is_aside) {
        residual = gb_six_bring_back(attempt, q, last);
    }
    if (is_aside && (residual > GB_ACCEPTANCE_RESIDUAL_SIX || candidate->depth > R(0.0))) {
        gb_six_remember(&search->far, first);
    }
    if (residual <= GB_ACCEPTANCE_RESIDUAL_SIX) {
        tally->worst = candidate->depth == R(0.0) ? gb_larger(tally->worst, start) : tally->worst;
        gb_six_wrap(q, chain->slides);
        gb_six_keep_answer(chain, q, residual, search);
        gb_six_keep(&tally->own, q, residual, chain->slides);
    } else if (deep <= GB_SIX_OFF * accuracy) {
        tally->lost++;
        gb_six_lose(search, last);
    }
}

/* Adds the solutions of one formulation. Returns whether it is reliable. */
static bool gb_six_run(const gb_six_attempt *attempt, const gb_rigid *displacement, gb_six_search *search)
{
    const size_t known = search->answers.count;
    const bool is_aside = attempt->size > R(0.0);
    const gb_real blurred = gb_larger(GB_EIGENVALUES_BLURRED, gb_square_root(GB_SIX_OFF * attempt->chain->within));
    gb_six_candidates candidates;
    gb_six_tally tally;
    if (!gb_six_find_candidates(attempt->chain, displacement, attempt->number, is_aside ? GB_SIX_DEEPEST : blurred, &candidates)
        || candidates.conditioning < GB_PIVOTS_SINGULAR_PENCIL) {
        return false;
    }
    search->is_meeting |= candidates.conditioning < attempt->chain->within;
    tally.own.count = tally.lost = 0;
    tally.worst = R(0.0);
    for (size_t k = 0; k < candidates.count; k++) {
        gb_six_follow(attempt, &candidates.list[k], search, &tally);
    }
    const size_t count = search->answers.count;
    const bool is_unreachable = candidates.count == 0 && candidates.conditioning >= GB_PIVOTS_REGULAR_SIX, nothing_lost = search->lost.count == 0;
    const bool is_clear = tally.lost == 0 && count % 2 == 0 && !candidates.are_crowded && (count > 0 || is_unreachable);
    const bool is_confirmed = attempt->number > 0 && known == count && tally.own.count == count && nothing_lost;
    const bool is_sound = tally.worst <= GB_ACCEPTANCE_UNSETTLED_EIGENVALUES && candidates.conditioning >= GB_PIVOTS_SINGULAR_SOUND;
    return is_clear && (is_confirmed || (is_sound && (!is_aside || nothing_lost)));
}

/* Runs formulations until one is reliable. Returns their number. Lost candidates are then removed. */
static size_t gb_six_search_all(const gb_chain *chain, const gb_rigid *goal, const gb_rigid *target, gb_six_search *search)
{
    for (size_t number = 0; number < GB_SIX_ATTEMPTS; number++) {
        gb_six_attempt attempt;
        /* Each formulation runs once at the target itself: a repetition would have the same result. */
        if (!(gb_six_disturbances[number] > R(0.0)) && number >= chain->formulation_count) {
            continue;
        }
        attempt.chain = chain;
        attempt.number = number;
        attempt.size = gb_six_disturbances[number];
        attempt.goal = goal;
        attempt.target = target;
        attempt.missing = gb_six_joint(gb_six_formulation(chain, number), 3);
        /* One run at a displaced target shows too few of the solutions nearby. */
        const bool is_first_aside = number > 0 && attempt.size > R(0.0) && gb_six_disturbances[number - 1] == R(0.0);
        if (is_first_aside) {
            search->lost.count = 0;
        }
        const gb_rigid motion = gb_six_aside(attempt.size, number), displacement = gb_six_after(&motion, goal);
        attempt.near = gb_six_after(&displacement, &chain->last);
        if (gb_six_run(&attempt, &displacement, search) && !is_first_aside) {
            search->lost.count = 0;
            return number + 1;
        }
    }
    return GB_SIX_ATTEMPTS;
}

/* Solves targets next to this one, on both sides: on one of them two complex solutions are real. Those that lead to no solution here are near one of the
 * robot of interest. */
static GB_APART void gb_six_meet(const gb_chain *chain, const gb_rigid *goal, const gb_rigid *target, gb_six_search *search)
{
    for (size_t k = 0; k < GB_SIX_MEETINGS; k++) {
        const size_t number = k % 2, missing = gb_six_joint(gb_six_formulation(chain, number), 3);
        const gb_rigid motion = gb_six_aside(gb_six_meetings[k] * chain->within, number), displacement = gb_six_after(&motion, goal);
        const gb_rigid near = gb_six_after(&displacement, &chain->last);
        gb_six_candidates candidates;
        if (!gb_six_find_candidates(chain, &displacement, number, R(0.0), &candidates)) {
            continue;
        }
        for (size_t i = 0; i < candidates.count; i++) {
            gb_real *q = candidates.list[i].q, start;
            q[missing] = gb_six_closing(chain, q, missing, &near);
            if (gb_six_polish(chain, q, &near, &start) <= GB_ACCEPTANCE_RESIDUAL_SIX && gb_six_polish(chain, q, target, &start) > GB_ACCEPTANCE_RESIDUAL_SIX) {
                gb_six_remember(&search->meeting, q);
            }
        }
    }
}

static bool gb_six_is_sorted(const gb_real *a, const gb_real *b)
{
    for (int k = 0; k < 6; k++) {
        if (a[k] != b[k]) {
            return a[k] < b[k];
        }
    }
    return true;
}

/* Joint values in the unit of the target. */
static gb_six_answer gb_six_answer_of(const gb_chain *chain, const gb_real *q, bool lost)
{
    gb_six_answer answer;
    for (int joint = 0; joint < 6; joint++) {
        answer.q[joint] = chain->slides[joint] ? q[joint] * chain->length : q[joint];
        answer.free[joint] = false;
    }
    answer.lost = lost;
    return answer;
}

/* Writes the solutions, in the unit of the target. Returns their number. */
static size_t gb_six_write_answers(const gb_chain *chain, const gb_six_search *search, bool is_isolated, gb_six_answer *out)
{
    size_t count = 0;
    for (; count < search->answers.count; count++) {
        gb_six_answer answer = gb_six_answer_of(chain, search->answers.list[count], false);
        if (!is_isolated) {
            gb_six_find_free(chain, search->answers.list[count], answer.free);
        }
        size_t place = count;
        for (; place > 0 && !gb_six_is_sorted(out[place - 1].q, answer.q); place--) {
            out[place] = out[place - 1];
        }
        out[place] = answer;
    }
    for (size_t k = 0; k < search->lost.count; k++) {
        out[count++] = gb_six_answer_of(chain, search->lost.list[k], true);
    }
    for (size_t k = 0; k < search->meeting.count && count < GB_SIX_ROOM; k++) {
        out[count++] = gb_six_answer_of(chain, search->meeting.list[k], true);
    }
    return count;
}

GB_LINKAGE size_t gb_six_axes(const gb_chain *chain, const gb_real *target, gb_six_answer *out)
{
    gb_rigid pose;
    gb_six_search search;
    memcpy(pose.translation, target, sizeof pose.translation);
    memcpy(pose.rotation, target + 3, sizeof pose.rotation);
    gb_rigid goal = gb_six_after(&pose, &chain->back);
    for (int i = 0; i < 3; i++) {
        goal.translation[i] = goal.translation[i] * (R(1.0) / chain->length);
    }
    const gb_rigid end = gb_six_after(&goal, &chain->last);
    search.answers.count = search.lost.count = search.far.count = search.meeting.count = 0;
    search.is_meeting = false;
    const size_t runs = gb_six_search_all(chain, &goal, &end, &search);
    if (runs > 1) {
        gb_six_walk_from(chain, &end, &search);
    }
    if (search.is_meeting) {
        gb_six_meet(chain, &goal, &end, &search);
    }
    /* The first run shows a reliable result only where there is no self-motion. */
    return gb_six_write_answers(chain, &search, runs == 1, out);
}
