#include "solver.hpp"

#include <algorithm>
#include <cmath>
#include <memory>

#define ARM_DECLARATIONS_ONLY
#include "arm.c"

#ifdef GROEBOT_REDUNDANT_H
static_assert(ARM_JOINTS == GB_MOST_ARM_JOINTS && ARM_INPUTS == 13, "the task is a pose");
#else
static_assert(ARM_INPUTS == 12, "the task is a pose, and no joint is given");
#endif

namespace groebot_arm
{
namespace
{

// Limits of MoveIt hold exactly. Those of the solver hold within 1e-9, and within 1e-7 where a curve only touches a limit: such values are moved to the limit.
constexpr double TOUCHING = 1e-7;

// Solutions by distance to the seed.
class Candidates
{
public:
    explicit Candidates(const Query &query) : query_(query), weights_(ARM_JOINTS, 1.0), wider_(query.limits)
    {
        for (std::size_t i = 0; i < ARM_JOINTS; i++) {
            wider_[2 * i] -= TOUCHING;
            wider_[2 * i + 1] += TOUCHING;
        }
    }

    // Adds a solution, with its angles turned to the values within limits that are nearest to the seed. Without such values it is omitted.
    void add(const double *q)
    {
        arm_solution solution{};
        std::copy_n(q, ARM_JOINTS, solution.q);
        Values turned(ARM_JOINTS);
        const double *limits = query_.limits.data();
        if (arm_nearest(&solution, 1, query_.seed.data(), weights_.data(), wider_.data(), turned.data()) < 0) {
            return;
        }
        double distance = 0.0;
        for (std::size_t i = 0; i < ARM_JOINTS; i++) {
            turned[i] = std::clamp(turned[i], limits[2 * i], limits[2 * i + 1]);
            distance += (turned[i] - query_.seed[i]) * (turned[i] - query_.seed[i]);
        }
        list_.push_back({distance, turned});
    }

    // The solutions, the nearest one first, without repetitions.
    std::vector<Values> sorted()
    {
        std::sort(list_.begin(), list_.end());
        std::vector<Values> result;
        for (Candidate &candidate : list_) {
            if (result.empty() || !is_same(result.back(), candidate.second)) {
                result.push_back(std::move(candidate.second));
            }
        }
        return result;
    }

    const double *weights() const
    {
        return weights_.data();
    }

private:
    using Candidate = std::pair<double, Values>;

    const Query &query_;
    Values weights_;
    Values wider_;
    std::vector<Candidate> list_;
};

#ifdef GROEBOT_REDUNDANT_H

// The greatest numbers of arcs of a target, of local minima on them, and of samples of an arc.
constexpr std::size_t MOST_ARCS = 64;
constexpr std::size_t MOST_OPTIMA = 128;
constexpr double MOST_SAMPLES = 1000;

std::vector<gb_arc> arcs_of(const Query &query)
{
    std::vector<gb_arc> arcs(MOST_ARCS);
    gb_arcs_outcome outcome;
    const int code = arm_arcs(query.target.data(), query.limits.data(), arcs.data(), arcs.size(), &outcome);
    arcs.resize(code < 0 ? 0 : std::min(outcome.count, arcs.size()));
    return arcs;
}

#endif

} // namespace

std::vector<std::string> joint_names()
{
    return {arm_joint_names, arm_joint_names + ARM_JOINTS};
}

Values described_limits()
{
    return {arm_limits, arm_limits + 2 * ARM_JOINTS};
}

Target forward(const Values &q)
{
    double numbers[ARM_INPUTS];
    arm_forward(q.data(), numbers);
    Target target;
    std::copy_n(numbers, target.size(), target.begin());
    return target;
}

bool is_same(const Values &a, const Values &b)
{
    return std::equal(a.begin(), a.end(), b.begin(), [](double x, double y) { return std::abs(x - y) < 1e-6; });
}

#ifdef GROEBOT_REDUNDANT_H

bool is_redundant()
{
    return true;
}

std::vector<Values> solutions(const Query &query)
{
    const std::vector<gb_arc> arcs = arcs_of(query);
    const gb_criterion nearest = gb_nearest_to_joints(query.seed.data());
    std::vector<gb_optimum> optima(MOST_OPTIMA);
    const int count = arm_optima(query.target.data(), query.limits.data(), arcs.data(), arcs.size(), &nearest, optima.data(), MOST_OPTIMA);
    Candidates candidates(query);
    for (int k = 0; k < count; k++) {
        candidates.add(optima[static_cast<std::size_t>(k)].q);
    }
    return candidates.sorted();
}

std::vector<Values> samples(const Query &query, double step)
{
    Candidates candidates(query);
    for (const gb_arc &arc : arcs_of(query)) {
        const auto count = static_cast<std::size_t>(std::clamp(std::ceil(arc.length / step) + 1.0, 2.0, MOST_SAMPLES));
        const auto points = std::make_unique<double[][GB_MOST_ARM_JOINTS]>(count);
        arm_arc_sample(query.target.data(), query.limits.data(), &arc, points.get(), count);
        for (std::size_t k = 0; k < count; k++) {
            candidates.add(points[k]);
        }
    }
    return candidates.sorted();
}

#else

bool is_redundant()
{
    return false;
}

std::vector<Values> solutions(const Query &query)
{
    Candidates candidates(query);
    arm_solution list[ARM_CAPACITY];
    const int count = arm_solve_within(query.target.data(), query.limits.data(), list);
    for (int k = 0; k < count; k++) {
        candidates.add(list[k].q);
    }
    if (arm_nearest_to(query.target.data(), query.seed.data(), candidates.weights(), query.limits.data(), list) == 1) {
        candidates.add(list[0].q);
    }
    return candidates.sorted();
}

std::vector<Values> samples(const Query &, double)
{
    return {};
}

#endif

} // namespace groebot_arm
