#include "replay/RunTrace.hpp"

#include "replay/RecordedConfig.hpp"
#include "replay/RecordLine.hpp"

namespace ACS::Acsd
{

RunTrace::RunTrace(MessageTrace* traceOrNull, const AcsdConfig& config, Core::Now now, Planning::IPlanObserver& next)
    : _observer(traceOrNull, next)
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
