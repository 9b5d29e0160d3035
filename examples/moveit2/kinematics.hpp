// Inverse kinematics of a generated solver as a plugin of MoveIt 2. Poses are those of the tip link in the base link: metres, quaternions x, y, z, w.
#pragma once

#include <string>
#include <vector>

#if __has_include(<moveit/kinematics_base/kinematics_base.hpp>)
#include <moveit/kinematics_base/kinematics_base.hpp>
#else
#include <moveit/kinematics_base/kinematics_base.h>
#endif

#include "solver.hpp"

namespace groebot_arm
{

class Kinematics : public kinematics::KinematicsBase
{
public:
    using Pose = geometry_msgs::msg::Pose;
    using ErrorCodes = moveit_msgs::msg::MoveItErrorCodes;
    using Options = kinematics::KinematicsQueryOptions;

    // MoveIt's own overloads for several tips call the ones below if there is one tip.
    using KinematicsBase::searchPositionIK;

    // Refuses a group without the joints of the arm, and links other than GROEBOT_BASE and GROEBOT_TIP. Limits are the described ones, narrowed by those of
    // the robot model. search_discretization is the distance (rad) of samples along arcs.
    bool initialize(const rclcpp::Node::SharedPtr &node, const moveit::core::RobotModel &robot_model, const std::string &group_name,
                    const std::string &base_frame, const std::vector<std::string> &tip_frames, double search_discretization) override;

    // The solution nearest to the seed.
    bool getPositionIK(const Pose &ik_pose, const std::vector<double> &ik_seed_state, std::vector<double> &solution, ErrorCodes &error_code,
                       const Options &options = Options()) const override;

    // All solutions of an arm of six joints. Of a redundant arm, the local minima of the distance to the seed; with ALL_DISCRETIZED, samples of all arcs.
    bool getPositionIK(const std::vector<Pose> &ik_poses, const std::vector<double> &ik_seed_state, std::vector<std::vector<double>> &solutions,
                       kinematics::KinematicsResult &result, const Options &options) const override;

    bool searchPositionIK(const Pose &ik_pose, const std::vector<double> &ik_seed_state, double timeout, std::vector<double> &solution,
                          ErrorCodes &error_code, const Options &options = Options()) const override;

    bool searchPositionIK(const Pose &ik_pose, const std::vector<double> &ik_seed_state, double timeout, const std::vector<double> &consistency_limits,
                          std::vector<double> &solution, ErrorCodes &error_code, const Options &options = Options()) const override;

    bool searchPositionIK(const Pose &ik_pose, const std::vector<double> &ik_seed_state, double timeout, std::vector<double> &solution,
                          const IKCallbackFn &solution_callback, ErrorCodes &error_code, const Options &options = Options()) const override;

    bool searchPositionIK(const Pose &ik_pose, const std::vector<double> &ik_seed_state, double timeout, const std::vector<double> &consistency_limits,
                          std::vector<double> &solution, const IKCallbackFn &solution_callback, ErrorCodes &error_code,
                          const Options &options = Options()) const override;

    // The pose of the tip link. Other links are refused.
    bool getPositionFK(const std::vector<std::string> &link_names, const std::vector<double> &joint_angles, std::vector<Pose> &poses) const override;

    const std::vector<std::string> &getJointNames() const override;

    // The tip link.
    const std::vector<std::string> &getLinkNames() const override;

private:
    struct Request;

    bool search(const Request &request, std::vector<double> &solution, ErrorCodes &error_code) const;
    bool narrow(Query &query, const std::vector<double> &consistency_limits, bool locks_redundant_joints) const;

    std::vector<std::string> joint_names_;
    Values limits_;
    double step_ = DEFAULT_SEARCH_DISCRETIZATION;
};

} // namespace groebot_arm
