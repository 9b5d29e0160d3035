/* Compares PUMA's solutions bitwise with those that reference.rs has written. */
#include "puma.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The next word of a file; false at its end. */
static bool next(FILE *file, uint64_t *word)
{
    return fread(word, sizeof *word, 1, file) == 1;
}

/* Whether a number is the next one of a file; all NaN are equal. */
static bool is_next(FILE *file, double number)
{
    uint64_t word;
    double other;
    if (!next(file, &word)) {
        return false;
    }
    memcpy(&other, &word, sizeof other);
    return memcmp(&other, &number, sizeof other) == 0 || (isnan(other) && isnan(number));
}

/* Whether a solution is the next one of a file. All of its fields are read. */
static bool is_next_solution(FILE *file, const puma_solution *solution)
{
    bool is_equal = true;
    for (int i = 0; i < PUMA_JOINTS; i++) {
        is_equal &= is_next(file, solution->q[i]);
    }
    is_equal &= is_next(file, solution->residual);
    is_equal &= is_next(file, solution->relative);
    is_equal &= is_next(file, (double)solution->branch);
    is_equal &= is_next(file, (double)solution->chosen);
    is_equal &= is_next(file, (double)solution->settled);
    is_equal &= is_next(file, (double)solution->free);
    return is_equal;
}

/* Whether pairs are the next ones of a file. All of their fields are read. */
static bool are_next_pairs(FILE *file, const puma_pairs *pairs)
{
    bool is_equal = true;
    for (int i = 0; i < PUMA_JOINTS; i++) {
        is_equal &= is_next(file, pairs->joints[i][0]);
        is_equal &= is_next(file, pairs->joints[i][1]);
    }
    is_equal &= is_next(file, pairs->residual);
    is_equal &= is_next(file, (double)pairs->branch);
    is_equal &= is_next(file, (double)pairs->free);
    return is_equal;
}

/* Whether solutions are the next ones of a file. All of them are read. */
static bool are_next_solutions(FILE *file, const puma_solution *out, int count)
{
    bool are_equal = is_next(file, count);
    for (int i = 0; i < count; i++) {
        are_equal &= is_next_solution(file, &out[i]);
    }
    return are_equal;
}

/* Whether all solutions of the target with this number are the next ones of a file. */
static bool are_next_answers(FILE *file, const double *target, size_t number)
{
    puma_solution out[PUMA_CAPACITY], nearest;
    puma_pairs pairs[PUMA_CAPACITY];
    int count = puma_solve(target, out);
    bool are_equal = are_next_solutions(file, out, count);
    count = puma_solve_bounded(target, number % 256, out);
    are_equal &= are_next_solutions(file, out, count);
    count = puma_solve_pairs(target, pairs);
    are_equal &= is_next(file, count);
    for (int i = 0; i < count; i++) {
        are_equal &= are_next_pairs(file, &pairs[i]);
    }
    puma_solve_or_nearest(target, out, &nearest);
    are_equal &= is_next(file, nearest.residual);
    return are_equal;
}

int main(int count, char **arguments)
{
    FILE *file = count == 2 ? fopen(arguments[1], "rb") : NULL;
    uint64_t word;
    size_t targets = 0;
    if (!file) {
        return 2;
    }
    while (next(file, &word)) {
        double target[PUMA_INPUTS];
        memcpy(target, &word, sizeof word);
        for (int i = 1; i < PUMA_INPUTS; i++) {
            if (!next(file, &word)) {
                return 2;
            }
            memcpy(target + i, &word, sizeof word);
        }
        if (!are_next_answers(file, target, targets)) {
            printf("target %zu has other answers\n", targets);
            return 1;
        }
        targets++;
    }
    fclose(file);
    printf("%zu targets have the same answers\n", targets);
    return 0;
}
