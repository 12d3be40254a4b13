#pragma once

#include <acs/core/Now.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace ACS::Acsd
{

/// An active alarm, as the operator sees it.
struct AlarmView
{
    std::string robotID; ///< "ACS" for acsd itself.
    std::string errorCode;
    std::string level;
    std::string title;
    std::string message;
    std::string cause;
    std::string remedy;
    Core::WallTime since; ///< At the earliest the start of acsd.
    std::optional<std::string> planID;
    std::optional<std::int32_t> stepNo;
    std::optional<std::string> jobID;

    bool operator==(const AlarmView&) const = default;
};

} // namespace ACS::Acsd
