#include "ClientPeer.hpp"

#include "FuzzCheck.hpp"
#include <acs/core/Overloaded.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

namespace ACS::Fuzz
{

using namespace OpenStream; // NOLINT(google-build-using-namespace)

namespace
{

/// What the session sends in addition to maximumOutput: the CONTROL that passes the limit, and the commands of its own.
constexpr std::size_t OUTPUT_MARGIN = 1024;

constexpr std::chrono::milliseconds WORK_STEP{100};
constexpr std::chrono::milliseconds CONFIRMATION_STEP{400};
constexpr std::uint32_t CONFIRMATION_STEPS = 4;
constexpr std::chrono::milliseconds LONGEST_CONFIRMATION = CONFIRMATION_STEP * CONFIRMATION_STEPS;

/// The number after the last '/' of the url.
std::uint64_t ReadNumber(std::string_view url)
{
    std::uint64_t number = 0;
    const std::string_view digits = url.substr(url.rfind('/') + 1);
    std::from_chars(digits.data(), digits.data() + digits.size(), number); // NOLINT(cppcoreguidelines-pro-bounds-*)
    return number;
}

bool IsOfRequest(const OpenStreamLine& line, EErrorScope scope)
{
    const auto* const error = std::get_if<ErrorLine>(&line);
    return error != nullptr
        && (GetErrorScope(error->code) == EErrorScope::Request || GetErrorScope(error->code) == scope);
}

ErrorLine MakeError(EOpenStreamErrorCode code)
{
    return ErrorLine{code, std::string(GetErrorText(code)), "no", {}};
}

} // namespace

ClientPeer::ClientPeer(const ClientSessionOptions& options)
    : _options(options),
      _session(options, *this)
{
}

std::uint64_t ClientPeer::GetNext()
{
    return 0;
}

void ClientPeer::Start()
{
    _session.Start(_now, _actions);
    _bEnded = false;
    Execute();
}

void ClientPeer::Stop()
{
    _session.Stop(_now, _actions);
    Execute();
}

void ClientPeer::SetMonitor(std::optional<std::chrono::milliseconds> periodOrNull)
{
    _monitor.reset();
    ++_monitorCalls;
    if (periodOrNull.has_value())
    {
        _monitor = MonitorRequest{"/m/" + std::to_string(_monitorCalls), *periodOrNull, {}, {}};
    }
    _bRefused = false;
    _session.SetMonitor(_monitor, _now, _actions);
    Require(_session.GetLatestOrNull() == nullptr, "the latest sample is of the current MONITOR");
    Execute();
}

bool ClientPeer::IsConfirmed(std::size_t index, const DataLine& sample)
{
    Control& control = _controls.at(index);
    Require(control.writtenAt.has_value(), "only a sample after the CONTROL was sent confirms it");
    Require(!control.outcome.has_value(), "a CONTROL with an outcome is not confirmed again");
    control.bConfirmed = control.bConfirmed || std::fmod(sample.ts, 3.0) == 0.0;
    return control.bConfirmed;
}

void ClientPeer::SendControl(Choices& choices)
{
    const std::size_t index = _controls.size();
    Control& control = _controls.emplace_back();
    control.session = _sessions;
    control.bTracked = choices.Take(4) != 0;
    ControlCall call;
    call.request = ControlRequest{EApiMethod::Post, "/c/" + std::to_string(index), {}, {}};
    call.tracking = control.bTracked ? EControlTracking::Tracked : EControlTracking::Streamed;
    call.timeout = std::chrono::milliseconds(choices.Take(4) == 0 ? choices.Take(200) : 0);
    if (choices.Take(3) == 0)
    {
        call.confirmWithin = CONFIRMATION_STEP * choices.Take(CONFIRMATION_STEPS);
        if (control.bTracked)
        {
            control.confirmWithin = call.confirmWithin;
        }
        call.isConfirmed = [this, index](const DataLine& sample) {
            return IsConfirmed(index, sample);
        };
    }
    const bool bPlain = call.timeout.count() == 0 && !call.isConfirmed;
    const std::uint64_t token = bPlain ? _session.SendControl(call.request, call.tracking, _now, _actions)
                                       : _session.SendControlCall(std::move(call), _now, _actions);
    Require(index == 0 || token > _controls.at(index - 1).token, "the token of a CONTROL is new");
    _controls.at(index).token = token;
    Execute();
}

void ClientPeer::StopControl()
{
    _session.StopControl(_now, _actions);
    Execute();
    const bool bOpen = std::ranges::any_of(_controls, [](const Control& control) {
        return control.bTracked && !control.outcome.has_value();
    });
    Require(!bOpen || _session.GetState() == EClientState::Ending, "STOP control settles every CONTROL");
}

void ClientPeer::EndConnecting(bool bConnected)
{
    if (_connection != EConnection::Connecting)
    {
        return;
    }
    _connection = bConnected ? EConnection::Open : EConnection::Closed;
    if (bConnected)
    {
        _session.OnConnected(_now, _actions);
    }
    else
    {
        _session.OnConnectFailed("refused", _now, _actions);
    }
    Execute();
}

void ClientPeer::CompleteSend()
{
    if (_connection != EConnection::Open || !_sending.has_value())
    {
        return;
    }
    Require(*_sending == _sendingCopy, "a text does not change while it is sent");
    _sending.reset();
    std::string_view rest = _sendingCopy;
    while (!rest.empty())
    {
        const std::size_t end = rest.find('\n');
        OpenStreamRequest request = *_codec.DecodeRequest(rest.substr(0, end));
        rest.remove_prefix(end + 1);
        if (const auto* control = std::get_if<ControlRequest>(&request))
        {
            _controls.at(ReadNumber(control->url)).writtenAt = _now.steady;
        }
        _received.push_back(std::move(request));
    }
    _session.OnSendCompleted(_now, _actions);
    Execute();
}

void ClientPeer::AnswerNext(EAnswer answer)
{
    if (_received.empty())
    {
        return;
    }
    const bool bRefused = answer != EAnswer::Accepted;
    const OpenStreamRequest request = std::move(_received.front());
    _received.pop_front();
    std::visit(
        Core::Overloaded{
            [this, bRefused](const HandshakeRequest& /*request*/) {
                Deliver(
                    bRefused ? OpenStreamLine(MakeError(EOpenStreamErrorCode::VersionMismatch))
                             : OpenStreamLine(HandshakeAck{true, "1.0.0"}));
            },
            [this, answer, bRefused](const MonitorRequest& monitor) {
                if (bRefused)
                {
                    const bool bActive = answer == EAnswer::RefusedAsActive && _servedMonitor != 0;
                    Deliver(MakeError(
                        bActive ? EOpenStreamErrorCode::MonitorAlreadyActive : EOpenStreamErrorCode::InvalidURL));
                    return;
                }
                _servedMonitor = ReadNumber(monitor.url);
                Deliver(MonitorAck{});
            },
            [this, bRefused](const ControlRequest& /*request*/) {
                if (bRefused)
                {
                    Deliver(ControlError{500, {}});
                }
            },
            [this](const StopRequest& stop) {
                const bool bNothing = stop.target == EStopTarget::Monitor && _servedMonitor == 0;
                _servedMonitor = stop.target == EStopTarget::Control ? _servedMonitor : 0;
                Deliver(
                    bNothing ? OpenStreamLine(MakeError(EOpenStreamErrorCode::NothingToStop))
                             : OpenStreamLine(StopAck{stop.target}));
            }},
        request);
}

void ClientPeer::SendSample()
{
    if (_servedMonitor != 0)
    {
        _ts += 1.0;
        DataLine sample;
        sample.ts = _ts;
        sample.result = Core::JsonText::FromInteger(static_cast<std::int64_t>(_servedMonitor));
        Deliver(sample);
    }
}

void ClientPeer::SendHostile(std::string_view bytes)
{
    if (_connection == EConnection::Open)
    {
        _bHostile = true;
        Deliver(bytes);
    }
}

void ClientPeer::Deliver(const OpenStreamLine& line)
{
    std::string text;
    OpenStreamCodec::EncodeLine(line, text);
    Deliver(text);
}

void ClientPeer::Deliver(std::string_view bytes)
{
    if (_connection != EConnection::Open)
    {
        return;
    }
    _unread.append(bytes);
    std::size_t begin = 0;
    for (std::size_t end = _unread.find('\n'); end != std::string::npos; end = _unread.find('\n', begin))
    {
        Core::Result<OpenStreamLine> line = _codec.DecodeLine(std::string_view(_unread).substr(begin, end - begin));
        begin = end + 1;
        if (line.has_value())
        {
            _bAcked = _bAcked || std::holds_alternative<HandshakeAck>(*line);
            _answers.push_back(std::move(*line));
        }
    }
    _unread.erase(0, begin);
    const bool bTooLong = _unread.size() > _options.longestLine + 1;
    _session.OnBytes(bytes, _now, _actions);
    Execute();
    Require(!bTooLong || _connection != EConnection::Open, "a line beyond the limit closes the connection");
}

void ClientPeer::ClosePeer()
{
    if (_connection == EConnection::Open)
    {
        _session.OnPeerClosed(_now, _actions);
        Execute();
        Require(_connection != EConnection::Open, "a closed connection is closed here too");
    }
}

void ClientPeer::BreakSocket()
{
    if (_connection == EConnection::Open)
    {
        _session.OnSocketError("reset", _now, _actions);
        Execute();
        Require(_connection != EConnection::Open, "a broken connection is closed");
    }
}

void ClientPeer::PassTime(std::chrono::milliseconds span)
{
    const Core::SteadyTime end = _now.steady + span;
    while (true)
    {
        Core::SteadyTime next = end;
        for (const auto& deadline : _deadlines)
        {
            next = deadline.has_value() ? std::min(next, *deadline) : next;
        }
        _now.steady = std::max(_now.steady, next);
        const bool bLast = _now.steady == end;
        FireTimers();
        CheckDataAge();
        if (bLast)
        {
            return;
        }
    }
}

void ClientPeer::FireTimers()
{
    for (std::size_t index = 0; index < _deadlines.size(); ++index)
    {
        if (_deadlines.at(index).has_value() && *_deadlines.at(index) <= _now.steady)
        {
            _deadlines.at(index).reset();
            _session.OnTimer(static_cast<EClientTimer>(index), _now, _actions);
            Execute();
        }
    }
}

void ClientPeer::Execute()
{
    // The pieces of one call in order; the session is not called from here.
    for (const ClientAction& action : std::exchange(_actions, {}))
    {
        std::visit([this](const auto& content) { Do(content); }, action);
    }
    if (!_sending.has_value())
    {
        // All commands that the session has sent are known.
        if (_awaited.has_value() && IsAnswered(*_awaited))
        {
            _awaited.reset();
        }
        _answers.clear();
    }
    CheckState();
    CheckTimers();
}

void ClientPeer::Do(const ClientConnect& /*action*/)
{
    Require(_connection == EConnection::Closed && !_bEnded, "a connection is opened after the last one was closed");
    _connection = EConnection::Connecting;
    ++_sessions;
}

void ClientPeer::Do(const ClientSend& action)
{
    Require(_connection == EConnection::Open, "nothing is sent without a connection");
    Require(!_sending.has_value(), "one send is in flight at a time");
    Require(action.text.ends_with('\n'), "a send ends with a complete line");
    Require(action.text.size() <= _options.maximumOutput + OUTPUT_MARGIN, "the output is bounded");
    _sending = action.text;
    _sendingCopy = action.text;
    std::string_view rest = action.text;
    while (!rest.empty())
    {
        const std::size_t end = rest.find('\n');
        const Core::Result<OpenStreamRequest> request = _codec.DecodeRequest(rest.substr(0, end));
        Require(request.has_value(), "every line can be decoded");
        CheckSentLine(*request);
        rest.remove_prefix(end + 1);
    }
}

void ClientPeer::CheckSentLine(const OpenStreamRequest& request)
{
    Require(
        std::holds_alternative<HandshakeRequest>(request) != _bHandshakeSent,
        "a session begins with one HANDSHAKE");
    _bHandshakeSent = true;
    Require(_bAcked || std::holds_alternative<HandshakeRequest>(request), "nothing is sent before the handshake_ack");
    std::visit(
        Core::Overloaded{
            [this](const HandshakeRequest& /*request*/) {
                Await({EOpenStreamCommand::Handshake, 0});
            },
            [this](const MonitorRequest& monitor) {
                Await({EOpenStreamCommand::Monitor, 0});
                const std::uint64_t number = ReadNumber(monitor.url);
                Require(number >= _sentMonitor, "no MONITOR is sent after a later one");
                Require(
                    monitor.period >= MINIMUM_PERIOD && monitor.period <= MAXIMUM_PERIOD,
                    "the period of a MONITOR is in its range");
                _sentMonitor = number;
            },
            [this](const ControlRequest& control) { CheckSentControl(control); },
            [this](const StopRequest& stop) {
                if (stop.target == EStopTarget::Monitor)
                {
                    Await({EOpenStreamCommand::Stop, 0});
                }
            }},
        request);
}

void ClientPeer::CheckSentControl(const ControlRequest& request)
{
    const std::size_t index = ReadNumber(request.url);
    Require(index < _controls.size(), "only a CONTROL of the caller is sent");
    Control& control = _controls.at(index);
    Require(!control.bSent, "a CONTROL is sent once");
    Require(control.session == _sessions, "a CONTROL is not sent in a later session");
    Require(control.outcome != EControlOutcome::NotSent, "a CONTROL that was reported as NotSent is not sent");
    control.bSent = true;
    if (control.bTracked)
    {
        Await({EOpenStreamCommand::Control, index});
    }
}

/// Whether the answer of the command was delivered, or its window has passed. Uses the answer.
bool ClientPeer::IsAnswered(const Awaited& awaited)
{
    if (awaited.command == EOpenStreamCommand::Control)
    {
        const Control& control = _controls.at(awaited.control);
        return control.outcome.has_value()
            || (control.writtenAt.has_value() && _now.steady >= *control.writtenAt + _options.controlWindow);
    }
    const auto answer = std::ranges::find_if(_answers, [&awaited](const OpenStreamLine& line) {
        switch (awaited.command)
        {
            case EOpenStreamCommand::Handshake:
                return std::holds_alternative<HandshakeAck>(line);
            case EOpenStreamCommand::Monitor:
                return std::holds_alternative<MonitorAck>(line) || IsOfRequest(line, EErrorScope::Monitor);
            case EOpenStreamCommand::Control:
            case EOpenStreamCommand::Stop:
            default:
                return std::holds_alternative<StopAck>(line) || IsOfRequest(line, EErrorScope::Stop);
        }
    });
    if (answer == _answers.end())
    {
        return false;
    }
    _answers.erase(_answers.begin(), answer + 1);
    return true;
}

void ClientPeer::Await(Awaited awaited)
{
    Require(!_awaited.has_value() || IsAnswered(*_awaited), "the next command follows the answer of the one before");
    _awaited = awaited;
}

void ClientPeer::Do(const ClientClose& /*action*/)
{
    for (const auto& deadline : _deadlines)
    {
        Require(!deadline.has_value(), "no timer runs after the close");
    }
    Forget();
}

/// The connection has ended.
void ClientPeer::Forget()
{
    _connection = EConnection::Closed;
    _sending.reset();
    _received.clear();
    _unread.clear();
    _answers.clear();
    _awaited.reset();
    _bReady = false;
    _bHandshakeSent = false;
    _bAcked = false;
    _bHostile = false;
    _sentMonitor = 0;
    _startedMonitor = 0;
    _servedMonitor = 0;
    _bStale = false;
    _bRefused = false;
}

void ClientPeer::Do(const ClientStartTimer& action)
{
    Require(action.deadline > _now.steady, "a timer ends in the future");
    _deadlines.at(static_cast<std::size_t>(action.timer)) = action.deadline;
}

void ClientPeer::Do(const ClientCancelTimer& action)
{
    _deadlines.at(static_cast<std::size_t>(action.timer)).reset();
}

void ClientPeer::Do(const ClientEvent& event)
{
    // A caller that sends nevertheless gets its outcome.
    const bool bOfCall =
        std::holds_alternative<ClientControlSettled>(event) || std::holds_alternative<ClientControlFault>(event);
    Require(!_bEnded || bOfCall, "no event follows ClientEnded");
    std::visit([this](const auto& content) { On(content); }, event);
}

void ClientPeer::On(const ClientReady& /*event*/)
{
    Require(
        _connection == EConnection::Open && _bAcked && !_bReady,
        "a session is ready once, after the handshake_ack");
    _bReady = true;
    ++_connects;
}

void ClientPeer::On(const ClientMonitorStarted& event)
{
    Require(_bReady, "no MONITOR starts before the session is ready");
    Require(event.requestNumber != 0 && event.requestNumber <= _monitorCalls, "a MONITOR has the number of its call");
    Require(event.requestNumber > _startedMonitor || _bHostile, "a MONITOR starts once in a session");
    _startedMonitor = event.requestNumber;
    _lastSampleAt = _now.steady;
    _bStale = false;
}

void ClientPeer::On(const ClientMonitorRefused& event)
{
    Require(_bReady, "no MONITOR is refused before the session is ready");
    _bRefused = _bRefused || ReadNumber(event.url) == _monitorCalls;
}

void ClientPeer::On(const ClientData& event)
{
    Require(_bReady && _monitor.has_value(), "no sample is reported without a MONITOR");
    Require(_options.bSampleEvents, "samples are events only where the caller wants them");
    ++_samples;
    const std::string_view result = event.line.result.has_value() ? event.line.result->GetText() : std::string_view();
    Require(_bHostile || result == std::to_string(_startedMonitor), "a sample is of the MONITOR that was started last");
    _lastSampleAt = _now.steady;
    _bStale = false;
}

void ClientPeer::On(const ClientMonitorStale& event)
{
    Require(_bReady && _startedMonitor != 0, "data is stale only where a MONITOR was started");
    const std::uint64_t lines = _session.GetStats().dataLines; // also those that are no events
    Require(!_bStale || lines > _linesAtStale, "stale data is reported once");
    _linesAtStale = lines;
    Require(
        event.age >= _options.staleAfter && _options.staleAfter.count() > 0,
        "stale data has the age of the options");
    _bStale = true;
}

void ClientPeer::On(const ClientControlSettled& event)
{
    const auto found = std::ranges::find(_controls, event.token, &Control::token);
    Require(found != _controls.end(), "an outcome has the token of its CONTROL");
    Control& control = *found;
    Require(control.bTracked, "a streamed CONTROL has no outcome");
    Require(!control.outcome.has_value(), "a CONTROL has one outcome");
    control.outcome = event.outcome;
    const auto hasPassed = [this, &control](std::chrono::milliseconds span) {
        return control.writtenAt.has_value() && _now.steady >= *control.writtenAt + span;
    };
    switch (event.outcome)
    {
        case EControlOutcome::Accepted:
            Require(hasPassed(_options.controlWindow), "a CONTROL is accepted after its window");
            Require(
                !control.confirmWithin.has_value() || control.bConfirmed,
                "a CONTROL is accepted when a sample confirms it");
            break;
        case EControlOutcome::Refused:
            break;
        case EControlOutcome::Unknown:
            Require(!control.bConfirmed || !hasPassed(_options.controlWindow), "a confirmed CONTROL is accepted");
            break;
        case EControlOutcome::NotSent:
            Require(!control.bSent, "a CONTROL that was sent is not reported as NotSent");
            break;
        case EControlOutcome::Unconfirmed:
            Require(
                control.confirmWithin.has_value() && hasPassed(*control.confirmWithin) && !control.bConfirmed,
                "a CONTROL is unconfirmed after its time");
            break;
        default:
            Require(false, "an outcome is known");
            break;
    }
}

void ClientPeer::On(const ClientControlFault& /*event*/)
{
}

void ClientPeer::On(const ClientStopped& /*event*/) const
{
    Require(_bReady, "nothing is stopped before the session is ready");
}

void ClientPeer::On(const ClientErrorReported& /*event*/) const
{
    Require(_bReady, "an error is reported by a session");
}

void ClientPeer::On(const ClientBadLine& /*event*/) const
{
    Require(_bHostile, "a valid line is read");
}

void ClientPeer::On(const ClientLost& event)
{
    Require(_connection == EConnection::Closed, "a lost connection was closed");
    Require(
        event.retryIn.count() > 0 && event.retryIn <= _options.reconnect.maximum,
        "the next attempt is within the maximum");
    Require(
        _deadlines.at(static_cast<std::size_t>(EClientTimer::Retry)) == _now.steady + event.retryIn,
        "the next attempt is due when it was announced");
}

void ClientPeer::On(const ClientEnded& /*event*/)
{
    Require(_connection == EConnection::Closed, "the connection is closed at the end");
    _bEnded = true;
    const bool bOpen = std::ranges::any_of(_controls, [](const Control& control) {
        return control.bTracked && control.token != 0 && !control.outcome.has_value();
    });
    Require(!bOpen, "each CONTROL has an outcome at the end");
}

void ClientPeer::CheckState() const
{
    const EClientState state = _session.GetState();
    const bool bConnected =
        state == EClientState::Handshaking || state == EClientState::Ready || state == EClientState::Ending;
    Require((_connection == EConnection::Open) == bConnected, "the state matches the connection");
    Require(
        (_connection == EConnection::Connecting) == (state == EClientState::Connecting),
        "the state matches the attempt");
    Require(_bEnded == (state == EClientState::Stopped), "a session is stopped after ClientEnded");
    Require(state != EClientState::Ready || _bReady, "a session that is ready has reported it");
    Require(bConnected || _session.GetLatestOrNull() == nullptr, "there is no latest sample without a connection");
    const ClientData* const latestOrNull = _session.GetLatestOrNull();
    Require(
        latestOrNull == nullptr || _bHostile
            || latestOrNull->line.result == Core::JsonText::FromInteger(static_cast<std::int64_t>(_monitorCalls)),
        "the latest sample is of the current MONITOR");
    const ClientSessionStats& stats = _session.GetStats();
    Require(stats.connects == _connects, "each handshake is counted");
    Require(!_options.bSampleEvents || stats.dataLines == _samples, "each sample is counted");
    std::size_t waiting = 0;
    for (const Control& control : _controls)
    {
        const bool bOpen = control.bTracked && control.token != 0 && !control.outcome.has_value();
        waiting += bOpen && !control.bSent ? 1U : 0U;
        Require(
            !bOpen || state == EClientState::Ready || state == EClientState::Ending,
            "no CONTROL waits without a session");
    }
    // The one in its turn may wait for the socket.
    Require(waiting <= _options.maximumControls + 1, "the queue of CONTROLs is bounded");
}

void ClientPeer::CheckTimers() const
{
    const auto isRunning = [this](EClientTimer timer) {
        return _deadlines.at(static_cast<std::size_t>(timer)).has_value();
    };
    const EClientState state = _session.GetState();
    Require(state != EClientState::Connecting || isRunning(EClientTimer::Connect), "a connection attempt has a limit");
    Require(state != EClientState::Handshaking || isRunning(EClientTimer::Answer), "a HANDSHAKE has a limit");
    Require(state != EClientState::Ending || isRunning(EClientTimer::Answer), "the end has a limit");
    Require(state != EClientState::Waiting || isRunning(EClientTimer::Retry), "the next attempt is due");
    Require(
        state != EClientState::Stopped
            || std::ranges::none_of(_deadlines, [](const auto& deadline) { return deadline.has_value(); }),
        "no timer runs when the session has ended");
    const bool bOpen = std::ranges::any_of(_controls, [](const Control& control) {
        return control.bTracked && control.token != 0 && !control.outcome.has_value();
    });
    Require(
        !bOpen || isRunning(EClientTimer::Control) || isRunning(EClientTimer::Answer)
            || _options.controlTimeout.count() == 0,
        "a CONTROL without an outcome has a timer");
}

/// Stale and lost data are noticed in time.
void ClientPeer::CheckDataAge() const
{
    const bool bCurrent = _session.GetState() == EClientState::Ready && _monitor.has_value() && !_bHostile
        && _startedMonitor == _monitorCalls;
    if (!bCurrent || !_options.bSampleEvents)
    {
        return;
    }
    const Core::Duration overdue =
        _now.steady - _lastSampleAt - std::clamp(_monitor->period, MINIMUM_PERIOD, MAXIMUM_PERIOD);
    Require(
        _options.staleAfter.count() == 0 || overdue < _options.staleAfter || _bStale,
        "stale data is reported in time");
    Require(_options.lostAfter.count() == 0 || overdue < _options.lostAfter, "silent data ends the connection in time");
}

/// A controller that answers everything.
void ClientPeer::Work(std::chrono::milliseconds span)
{
    for (std::chrono::milliseconds passed{0}; passed < span; passed += WORK_STEP)
    {
        EndConnecting(true);
        for (int turn = 0; turn < 4; ++turn)
        {
            CompleteSend();
            while (!_received.empty())
            {
                AnswerNext(EAnswer::Accepted);
            }
        }
        SendSample();
        PassTime(WORK_STEP);
    }
}

void ClientPeer::CheckWorks()
{
    Work(_options.answerTimeout + _options.reconnect.maximum + _options.controlTimeout + LONGEST_CONFIRMATION);
    Require(_session.GetState() == EClientState::Ready, "the session is ready with a controller that works");
    const std::uint64_t wanted = _monitor.has_value() && !_bRefused ? _monitorCalls : 0;
    Require(_bRefused || _servedMonitor == wanted, "the MONITOR that was set last is the one of the controller");
    Require(wanted == 0 || _startedMonitor == wanted, "the MONITOR that was set last was reported");
    const bool bOpen = std::ranges::any_of(_controls, [](const Control& control) {
        return control.bTracked && !control.outcome.has_value();
    });
    Require(!bOpen, "each CONTROL has an outcome");
}

void ClientPeer::End()
{
    if (_session.GetState() == EClientState::Ending || _bEnded)
    {
        PassTime(_options.answerTimeout);
        Require(_bEnded, "a session that is stopped ends in time");
        Start();
    }
    if (_bHostile)
    {
        BreakSocket();
    }
    CheckWorks();
    SetMonitor(WORK_STEP);
    CheckWorks();
    SetMonitor(std::nullopt);
    CheckWorks();
    Stop();
    PassTime(_options.answerTimeout);
    Require(_bEnded, "a session that is stopped ends in time");
}

} // namespace ACS::Fuzz
