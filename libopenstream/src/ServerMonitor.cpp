#include "ServerMonitor.hpp"

#include <acs/openstream/OpenStreamCodec.hpp>

#include <algorithm>
#include <ratio>
#include <utility>

namespace ACS::OpenStream
{

namespace
{

constexpr int FIRST_SERVICE_FAILURE = 500;

} // namespace

ServerMonitor::ServerMonitor(std::chrono::milliseconds serviceTimeout)
    : _serviceTimeout(serviceTimeout)
{
}

void ServerMonitor::Begin(const MonitorRequest& request, Core::Now now, ServerActions& out)
{
    _begin = now.steady;
    _lastDataAt = now.steady;
    Apply(request, now.steady + request.period, out);
}

void ServerMonitor::Replace(const MonitorRequest& request, Core::Now now, ServerActions& out)
{
    const Core::SteadyTime due = std::min(GetDataDue(), now.steady + request.period);
    // The earlier tick stays: a client that sends MONITOR at every period would otherwise starve the stream.
    Apply(request, std::min(_nextTick, now.steady + request.period), out);
    // A silence that the former period allowed is no interruption.
    _lastDataAt = due - request.period;
}

void ServerMonitor::Apply(const MonitorRequest& request, Core::SteadyTime firstTick, ServerActions& out)
{
    SplitURL(request.url, _call);
    if (request.args.has_value())
    {
        AddArguments(*request.args, _call);
    }
    _id = request.id;
    _period = request.period;
    _token = 0;
    _bFailing = false;
    _nextTick = firstTick;
    out.emplace_back(ServerStartTimer{EServerTimer::MonitorTick, _nextTick});
}

void ServerMonitor::Stop(ServerActions& out)
{
    _token = 0;
    out.emplace_back(ServerCancelTimer{EServerTimer::MonitorTick});
}

ServerMonitor::Outcome ServerMonitor::OnTick(std::uint64_t token, Core::Now now, ServerActions& out)
{
    Outcome outcome;
    if (now.steady < _nextTick)
    {
        out.emplace_back(ServerStartTimer{EServerTimer::MonitorTick, _nextTick});
        return outcome;
    }
    // The phase is kept: a late tick does not shift later ones, and missed ticks are not repeated.
    const auto missed = (now.steady - _nextTick) / std::chrono::duration_cast<Core::Duration>(_period);
    outcome.skipped = static_cast<std::uint64_t>(missed);
    _nextTick += _period * (missed + 1);
    out.emplace_back(ServerStartTimer{EServerTimer::MonitorTick, _nextTick});
    if (_token != 0)
    {
        ++outcome.skipped;
        outcome.bFailureBegan = now.steady - _askedAt >= _serviceTimeout && TryBeginFailure();
        return outcome;
    }
    _token = token;
    _askedAt = now.steady;
    out.emplace_back(ServerCall{_token, &_call});
    return outcome;
}

ServerMonitor::Outcome ServerMonitor::OnAnswer(const ApiResponse& response)
{
    _token = 0;
    if (response.bNoSample)
    {
        return Outcome{1, false};
    }
    if (response.status >= FIRST_SERVICE_FAILURE)
    {
        return Outcome{0, TryBeginFailure()};
    }
    _bFailing = false;
    return {};
}

void ServerMonitor::Encode(const ApiResponse& response, Core::Now now, std::string& line) const
{
    using Milliseconds = std::chrono::duration<double, std::milli>;
    const auto ts = std::chrono::duration_cast<std::chrono::milliseconds>(_askedAt - _begin);
    const Milliseconds duration = std::max(now.steady - _askedAt, Core::Duration::zero());
    OpenStreamCodec::EncodeData(ts.count(), duration.count(), response, _id, line);
}

void ServerMonitor::OnDataSent(Core::Now now) noexcept
{
    _lastDataAt = now.steady;
}

bool ServerMonitor::IsCall(std::uint64_t token) const noexcept
{
    return _token == token;
}

Core::SteadyTime ServerMonitor::GetDataDue() const noexcept
{
    return _lastDataAt + _period;
}

bool ServerMonitor::TryBeginFailure() noexcept
{
    return !std::exchange(_bFailing, true);
}

} // namespace ACS::OpenStream
