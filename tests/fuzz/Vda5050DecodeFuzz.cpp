#include "FuzzCheck.hpp"
#include <acs/vda5050/Vda5050Codec.hpp>

#include <string>
#include <string_view>

namespace
{

using namespace ACS; // NOLINT(google-build-using-namespace)

template <typename TMessage>
void CheckMessage(VDA5050::Vda5050Codec& codec, std::string_view payload)
{
    const Core::Result<TMessage> first = codec.Decode<TMessage>(payload);
    if (!first)
    {
        return;
    }
    // What 2.0 does not know is left out there: only 2.1 writes everything that was read.
    const std::string text = codec.Encode(*first, VDA5050::EVda5050Version::Version210);
    const Core::Result<TMessage> second = codec.Decode<TMessage>(text);
    Fuzz::Require(second.has_value(), "what was encoded can be decoded");
    const std::string again = codec.Encode(*second, VDA5050::EVda5050Version::Version210);
    Fuzz::Require(text == again, "decode, encode, decode, encode gives the same bytes");
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view payload = Fuzz::AsText(data, size);
    VDA5050::Vda5050Codec codec;
    CheckMessage<VDA5050::OrderMessage>(codec, payload);
    CheckMessage<VDA5050::InstantActionsMessage>(codec, payload);
    CheckMessage<VDA5050::StateMessage>(codec, payload);
    CheckMessage<VDA5050::VisualizationMessage>(codec, payload);
    CheckMessage<VDA5050::ConnectionMessage>(codec, payload);
    CheckMessage<VDA5050::FactsheetMessage>(codec, payload);
    static_cast<void>(codec.DecodeIdentity(payload));
    return 0;
}
