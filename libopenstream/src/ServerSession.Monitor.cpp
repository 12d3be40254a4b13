#include "ServerSession.Impl.hpp"

#include <algorithm>
#include <chrono>
#include <ratio>

namespace ACS::OpenStream
{

namespace
{

constexpr int FIRST_SERVICE_FAILURE = 500;

} // namespace

void ServerSession::Impl::Handle(const MonitorRequest& request, Core::Now now, ServerActions& out)
{
    // No line of the old recipe may come behind this ack.
    _outbox.SealData();
    OpenStreamCodec::EncodeLine(MonitorAck{}, _outbox.GetLines());
    FillRequest(EApiMethod::Get, request.url, request.args, _monitorCall);
    _monitorID = request.id;
    _period = request.period;
    _monitorToken = 0;
    _bMonitorFailing = false;
    const Core::SteadyTime firstTick = now.steady + _period;
    if (_state == EServerState::Streaming)
    {
        // The earlier tick stays: a client that sends MONITOR at every period would otherwise starve the stream.
        _nextTick = std::min(_nextTick, firstTick);
    }
    else
    {
        _state = EServerState::Streaming;
        _monitorBegin = now.steady;
        _lastDataAt = now.steady;
        _nextTick = firstTick;
    }
    out.emplace_back(ServerStartTimer{EServerTimer::MonitorTick, _nextTick});
    ArmWatchdog(out);
}

void ServerSession::Impl::StopMonitor(ServerActions& out)
{
    if (_state != EServerState::Streaming)
    {
        return;
    }
    _outbox.SealData();
    _state = EServerState::Ready;
    _monitorToken = 0;
    out.emplace_back(ServerCancelTimer{EServerTimer::MonitorTick});
}

void ServerSession::Impl::Tick(Core::Now now, ServerActions& out)
{
    if (_state != EServerState::Streaming)
    {
        return;
    }
    if (now.steady < _nextTick)
    {
        out.emplace_back(ServerStartTimer{EServerTimer::MonitorTick, _nextTick});
        return;
    }
    // The phase is kept: a late tick does not shift later ones, and missed ticks are not repeated.
    const auto missed = (now.steady - _nextTick) / std::chrono::duration_cast<Core::Duration>(_period);
    _stats.skippedTicks += static_cast<std::uint64_t>(missed);
    _nextTick += _period * (missed + 1);
    out.emplace_back(ServerStartTimer{EServerTimer::MonitorTick, _nextTick});
    if (_monitorToken != 0)
    {
        ++_stats.skippedTicks;
        if (now.steady - _monitorAskedAt >= _options.serviceTimeout)
        {
            ReportMonitorFailure();
        }
        return;
    }
    _monitorToken = ++_lastToken;
    _monitorAskedAt = now.steady;
    out.emplace_back(ServerCall{_monitorToken, &_monitorCall});
}

void ServerSession::Impl::FinishMonitor(const ApiResponse& response, Core::Now now, ServerActions& /*out*/)
{
    using Milliseconds = std::chrono::duration<double, std::milli>;
    _monitorToken = 0;
    if (response.bNoSample)
    {
        ++_stats.skippedTicks;
        return;
    }
    if (response.status >= FIRST_SERVICE_FAILURE)
    {
        ReportMonitorFailure();
    }
    else
    {
        _bMonitorFailing = false;
    }
    bool bReplaced = false;
    std::string& data = _outbox.BeginData(bReplaced);
    _stats.replacedLines += bReplaced ? 1U : 0U;
    const auto ts = std::chrono::duration_cast<std::chrono::milliseconds>(_monitorAskedAt - _monitorBegin);
    const Milliseconds duration = std::max(now.steady - _monitorAskedAt, Core::Duration::zero());
    OpenStreamCodec::EncodeData(ts.count(), duration.count(), response, _monitorID, data);
}

void ServerSession::Impl::ReportMonitorFailure()
{
    if (!_bMonitorFailing)
    {
        _bMonitorFailing = true;
        AppendError(EOpenStreamErrorCode::MonitorInternalError, "the controller's service failed");
    }
}

} // namespace ACS::OpenStream
