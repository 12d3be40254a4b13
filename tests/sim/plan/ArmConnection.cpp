#include "ArmConnection.hpp"

#include <utility>
#include <variant>

namespace ACS::Simulation
{

using namespace std::chrono_literals;

ArmConnection::ArmConnection(Timeline& timeline, TextNetwork& network, Protocol::ConnectionID id, Handlers handlers)
    : _timeline(timeline),
      _network(network),
      _id(id),
      _handlers(std::move(handlers)),
      _timers(timeline),
      _answerTimers(timeline)
{
}

/// Carries out the batch. Its immediate consequences (the answer of the service) join it.
template <typename TCall>
void ArmConnection::Call(TCall call)
{
    if (_bEnded)
    {
        return;
    }
    call(_timeline.GetNow(), _actions);
    for (std::size_t index = 0; index < _actions.size() && !_bEnded; ++index)
    {
        const OpenStream::ServerAction action = _actions[index];
        std::visit([this](const auto& content) { this->Do(content); }, action);
    }
    _actions.clear();
}

void ArmConnection::Do(const OpenStream::ServerSend& action)
{
    _network.Send(_id, ETextEnd::Server, std::string(action.text));
    _session.OnSendCompleted(_timeline.GetNow(), _actions); // the simulated network always accepts everything
}

void ArmConnection::Do(const OpenStream::ServerCall& action)
{
    const EAnswer kind = action.request->method == OpenStream::EApiMethod::Get ? EAnswer::Sample : EAnswer::Control;
    Answer& answer = _answers.at(static_cast<std::size_t>(kind));
    answer.token = action.token;
    _handlers.call(*action.request, answer.response);
    if (_bEnded)
    {
        return;
    }
    if (answer.response.delay > Core::Duration::zero())
    {
        _answerTimers.Start(kind, answer.response.delay, [this, &answer] {
            Call([this, &answer](Core::Now now, auto& out) {
                _session.OnServiceAnswer(answer.token, answer.response, now, out);
            });
        });
        return;
    }
    _session.OnServiceAnswer(answer.token, answer.response, _timeline.GetNow(), _actions);
}

void ArmConnection::Do(const OpenStream::ServerStopControl& action) const
{
    if (action.bControls || !_handlers.isOtherInControl())
    {
        _handlers.stopControl();
    }
}

void ArmConnection::Do(const OpenStream::ServerStartTimer& action)
{
    const OpenStream::EServerTimer timer = action.timer;
    _timers.Start(timer, action.deadline - _timeline.GetNow().steady, [this, timer] {
        Call([this, timer](Core::Now now, auto& out) { _session.OnTimer(timer, now, out); });
    });
}

void ArmConnection::Do(const OpenStream::ServerCancelTimer& action)
{
    _timers.Cancel(action.timer);
}

void ArmConnection::Do(const OpenStream::ServerPauseReading& /*action*/)
{
    // No text waits before the session: the network delivers text by text.
}

void ArmConnection::Do(const OpenStream::ServerResumeReading& /*action*/)
{
}

void ArmConnection::Do(const OpenStream::ServerContinue& /*action*/)
{
    _timers.Post(0ms, [this] { Call([this](Core::Now now, auto& out) { _session.OnContinue(now, out); }); });
}

void ArmConnection::Do(const OpenStream::ServerShutdownSend& /*action*/)
{
    _network.Close(_id, ETextEnd::Server, "the controller closed the connection");
}

void ArmConnection::Do(const OpenStream::ServerClose& /*action*/)
{
    End();
    _handlers.onEnded();
}

void ArmConnection::End()
{
    _bEnded = true;
    _timers.CancelAll();
    _answerTimers.CancelAll();
    _network.Abandon(_id, ETextEnd::Server);
}

void ArmConnection::Start()
{
    Call([this](Core::Now now, auto& out) { _session.Start(now, out); });
}

void ArmConnection::OnText(const std::string& text)
{
    Call([this, &text](Core::Now now, auto& out) { _session.OnBytes(text, now, out); });
}

void ArmConnection::OnPeerClosed()
{
    Call([this](Core::Now now, auto& out) { _session.OnPeerClosed(now, out); });
}

void ArmConnection::Drop()
{
    if (!_bEnded)
    {
        End();
    }
}

bool ArmConnection::IsEnded() const noexcept
{
    return _bEnded;
}

bool ArmConnection::HasControl() const noexcept
{
    return !_bEnded && _session.HasControl();
}

} // namespace ACS::Simulation
