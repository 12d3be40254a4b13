#pragma once

#include "robots/ArmRelay.hpp"
#include <acs/plan/RobotCommand.hpp>

#include <tl/expected.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// A value that a program finds in a relay when it starts.
struct ArmInput
{
    ArmRelay relay;
    std::int32_t value = 0; ///< CanHold returns whether the relay is wide enough.

    bool operator==(const ArmInput&) const = default;
};

/// The inputs of a job's program, in the order in which they are written; or why they cannot be derived from the job, which
/// then fails with that reason. Empty where the action has none.
using ArmInputResolver = std::function<tl::expected<std::vector<ArmInput>, std::string>(const Planning::StartJob& job)>;

} // namespace ACS::Acsd
