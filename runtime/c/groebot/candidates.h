/* Receiver of candidates */

#if GB_WIDTH == 1

/* The solutions of a target. By place: the numbers of the candidates that are waiting, and how each was found. */
struct gb_sink_1 {
    gb_answers all;
    gb_solution *out;
    /* The output for pairs, or null, and whether all candidates so far can be written as pairs. */
    gb_pairs *pairs;
    bool is_usual;
    /* What is searched for: all solutions, the candidate nearest to the target, a member of a self-motion, or solutions other than the `known` ones.
     * `moving` is the problem that known members of self-motions solve, else null. */
    enum gb_sought sought;
    size_t known;
    const gb_problem *ideal;
    uint32_t moving;
    /* The joints that at least one candidate frees. */
    uint32_t free;
    /* Whether only the usual cases have run. */
    bool is_ordinary;
    size_t waiting;
    gb_real at[GB_PLACES][GB_CANDIDATES];
    gb_found_1 found[GB_CANDIDATES];
    gb_real extras[GB_PLACES];
};

static GB_APART void gb_flush(gb_sink_1 *c);

/* Whether there were candidates after the first `candidates`, and each was a solution without polishing. Then no solution is lost beside a stratum. */
static GB_COLD bool gb_suffice_since(gb_sink_1 *c, size_t candidates)
{
    gb_flush(c);
    return c->all.candidates > candidates && c->all.unsound <= candidates;
}

/* Receives one candidate, or the second of a pair. */
GB_INLINE void gb_take_1(gb_sink_1 *c, const gb_found_1 *found, const gb_real *at)
{
    if (GB_SELDOM(c->waiting >= GB_CANDIDATES)) {
        gb_flush(c);
    }
    const size_t k = c->waiting;
    GB_UNROLL
    for (int i = 0; i < GB_PLACES; i++) {
        c->at[i][k] = at[i];
    }
    c->found[k] = *found;
    c->waiting = k + 1;
    c->all.candidates++;
}

#else

/* The candidates of several targets. */
struct GB_(sink) {
    T at[GB_CANDIDATES][GB_PLACES];
    T q[GB_CANDIDATES][GB_JOINTS];
    T residual[GB_CANDIDATES];
    T relative[GB_CANDIDATES];
    /* Which targets do not have this candidate. */
    GB_(truth) dead[GB_CANDIDATES];
    /* Which targets are not ordinary: a case of a stratum may run, roots are close, a candidate has a large residual, or two candidates are close. */
    GB_(truth) doubt;
    size_t branch[GB_CANDIDATES];
    size_t count;
};

/* Receives one candidate, or the second of a pair. */
GB_INLINE void GB_(take)(GB_(sink) *c, const GB_(found) *found, const T *at)
{
    const size_t k = c->count % GB_CANDIDATES;
    GB_UNROLL
    for (int i = 0; i < GB_PLACES; i++) {
        c->at[k][i] = at[i];
    }
    c->dead[k] = found->dead;
    c->branch[k] = found->branch;
    c->doubt |= found->close & ~found->dead;
    c->count = k + 1;
}

#endif

#ifdef GROEBOT_SIX_AXES_H
/* All values of six joints that reach a target. Not available for several targets at once, whose programs do not use it. */
GB_INLINE size_t GB_(six_axes)(const gb_chain *chain, const T *target, gb_six_answer *out)
{
#if GB_WIDTH == 1
    return gb_six_axes(chain, target, out);
#else
    (void)chain;
    (void)target;
    (void)out;
    return 0;
#endif
}

/* As above, with the values of given joints between the six after the target. */
GB_INLINE size_t GB_(six_axes_given)(const gb_chain *chain, const gb_given *given, size_t count, const T *numbers, gb_six_answer *out)
{
#if GB_WIDTH == 1
    return gb_six_axes_given(chain, given, count, numbers, out);
#else
    (void)chain;
    (void)given;
    (void)count;
    (void)numbers;
    (void)out;
    return 0;
#endif
}

/* The branch of a solution for six axes: its free joints are free, and it is doubtful where it is only near a solution. */
GB_INLINE GB_(found) GB_(by_answer)(GB_(found) found, const gb_six_answer *answer, uint32_t a, uint32_t b, uint32_t c, uint32_t d,
                                    uint32_t e, uint32_t f)
{
    const uint32_t bits[6] = {a, b, c, d, e, f};
    uint32_t free = 0;
    for (int joint = 0; joint < 6; joint++) {
        free |= answer->free[joint] ? bits[joint] : 0;
    }
    found = GB_(freeing)(found, free);
    if (answer->lost) {
        found.close |= GB_(at_most)(GB_(of)(R(0.0)), GB_(of)(R(1.0)));
    }
    return found;
}
#endif

/* Whether a case runs that applies to ordinary targets. */
GB_INLINE bool GB_(is_usual)(GB_(sink) *c, GB_(guard) guard)
{
#if GB_WIDTH == 1
    if (GB_SELDOM(!guard.here)) {
        c->is_ordinary = false;
    }
    return guard.here;
#else
    c->doubt |= ~guard.here;
    return true;
#endif
}

/* Whether a case runs that applies to singular targets. */
GB_INLINE bool GB_(is_rare)(GB_(sink) *c, GB_(guard) guard)
{
#if GB_WIDTH == 1
    if (GB_SELDOM(guard.here)) {
        c->is_ordinary = false;
    }
    return GB_SELDOM(guard.here);
#else
    c->doubt |= guard.here;
    return false;
#endif
}

/* Whether the case of a stratum runs. It runs near the stratum. If the candidates after the first `before` lost no solution and none has close roots, it
 * runs only within rounding. The error of a double root is the square root of the rounding error, so that the stratum may be nearer than it appears. */
GB_INLINE bool GB_(is_due)(GB_(sink) *c, size_t before, GB_(guard) guard)
{
#if GB_WIDTH == 1
    if (!GB_(is_rare)(c, guard)) {
        return false;
    }
    const bool suffices = gb_suffice_since(c, before);
    c->all.suffices = c->all.suffices && suffices;
    return guard.beside || !suffices || c->all.doubted > before;
#else
    (void)before;
    return GB_(is_rare)(c, guard);
#endif
}

/* Number of candidates so far. */
GB_INLINE size_t GB_(count)(const GB_(sink) *c)
{
#if GB_WIDTH == 1
    return c->all.candidates;
#else
    (void)c;
    return 0;
#endif
}

/* Records whether the target is on a stratum for which no derivation exists. */
GB_INLINE void GB_(is_open)(GB_(sink) *c, GB_(guard) guard)
{
#if GB_WIDTH == 1
    c->all.is_open = c->all.is_open || guard.here;
#else
    c->doubt |= guard.here;
#endif
}

/* The index of the greatest number that is not negative, the first of equals. The length of the list if all are negative. In lanes all must agree. */
GB_INLINE size_t GB_(elect)(GB_(sink) *c, const T *claims, size_t count)
{
    size_t first = count;
    for (int lane = 0; lane < GB_WIDTH; lane++) {
        gb_real most = R(-1.0);
        size_t place = count;
        for (size_t i = 0; i < count; i++) {
#if GB_WIDTH == 1
            const gb_real claim = claims[i];
#else
            const gb_real claim = claims[i][lane];
#endif
            if (claim > most) {
                most = claim;
                place = i;
            }
        }
        first = lane == 0 ? place : first;
#if GB_WIDTH > 1
        c->doubt[lane] |= place == first ? 0 : -1;
#endif
    }
    (void)c;
    return first;
}

/* Receives a candidate, or a pair. */
GB_INLINE void GB_(finish)(GB_(sink) *c, GB_(found) found, const T *at)
{
    GB_(take)(c, &found, at);
#ifdef GB_TURNED
    if (found.is_pair) {
        T turned[GB_PLACES];
        GB_UNROLL
        for (int i = 0; i < GB_PLACES; i++) {
            turned[i] = at[i];
        }
        GB_UNROLL
        for (size_t i = 0; i < sizeof gb_turned; i++) {
            turned[gb_turned[i]] = -turned[gb_turned[i]];
        }
        found.branch++;
        GB_(take)(c, &found, turned);
    }
#endif
}
