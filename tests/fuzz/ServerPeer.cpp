#include "ServerPeer.hpp"

#include "FuzzCheck.hpp"
#include <acs/core/Overloaded.hpp>

#include <algorithm>
#include <utility>

namespace ACS::Fuzz
{

using namespace OpenStream; // NOLINT(google-build-using-namespace)

namespace
{

constexpr std::chrono::milliseconds CLOSE_TIME{1'000};

/// Messages that are not the answer to a line.
bool IsUnasked(EOpenStreamErrorCode code)
{
    return code == EOpenStreamErrorCode::SessionTimeout || code == EOpenStreamErrorCode::MonitorInternalError
        || code == EOpenStreamErrorCode::RxBufOverflow || code == EOpenStreamErrorCode::HandshakeRejected;
}

} // namespace

ServerPeer::ServerPeer(const ServerSessionOptions& options)
    : _session(options)
{
    _session.Start(_now, _actions);
    Execute();
}

void ServerPeer::Execute()
{
    std::size_t index = 0;
    while (index < _actions.size()) // grows in the loop
    {
        const ServerAction action = _actions[index];
        Require(!_bClosed, "no action follows the close");
        std::visit([this](const auto& content) { Do(content); }, action);
        ++index;
    }
    _actions.clear();
}

void ServerPeer::Do(const ServerSend& action)
{
    Require(!_bSending, "one send is in flight at a time");
    Require(!_bShutDown, "nothing is sent after the shutdown");
    Require(action.text.ends_with('\n'), "a send ends with a complete line");
    _bSending = true;
    std::string_view rest = action.text;
    while (!rest.empty())
    {
        const std::size_t end = rest.find('\n');
        CheckLine(rest.substr(0, end));
        rest.remove_prefix(end + 1);
    }
}

void ServerPeer::CheckLine(std::string_view text)
{
    const Core::Result<OpenStreamLine> line = _codec.DecodeLine(text);
    Require(line.has_value(), "every line can be decoded");
    std::visit(
        Core::Overloaded{
            [this](const HandshakeAck& /*ack*/) { CheckAnswer("handshake_ack"); },
            [this](const MonitorAck& /*ack*/) {
                CheckAnswer("monitor_ack");
                _lastTs = _bStreaming ? _lastTs : -1.0;
                _bStreaming = true;
            },
            [this](const DataLine& data) {
                Require(_bStreaming, "no data is sent before a monitor_ack or after a stop_ack");
                Require(data.ts > _lastTs, "ts rises");
                _lastTs = data.ts;
            },
            [this](const StopAck& ack) {
                CheckAnswer("stop_ack");
                _bStreaming = _bStreaming && ack.target == EStopTarget::Control;
            },
            [](const ControlError& error) { Require(error.status >= 300, "a success of a CONTROL is silent"); },
            [this](const ErrorLine& error) {
                Require(error.code != EOpenStreamErrorCode::Unknown, "every error has a code of the protocol");
                if (!IsUnasked(error.code))
                {
                    CheckAnswer(error.codeText);
                }
            }},
        *line);
}

void ServerPeer::CheckAnswer(const std::string& kind)
{
    while (true)
    {
        Require(!_expected.empty(), "every answer has a request");
        const ExpectedAnswer next = std::move(_expected.front());
        _expected.pop_front();
        if (std::ranges::find(next.kinds, kind) != next.kinds.end())
        {
            return;
        }
        Require(next.bMaySucceedSilently, "every line is answered, in order");
    }
}

void ServerPeer::Do(const ServerCall& action)
{
    Require(action.request != nullptr, "a call has its request");
    if (action.request->method != EApiMethod::Get)
    {
        Require(_controlAsked == 0, "one CONTROL is at the service at a time");
        _controlAsked = action.token;
    }
    _asked.push_back(action.token);
}

void ServerPeer::Do(const ServerStopControl& /*action*/)
{
}

void ServerPeer::Do(const ServerStartTimer& action)
{
    _deadlines.at(static_cast<std::size_t>(action.timer)) = action.deadline;
}

void ServerPeer::Do(const ServerCancelTimer& action)
{
    _deadlines.at(static_cast<std::size_t>(action.timer)).reset();
}

void ServerPeer::Do(const ServerPauseReading& /*action*/)
{
    Require(!_bPaused, "a pause is requested once");
    _bPaused = true;
}

void ServerPeer::Do(const ServerResumeReading& /*action*/)
{
    Require(_bPaused, "reading is resumed only after a pause");
    _bPaused = false;
}

void ServerPeer::Do(const ServerContinue& /*action*/)
{
    _bContinue = true;
}

void ServerPeer::Do(const ServerShutdownSend& /*action*/)
{
    Require(!_bSending && !_bShutDown, "the shutdown is requested once, after the last send");
    _bShutDown = true;
}

void ServerPeer::Do(const ServerClose& /*action*/)
{
    _bClosed = true;
    for (const auto& deadline : _deadlines)
    {
        Require(!deadline.has_value(), "no timer runs after the close");
    }
}

bool ServerPeer::IsReading() const
{
    return !_bClosed && !_bPaused && !_bPeerClosed;
}

void ServerPeer::Send(std::string_view bytes, const std::vector<ExpectedAnswer>& expected)
{
    if (IsReading())
    {
        _expected.insert(_expected.end(), expected.begin(), expected.end());
        _session.OnBytes(bytes, _now, _actions);
        Execute();
    }
}

void ServerPeer::CompleteSend()
{
    if (!_bClosed && std::exchange(_bSending, false))
    {
        _session.OnSendCompleted(_now, _actions);
        Execute();
    }
}

void ServerPeer::Answer(std::uint32_t choice, const ApiResponse& response)
{
    if (_bClosed || _asked.empty())
    {
        return;
    }
    const auto chosen = _asked.begin() + static_cast<std::ptrdiff_t>(choice % _asked.size());
    const std::uint64_t token = *chosen;
    _asked.erase(chosen);
    _controlAsked = token == _controlAsked ? 0 : _controlAsked;
    _session.OnServiceAnswer(token, response, _now, _actions);
    Execute();
}

void ServerPeer::Continue()
{
    if (!_bClosed && std::exchange(_bContinue, false))
    {
        _session.OnContinue(_now, _actions);
        Execute();
    }
}

void ServerPeer::FireTimers()
{
    for (std::size_t index = 0; index < _deadlines.size(); ++index)
    {
        if (!_bClosed && _deadlines.at(index).has_value() && *_deadlines.at(index) <= _now.steady)
        {
            _deadlines.at(index).reset();
            _session.OnTimer(static_cast<EServerTimer>(index), _now, _actions);
            Execute();
        }
    }
}

void ServerPeer::PassTime(std::chrono::milliseconds span)
{
    _now.steady += span;
    FireTimers();
}

void ServerPeer::ClosePeer()
{
    if (!_bClosed && !std::exchange(_bPeerClosed, true))
    {
        _session.OnPeerClosed(_now, _actions);
        Execute();
    }
}

void ServerPeer::BreakSocket()
{
    if (!_bClosed)
    {
        _session.OnSocketError(_actions);
        Execute();
        Require(_bClosed, "a broken connection is closed");
    }
}

void ServerPeer::End()
{
    while (!_bClosed && (_bSending || _bContinue || _controlAsked != 0))
    {
        CompleteSend();
        Continue();
        const auto control = std::ranges::find(_asked, _controlAsked);
        if (control != _asked.end())
        {
            Answer(static_cast<std::uint32_t>(control - _asked.begin()), ApiResponse{});
        }
    }
    if (!_bClosed && _session.GetState() < EServerState::Closing)
    {
        Require(!_bPaused, "a session without open work reads again");
        Require(
            std::ranges::all_of(_expected, &ExpectedAnswer::bMaySucceedSilently),
            "every line is answered in the end");
    }
    ClosePeer();
    CompleteSend();
    PassTime(CLOSE_TIME);
    Require(_bClosed, "a session whose peer has closed ends within a second");
}

} // namespace ACS::Fuzz
