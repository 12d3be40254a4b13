#include "ClientMonitor.hpp"

#include "ClientEvents.hpp"

#include <algorithm>
#include <utility>

namespace ACS::OpenStream
{

using Detail::Report;

ClientMonitor::ClientMonitor(const ClientSessionOptions& options)
    : _options(options)
{
}

void ClientMonitor::Set(std::optional<MonitorRequest> monitorOrNull)
{
    _wanted = std::move(monitorOrNull);
    ++_wantedNumber;
    if (_wanted.has_value())
    {
        _wanted->period = std::clamp(_wanted->period, MINIMUM_PERIOD, MAXIMUM_PERIOD);
    }
    _bDue = true;
    _latest.reset();
}

void ClientMonitor::OnDisconnected()
{
    _bDue = _wanted.has_value();
    _asked = EAsked::Nothing;
    _stream = EStream::Nothing;
    _bStale = false;
    _ageTimer.Reset();
    _latest.reset();
}

std::optional<OpenStreamRequest> ClientMonitor::BeginNextOrNull()
{
    if (!_bDue)
    {
        return std::nullopt;
    }
    if (_stream == EStream::Occupied || (_stream == EStream::Started && !_wanted.has_value()))
    {
        _bDue = _wanted.has_value();
        _asked = EAsked::Stop;
        return StopRequest{EStopTarget::Monitor};
    }
    _bDue = false;
    if (!_wanted.has_value())
    {
        _stream = EStream::Nothing;
        return std::nullopt;
    }
    _asked = EAsked::Start;
    _sentNumber = _wantedNumber;
    _sentURL = _wanted->url;
    _sentPeriod = _wanted->period;
    if (IsSilent())
    {
        _meter.Begin(_sentPeriod);
    }
    return *_wanted;
}

void ClientMonitor::OnStarted(Core::Now now, ClientActions& out)
{
    if (IsStarting())
    {
        FinishAsked(out);
    }
    _asked = EAsked::Nothing; // A refused one has no timer; a CONTROL may have.
    _bDue = _bDue || !_wanted.has_value();
    _stream = EStream::Started;
    _startedNumber = _sentNumber;
    _bStale = false;
    _meter.Begin(_sentPeriod);
    _lastDataAt = now.steady;
    Report(ClientMonitorStarted{_sentNumber}, out);
    ArmAgeTimer(out);
}

void ClientMonitor::OnRefused(ErrorLine error, ClientActions& out)
{
    FinishAsked(out);
    const bool bOccupied = error.code == EOpenStreamErrorCode::MonitorAlreadyActive;
    if (bOccupied && _stream != EStream::Freed)
    {
        _stream = EStream::Occupied;
        _bDue = true;
        return;
    }
    _asked = EAsked::Refused;
    _stream = _stream == EStream::Freed ? EStream::Nothing : _stream;
    Report(ClientMonitorRefused{std::move(error), _sentURL}, out);
}

void ClientMonitor::OnStopped(ClientActions& out)
{
    FinishAsked(out);
    _stream = _stream == EStream::Occupied ? EStream::Freed : EStream::Nothing;
}

std::uint64_t ClientMonitor::OnSample(DataLine line, Core::Now now, ClientActions& out)
{
    const std::uint64_t missing = _meter.Add(line.ts, now.steady);
    _lastDataAt = now.steady;
    _bStale = false;
    ArmAgeTimer(out);
    if (_options.bSampleEvents)
    {
        Report(ClientData{line, now}, out);
    }
    if (IsSilent() || IsCurrent()) // otherwise it was on its way when the stream was replaced
    {
        _latest = ClientData{std::move(line), now};
    }
    return missing;
}

bool ClientMonitor::TryAwaitData(Core::Now now, ClientActions& out)
{
    _ageTimer.Reset();
    if (!IsCurrent())
    {
        return true;
    }
    const auto age = std::chrono::duration_cast<std::chrono::milliseconds>(now.steady - _lastDataAt);
    const std::chrono::milliseconds overdue = age - _wanted->period;
    if (!_bStale && _options.staleAfter.count() > 0 && overdue >= _options.staleAfter)
    {
        _bStale = true;
        Report(ClientMonitorStale{age}, out);
    }
    if (_options.lostAfter.count() > 0 && overdue >= _options.lostAfter)
    {
        return false;
    }
    ArmAgeTimer(out);
    return true;
}

bool ClientMonitor::IsWanted() const noexcept
{
    return _wanted.has_value();
}

bool ClientMonitor::IsInFlight() const noexcept
{
    return IsStarting() || IsStopping();
}

bool ClientMonitor::IsStarting() const noexcept
{
    return _asked == EAsked::Start;
}

bool ClientMonitor::IsRefused() const noexcept
{
    return _asked == EAsked::Refused;
}

bool ClientMonitor::IsStopping() const noexcept
{
    return _asked == EAsked::Stop;
}

const ClientData* ClientMonitor::GetLatestOrNull() const noexcept
{
    return _latest.has_value() ? &*_latest : nullptr;
}

StreamQuality ClientMonitor::GetQuality() const
{
    return _meter.GetQuality();
}

bool ClientMonitor::IsSilent() const noexcept
{
    return _stream == EStream::Nothing || _stream == EStream::Freed;
}

bool ClientMonitor::IsCurrent() const noexcept
{
    return _stream == EStream::Started && _wanted.has_value() && _startedNumber == _wantedNumber;
}

std::chrono::milliseconds ClientMonitor::GetDataLimit() const noexcept
{
    const bool bWaitsForStale = !_bStale && _options.staleAfter.count() > 0;
    const bool bLostFirst = _options.lostAfter.count() > 0 && _options.lostAfter < _options.staleAfter;
    return bWaitsForStale && !bLostFirst ? _options.staleAfter : _options.lostAfter;
}

void ClientMonitor::ArmAgeTimer(ClientActions& out)
{
    const std::chrono::milliseconds limit = GetDataLimit();
    if (!IsCurrent() || limit.count() <= 0)
    {
        return;
    }
    const Core::SteadyTime deadline = _lastDataAt + _wanted->period + limit;
    if (_ageTimer.ShouldStart(deadline))
    {
        out.emplace_back(ClientStartTimer{EClientTimer::DataAge, deadline});
    }
}

void ClientMonitor::FinishAsked(ClientActions& out)
{
    _asked = EAsked::Nothing;
    out.emplace_back(ClientCancelTimer{EClientTimer::Answer});
}

} // namespace ACS::OpenStream
