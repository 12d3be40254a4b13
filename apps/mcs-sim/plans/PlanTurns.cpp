#include "plans/PlanTurns.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace ACS::McsSim
{

void PlanTurns::Add(std::size_t plan, std::vector<std::string> claims)
{
    for (const std::string& claim : claims)
    {
        _queues[claim].push_back(plan);
    }
    _claims.emplace(plan, std::move(claims));
}

bool PlanTurns::IsFirst(std::size_t plan) const
{
    const auto found = _claims.find(plan);
    return found == _claims.end()
        || std::all_of(found->second.begin(), found->second.end(), [this, plan](const std::string& claim) {
               return _queues.at(claim).front() == plan;
           });
}

std::vector<std::size_t> PlanTurns::End(std::size_t plan)
{
    std::set<std::size_t> next;
    const auto found = _claims.find(plan);
    if (found == _claims.end())
    {
        return {};
    }
    for (const std::string& claim : found->second)
    {
        std::deque<std::size_t>& queue = _queues.at(claim);
        std::erase(queue, plan);
        if (queue.empty())
        {
            _queues.erase(claim);
        }
        else
        {
            next.insert(queue.front());
        }
    }
    _claims.erase(found);
    std::vector<std::size_t> first;
    std::copy_if(next.begin(), next.end(), std::back_inserter(first), [this](std::size_t candidate) {
        return IsFirst(candidate);
    });
    return first;
}

} // namespace ACS::McsSim
