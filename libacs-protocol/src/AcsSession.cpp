#include "AnswerStore.hpp"
#include "PendingRequests.hpp"
#include "SessionOutput.hpp"
#include <acs/core/Backoff.hpp>
#include <acs/core/Uuid.hpp>
#include <acs/protocol/AcsCodec.hpp>
#include <acs/protocol/AcsSession.hpp>

#include <algorithm>
#include <cassert>
#include <deque>
#include <map>
#include <utility>
#include <vector>

namespace ACS::Protocol
{

namespace
{

constexpr std::size_t RECENT_COUNT = 256;

///                Start        OnConnected   RegistrationAck    OnClosed    Reconnect timer   Stop
/// Stopped        Connecting
/// Connecting                  Registering                      Waiting                       Stopping
/// Registering                               Registered/Closing Waiting                       Stopping
/// Registered                                                   Waiting                       Farewell
/// Closing                                                      Waiting                       Stopping
/// Waiting                                                                  Connecting        Stopped
/// Farewell       (its Ack or the grace: Stopping)              Stopped
/// Stopping                                                     Stopped
enum class EState : std::uint8_t
{
    Stopped,
    Connecting,
    Registering,
    Registered,
    Closing,
    Waiting,
    Farewell,
    Stopping,
};

/// What is kept of a status: the latest of its kind and robot. The map's order is the order of section 6.
using StatusKey = std::pair<EAcsCommand, std::string>;

struct Status
{
    AcsPayload payload;
    bool bPending = false;
};

struct InFlight
{
    EAcsCommand command = EAcsCommand::Registration;
    std::string transactionID;
    std::string text;
    Core::SteadyTime deadline{};
    std::size_t resends = 0;
    bool bDurable = false;
    bool bSuperseded =
        false; ///< A newer status of the same robot has gone out: resending this one would go back in time.
    StatusKey statusKey{};
};

/// A transaction that has left the window: its late or second Ack must not be taken for that of another one.
struct RecentTransaction
{
    EAcsCommand command = EAcsCommand::Registration;
    std::string transactionID;
    bool bUnanswered = false;
};

StatusKey MakeStatusKey(const AcsPayload& payload)
{
    const RobotStatusUpdate* robotOrNull = std::get_if<RobotStatusUpdate>(&payload);
    return {GetCommand(payload), robotOrNull == nullptr ? std::string() : robotOrNull->robotID};
}

bool IsStatus(const AcsPayload& payload)
{
    return std::holds_alternative<TscStateUpdate>(payload) || std::holds_alternative<AcsCommStateUpdate>(payload)
        || std::holds_alternative<RobotStatusUpdate>(payload);
}

} // namespace

class AcsSession::Impl
{
    SessionOptions _options;
    Core::IRandom& _random;
    AcsCodec _codec;
    Core::Backoff _backoff;
    std::chrono::minutes _siteOffset;
    Detail::AnswerStore _answers;
    Detail::SessionOutput _output;

    EState _state = EState::Stopped;
    bool _bWasRegistered = false; ///< On this connection.
    bool _bReplayDone = false;
    bool _bRoomWanted = false;
    std::string _registrationID;
    std::string _farewellID;
    std::vector<InFlight> _inFlight;
    std::deque<RecentTransaction> _recent;
    std::size_t _unansweredInRow = 0;
    std::map<StatusKey, Status> _statuses;
    Core::SteadyTime _nextPosition{};
    std::string _scratch;

public:
    Impl(const SessionOptions& options, Core::IRandom& random)
        : _options(options),
          _random(random),
          _codec(options.codec),
          _backoff(options.reconnect),
          _siteOffset(options.codec.siteOffset),
          _answers(options.answerMemory, options.answerCount)
    {
        _options.window = std::max<std::size_t>(_options.window, 1);
        _inFlight.reserve(_options.window + 1);
    }

    void Start(SessionActions& out)
    {
        if (_state == EState::Stopped)
        {
            _state = EState::Connecting;
            out.emplace_back(Connect{});
        }
    }

    void Stop(Core::Now now, SessionActions& out)
    {
        switch (_state)
        {
            case EState::Registered:
                _output.Cancel(ESessionTimer::Position, out);
                _state = EState::Farewell;
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

    void OnConnected(Core::Now now, SessionActions& out)
    {
        if (_state != EState::Connecting)
        {
            return;
        }
        ++_output.statistics.connects;
        _state = EState::Registering;
        _registrationID = Core::MakeUuid(_random);
        AcsCodec::EncodeRequest({_registrationID, Detail::MakeTimestamp(now, _siteOffset), Registration{}}, _scratch);
        ++_output.statistics.Of(EAcsCommand::Registration).sent;
        out.emplace_back(SendText{0, _scratch, false});
        _output.Start(ESessionTimer::Registration, _options.ackTimeout, out);
    }

    void OnText(std::string_view text, Core::Now now, SessionActions& out)
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

    void OnClosed(std::string_view reason, Core::Now /*now*/, SessionActions& out)
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

    void OnTimer(ESessionTimer timer, Core::Now now, SessionActions& out)
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
            case ESessionTimer::DelayedAck:
            default:
                assert(false && "not a timer of this side");
                break;
        }
    }

    bool TrySendDurable(const AcsRequest& request, Core::Now now, SessionActions& out)
    {
        if (_state != EState::Registered)
        {
            return false;
        }
        const EAcsCommand command = GetCommand(request);
        if (Detail::FindPendingByID(_inFlight, command, request.transactionID).bFound)
        {
            return true;
        }
        if (GetRoom() == 0)
        {
            _bRoomWanted = true;
            return false;
        }
        std::erase_if(_recent, [&request](const RecentTransaction& recent) {
            return recent.transactionID == request.transactionID;
        });
        Send(request, true, {}, now, out);
        ArmAckTimer(now, out);
        return true;
    }

    void ReplayDone(Core::Now now, SessionActions& out)
    {
        if (_state != EState::Registered || _bReplayDone)
        {
            return;
        }
        _bReplayDone = true;
        UseRoom(now, out);
        if (_options.positionInterval.count() > 0)
        {
            _nextPosition = now.steady;
            SchedulePosition(now, out);
        }
    }

    void SendStatus(const AcsPayload& status, Core::Now now, SessionActions& out)
    {
        assert(IsStatus(status));
        if (IsStatus(status))
        {
            _statuses.insert_or_assign(MakeStatusKey(status), Status{status, true});
            UseRoom(now, out);
        }
    }

    void SendPosition(const RobotPositionUpdate& positions, Core::Now now, SessionActions& out)
    {
        if (_state != EState::Registered || !_bReplayDone)
        {
            return;
        }
        AcsCodec::EncodeRequest(
            {Core::MakeUuid(_random), Detail::MakeTimestamp(now, _siteOffset), positions},
            _scratch);
        ++_output.statistics.Of(EAcsCommand::RobotPositionUpdate).sent;
        out.emplace_back(SendText{0, _scratch, true});
    }

    void Answer(const AcsAck& answer, Core::Now now, SessionActions& out)
    {
        Detail::AnswerStore::Entry* entryOrNull = _answers.FindOrNull(answer.command, answer.transactionID, now);
        if (entryOrNull != nullptr && !entryOrNull->text.empty())
        {
            return;
        }
        AcsAck ack = answer;
        ack.timestamp = Detail::MakeTimestamp(now, _siteOffset);
        ack.bLegacyName = entryOrNull != nullptr && entryOrNull->bLegacyName;
        AcsCodec::EncodeAck(ack, _scratch);
        if (entryOrNull != nullptr)
        {
            entryOrNull->text = _scratch;
        }
        if (IsUp())
        {
            CountAnswer(answer.command, answer.result);
            out.emplace_back(SendText{0, _scratch, false});
        }
    }

    [[nodiscard]] bool IsRegistered() const noexcept
    {
        return _state == EState::Registered;
    }

    [[nodiscard]] std::size_t GetRoom() const noexcept
    {
        return _state == EState::Registered && _inFlight.size() < _options.window ? _options.window - _inFlight.size()
                                                                                  : 0;
    }

    void SetSiteOffset(std::chrono::minutes offset) noexcept
    {
        _siteOffset = offset;
    }

    [[nodiscard]] const SessionStatistics& GetStatistics() const noexcept
    {
        return _output.statistics;
    }

private:
    [[nodiscard]] bool IsUp() const noexcept
    {
        return _state == EState::Registered || _state == EState::Farewell;
    }

    /// Closes the connection; OnClosed goes on from the given state.
    void Leave(EState state, std::uint16_t code, std::string reason, SessionActions& out)
    {
        _output.CancelAll(out);
        _state = state;
        out.emplace_back(Close{0, code, std::move(reason)});
    }

    /// Everything that ends with the connection.
    void Forget(SessionActions& out)
    {
        _output.CancelAll(out);
        _inFlight.clear();
        _bWasRegistered = false;
        _bReplayDone = false;
        _bRoomWanted = false;
        _unansweredInRow = 0;
    }

    void End(SessionActions& out)
    {
        Forget(out);
        _state = EState::Stopped;
        out.emplace_back(Deliver{Stopped{}});
    }

    void CountAnswer(EAcsCommand command, EAckResult result)
    {
        CommandCounters& counters = _output.statistics.Of(command);
        ++counters.acknowledged;
        counters.refused += result == EAckResult::Fail ? 1U : 0U;
    }

    void Send(const AcsRequest& request, bool bDurable, StatusKey statusKey, Core::Now now, SessionActions& out)
    {
        InFlight& entry = _inFlight.emplace_back();
        entry.command = GetCommand(request);
        entry.transactionID = request.transactionID;
        entry.deadline = now.steady + _options.ackTimeout;
        entry.bDurable = bDurable;
        entry.statusKey = std::move(statusKey);
        AcsCodec::EncodeRequest(request, entry.text);
        ++_output.statistics.Of(entry.command).sent;
        out.emplace_back(SendText{0, entry.text, false});
    }

    std::string SendPayload(AcsPayload payload, StatusKey statusKey, Core::Now now, SessionActions& out)
    {
        AcsRequest request{Core::MakeUuid(_random), Detail::MakeTimestamp(now, _siteOffset), std::move(payload)};
        Send(request, false, std::move(statusKey), now, out);
        return std::move(request.transactionID);
    }

    /// After anything that may have made room or work: statuses first, then whoever was turned away.
    void UseRoom(Core::Now now, SessionActions& out)
    {
        if (_bReplayDone)
        {
            SendStatuses(now, out);
        }
        if (_bRoomWanted && GetRoom() > 0)
        {
            _bRoomWanted = false;
            out.emplace_back(Deliver{WindowOpened{}});
        }
        ArmAckTimer(now, out);
    }

    void SendStatuses(Core::Now now, SessionActions& out)
    {
        for (auto& [key, status] : _statuses)
        {
            if (!status.bPending)
            {
                continue;
            }
            if (GetRoom() == 0)
            {
                return;
            }
            for (InFlight& entry : _inFlight)
            {
                entry.bSuperseded = entry.bSuperseded || (!entry.bDurable && entry.statusKey == key);
            }
            status.bPending = false;
            static_cast<void>(SendPayload(status.payload, key, now, out));
        }
    }

    /// All deadlines lie equally far ahead, so that a timer that runs is never too late; one that is too early finds
    /// nothing and is started again.
    void ArmAckTimer(Core::Now now, SessionActions& out)
    {
        if (IsUp() && !_inFlight.empty() && !_output.IsRunning(ESessionTimer::Ack))
        {
            _output.Start(ESessionTimer::Ack, Detail::GetNextDelay(_inFlight, now), out);
        }
    }

    void ResendLate(Core::Now now, SessionActions& out)
    {
        std::vector<InFlight> entries = std::exchange(_inFlight, {});
        for (InFlight& entry : entries)
        {
            if (entry.deadline > now.steady)
            {
                _inFlight.push_back(std::move(entry));
            }
            else if (entry.bSuperseded)
            {
                Remember(entry, true);
            }
            else if (entry.resends < _options.ackRetries)
            {
                ++entry.resends;
                entry.deadline = now.steady + _options.ackTimeout;
                ++_output.statistics.Of(entry.command).sent;
                out.emplace_back(SendText{0, entry.text, false});
                _inFlight.push_back(std::move(entry));
            }
            else
            {
                GiveUp(entry, out);
            }
        }
        if (_unansweredInRow >= _options.ackDeadAfter && _state == EState::Registered)
        {
            Leave(EState::Closing, CLOSE_NORMAL, "no acknowledgements", out);
        }
    }

    void GiveUp(const InFlight& entry, SessionActions& out)
    {
        ++_unansweredInRow;
        Remember(entry, true);
        if (entry.bDurable)
        {
            out.emplace_back(Deliver{RequestUnanswered{entry.command, entry.transactionID}});
        }
    }

    void Remember(const InFlight& entry, bool bUnanswered)
    {
        if (_recent.size() >= RECENT_COUNT)
        {
            _recent.pop_front();
        }
        _recent.push_back({entry.command, entry.transactionID, bUnanswered && entry.bDurable});
    }

    void SchedulePosition(Core::Now now, SessionActions& out)
    {
        const auto late = now.steady - _nextPosition;
        _nextPosition += _options.positionInterval * (late / _options.positionInterval + 1);
        const auto delay = std::chrono::ceil<std::chrono::milliseconds>(_nextPosition - now.steady);
        _output.Start(ESessionTimer::Position, delay, out);
        out.emplace_back(Deliver{PositionDue{}});
    }

    void Refuse(const DecodeFailure& failure, bool bLegacyName, Core::Now now, SessionActions& out)
    {
        const bool bForUs = failure.command.has_value() && IsSentByMcs(*failure.command);
        const bool bKnown = failure.commandName.empty() || failure.bAck || bForUs;
        _output.Note(
            bKnown ? EProtocolNote::Undecodable : EProtocolNote::UnknownCommand,
            Core::Describe(failure.error),
            out);
        const bool bAnswerable =
            !failure.commandName.empty() && !failure.bAck && (!failure.command.has_value() || HasAck(*failure.command));
        if (!IsUp() || !bAnswerable)
        {
            return;
        }
        const Core::Timestamp timestamp = Detail::MakeTimestamp(now, _siteOffset);
        if (bForUs)
        {
            ++_output.statistics.Of(*failure.command).received;
            CountAnswer(*failure.command, EAckResult::Fail);
            AcsAck ack{*failure.command, failure.transactionID, timestamp, EAckResult::Fail, {}, {}, bLegacyName};
            ack.message = Detail::MakeRefusal(failure);
            ack.payload = Detail::MakeRefusalPayload(failure);
            AcsCodec::EncodeAck(ack, _scratch);
        }
        else
        {
            AcsCodec::EncodeRefusal(
                failure.commandName,
                failure.transactionID,
                timestamp,
                Detail::UNSUPPORTED,
                _scratch);
        }
        out.emplace_back(SendText{0, _scratch, false});
    }

    void HandleRequest(AcsRequest& request, bool bLegacyName, Core::Now now, SessionActions& out)
    {
        const EAcsCommand command = GetCommand(request);
        if (!IsUp())
        {
            _output.Note(EProtocolNote::BeforeRegistered, std::string(GetText(command)), out);
            return;
        }
        CommandCounters& counters = _output.statistics.Of(command);
        ++counters.received;
        if (!IsSentByMcs(command))
        {
            RefuseForeign(request, now, out);
            return;
        }
        const Detail::AnswerStore::Entry* entryOrNull = _answers.FindOrNull(command, request.transactionID, now);
        if (entryOrNull == nullptr)
        {
            _answers.Insert(command, request.transactionID, bLegacyName, now);
            out.emplace_back(Deliver{RequestReceived{std::move(request), false}});
            return;
        }
        ++counters.duplicates;
        _output.Note(EProtocolNote::DuplicateRequest, std::string(GetText(command)), out);
        if (!entryOrNull->text.empty())
        {
            out.emplace_back(SendText{0, entryOrNull->text, false});
        }
    }

    void RefuseForeign(const AcsRequest& request, Core::Now now, SessionActions& out)
    {
        const EAcsCommand command = GetCommand(request);
        _output.Note(EProtocolNote::UnknownCommand, std::string(GetText(command)), out);
        if (HasAck(command))
        {
            CountAnswer(command, EAckResult::Fail);
            AcsCodec::EncodeRefusal(
                GetText(command),
                request.transactionID,
                Detail::MakeTimestamp(now, _siteOffset),
                Detail::UNSUPPORTED,
                _scratch);
            out.emplace_back(SendText{0, _scratch, false});
        }
    }

    void HandleAck(const AcsAck& ack, SessionActions& out)
    {
        if (_state == EState::Registering && ack.command == EAcsCommand::Registration)
        {
            HandleRegistrationAck(ack, out);
            return;
        }
        Detail::PendingMatch match = Detail::FindPendingByID(_inFlight, ack.command, ack.transactionID);
        if (!match.bFound)
        {
            if (IsLateAck(ack, out))
            {
                return;
            }
            match = Detail::FindPendingByCommand(_inFlight, ack.command);
        }
        if (!match.bFound)
        {
            _output.Note(EProtocolNote::AckUnexpected, std::string(GetText(ack.command)), out);
            return;
        }
        if (match.bByCommand)
        {
            _output.Note(EProtocolNote::AckMismatched, std::string(GetText(ack.command)), out);
        }
        const InFlight entry = std::move(_inFlight[match.index]);
        _inFlight.erase(_inFlight.begin() + static_cast<std::ptrdiff_t>(match.index));
        Remember(entry, false);
        _unansweredInRow = 0;
        ++_output.statistics.Of(ack.command).answered;
        if (entry.bDurable)
        {
            out.emplace_back(Deliver{Acked{ack.command, entry.transactionID, ack.result, ack.message}});
        }
        else if (ack.result == EAckResult::Fail)
        {
            _output.Note(EProtocolNote::AckFailed, ack.message, out);
        }
        if (_state == EState::Farewell && entry.transactionID == _farewellID)
        {
            Leave(EState::Stopping, CLOSE_NORMAL, "shutting down", out);
        }
    }

    /// Whether the Ack belongs to what has left the window: the second one after a resend, or one that comes too late.
    [[nodiscard]] bool IsLateAck(const AcsAck& ack, SessionActions& out)
    {
        const auto found = std::find_if(_recent.begin(), _recent.end(), [&ack](const RecentTransaction& recent) {
            return recent.command == ack.command && recent.transactionID == ack.transactionID;
        });
        if (found == _recent.end())
        {
            return false;
        }
        if (std::exchange(found->bUnanswered, false))
        {
            _unansweredInRow = 0;
            ++_output.statistics.Of(ack.command).answered;
            out.emplace_back(Deliver{Acked{ack.command, ack.transactionID, ack.result, ack.message}});
        }
        else
        {
            _output.Note(EProtocolNote::AckUnexpected, std::string(GetText(ack.command)), out);
        }
        return true;
    }

    void HandleRegistrationAck(const AcsAck& ack, SessionActions& out)
    {
        ++_output.statistics.Of(EAcsCommand::Registration).answered;
        if (ack.transactionID != _registrationID)
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
        }
        out.emplace_back(Deliver{Registered{}});
    }
};

AcsSession::AcsSession(const SessionOptions& options, Core::IRandom& random)
    : _impl(std::make_unique<Impl>(options, random))
{
}

AcsSession::~AcsSession() = default;

void AcsSession::Start(Core::Now /*now*/, SessionActions& out)
{
    _impl->Start(out);
}

void AcsSession::Stop(Core::Now now, SessionActions& out)
{
    _impl->Stop(now, out);
}

void AcsSession::OnConnected(Core::Now now, SessionActions& out)
{
    _impl->OnConnected(now, out);
}

void AcsSession::OnText(std::string_view text, Core::Now now, SessionActions& out)
{
    _impl->OnText(text, now, out);
}

void AcsSession::OnClosed(std::string_view reason, Core::Now now, SessionActions& out)
{
    _impl->OnClosed(reason, now, out);
}

void AcsSession::OnTimer(ESessionTimer timer, Core::Now now, SessionActions& out)
{
    _impl->OnTimer(timer, now, out);
}

bool AcsSession::TrySendDurable(const AcsRequest& request, Core::Now now, SessionActions& out)
{
    return _impl->TrySendDurable(request, now, out);
}

void AcsSession::ReplayDone(Core::Now now, SessionActions& out)
{
    _impl->ReplayDone(now, out);
}

void AcsSession::SendStatus(const AcsPayload& status, Core::Now now, SessionActions& out)
{
    _impl->SendStatus(status, now, out);
}

void AcsSession::SendPosition(const RobotPositionUpdate& positions, Core::Now now, SessionActions& out)
{
    _impl->SendPosition(positions, now, out);
}

void AcsSession::Answer(
    EAcsCommand command,
    std::string_view transactionID,
    EAckResult result,
    std::string_view message,
    const AckPayload& payload,
    Core::Now now,
    SessionActions& out)
{
    _impl->Answer({command, std::string(transactionID), {}, result, std::string(message), payload, false}, now, out);
}

bool AcsSession::IsRegistered() const noexcept
{
    return _impl->IsRegistered();
}

std::size_t AcsSession::GetRoom() const noexcept
{
    return _impl->GetRoom();
}

void AcsSession::SetSiteOffset(std::chrono::minutes offset) noexcept
{
    _impl->SetSiteOffset(offset);
}

const SessionStatistics& AcsSession::GetStatistics() const noexcept
{
    return _impl->GetStatistics();
}

} // namespace ACS::Protocol
