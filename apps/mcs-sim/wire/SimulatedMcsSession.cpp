#include "wire/SimulatedMcsSession.hpp"

#include <acs/core/Timestamp.hpp>

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>

namespace ACS::McsSim
{

using Protocol::EAckResult;
using Protocol::EAcsCommand;
using Protocol::SessionActions;

SimulatedMcsSession::SimulatedMcsSession(
    const Protocol::McsSessionOptions& options,
    const McsBehaviour& behaviour,
    Core::IRandom& random,
    DelayHandler onDelay)
    : _session(options, random),
      _codec(options.codec),
      _behaviour(behaviour),
      _onDelay(std::move(onDelay)),
      _siteOffset(options.codec.siteOffset)
{
}

bool SimulatedMcsSession::ShouldRefuseUpgrade() const noexcept
{
    return _session.ShouldRefuseUpgrade();
}

void SimulatedMcsSession::OnConnected(Protocol::ConnectionID connection, Core::Now now, SessionActions& out)
{
    _session.OnConnected(connection, now, out);
}

void SimulatedMcsSession::OnText(
    Protocol::ConnectionID connection,
    std::string_view text,
    Core::Now now,
    SessionActions& out)
{
    text = GetReadPart(text);
    if (ShouldIntercept(connection, text, now, out))
    {
        return;
    }
    SessionActions actions;
    _session.OnText(connection, text, now, actions);
    Filter(actions, now, out);
}

bool SimulatedMcsSession::TryAnswer(
    Protocol::AnswerToken token,
    EAckResult result,
    std::string_view message,
    Core::Now now,
    SessionActions& out)
{
    SessionActions actions;
    const bool bTaken = _session.TryAnswer(token, result, message, now, actions);
    Filter(actions, now, out);
    return bTaken;
}

std::size_t SimulatedMcsSession::GetUnansweredCount() const noexcept
{
    return _session.GetUnansweredCount();
}

void SimulatedMcsSession::OnClosed(
    Protocol::ConnectionID connection,
    std::string_view reason,
    Core::Now now,
    SessionActions& out)
{
    std::erase_if(_delayed, [connection](const DelayedText& delayed) { return delayed.connection == connection; });
    _session.OnClosed(connection, reason, now, out);
}

void SimulatedMcsSession::OnTimer(Protocol::ESessionTimer timer, Core::Now now, SessionActions& out)
{
    const std::optional<std::chrono::milliseconds> held = GetHeldTimeOrNull(now);
    if (timer == Protocol::ESessionTimer::Registration && held.has_value())
    {
        // The session would close the connection: it has not seen the Registration.
        out.emplace_back(Protocol::StartTimer{timer, *held});
        return;
    }
    _session.OnTimer(timer, now, out);
}

Protocol::AcsRequest SimulatedMcsSession::MakeRequest(Protocol::AcsPayload payload, Core::Now now)
{
    return _session.MakeRequest(std::move(payload), now);
}

bool SimulatedMcsSession::TrySend(const Protocol::AcsRequest& request, Core::Now now, SessionActions& out)
{
    const std::size_t first = out.size();
    const bool bSent = _session.TrySend(request, now, out);
    for (std::size_t i = first; _behaviour.bNullResults && i < out.size(); ++i)
    {
        if (auto* const sendOrNull = std::get_if<Protocol::SendText>(&out[i]); sendOrNull != nullptr)
        {
            sendOrNull->text.pop_back(); // the brace
            sendOrNull->text += R"(,"result":null,"message":null})";
        }
    }
    return bSent;
}

bool SimulatedMcsSession::IsTakingPlans() const noexcept
{
    return _session.IsTakingPlans();
}

std::optional<Protocol::ConnectionID> SimulatedMcsSession::GetRegisteredOrNull() const noexcept
{
    return _session.GetRegisteredOrNull();
}

std::size_t SimulatedMcsSession::GetPendingCount() const noexcept
{
    return _session.GetPendingCount();
}

const Protocol::SessionStatistics& SimulatedMcsSession::GetStatistics() const noexcept
{
    _statistics = _session.GetStatistics();
    for (std::size_t i = 0; i < Protocol::COMMAND_COUNT; ++i)
    {
        _statistics.commands[i].acknowledged -= _unsent.commands[i].acknowledged;
        _statistics.commands[i].refused -= _unsent.commands[i].refused;
    }
    Protocol::CommandCounters& registrations = _statistics.Of(EAcsCommand::Registration);
    registrations.received += _intercepted.received;
    registrations.acknowledged += _intercepted.acknowledged;
    registrations.refused += _intercepted.refused;
    return _statistics;
}

bool SimulatedMcsSession::TrySendText(std::string_view text, SessionActions& out) const
{
    const std::optional<Protocol::ConnectionID> registered = _session.GetRegisteredOrNull();
    if (registered.has_value())
    {
        out.emplace_back(Protocol::SendText{*registered, std::string(text), false});
    }
    return registered.has_value();
}

void SimulatedMcsSession::HoldAcks(const AckHold& hold, Core::Now now)
{
    std::erase_if(_holds, [now](const ActiveHold& active) { return active.end <= now.steady; });
    _holds.push_back({hold, now.steady + hold.duration, ++_faults});
}

void SimulatedMcsSession::RefuseRegistrations(std::size_t count, std::string_view message)
{
    _refusalNumber = ++_faults;
    _refusalsLeft = count;
    _refusalMessage = message;
}

void SimulatedMcsSession::EndFaults() noexcept
{
    _holds.clear();
    _refusalsLeft = 0;
}

void SimulatedMcsSession::SendDelayed(Core::Now now, SessionActions& out)
{
    const auto later = std::stable_partition(_delayed.begin(), _delayed.end(), [now](const DelayedText& delayed) {
        return delayed.deadline <= now.steady;
    });
    const std::vector<DelayedText> due(std::make_move_iterator(_delayed.begin()), std::make_move_iterator(later));
    _delayed.erase(_delayed.begin(), later);
    for (const DelayedText& delayed : due)
    {
        if (delayed.bRegistration)
        {
            _session.OnText(delayed.connection, delayed.text, now, out);
        }
        else
        {
            out.emplace_back(Protocol::SendText{delayed.connection, delayed.text, false});
        }
    }
    RequestDelay(now);
}

void SimulatedMcsSession::Drop(std::uint16_t code, std::string_view reason, SessionActions& out) const
{
    if (const std::optional<Protocol::ConnectionID> registered = _session.GetRegisteredOrNull(); registered.has_value())
    {
        out.emplace_back(Protocol::Close{*registered, code, std::string(reason)});
    }
}

std::string_view SimulatedMcsSession::GetReadPart(std::string_view text) const
{
    const std::size_t chunk = _behaviour.finalChunkBytes;
    return chunk == 0 || text.size() <= chunk ? text : text.substr((text.size() - 1) / chunk * chunk);
}

const SimulatedMcsSession::ActiveHold* SimulatedMcsSession::FindHoldOrNull(EAcsCommand command, Core::Now now) const
{
    const auto found = std::find_if(_holds.rbegin(), _holds.rend(), [command, now](const ActiveHold& active) {
        return active.hold.command.value_or(command) == command && now.steady < active.end;
    });
    return found == _holds.rend() ? nullptr : &*found;
}

bool SimulatedMcsSession::ShouldIntercept(
    Protocol::ConnectionID connection,
    std::string_view text,
    Core::Now now,
    SessionActions& out)
{
    const ActiveHold* const activeOrNull = FindHoldOrNull(EAcsCommand::Registration, now);
    if (activeOrNull == nullptr && _refusalsLeft == 0)
    {
        return false;
    }
    const Protocol::DecodeOutcome outcome = _codec.Decode(text);
    const auto* const requestOrNull =
        outcome.message.has_value() ? std::get_if<Protocol::AcsRequest>(&*outcome.message) : nullptr;
    if (requestOrNull == nullptr || GetCommand(*requestOrNull) != EAcsCommand::Registration)
    {
        return false;
    }
    // Of a refusal and Acks that are withheld the later one applies.
    const bool bRefusedLater = _refusalsLeft > 0 && activeOrNull != nullptr && _refusalNumber > activeOrNull->number;
    const bool bWithheld = activeOrNull != nullptr && !activeOrNull->hold.delay.has_value() && !bRefusedLater;
    const bool bRefused = _refusalsLeft > 0 && !bWithheld;
    DelayedText delayed{connection, std::string(text), now.steady, true};
    if (bRefused)
    {
        --_refusalsLeft;
        delayed.bRegistration = false;
        Protocol::AcsCodec::EncodeAck(
            {EAcsCommand::Registration,
             requestOrNull->transactionID,
             Core::Timestamp{std::chrono::floor<std::chrono::milliseconds>(now.wall), _siteOffset},
             EAckResult::Fail,
             _refusalMessage,
             Protocol::EmptyAck{},
             false},
            delayed.text);
    }
    if (bRefused || bWithheld)
    {
        ++_intercepted.received;
    }
    if (bWithheld)
    {
        return true;
    }
    if (bRefused)
    {
        _intercepted.CountAnswer(EAckResult::Fail);
    }
    if (activeOrNull == nullptr || !activeOrNull->hold.delay.has_value())
    {
        out.emplace_back(Protocol::SendText{connection, delayed.text, false});
        return true;
    }
    delayed.deadline += *activeOrNull->hold.delay;
    Delay(std::move(delayed), now);
    return true;
}

void SimulatedMcsSession::Filter(SessionActions& actions, Core::Now now, SessionActions& out)
{
    std::vector<Protocol::ConnectionID> closed;
    for (const Protocol::SessionAction& action : actions)
    {
        if (const auto* const closeOrNull = std::get_if<Protocol::Close>(&action); closeOrNull != nullptr)
        {
            closed.push_back(closeOrNull->connection);
        }
    }
    for (Protocol::SessionAction& action : actions)
    {
        const auto* const sendOrNull = std::get_if<Protocol::SendText>(&action);
        const bool bConnectionRefused =
            sendOrNull != nullptr && std::find(closed.begin(), closed.end(), sendOrNull->connection) != closed.end();
        if (ShouldKeep(action, bConnectionRefused, now))
        {
            out.push_back(std::move(action));
        }
    }
}

bool SimulatedMcsSession::ShouldKeep(Protocol::SessionAction& action, bool bConnectionRefused, Core::Now now)
{
    if (auto* const deliverOrNull = std::get_if<Protocol::Deliver>(&action); deliverOrNull != nullptr)
    {
        const auto* const receivedOrNull = std::get_if<Protocol::RequestReceived>(&deliverOrNull->event);
        if (_behaviour.bPositionsUnknown && receivedOrNull != nullptr
            && GetCommand(receivedOrNull->request) == EAcsCommand::RobotPositionUpdate)
        {
            deliverOrNull->event = Protocol::ProtocolNoted{
                Protocol::EProtocolNote::UnknownCommand,
                1,
                std::string(GetText(EAcsCommand::RobotPositionUpdate))};
        }
        return true;
    }
    auto* const sendOrNull = std::get_if<Protocol::SendText>(&action);
    if (sendOrNull == nullptr || (_holds.empty() && !_behaviour.bErrorsUnanswered))
    {
        return true;
    }
    const Protocol::DecodeOutcome outcome = _codec.Decode(sendOrNull->text);
    const auto* const ackOrNull =
        outcome.message.has_value() ? std::get_if<Protocol::AcsAck>(&*outcome.message) : nullptr;
    // The Ack of a command that the codec does not know is a refusal as well.
    const EAckResult result = ackOrNull == nullptr ? EAckResult::Fail : ackOrNull->result;
    const ActiveHold* const activeOrNull = ackOrNull == nullptr ? nullptr : FindHoldOrNull(ackOrNull->command, now);
    const AckHold* const holdOrNull = activeOrNull == nullptr ? nullptr : &activeOrNull->hold;
    const bool bUnanswered = _behaviour.bErrorsUnanswered && result == EAckResult::Fail && !bConnectionRefused;
    if (bUnanswered || (holdOrNull != nullptr && !holdOrNull->delay.has_value()))
    {
        if (ackOrNull != nullptr)
        {
            _unsent.Of(ackOrNull->command).CountAnswer(result);
        }
        return false;
    }
    if (holdOrNull == nullptr)
    {
        return true;
    }
    Delay({sendOrNull->connection, std::move(sendOrNull->text), now.steady + *holdOrNull->delay, false}, now);
    return false;
}

void SimulatedMcsSession::Delay(DelayedText delayed, Core::Now now)
{
    _delayed.push_back(std::move(delayed));
    RequestDelay(now);
}

std::optional<std::chrono::milliseconds> SimulatedMcsSession::GetHeldTimeOrNull(Core::Now now) const
{
    std::optional<std::chrono::milliseconds> time;
    for (const DelayedText& delayed : _delayed)
    {
        if (_session.GetRegisteredOrNull() != delayed.connection)
        {
            const auto rest = std::chrono::ceil<std::chrono::milliseconds>(delayed.deadline - now.steady);
            // One that is due is sent within a millisecond. A timer of 0 would expire again and again until then.
            time = std::max(time.value_or(std::chrono::milliseconds(1)), rest);
        }
    }
    return time;
}

void SimulatedMcsSession::RequestDelay(Core::Now now) const
{
    const auto next = std::ranges::min_element(_delayed, {}, &DelayedText::deadline);
    if (next != _delayed.end())
    {
        _onDelay(std::max(
            std::chrono::milliseconds(0),
            std::chrono::ceil<std::chrono::milliseconds>(next->deadline - now.steady)));
    }
}

} // namespace ACS::McsSim
