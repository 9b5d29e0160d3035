/* Chains: see chain.rs */

/* The joint `steps` after the hidden one in the loop. */
GB_INLINE size_t gb_six_joint(gb_formulation formulation, size_t steps)
{
    return (formulation.hidden + steps) % 6;
}

/* The joint by whose half angle or displacement the equations are multiplied. */
GB_INLINE size_t gb_six_doubled(gb_formulation formulation)
{
    return gb_six_joint(formulation, formulation.second ? 2 : 1);
}

/* The formulation of an attempt; after the last one the first is used again. */
GB_INLINE gb_formulation gb_six_formulation(const gb_chain *chain, size_t attempt)
{
    return chain->formulations[attempt % chain->formulation_count];
}

static gb_six_figure gb_six_figure_of(const gb_chain *chain, size_t joint)
{
    gb_six_figure figure;
    memcpy(figure.direction, chain->directions[joint], sizeof figure.direction);
    memcpy(figure.point, chain->points[joint], sizeof figure.point);
    memcpy(figure.side, chain->across[joint][0], sizeof figure.side);
    figure.slides = chain->slides[joint];
    return figure;
}

/* The line or direction that a joint leaves invariant, moved to the other side of the target if `ahead`. */
static gb_six_figure gb_six_place(const gb_chain *chain, gb_formulation formulation, size_t steps, bool ahead, const gb_rigid *displacement)
{
    const gb_six_figure figure = gb_six_figure_of(chain, gb_six_joint(formulation, steps));
    if (ahead != (formulation.hidden + steps >= 6)) {
        return figure;
    }
    const gb_rigid motion = ahead ? gb_six_inverse(displacement) : *displacement;
    gb_six_figure moved;
    gb_six_turned(&motion, figure.direction, moved.direction);
    gb_six_moved(&motion, figure.point, moved.point);
    gb_six_turned(&motion, figure.side, moved.side);
    moved.slides = figure.slides;
    return moved;
}

/* Whether a displacement represents an infinite one. Chains with two prismatic joints have such eigenvalues. */
static bool gb_six_is_infinite(gb_real value)
{
    return !(gb_magnitude(value) <= GB_SIX_LONG);
}

/* Whether a displacement among joint values represents an infinite one. */
static bool gb_six_has_infinite(const gb_chain *chain, const gb_real *q)
{
    for (int joint = 0; joint < 6; joint++) {
        if (chain->slides[joint] && gb_six_is_infinite(q[joint])) {
            return true;
        }
    }
    return false;
}
