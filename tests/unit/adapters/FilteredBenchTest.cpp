// That the benches of the SDK's adapters find something: the same adapters with one defect each.

#include "FilteredBench.hpp"

#include "ArmBench.hpp"
#include "CartBench.hpp"
#include "Catch.hpp"
#include "VehicleBench.hpp"
#include <acs/adapter_test/CheckAdapter.hpp>

#include <utility>
#include <variant>

namespace ACS::Testing
{

namespace
{

using AdapterTest::ERule;
using Planning::RobotEvent;

RobotEvent HideHeldNodes(const RobotEvent& event)
{
    RobotEvent changed = event;
    if (auto* const stateOrNull = std::get_if<Planning::StateChanged>(&changed))
    {
        stateOrNull->heldNodeIDs.clear();
    }
    return changed;
}

RobotEvent HidePause(const RobotEvent& event)
{
    RobotEvent changed = event;
    if (auto* const stateOrNull = std::get_if<Planning::StateChanged>(&changed))
    {
        stateOrNull->bPaused = false;
    }
    return changed;
}

/// Nothing is known to be not done.
RobotEvent ReportUnknownAsFinished(const RobotEvent& event)
{
    const auto* const unknownOrNull = std::get_if<Planning::JobUnknown>(&event);
    return unknownOrNull == nullptr ? event : RobotEvent(Planning::JobFinished{unknownOrNull->jobID});
}

RobotEvent ReportStartedAsFinished(const RobotEvent& event)
{
    const auto* const startedOrNull = std::get_if<Planning::JobStarted>(&event);
    return startedOrNull == nullptr ? event : RobotEvent(Planning::JobFinished{startedOrNull->jobID});
}

bool IsFound(AdapterTest::IAdapterBench& bench, FilteredBench::Change change, ERule rule)
{
    FilteredBench filtered(bench, std::move(change));
    return AdapterTest::CheckAdapter(filtered).HasFinding(rule);
}

} // namespace

TEST_CASE("Defects of a vehicle's adapter are found", "[.long]")
{
    VehicleBench bench(VehicleBench::ELink::OfAdapter);
    CHECK(IsFound(bench, HideHeldNodes, ERule::HeldNodes));
    CHECK(IsFound(bench, HidePause, ERule::PauseObeyed));
    CHECK(IsFound(bench, ReportUnknownAsFinished, ERule::OutcomeTrue));
    CHECK(IsFound(bench, ReportStartedAsFinished, ERule::OneEnd));
}

TEST_CASE("A defect of an arm's adapter is found")
{
    ArmBench bench(1);
    CHECK(IsFound(bench, ReportStartedAsFinished, ERule::OutcomeTrue));
}

TEST_CASE("Defects of the cart's adapter are found")
{
    CartBench bench;
    CHECK(IsFound(bench, HideHeldNodes, ERule::HeldNodes));
    CHECK(IsFound(bench, ReportUnknownAsFinished, ERule::OutcomeTrue));
}

} // namespace ACS::Testing
