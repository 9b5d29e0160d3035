/* Measures one printed solver: see printed.py, which defines SOLVER, NAME, CAPACITY and SLIDES. */
#include SOLVER

#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define JOIN(a, b) a##b
#define CALLED(name, what) JOIN(name, what)

static uint64_t word = 88172645463325252u;

static double next(void)
{
    word ^= word << 13;
    word ^= word >> 7;
    word ^= word << 17;
    return (double)(word >> 11) / 4503599627370496.0 - 1.0;
}

static double now(clockid_t clock)
{
    struct timespec at;
    clock_gettime(clock, &at);
    return 1e6 * (double)at.tv_sec + 1e-3 * (double)at.tv_nsec;
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

int main(int count, char **words)
{
    const long poses = count > 1 ? atol(words[1]) : 1000;
    double(*joints)[6] = malloc((size_t)poses * sizeof *joints);
    double(*targets)[12] = malloc((size_t)poses * sizeof *targets);
    double *times = malloc((size_t)poses * sizeof *times);
    long answers = 0, lost = 0;
    for (long i = 0; i < poses; i++) {
        for (int k = 0; k < 6; k++) {
            const double value = next();
            joints[i][k] = SLIDES >> k & 1 ? value : 3.141592653589793 * value;
        }
        CALLED(NAME, _forward)(joints[i], targets[i]);
    }
    const double before = now(CLOCK_PROCESS_CPUTIME_ID);
    for (long i = 0; i < poses; i++) {
        CALLED(NAME, _solution) out[CAPACITY];
        const double start = now(CLOCK_MONOTONIC);
        const int found = CALLED(NAME, _solve)(targets[i], out);
        times[i] = now(CLOCK_MONOTONIC) - start;
        answers += found > 0 ? found : 0;
        int near = 0;
        for (int k = 0; k < found && !near; k++) {
            near = 1;
            for (int j = 0; j < 6; j++) {
                const double way = out[k].q[j] - joints[i][j];
                const double turns = SLIDES >> j & 1 ? 0.0 : round(way / 6.283185307179586);
                near = near && fabs(way - 6.283185307179586 * turns) <= 1e-6;
            }
        }
        lost += !near;
    }
    const double mean = (now(CLOCK_PROCESS_CPUTIME_ID) - before) / (double)poses;
    qsort(times, (size_t)poses, sizeof *times, by_size);
    printf("%ld,%.2f,%.1f,%.1f,%.1f,%.1f,%.0f\n", lost, (double)answers / (double)poses, mean, times[(poses - 1) / 10], times[(poses - 1) / 2],
           times[(poses - 1) * 9 / 10], times[(poses - 1) * 999 / 1000]);
    return 0;
}
