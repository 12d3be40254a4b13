#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Result.hpp>
#include <acs/vda5050/Header.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::VDA5050
{

/// The topics of 2.x (section 6.5 of the standard).
enum class ETopic : std::uint8_t
{
    Order,
    InstantActions,
    State,
    Visualization,
    Connection,
    Factsheet,
};

/// Number of enumerators of ETopic.
inline constexpr std::size_t TOPIC_COUNT = 6;

/// Project: order and instantActions 2, state and connection 1, others 0. Standard: connection 1, others 0.
enum class EQosProfile : std::uint8_t
{
    Project,
    Standard,
};

/// The last level of a topic: "order", "instantActions", …
[[nodiscard]] ACS_API std::string_view GetTopicName(ETopic topic);

/// Whether messages of this topic are published retained (connection and factsheet).
[[nodiscard]] ACS_API bool IsRetained(ETopic topic);

/// The quality of service of a profile; QosTable changes single topics of it.
[[nodiscard]] ACS_API std::uint8_t GetQos(ETopic topic, EQosProfile profile);

/// The address of a vehicle on the broker. A level has no `/`, `+`, `#` and no control characters, does not begin with `$`,
/// and is not empty.
struct VehicleAddress
{
    std::string interfaceName = "uagv"; ///< First level of the topic.
    std::string manufacturer;           ///< Third level, as in the header; the second one is the major version.
    std::string serialNumber;           ///< Fourth level, as in the header.

    bool operator==(const VehicleAddress&) const = default;
};

/// Whether each level is allowed in a topic.
[[nodiscard]] ACS_API bool IsValidAddress(const VehicleAddress& address);

/// Why the header does not belong to the vehicle of the topic; nullopt if it does. Empty names are accepted, because some
/// senders omit them.
[[nodiscard]] ACS_API std::optional<Core::Error> FindForeignNameOrNull(
    const Header& header,
    const VehicleAddress& address);

/// "uagv/v2/KIT/0001": the topics of the vehicle without their last level.
[[nodiscard]] ACS_API std::string BuildTopicPrefix(const VehicleAddress& address);

/// "uagv/v2/KIT/0001/order"
[[nodiscard]] ACS_API std::string BuildTopic(const VehicleAddress& address, ETopic topic);

/// The filter for one topic of all vehicles: "uagv/v2/+/+/connection".
[[nodiscard]] ACS_API std::string BuildTopicFilter(std::string_view interfaceName, ETopic topic);

/// The parts of a topic name.
struct ParsedTopic
{
    VehicleAddress address;       ///< Valid (IsValidAddress).
    ETopic topic = ETopic::Order; ///< According to the last level.

    bool operator==(const ParsedTopic&) const = default;
};

/// Fails with InvalidTopic, or with UnsupportedVersion if only the major version is not 2.
[[nodiscard]] ACS_API Core::Result<ParsedTopic> ParseTopic(std::string_view text);

} // namespace ACS::VDA5050
