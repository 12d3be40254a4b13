#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace ACS::Planning
{

/// Which robot holds which node of the map; a node has one holder at most. Robots and nodes by index.
class Reservations
{
    std::vector<std::optional<std::size_t>> _holders;

public:
    explicit Reservations(std::size_t nodeCount);

    [[nodiscard]] std::optional<std::size_t> GetHolderOrNull(std::size_t node) const;
    [[nodiscard]] bool IsFreeFor(std::size_t node, std::size_t robot) const;

    /// All of them or, where another robot holds one, none and false.
    [[nodiscard]] bool TryClaim(std::span<const std::size_t> nodes, std::size_t robot);

    void Release(std::size_t node, std::size_t robot);

    /// Everything that the robot holds, but for the node where it stands.
    void ReleaseAllBut(std::optional<std::size_t> node, std::size_t robot);
    void ReleaseAllBut(std::span<const std::size_t> nodes, std::size_t robot);
};

} // namespace ACS::Planning
