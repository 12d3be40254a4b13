#pragma once

#include "SortedIndex.hpp"
#include <acs/vda5050/StateMessage.hpp>

#include <string>
#include <vector>

namespace ACS::VDA5050
{

/// The actions of a state by their id.
class ActionIndex : public SortedIndex<ActionState, std::string ActionState::*>
{
public:
    explicit ActionIndex(const std::vector<ActionState>& actions)
        : SortedIndex(actions, &ActionState::actionID)
    {
    }
};

} // namespace ACS::VDA5050
