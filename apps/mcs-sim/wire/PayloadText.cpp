#include "wire/PayloadText.hpp"

#include <acs/protocol/AcsCodec.hpp>

#include <fmt/format.h>

#include <utility>
#include <variant>

namespace ACS::McsSim
{

Core::Result<Protocol::AcsPayload> ParsePayload(Protocol::EAcsCommand command, const Core::JsonText& payload)
{
    Protocol::AcsCodec codec;
    Protocol::DecodeOutcome outcome = codec.Decode(fmt::format(
        R"({{"command":"{}","transactionId":"-","timestamp":"1970-01-01T00:00:00Z","payload":{}}})",
        GetText(command),
        payload.GetText()));
    if (!outcome.message.has_value())
    {
        return tl::make_unexpected(std::move(outcome.message.error().error));
    }
    return std::move(std::get<Protocol::AcsRequest>(*outcome.message).payload);
}

} // namespace ACS::McsSim
