#pragma once

#include <string_view>

/// The version of the SDK, for the preprocessor. Semantic versioning; before 1.0 a minor version may break a user's code.
#define ACS_VERSION_MAJOR 0
/// Raised by a new feature.
#define ACS_VERSION_MINOR 1
/// Raised by a correction.
#define ACS_VERSION_PATCH 0

namespace ACS::Core
{

/// The same as "MAJOR.MINOR.PATCH".
constexpr std::string_view SDK_VERSION = "0.1.0";

} // namespace ACS::Core
