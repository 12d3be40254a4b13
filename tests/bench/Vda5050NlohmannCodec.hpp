#pragma once

#include <acs/vda5050/OrderMessage.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <string>
#include <string_view>

namespace ACS::Bench
{

/// Orders and states of 2.0 as one would read and write them with nlohmann-json: for comparison only. Throws where the
/// text is another message.
class Vda5050NlohmannCodec
{
public:
    Vda5050NlohmannCodec() = delete;

    template <typename TMessage>
    [[nodiscard]] static TMessage Decode(std::string_view text);
    [[nodiscard]] static std::string Encode(const VDA5050::OrderMessage& order);
    [[nodiscard]] static std::string Encode(const VDA5050::StateMessage& state);
};

template <>
VDA5050::OrderMessage Vda5050NlohmannCodec::Decode(std::string_view text);
template <>
VDA5050::StateMessage Vda5050NlohmannCodec::Decode(std::string_view text);

} // namespace ACS::Bench
