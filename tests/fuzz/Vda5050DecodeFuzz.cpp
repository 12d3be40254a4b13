#include "FuzzCheck.hpp"
#include <acs/vda5050/Vda5050Codec.hpp>

#include <string>
#include <string_view>
#include <type_traits>

namespace
{

using namespace ACS; // NOLINT(google-build-using-namespace)

/// A message in one version: encoded, decoded and encoded again.
template <typename TMessage>
void CheckVersion(VDA5050::Vda5050Codec& codec, const TMessage& message, VDA5050::EVda5050Version version)
{
    const std::string text = codec.Encode(message, version);
    const Core::Result<TMessage> second = codec.Decode<TMessage>(text);
    Fuzz::Require(second.has_value(), "what was encoded can be decoded");
    Fuzz::Require(codec.GetTolerance() == VDA5050::DecodeTolerance{}, "what is sent needs no tolerance");
    const std::string again = codec.Encode(*second, version);
    Fuzz::Require(text == again, "decode, encode, decode, encode gives the same bytes");
    const Core::Result<TMessage> third = codec.Decode<TMessage>(again);
    Fuzz::Require(third.has_value() && *third == *second, "what a version knows of a message stays the same");
}

template <typename TMessage>
void CheckMessage(VDA5050::Vda5050Codec& codec, std::string_view payload)
{
    const Core::Result<TMessage> message = codec.Decode<TMessage>(payload);
    if (!message)
    {
        Fuzz::Require(static_cast<bool>(message.error().code), "an error has a code");
        return;
    }
    CheckVersion(codec, *message, VDA5050::EVda5050Version::Version200);
    CheckVersion(codec, *message, VDA5050::EVda5050Version::Version210);
    if constexpr (std::is_same_v<TMessage, VDA5050::OrderMessage>)
    {
        const Core::Result<VDA5050::MessageIdentity> identity = codec.DecodeIdentity(payload);
        Fuzz::Require(
            identity.has_value() && identity->orderID == message->orderID
                && identity->orderUpdateID == message->orderUpdateID
                && identity->header.headerID == message->header.headerID,
            "DecodeIdentity returns the ids of every order that can be decoded");
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    // One codec for all inputs, as in a session: a text must have no effect on the next one.
    static VDA5050::Vda5050Codec codec;
    const std::string_view payload = Fuzz::AsText(data, size);
    CheckMessage<VDA5050::OrderMessage>(codec, payload);
    CheckMessage<VDA5050::InstantActionsMessage>(codec, payload);
    CheckMessage<VDA5050::StateMessage>(codec, payload);
    CheckMessage<VDA5050::VisualizationMessage>(codec, payload);
    CheckMessage<VDA5050::ConnectionMessage>(codec, payload);
    CheckMessage<VDA5050::FactsheetMessage>(codec, payload);
    static_cast<void>(codec.DecodeIdentity(payload));
    return 0;
}
