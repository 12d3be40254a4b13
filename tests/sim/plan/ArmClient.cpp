#include "ArmClient.hpp"

#include <acs/core/Overloaded.hpp>

#include <fmt/format.h>

#include <array>
#include <string_view>
#include <utility>
#include <variant>

namespace ACS::Simulation
{

namespace
{

constexpr std::string_view START_URL = "/project/robot/start";

} // namespace

ArmClient::ArmClient(
    Timeline& timeline,
    ArmController& controller,
    const OpenStream::ClientSessionOptions& options,
    EventHandler handler)
    : _timeline(timeline),
      _controller(controller),
      _handler(std::move(handler)),
      _session(options, controller.GetClientRandom()),
      _timers(timeline)
{
}

ArmClient::~ArmClient()
{
    if (_connection.has_value())
    {
        _controller.GetNetwork().Abandon(*_connection, ETextEnd::Client);
    }
}

/// Requests of the event handler join the batch, as in OpenStreamClient.
template <typename TCall>
void ArmClient::Call(TCall call)
{
    call(_timeline.GetNow(), _actions);
    if (std::exchange(_bExecuting, true))
    {
        return;
    }
    std::size_t index = 0;
    while (index < _actions.size()) // grows in the loop
    {
        const OpenStream::ClientAction action = std::move(_actions[index]);
        std::visit([this](const auto& content) { this->Do(content); }, action);
        ++index;
    }
    _actions.clear();
    _bExecuting = false;
}

void ArmClient::Do(const OpenStream::ClientEvent& event)
{
    TraceEvent(event);
    Mutate(event);
    _handler(event);
}

void ArmClient::Mutate(const OpenStream::ClientEvent& event)
{
    if (std::holds_alternative<OpenStream::ClientReady>(event) && _controller.Is(EMutation::StartRepeated)
        && std::exchange(_bStartSent, false))
    {
        OpenStream::ControlRequest again;
        again.url = START_URL;
        again.body = Core::JsonText::FromTrusted("{}");
        static_cast<void>(
            _session.SendControl(again, OpenStream::EControlTracking::Streamed, _timeline.GetNow(), _actions));
    }
}

/// Only the samples that have changed.
void ArmClient::TraceEvent(const OpenStream::ClientEvent& event)
{
    std::visit(
        Core::Overloaded{
            [this](const OpenStream::ClientReady&) { _controller.AddToTrace("session with the arm"); },
            [this](const OpenStream::ClientMonitorStarted&) { _controller.AddToTrace("MONITOR begins"); },
            [this](const OpenStream::ClientData& data) {
                const std::string text(data.line.result.has_value() ? data.line.result->GetText() : std::string());
                if (std::exchange(_toldSample, text) != text)
                {
                    _controller.AddToTrace("sample " + text);
                }
            },
            [this](const OpenStream::ClientControlSettled& settled) {
                static constexpr std::array OUTCOMES{"accepted", "refused", "unknown", "not sent", "unconfirmed"};
                const std::string outcome = OUTCOMES.at(static_cast<std::size_t>(settled.outcome));
                _controller.AddToTrace("CONTROL " + outcome + " " + settled.detail);
            },
            [this](const OpenStream::ClientControlFault& fault) {
                _controller.AddToTrace("CONTROL fault " + fault.detail);
            },
            [this](const OpenStream::ClientLost& lost) { _controller.AddToTrace("arm lost: " + lost.detail); },
            [this](const auto&) {
                _controller.AddToTrace("another event of the session");
            }},
        event);
}

void ArmClient::Do(const OpenStream::ClientConnect& /*action*/)
{
    _bOpened = false;
    _connection = _controller.GetNetwork().Connect(*this);
}

void ArmClient::Do(const OpenStream::ClientSend& action)
{
    const std::string start = fmt::format("\"{}\"", START_URL);
    const std::string text(action.text);
    for (std::size_t at = text.find(start); at != std::string::npos; at = text.find(start, at + 1))
    {
        _controller.NoteStartSent(*_connection, _commandID);
    }
    _controller.GetNetwork().Send(*_connection, ETextEnd::Client, text);
    _session.OnSendCompleted(_timeline.GetNow(), _actions); // the simulated network always accepts everything
}

void ArmClient::Do(const OpenStream::ClientClose& /*action*/)
{
    if (const std::optional<Protocol::ConnectionID> connection = std::exchange(_connection, std::nullopt))
    {
        _controller.GetNetwork().Abandon(*connection, ETextEnd::Client);
    }
}

void ArmClient::Do(const OpenStream::ClientStartTimer& action)
{
    const OpenStream::EClientTimer timer = action.timer;
    _timers.Start(timer, action.deadline - _timeline.GetNow().steady, [this, timer] {
        Call([this, timer](Core::Now now, auto& out) { _session.OnTimer(timer, now, out); });
    });
}

void ArmClient::Do(const OpenStream::ClientCancelTimer& action)
{
    _timers.Cancel(action.timer);
}

void ArmClient::OnOpened(Protocol::ConnectionID connection)
{
    if (connection == _connection)
    {
        _bOpened = true;
        Call([this](Core::Now now, auto& out) { _session.OnConnected(now, out); });
    }
}

void ArmClient::OnText(Protocol::ConnectionID connection, const std::string& text)
{
    if (connection == _connection)
    {
        Call([this, &text](Core::Now now, auto& out) { _session.OnBytes(text, now, out); });
    }
}

void ArmClient::OnClosed(Protocol::ConnectionID connection, const std::string& reason)
{
    if (connection != _connection)
    {
        return;
    }
    _connection.reset();
    Call([this, &reason](Core::Now now, auto& out) {
        if (_bOpened)
        {
            _session.OnSocketError(reason, now, out);
        }
        else
        {
            _session.OnConnectFailed(reason, now, out);
        }
    });
}

void ArmClient::Start()
{
    Call([this](Core::Now now, auto& out) { _session.Start(now, out); });
}

void ArmClient::Send(const Acsd::ArmRequest& request)
{
    Call([this, &request](Core::Now now, auto& out) {
        std::visit(
            Core::Overloaded{
                [&](const OpenStream::MonitorRequest& monitor) { _session.SetMonitor(monitor, now, out); },
                [&](const OpenStream::ControlRequest& control) {
                    _bStartSent = _bStartSent || control.url == START_URL;
                    static_cast<void>(_session.SendControl(control, OpenStream::EControlTracking::Tracked, now, out));
                }},
            request);
    });
}

void ArmClient::NoteCommand(const Planning::RobotCommand& command)
{
    if (const auto* const jobOrNull = std::get_if<Planning::StartJob>(&command); jobOrNull != nullptr)
    {
        _commandID = jobOrNull->commandID;
    }
    else if (const auto* const recoveryOrNull = std::get_if<Planning::RecoverJob>(&command); recoveryOrNull != nullptr)
    {
        _commandID = recoveryOrNull->job.commandID;
    }
}

} // namespace ACS::Simulation
