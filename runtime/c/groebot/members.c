/* Candidates for members of self-motions: see members.rs */

/* Stores a member, with the tangent unless that is null. */
static void gb_remember(gb_answers *all, size_t branch, uint32_t free, const gb_real *q, const gb_real *tangent)
{
    const size_t place = all->members_count++ % GB_MEMBERS;
    all->members_of[place].branch = branch;
    all->members_of[place].free = free;
    gb_copy(all->members[place], q, all->problem.mechanism->joints);
    all->members_have_tangent[place] = tangent != NULL;
    if (tangent) {
        gb_copy(all->members_tangent[place], tangent, all->problem.mechanism->joints);
    }
}

/* The index of the k-th last stored member, from 1; false where there are not so many. */
static bool gb_look_back(const gb_answers *all, size_t k, size_t *place)
{
    if (k > all->members_count || k > GB_MEMBERS) {
        return false;
    }
    *place = (all->members_count - k) % GB_MEMBERS;
    return true;
}

/* Whether these joint values were stored as a member before. */
static bool gb_is_remembered(const gb_answers *all, const gb_real *q, uint32_t free)
{
    size_t place;
    for (size_t k = 1; gb_look_back(all, k, &place); k++) {
        if (all->members_of[place].free == free && gb_is_close(all->problem.mechanism, all->members[place], q, 0, GB_MERGING_JOINTS)) {
            return true;
        }
    }
    return false;
}

/* The index of the last member of a branch with these free joints; if `free` is zero, with any single free joint. False where there is none. */
static bool gb_find_member(const gb_answers *all, size_t branch, uint32_t free, size_t *place)
{
    for (size_t k = 1; gb_look_back(all, k, place); k++) {
        const gb_found_1 *found = &all->members_of[*place];
        if (found->branch == branch && (free == 0 ? gb_is_single(found->free) : found->free == free)) {
            return true;
        }
    }
    return false;
}

/* Keeps a solution, and records a member. */
static void gb_keep_remembered(gb_answers *all, const gb_found_1 *found, const gb_end *end)
{
    if (found->free != 0) {
        gb_remember(all, found->branch, found->free, end->q, NULL);
    }
    gb_keep(all, found, end->q, &end->fit);
}

/* Whether joints are on a self-motion of one joint that recent candidates of this branch have led to. */
static bool gb_is_on_remembered(gb_answers *all, const gb_found_1 *found, const gb_real *q)
{
    size_t place;
    if (!gb_find_member(all, found->branch, 0, &place) || gb_regularity(&all->problem, q) > GB_PIVOTS_REGULAR
        || !gb_leads_to(&all->problem, all->members[place], q, all->members_of[place].free)) {
        return false;
    }
    gb_remember(all, found->branch, all->members_of[place].free, q, NULL);
    return true;
}

/* Keeps a candidate if it is a member of a self-motion. Returns whether it is. */
static bool gb_keep_member(gb_answers *all, const gb_found_1 *found, const gb_end *end)
{
    const bool is_member = end->fit.accepted && gb_is_on_self_motion(&all->problem, end->q, found->free, end->fit.relative);
    if (is_member) {
        gb_keep_remembered(all, found, end);
    }
    return is_member;
}

/* Whether an isolated solution with these joints is in the list. */
static bool gb_is_listed(const gb_answers *all, const gb_real *q)
{
    for (size_t i = 0; i < all->count; i++) {
        if (*gb_free_of(all, i) == 0 && gb_is_close(all->problem.mechanism, gb_q_of(all, i), q, 0, GB_MERGING_JOINTS)) {
            return true;
        }
    }
    return false;
}

/* Keeps the end of the steps from a candidate for a member of a self-motion. It is either a member of another self-motion, of one joint that a case frees,
 * or an isolated solution. A new isolated solution may have a second one next to it. */
static void gb_keep_alone(gb_answers *all, const gb_found_1 *found, const gb_end *end, gb_real missed)
{
    if (end->fit.relative > GB_SELF_MOTIONS_MEMBER) {
        gb_miss(all, end->q, &end->fit);
        return;
    }
    gb_found_1 alone = *found;
    const bool is_listed = gb_is_listed(all, end->q);
    if (!is_listed && gb_is_on_remembered(all, found, end->q)) {
        return;
    }
    alone.free = is_listed ? 0 : gb_joint_on_self_motion(&all->problem, end->q, end->fit.relative);
    const size_t known = all->count;
    gb_keep_remembered(all, &alone, end);
    if (alone.free == 0 && all->count > known && gb_is_between(missed, GB_ACCEPTANCE_ROUNDING, GB_STRATA_NEAR)) {
        gb_around(all, &alone, end, missed);
    }
}

/* Whether a solution in the list is a member of a self-motion within rounding, with the branch and the free joints of a candidate. */
static bool gb_is_member_of(const gb_answers *all, size_t i, const gb_found_1 *found)
{
    return *gb_relative_of(all, i) <= GB_ACCEPTANCE_ROUNDING && *gb_branch_of(all, i) == found->branch && *gb_free_of(all, i) == found->free;
}

/* Whether a member of a candidate's self-motion is known. */
static bool gb_is_known(const gb_answers *all, const gb_found_1 *found)
{
    for (size_t i = 0; i < all->merged_count; i++) {
        if (all->merged[i].branch == found->branch && all->merged[i].free == found->free) {
            return true;
        }
    }
    for (size_t i = 0; i < all->count; i++) {
        if (gb_is_member_of(all, i, found)) {
            return true;
        }
    }
    return false;
}

/* Keeps a member of a long self-motion within rounding if no solution is lost without further tests. Returns whether it was kept. */
static bool gb_keep_long_member(gb_answers *all, const gb_found_1 *found, const gb_end *end, bool is_known)
{
    if (end->fit.relative <= GB_ACCEPTANCE_ROUNDING && gb_is_on_long_self_motion(&all->problem, end->q, found->free)) {
        gb_keep_remembered(all, found, end);
        return true;
    }
    gb_rejected_kind *kind = is_known ? NULL : gb_kind(&all->rejected, found);
    if (kind) {
        kind->is_rejected = true;
    }
    gb_miss(all, end->q, &end->fit);
    return true;
}

/* Whether a member is on a known self-motion of its branch: a continuous motion connects them. Where further joints are free, it is assumed to be on one,
 * and this is recorded. */
static bool gb_is_on_known(gb_answers *all, const gb_found_1 *found, const gb_end *end)
{
    const gb_problem *problem = &all->problem;
    gb_real tangent[GB_MAX_JOINTS];
    size_t place = 0;
    const bool has_last = gb_find_member(all, found->branch, found->free, &place);
    /* First, because it is the fastest test. */
    if (end->fit.relative > GB_ACCEPTANCE_ROUNDING || (has_last && gb_leads_straight_to(problem, all->members[place], end->q, found->free))) {
        gb_remember(all, found->branch, found->free, end->q, NULL);
        return true;
    }
    const bool is_on_curve = gb_find_tangent(problem, end->q, found->free, tangent);
    const gb_member last = {all->members[place], has_last && all->members_have_tangent[place] ? all->members_tangent[place] : NULL};
    const gb_member here = {end->q, tangent};
    bool joins = !is_on_curve || (has_last && gb_leads_round_to(problem, last, here, found->free));
    for (size_t i = all->count; i > 0 && !joins;) {
        i--;
        joins = gb_is_member_of(all, i, found) && gb_leads_to(problem, gb_q_of(all, i), end->q, found->free);
    }
    if (joins) {
        gb_remember(all, found->branch, found->free, end->q, is_on_curve ? tangent : NULL);
    }
    return joins;
}

/* Whether the list has a member with the branch and the one free joint of a candidate. All members with residuals above rounding count as of one branch. */
static bool gb_has_member_of_branch(const gb_answers *all, const gb_found_1 *found)
{
    for (size_t i = 0; gb_is_single(found->free) && i < all->count; i++) {
        if (*gb_branch_of(all, i) == found->branch && *gb_free_of(all, i) == found->free) {
            return true;
        }
    }
    return false;
}

/* Whether joints with residuals within rounding are the same singular configuration as an isolated solution in the list. */
static bool gb_is_joined_to_listed(const gb_answers *all, const gb_end *end)
{
    for (size_t i = 0; end->fit.relative <= GB_ACCEPTANCE_ROUNDING && i < all->count; i++) {
        if (*gb_free_of(all, i) == 0
            && gb_are_blurred(&all->problem, gb_q_of(all, i), *gb_relative_of(all, i), end->q, end->fit.relative)) {
            return true;
        }
    }
    return false;
}

/* Keeps a member of a self-motion. It is moved along the self-motion only if its residual exceeds rounding. This happens where the self-motion covers only a
 * part of the circle, or where there is none and an isolated solution is nearby. */
static void gb_refine_member(gb_answers *all, const gb_found_1 *found, const gb_real *q)
{
    const bool is_known = gb_is_known(all, found);
    gb_end end;
    if (is_known && (!gb_is_single(found->free) || gb_are_spent(&all->problem))) {
        return;
    }
    if (gb_is_remembered(all, q, found->free)) {
        return;
    }
    gb_copy(end.q, q, all->problem.mechanism->joints);
    end.fit = gb_measure(&all->problem, q);
    const gb_real missed = end.fit.relative;
    if (all->suffices && (missed > GB_ACCEPTANCE_UNSETTLED || gb_are_known(&all->rejected, found, missed))) {
        gb_miss(all, end.q, &end.fit);
        return;
    }
    /* Repeated to find a solution next to a self-motion's end, but not where that end is far. */
    if (missed > GB_STRATA_NEAR && gb_are_rejected(&all->rejected, found)) {
        gb_miss(all, end.q, &end.fit);
        return;
    }
    if (gb_are_spent(&all->problem)) {
        gb_keep(all, found, end.q, &end.fit);
        return;
    }
    const bool may_miss = all->problem.mechanism->is_nearby && gb_is_single(found->free) && !is_known;
    if (may_miss && missed > GB_ACCEPTANCE_ROUNDING && gb_begin_curve(all, found, end.q)) {
        return;
    }
    if (gb_is_between(missed, GB_ACCEPTANCE_ROUNDING, GB_ACCEPTANCE_UNSETTLED)) {
        gb_polish(&all->problem, &end, found->free);
    }
    if (end.fit.relative > GB_ACCEPTANCE_ROUNDING && gb_has_member_of_branch(all, found)) {
        return;
    }
    if (is_known && gb_is_on_known(all, found, &end)) {
        return;
    }
    all->is_another = is_known;
    const bool is_done = all->suffices ? gb_keep_long_member(all, found, &end, is_known) : gb_keep_member(all, found, &end);
    all->is_another = false;
    if (is_done || is_known) {
        return;
    }
    gb_polish(&all->problem, &end, 0);
    if (gb_is_joined_to_listed(all, &end)) {
        return;
    }
    if (!gb_keep_member(all, found, &end)) {
        gb_keep_alone(all, found, &end, missed);
    }
}
