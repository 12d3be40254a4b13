#pragma once

#include <cstdint>
#include <optional>
#include <vector>

namespace ACS::VDA5050
{

/// The orderUpdateIds of one order: which were used, which the vehicle has accepted, and after which more nodes follow.
class OrderNumbers
{
    std::uint32_t _lastID = 0;
    std::optional<std::uint32_t> _acceptedIDOrNull;
    /// Of messages that were built with a horizon, from the accepted one on: more nodes follow, whether or not it was sent.
    std::vector<std::uint32_t> _continuedIDs;

public:
    OrderNumbers() = default;
    OrderNumbers(std::uint32_t lastID, std::vector<std::uint32_t> continuedIDs);

    /// The next number, above those that were used and the one that the vehicle shows; nullopt after the last one.
    [[nodiscard]] std::optional<std::uint32_t> TakeOrNull(std::uint32_t shownID);
    void SetContinued(std::uint32_t updateID);
    /// False: no number is left for the message.
    [[nodiscard]] bool TryRenumber(std::uint32_t& updateID, std::uint32_t shownID);
    /// updateID is that of the order's own message: the vehicle may show a later one, of which no content is known.
    void Accept(std::uint32_t updateID);

    [[nodiscard]] bool IsAccepted() const noexcept;
    /// Whether more nodes follow after the accepted message.
    [[nodiscard]] bool IsContinued() const;
};

} // namespace ACS::VDA5050
