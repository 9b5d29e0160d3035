/* Prints arcs of redundant arms, like redundant.rs: a word of 64 bits in hexadecimal for each number. Also checks that joint values reach the target within
 * limits. */
#define GB_RUNTIME
#include "groebot.h"
#include "groebot_redundant.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "redundant_arms.c"

#define CHECK(truth) ((truth) ? (void)0 : fail(#truth, __LINE__))

/* Maximal numbers of arcs, samples and optima. */
#define ARCS 64
#define SAMPLES 7
#define OPTIMA 6

static void fail(const char *what, int line)
{
    printf("redundant.c:%d: %s does not hold\n", line, what);
    exit(1);
}

static void print(const char *name, const double *numbers, size_t count)
{
    printf("%s", name);
    for (size_t i = 0; i < count; i++) {
        uint64_t word;
        memcpy(&word, &numbers[i], sizeof word);
        printf(" %016" PRIx64, word);
    }
    printf("\n");
}

/* The planar arm, the rail and the arm with spherical shoulder and wrist. */
enum { PLANAR, RAIL, SRS };

static void forward(int robot, const double *q, double *target)
{
    if (robot == SRS) {
        srs_pose(q, target);
    } else if (robot == RAIL) {
        target[0] = q[0] + rail_links[0] * gb_cosine(q[1]) + rail_links[1] * gb_cosine(q[1] + q[2]);
        target[1] = rail_links[0] * gb_sine(q[1]) + rail_links[1] * gb_sine(q[1] + q[2]);
    } else {
        const double a = q[0], b = q[0] + q[1], c = q[0] + q[1] + q[2], *l = planar_links;
        target[0] = l[0] * gb_cosine(a) + l[1] * gb_cosine(b) + l[2] * gb_cosine(c);
        target[1] = l[0] * gb_sine(a) + l[1] * gb_sine(b) + l[2] * gb_sine(c);
    }
}

/* Checks joint values: they reach the target and are within limits. */
static void expect_solution(int robot, size_t joints, const double *target, const double *limits, const double *q)
{
    double reached[GB_ARM_TARGET] = {0.0};
    forward(robot, q, reached);
    for (int i = 0; i < GB_ARM_TARGET; i++) {
        CHECK(gb_magnitude(reached[i] - target[i]) <= 1e-9);
    }
    for (size_t i = 0; i < joints; i++) {
        CHECK(q[i] >= limits[2 * i] - 1e-8 && q[i] <= limits[2 * i + 1] + 1e-8);
    }
}

static void print_end(const char *name, const gb_arc_end *end)
{
    printf("joint %d %d\n", end->joint, end->is_upper);
    print(name, end->q, GB_MOST_ARM_JOINTS);
}

static void print_optima(const gb_arm *arm, const double *target, const double *limits, const gb_arc *arcs, size_t count)
{
    for (int kind = 0; kind < 5; kind++) {
        gb_criterion criterion;
        gb_optimum list[OPTIMA], best;
        memset(&criterion, 0, sizeof criterion);
        criterion.kind = kind == 4 ? GB_CRITERION_MARGIN : (gb_criterion_kind)kind;
        criterion.is_relative = kind == 4;
        criterion.joint = 1;
        criterion.value = 0.25;
        for (int i = 0; i < GB_MOST_ARM_JOINTS; i++) {
            criterion.q0[i] = 0.1 * i - 0.3;
            criterion.weights[i] = 1.0 + 0.5 * i;
        }
        const int number = gb_optima(arm, target, limits, arcs, count, &criterion, list, OPTIMA);
        printf("optima %d\n", number);
        for (int k = 0; k < number; k++) {
            for (size_t i = 0; i < arm->count; i++) {
                /* Curves that only touch a limit, within 1e-7, do not end there. */
                CHECK(list[k].q[i] >= limits[2 * i] - 1e-7 && list[k].q[i] <= limits[2 * i + 1] + 1e-7);
            }
            printf("arc %zu\n", list[k].arc);
            print("optimum", list[k].q, GB_MOST_ARM_JOINTS);
            print("value", &list[k].value, 1);
            print("s", &list[k].s, 1);
        }
        CHECK(gb_best(arm, target, limits, arcs, count, &criterion, &best) == (number > 0));
        CHECK(number == 0 || best.value == list[0].value || gb_magnitude(best.value - list[0].value) <= 1e-11);
    }
}

/* Prints one of the arcs that differ by whole turns, within limits that are wider by more than one turn. */
static void print_turned(const gb_arm *arm, const double *target, const double *limits, const gb_arc *arc)
{
    double wide[2 * GB_MOST_ARM_JOINTS], start[GB_MOST_ARM_JOINTS], list[3][GB_MOST_ARM_JOINTS];
    gb_arm_span span;
    for (size_t i = 0; i < arm->count; i++) {
        wide[2 * i] = limits[2 * i] - 7.0;
        wide[2 * i + 1] = limits[2 * i + 1] + 8.0;
    }
    gb_arc_span(arm, target, limits, arc, &span);
    const size_t count = gb_span_turns(arm, wide, &span);
    gb_span_turn(arm, wide, &span, count / 2, start);
    gb_arc_sample_from(arm, target, limits, arc, start, list, 3);
    print("low", span.low, GB_MOST_ARM_JOINTS);
    print("high", span.high, GB_MOST_ARM_JOINTS);
    printf("turns %zu\n", count);
    for (int k = 0; k < 3; k++) {
        print("turned", list[k], GB_MOST_ARM_JOINTS);
    }
}

static void print_samples(const gb_arm *arm, const double *target, const double *limits, const gb_arc *arc)
{
    double list[SAMPLES][GB_MOST_ARM_JOINTS];
    gb_arc_sample(arm, target, limits, arc, list, SAMPLES);
    for (int k = 0; k < SAMPLES; k++) {
        print("sample", list[k], GB_MOST_ARM_JOINTS);
    }
    gb_arc_at(arm, target, limits, arc, 0.3 * arc->length, list[0]);
    print("at", list[0], GB_MOST_ARM_JOINTS);
    print_turned(arm, target, limits, arc);
}

static void print_within(int number, const gb_redundant *robot, const double *target, const double *limits, bool has_solution)
{
    gb_within within;
    const int code = gb_any_within(robot, target, limits, &within);
    printf("within %d\n", code);
    CHECK(code == 1 || !has_solution);
    if (code == 1) {
        print("q", within.q, GB_MOST_ARM_JOINTS);
        expect_solution(number, robot->arm->count, target, limits, within.q);
    } else if (code == 0) {
        printf("none %d %u %d\n", within.is_reachable, (unsigned)within.beyond, within.is_unsure);
    }
}

/* Prints all results for a target. Returns the number of arcs. */
static size_t print_all(int number, const gb_redundant *robot, const double *target, const double *limits, bool has_solution)
{
    const gb_arm *arm = robot->arm;
    gb_arc arcs[ARCS];
    gb_arcs_outcome outcome;
    print("target", target, GB_ARM_TARGET);
    print_within(number, robot, target, limits, has_solution);
    const int code = gb_arcs(robot, target, limits, arcs, ARCS, &outcome);
    printf("arcs %d\n", code);
    if (code < 0) {
        return 0;
    }
    printf("outcome %zu %zu %d %zu %d %d %d %u\n", outcome.count, outcome.ends, outcome.is_unsure, outcome.closed, outcome.is_surface,
           outcome.is_reachable, outcome.is_grid_only, (unsigned)outcome.beyond);
    CHECK(outcome.count <= ARCS && (outcome.count > 0 || !has_solution));
    for (size_t k = 0; k < outcome.count; k++) {
        printf("arc %d %d\n", arcs[k].is_closed, arcs[k].is_unsure);
        print_end("start", &arcs[k].start);
        print_end("end", &arcs[k].end);
        print("length", &arcs[k].length, 1);
        print_samples(arm, target, limits, &arcs[k]);
        expect_solution(number, arm->count, target, limits, arcs[k].start.q);
        expect_solution(number, arm->count, target, limits, arcs[k].end.q);
    }
    print_optima(arm, target, limits, arcs, outcome.count);
    return outcome.count;
}

/* Limits of an angle: random, round, a whole turn, or none. Returns false if they are not in order. */
static bool random_limits(int number, double *limits)
{
    const double low = between(-3.0, 0.0), range = between(0.2, 5.0);
    limits[0] = low;
    limits[1] = low + range;
    if (number % 5 == 1) {
        limits[0] = -PI / 6.0 * (double)(int)(6.0 * random_number());
        limits[1] = PI / 6.0 * (double)(int)(6.0 * random_number());
    } else if (number % 11 == 3) {
        limits[1] = low + 2.0 * PI;
    } else if (number % 11 == 5) {
        limits[0] = -HUGE_VAL;
        limits[1] = HUGE_VAL;
    } else if (number == 77) {
        limits[0] = 1.0;
        limits[1] = -1.0;
    }
    return limits[0] <= limits[1];
}

/* A random joint value within limits; a round one for every fifth target. */
static double random_value(int number, const double *limits)
{
    const double low = limits[0] >= -PI ? limits[0] : -PI, high = limits[1] <= PI ? limits[1] : PI;
    if (number % 5 == 1) {
        const int most = (int)((high - low) * 6.0 / PI);
        return low + PI / 6.0 * (double)(int)((double)(most + 1) * random_number());
    }
    return between(low, high);
}

/* Random and round targets of an arm within random limits. Returns the number of arcs. */
static size_t print_targets(int robot, int first, int last, gb_redundant *solver, gb_arm *arm)
{
    size_t arcs = 0;
    for (int number = first; number < last; number++) {
        double q[GB_MOST_ARM_JOINTS] = {0.0}, target[GB_ARM_TARGET] = {0.0};
        bool is_ordered = true;
        for (size_t i = 0; i < arm->count; i++) {
            double *limits = arm->limits + 2 * i;
            if (robot == SRS && number % 3 == 0) {
                limits[0] = 0.6 * limits[0];
                limits[1] = 0.9 * limits[1];
            } else if (robot != SRS) {
                is_ordered &= random_limits(number, limits);
            }
            q[i] = random_value(number, limits);
        }
        if (robot == SRS && number % 10 == 6) {
            q[3] = 0.0;
        }
        forward(robot, q, target);
        if (number % 7 == 4) {
            target[0] += between(-2.0, 2.0);
        }
        /* Where the arm is nearly stretched, rounding may move joints beyond limits, and a closed curve may be narrower than the grid. */
        const bool is_bent = gb_magnitude(q[robot == SRS ? 3 : 2]) > 0.5;
        arcs += print_all(robot, solver, target, arm->limits, is_ordered && is_bent && number % 7 != 4);
        if (robot == SRS) {
            set_srs(arm);
        }
    }
    return arcs;
}

/* The rotation of the tip by yaw, pitch and roll. */
static void set_tip(gb_arm *arm, double yaw, double pitch, double roll)
{
    double next[3][3];
    about(2, yaw, arm->tip.rotation);
    about(1, pitch, next);
    multiply(arm->tip.rotation, next);
    about(0, roll, next);
    multiply(arm->tip.rotation, next);
}

static void random_direction(double *out)
{
    const double x = between(-1.0, 1.0), y = between(-1.0, 1.0), z = between(0.1, 1.0), length = gb_square_root(x * x + y * y + z * z);
    out[0] = x / length;
    out[1] = y / length;
    out[2] = z / length;
}

/* An arm with random axes, all parallel for planar tasks, and a prismatic joint; and the target that it reaches at zero. */
static void random_arm(int number, gb_task_kind kind, gb_arm *arm, double *target)
{
    static const size_t joints[9] = {7, 4, 4, 6, 3, 6, 5, 3, 4};
    const size_t axis = (size_t)number % 3, slide = (size_t)(8.0 * random_number());
    const double yaw = between(-3.0, 3.0), pitch = between(-1.0, 1.0), roll = between(-1.0, 1.0);
    const bool is_parallel = kind >= GB_TASK_POSITION_YAW, is_rotation = kind == GB_TASK_ROTATION || kind == GB_TASK_DIRECTION;
    clear_arm(arm, joints[kind], kind, 0.7);
    arm->task.axis = axis;
    arm->task.coordinates[0] = axis == 0 ? 1 : 0;
    arm->task.coordinates[1] = axis == 2 ? 1 : 2;
    set_tip(arm, yaw, pitch, roll);
    random_direction(arm->task.direction);
    for (int i = 0; i < 3; i++) {
        arm->tip.translation[i] = between(0.5, 1.0);
    }
    for (size_t i = 0; i < arm->count; i++) {
        random_direction(arm->directions[i]);
        for (size_t k = 0; k < 3; k++) {
            arm->points[i][k] = between(-1.0, 1.0);
            arm->directions[i][k] = is_parallel ? (k == axis ? 1.0 : 0.0) : arm->directions[i][k];
        }
        arm->slides[i] = kind == GB_TASK_POSITION_YAW ? i == 1 : i == slide && !is_parallel && !is_rotation;
        arm->limits[2 * i] = -3.0;
        arm->limits[2 * i + 1] = 2.5;
    }
    if (kind == GB_TASK_POSITION_YAW) {
        about(axis, yaw, arm->tip.rotation);
        for (size_t k = 0; k < 3; k++) {
            arm->task.direction[k] = k == (axis + 1) % 3 ? 1.0 : 0.0;
        }
    }
    memset(target, 0, GB_ARM_TARGET * sizeof *target);
    double *after = is_rotation ? target : target + 3;
    memcpy(target, arm->tip.translation, 3 * sizeof *target);
    if (kind == GB_TASK_POSE || kind == GB_TASK_ROTATION) {
        memcpy(after, arm->tip.rotation, 9 * sizeof *target);
    } else if (kind == GB_TASK_RAY || kind == GB_TASK_DIRECTION) {
        image(arm->tip.rotation, arm->task.direction, after);
    } else if (kind == GB_TASK_POSITION_PITCH_ROLL) {
        target[3] = pitch;
        target[4] = roll;
    } else if (kind == GB_TASK_POSITION_YAW) {
        target[3] = yaw;
    } else if (kind >= GB_TASK_PLANAR_POSITION) {
        target[0] = arm->tip.translation[arm->task.coordinates[0]];
        target[1] = arm->tip.translation[arm->task.coordinates[1]];
        target[2] = 0.0;
    }
}

/* The curves through zero of arms with all tasks. */
static void print_tasks(void)
{
    for (int number = 0; number < 90; number++) {
        gb_arm arm;
        gb_arc arc;
        double target[GB_ARM_TARGET];
        random_arm(number / 9, (gb_task_kind)(number % 9), &arm, target);
        memset(&arc, 0, sizeof arc);
        arc.length = 2.0;
        arc.side = 1.0;
        print("target", target, GB_ARM_TARGET);
        print_samples(&arm, target, arm.limits, &arc);
        print_optima(&arm, target, arm.limits, &arc, 1);
    }
}

int main(void)
{
    gb_arm arm;
    gb_redundant planar = {&arm, NULL, solve_planar}, rail = {&arm, NULL, solve_rail}, srs = {&arm, NULL, solve_srs};
    set_planar(&arm);
    CHECK(print_targets(PLANAR, 0, 150, &planar, &arm) > 150);
    set_rail(&arm);
    CHECK(print_targets(RAIL, 0, 60, &rail, &arm) > 60);
    set_srs(&arm);
    CHECK(print_targets(SRS, 0, 60, &srs, &arm) > 200);
    print_tasks();
    return 0;
}
