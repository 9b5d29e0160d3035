/* Continuation along curves on which the target is nearly reached, as next to a self-motion: see curve.rs
 *
 * Next to a self-motion, the isolated solutions of a target may be anywhere on the curve that remains of the self-motion. Newton steps find none of them,
 * because the Jacobian has rank five within a small error. A walk keeps the five equations that the joints influence, and follows the tangent. The residual
 * of the sixth equation changes its sign at each solution. (Steps along the tangent: E. L. Allgower and K. Georg, Numerical Continuation Methods, 1990,
 * chapter 3.) */

/* A walk along all curves found from given joint vectors. */
typedef struct {
    const gb_chain *chain;
    const gb_rigid *target;
    gb_six_search *search;
    /* Starts of walks; those that another walk has passed are removed. */
    gb_six_point starts[GB_SIX_KEPT];
    bool is_open[GB_SIX_KEPT];
    size_t count;
} gb_six_walk;

/* Adds a start at `q` if there is a curve next to it. */
static void gb_six_begin(gb_six_walk *walk, const gb_real *q)
{
    if (walk->count == GB_SIX_KEPT) {
        return;
    }
    gb_six_point *start = &walk->starts[walk->count];
    memcpy(start->q, q, sizeof start->q);
    if (gb_six_settle(walk->chain, walk->target, start, GB_SIX_MANY)) {
        walk->is_open[walk->count++] = true;
    }
}

/* The place that steps across the curve lead to from `q` plus a share of `delta`; false where there is none. */
static bool gb_six_advance(const gb_six_walk *walk, const gb_real *q, const gb_real *delta, gb_real share, gb_six_point *next)
{
    for (int k = 0; k < 6; k++) {
        next->q[k] = q[k] + share * delta[k];
    }
    return gb_six_settle(walk->chain, walk->target, next, GB_SIX_FEW);
}

static void gb_six_differences(const gb_real *from, const gb_real *to, gb_real *delta)
{
    for (int k = 0; k < 6; k++) {
        delta[k] = to[k] - from[k];
    }
}

/* Adds the solution between two places where the sixth equation has different signs, by false position (the Illinois rule: M. Dowell and P. Jarratt, BIT 11
 * (1971) 168-174). */
static void gb_six_change(const gb_six_walk *walk, const gb_six_point *a, const gb_six_point *b)
{
    gb_real low = a->value, high = b->value;
    if ((low <= R(0.0)) == (high <= R(0.0)) || gb_larger(gb_magnitude(low), gb_magnitude(high)) <= GB_SELF_MOTIONS_MEMBER_SIX) {
        return;
    }
    gb_six_point near = *a, far = *b;
    int side = 0;
    for (int round = 0; round < GB_SIX_NARROWED; round++) {
        gb_six_point middle;
        gb_real delta[6];
        gb_six_differences(near.q, far.q, delta);
        if (!gb_six_advance(walk, near.q, delta, low / (low - high), &middle)) {
            break;
        }
        gb_six_align(&middle, a);
        if ((middle.value <= R(0.0)) == (low <= R(0.0))) {
            near = middle;
            high = side < 0 ? R(0.5) * high : far.value;
            low = middle.value;
            side = -1;
        } else {
            far = middle;
            low = side > 0 ? R(0.5) * low : near.value;
            high = middle.value;
            side = 1;
        }
        if (gb_magnitude(middle.value) <= GB_SIX_EXACT) {
            break;
        }
    }
    gb_six_find(walk->chain, walk->target, gb_magnitude(near.value) <= gb_magnitude(far.value) ? near.q : far.q, walk->search);
}

/* Searches for two solutions, or a double one, where the sixth equation has an extremum near zero. */
static void gb_six_dip(const gb_six_walk *walk, const gb_six_point *a, const gb_six_point *b, const gb_six_point *c)
{
    const gb_real low = a->value, least = b->value, high = c->value, size = gb_magnitude(least);
    if (!(size < gb_magnitude(low) && size < gb_magnitude(high) && size > GB_SELF_MOTIONS_MEMBER_SIX) || (low <= R(0.0)) != (least <= R(0.0))
        || (high <= R(0.0)) != (least <= R(0.0))) {
        return;
    }
    const gb_real share = R(0.5) * (low - high) / (low - least - least + high);
    const gb_six_point *end = share < R(0.0) ? a : c;
    gb_six_point vertex;
    gb_real delta[6];
    gb_six_differences(b->q, end->q, delta);
    if (gb_six_advance(walk, b->q, delta, gb_magnitude(share), &vertex)) {
        gb_six_align(&vertex, b);
        gb_six_change(walk, b, &vertex);
        gb_six_change(walk, &vertex, end);
        gb_six_find(walk->chain, walk->target, vertex.q, walk->search);
    }
}

/* A step along the curve, shorter where it bends; false where the curve ends. */
static bool gb_six_pace(const gb_six_walk *walk, const gb_six_point *at, gb_real *stride, gb_six_point *next)
{
    for (; *stride >= GB_SIX_SHORT * GB_SIX_STRIDE; *stride *= R(0.5)) {
        if (gb_six_advance(walk, at->q, at->along, *stride, next) && gb_magnitude(gb_six_product(next->along, at->along, 6)) > R(0.9)
            && gb_six_distance(next->q, at->q, walk->chain->slides) <= R(2.0) * *stride) {
            *stride = gb_smaller(R(2.0) * *stride, GB_SIX_STRIDE);
            gb_six_align(next, at);
            return true;
        }
    }
    return false;
}

/* The last place of a closed walk, with its angles shifted by whole turns to be nearest to the place before. */
static gb_six_point gb_six_beside(const gb_six_point *home, const gb_six_point *at, const bool *slides)
{
    gb_six_point end = *home;
    gb_six_align(&end, at);
    for (int joint = 0; joint < 6; joint++) {
        const gb_real turns = slides[joint] ? R(0.0) : gb_round((at->q[joint] - end.q[joint]) / GB_TAU);
        end.q[joint] = end.q[joint] + GB_TAU * turns;
    }
    return end;
}

/* Follows the curve from `home` until it closes or ends. Returns whether it closed. `level` receives the least and the largest residual. */
static bool gb_six_leads_home(gb_six_walk *walk, const gb_six_point *home, gb_real *level)
{
    const bool *slides = walk->chain->slides;
    gb_six_point before = *home, at = *home, next;
    gb_real stride = GB_SIX_STRIDE;
    bool is_away = false;
    for (int pace = 0; pace < GB_SIX_PACES; pace++) {
        if (!gb_six_pace(walk, &at, &stride, &next)) {
            return false;
        }
        level[0] = gb_smaller(level[0], gb_magnitude(next.value));
        level[1] = gb_larger(level[1], gb_magnitude(next.value));
        gb_six_change(walk, &at, &next);
        gb_six_dip(walk, &before, &at, &next);
        for (size_t k = 0; k < walk->count; k++) {
            walk->is_open[k] = walk->is_open[k] && gb_six_distance(walk->starts[k].q, next.q, slides) > GB_SIX_STRIDE;
        }
        before = at;
        at = next;
        const gb_real delta = gb_six_distance(at.q, home->q, slides);
        is_away |= delta > R(3.0) * GB_SIX_STRIDE;
        if (is_away && delta <= GB_SIX_STRIDE && gb_six_product(at.along, home->along, 6) > R(0.5)) {
            const gb_six_point end = gb_six_beside(home, &at, slides);
            gb_six_change(walk, &at, &end);
            return true;
        }
    }
    return false;
}

/* Follows the curves, in both directions if they are not closed, and adds solutions where the sixth equation changes its sign. If its residual is zero all
 * along, the curve is a self-motion, and one member is added. */
static void gb_six_run_walk(gb_six_walk *walk)
{
    for (size_t index = 0; index < walk->count; index++) {
        if (!walk->is_open[index]) {
            continue;
        }
        walk->is_open[index] = false;
        const gb_six_point *start = &walk->starts[index];
        gb_six_point home = *start;
        gb_real level[2] = {gb_magnitude(start->value), gb_magnitude(start->value)};
        if (!gb_six_leads_home(walk, &home, level)) {
            for (int k = 0; k < 6; k++) {
                home.along[k] = -start->along[k];
            }
            gb_six_leads_home(walk, &home, level);
        }
        if (level[1] <= GB_SELF_MOTIONS_MEMBER_SIX) {
            gb_six_find(walk->chain, walk->target, start->q, walk->search);
        } else if (walk->chain->within > R(0.0) && level[0] <= GB_SIX_NEXT * walk->chain->within) {
            gb_six_remember(&walk->search->meeting, start->q);
        }
    }
}

/* Follows the curves next to solutions, and next to candidates from which polishing failed. */
static GB_APART void gb_six_walk_from(const gb_chain *chain, const gb_rigid *target, gb_six_search *search)
{
    gb_six_walk walk;
    walk.chain = chain;
    walk.target = target;
    walk.search = search;
    walk.count = 0;
    for (size_t k = 0; k < search->answers.count; k++) {
        gb_six_point at;
        memcpy(at.q, search->answers.list[k], sizeof at.q);
        if (gb_six_section(chain, target, &at) && gb_six_is_near(&at)) {
            gb_six_begin(&walk, at.q);
        }
    }
    for (size_t k = 0; k < search->far.count; k++) {
        gb_six_begin(&walk, search->far.list[k]);
    }
    for (size_t k = 0; k < search->lost.count; k++) {
        gb_six_begin(&walk, search->lost.list[k]);
    }
    gb_six_run_walk(&walk);
}
