/* The solver as that of a joint with a given value: see solve_part of given.rs */

/* Adds all solutions of the target with the joint given at `value` to the list. Returns 0, or a code below zero. */
static int GB_JOIN(GB_ROBOT, _given_, GB_GIVEN)(const gb_real *target, gb_real value, gb_arm_members *members)
{
    gb_real numbers[GB_INPUTS];
    gb_solution list[GB_CAPACITY];
    memcpy(numbers, target, sizeof numbers - sizeof value);
    numbers[GB_INPUTS - 1] = value;
#ifndef GB_PART
    const int count = GB_PUBLIC(solve)(numbers, list);
#else
    size_t steps = gb_steps_at_most(GB_MOST_STEPS);
#ifdef GB_WITHIN
    const int count = gb_solve_described(numbers, list, NULL, &steps);
#else
    const int count = gb_solve_ideal(numbers, list, &steps);
#endif
#endif
    for (int k = 0; k < count; k++) {
        gb_arm_member member = {{0}, list[k].free, list[k].settled};
        memcpy(member.q, list[k].q, sizeof list[k].q);
        gb_add_arm_member(members, &member);
    }
    return count < 0 ? count : 0;
}
