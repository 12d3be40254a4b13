#pragma once

#include "common/http/HttpRoutes.hpp"
#include <acs/plan/PlanEngine.hpp>

#include <functional>
#include <optional>
#include <string>

namespace ACS::Acsd
{

/// What the routes need of acsd.
struct OperatorAccess
{
    /// Takes what an operator asks of the engine; false where nothing is taken any more, as acsd stops.
    std::function<bool(Planning::PlanCommand command)> take;
    /// Why nothing can be stored at present, as the middle of a sentence.
    std::function<std::optional<std::string>()> getStoreObstacleOrNull;
};

/// What an operator may ask of acsd, each by a POST. The answers are JSON: 202 with a message where the command was
/// handed on (it may still wait for the store; /status tells what came of it), else an error in a
/// sentence: 400 for a parameter that is missing, unknown or wrong, 404 for what is not there, 409 for what is but not so, 503 where acsd stops or nothing can be stored, as a
/// crash would forget what was promised. What only takes work away (maintenance on, the TSC's pause) is taken then too,
/// and the message says that it is not stored. The engine must outlive the routes.
void AddOperatorRoutes(Apps::HttpRoutes& routes, const Planning::PlanEngine& engine, const OperatorAccess& access);

} // namespace ACS::Acsd
