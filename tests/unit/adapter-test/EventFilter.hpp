#pragma once

#include "ReferenceAdapter.hpp"
#include <acs/plan/RobotEvent.hpp>

#include <functional>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Testing
{

/// Changes the events that the adapter raises.
class EventFilter : public ReferenceAdapter
{
    using Change = std::function<std::vector<Planning::RobotEvent>(const Planning::RobotEvent& event)>;

    const Change _change;

public:
    explicit EventFilter(Change change)
        : _change(std::move(change))
    {
    }

protected:
    void Raise(Planning::RobotEvent event, Out& out) override
    {
        for (Planning::RobotEvent& changed : _change(event))
        {
            ReferenceAdapter::Raise(std::move(changed), out);
        }
    }
};

template <typename TEvent>
[[nodiscard]] bool Is(const Planning::RobotEvent& event)
{
    return std::holds_alternative<TEvent>(event);
}

} // namespace ACS::Testing
