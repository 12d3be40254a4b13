#include "ShownMessage.hpp"

#include "Arguments.hpp"
#include <acs/core/Result.hpp>
#include <acs/protocol/AcsCodec.hpp>

#include <utility>
#include <variant>

namespace ACS::CInterface
{

std::int32_t ShownMessage::Assign(const Protocol::DecodeOutcome& outcome)
{
    ShownMessage next;
    const Protocol::DecodeNotes& notes = outcome.notes;
    next._notes = notes.unknownMembers + notes.nullOptionals + notes.lenientWords + notes.lenientNumbers
        + notes.badTimestamps + (outcome.bLegacyName ? 1U : 0U);
    if (!outcome.message.has_value())
    {
        const Protocol::DecodeFailure& failure = outcome.message.error();
        next._command = failure.commandName;
        next._transactionID = failure.transactionID;
        next._errorSentence = Core::Describe(failure.error);
        next._error = failure.error;
        *this = std::move(next);
        return ACS_ERROR_MESSAGE;
    }
    if (const auto* const ackOrNull = std::get_if<Protocol::AcsAck>(&*outcome.message))
    {
        next._kind = ACS_KIND_ACK;
        next._result = ackOrNull->result == Protocol::EAckResult::Success ? ACS_RESULT_SUCCESS : ACS_RESULT_FAIL;
        next._command = Protocol::GetText(ackOrNull->command);
        next._transactionID = ackOrNull->transactionID;
        next._message = ackOrNull->message;
    }
    else
    {
        const auto& request = std::get<Protocol::AcsRequest>(*outcome.message);
        next._kind = ACS_KIND_REQUEST;
        next._command = Protocol::GetText(Protocol::GetCommand(request));
        next._transactionID = request.transactionID;
    }
    Protocol::AcsCodec::Encode(*outcome.message, next._text);
    *this = std::move(next);
    return ACS_OK;
}

void ShownMessage::Show(acs_message& out) const
{
    out.kind = _kind;
    out.result = _result;
    out.notes = _notes;
    out.command = ShowText(_command);
    out.transaction_id = ShowText(_transactionID);
    out.text = ShowText(_text);
    out.message = ShowText(_message);
    out.error = ShowText(_errorSentence);
    out.error_path = ShowText(_error.path);
    out.error_expected = ShowText(_error.expected);
    out.error_found = ShowText(_error.found);
}

} // namespace ACS::CInterface
