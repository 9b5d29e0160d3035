/* Vectors and rigid motions: see vector.rs, rigid.rs */
#ifndef GB_SIX_RIGID
#define GB_SIX_RIGID

GB_INLINE gb_real gb_six_dot(const gb_real *a, const gb_real *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

GB_INLINE void gb_six_cross(const gb_real *a, const gb_real *b, gb_real *out)
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

/* The scalar product of two lists, which are not empty. */
GB_INLINE gb_real gb_six_product(const gb_real *a, const gb_real *b, size_t count)
{
    gb_real sum = a[0] * b[0];
    for (size_t i = 1; i < count; i++) {
        sum += a[i] * b[i];
    }
    return sum;
}

GB_INLINE gb_real gb_six_norm(const gb_real *v)
{
    return gb_square_root(gb_six_product(v, v, 6));
}

/* The largest magnitude of six; NaN where one is NaN. */
GB_INLINE gb_real gb_six_size(const gb_real *v)
{
    gb_real most = R(0.0);
    GB_UNROLL
    for (int i = 0; i < 6; i++) {
        const gb_real entry = gb_magnitude(v[i]);
        most = entry > most || entry != entry ? entry : most;
    }
    return most;
}

GB_INLINE bool gb_six_is_finite(gb_real x)
{
    return gb_magnitude(x) <= GB_GREATEST;
}

static const gb_rigid gb_six_none = {{{R(1.0), R(0.0), R(0.0)}, {R(0.0), R(1.0), R(0.0)}, {R(0.0), R(0.0), R(1.0)}}, {R(0.0), R(0.0), R(0.0)}};

/* A rotated direction. */
GB_INLINE void gb_six_turned(const gb_rigid *motion, const gb_real *v, gb_real *out)
{
    GB_UNROLL
    for (int i = 0; i < 3; i++) {
        out[i] = gb_six_dot(motion->rotation[i], v);
    }
}

/* A transformed point. */
GB_INLINE void gb_six_moved(const gb_rigid *motion, const gb_real *p, gb_real *out)
{
    GB_UNROLL
    for (int i = 0; i < 3; i++) {
        out[i] = gb_six_dot(motion->rotation[i], p) + motion->translation[i];
    }
}

/* The inverse motion. */
GB_INLINE gb_rigid gb_six_inverse(const gb_rigid *motion)
{
    gb_rigid back;
    GB_UNROLL
    for (int i = 0; i < 3; i++) {
        GB_UNROLL
        for (int j = 0; j < 3; j++) {
            back.rotation[i][j] = motion->rotation[j][i];
        }
        back.translation[i] = -gb_six_dot(back.rotation[i], motion->translation);
    }
    return back;
}

/* The composition: b first, then a. */
GB_INLINE gb_rigid gb_six_after(const gb_rigid *a, const gb_rigid *b)
{
    gb_rigid both;
    GB_UNROLL
    for (int i = 0; i < 3; i++) {
        const gb_real *row = a->rotation[i];
        GB_UNROLL
        for (int j = 0; j < 3; j++) {
            both.rotation[i][j] = row[0] * b->rotation[0][j] + row[1] * b->rotation[1][j] + row[2] * b->rotation[2][j];
        }
        both.translation[i] = gb_six_dot(row, b->translation) + a->translation[i];
    }
    return both;
}

/* Followed by a rotation about the moved z axis, given its cosine and sine. */
GB_INLINE void gb_six_then_turn(gb_rigid *motion, gb_real c, gb_real s)
{
    GB_UNROLL
    for (int i = 0; i < 3; i++) {
        gb_real *row = motion->rotation[i];
        const gb_real x = row[0], y = row[1];
        row[0] = c * x + s * y;
        row[1] = c * y - s * x;
    }
}

/* Followed by a translation along the moved z axis. */
GB_INLINE void gb_six_then_slide(gb_rigid *motion, gb_real distance)
{
    GB_UNROLL
    for (int i = 0; i < 3; i++) {
        motion->translation[i] = motion->translation[i] + motion->rotation[i][2] * distance;
    }
}

#endif
