// A replacement of the header of ROS 2, as far as the example uses it.
#pragma once

#include <memory>

namespace rclcpp
{

class Node
{
public:
    using SharedPtr = std::shared_ptr<Node>;
};

} // namespace rclcpp
