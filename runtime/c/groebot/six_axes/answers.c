/* Solutions, and the state of the search for them: see answers.rs */

/* A list of joint vectors. */
typedef struct {
    gb_real list[GB_SIX_KEPT][6];
    size_t count;
} gb_six_list;

/* Distinct solutions, each with its residual. */
typedef struct {
    gb_real list[GB_SIX_KEPT][6];
    gb_real residual[GB_SIX_KEPT];
    size_t count;
} gb_six_distinct;

/* The state of the search at a target. */
typedef struct {
    gb_six_distinct answers;
    /* Candidates from which polishing failed: next to a self-motion an isolated solution may be near them. */
    gb_six_list lost;
    /* Candidates off the real line, or from which polishing failed at a displaced target: a curve may be next to them. */
    gb_six_list far;
    /* Whether complex solutions nearly meet, for a robot within `gb_chain.within`, and joint values near which that robot may have solutions. */
    bool is_meeting;
    gb_six_list meeting;
} gb_six_search;

/* The magnitude of a displacement; of an angle, reduced to (-pi, pi]. */
GB_INLINE gb_real gb_six_difference(gb_real delta, bool slides)
{
    const gb_real turns = slides ? R(0.0) : gb_round(delta / GB_TAU);
    return gb_magnitude(delta - GB_TAU * turns);
}

/* The largest difference of two joint vectors. */
static gb_real gb_six_distance(const gb_real *a, const gb_real *b, const bool *slides)
{
    gb_real most = R(0.0);
    for (int joint = 0; joint < 6; joint++) {
        most = gb_larger(most, gb_six_difference(a[joint] - b[joint], slides[joint]));
    }
    return most;
}

/* Whether no joint differs by more than a limit. */
static bool gb_six_is_within(const gb_real *a, const gb_real *b, const bool *slides, gb_real limit)
{
    for (int joint = 0; joint < 6; joint++) {
        if (gb_six_difference(a[joint] - b[joint], slides[joint]) > limit) {
            return false;
        }
    }
    return true;
}

/* Adds a joint vector if the list has none close to it. Angles that differ by whole turns are distinct. */
static void gb_six_remember(gb_six_list *list, const gb_real *q)
{
    static const bool slides[6] = {true, true, true, true, true, true};
    if (list->count == GB_SIX_KEPT) {
        return;
    }
    for (size_t k = 0; k < list->count; k++) {
        if (gb_six_is_within(list->list[k], q, slides, GB_MERGING_KNOWN)) {
            return;
        }
    }
    memcpy(list->list[list->count++], q, sizeof list->list[0]);
}

/* Stores a candidate from which polishing failed. */
static void gb_six_lose(gb_six_search *search, const gb_real *q)
{
    for (int joint = 0; joint < 6; joint++) {
        if (!gb_six_is_finite(q[joint])) {
            return;
        }
    }
    gb_six_remember(&search->lost, q);
}

/* Adds a solution; it replaces an equal one with a larger residual. */
static void gb_six_keep(gb_six_distinct *answers, const gb_real *q, gb_real residual, const bool *slides)
{
    size_t at = 0;
    while (at < answers->count && !gb_six_is_within(answers->list[at], q, slides, GB_MERGING_JOINTS)) {
        at++;
    }
    if (at == GB_SIX_KEPT || (at < answers->count && !(residual < answers->residual[at]))) {
        return;
    }
    memcpy(answers->list[at], q, sizeof answers->list[at]);
    answers->residual[at] = residual;
    answers->count += at == answers->count ? 1 : 0;
}

/* Whether joint values are a member of a self-motion, to first order. */
static bool gb_six_is_member(const gb_chain *chain, const gb_real *q)
{
    bool free[6], is_member = false;
    gb_six_find_free(chain, q, free);
    for (int joint = 0; joint < 6; joint++) {
        is_member = is_member || free[joint];
    }
    return is_member;
}

/* Replaces a member of a self-motion by an isolated solution. */
static GB_COLD void gb_six_displace(const gb_chain *chain, const gb_real *q, gb_real residual, gb_six_distinct *answers)
{
    bool is_new = !gb_six_is_member(chain, q);
    for (size_t k = 0; k < answers->count && is_new; k++) {
        is_new = !gb_six_is_within(answers->list[k], q, chain->slides, GB_MERGING_JOINTS);
    }
    for (size_t k = 0; k < answers->count && is_new; k++) {
        if (gb_six_is_member(chain, answers->list[k])) {
            memcpy(answers->list[k], q, sizeof answers->list[k]);
            answers->residual[k] = residual;
            return;
        }
    }
}

/* Adds a solution. Isolated solutions replace members of self-motions, of which there may be any number. */
static void gb_six_keep_answer(const gb_chain *chain, const gb_real *q, gb_real residual, gb_six_search *search)
{
    if (search->answers.count < GB_SIX_KEPT) {
        gb_six_keep(&search->answers, q, residual, chain->slides);
    } else {
        gb_six_displace(chain, q, residual, &search->answers);
    }
}

/* Moves angles into (-pi, pi]. */
static void gb_six_wrap(gb_real *q, const bool *slides)
{
    for (int joint = 0; joint < 6; joint++) {
        q[joint] = slides[joint] ? q[joint] : gb_wrap(q[joint]);
    }
}

/* Polishes joint values from a walk along a curve, and keeps the result if it is a new solution. */
static void gb_six_find(const gb_chain *chain, const gb_rigid *target, const gb_real *from, gb_six_search *search)
{
    gb_real q[6], start;
    memcpy(q, from, sizeof q);
    const gb_real residual = gb_six_polish(chain, q, target, &start);
    gb_six_wrap(q, chain->slides);
    if (!(residual <= GB_ACCEPTANCE_RESIDUAL_SIX)) {
        return;
    }
    for (size_t k = 0; k < search->answers.count; k++) {
        if (gb_six_is_within(search->answers.list[k], q, chain->slides, GB_MERGING_APART)) {
            return;
        }
    }
    gb_six_keep_answer(chain, q, residual, search);
}
