/* Begins the next solver of a file that has several, one for each given joint. GB_PART is the number of that joint, from 1. The facts of the solver before are
 * removed. Names of its functions, types and tables are used again: those of the next solvers end with `_given_` and
 * GB_PART. */

#undef GB_ROBOT
#undef GB_INPUTS
#undef GB_PARAMETERS
#undef GB_JOINTS
#undef GB_PLACES
#undef GB_EQUATIONS
#undef GB_SIZES
#undef GB_CANDIDATES
#undef GB_CAPACITY
#undef GB_SHORTS
#undef GB_DEGREE
#undef GB_JACOBIAN
#undef GB_JOINT_LIST
#undef GB_LAST_FIRST
#undef GB_SIZE_OF
#undef GB_COMPARED
#undef GB_TURNED
#undef GB_FREED
#undef GB_RUNS
#undef GB_TWINS
#undef GB_SCALE
#undef GB_ISOLATED
#undef GB_EXTRAS
#undef GB_CONDITIONS
#undef GB_WITHIN
#undef GB_REACHED
#undef GB_PREFERRED
#undef GB_PREFERS_GREATEST
#undef GB_GIVEN
#undef GB_DEFAULTS
#undef GB_OF_PART
#undef GB_WIDTH
#define GB_GIVEN GB_PART

#ifndef GB_OWN
#define GB_OWN(name) GB_JOIN(gb_, name, GB_OF_PART)
#define gb_add_others GB_OWN(add_others)
#define gb_approach_from GB_OWN(approach_from)
#define gb_approaches GB_OWN(approaches)
#define gb_are_apart GB_OWN(are_apart)
#define gb_are_in_order GB_OWN(are_in_order)
#define gb_are_ordinary GB_OWN(are_ordinary)
#define gb_are_within GB_OWN(are_within)
#define gb_as_described GB_OWN(as_described)
#define gb_assert_candidates_are_even GB_OWN(assert_candidates_are_even)
#define gb_assert_equations_have_room_in_groebot_c GB_OWN(assert_equations_have_room_in_groebot_c)
#define gb_assert_joints_have_room_in_groebot_c GB_OWN(assert_joints_have_room_in_groebot_c)
#define gb_assert_places_have_room_in_groebot_c GB_OWN(assert_places_have_room_in_groebot_c)
#define gb_assert_sizes_have_room_in_groebot_c GB_OWN(assert_sizes_have_room_in_groebot_c)
#define gb_bring_all_within GB_OWN(bring_all_within)
#define gb_bring_within GB_OWN(bring_within)
#define gb_compared GB_OWN(compared)
#define gb_conditions GB_OWN(conditions)
#define gb_conform GB_OWN(conform)
#define gb_derive_affine GB_OWN(derive_affine)
#define gb_described_1 GB_OWN(described_1)
#define gb_everywhere GB_OWN(everywhere)
#define gb_extras_of GB_OWN(extras_of)
#define gb_find_approaches GB_OWN(find_approaches)
#define gb_find_joints GB_OWN(find_joints)
#define gb_first_step_1 GB_OWN(first_step_1)
#define gb_fit_all GB_OWN(fit_all)
#define gb_fit_to GB_OWN(fit_to)
#define gb_fit_waiting GB_OWN(fit_waiting)
#define gb_fits GB_OWN(fits)
#define gb_flush GB_OWN(flush)
#define gb_follow GB_OWN(follow)
#define gb_freed GB_OWN(freed)
#define gb_fulfil_1 GB_OWN(fulfil_1)
#define gb_has_enough GB_OWN(has_enough)
#define gb_ideal_parameters GB_OWN(ideal_parameters)
#define gb_ideal_target GB_OWN(ideal_target)
#define gb_is_far GB_OWN(is_far)
#define gb_is_new GB_OWN(is_new)
#define gb_jacobian GB_OWN(jacobian)
#define gb_jacobian_as_described GB_OWN(jacobian_as_described)
#define gb_joints GB_OWN(joints)
#define gb_joints_of GB_OWN(joints_of)
#define gb_keep_one_within GB_OWN(keep_one_within)
#define gb_keep_pairs GB_OWN(keep_pairs)
#define gb_keep_waiting GB_OWN(keep_waiting)
#define gb_last_first GB_OWN(last_first)
#define gb_lead GB_OWN(lead)
#define gb_look_closer GB_OWN(look_closer)
#define gb_measure_of GB_OWN(measure_of)
#define gb_measure_waiting GB_OWN(measure_waiting)
#define gb_normal_1 GB_OWN(normal_1)
#define gb_onto_self_motion GB_OWN(onto_self_motion)
#define gb_parameters_1 GB_OWN(parameters_1)
#define gb_read_off GB_OWN(read_off)
#define gb_run_of GB_OWN(run_of)
#define gb_runs GB_OWN(runs)
#define gb_search_ideal GB_OWN(search_ideal)
#define gb_second_step_1 GB_OWN(second_step_1)
#define gb_settle GB_OWN(settle)
#define gb_sink_1 GB_OWN(sink_1)
#define gb_size_of GB_OWN(size_of)
#define gb_sizes_1 GB_OWN(sizes_1)
#define gb_sizes_of GB_OWN(sizes_of)
#define gb_solve_described GB_OWN(solve_described)
#define gb_solve_ideal GB_OWN(solve_ideal)
#define gb_start_approaches GB_OWN(start_approaches)
#define gb_step_approaches GB_OWN(step_approaches)
#define gb_step_back GB_OWN(step_back)
#define gb_step_walker GB_OWN(step_walker)
#define gb_suffice_since GB_OWN(suffice_since)
#define gb_take_1 GB_OWN(take_1)
#define gb_take_closest GB_OWN(take_closest)
#define gb_take_member GB_OWN(take_member)
#define gb_take_other GB_OWN(take_other)
#define gb_tell_apart GB_OWN(tell_apart)
#define gb_this GB_OWN(this)
#define gb_tip_1 GB_OWN(tip_1)
#define gb_turn_back_1 GB_OWN(turn_back_1)
#define gb_turned GB_OWN(turned)
#define gb_twins GB_OWN(twins)
#define gb_values_1 GB_OWN(values_1)
#define gb_values_as_described GB_OWN(values_as_described)
#define gb_values_of GB_OWN(values_of)
#define gb_walk_1 GB_OWN(walk_1)
#define gb_walk_through GB_OWN(walk_through)
#define gb_walker GB_OWN(walker)
#define gb_write_apart GB_OWN(write_apart)
#define gb_write_approaches GB_OWN(write_approaches)
#define gb_write_one GB_OWN(write_one)
#define gb_write_pairs GB_OWN(write_pairs)
#endif
