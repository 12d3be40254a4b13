#include "AcsSession.Impl.hpp"

#include <acs/core/Uuid.hpp>

#include <algorithm>
#include <cassert>
#include <utility>

namespace ACS::Protocol
{

AcsSession::Impl::Impl(const SessionOptions& options, Core::IRandom& random)
    : _options(options),
      _random(random),
      _codec(options.codec),
      _backoff(options.reconnect),
      _siteOffset(options.codec.siteOffset),
      _answers(options.answerMemory, options.answerCount, options.answerBytes),
      _recent(MOST_ABANDONED)
{
    _options.window = std::max<std::size_t>(_options.window, 1);
    _inFlight.reserve(_options.window + 1);
}

void AcsSession::Impl::Start(SessionActions& out)
{
    if (_state == EState::Stopped)
    {
        _state = EState::Connecting;
        out.emplace_back(Connect{});
    }
}

void AcsSession::Impl::Stop(Core::Now now, SessionActions& out)
{
    switch (_state)
    {
        case EState::Registered:
            _output.Cancel(ESessionTimer::Position, out);
            _state = EState::Farewell;
            Supersede(AcsCommStateUpdate{false});
            _farewellID = SendPayload(AcsCommStateUpdate{false}, {}, now, out);
            _output.Start(ESessionTimer::Shutdown, _options.shutdownGrace, out);
            ArmAckTimer(now, out);
            break;
        case EState::Connecting:
        case EState::Registering:
            Leave(EState::Stopping, CLOSE_NORMAL, "shutting down", out);
            break;
        case EState::Closing:
            _state = EState::Stopping;
            break;
        case EState::Waiting:
            End(out);
            break;
        case EState::Stopped:
        case EState::Farewell:
        case EState::Stopping:
        default:
            break;
    }
}

void AcsSession::Impl::OnConnected(Core::Now now, SessionActions& out)
{
    if (_state != EState::Connecting)
    {
        return;
    }
    ++_output.statistics.connects;
    _state = EState::Registering;
    _registrationID = Core::MakeUUID(_random);
    AcsCodec::EncodeRequest({_registrationID, Detail::MakeTimestamp(now, _siteOffset), Registration{}}, _scratch);
    ++_output.statistics.Of(EAcsCommand::Registration).sent;
    out.emplace_back(SendText{0, _scratch, false});
    _output.Start(ESessionTimer::Registration, _options.ackTimeout, out);
}

void AcsSession::Impl::OnText(std::string_view text, Core::Now now, SessionActions& out)
{
    if (_state != EState::Registering && !IsUp())
    {
        return;
    }
    DecodeOutcome outcome = _codec.Decode(text);
    _output.NoteAll(outcome.notes, out);
    if (!outcome.message.has_value())
    {
        Refuse(outcome.message.error(), outcome.bLegacyName, now, out);
    }
    else if (AcsRequest* requestOrNull = std::get_if<AcsRequest>(&*outcome.message))
    {
        HandleRequest(*requestOrNull, outcome.bLegacyName, now, out);
    }
    else
    {
        HandleAck(std::get<AcsAck>(*outcome.message), out);
    }
    UseRoom(now, out);
}

void AcsSession::Impl::OnClosed(std::string_view reason, Core::Now /*now*/, SessionActions& out)
{
    const bool bWasRegistered = _bWasRegistered;
    switch (_state)
    {
        case EState::Farewell:
        case EState::Stopping:
            End(out);
            break;
        case EState::Connecting:
        case EState::Registering:
        case EState::Registered:
        case EState::Closing:
            Forget(out);
            _state = EState::Waiting;
            ++_output.statistics.linkLosses;
            out.emplace_back(Deliver{LinkLost{std::string(reason), bWasRegistered}});
            _output.Start(ESessionTimer::Reconnect, _backoff.GetNextDelay(_random), out);
            break;
        case EState::Stopped:
        case EState::Waiting:
        default:
            break;
    }
}

void AcsSession::Impl::OnTimer(ESessionTimer timer, Core::Now now, SessionActions& out)
{
    if (!_output.TryExpire(timer))
    {
        return;
    }
    switch (timer)
    {
        case ESessionTimer::Registration:
            _output.Note(EProtocolNote::RegistrationUnanswered, {}, out);
            Leave(EState::Closing, CLOSE_NORMAL, "no answer to Registration", out);
            break;
        case ESessionTimer::Ack:
            ResendLate(now, out);
            UseRoom(now, out);
            break;
        case ESessionTimer::Reconnect:
            _state = EState::Connecting;
            out.emplace_back(Connect{});
            break;
        case ESessionTimer::Position:
            SchedulePosition(now, out);
            break;
        case ESessionTimer::Shutdown:
            Leave(EState::Stopping, CLOSE_NORMAL, "shutting down", out);
            break;
        case ESessionTimer::Answer:
        default:
            assert(false && "not a timer of this side");
            break;
    }
}

bool AcsSession::Impl::IsRegistered() const noexcept
{
    return _state == EState::Registered;
}

void AcsSession::Impl::SetSiteOffset(std::chrono::minutes offset) noexcept
{
    _siteOffset = offset;
    _codec.SetSiteOffset(offset);
}

const SessionStatistics& AcsSession::Impl::GetStatistics() const noexcept
{
    return _output.statistics;
}

bool AcsSession::Impl::IsUp() const noexcept
{
    return _state == EState::Registered || _state == EState::Farewell;
}

void AcsSession::Impl::Leave(EState state, std::uint16_t code, std::string reason, SessionActions& out)
{
    _output.CancelAll(out);
    _state = state;
    out.emplace_back(Close{0, code, std::move(reason)});
}

void AcsSession::Impl::Forget(SessionActions& out)
{
    _output.CancelAll(out);
    _inFlight.clear();
    _bWasRegistered = false;
    _phase = Detail::EConnectPhase::Replay;
    _requests = Detail::EWaitingRequests::None;
    _lastStatus = {};
    for (auto& [key, status] : _statuses)
    {
        status.passed.clear(); // the next connection begins with the latest status
    }
    _unansweredInRow = 0;
}

void AcsSession::Impl::End(SessionActions& out)
{
    Forget(out);
    _state = EState::Stopped;
    out.emplace_back(Deliver{Stopped{}});
}

void AcsSession::Impl::HandleRegistrationAck(const AcsAck& ack, SessionActions& out)
{
    const bool bForeign = ack.transactionID != _registrationID;
    if (bForeign && !_options.bAcksMatchedByCommand)
    {
        _output.Note(EProtocolNote::AckUnexpected, std::string(GetText(ack.command)), out);
        return;
    }
    ++_output.statistics.Of(EAcsCommand::Registration).answered;
    if (bForeign)
    {
        _output.Note(EProtocolNote::AckMismatched, std::string(GetText(ack.command)), out);
    }
    _output.Cancel(ESessionTimer::Registration, out);
    if (ack.result == EAckResult::Fail)
    {
        out.emplace_back(Deliver{RegistrationRefused{ack.message}});
        Leave(EState::Closing, CLOSE_NORMAL, "registration refused", out);
        return;
    }
    ++_output.statistics.registrations;
    _state = EState::Registered;
    _bWasRegistered = true;
    _backoff.Reset();
    for (auto& [key, status] : _statuses)
    {
        status.bPending = true;
        status.bEarlier = true;
    }
    out.emplace_back(Deliver{Registered{}});
}

} // namespace ACS::Protocol
