// The generated solver arm.c in C++, without MoveIt. Joint values are in rad or m, in the order of joint_names().
#pragma once

#include <array>
#include <string>
#include <vector>

namespace groebot_arm
{

using Values = std::vector<double>;

// The pose base_from_tip: its position (m), then its rotation matrix by rows.
using Target = std::array<double, 12>;

// The solutions that are searched for: those of a target within limits, nearest to the seed first. Limits are the least and the greatest value of each
// joint in turn, infinite where there is none.
struct Query
{
    Target target;
    Values seed;
    Values limits;
};

// The names of the joints in the description of the arm.
std::vector<std::string> joint_names();

// The limits in the description of the arm.
Values described_limits();

// The pose of the tip at joint values.
Target forward(const Values &q);

// Whether two solutions are one: their joint values differ by less than 1e-6.
bool is_same(const Values &a, const Values &b);

// Whether the solutions of a pose are curves.
bool is_redundant();

// Of an arm of six joints, all solutions within limits; at singular targets also the nearest one on self-motions. Of a redundant arm, the solutions on arcs
// whose distance to the seed has a local minimum. Empty for a target that is out of reach or not a pose, and for limits that are not in order.
std::vector<Values> solutions(const Query &query);

// Of a redundant arm, points on all arcs at most `step` apart (rad), but at most 1,000 of an arc. Otherwise empty.
std::vector<Values> samples(const Query &query, double step);

} // namespace groebot_arm
