#include "EngineControl.hpp"

#include <utility>

namespace ACS::Testing
{

using namespace Planning; // NOLINT(google-build-using-namespace): a test of that namespace

namespace
{

EngineOptions MakeOptions(const Floor& floor, std::size_t vehicles, std::chrono::milliseconds overtaking)
{
    EngineOptions options = MakeEngineOptions(floor, vehicles);
    options.queueOvertaking = overtaking;
    return options;
}

} // namespace

EngineControl::EngineControl(const Floor& floor, std::size_t vehicles, std::chrono::milliseconds overtaking)
    : _engine(MakeOptions(floor, vehicles, overtaking), floor.site, _random)
{
}

void EngineControl::Submit(Plan plan, std::uint64_t number, Core::Now now, EngineActions& out)
{
    _engine.Handle(SubmitPlan{std::move(plan), number}, now, out);
}

void EngineControl::OnEvent(const std::string& robotID, const RobotEvent& event, Core::Now now, EngineActions& out)
{
    _engine.Handle(robotID, event, now, out);
}

void EngineControl::OnTimer(const EngineTimer& timer, Core::Now now, EngineActions& out)
{
    _engine.OnTimer(timer, now, out);
}

void EngineControl::OnStored(Core::Now now, EngineActions& out)
{
    _engine.OnStored({}, now, out);
}

void EngineControl::OnReportSent(std::uint64_t sequence, Core::Now now, EngineActions& out)
{
    _engine.Handle(MessageAcknowledged{sequence}, now, out);
}

std::optional<std::string> EngineControl::GetRobotIDOrNull(const std::string& planID) const
{
    const std::optional<PlanSummary> plan = _engine.GetPlanOrNull(planID);
    return plan.has_value() ? plan->robotID : std::nullopt;
}

} // namespace ACS::Testing
