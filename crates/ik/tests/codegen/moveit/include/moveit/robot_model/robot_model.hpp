// A replacement of the header of MoveIt 2, as far as the example uses it: a robot with one group.
#pragma once

#include "moveit/robot_model/joint_model_group.hpp"

namespace moveit::core
{

class RobotModel
{
public:
    RobotModel(std::string group_name, JointModelGroup group) : group_name_(std::move(group_name)), group_(std::move(group))
    {
    }

    const JointModelGroup *getJointModelGroup(const std::string &name) const
    {
        return name == group_name_ ? &group_ : nullptr;
    }

    const VariableBounds &getVariableBounds(const std::string &variable) const
    {
        return group_.getVariableBounds(variable);
    }

private:
    std::string group_name_;
    JointModelGroup group_;
};

} // namespace moveit::core
