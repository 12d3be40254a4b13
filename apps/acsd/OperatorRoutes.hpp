#pragma once

#include "common/HttpRoutes.hpp"
#include <acs/plan/PlanEngine.hpp>

#include <functional>

namespace ACS::Acsd
{

/// Takes what an operator asks of the engine; false where nothing is taken any more, as acsd stops.
using OperatorHandler = std::function<bool(Planning::PlanCommand command)>;

/// What an operator may ask of acsd, each by a POST. The answers are JSON: 202 with a message where the command was
/// handed on (it may still wait for the store; /status tells what came of it), else an error in a
/// sentence: 404 for what is not there, 409 for what is but not so, 503 where acsd stops. The engine must outlive the routes.
void AddOperatorRoutes(Apps::HttpRoutes& routes, const Planning::PlanEngine& engine, OperatorHandler handler);

} // namespace ACS::Acsd
