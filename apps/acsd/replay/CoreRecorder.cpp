#include "replay/CoreRecorder.hpp"

#include "replay/InputCodec.hpp"
#include "replay/JobCheckText.hpp"
#include "replay/OutputText.hpp"
#include "replay/RecordKind.hpp"
#include "replay/TimerText.hpp"
#include <acs/plan/IJobCheck.hpp>

#include <fmt/format.h>

#include <chrono>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <variant>

namespace ACS::Acsd
{

namespace
{

/// The precision of a line of the trace.
Core::Now Round(Core::Now now)
{
    return {
        std::chrono::floor<std::chrono::microseconds>(now.steady),
        std::chrono::floor<std::chrono::milliseconds>(now.wall)};
}

Protocol::AcsRequest MakeUnnumbered(Protocol::AcsPayload payload)
{
    return {{}, {}, std::move(payload)};
}

} // namespace

/// Records what a job check rejects, each job once: the answers do not change.
class CoreRecorder::WatchedCheck final : public Planning::IJobCheck
{
    /// More are recorded again: the memory stays bounded.
    static constexpr std::size_t MOST_JOBS = 1'000;

    const CoreRecorder& _recorder;
    const std::string _robotID;
    const std::shared_ptr<const IJobCheck> _real;
    mutable std::set<std::string> _rejected;

public:
    WatchedCheck(const CoreRecorder& recorder, std::string robotID, std::shared_ptr<const IJobCheck> real)
        : _recorder(recorder),
          _robotID(std::move(robotID)),
          _real(std::move(real))
    {
    }

    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const Planning::StartJob& job) const override
    {
        std::optional<std::string> reason = _real->GetRejectionReasonOrNull(job);
        if (reason.has_value() && _recorder._depth > 0) // else asked by a view, which the replay does not have
        {
            CoreRecord record = EncodeRejection({_robotID, EncodeJob(job), *reason});
            record.planID = job.planID;
            if (_rejected.size() >= MOST_JOBS)
            {
                _rejected.clear();
            }
            if (_rejected.insert(record.text).second)
            {
                _recorder.Emit(std::move(record));
            }
        }
        return reason;
    }
};

CoreRecorder::CoreRecorder(RecordHandler handler)
    : _handler(std::move(handler))
{
}

AcsdCore::Dependencies CoreRecorder::Wrap(const AcsdCore::Dependencies& real)
{
    _real.emplace(real);
    return {*this, *this, real.logger, *this, *this, real.filter, this};
}

void CoreRecorder::Stop()
{
    FlushDrawn();
    _bStopped = true;
}

const std::map<AcsdTimer, Core::SteadyTime>& CoreRecorder::GetTimers() const noexcept
{
    return _timers;
}

void CoreRecorder::BeginInput(const CoreInput& input)
{
    if (_depth == 0)
    {
        _now = Round(_real->clock.GetNow());
    }
    CoreRecord record = EncodeInput(input);
    record.depth = _depth++;
    if (const auto* const timerOrNull = std::get_if<AcsdTimer>(&input))
    {
        const auto running = _timers.find(*timerOrNull);
        record.text =
            EncodeTimer(*timerOrNull, running == _timers.end() ? std::nullopt : std::optional(running->second));
        _timers.erase(*timerOrNull);
    }
    Emit(std::move(record));
}

void CoreRecorder::EndInput()
{
    if (--_depth == 0)
    {
        FlushDrawn();
    }
}

Planning::RobotEvent CoreRecorder::Watch(const std::string& robotID, const Planning::RobotEvent& event)
{
    const auto* const changedOrNull = std::get_if<Planning::JobCheckChanged>(&event);
    if (changedOrNull == nullptr || changedOrNull->jobCheck == nullptr)
    {
        return event;
    }
    return Planning::JobCheckChanged{std::make_shared<WatchedCheck>(*this, robotID, changedOrNull->jobCheck)};
}

void CoreRecorder::Emit(CoreRecord record) const
{
    if (!_bStopped)
    {
        record.now = _now;
        _handler(record);
    }
}

void CoreRecorder::Emit(std::string_view kind) const
{
    CoreRecord record;
    record.kind = kind;
    Emit(std::move(record));
}

void CoreRecorder::FlushDrawn()
{
    if (_drawn.empty())
    {
        return;
    }
    CoreRecord record;
    record.kind = RANDOM_KIND;
    record.text = fmt::format("{:x}", fmt::join(std::exchange(_drawn, {}), " "));
    Emit(std::move(record));
}

Core::Now CoreRecorder::GetNow() const
{
    return _depth > 0 ? _now : Round(_real->clock.GetNow());
}

std::uint64_t CoreRecorder::GetNext()
{
    return _drawn.emplace_back(_real->random.GetNext());
}

void CoreRecorder::Store(const Planning::StoreBatch& batch)
{
    Emit(EncodeTransaction(batch));
    _real->output.Store(batch);
}

void CoreRecorder::CheckStore()
{
    _real->output.CheckStore();
}

void CoreRecorder::CommandRobot(const Planning::CommandRobot& command)
{
    Emit(EncodeRobotCommand(command));
    _real->output.CommandRobot(command);
}

void CoreRecorder::StartTimer(const AcsdTimer& timer, Core::Duration delay)
{
    _timers[timer] = GetNow().steady + delay;
    _real->output.StartTimer(timer, delay);
}

void CoreRecorder::CancelTimer(const AcsdTimer& timer)
{
    _timers.erase(timer);
    _real->output.CancelTimer(timer);
}

void CoreRecorder::CancelTimers()
{
    _timers.clear();
    _real->output.CancelTimers();
}

void CoreRecorder::CloseLinks()
{
    Emit("close links");
    _real->output.CloseLinks();
}

void CoreRecorder::OnStopped()
{
    Emit("stopped");
    _real->output.OnStopped();
}

void CoreRecorder::OnStoreTaken(const std::string& reason)
{
    Emit("store taken");
    _real->output.OnStoreTaken(reason);
}

void CoreRecorder::ObserveCommit(Core::Duration duration)
{
    _real->output.ObserveCommit(duration);
}

void CoreRecorder::OnOperatorRefused(const RefusedOffer& refused)
{
    _real->output.OnOperatorRefused(refused);
}

void CoreRecorder::ObserveAckWait(Core::Duration wait)
{
    _real->output.ObserveAckWait(wait);
}

bool CoreRecorder::IsRegistered() const
{
    const bool bRegistered = _real->mcs.IsRegistered();
    if (std::exchange(_bRegistered, bRegistered) != bRegistered)
    {
        Emit(bRegistered ? REGISTERED_KIND : UNREGISTERED_KIND);
    }
    return bRegistered;
}

bool CoreRecorder::TrySendDurable(const Protocol::AcsRequest& request)
{
    const bool bAccepted = _real->mcs.TrySendDurable(request);
    Emit(EncodeRequest(bAccepted ? REPORT_KIND : HELD_REPORT_KIND, request));
    return bAccepted;
}

void CoreRecorder::ReplayDone()
{
    Emit("replay done");
    _real->mcs.ReplayDone();
}

void CoreRecorder::SendStatus(const Protocol::AcsPayload& status)
{
    Emit(EncodeRequest("status", MakeUnnumbered(status)));
    _real->mcs.SendStatus(status);
}

void CoreRecorder::SendPosition(const Protocol::RobotPositionUpdate& positions)
{
    Emit(EncodeRequest("position", MakeUnnumbered(positions)));
    _real->mcs.SendPosition(positions);
}

void CoreRecorder::Answer(
    Protocol::EAcsCommand command,
    std::string_view transactionID,
    Protocol::EAckResult result,
    std::string_view message,
    const Protocol::AckPayload& payload)
{
    Emit(EncodeAnswer({command, std::string(transactionID), {}, result, std::string(message), payload}));
    _real->mcs.Answer(command, transactionID, result, message, payload);
}

void CoreRecorder::SetSiteOffset(std::chrono::minutes offset)
{
    _real->mcs.SetSiteOffset(offset);
}

} // namespace ACS::Acsd
