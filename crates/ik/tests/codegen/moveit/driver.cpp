// Calls the plugin like MoveIt does, through its base class.
//
// Reads the limits of the robot model (least and greatest value of each joint), then searches: a pose (x, y, z, then the quaternion x, y, z, w), a seed,
// the consistency limit of all joints (negative: none), how many candidates the callback refuses (negative: no callback), the timeout (s), and the joint to
// be locked (negative: none).
//
// Prints for each search lines of a name and numbers: "candidate" for each call of the callback, "solution", the "tip" at the solution, then "code", and with
// neither consistency limits nor a locked joint also "all" for each solution of getPositionIK, and "sample" for each with discretization.
#include <cstdio>

#include "kinematics.hpp"

#include <moveit/robot_model/robot_model.hpp>

using kinematics::KinematicsBase;
using Pose = geometry_msgs::msg::Pose;
using Codes = moveit_msgs::msg::MoveItErrorCodes;
using Values = std::vector<double>;

static bool read(Values &numbers)
{
    for (double &number : numbers) {
        if (std::scanf("%lf", &number) != 1) {
            return false;
        }
    }
    return true;
}

static void print(const char *name, const Values &numbers)
{
    std::printf("%s", name);
    for (const double number : numbers) {
        std::printf(" %.17g", number);
    }
    std::printf("\n");
}

// A robot model with the joints of the plugin.
static moveit::core::RobotModel model(const std::vector<std::string> &joints, const Values &limits)
{
    std::map<std::string, moveit::core::VariableBounds> bounds;
    for (std::size_t i = 0; i < joints.size(); i++) {
        bounds[joints[i]] = {limits[2 * i], limits[2 * i + 1], true};
    }
    return moveit::core::RobotModel("arm", moveit::core::JointModelGroup(bounds));
}

static Pose pose_of(const Values &row)
{
    Pose pose;
    pose.position = {row[0], row[1], row[2]};
    pose.orientation = {row[3], row[4], row[5], row[6]};
    return pose;
}

static void all(const KinematicsBase &plugin, const Pose &pose, const Values &seed)
{
    kinematics::KinematicsQueryOptions options;
    kinematics::KinematicsResult result;
    std::vector<Values> list;
    plugin.getPositionIK(std::vector<Pose>{pose}, seed, list, result, options);
    for (const Values &one : list) {
        print("all", one);
    }
    options.discretization_method = kinematics::DiscretizationMethods::ALL_DISCRETIZED;
    list.clear();
    plugin.getPositionIK(std::vector<Pose>{pose}, seed, list, result, options);
    for (const Values &one : list) {
        print("sample", one);
    }
}

// The overload of MoveIt's interface that has these arguments.
static bool search(const KinematicsBase &plugin, const Values &row, const Values &seed, Values &solution, Codes &code)
{
    const Pose pose = pose_of(row);
    const double *options = row.data() + 7 + seed.size(), timeout = options[2];
    const Values near(options[0] < 0.0 ? 0 : seed.size(), options[0]);
    double refused = options[1];
    const KinematicsBase::IKCallbackFn callback = [&refused](const Pose &, const Values &candidate, Codes &answer) {
        print("candidate", candidate);
        answer.val = refused-- > 0.0 ? Codes::NO_IK_SOLUTION : Codes::SUCCESS;
    };
    kinematics::KinematicsQueryOptions query;
    query.lock_redundant_joints = options[3] >= 0.0;
    if (options[1] < 0.0) {
        return near.empty() ? plugin.searchPositionIK(pose, seed, timeout, solution, code, query)
                            : plugin.searchPositionIK(pose, seed, timeout, near, solution, code, query);
    }
    return near.empty() ? plugin.searchPositionIK(pose, seed, timeout, solution, callback, code, query)
                        : plugin.searchPositionIK(std::vector<Pose>{pose}, seed, timeout, near, solution, callback, code, query);
}

int main()
{
    groebot_arm::Kinematics kinematics;
    const std::vector<std::string> joints = groebot_arm::joint_names();
    Values limits(2 * joints.size()), row(7 + joints.size() + 4);
    if (!read(limits)) {
        return 1;
    }
    const moveit::core::RobotModel robot = model(joints, limits), other = model({"other"}, limits);
    const auto starts = [](const moveit::core::RobotModel &model, const char *base, const char *tip) {
        return groebot_arm::Kinematics().initialize(nullptr, model, "arm", base, {tip}, 0.1);
    };
    if (starts(robot, GROEBOT_TIP, GROEBOT_BASE) || starts(other, GROEBOT_BASE, GROEBOT_TIP)
        || !kinematics.initialize(nullptr, robot, "arm", GROEBOT_BASE, {GROEBOT_TIP}, 0.1)) {
        return 2;
    }
    KinematicsBase &plugin = kinematics;
    while (read(row)) {
        const Values seed(row.begin() + 7, row.begin() + 7 + static_cast<std::ptrdiff_t>(joints.size()));
        const bool is_locked = row.back() >= 0.0, is_near = row[7 + joints.size()] >= 0.0;
        plugin.setRedundantJoints(is_locked ? std::vector<unsigned int>{static_cast<unsigned int>(row.back())} : std::vector<unsigned int>{});
        Values solution;
        Codes code;
        if (search(plugin, row, seed, solution, code)) {
            std::vector<Pose> tip;
            plugin.getPositionFK(plugin.getLinkNames(), solution, tip);
            const auto &[p, r] = tip.at(0);
            print("solution", solution);
            print("tip", {p.x, p.y, p.z, r.x, r.y, r.z, r.w});
        }
        if (!is_locked && !is_near) {
            all(plugin, pose_of(row), seed);
        }
        print("code", {static_cast<double>(code.val)});
    }
    return 0;
}
