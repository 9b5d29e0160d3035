// A replacement of the header of MoveIt 2: the virtual functions of an inverse kinematics plugin with MoveIt's signatures, and the members that the example
// uses. MoveIt's own functions are reduced to what they do for one tip.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "geometry_msgs/msg/pose.hpp"
#include "moveit_msgs/msg/move_it_error_codes.hpp"
#include "rclcpp/node.hpp"

namespace moveit::core
{

class JointModelGroup;
class RobotModel;
class RobotState;

} // namespace moveit::core

namespace kinematics
{

namespace DiscretizationMethods
{
enum DiscretizationMethod { NO_DISCRETIZATION = 1, ALL_DISCRETIZED, SOME_DISCRETIZED, ALL_RANDOM_SAMPLED, SOME_RANDOM_SAMPLED };
}
using DiscretizationMethod = DiscretizationMethods::DiscretizationMethod;

namespace KinematicErrors
{
enum KinematicError {
    OK = 1,
    UNSUPORTED_DISCRETIZATION_REQUESTED,
    DISCRETIZATION_NOT_INITIALIZED,
    MULTIPLE_TIPS_NOT_SUPPORTED,
    EMPTY_TIP_POSES,
    IK_SEED_OUTSIDE_LIMITS,
    SOLVER_NOT_ACTIVE,
    NO_SOLUTION
};
}
using KinematicError = KinematicErrors::KinematicError;

struct KinematicsQueryOptions
{
    KinematicsQueryOptions()
    {
    }

    bool lock_redundant_joints = false;
    bool return_approximate_solution = false;
    DiscretizationMethod discretization_method = DiscretizationMethods::NO_DISCRETIZATION;
};

struct KinematicsResult
{
    KinematicError kinematic_error;
    double solution_percentage;
};

class KinematicsBase
{
public:
    static constexpr double DEFAULT_SEARCH_DISCRETIZATION = 0.1;
    static constexpr double DEFAULT_TIMEOUT = 1.0;

    using Pose = geometry_msgs::msg::Pose;
    using Codes = moveit_msgs::msg::MoveItErrorCodes;
    using Options = KinematicsQueryOptions;
    using Values = std::vector<double>;
    using IKCallbackFn = std::function<void(const Pose &, const Values &, Codes &)>;
    using IKCostFn =
        std::function<double(const Pose &, const moveit::core::RobotState &, const moveit::core::JointModelGroup *, const Values &)>;

    virtual ~KinematicsBase() = default;

    virtual bool getPositionIK(const Pose &, const Values &, Values &, Codes &, const Options & = Options()) const = 0;

    virtual bool getPositionIK(const std::vector<Pose> &, const Values &, std::vector<Values> &, KinematicsResult &, const Options &) const
    {
        return false;
    }

    virtual bool searchPositionIK(const Pose &, const Values &, double, Values &, Codes &, const Options & = Options()) const = 0;

    virtual bool searchPositionIK(const Pose &, const Values &, double, const Values &, Values &, Codes &, const Options & = Options()) const = 0;

    virtual bool searchPositionIK(const Pose &, const Values &, double, Values &, const IKCallbackFn &, Codes &, const Options & = Options()) const = 0;

    virtual bool searchPositionIK(const Pose &, const Values &, double, const Values &, Values &, const IKCallbackFn &, Codes &,
                                  const Options & = Options()) const = 0;

    virtual bool searchPositionIK(const std::vector<Pose> &poses, const Values &seed, double timeout, const Values &consistency_limits, Values &solution,
                                  const IKCallbackFn &callback, Codes &code, const Options &options = Options(),
                                  const moveit::core::RobotState * = nullptr) const
    {
        return poses.size() == 1 && searchPositionIK(poses[0], seed, timeout, consistency_limits, solution, callback, code, options);
    }

    virtual bool searchPositionIK(const std::vector<Pose> &poses, const Values &seed, double timeout, const Values &consistency_limits, Values &solution,
                                  const IKCallbackFn &callback, const IKCostFn &cost, Codes &code, const Options &options = Options(),
                                  const moveit::core::RobotState *context = nullptr) const
    {
        return !cost && searchPositionIK(poses, seed, timeout, consistency_limits, solution, callback, code, options, context);
    }

    virtual bool getPositionFK(const std::vector<std::string> &, const Values &, std::vector<Pose> &) const = 0;

    virtual bool initialize(const rclcpp::Node::SharedPtr &, const moveit::core::RobotModel &, const std::string &, const std::string &,
                            const std::vector<std::string> &, double)
    {
        return false;
    }

    virtual bool setRedundantJoints(const std::vector<unsigned int> &joints)
    {
        redundant_joint_indices_ = joints;
        return true;
    }

    virtual const std::vector<std::string> &getJointNames() const = 0;

    virtual const std::vector<std::string> &getLinkNames() const = 0;

protected:
    void storeValues(const moveit::core::RobotModel &, const std::string &group_name, const std::string &base_frame,
                     const std::vector<std::string> &tip_frames, double)
    {
        group_name_ = group_name;
        base_frame_ = base_frame;
        tip_frames_ = tip_frames;
    }

    rclcpp::Node::SharedPtr node_;
    std::string group_name_;
    std::string base_frame_;
    std::vector<std::string> tip_frames_;
    double default_timeout_ = DEFAULT_TIMEOUT;
    std::vector<unsigned int> redundant_joint_indices_;
    std::vector<DiscretizationMethod> supported_methods_{DiscretizationMethods::NO_DISCRETIZATION};
};

} // namespace kinematics
