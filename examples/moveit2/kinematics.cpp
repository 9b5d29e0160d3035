#include "kinematics.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <pluginlib/class_list_macros.hpp>
#include <rclcpp/logger.hpp>
#include <rclcpp/logging.hpp>

#if __has_include(<moveit/robot_model/robot_model.hpp>)
#include <moveit/robot_model/joint_model_group.hpp>
#include <moveit/robot_model/robot_model.hpp>
#else
#include <moveit/robot_model/joint_model_group.h>
#include <moveit/robot_model/robot_model.h>
#endif

namespace groebot_arm
{
namespace
{

rclcpp::Logger logger()
{
    return rclcpp::get_logger("groebot_arm");
}

// The quaternion may have any length but zero, whose target is not finite and has no solutions.
Target target_of(const geometry_msgs::msg::Pose &pose)
{
    const auto &p = pose.position;
    const auto &r = pose.orientation;
    const double s = 2.0 / (r.x * r.x + r.y * r.y + r.z * r.z + r.w * r.w);
    return {p.x,
            p.y,
            p.z,
            1.0 - s * (r.y * r.y + r.z * r.z),
            s * (r.x * r.y - r.z * r.w),
            s * (r.x * r.z + r.y * r.w),
            s * (r.x * r.y + r.z * r.w),
            1.0 - s * (r.x * r.x + r.z * r.z),
            s * (r.y * r.z - r.x * r.w),
            s * (r.x * r.z - r.y * r.w),
            s * (r.y * r.z + r.x * r.w),
            1.0 - s * (r.x * r.x + r.y * r.y)};
}

// Divides by the largest component of the quaternion (S. W. Shepperd, Journal of Guidance and Control 1 (1978) 223-224).
geometry_msgs::msg::Pose pose_of(const Target &target)
{
    const auto r = [&target](std::size_t row, std::size_t column) { return target[3 + 3 * row + column]; };
    const double trace = r(0, 0) + r(1, 1) + r(2, 2);
    std::array<double, 4> q; // x, y, z, w
    std::size_t i = 0;
    for (const std::size_t k : {1, 2}) {
        i = r(k, k) > r(i, i) ? k : i;
    }
    if (trace > r(i, i)) {
        q = {r(2, 1) - r(1, 2), r(0, 2) - r(2, 0), r(1, 0) - r(0, 1), 1.0 + trace};
    } else {
        const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
        q[i] = 1.0 + 2.0 * r(i, i) - trace;
        q[j] = r(j, i) + r(i, j);
        q[k] = r(k, i) + r(i, k);
        q[3] = r(k, j) - r(j, k);
    }
    const double length = std::hypot(std::hypot(q[0], q[1]), std::hypot(q[2], q[3]));
    geometry_msgs::msg::Pose pose;
    pose.position.x = target[0];
    pose.position.y = target[1];
    pose.position.z = target[2];
    pose.orientation.x = q[0] / length;
    pose.orientation.y = q[1] / length;
    pose.orientation.z = q[2] / length;
    pose.orientation.w = q[3] / length;
    return pose;
}

bool is_finite(const std::vector<double> &values)
{
    return std::all_of(values.begin(), values.end(), [](double value) { return std::isfinite(value); });
}

} // namespace

// The arguments of a search. Consistency limits may be empty, and so may the callback.
struct Kinematics::Request
{
    const Pose &pose;
    const std::vector<double> &seed;
    double timeout;
    const std::vector<double> &consistency_limits;
    const IKCallbackFn &callback;
    const Options &options;
};

bool Kinematics::initialize(const rclcpp::Node::SharedPtr &node, const moveit::core::RobotModel &robot_model, const std::string &group_name,
                            const std::string &base_frame, const std::vector<std::string> &tip_frames, double search_discretization)
{
    storeValues(robot_model, group_name, base_frame, tip_frames, search_discretization);
    node_ = node;
    joint_names_ = joint_names();
    limits_ = described_limits();
    step_ = search_discretization > 0.0 ? search_discretization : DEFAULT_SEARCH_DISCRETIZATION;
    if (is_redundant()) {
        supported_methods_.push_back(kinematics::DiscretizationMethods::ALL_DISCRETIZED);
    }
    if (base_frame_ != GROEBOT_BASE || tip_frames_ != std::vector<std::string>{GROEBOT_TIP}) {
        RCLCPP_ERROR(logger(), "the solver is for the tip link %s in %s; derive one for the links of group %s", GROEBOT_TIP, GROEBOT_BASE, group_name.c_str());
        return false;
    }
    const moveit::core::JointModelGroup *group = robot_model.getJointModelGroup(group_name);
    for (std::size_t i = 0; i < joint_names_.size(); i++) {
        if (!group || !group->hasJointModel(joint_names_[i])) {
            RCLCPP_ERROR(logger(), "group %s has no joint %s", group_name.c_str(), joint_names_[i].c_str());
            return false;
        }
        const moveit::core::VariableBounds &bounds = robot_model.getVariableBounds(joint_names_[i]);
        if (bounds.position_bounded_) {
            limits_[2 * i] = std::max(limits_[2 * i], bounds.min_position_);
            limits_[2 * i + 1] = std::min(limits_[2 * i + 1], bounds.max_position_);
        }
    }
    return true;
}

// Checks the seed, and sets the limits: those of the arm, and the consistency limits around the seed.
bool Kinematics::narrow(Query &query, const std::vector<double> &consistency_limits, bool locks_redundant_joints) const
{
    const std::size_t joints = joint_names_.size();
    query.limits = limits_;
    if (query.seed.size() != joints || !is_finite(query.seed) || (!consistency_limits.empty() && consistency_limits.size() != joints)) {
        RCLCPP_ERROR(logger(), "the seed and consistency limits have %zu finite numbers", joints);
        return false;
    }
    const auto keep_near = [&query](std::size_t joint, double distance) {
        query.limits[2 * joint] = std::max(query.limits[2 * joint], query.seed[joint] - distance);
        query.limits[2 * joint + 1] = std::min(query.limits[2 * joint + 1], query.seed[joint] + distance);
    };
    for (std::size_t i = 0; i < consistency_limits.size(); i++) {
        keep_near(i, consistency_limits[i]);
    }
    if (locks_redundant_joints) {
        for (const unsigned int joint : redundant_joint_indices_) {
            keep_near(joint, 0.0);
        }
    }
    for (std::size_t i = 0; i < joints; i++) {
        if (!(query.limits[2 * i] <= query.limits[2 * i + 1])) {
            return false;
        }
    }
    return true;
}

// Candidates are the solutions, then samples of arcs, each list by distance to the seed. The timeout is tested between candidates.
bool Kinematics::search(const Request &request, std::vector<double> &solution, ErrorCodes &error_code) const
{
    using Clock = std::chrono::steady_clock;
    const auto start = Clock::now();
    error_code.val = ErrorCodes::NO_IK_SOLUTION;
    Query query{target_of(request.pose), request.seed, {}};
    if (!narrow(query, request.consistency_limits, request.options.lock_redundant_joints)) {
        return false;
    }
    const std::vector<Values> nearest = solutions(query);
    for (const bool is_sampled : {false, true}) {
        if (nearest.empty()) {
            break;
        }
        for (const Values &candidate : is_sampled ? samples(query, step_) : nearest) {
            const auto is_tried = [&candidate](const Values &other) { return is_same(candidate, other); };
            if (is_sampled && std::any_of(nearest.begin(), nearest.end(), is_tried)) {
                continue;
            }
            error_code.val = ErrorCodes::SUCCESS;
            if (request.callback) {
                request.callback(request.pose, candidate, error_code);
            }
            if (error_code.val == ErrorCodes::SUCCESS) {
                solution = candidate;
                return true;
            }
            if (std::chrono::duration<double>(Clock::now() - start).count() >= request.timeout) {
                error_code.val = ErrorCodes::TIMED_OUT;
                return false;
            }
        }
    }
    error_code.val = ErrorCodes::NO_IK_SOLUTION;
    return false;
}

bool Kinematics::getPositionIK(const Pose &ik_pose, const std::vector<double> &ik_seed_state, std::vector<double> &solution, ErrorCodes &error_code,
                               const Options &options) const
{
    return search({ik_pose, ik_seed_state, default_timeout_, {}, {}, options}, solution, error_code);
}

bool Kinematics::getPositionIK(const std::vector<Pose> &ik_poses, const std::vector<double> &ik_seed_state, std::vector<std::vector<double>> &solutions,
                               kinematics::KinematicsResult &result, const Options &options) const
{
    using namespace kinematics;
    solutions.clear();
    result.solution_percentage = 0.0;
    const DiscretizationMethod method = options.discretization_method;
    if (ik_poses.size() != 1) {
        result.kinematic_error = ik_poses.empty() ? KinematicErrors::EMPTY_TIP_POSES : KinematicErrors::MULTIPLE_TIPS_NOT_SUPPORTED;
        return false;
    }
    if (std::find(supported_methods_.begin(), supported_methods_.end(), method) == supported_methods_.end()) {
        result.kinematic_error = KinematicErrors::UNSUPORTED_DISCRETIZATION_REQUESTED;
        return false;
    }
    Query query{target_of(ik_poses[0]), ik_seed_state, {}};
    if (narrow(query, {}, options.lock_redundant_joints)) {
        const bool is_sampled = method == DiscretizationMethods::ALL_DISCRETIZED;
        solutions = is_sampled ? samples(query, step_) : groebot_arm::solutions(query);
    }
    result.kinematic_error = solutions.empty() ? KinematicErrors::NO_SOLUTION : KinematicErrors::OK;
    result.solution_percentage = solutions.empty() ? 0.0 : 1.0;
    return !solutions.empty();
}

bool Kinematics::searchPositionIK(const Pose &ik_pose, const std::vector<double> &ik_seed_state, double timeout, std::vector<double> &solution,
                                  ErrorCodes &error_code, const Options &options) const
{
    return search({ik_pose, ik_seed_state, timeout, {}, {}, options}, solution, error_code);
}

bool Kinematics::searchPositionIK(const Pose &ik_pose, const std::vector<double> &ik_seed_state, double timeout,
                                  const std::vector<double> &consistency_limits, std::vector<double> &solution, ErrorCodes &error_code,
                                  const Options &options) const
{
    return search({ik_pose, ik_seed_state, timeout, consistency_limits, {}, options}, solution, error_code);
}

bool Kinematics::searchPositionIK(const Pose &ik_pose, const std::vector<double> &ik_seed_state, double timeout, std::vector<double> &solution,
                                  const IKCallbackFn &solution_callback, ErrorCodes &error_code, const Options &options) const
{
    return search({ik_pose, ik_seed_state, timeout, {}, solution_callback, options}, solution, error_code);
}

bool Kinematics::searchPositionIK(const Pose &ik_pose, const std::vector<double> &ik_seed_state, double timeout,
                                  const std::vector<double> &consistency_limits, std::vector<double> &solution, const IKCallbackFn &solution_callback,
                                  ErrorCodes &error_code, const Options &options) const
{
    return search({ik_pose, ik_seed_state, timeout, consistency_limits, solution_callback, options}, solution, error_code);
}

bool Kinematics::getPositionFK(const std::vector<std::string> &link_names, const std::vector<double> &joint_angles, std::vector<Pose> &poses) const
{
    if (link_names != tip_frames_ || joint_angles.size() != joint_names_.size()) {
        RCLCPP_ERROR(logger(), "forward kinematics is that of %s, with %zu joint values", GROEBOT_TIP, joint_names_.size());
        return false;
    }
    poses = {pose_of(forward(joint_angles))};
    return true;
}

const std::vector<std::string> &Kinematics::getJointNames() const
{
    return joint_names_;
}

const std::vector<std::string> &Kinematics::getLinkNames() const
{
    return tip_frames_;
}

} // namespace groebot_arm

PLUGINLIB_EXPORT_CLASS(groebot_arm::Kinematics, kinematics::KinematicsBase)
