/* Tests of the run time with PUMA's solver. Both source files are part of this one, so that static functions are accessible. */
#include "puma.c"

#include "../groebot.c"

#include <stdio.h>
#include <stdlib.h>

#define CHECK(truth) ((truth) ? (void)0 : fail(#truth, __LINE__))

/* Tolerance for numbers that are equal up to rounding. */
#define CLOSE GB_EITHER(1e-14, 1e-5)
/* Tolerance for joint values found from forward kinematics. */
#define FOUND GB_EITHER(1e-8, 2e-2)

static void fail(const char *what, int line)
{
    printf("test.c:%d: %s does not hold\n", line, what);
    exit(1);
}

static bool are_close(gb_real a, gb_real b, gb_real tolerance)
{
    return gb_magnitude(a - b) <= tolerance;
}

/* A random number in [-1, 1): xorshift64 (G. Marsaglia, "Xorshift RNGs", 2003). */
static gb_real random_number(void)
{
    static uint64_t state = 88172645463325252u;
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return (gb_real)(int64_t)(state >> 11) / (gb_real)((int64_t)1 << 52) - R(1.0);
}

static void random_joints(gb_real *q)
{
    for (int i = 0; i < PUMA_JOINTS; i++) {
        q[i] = R(3.1) * random_number();
    }
}

/* Checks the real roots of a polynomial. */
static void expect_roots(const gb_real *coefficients, size_t length, const gb_real *expected, size_t count, gb_real tolerance)
{
    const gb_polynomial_1 polynomial = {coefficients, length};
    gb_real values[GB_MOST_DEGREE];
    const gb_scale scale = {R(1.0), R(1.0)};
    bool close;
    CHECK(gb_real_roots(&polynomial, 1, scale, values, GB_MOST_DEGREE, &close) == count);
    for (size_t i = 0; i < count; i++) {
        CHECK(are_close(values[i], expected[i], tolerance));
    }
}

static void squares_have_two_roots_one_or_none(void)
{
    const gb_roots_1 two = gb_square_roots_1(R(-4.0), R(1.0)), one = gb_square_roots_1(R(0.0), R(1.0)), none = gb_square_roots_1(R(1.0), R(1.0));
    CHECK(two.count == 2 && two.values[0] == R(-2.0) && two.values[1] == R(2.0) && !two.close);
    CHECK(one.count == 1 && one.values[0] == R(0.0) && one.close);
    CHECK(none.count == 0);
    CHECK(gb_square_roots_1(NAN, R(1.0)).count == 0);
    CHECK(gb_square_roots_1(-INFINITY, R(1.0)).count == 0);
    CHECK(gb_square_roots_1(GB_EITHER(-1e-20, -1e-10), R(1.0)).close);
}

static void polynomials_have_their_roots(void)
{
    const gb_real line[] = {R(-3.0), R(2.0)}, halves[] = {R(1.5)};
    expect_roots(line, 2, halves, 1, CLOSE);
    const gb_real quartic[] = {R(24.0), R(-50.0), R(35.0), R(-10.0), R(1.0)}, whole[] = {R(1.0), R(2.0), R(3.0), R(4.0)};
    expect_roots(quartic, 5, whole, 4, R(100.0) * CLOSE);
    const gb_real sixth[] = {R(-1.0), 0, 0, 0, 0, 0, R(1.0)}, units[] = {R(-1.0), R(1.0)};
    expect_roots(sixth, 7, units, 2, CLOSE);
    const gb_real eighth[] = {R(1.0), 0, 0, 0, 0, 0, 0, 0, R(1.0)};
    expect_roots(eighth, 9, NULL, 0, CLOSE);
    const gb_real zero[] = {R(0.0), R(0.0)};
    expect_roots(zero, 2, NULL, 0, CLOSE);
}

#ifndef GB_FLOAT
static void double_roots_are_found_once(void)
{
    const gb_real squares[] = {16.0, 0, -40.0, 0, 33.0, 0, -10.0, 0, 1.0}, whole[] = {-2.0, -1.0, 1.0, 2.0};
    expect_roots(squares, 9, whole, 4, 1e-7);
}
#endif

static void a_small_leading_coefficient_passes_the_turn_on(void)
{
    const gb_real first[] = {R(-1.0), R(1.0), R(1e-12)}, second[] = {R(-2.0), R(1.0)};
    const gb_polynomial_1 list[] = {{first, 3}, {second, 2}};
    gb_real values[2];
    const gb_scale scale = {R(1.0), R(1.0)};
    bool close;
    CHECK(gb_real_roots(list, 2, scale, values, 2, &close) == 1 && are_close(values[0], R(2.0), CLOSE));
}

static void angles_are_those_of_the_library(void)
{
    for (int i = 0; i < 100000; i++) {
        const gb_real angle = random_number() * (i % 2 ? R(4.0) : R(300.0)), x = random_number(), y = random_number();
        CHECK(are_close(gb_sine(angle), (gb_real)sin((double)angle), GB_EITHER(2.3e-16, 1.2e-7)));
        gb_real cosine, sine;
        gb_cosine_and_sine(angle, &cosine, &sine);
        CHECK(cosine == gb_cosine(angle) && sine == gb_sine(angle));
        CHECK(are_close(gb_cosine(angle), (gb_real)cos((double)angle), GB_EITHER(2.3e-16, 1.2e-7)));
        const gb_real arc = gb_unfold_1(gb_acute_1(gb_magnitude(x), gb_magnitude(y)), x, y);
        CHECK(are_close(arc, (gb_real)atan2((double)y, (double)x), GB_EITHER(9e-16, 5e-7)));
    }
    CHECK(gb_unfold_1(gb_acute_1(R(1.0), R(0.0)), R(-1.0), R(-0.0)) == GB_PI);
    CHECK(!signbit(gb_unfold_1(gb_acute_1(R(1.0), R(0.0)), R(1.0), R(-0.0))));
    CHECK(isnan(gb_sine(INFINITY)) && isnan(gb_cosine(NAN)));
}

static void angles_are_wrapped(void)
{
    CHECK(gb_wrap(-GB_PI) == GB_PI);
    CHECK(are_close(gb_wrap(R(7.0)), R(7.0) - GB_TAU, CLOSE));
    CHECK(gb_round(R(2.5)) == R(3.0) && gb_round(R(-2.5)) == R(-3.0) && gb_round(R(0.5) - R(0.25) * GB_EPSILON) == R(0.0));
    CHECK(gb_floor(R(-0.5)) == R(-1.0) && gb_ceiling(R(-0.5)) == R(0.0) && gb_floor(R(3.0)) == R(3.0));
}

#if GB_LANES > 1
static void lanes_hold_what_numbers_do(void)
{
    for (int i = 0; i < 10000; i++) {
        const gb_real c[2] = {random_number(), random_number()}, s[2] = {random_number(), random_number()};
        const gb_number_2 cosine = gb_load_2(c), sine = gb_load_2(s);
        const gb_number_2 both = gb_unfold_2(gb_acute_2(gb_abs_2(cosine), gb_abs_2(sine)), cosine, sine);
        const gb_roots_2 roots = gb_square_roots_2(cosine, gb_abs_2(sine));
        for (int lane = 0; lane < 2; lane++) {
            CHECK(both[lane] == gb_unfold_1(gb_acute_1(gb_magnitude(c[lane]), gb_magnitude(s[lane])), c[lane], s[lane]));
            const gb_roots_1 own = gb_square_roots_1(c[lane], gb_magnitude(s[lane]));
            CHECK((own.count == 0) == (roots.dead[0][lane] != 0));
            CHECK(own.count < 2 || (own.values[0] == roots.values[0][lane] && own.values[1] == roots.values[1][lane]));
        }
    }
}
#endif

static void rotations_are_checked_and_mended(void)
{
    gb_real r[9] = {R(1.0), 0, 0, 0, R(1.0), 0, 0, 0, R(1.0) + GB_ACCEPTANCE_INPUT / R(4.0)};
    CHECK(gb_make_rotation_1(r) && are_close(r[8], R(1.0), GB_ACCEPTANCE_INPUT / R(100.0)));
    r[8] = R(-1.0);
    CHECK(!gb_make_rotation_1(r));
    r[8] = R(1.1);
    CHECK(!gb_make_rotation_1(r));
    gb_real v[3] = {R(0.6), R(0.8), GB_ACCEPTANCE_INPUT / R(4.0)};
    CHECK(gb_make_unit_1(v));
    v[0] = NAN;
    CHECK(!gb_make_unit_1(v));
}

static void targets_that_are_none_are_refused(void)
{
    const gb_real q[PUMA_JOINTS] = {R(0.1), R(0.2), R(0.3), R(0.4), R(0.5), R(0.6)};
    gb_real target[PUMA_INPUTS];
    puma_solution out[PUMA_CAPACITY], nearest;
    CHECK(puma_forward(q, target));
    target[0] = NAN;
    CHECK(puma_solve(target, out) == GB_NOT_FINITE && isnan(puma_residual(target, q)));
    CHECK(puma_forward(q, target));
    target[3] += R(0.1);
    CHECK(puma_solve(target, out) == GB_NOT_ROTATION);
    CHECK(puma_forward(q, target));
    target[0] += R(10.0);
    CHECK(puma_solve_or_nearest(target, out, &nearest) == 0 && nearest.residual > R(1.0));
}

static bool is_among(const gb_real *q, const puma_solution *list, int count)
{
    for (int i = 0; i < count; i++) {
        if (gb_is_close(&gb_this, q, list[i].q, list[i].free, FOUND)) {
            return true;
        }
    }
    return false;
}

static void joints_come_back_from_forward_kinematics(void)
{
    int lost = 0;
    for (int i = 0; i < 2000; i++) {
        gb_real q[PUMA_JOINTS], target[PUMA_INPUTS];
        puma_solution out[PUMA_CAPACITY];
        random_joints(q);
        puma_forward(q, target);
        const int count = puma_solve(target, out);
        CHECK(count >= 0);
        lost += !is_among(q, out, count);
        for (int k = 0; k < count; k++) {
            CHECK(puma_residual(target, out[k].q) <= R(4.0) * GB_ACCEPTANCE_RESIDUAL);
            CHECK(k == 0 || out[k - 1].branch <= out[k].branch);
        }
    }
    CHECK(lost <= GB_EITHER_COUNT(0, 20));
}

static void free_joints_are_reported(void)
{
    const gb_real q[PUMA_JOINTS] = {R(0.3), R(-0.4), R(0.9), R(0.7), GB_PI / R(2.0), R(0.2)};
    gb_real target[PUMA_INPUTS];
    puma_solution out[PUMA_CAPACITY];
    puma_forward(q, target);
    const int count = puma_solve(target, out);
    bool is_free = false;
    for (int i = 0; i < count; i++) {
        is_free = is_free || out[i].free == 1u << 3;
    }
    CHECK(is_free);
}

static void pairs_are_cosines_and_sines_of_solutions(void)
{
    for (int i = 0; i < 500; i++) {
        gb_real q[PUMA_JOINTS], target[PUMA_INPUTS];
        puma_solution out[PUMA_CAPACITY];
        puma_pairs pairs[PUMA_CAPACITY];
        random_joints(q);
        puma_forward(q, target);
        const int count = puma_solve(target, out);
        CHECK(puma_solve_pairs(target, pairs) == count);
        for (int k = 0; k < count; k++) {
            CHECK(pairs[k].branch == out[k].branch);
            CHECK(are_close(pairs[k].joints[2][0], gb_cosine(out[k].q[2]), R(10.0) * CLOSE));
        }
    }
}

static void batches_hold_what_single_targets_do(void)
{
    enum { MANY = 203 };
    static gb_real targets[MANY * PUMA_INPUTS];
    static puma_solution all[MANY * PUMA_CAPACITY], one[PUMA_CAPACITY];
    int counts[MANY];
    size_t place = 0;
    for (size_t i = 0; i < MANY; i++) {
        gb_real q[PUMA_JOINTS];
        random_joints(q);
        q[4] = i % 9 == 0 ? GB_PI / R(2.0) : q[4];
        puma_forward(q, targets + i * PUMA_INPUTS);
        targets[i * PUMA_INPUTS] = i % 50 == 3 ? NAN : targets[i * PUMA_INPUTS];
    }
    CHECK(puma_solve_batch(targets, MANY, all, MANY * PUMA_CAPACITY, counts) == MANY);
    for (size_t i = 0; i < MANY; i++) {
        CHECK(puma_solve(targets + i * PUMA_INPUTS, one) == counts[i]);
        for (int k = 0; k < counts[i]; k++, place++) {
            CHECK(memcmp(one[k].q, all[place].q, sizeof one[k].q) == 0 && one[k].branch == all[place].branch && one[k].residual == all[place].residual);
        }
    }
    CHECK(puma_solve_batch(targets, MANY, all, 20, counts) < 5);
}

static void turns_are_counted_and_taken(void)
{
    const gb_real q[PUMA_JOINTS] = {R(1.0), R(-1.0), 0, 0, 0, 0};
    gb_real limits[2 * PUMA_JOINTS], out[PUMA_JOINTS];
    for (int i = 0; i < PUMA_JOINTS; i++) {
        limits[2 * i] = i == 0 ? R(-12.0) : R(-1.0);
        limits[2 * i + 1] = i == 0 ? R(12.0) : R(1.0);
    }
    CHECK(puma_count_turns(q, limits) == 4);
    puma_turn(q, limits, 0, out);
    CHECK(are_close(out[0], R(1.0) - R(2.0) * GB_TAU, R(10.0) * CLOSE) && out[1] == R(-1.0));
    puma_turn(q, limits, 2, out);
    CHECK(out[0] == R(1.0));
    limits[2] = R(0.0);
    CHECK(puma_count_turns(q, limits) == 0);
    CHECK(puma_count_turns(q, puma_limits) == 1);
}

static void solutions_are_brought_within_limits(void)
{
    const gb_real q[PUMA_JOINTS] = {R(0.3), R(-0.4), R(0.9), R(0.7), R(0.8), R(0.2)}, ones[PUMA_JOINTS] = {1, 1, 1, 1, 1, 1};
    gb_real target[PUMA_INPUTS], limits[2 * PUMA_JOINTS], place[PUMA_JOINTS];
    puma_solution out[PUMA_CAPACITY];
    for (int i = 0; i < PUMA_JOINTS; i++) {
        limits[2 * i] = q[i] - R(0.1) + GB_TAU;
        limits[2 * i + 1] = q[i] + R(0.1) + GB_TAU;
    }
    puma_forward(q, target);
    CHECK(puma_solve_within(target, limits, out) == 1 && are_close(out[0].q[0], q[0] + GB_TAU, FOUND));
    const int count = puma_solve(target, out), best = puma_nearest(out, count, q, ones, puma_limits, place);
    CHECK(best >= 0 && gb_is_close(&gb_this, q, place, 0, FOUND));
    limits[0] = limits[1] = R(2.0);
    CHECK(puma_nearest(out, count, q, ones, limits, place) == -1);
}

static void frames_are_composed(void)
{
    const gb_real base[12] = {R(1.0), R(2.0), R(3.0), 0, R(-1.0), 0, R(1.0), 0, 0, 0, 0, R(1.0)};
    const gb_real tool[12] = {0, 0, R(0.5), R(1.0), 0, 0, 0, R(1.0), 0, 0, 0, R(1.0)};
    const gb_real pose[12] = {R(1.0), R(3.0), R(4.0), R(1.0), 0, 0, 0, R(1.0), 0, 0, 0, R(1.0)};
    const gb_real expected[12] = {R(1.0), 0, R(0.5), 0, R(1.0), 0, R(-1.0), 0, 0, 0, 0, R(1.0)};
    gb_real target[12];
    puma_target_of(base, tool, pose, target);
    for (int i = 0; i < 12; i++) {
        CHECK(are_close(target[i], expected[i], CLOSE));
    }
}

int main(void)
{
    squares_have_two_roots_one_or_none();
    polynomials_have_their_roots();
#ifndef GB_FLOAT
    double_roots_are_found_once();
#endif
    a_small_leading_coefficient_passes_the_turn_on();
    angles_are_those_of_the_library();
    angles_are_wrapped();
#if GB_LANES > 1
    lanes_hold_what_numbers_do();
#endif
    rotations_are_checked_and_mended();
    targets_that_are_none_are_refused();
    joints_come_back_from_forward_kinematics();
    free_joints_are_reported();
    pairs_are_cosines_and_sines_of_solutions();
    batches_hold_what_single_targets_do();
    turns_are_counted_and_taken();
    solutions_are_brought_within_limits();
    frames_are_composed();
    printf("all tests passed\n");
    return 0;
}
