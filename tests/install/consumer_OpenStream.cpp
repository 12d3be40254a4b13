// needs: nothing
#include <acs/openstream/OpenStreamCodec.hpp>

#include <cstdio>

int main()
{
    ACS::OpenStream::OpenStreamCodec codec;
    std::string text;
    ACS::OpenStream::OpenStreamCodec::EncodeRequest(ACS::OpenStream::HandshakeRequest{}, text);
    std::fputs(text.c_str(), stdout);
    return codec.DecodeRequest(text).has_value() ? 0 : 1;
}
