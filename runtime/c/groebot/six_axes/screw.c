/* Axes of joints, and lines and directions that they move: see screw.rs */

/* The axis of a joint, and the line or directions that the joint leaves invariant: the line of its axis; for a prismatic joint, its direction and one
 * orthogonal to it. */
typedef struct {
    gb_real direction[3];
    gb_real point[3];
    gb_real side[3];
    bool slides;
} gb_six_figure;

/* `c` and `s` of the rotations, or `d^2` and `d` of the translations, at which functions are sampled. */
static const gb_real gb_six_samples[2][3][2] = {
    {{R(1.0), R(0.0)}, {R(0.0), R(1.0)}, {R(0.0), R(-1.0)}},
    {{R(0.0), R(0.0)}, {R(1.0), R(1.0)}, {R(1.0), R(-1.0)}},
};

/* A vector rotated about a direction, given cosine and sine. */
GB_INLINE void gb_six_turned_about(const gb_real *w, const gb_real *v, const gb_real *by, gb_real *out)
{
    const gb_real share = gb_six_dot(w, v);
    gb_real third[3];
    gb_six_cross(w, v, third);
    GB_UNROLL
    for (int i = 0; i < 3; i++) {
        const gb_real along = w[i] * share;
        out[i] = along + ((v[i] - along) * by[0] + third[i] * by[1]);
    }
}

/* The figure moved by the joint of an axis, given `c` and `s` of its angle, or `d^2` and `d` of its displacement. */
GB_INLINE gb_six_figure gb_six_moved_by(const gb_six_figure *figure, const gb_six_figure *axis, const gb_real *by)
{
    gb_six_figure moved = *figure;
    gb_real from[3], arm[3];
    if (axis->slides) {
        GB_UNROLL
        for (int i = 0; i < 3; i++) {
            moved.point[i] = figure->point[i] + axis->direction[i] * by[1];
        }
        return moved;
    }
    GB_UNROLL
    for (int i = 0; i < 3; i++) {
        from[i] = figure->point[i] - axis->point[i];
    }
    gb_six_turned_about(axis->direction, from, by, arm);
    gb_six_turned_about(axis->direction, figure->direction, by, moved.direction);
    GB_UNROLL
    for (int i = 0; i < 3; i++) {
        moved.point[i] = axis->point[i] + arm[i];
    }
    if (figure->slides) {
        gb_six_turned_about(axis->direction, figure->side, by, moved.side);
    }
    return moved;
}

/* The coefficients of 1, c, s, or of 1, d^2, d, of functions affine in them, from their values at the samples. */
GB_INLINE void gb_six_coefficients(bool slides, gb_six_lanes f, gb_six_lanes g, gb_six_lanes h, gb_six_lanes *out)
{
    const gb_six_lanes mean = R(0.5) * (g + h);
    out[1] = slides ? mean - f : f - mean;
    out[0] = slides ? f : f - out[1];
    out[2] = R(0.5) * (g - h);
}
