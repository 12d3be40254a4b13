#include "FuzzCheck.hpp"
#include <acs/plan/StoreCodec.hpp>

#include <string>

namespace
{

using namespace ACS;           // NOLINT(google-build-using-namespace)
using namespace ACS::Planning; // NOLINT(google-build-using-namespace)

/// A record that can be read is written as a text that is read as the same record.
template <typename TDecode, typename TEncode>
void Check(std::string_view text, TDecode decode, TEncode encode)
{
    const auto first = decode(text);
    if (first.has_value())
    {
        const std::string written = encode(*first);
        const auto second = decode(written);
        Fuzz::Require(second.has_value(), "what was encoded can be decoded");
        Fuzz::Require(encode(*second) == written, "decode, encode, decode, encode gives an equal text");
    }
}

} // namespace

/// A text of a store, damaged in any way, as each kind of record.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    const std::string_view text = Fuzz::AsText(data, size);
    Check(text, DecodePlan, EncodePlan);
    Check(text, DecodeProgress, EncodeProgress);
    Check(text, DecodeReport, EncodeReport);
    Check(text, DecodeCarriers, EncodeCarriers);
    Check(text, DecodeRobotWork, EncodeRobotWork);
    Check(text, DecodeAlarm, EncodeAlarm);
    return 0;
}
