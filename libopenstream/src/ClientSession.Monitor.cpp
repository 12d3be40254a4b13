#include "ClientEvents.hpp"
#include "ClientSession.Impl.hpp"

#include <algorithm>
#include <utility>

namespace ACS::OpenStream
{

using Detail::Report;

void ClientSession::Impl::SetMonitor(std::optional<MonitorRequest> monitorOrNull, Core::Now now, ClientActions& out)
{
    _monitor = std::move(monitorOrNull);
    ++_monitorNumber;
    if (_monitor.has_value())
    {
        _monitor->period = std::clamp(_monitor->period, MINIMUM_PERIOD, MAXIMUM_PERIOD);
    }
    _bMonitorDue = true;
    _latest.reset();
    SendNext(now, out);
}

void ClientSession::Impl::Handle(MonitorAck& /*ack*/, Core::Now now, ClientActions& out)
{
    if (!IsAwaited(EInFlight::Monitor))
    {
        return;
    }
    FinishInFlight(out);
    _bMonitorOn = true;
    _startedMonitorNumber = _sentMonitorNumber;
    _bStale = false;
    _meter.Begin(_monitor.has_value() ? _monitor->period : MINIMUM_PERIOD);
    _lastDataAt = now.steady;
    Report(ClientMonitorStarted{_sentMonitorNumber}, out);
    ArmDataAge(out);
    SendNext(now, out);
}

void ClientSession::Impl::Handle(DataLine& line, Core::Now now, ClientActions& out)
{
    if (_state != EClientState::Ready || !_monitor.has_value())
    {
        return; // still on its way when the stream was stopped
    }
    ++_stats.dataLines;
    _stats.missingLines += _meter.Add(line.ts, now.steady);
    _lastDataAt = now.steady;
    _bStale = false;
    ArmDataAge(out);
    Confirm(line, out);
    if (_options.bSampleEvents)
    {
        Report(ClientData{line, now}, out);
    }
    if (!_bMonitorOn || IsMonitorCurrent()) // otherwise it was on its way when the stream was replaced
    {
        _latest = ClientData{std::move(line), now};
    }
}

void ClientSession::Impl::HandleMonitorError(ErrorLine& error, ClientActions& out)
{
    FinishInFlight(out);
    if (error.code == EOpenStreamErrorCode::MonitorAlreadyActive && !std::exchange(_bMonitorStopFirst, true))
    {
        _bMonitorOn = true;
        _bMonitorDue = true;
        return;
    }
    _bMonitorStopFirst = false;
    Report(ClientMonitorRefused{std::move(error), _sentMonitorURL}, out);
}

bool ClientSession::Impl::TrySendMonitor(Core::Now now, ClientActions& out)
{
    if (!_bMonitorDue)
    {
        return false;
    }
    if (_bMonitorOn && (!_monitor.has_value() || _bMonitorStopFirst))
    {
        _bMonitorDue = _monitor.has_value();
        SendAwaited(StopRequest{EStopTarget::Monitor}, EInFlight::StopMonitor, now, out);
        return true;
    }
    _bMonitorDue = false;
    if (_monitor.has_value())
    {
        _meter.Begin(_monitor->period);
        _sentMonitorNumber = _monitorNumber;
        _sentMonitorURL = _monitor->url;
        SendAwaited(*_monitor, EInFlight::Monitor, now, out);
    }
    return _monitor.has_value();
}

std::chrono::milliseconds ClientSession::Impl::GetDataLimit() const noexcept
{
    const bool bWaitsForStale = !_bStale && _options.staleAfter.count() > 0;
    const bool bLostFirst = _options.lostAfter.count() > 0 && _options.lostAfter < _options.staleAfter;
    return bWaitsForStale && !bLostFirst ? _options.staleAfter : _options.lostAfter;
}

bool ClientSession::Impl::IsMonitorCurrent() const noexcept
{
    return _bMonitorOn && _monitor.has_value() && _startedMonitorNumber == _monitorNumber;
}

/// Started forward only, and again where it fires early: see the watchdog of ServerSession.
void ClientSession::Impl::ArmDataAge(ClientActions& out)
{
    const std::chrono::milliseconds limit = GetDataLimit();
    if (!IsMonitorCurrent() || limit.count() <= 0)
    {
        return;
    }
    const Core::SteadyTime deadline = _lastDataAt + _monitor->period + limit;
    if (!_bDataAgeArmed || deadline < _dataAgeAt)
    {
        _bDataAgeArmed = true;
        _dataAgeAt = deadline;
        out.emplace_back(ClientStartTimer{EClientTimer::DataAge, deadline});
    }
}

void ClientSession::Impl::CheckDataAge(Core::Now now, ClientActions& out)
{
    if (_state != EClientState::Ready || !IsMonitorCurrent())
    {
        return;
    }
    const auto age = std::chrono::duration_cast<std::chrono::milliseconds>(now.steady - _lastDataAt);
    const std::chrono::milliseconds overdue = age - _monitor->period;
    if (!_bStale && _options.staleAfter.count() > 0 && overdue >= _options.staleAfter)
    {
        _bStale = true;
        Report(ClientMonitorStale{age}, out);
    }
    if (_options.lostAfter.count() > 0 && overdue >= _options.lostAfter)
    {
        HandleLoss(EClientLossReason::DataSilent, "the controller sent no data", now, out);
        return;
    }
    ArmDataAge(out);
}

const ClientData* ClientSession::Impl::GetLatestOrNull() const noexcept
{
    return _latest.has_value() ? &*_latest : nullptr;
}

StreamQuality ClientSession::Impl::GetQuality() const
{
    return _meter.GetQuality();
}

} // namespace ACS::OpenStream
