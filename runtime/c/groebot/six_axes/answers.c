/* Answers, and what a search for them remembers: answers.rs */

/* A list of joint vectors. */
typedef struct {
    gb_real list[GB_SIX_KEPT][6];
    size_t count;
} gb_six_list;

/* Answers that differ, each with its residual. */
typedef struct {
    gb_real list[GB_SIX_KEPT][6];
    gb_real residual[GB_SIX_KEPT];
    size_t count;
} gb_six_distinct;

/* What has been found at a target. */
typedef struct {
    gb_six_distinct answers;
    /* Where candidates were that polishing led nowhere: next to a self-motion some isolated answer may be near them. */
    gb_six_list lost;
    /* Candidates off the real line, or such that led to no answer, at a target aside: a curve may be next to them. */
    gb_six_list far;
    /* Whether complex solutions nearly meet, for a robot within `gb_chain.within`, and where such a robot may have answers. */
    bool is_meeting;
    gb_six_list meeting;
} gb_six_search;

/* The size of a way, of an angle's by the shorter way round. */
GB_INLINE gb_real gb_six_difference(gb_real way, bool slides)
{
    const gb_real turns = slides ? R(0.0) : gb_round(way / GB_TAU);
    return gb_magnitude(way - GB_TAU * turns);
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

/* Adds a joint vector if none is nearly the same, turns counted. */
static void gb_six_remember(gb_six_list *list, const gb_real *q)
{
    static const bool ways[6] = {true, true, true, true, true, true};
    if (list->count == GB_SIX_KEPT) {
        return;
    }
    for (size_t k = 0; k < list->count; k++) {
        if (gb_six_is_within(list->list[k], q, ways, GB_SIX_ALIKE)) {
            return;
        }
    }
    memcpy(list->list[list->count++], q, sizeof list->list[0]);
}

/* Remembers a candidate that polishing led nowhere. */
static void gb_six_lose(gb_six_search *search, const gb_real *q)
{
    for (int joint = 0; joint < 6; joint++) {
        if (!gb_six_is_finite(q[joint])) {
            return;
        }
    }
    gb_six_remember(&search->lost, q);
}

/* Adds an answer, in place of a worse equal one. */
static void gb_six_keep(gb_six_distinct *answers, const gb_real *q, gb_real residual, const bool *slides)
{
    size_t at = 0;
    while (at < answers->count && !gb_six_is_within(answers->list[at], q, slides, GB_SIX_MERGE)) {
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

/* Takes an isolated answer in place of a member of a self-motion. */
static GB_COLD void gb_six_displace(const gb_chain *chain, const gb_real *q, gb_real residual, gb_six_distinct *answers)
{
    bool is_new = !gb_six_is_member(chain, q);
    for (size_t k = 0; k < answers->count && is_new; k++) {
        is_new = !gb_six_is_within(answers->list[k], q, chain->slides, GB_SIX_MERGE);
    }
    for (size_t k = 0; k < answers->count && is_new; k++) {
        if (gb_six_is_member(chain, answers->list[k])) {
            memcpy(answers->list[k], q, sizeof answers->list[k]);
            answers->residual[k] = residual;
            return;
        }
    }
}

/* Adds an answer; members of self-motions, of which there may be any number, give way to isolated answers. */
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

/* Polishes joints that a walk along a curve has led to, and keeps them if they are an answer that is not known. */
static void gb_six_find(const gb_chain *chain, const gb_rigid *target, const gb_real *from, gb_six_search *search)
{
    gb_real q[6], start;
    memcpy(q, from, sizeof q);
    const gb_real residual = gb_six_polish(chain, q, target, &start);
    gb_six_wrap(q, chain->slides);
    if (!(residual <= GB_SIX_ACCEPT)) {
        return;
    }
    for (size_t k = 0; k < search->answers.count; k++) {
        if (gb_six_is_within(search->answers.list[k], q, chain->slides, GB_SIX_APART)) {
            return;
        }
    }
    gb_six_keep_answer(chain, q, residual, search);
}
