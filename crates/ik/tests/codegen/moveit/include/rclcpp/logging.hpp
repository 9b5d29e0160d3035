// A replacement of the header of ROS 2, as far as the example uses it.
#pragma once

#include <cstdio>

#include "rclcpp/logger.hpp"

#define RCLCPP_ERROR(logger, ...) (std::fprintf(stderr, "%s: ", (logger).get_name()), std::fprintf(stderr, __VA_ARGS__), std::fputc('\n', stderr))
