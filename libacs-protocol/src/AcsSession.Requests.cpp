#include "AcsSession.Impl.hpp"

#include <utility>

namespace ACS::Protocol
{

void AcsSession::Impl::Answer(const AcsAck& answer, Core::Now now, SessionActions& out)
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

void AcsSession::Impl::CountAnswer(EAcsCommand command, EAckResult result)
{
    CommandCounters& counters = _output.statistics.Of(command);
    ++counters.acknowledged;
    counters.refused += result == EAckResult::Fail ? 1U : 0U;
}

void AcsSession::Impl::Refuse(const DecodeFailure& failure, bool bLegacyName, Core::Now now, SessionActions& out)
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
        AcsCodec::EncodeRefusal(failure.commandName, failure.transactionID, timestamp, Detail::UNSUPPORTED, _scratch);
    }
    out.emplace_back(SendText{0, _scratch, false});
}

void AcsSession::Impl::HandleRequest(AcsRequest& request, bool bLegacyName, Core::Now now, SessionActions& out)
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

void AcsSession::Impl::RefuseForeign(const AcsRequest& request, Core::Now now, SessionActions& out)
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

} // namespace ACS::Protocol
