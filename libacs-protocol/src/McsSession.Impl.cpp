#include "McsSession.Impl.hpp"

#include "PendingRequests.hpp"

#include <algorithm>
#include <cassert>
#include <utility>
#include <variant>

namespace ACS::Protocol
{

McsSession::Impl::Impl(const McsSessionOptions& options, Core::IRandom& random)
    : _options(options),
      _random(random),
      _codec(options.codec),
      _siteOffset(options.codec.siteOffset),
      _recent(options.maximumPending),
      _seen(options.duplicateMemory, options.answerBytes)
{
}

bool McsSession::Impl::ShouldRefuseUpgrade() const noexcept
{
    return _options.bSecondRefused && !_connections.empty();
}

void McsSession::Impl::OnConnected(ConnectionID connection, Core::Now now, SessionActions& out)
{
    ++_output.statistics.connects;
    _connections.push_back(connection);
    _unregistered.push_back({connection, now.steady + _options.registrationTimeout});
    ArmRegistrationTimer(now, out);
}

void McsSession::Impl::OnText(ConnectionID connection, std::string_view text, Core::Now now, SessionActions& out)
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

void McsSession::Impl::OnClosed(ConnectionID connection, std::string_view reason, SessionActions& out)
{
    std::erase(_connections, connection);
    RemoveUnregistered(connection, out);
    std::erase_if(_unanswered, [connection](const UnansweredRequest& unanswered) {
        return unanswered.command == EAcsCommand::Registration && unanswered.connection == connection;
    });
    if (_unanswered.empty())
    {
        _output.Cancel(ESessionTimer::Answer, out);
    }
    if (_registered == connection)
    {
        EndRegistration(EUnansweredReason::LinkLost, reason, out);
    }
}

void McsSession::Impl::OnTimer(ESessionTimer timer, Core::Now now, SessionActions& out)
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
            ResendOverdue(now, out);
            break;
        case ESessionTimer::Answer:
            GiveUpOverdue(now, out);
            break;
        case ESessionTimer::Reconnect:
        case ESessionTimer::Position:
        case ESessionTimer::Shutdown:
        default:
            assert(false && "a timer of the other side");
            break;
    }
}

const std::optional<ConnectionID>& McsSession::Impl::GetRegisteredOrNull() const noexcept
{
    return _registered;
}

void McsSession::Impl::SetSiteOffset(std::chrono::minutes offset) noexcept
{
    _siteOffset = offset;
    _codec.SetSiteOffset(offset);
}

const SessionStatistics& McsSession::Impl::GetStatistics() const noexcept
{
    return _output.statistics;
}

void McsSession::Impl::ArmRegistrationTimer(Core::Now now, SessionActions& out)
{
    if (!_unregistered.empty() && !_output.IsRunning(ESessionTimer::Registration))
    {
        _output.Start(ESessionTimer::Registration, Detail::GetNextDelay(_unregistered, now), out);
    }
}

void McsSession::Impl::RemoveUnregistered(ConnectionID connection, SessionActions& out)
{
    std::erase_if(_unregistered, [connection](const UnregisteredConnection& unregistered) {
        return unregistered.id == connection;
    });
    if (_unregistered.empty())
    {
        _output.Cancel(ESessionTimer::Registration, out);
    }
}

void McsSession::Impl::CloseUnregistered(Core::Now now, SessionActions& out)
{
    for (const UnregisteredConnection& unregistered : _unregistered)
    {
        if (unregistered.deadline <= now.steady)
        {
            std::erase(_connections, unregistered.id); // what it sends until it is closed is ignored
            out.emplace_back(Close{unregistered.id, CLOSE_POLICY, "no Registration has come"});
        }
    }
    std::erase_if(_unregistered, [now](const UnregisteredConnection& unregistered) {
        return unregistered.deadline <= now.steady;
    });
    ArmRegistrationTimer(now, out);
}

void McsSession::Impl::EndRegistration(EUnansweredReason reason, std::string_view text, SessionActions& out)
{
    _output.Cancel(ESessionTimer::Ack, out);
    _registered.reset();
    ++_output.statistics.linkLosses;
    for (const PendingRequest& request : std::exchange(_pending, {}))
    {
        Abandon(request, reason, out);
    }
    out.emplace_back(Deliver{LinkLost{std::string(text), true}});
}

} // namespace ACS::Protocol
