#pragma once

#include <acs/core/Api.hpp>
#include <acs/vda5050/Topic.hpp>

#include <array>
#include <cstdint>

namespace ACS::VDA5050
{

/// The quality of service per topic: a profile, with changes for single topics.
class ACS_API QosTable
{
    std::array<std::uint8_t, TOPIC_COUNT> _levels{};

public:
    /// The default profile.
    QosTable();
    /// The levels of this profile (GetQos).
    explicit QosTable(EQosProfile profile);

    /// 0, 1 or 2.
    [[nodiscard]] std::uint8_t Get(ETopic topic) const;
    /// Requires qos 0, 1 or 2.
    void Set(ETopic topic, std::uint8_t qos);

    bool operator==(const QosTable&) const = default;
};

} // namespace ACS::VDA5050
