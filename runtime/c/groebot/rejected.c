/* Kinds of candidates that are not members of self-motions: see rejected.rs */

/* The record of a candidate's kind, or null where there are too many. */
static gb_rejected_kind *gb_kind(gb_rejected_kinds *rejected, const gb_found_1 *found)
{
    size_t i = 0;
    while (i < rejected->count && !(rejected->kinds[i].branch == found->branch && rejected->kinds[i].free == found->free)) {
        i++;
    }
    if (i == GB_KINDS) {
        rejected->are_too_many = true;
        return NULL;
    }
    if (i == rejected->count) {
        const gb_rejected_kind none = {found->branch, 0, R(0.0), found->free, false};
        rejected->kinds[rejected->count++] = none;
    }
    return &rejected->kinds[i];
}

/* Counts a candidate with its relative residual. Returns whether candidates of its kind are known not to be members. */
static bool gb_are_known(gb_rejected_kinds *rejected, const gb_found_1 *found, gb_real missed)
{
    gb_rejected_kind *kind = gb_kind(rejected, found);
    if (!kind) {
        return false;
    }
    kind->count++;
    kind->missed = gb_larger(kind->missed, missed);
    return kind->is_rejected;
}

/* Whether candidates of this kind are known not to be members. */
static bool gb_are_rejected(const gb_rejected_kinds *rejected, const gb_found_1 *found)
{
    for (size_t i = 0; i < rejected->count; i++) {
        if (rejected->kinds[i].branch == found->branch && rejected->kinds[i].free == found->free) {
            return rejected->kinds[i].is_rejected;
        }
    }
    return false;
}

/* Whether a solution may have been lost. This is possible where a kind exists only on a part of the circle and its candidates are close to the stratum:
 * rounding may have hidden a solution at the end of that part. A free joint is sampled at eight places round the circle, or at a multiple of it. */
GB_LINKAGE bool gb_are_doubtful(const gb_rejected_kinds *rejected)
{
    bool are_doubtful = rejected->are_too_many;
    for (size_t i = 0; i < rejected->count; i++) {
        const gb_rejected_kind *kind = &rejected->kinds[i];
        are_doubtful = are_doubtful || (kind->is_rejected && kind->missed <= GB_ACCEPTANCE_UNSETTLED && kind->count % 8 != 0);
    }
    return are_doubtful;
}
