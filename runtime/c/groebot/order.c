/* The final form of the list of solutions, no more than a target can have, sorted by branch: see order.rs */

/* Number of isolated solutions. */
static size_t gb_count_isolated(const gb_answers *all)
{
    size_t isolated = 0;
    for (size_t i = 0; i < all->count; i++) {
        isolated += *gb_free_of(all, i) == 0;
    }
    return isolated;
}

/* Whether the target has its maximal number of isolated solutions. */
GB_LINKAGE bool gb_are_all(const gb_answers *all)
{
    return gb_count_isolated(all) >= all->problem.mechanism->isolated;
}

/* Merges the nearest two isolated solutions while there are more than a target can have: at a singular configuration rounding makes several of one. The
 * better one is kept. */
static void gb_unite(gb_answers *all)
{
    while (gb_count_isolated(all) > all->problem.mechanism->isolated) {
        gb_real least = INFINITY;
        size_t worse = 0;
        for (size_t second = 0; second < all->count; second++) {
            for (size_t first = 0; first < second; first++) {
                const gb_real distance = gb_farthest(all->problem.mechanism, gb_q_of(all, first), gb_q_of(all, second));
                if (*gb_free_of(all, first) == 0 && *gb_free_of(all, second) == 0 && distance < least) {
                    least = distance;
                    worse = *gb_relative_of(all, first) > *gb_relative_of(all, second) ? first : second;
                }
            }
        }
        gb_drop(all, worse);
    }
}

/* Insertion sort by branch. */
static void gb_sort(gb_answers *all)
{
    for (size_t end = 1; end < all->count; end++) {
        for (size_t i = end; i > 0 && *gb_branch_of(all, i - 1) > *gb_branch_of(all, i); i--) {
            gb_swap(all, i - 1, i);
        }
    }
}

/* The number whose root the source of the mechanism selects, with a sign such that the least is selected. */
static gb_real gb_preference(const gb_answers *all, size_t i)
{
    const gb_mechanism *m = all->problem.mechanism;
    gb_real at[GB_MAX_PLACES];
    gb_place(&all->problem, gb_q_of(all, i), at);
    return (m->prefers_greatest ? R(-1.0) : R(1.0)) * at[m->preferred];
}

/* Marks the solutions that the source would select. */
static void gb_mark_choice(gb_answers *all)
{
    gb_real least = INFINITY;
    for (size_t i = 0; i < all->count; i++) {
        least = gb_smaller(least, gb_preference(all, i));
    }
    for (size_t i = 0; i < all->count; i++) {
        *gb_chosen_of(all, i) = gb_preference(all, i) <= least + GB_MERGING_JOINTS;
    }
}

/* Sorts the solutions. */
GB_LINKAGE void gb_put_in_order(gb_answers *all)
{
    gb_unite(all);
    gb_sort(all);
    if (all->problem.mechanism->preferred >= 0) {
        gb_mark_choice(all);
    }
}
