// A replacement of the header of MoveIt 2, as far as the example uses it.
#pragma once

#include <map>
#include <string>

namespace moveit::core
{

struct VariableBounds
{
    double min_position_ = 0.0;
    double max_position_ = 0.0;
    bool position_bounded_ = false;
};

class JointModelGroup
{
public:
    explicit JointModelGroup(std::map<std::string, VariableBounds> bounds) : bounds_(std::move(bounds))
    {
    }

    bool hasJointModel(const std::string &joint) const
    {
        return bounds_.count(joint) > 0;
    }

    const VariableBounds &getVariableBounds(const std::string &variable) const
    {
        return bounds_.at(variable);
    }

private:
    std::map<std::string, VariableBounds> bounds_;
};

} // namespace moveit::core
