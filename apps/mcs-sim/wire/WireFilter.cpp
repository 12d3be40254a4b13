#include "wire/WireFilter.hpp"

#include <variant>

namespace ACS::McsSim
{

using Protocol::EAcsCommand;

bool WireFilter::ShouldPass(
    ProtocolBeast::EWireDirection direction,
    Protocol::ConnectionID connection,
    std::string_view text)
{
    if (direction == ProtocolBeast::EWireDirection::Out)
    {
        if (IsAcceptance(text))
        {
            _registered = connection;
        }
        return false;
    }
    return _registered == connection || IsRegistration(text);
}

bool WireFilter::IsAcceptance(std::string_view text)
{
    if (text.find("RegistrationAck") == std::string_view::npos)
    {
        return false; // Most texts: they are not decoded for nothing.
    }
    const Protocol::DecodeOutcome outcome = _codec.Decode(text);
    const auto* const ackOrNull =
        outcome.message.has_value() ? std::get_if<Protocol::AcsAck>(&*outcome.message) : nullptr;
    return ackOrNull != nullptr && ackOrNull->command == EAcsCommand::Registration
        && ackOrNull->result == Protocol::EAckResult::Success;
}

bool WireFilter::IsRegistration(std::string_view text)
{
    const Protocol::DecodeOutcome outcome = _codec.Decode(text);
    if (!outcome.message.has_value())
    {
        const Protocol::DecodeFailure& failure = outcome.message.error();
        return failure.command == EAcsCommand::Registration && !failure.bAck;
    }
    const auto* const requestOrNull = std::get_if<Protocol::AcsRequest>(&*outcome.message);
    return requestOrNull != nullptr && GetCommand(*requestOrNull) == EAcsCommand::Registration;
}

} // namespace ACS::McsSim
