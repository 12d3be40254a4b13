#include "PendingRequests.hpp"
#include "RecentTransactions.hpp"
#include "SessionOutput.hpp"
#include "TransactionMemory.hpp"
#include <acs/core/Uuid.hpp>
#include <acs/protocol/AcsCodec.hpp>
#include <acs/protocol/McsSession.hpp>

#include <algorithm>
#include <cassert>
#include <optional>
#include <utility>
#include <vector>

namespace ACS::Protocol
{

namespace
{

struct PendingRequest
{
    EAcsCommand command = EAcsCommand::ExecutionPlan;
    std::string transactionID;
    Core::SteadyTime deadline{};
};

struct Connection
{
    ConnectionID id = 0;
    Core::SteadyTime deadline{}; ///< For its Registration.
};

} // namespace

class McsSession::Impl
{
    McsSessionOptions _options;
    Core::IRandom& _random;
    AcsCodec _codec;
    std::chrono::minutes _siteOffset;
    Detail::SessionOutput _output;

    std::vector<ConnectionID> _connections; ///< All open connections.
    std::vector<Connection> _unregistered;  ///< Open connections without a Registration.
    std::optional<ConnectionID> _registered;
    bool _bAcsConnected = true; ///< The last AcsCommStateUpdate of the registered ACS.
    std::vector<PendingRequest> _pending;
    Detail::RecentTransactions _recent;
    Detail::TransactionMemory _seen;
    std::string _scratch;

public:
    Impl(const McsSessionOptions& options, Core::IRandom& random)
        : _options(options),
          _random(random),
          _codec(options.codec),
          _siteOffset(options.codec.siteOffset),
          _seen(options.duplicateMemory)
    {
    }

    [[nodiscard]] bool ShouldRefuseUpgrade() const noexcept
    {
        return _options.bSecondRefused && !_connections.empty();
    }

    void OnConnected(ConnectionID connection, Core::Now now, SessionActions& out)
    {
        ++_output.statistics.connects;
        _connections.push_back(connection);
        _unregistered.push_back({connection, now.steady + _options.registrationTimeout});
        ArmRegistrationTimer(now, out);
    }

    void OnText(ConnectionID connection, std::string_view text, Core::Now now, SessionActions& out)
    {
        if (std::find(_connections.begin(), _connections.end(), connection) == _connections.end())
        {
            return;
        }
        DecodeOutcome outcome = _codec.Decode(text);
        _output.NoteAll(outcome.notes, out);
        if (!outcome.message.has_value())
        {
            Refuse(connection, outcome.message.error(), now, out);
        }
        else if (AcsRequest* requestOrNull = std::get_if<AcsRequest>(&*outcome.message))
        {
            HandleRequest(connection, *requestOrNull, now, out);
        }
        else if (_registered == connection)
        {
            HandleAck(std::get<AcsAck>(*outcome.message), out);
        }
        else
        {
            _output.Note(EProtocolNote::BeforeRegistered, "an Ack", out);
        }
        ArmAckTimer(now, out);
    }

    void OnClosed(ConnectionID connection, std::string_view reason, SessionActions& out)
    {
        std::erase(_connections, connection);
        RemoveUnregistered(connection, out);
        if (_registered == connection)
        {
            EndRegistration(reason, out);
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
                CloseUnregistered(now, out);
                break;
            case ESessionTimer::Ack:
                AbandonOverdue(now, out);
                break;
            case ESessionTimer::Reconnect:
            case ESessionTimer::Position:
            case ESessionTimer::Shutdown:
            default:
                assert(false && "a timer of the other side");
                break;
        }
    }

    AcsRequest MakeRequest(AcsPayload payload, Core::Now now)
    {
        return {Core::MakeUUID(_random), Detail::MakeTimestamp(now, _siteOffset), std::move(payload)};
    }

    bool TrySend(const AcsRequest& request, Core::Now now, SessionActions& out)
    {
        if (!_registered.has_value() || _pending.size() >= _options.maximumPending)
        {
            return false;
        }
        const EAcsCommand command = GetCommand(request);
        if (command == EAcsCommand::ExecutionPlan && _options.bPlansWithheld && !_bAcsConnected)
        {
            return false;
        }
        AcsCodec::EncodeRequest(request, _scratch);
        ++_output.statistics.Of(command).sent;
        out.emplace_back(SendText{*_registered, _scratch, false});
        _pending.push_back({command, request.transactionID, now.steady + _options.ackTimeout});
        ArmAckTimer(now, out);
        return true;
    }

    [[nodiscard]] const std::optional<ConnectionID>& GetRegisteredOrNull() const noexcept
    {
        return _registered;
    }

    [[nodiscard]] bool IsTakingPlans() const noexcept
    {
        return _registered.has_value() && _bAcsConnected;
    }

    [[nodiscard]] std::size_t GetPendingCount() const noexcept
    {
        return _pending.size();
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
    void ArmRegistrationTimer(Core::Now now, SessionActions& out)
    {
        if (!_unregistered.empty() && !_output.IsRunning(ESessionTimer::Registration))
        {
            _output.Start(ESessionTimer::Registration, Detail::GetNextDelay(_unregistered, now), out);
        }
    }

    void RemoveUnregistered(ConnectionID connection, SessionActions& out)
    {
        std::erase_if(_unregistered, [connection](const Connection& unregistered) {
            return unregistered.id == connection;
        });
        if (_unregistered.empty())
        {
            _output.Cancel(ESessionTimer::Registration, out);
        }
    }

    void CloseUnregistered(Core::Now now, SessionActions& out)
    {
        for (const Connection& unregistered : _unregistered)
        {
            if (unregistered.deadline <= now.steady)
            {
                out.emplace_back(Close{unregistered.id, CLOSE_POLICY, "no Registration has come"});
            }
        }
        std::erase_if(_unregistered, [now](const Connection& unregistered) {
            return unregistered.deadline <= now.steady;
        });
        ArmRegistrationTimer(now, out);
    }

    void Abandon(const PendingRequest& request, SessionActions& out)
    {
        _recent.Remember(request.command, request.transactionID, true);
        out.emplace_back(Deliver{RequestUnanswered{request.command, request.transactionID}});
    }

    void AbandonOverdue(Core::Now now, SessionActions& out)
    {
        for (const PendingRequest& request : _pending)
        {
            if (request.deadline <= now.steady)
            {
                Abandon(request, out);
            }
        }
        std::erase_if(_pending, [now](const PendingRequest& request) { return request.deadline <= now.steady; });
        ArmAckTimer(now, out);
    }

    void ArmAckTimer(Core::Now now, SessionActions& out)
    {
        if (!_pending.empty() && !_output.IsRunning(ESessionTimer::Ack))
        {
            _output.Start(ESessionTimer::Ack, Detail::GetNextDelay(_pending, now), out);
        }
    }

    void EndRegistration(std::string_view reason, SessionActions& out)
    {
        _output.Cancel(ESessionTimer::Ack, out);
        _registered.reset();
        ++_output.statistics.linkLosses;
        for (const PendingRequest& request : std::exchange(_pending, {}))
        {
            Abandon(request, out);
        }
        out.emplace_back(Deliver{LinkLost{std::string(reason), true}});
    }

    void Acknowledge(
        ConnectionID connection,
        const AcsRequest& request,
        EAckResult result,
        std::string_view message,
        Core::Now now,
        SessionActions& out)
    {
        const EAcsCommand command = GetCommand(request);
        if (!HasAck(command))
        {
            return;
        }
        _output.statistics.Of(command).CountAnswer(result);
        const Core::Timestamp timestamp = Detail::MakeTimestamp(now, _siteOffset);
        AcsCodec::EncodeAck(
            {command, request.transactionID, timestamp, result, std::string(message), EmptyAck{}, false},
            _scratch);
        out.emplace_back(SendText{connection, _scratch, false});
    }

    void Refuse(ConnectionID connection, const DecodeFailure& failure, Core::Now now, SessionActions& out)
    {
        const Detail::ERefusal refusal = _output.NoteFailure(failure, false, out);
        if (refusal == Detail::ERefusal::None)
        {
            return;
        }
        if (refusal == Detail::ERefusal::Failed)
        {
            CommandCounters& counters = _output.statistics.Of(*failure.command);
            ++counters.received;
            counters.CountAnswer(EAckResult::Fail);
        }
        AcsCodec::EncodeRefusal(
            failure.commandName,
            failure.transactionID,
            Detail::MakeTimestamp(now, _siteOffset),
            refusal == Detail::ERefusal::Failed ? Detail::MakeRefusal(failure) : std::string(Detail::UNSUPPORTED),
            _scratch);
        out.emplace_back(SendText{connection, _scratch, false});
    }

    void HandleRequest(ConnectionID connection, AcsRequest& request, Core::Now now, SessionActions& out)
    {
        const EAcsCommand command = GetCommand(request);
        if (command == EAcsCommand::Registration)
        {
            ++_output.statistics.Of(command).received;
            Register(connection, request, now, out);
            return;
        }
        if (_registered != connection)
        {
            _output.Note(EProtocolNote::BeforeRegistered, std::string(GetText(command)), out);
            Acknowledge(connection, request, EAckResult::Fail, "Register first.", now, out);
            return;
        }
        CommandCounters& counters = _output.statistics.Of(command);
        ++counters.received;
        if (IsSentByMCS(command))
        {
            _output.Note(EProtocolNote::UnknownCommand, std::string(GetText(command)), out);
            Acknowledge(connection, request, EAckResult::Fail, Detail::UNSUPPORTED, now, out);
            return;
        }
        // Positions arrive five times a second and are never resent.
        const bool bDuplicate = HasAck(command) && !_seen.TryInsert(command, request.transactionID);
        counters.duplicates += bDuplicate ? 1U : 0U;
        Acknowledge(connection, request, EAckResult::Success, "Received.", now, out);
        if (const AcsCommStateUpdate* stateOrNull = std::get_if<AcsCommStateUpdate>(&request.payload);
            stateOrNull != nullptr && !bDuplicate)
        {
            _bAcsConnected = stateOrNull->bConnected;
        }
        out.emplace_back(Deliver{RequestReceived{std::move(request), bDuplicate}});
    }

    void Register(ConnectionID connection, const AcsRequest& request, Core::Now now, SessionActions& out)
    {
        if (_registered.has_value() && _options.bSecondRefused)
        {
            Acknowledge(connection, request, EAckResult::Fail, "An ACS is registered already.", now, out);
            out.emplace_back(Close{connection, CLOSE_POLICY, "an ACS is registered already"});
            return;
        }
        RemoveUnregistered(connection, out);
        if (_registered.value_or(connection) != connection)
        {
            out.emplace_back(Close{*_registered, CLOSE_POLICY, "replaced by a new connection"});
            EndRegistration("replaced by a new connection", out);
        }
        Acknowledge(connection, request, EAckResult::Success, "Registered.", now, out);
        if (_registered != connection)
        {
            _registered = connection;
            _bAcsConnected = true;
            ++_output.statistics.registrations;
            out.emplace_back(Deliver{Registered{}});
        }
    }

    void HandleAck(AcsAck& ack, SessionActions& out)
    {
        Detail::PendingMatch match = Detail::FindPendingByID(_pending, ack.command, ack.transactionID);
        if (!match.bFound)
        {
            const Detail::ELateAck late = _recent.TakeAck(ack.command, ack.transactionID);
            if (late == Detail::ELateAck::Late)
            {
                ++_output.statistics.Of(ack.command).answered;
                out.emplace_back(Deliver{AckReceived{std::move(ack)}});
                return;
            }
            if (late != Detail::ELateAck::Repeated)
            {
                match = Detail::FindPendingByCommand(_pending, ack.command);
            }
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
        ++_output.statistics.Of(ack.command).answered;
        ack.transactionID = std::move(_pending[match.index].transactionID);
        _recent.Remember(ack.command, ack.transactionID, false);
        _pending.erase(_pending.begin() + static_cast<std::ptrdiff_t>(match.index));
        out.emplace_back(Deliver{AckReceived{std::move(ack)}});
    }
};

McsSession::McsSession(const McsSessionOptions& options, Core::IRandom& random)
    : _impl(std::make_unique<Impl>(options, random))
{
}

McsSession::~McsSession() = default;

bool McsSession::ShouldRefuseUpgrade() const noexcept
{
    return _impl->ShouldRefuseUpgrade();
}

void McsSession::OnConnected(ConnectionID connection, Core::Now now, SessionActions& out)
{
    _impl->OnConnected(connection, now, out);
}

void McsSession::OnText(ConnectionID connection, std::string_view text, Core::Now now, SessionActions& out)
{
    _impl->OnText(connection, text, now, out);
}

void McsSession::OnClosed(ConnectionID connection, std::string_view reason, Core::Now /*now*/, SessionActions& out)
{
    _impl->OnClosed(connection, reason, out);
}

void McsSession::OnTimer(ESessionTimer timer, Core::Now now, SessionActions& out)
{
    _impl->OnTimer(timer, now, out);
}

AcsRequest McsSession::MakeRequest(AcsPayload payload, Core::Now now)
{
    return _impl->MakeRequest(std::move(payload), now);
}

bool McsSession::TrySend(const AcsRequest& request, Core::Now now, SessionActions& out)
{
    return _impl->TrySend(request, now, out);
}

std::optional<ConnectionID> McsSession::GetRegisteredOrNull() const noexcept
{
    return _impl->GetRegisteredOrNull();
}

bool McsSession::IsRegistered() const noexcept
{
    return _impl->GetRegisteredOrNull().has_value();
}

bool McsSession::IsTakingPlans() const noexcept
{
    return _impl->IsTakingPlans();
}

std::size_t McsSession::GetPendingCount() const noexcept
{
    return _impl->GetPendingCount();
}

void McsSession::SetSiteOffset(std::chrono::minutes offset) noexcept
{
    _impl->SetSiteOffset(offset);
}

const SessionStatistics& McsSession::GetStatistics() const noexcept
{
    return _impl->GetStatistics();
}

} // namespace ACS::Protocol
