#pragma once

#include <acs/vda5050/StateMessage.hpp>

#include <cstddef>
#include <string>
#include <string_view>

namespace ACS::VDA5050
{

/// The keys of references (best practice of section 7.1). topic is always sent: some masters know a rejection by it.
namespace ReferenceKeys
{
inline constexpr std::string_view TOPIC = "topic";
inline constexpr std::string_view HEADER_ID = "headerId";
inline constexpr std::string_view ORDER_ID = "orderId";
inline constexpr std::string_view ORDER_UPDATE_ID = "orderUpdateId";
inline constexpr std::string_view ACTION_ID = "actionId";
inline constexpr std::string_view NODE_ID = "nodeId";
inline constexpr std::string_view EDGE_ID = "edgeId";
inline constexpr std::string_view MAP_ID = "mapId";
inline constexpr std::string_view PARAMETER = "parameter"; ///< The name of the wrong field.
} // namespace ReferenceKeys

/// Of a text that came from outside, in bytes: an error repeats it, and a state repeats the error.
inline constexpr std::size_t LONGEST_FOREIGN_TEXT = 1024;

/// The text, or as many bytes of it; no character is cut in two.
[[nodiscard]] inline std::string_view CutForeignText(std::string_view text, std::size_t maximum = LONGEST_FOREIGN_TEXT)
{
    std::size_t size = text.size();
    if (size > maximum)
    {
        size = maximum;
        while (size > 0 && (static_cast<unsigned char>(text[size]) & 0xC0U) == 0x80U)
        {
            --size;
        }
    }
    return text.substr(0, size);
}

inline void AddReference(VehicleError& error, std::string_view key, std::string_view value)
{
    error.errorReferences.push_back(ErrorReference{std::string(key), std::string(CutForeignText(value))});
}

} // namespace ACS::VDA5050
