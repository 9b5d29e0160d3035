/* Conditions on a target */

GB_INLINE T GB_(dot)(const T *a, const T *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/* Takes one Newton step from a matrix by rows towards the nearest rotation, `R - (R R^T - 1) R / 2` (N. Higham, "Computing the polar decomposition - with
 * applications", 1986). False when the matrix is far from a rotation or is a reflection. */
GB_INLINE GB_(truth) GB_(make_rotation)(T *r)
{
    T excess[3][3], given[9], deviation = GB_(of)(R(0.0));
    for (int i = 0; i < 3; i++) {
        for (int j = 0; j < 3; j++) {
            excess[i][j] = GB_(dot)(r + 3 * i, r + 3 * j) - (i == j ? R(1.0) : R(0.0));
            deviation = GB_(greater)(deviation, GB_(abs)(excess[i][j]));
        }
    }
    const T determinant = r[0] * (r[4] * r[8] - r[5] * r[7]) - r[1] * (r[3] * r[8] - r[5] * r[6]) + r[2] * (r[3] * r[7] - r[4] * r[6]);
    memcpy(given, r, sizeof given);
    for (int i = 0; i < 9; i++) {
        const T *row = excess[i / 3], *column = given + i % 3;
        r[i] = r[i] - R(0.5) * (row[0] * column[0] + row[1] * column[3] + row[2] * column[6]);
    }
    return (GB_(truth))(GB_(at_most)(GB_(of)(R(0.0)), determinant) & GB_(at_most)(deviation, GB_(of)(GB_ACCEPTANCE_INPUT)));
}

/* Takes one Newton step towards the nearest unit vector. False when the vector is far from it. */
GB_INLINE GB_(truth) GB_(make_unit)(T *v)
{
    const T excess = GB_(dot)(v, v) - R(1.0);
    for (int i = 0; i < 3; i++) {
        v[i] = v[i] - R(0.5) * (excess * v[i]);
    }
    return GB_(at_most)(GB_(abs)(excess), GB_(of)(GB_ACCEPTANCE_INPUT));
}

/* Projects a target onto a condition; false where it is farther from it than the tolerance. */
GB_INLINE GB_(truth) GB_(fulfil)(gb_condition condition, T *target)
{
    return condition.is_rotation ? GB_(make_rotation)(target + condition.first) : GB_(make_unit)(target + condition.first);
}
