#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <string>
#include <vector>

namespace ACS::McsSim
{

/// Lets plans that claim the same thing go one after the other, in the order in which they were added.
class PlanTurns
{
    std::map<std::string, std::deque<std::size_t>> _queues; ///< Of plans, by claim.
    std::map<std::size_t, std::vector<std::string>> _claims;

public:
    /// Each plan once, with an index above all before it.
    void Add(std::size_t plan, std::vector<std::string> claims);

    /// Whether no earlier plan claims anything that this one claims. True for one that was not added or has ended.
    [[nodiscard]] bool IsFirst(std::size_t plan) const;

    /// The plans whose turn it is now because this one has ended.
    [[nodiscard]] std::vector<std::size_t> End(std::size_t plan);
};

} // namespace ACS::McsSim
