#include "AcsSession.Impl.hpp"
#include "PendingRequests.hpp"

#include <functional>
#include <string>
#include <utility>
#include <variant>

namespace ACS::Protocol
{

void AcsSession::Impl::Answer(const AcsAck& answer, Core::Now now, SessionActions& out)
{
    const Detail::AnswerCache::Entry* entryOrNull = _answers.FindOrNull(answer.command, answer.transactionID, now);
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
        _answers.KeepText(answer.command, answer.transactionID, _scratch);
    }
    if (IsUp())
    {
        _output.statistics.Of(answer.command).CountAnswer(answer.result);
        out.emplace_back(SendText{0, _scratch, false});
    }
}

void AcsSession::Impl::Refuse(const DecodeFailure& failure, bool bLegacyName, Core::Now now, SessionActions& out)
{
    const Detail::ERefusal refusal = _output.NoteFailure(failure, true, out);
    if (!IsUp() || refusal == Detail::ERefusal::None)
    {
        return;
    }
    out.emplace_back(Deliver{RequestRefused{
        failure.commandName,
        failure.transactionID,
        failure.planID,
        failure.error.path,
        refusal == Detail::ERefusal::Failed ? Detail::MakeRefusal(failure) : std::string(Detail::UNSUPPORTED)}});
    const Core::Timestamp timestamp = Detail::MakeTimestamp(now, _siteOffset);
    if (refusal == Detail::ERefusal::Failed)
    {
        CommandCounters& counters = _output.statistics.Of(*failure.command);
        ++counters.received;
        counters.CountAnswer(EAckResult::Fail);
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

/// Of what the request asks for: a repetition may be written otherwise, and at another time.
std::uint64_t AcsSession::Impl::MakeDigest(AcsRequest& request)
{
    const Core::Timestamp timestamp = std::exchange(request.timestamp, {});
    AcsCodec::EncodeRequest(request, _scratch);
    request.timestamp = timestamp;
    return std::hash<std::string>{}(_scratch);
}

/// D-23: the answer to another request is none to this one.
DecodeFailure AcsSession::Impl::DescribeReuse(const AcsRequest& request)
{
    const EAcsCommand command = GetCommand(request);
    DecodeFailure failure;
    failure.error = {
        Core::ECoreError::InvalidIdentifier,
        "transactionId",
        "one that no other " + std::string(GetText(command)) + " had",
        Core::QuoteForError(request.transactionID)};
    failure.commandName = GetText(command);
    failure.command = command;
    failure.transactionID = request.transactionID;
    failure.planID = Detail::GetPlanID(request.payload);
    return failure;
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
    if (!IsSentByMCS(command))
    {
        ++counters.received;
        RefuseForeign(request, now, out);
        return;
    }
    const std::uint64_t digest = MakeDigest(request);
    const Detail::AnswerCache::Entry* entryOrNull = _answers.FindOrNull(command, request.transactionID, now);
    if (entryOrNull != nullptr && entryOrNull->digest != digest)
    {
        Refuse(DescribeReuse(request), bLegacyName, now, out);
        return;
    }
    ++counters.received;
    if (entryOrNull == nullptr)
    {
        _answers.Insert(command, request.transactionID, bLegacyName, digest, now);
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
        _output.statistics.Of(command).CountAnswer(EAckResult::Fail);
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
