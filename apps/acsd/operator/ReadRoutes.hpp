#pragma once

#include "common/http/HttpRoutes.hpp"
#include "view/StateView.hpp"
#include <acs/core/Now.hpp>
#include <acs/plan/PlanEngine.hpp>

#include <cstdint>
#include <functional>

namespace ACS::Acsd
{

/// What the routes that read show besides the engine's own state.
struct ReadAccess
{
    const Core::IClock& clock;
    /// The present state; valid until the next call.
    std::function<const StateView&()> getState;
    /// The present state, all of whose changes are events; valid until the next call.
    std::function<const StateView&()> getPublished;
    /// Number of the last event that contributed to the published state.
    std::function<std::uint64_t()> getEventID;
};

/// The part of the operator API that reads state, as JSON: status, snapshot, plans, robots, alarms, links, queue, site
/// (docs/reference/openapi.json). The engine and the clock must outlive the routes.
void AddReadRoutes(Apps::HttpRoutes& routes, const Planning::PlanEngine& engine, const ReadAccess& access);

} // namespace ACS::Acsd
