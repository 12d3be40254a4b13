#include "McsSession.Impl.hpp"
#include "PendingRequests.hpp"

#include <algorithm>
#include <utility>
#include <variant>

namespace ACS::Protocol
{

bool McsSession::Impl::TryAnswer(
    AnswerToken token,
    EAckResult result,
    std::string_view message,
    Core::Now now,
    SessionActions& out)
{
    const auto found = std::find_if(_unanswered.begin(), _unanswered.end(), [token](const UnansweredRequest& request) {
        return request.token == token;
    });
    if (found == _unanswered.end())
    {
        return false;
    }
    const UnansweredRequest request = std::move(*found);
    _unanswered.erase(found);
    if (_unanswered.empty())
    {
        _output.Cancel(ESessionTimer::Answer, out);
    }
    if (request.command != EAcsCommand::Registration)
    {
        AnswerFirst(request.connection, request.command, request.transactionID, result, message, now, out);
    }
    else if (result == EAckResult::Success)
    {
        AcceptRegistration(request.connection, request.transactionID, message, now, out);
    }
    else
    {
        RefuseRegistration(request.connection, request.transactionID, message, now, out);
    }
    return true;
}

std::size_t McsSession::Impl::GetUnansweredCount() const noexcept
{
    return _unanswered.size();
}

void McsSession::Impl::Refuse(ConnectionID connection, const DecodeFailure& failure, Core::Now now, SessionActions& out)
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

void McsSession::Impl::HandleRequest(ConnectionID connection, AcsRequest& request, Core::Now now, SessionActions& out)
{
    const EAcsCommand command = GetCommand(request);
    ++_output.statistics.Of(command).received;
    if (command == EAcsCommand::Registration)
    {
        Register(connection, request, now, out);
        return;
    }
    const auto refuse = [&](EProtocolNote note, std::string_view message) {
        _output.Note(note, std::string(GetText(command)), out);
        SendAnswer(connection, command, request.transactionID, MakeAnswer(EAckResult::Fail, message, now), out);
    };
    if (_registered != connection)
    {
        refuse(EProtocolNote::BeforeRegistered, "Register first.");
    }
    else if (IsSentByMCS(command))
    {
        refuse(EProtocolNote::UnknownCommand, Detail::UNSUPPORTED);
    }
    else if (!HasAck(command))
    {
        // Positions arrive five times a second and are never resent.
        out.emplace_back(Deliver{RequestReceived{std::move(request), false, connection, NO_ANSWER}});
    }
    else if (_options.answeredByApplication.test(static_cast<std::size_t>(command)))
    {
        AskForAnswer(connection, request, now, out);
    }
    else
    {
        AnswerReport(connection, request, now, out);
    }
}

void McsSession::Impl::Register(ConnectionID connection, AcsRequest& request, Core::Now now, SessionActions& out)
{
    if (_registered.has_value() && _options.bSecondRefused)
    {
        RefuseRegistration(connection, request.transactionID, "An ACS is registered already.", now, out);
        return;
    }
    RemoveUnregistered(connection, out);
    const bool bAsked = _options.answeredByApplication.test(static_cast<std::size_t>(EAcsCommand::Registration));
    if (!bAsked || _registered == connection)
    {
        AcceptRegistration(connection, request.transactionID, "Registered.", now, out);
        return;
    }
    UnansweredRequest* const waitingOrNull = FindUnansweredOrNull(connection, request);
    if (waitingOrNull == nullptr)
    {
        Await(connection, request, false, now, out);
    }
    else if (waitingOrNull->transactionID != request.transactionID)
    {
        const std::string former = std::exchange(waitingOrNull->transactionID, request.transactionID);
        SendAnswer(
            connection,
            EAcsCommand::Registration,
            former,
            MakeAnswer(EAckResult::Fail, "Another Registration has followed.", now),
            out);
    }
}

void McsSession::Impl::AcceptRegistration(
    ConnectionID connection,
    std::string_view transactionID,
    std::string_view message,
    Core::Now now,
    SessionActions& out)
{
    if (_options.bSecondRefused && _registered.value_or(connection) != connection)
    {
        RefuseRegistration(connection, transactionID, "An ACS is registered already.", now, out);
        return;
    }
    if (_registered.value_or(connection) != connection)
    {
        out.emplace_back(Close{*_registered, CLOSE_POLICY, "replaced by a new connection"});
        std::erase(_connections, *_registered); // what it sends until it is closed is ignored
        EndRegistration(EUnansweredReason::Replaced, "replaced by a new connection", out);
    }
    SendAnswer(
        connection,
        EAcsCommand::Registration,
        transactionID,
        MakeAnswer(EAckResult::Success, message, now),
        out);
    if (_registered != connection)
    {
        _registered = connection;
        _bAcsConnected = true;
        ++_output.statistics.registrations;
        out.emplace_back(Deliver{Registered{}});
    }
}

void McsSession::Impl::RefuseRegistration(
    ConnectionID connection,
    std::string_view transactionID,
    std::string_view message,
    Core::Now now,
    SessionActions& out)
{
    SendAnswer(connection, EAcsCommand::Registration, transactionID, MakeAnswer(EAckResult::Fail, message, now), out);
    out.emplace_back(Close{connection, CLOSE_POLICY, "the registration was refused"});
    std::erase(_connections, connection); // what it sends until it is closed is ignored
    RemoveUnregistered(connection, out);
}

void McsSession::Impl::AnswerReport(ConnectionID connection, AcsRequest& request, Core::Now now, SessionActions& out)
{
    const EAcsCommand command = GetCommand(request);
    const bool bDuplicate = !_seen.TryInsert(command, request.transactionID);
    _output.statistics.Of(command).duplicates += bDuplicate ? 1U : 0U;
    if (const auto* const givenOrNull = _seen.FindAnswerOrNull(command, request.transactionID); givenOrNull != nullptr)
    {
        SendAnswer(connection, command, request.transactionID, *givenOrNull, out);
    }
    else
    {
        AnswerFirst(connection, command, request.transactionID, EAckResult::Success, "Received.", now, out);
    }
    if (const auto* const stateOrNull = std::get_if<AcsCommStateUpdate>(&request.payload);
        stateOrNull != nullptr && !bDuplicate)
    {
        _bAcsConnected = stateOrNull->bConnected;
    }
    out.emplace_back(Deliver{RequestReceived{std::move(request), bDuplicate, connection, NO_ANSWER}});
}

void McsSession::Impl::AskForAnswer(ConnectionID connection, AcsRequest& request, Core::Now now, SessionActions& out)
{
    const EAcsCommand command = GetCommand(request);
    CommandCounters& counters = _output.statistics.Of(command);
    if (UnansweredRequest* const waitingOrNull = FindUnansweredOrNull(connection, request); waitingOrNull != nullptr)
    {
        ++counters.duplicates;
        waitingOrNull->connection = connection; // where the answer is expected now
        return;
    }
    if (const auto* const givenOrNull = _seen.FindAnswerOrNull(command, request.transactionID); givenOrNull != nullptr)
    {
        ++counters.duplicates;
        SendAnswer(connection, command, request.transactionID, *givenOrNull, out);
        return;
    }
    const auto reports = static_cast<std::size_t>(
        std::count_if(_unanswered.begin(), _unanswered.end(), [](const UnansweredRequest& unanswered) {
            return unanswered.command != EAcsCommand::Registration;
        }));
    if (reports >= _options.maximumUnanswered)
    {
        if (_options.unansweredPolicy == EUnansweredPolicy::Fail)
        {
            AnswerFirst(
                connection,
                command,
                request.transactionID,
                EAckResult::Fail,
                "Too many requests wait for an answer of the MCS.",
                now,
                out);
        }
        out.emplace_back(Deliver{RequestGivenUp{command, std::move(request.transactionID), NO_ANSWER}});
        return;
    }
    const bool bDuplicate = !_seen.TryInsert(command, request.transactionID);
    counters.duplicates += bDuplicate ? 1U : 0U;
    if (const auto* const stateOrNull = std::get_if<AcsCommStateUpdate>(&request.payload);
        stateOrNull != nullptr && !bDuplicate)
    {
        _bAcsConnected = stateOrNull->bConnected;
    }
    Await(connection, request, bDuplicate, now, out);
}

void McsSession::Impl::Await(
    ConnectionID connection,
    AcsRequest& request,
    bool bDuplicate,
    Core::Now now,
    SessionActions& out)
{
    const Core::SteadyTime deadline = now.steady + _options.answerTimeout;
    _unanswered.push_back({++_lastToken, GetCommand(request), request.transactionID, connection, deadline});
    out.emplace_back(Deliver{RequestReceived{std::move(request), bDuplicate, connection, _lastToken}});
    ArmAnswerTimer(now, out);
}

Detail::UnansweredRequest* McsSession::Impl::FindUnansweredOrNull(ConnectionID connection, const AcsRequest& request)
{
    const EAcsCommand command = GetCommand(request);
    const bool bRegistration = command == EAcsCommand::Registration;
    const auto found = std::find_if(_unanswered.begin(), _unanswered.end(), [&](const UnansweredRequest& unanswered) {
        return unanswered.command == command
            && (bRegistration ? unanswered.connection == connection
                              : unanswered.transactionID == request.transactionID);
    });
    return found == _unanswered.end() ? nullptr : &*found;
}

void McsSession::Impl::GiveUpOverdue(Core::Now now, SessionActions& out)
{
    std::vector<UnansweredRequest> waiting;
    for (UnansweredRequest& request : std::exchange(_unanswered, {}))
    {
        if (request.deadline > now.steady)
        {
            waiting.push_back(std::move(request));
            continue;
        }
        constexpr std::string_view MESSAGE = "The MCS has not answered in time.";
        if (request.command == EAcsCommand::Registration)
        {
            RefuseRegistration(request.connection, request.transactionID, MESSAGE, now, out);
        }
        else if (_options.unansweredPolicy == EUnansweredPolicy::Fail)
        {
            AnswerFirst(
                request.connection,
                request.command,
                request.transactionID,
                EAckResult::Fail,
                MESSAGE,
                now,
                out);
        }
        out.emplace_back(Deliver{RequestGivenUp{request.command, std::move(request.transactionID), request.token}});
    }
    _unanswered = std::move(waiting);
    ArmAnswerTimer(now, out);
}

void McsSession::Impl::ArmAnswerTimer(Core::Now now, SessionActions& out)
{
    if (!_unanswered.empty() && !_output.IsRunning(ESessionTimer::Answer))
    {
        _output.Start(ESessionTimer::Answer, Detail::GetNextDelay(_unanswered, now), out);
    }
}

void McsSession::Impl::AnswerFirst(
    ConnectionID connection,
    EAcsCommand command,
    std::string_view transactionID,
    EAckResult result,
    std::string_view message,
    Core::Now now,
    SessionActions& out)
{
    Detail::GivenAnswer answer = MakeAnswer(result, message, now);
    if (_registered == connection)
    {
        SendAnswer(connection, command, transactionID, answer, out);
    }
    _seen.KeepAnswer(command, transactionID, std::move(answer));
}

void McsSession::Impl::SendAnswer(
    ConnectionID connection,
    EAcsCommand command,
    std::string_view transactionID,
    const Detail::GivenAnswer& answer,
    SessionActions& out)
{
    if (!HasAck(command))
    {
        return;
    }
    _output.statistics.Of(command).CountAnswer(answer.result);
    AcsCodec::EncodeAck(
        {command, std::string(transactionID), answer.timestamp, answer.result, answer.message, EmptyAck{}, false},
        _scratch);
    out.emplace_back(SendText{connection, _scratch, false});
}

Detail::GivenAnswer McsSession::Impl::MakeAnswer(EAckResult result, std::string_view message, Core::Now now) const
{
    return {result, std::string(message), Detail::MakeTimestamp(now, _siteOffset)};
}

} // namespace ACS::Protocol
