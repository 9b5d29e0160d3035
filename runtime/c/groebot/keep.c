/* The list of solutions: equal ones are merged as they are kept: see keep.rs */

/* A solution in a robot's list, in the form that groebot.c uses. */
typedef struct {
    gb_real q[GB_MAX_JOINTS];
    gb_fit fit;
    size_t branch;
    uint32_t free;
} gb_answer;

/* Maximal number of solutions that are compared with a new one. */
#define GB_MOST_ANSWERS 4096

static char *gb_at(const gb_answers *all, size_t i)
{
    return (char *)all->out + i * all->problem.mechanism->solution;
}

static gb_real *gb_q_of(const gb_answers *all, size_t i)
{
    return (gb_real *)(void *)gb_at(all, i);
}

static gb_real *gb_residual_of(const gb_answers *all, size_t i)
{
    return (gb_real *)(void *)(gb_at(all, i) + all->problem.mechanism->residual);
}

static gb_real *gb_relative_of(const gb_answers *all, size_t i)
{
    return (gb_real *)(void *)(gb_at(all, i) + all->problem.mechanism->relative);
}

static size_t *gb_branch_of(const gb_answers *all, size_t i)
{
    return (size_t *)(void *)(gb_at(all, i) + all->problem.mechanism->branch);
}

static bool *gb_chosen_of(const gb_answers *all, size_t i)
{
    return (bool *)(void *)(gb_at(all, i) + all->problem.mechanism->chosen);
}

static uint32_t *gb_free_of(const gb_answers *all, size_t i)
{
    return (uint32_t *)(void *)(gb_at(all, i) + all->problem.mechanism->free);
}

/* Appends a solution. */
static void gb_write(gb_answers *all, const gb_answer *answer)
{
    const size_t i = all->count++;
    gb_copy(gb_q_of(all, i), answer->q, all->problem.mechanism->joints);
    *gb_residual_of(all, i) = answer->fit.residual;
    *gb_relative_of(all, i) = answer->fit.relative;
    *gb_branch_of(all, i) = answer->branch;
    *gb_chosen_of(all, i) = false;
    *gb_free_of(all, i) = answer->free;
}

/* Exchanges two solutions. */
static void gb_swap(gb_answers *all, size_t i, size_t k)
{
    char *a = gb_at(all, i), *b = gb_at(all, k);
    for (size_t byte = 0; byte < all->problem.mechanism->solution; byte++) {
        const char other = a[byte];
        a[byte] = b[byte];
        b[byte] = other;
    }
}

/* Drops a solution. */
static void gb_drop(gb_answers *all, size_t i)
{
    const size_t size = all->problem.mechanism->solution;
    all->count--;
    memmove(gb_at(all, i), gb_at(all, i + 1), (all->count - i) * size);
}

/* Stores a candidate that is not a solution if its residual is the least so far. */
static void gb_miss(gb_answers *all, const gb_real *q, const gb_fit *fit)
{
    if (!fit->accepted && gb_is_finite(fit->relative) && !(all->has_nearest && fit->relative >= all->nearest_fit.relative)) {
        all->has_nearest = true;
        all->nearest_fit = *fit;
        gb_copy(all->nearest, q, all->problem.mechanism->joints);
    }
}

/* Whether an isolated solution is known to be on no self-motion of these joints. */
static bool gb_is_known_isolated(const gb_answers *all, const gb_real *q, uint32_t free)
{
    for (size_t i = 0; i < GB_KNOWN_ISOLATED && i < all->known_isolated_count; i++) {
        bool is_same = all->known_isolated_of[i] == free;
        for (size_t k = 0; k < all->problem.mechanism->joints; k++) {
            is_same = is_same && all->known_isolated[i][k] == q[k];
        }
        if (is_same) {
            return true;
        }
    }
    return false;
}

/* Whether an isolated solution belongs to the self-motion of a member. If the cases before have lost no solution, the residual of the self-motion may be
 * larger. */
static bool gb_is_on(gb_answers *all, const gb_real *member, uint32_t free, const gb_real *isolated)
{
    if (gb_is_known_isolated(all, isolated, free)) {
        return false;
    }
    if (!gb_is_on_self_motion(&all->problem, isolated, free, GB_ACCEPTANCE_ROUNDING)) {
        const size_t next = all->known_isolated_count++ % GB_KNOWN_ISOLATED;
        gb_copy(all->known_isolated[next], isolated, all->problem.mechanism->joints);
        all->known_isolated_of[next] = free;
        return false;
    }
    return !all->suffices || gb_leads_to(&all->problem, member, isolated, free);
}

/* Whether two close solutions are one at a singular configuration, where the equations determine the joints less exactly than GB_MERGING_JOINTS. Half-way
 * between them the residual is then no larger than at the worse of the two. */
static bool gb_are_blurred(const gb_problem *problem, const gb_real *a, gb_real of_a, const gb_real *b, gb_real of_b)
{
    const gb_real bound = gb_larger(gb_larger(of_a, of_b), GB_MERGING_HALFWAY);
    const bool is_near = gb_farthest(problem->mechanism, a, b) <= GB_MERGING_BLUR;
    if (bound <= GB_ACCEPTANCE_ROUNDING && is_near && gb_regularity(problem, b) > GB_PIVOTS_ISOLATED) {
        return false;
    }
    return gb_are_joined(problem, a, b, bound, 0);
}

/* Whether members of one branch count as one self-motion: where it is not a curve, or its residual exceeds rounding. */
static bool gb_are_by_branch(const gb_answers *all, size_t i, const gb_answer *b)
{
    const gb_real relative = gb_larger(*gb_relative_of(all, i), b->fit.relative);
    gb_real tangent[GB_MAX_JOINTS];
    return *gb_branch_of(all, i) == b->branch && !(relative <= GB_ACCEPTANCE_ROUNDING && gb_find_tangent(&all->problem, b->q, b->free, tangent));
}

/* Whether a solution in the list and a new one count as one when no steps are left to distinguish them: members of one branch, or solutions that polishing
 * might have merged. */
static bool gb_are_alike(const gb_answers *all, size_t i, const gb_answer *b)
{
    const gb_real relative = gb_larger(*gb_relative_of(all, i), b->fit.relative);
    if (*gb_free_of(all, i) == 0 && b->free == 0) {
        return relative > GB_ACCEPTANCE_RESIDUAL && gb_farthest(all->problem.mechanism, gb_q_of(all, i), b->q) <= GB_MERGING_BLUR;
    }
    return *gb_branch_of(all, i) == b->branch && *gb_free_of(all, i) == b->free;
}

/* Whether a solution in the list and a new one are one: members of one self-motion, one singular configuration, or within GB_MERGING_JOINTS without the
 * joints that are free in either. */
static bool gb_is_one(gb_answers *all, size_t i, const gb_answer *b)
{
    const gb_problem *problem = &all->problem;
    const gb_real *a = gb_q_of(all, i), relative = *gb_relative_of(all, i);
    const uint32_t free = *gb_free_of(all, i);
    if (gb_is_close(problem->mechanism, a, b->q, free | b->free, GB_MERGING_JOINTS)) {
        return true;
    }
    if (gb_are_spent(problem)) {
        return gb_are_alike(all, i, b);
    }
    if (free == 0 && b->free == 0) {
        return gb_are_blurred(problem, a, relative, b->q, b->fit.relative);
    }
    if (free != 0 && b->free != 0) {
        const bool are_apart = all->is_another && relative <= GB_ACCEPTANCE_ROUNDING && *gb_branch_of(all, i) == b->branch;
        return free == b->free && !are_apart && (gb_are_by_branch(all, i, b) || gb_leads_to(problem, a, b->q, free));
    }
    if (free == 0) {
        return b->fit.relative <= GB_ACCEPTANCE_ROUNDING && gb_is_on(all, b->q, b->free, a);
    }
    return relative <= GB_ACCEPTANCE_ROUNDING && gb_is_on(all, a, free, b->q);
}

/* Whether a solution in the list is kept when a new one is equal to it: the better one is kept. However, a self-motion within rounding is preferred to its
 * isolated members, and its first member to the later ones. */
static bool gb_holds_against(const gb_answers *all, size_t i, const gb_answer *b)
{
    const gb_real relative = *gb_relative_of(all, i);
    const bool is_isolated = *gb_free_of(all, i) == 0;
    if (is_isolated && b->free != 0 && b->fit.relative <= GB_ACCEPTANCE_ROUNDING) {
        return false;
    }
    return (!is_isolated && relative <= GB_ACCEPTANCE_ROUNDING) || relative <= b->fit.relative;
}

/* Adds a solution. If there are too many, the worst is dropped. */
static void gb_add(gb_answers *all, const gb_answer *answer)
{
    if (all->count == all->room) {
        size_t worst = 0;
        for (size_t i = 1; i < all->count; i++) {
            worst = *gb_relative_of(all, i) >= *gb_relative_of(all, worst) ? i : worst;
        }
        if (!(all->room > 0 && answer->fit.relative < *gb_relative_of(all, worst))) {
            return;
        }
        gb_drop(all, worst);
    }
    gb_write(all, answer);
}

/* Whether a solution has this branch. */
static bool gb_is_taken(const gb_answers *all, size_t branch)
{
    for (size_t i = 0; i < all->count; i++) {
        if (*gb_branch_of(all, i) == branch) {
            return true;
        }
    }
    return false;
}

/* The first branch without a solution, from that of a candidate on: a second root of a double one gets the next free number below `last`. */
static size_t gb_free_branch(const gb_answers *all, const gb_found_1 *found)
{
    const size_t next = found->free == 0 ? found->last : found->branch;
    for (size_t branch = found->branch; branch < next; branch++) {
        if (!gb_is_taken(all, branch)) {
            return branch;
        }
    }
    return found->branch;
}

/* Where several joints are free, records that members of a candidate's branch are on a self-motion in the list. */
static void gb_remember_merged(gb_answers *all, size_t i, const gb_answer *answer, const gb_found_1 *found)
{
    const bool are_sharp = gb_larger(*gb_relative_of(all, i), answer->fit.relative) <= GB_ACCEPTANCE_ROUNDING;
    if (are_sharp && *gb_free_of(all, i) == found->free && !gb_is_single(found->free) && found->free != 0 && all->merged_count < GB_KINDS) {
        all->merged[all->merged_count++] = *found;
    }
}

/* Keeps a solution where others are near. */
static void gb_keep_one(gb_answers *all, gb_answer *answer, const gb_found_1 *found)
{
    uint64_t doubles[GB_MOST_ANSWERS / 64] = {0};
    const size_t count = all->count < GB_MOST_ANSWERS ? all->count : GB_MOST_ANSWERS;
    bool is_double = false;
    answer->branch = gb_free_branch(all, found);
    size_t first = answer->branch;
    for (size_t i = 0; i < count; i++) {
        if (gb_is_one(all, i, answer)) {
            if (gb_holds_against(all, i, answer)) {
                gb_remember_merged(all, i, answer, found);
                return;
            }
            doubles[i / 64] |= (uint64_t)1 << (i % 64);
            first = is_double ? first : *gb_branch_of(all, i);
            is_double = true;
        }
    }
    if (answer->free == 0) {
        answer->branch = first;
    }
    for (size_t i = count; i-- > 0;) {
        if (doubles[i / 64] >> (i % 64) & 1) {
            gb_drop(all, i);
        }
    }
    gb_add(all, answer);
}

/* Whether a candidate is the first of its branch, and far from all solutions. */
static bool gb_is_first(const gb_answers *all, const gb_found_1 *found, const gb_real *q)
{
    for (size_t i = 0; i < all->count; i++) {
        if (*gb_branch_of(all, i) == found->branch || *gb_free_of(all, i) != 0
            || gb_is_close(all->problem.mechanism, gb_q_of(all, i), q, 0, GB_MERGING_BLUR)) {
            return false;
        }
    }
    return found->free == 0;
}

/* Whether a candidate that could not be polished, because no steps are left, is near enough to a solution. */
static bool gb_may_stay(const gb_problem *problem, const gb_real *q, const gb_fit *fit)
{
    bool is_whole = true;
    for (size_t i = 0; i < problem->mechanism->joints; i++) {
        is_whole = is_whole && gb_is_finite(q[i]);
    }
    for (size_t i = 0; problem->extras && i < problem->mechanism->places; i++) {
        is_whole = is_whole && gb_is_finite(problem->extras[i]);
    }
    return gb_are_spent(problem) && fit->relative <= GB_ACCEPTANCE_UNSETTLED && is_whole;
}

/* Keeps a solution if the equations hold. Of equal solutions, the branch of the first and the joints of the best are kept. A second root of a double one
 * gets the next free number below `last`. */
GB_LINKAGE void gb_keep(gb_answers *all, const gb_found_1 *found, const gb_real *q, const gb_fit *fit)
{
    gb_answer answer;
    if (!fit->accepted && !gb_may_stay(&all->problem, q, fit)) {
        gb_miss(all, q, fit);
        return;
    }
    gb_copy(answer.q, q, all->problem.mechanism->joints);
    answer.fit = *fit;
    answer.branch = found->branch;
    answer.free = found->free;
    if (all->count < all->room && gb_is_first(all, found, q)) {
        gb_write(all, &answer);
    } else {
        gb_keep_one(all, &answer, found);
    }
}
