#pragma once

#include <acs/vda5050/Action.hpp>
#include <acs/vda5050/Header.hpp>

#include <vector>

namespace ACS::VDA5050
{

/// Topic instantActions (section 6.9): executed at once, in parallel to the order.
struct InstantActionsMessage
{
    Header header;
    std::vector<Action> actions;

    bool operator==(const InstantActionsMessage&) const = default;
};

} // namespace ACS::VDA5050
