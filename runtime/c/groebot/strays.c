/* Candidates for members of self-motions that turn out to be none: see strays.rs */

/* The record of a candidate's kind, or null where there are too many. */
static gb_kind_of_stray *gb_kind(gb_strays *strays, const gb_found_1 *found)
{
    size_t i = 0;
    while (i < strays->count && !(strays->kinds[i].branch == found->branch && strays->kinds[i].free == found->free)) {
        i++;
    }
    if (i == GB_KINDS) {
        strays->are_too_many = true;
        return NULL;
    }
    if (i == strays->count) {
        const gb_kind_of_stray none = {found->branch, 0, R(0.0), found->free, false};
        strays->kinds[strays->count++] = none;
    }
    return &strays->kinds[i];
}

/* Counts a candidate with its relative residual. Returns whether candidates of its kind are known not to be members. */
static bool gb_are_known(gb_strays *strays, const gb_found_1 *found, gb_real missed)
{
    gb_kind_of_stray *kind = gb_kind(strays, found);
    if (!kind) {
        return false;
    }
    kind->count++;
    kind->missed = gb_larger(kind->missed, missed);
    return kind->is_astray;
}

/* Whether candidates of this kind are known not to be members. */
static bool gb_are_astray(const gb_strays *strays, const gb_found_1 *found)
{
    for (size_t i = 0; i < strays->count; i++) {
        if (strays->kinds[i].branch == found->branch && strays->kinds[i].free == found->free) {
            return strays->kinds[i].is_astray;
        }
    }
    return false;
}

/* Whether a solution may have been lost. This is possible where a kind exists only on a part of the circle and its candidates are close to the stratum:
 * rounding may have hidden a solution at the end of that part. A free joint is sampled at eight places round the circle, or at a multiple of it. */
GB_LINKAGE bool gb_are_doubtful(const gb_strays *strays)
{
    bool are_doubtful = strays->are_too_many;
    for (size_t i = 0; i < strays->count; i++) {
        const gb_kind_of_stray *kind = &strays->kinds[i];
        are_doubtful = are_doubtful || (kind->is_astray && kind->missed <= GB_ACCEPTANCE_UNSETTLED && kind->count % 8 != 0);
    }
    return are_doubtful;
}
