#include "replay/RunTrace.hpp"

#include "replay/RecordedConfig.hpp"
#include "replay/RecordLine.hpp"

#include <string>

namespace ACS::Acsd
{

namespace
{

/// A decision of the engine. Later messages of the robot belong to its plan.
void AddToTrace(const ChangeEntry& entry, MessageTrace& trace)
{
    trace.Add(
        {"engine",
         ProtocolBeast::EWireDirection::Out,
         entry.robotID,
         {},
         entry.text,
         entry.kind,
         entry.planID,
         entry.transactionID},
        ETraceUse::All);
    // The first order of a plan is sent before the plan has changed: then only the robot shows the plan.
    const bool bStart = entry.kind == "robot" && !entry.planID.empty();
    if ((bStart || entry.kind == "plan" || entry.kind == "step") && !entry.robotID.empty())
    {
        const std::string_view planID = entry.endedPlanOrNull != nullptr ? std::string_view() : entry.planID;
        trace.SetPlan(std::string(entry.robotID), std::string(planID));
    }
}

} // namespace

RunTrace::RunTrace(MessageTrace* traceOrNull, const AcsdConfig& config, Core::Now now)
    : _observer([traceOrNull](const ChangeEntry& entry, Core::Now /*now*/) {
          if (traceOrNull != nullptr)
          {
              AddToTrace(entry, *traceOrNull);
          }
      })
{
    if (traceOrNull != nullptr)
    {
        WriteRecord(MakeBeginRecord(config, now), *traceOrNull);
        _recorder = std::make_unique<CoreRecorder>(
            [traceOrNull](const CoreRecord& record) { WriteRecord(record, *traceOrNull); });
    }
}

AcsdCore::Dependencies RunTrace::Wrap(const AcsdCore::Dependencies& real)
{
    return _recorder == nullptr ? real : _recorder->Wrap(real);
}

Planning::IPlanObserver& RunTrace::GetObserver() noexcept
{
    return _observer;
}

} // namespace ACS::Acsd
