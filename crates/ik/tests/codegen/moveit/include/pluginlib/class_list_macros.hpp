// A replacement of the header of ROS 2: the plugin must be complete and derived from its base. Nothing is registered.
#pragma once

#include <type_traits>

#define PLUGINLIB_EXPORT_CLASS(type, base) static_assert(std::is_default_constructible_v<type> && std::is_base_of_v<base, type>, "a plugin");
