#include "FuzzCheck.hpp"
#include <acs/protocol/AcsCodec.hpp>

#include <string>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace ACS; // NOLINT(google-build-using-namespace)
    // One codec for all inputs, as in a session: a text must have no effect on the next one.
    static Protocol::AcsCodec codec;
    const Protocol::DecodeOutcome first = codec.Decode(Fuzz::AsText(data, size));
    if (first.message)
    {
        std::string text;
        Protocol::AcsCodec::Encode(*first.message, text);
        const Protocol::DecodeOutcome second = codec.Decode(text);
        Fuzz::Require(second.message.has_value(), "what was encoded can be decoded");
        Fuzz::Require(*second.message == *first.message, "decode, encode, decode gives an equal message");
        Fuzz::Require(second.notes == Protocol::DecodeNotes{}, "what is sent needs no tolerance");
        std::string again;
        Protocol::AcsCodec::Encode(*second.message, again);
        Fuzz::Require(again == text, "an equal message has the same bytes");
    }
    return 0;
}
