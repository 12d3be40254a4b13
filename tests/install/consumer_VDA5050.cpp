// needs: nothing
#include <acs/vda5050/Vda5050Codec.hpp>

#include <cstdio>

int main()
{
    using namespace ACS::VDA5050;
    ConnectionMessage message;
    message.header.serialNumber = "LR01";
    message.connectionState = EConnectionState::Online;
    Vda5050Codec codec;
    const std::string text = codec.Encode(message, EVda5050Version::Version210);
    std::puts(text.c_str());
    return codec.Decode<ConnectionMessage>(text) == message ? 0 : 1;
}
