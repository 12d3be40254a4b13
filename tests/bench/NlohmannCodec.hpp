#pragma once

#include <acs/protocol/AcsMessage.hpp>

#include <string>
#include <string_view>

namespace ACS::Bench
{

/// The two messages of the benchmark as one would read and write them with nlohmann-json: for comparison only. Throws
/// where the text is another message.
class NlohmannCodec
{
public:
    NlohmannCodec() = delete;

    [[nodiscard]] static Protocol::AcsRequest Decode(std::string_view text);
    [[nodiscard]] static std::string Encode(const Protocol::AcsRequest& request);
};

} // namespace ACS::Bench
