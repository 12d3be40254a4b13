#pragma once

#include "api/ApiTypes.hpp"
#include "commands/Answers.hpp"
#include "commands/CommandError.hpp"
#include "commands/Session.hpp"
#include "options/AcsctlOptions.hpp"

#include <chrono>
#include <string>

namespace ACS::Acsctl
{

/// Maximum time to wait for the outcome of an instant action.
constexpr std::chrono::seconds ACTION_LIMIT{60};

/// The body of the request: a value of a parameter that the robot offers as STRING is a string. Any other value is JSON if it is valid
/// JSON, otherwise a string.
[[nodiscard]] Outcome<std::string> MakeActionBody(const CommandArguments& arguments, const ActionsAnswer& offered);

/// Sends an instant action and waits for its outcome, unless that is not wanted. The exit code is EXIT_ATTENTION if the action is not
/// Finished in time.
[[nodiscard]] Outcome<Shown> RunAction(
    Session& session,
    const AcsctlOptions& options,
    const std::string& idempotencyKey);

} // namespace ACS::Acsctl
