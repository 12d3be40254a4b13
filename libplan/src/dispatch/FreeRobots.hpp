#pragma once

#include "robot/Fleet.hpp"

#include <cstddef>
#include <map>
#include <span>
#include <vector>

namespace ACS::Planning
{

/// The robots to which plans may be assigned, during one pass over the queue. Many plans have the same candidates: which of
/// them are free is determined once.
class FreeRobots
{
    std::vector<Robot*> _robots;
    std::map<const std::size_t*, std::vector<Robot*>>
        _ofCandidates; ///< By the first element of ResolvedPlan::candidates.

public:
    explicit FreeRobots(Fleet& fleet);

    [[nodiscard]] bool IsEmpty() const noexcept;
    /// Those among the candidates, in their order.
    [[nodiscard]] const std::vector<Robot*>& List(std::span<const std::size_t> candidates);
    /// The robot has got a plan.
    void Remove(const Robot& robot);
};

} // namespace ACS::Planning
