#include <acs/acsd/LineRobot.hpp>
#include <acs/core/Logger.hpp>

#include <fmt/format.h>

#include <utility>

namespace ACS::Acsd
{

namespace
{

LineClientOptions AddPermission(LineClientOptions options, const std::function<bool()>& mayCommand)
{
    options.maySend = mayCommand;
    return options;
}

} // namespace

LineRobot::LineRobot(RobotServices services, LineClientOptions options, std::unique_ptr<ILineAdapter> adapter)
    : _services(std::move(services)),
      _peer(fmt::format("{}:{}", options.host, options.port)),
      _adapter(std::move(adapter)),
      _client(
          _services.executor,
          _services.random,
          AddPermission(std::move(options), _services.mayCommand),
          {[this] { OnConnected(); },
           [this](std::string_view line) { OnLine(line); },
           [this](std::string_view reason) {
               OnLost(reason);
           }})
{
    _services.metrics.AddGauge("connected", "Whether the connection to the robot is open");
    _services.metrics.AddCounter("connects_total", "Connections to the robot");
    _services.metrics.AddCounter("lines_received_total", "Lines received from the robot");
    _services.metrics.AddCounter("lines_sent_total", "Lines sent to the robot");
    _services.metrics.AddCounter("lines_dropped_total", "Lines to the robot that were dropped");
}

Planning::IRobotAdapter& LineRobot::GetAdapter() noexcept
{
    return *_adapter;
}

void LineRobot::Start()
{
    _client.Start();
}

void LineRobot::Stop()
{
    _client.Stop();
}

void LineRobot::OnAdapterCalled()
{
    for (std::string& line : _adapter->TakeLines())
    {
        std::string traced = line;
        const ELineSend sent = _client.Send(std::move(line));
        if (sent == ELineSend::Accepted)
        {
            _services.trace(ETraceDirection::Out, traced);
        }
        else if (sent == ELineSend::InvalidLine)
        {
            _services.logger.Error(
                "the adapter sends a line that is too long or has a line end; it is dropped",
                {{"robot", _peer}, {"bytes", std::to_string(traced.size())}});
        }
    }
}

void LineRobot::UpdateMetrics()
{
    const LineClientStats& stats = _client.GetStats();
    _services.metrics.SetGauge("connected", _client.IsConnected() ? 1.0 : 0.0);
    _services.metrics.SetTotal("connects_total", static_cast<double>(stats.connects));
    _services.metrics.SetTotal("lines_received_total", static_cast<double>(stats.linesReceived));
    _services.metrics.SetTotal("lines_sent_total", static_cast<double>(stats.linesSent));
    _services.metrics.SetTotal("lines_dropped_total", static_cast<double>(stats.linesDropped));
}

void LineRobot::OnConnected()
{
    _bConnected = true;
    _connectedAt = _services.clock.GetNow().steady;
    _services.logger.Write(
        _bLossLogged ? Core::ELogLevel::Debug : Core::ELogLevel::Info,
        "connected to the robot",
        {{"robot", _peer}});
    _services.call([this](Core::Now now, Planning::AdapterActions& out) { _adapter->OnLinkUp(now, out); });
}

void LineRobot::OnLine(std::string_view line)
{
    if (_services.clock.GetNow().steady - _connectedAt >= LineClient::STABLE_AFTER
        && std::exchange(_bLossLogged, false))
    {
        _services.logger.Info("the robot answers again", {{"robot", _peer}});
    }
    _services.trace(ETraceDirection::In, line);
    _services.call([this, line](Core::Now now, Planning::AdapterActions& out) { _adapter->OnLine(line, now, out); });
}

/// Logged once per outage: the further attempts fail for the same reason.
void LineRobot::OnLost(std::string_view reason)
{
    const bool bWasConnected = std::exchange(_bConnected, false);
    _services.logger.Write(
        std::exchange(_bLossLogged, true) ? Core::ELogLevel::Debug : Core::ELogLevel::Warning,
        bWasConnected ? "lost the connection to the robot, reconnecting until it answers"
                      : "no connection to the robot: start it or correct its address; retrying until it answers",
        {{"robot", _peer}, {"reason", reason}});
    if (bWasConnected)
    {
        _services.call([this](Core::Now now, Planning::AdapterActions& out) { _adapter->OnLinkDown(now, out); });
    }
}

} // namespace ACS::Acsd
