#pragma once

#include "robots/JobMethods.hpp"
#include <acs/acsd/RobotAction.hpp>
#include <acs/vda5050/EVda5050Version.hpp>
#include <acs/vda5050/FactsheetMessage.hpp>

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// Which instant actions an operator may request from a vehicle: those of its factsheet with the scope INSTANT, without those that acsd
/// sends itself. Without a factsheet, or with one that lists no actions, those of the standard. A vehicle accepts stateRequest and
/// factsheetRequest in any case. Pure.
class InstantActionCheck final
{
    std::set<std::string, std::less<>> _jobActions; ///< By which the vehicle does jobs.
    VDA5050::EVda5050Version _version;

public:
    /// version: of the messages that are sent to the vehicle.
    InstantActionCheck(const JobMethods& methods, VDA5050::EVda5050Version version);

    /// Sorted by type.
    [[nodiscard]] std::vector<RobotActionOffer> ListOffers(const VDA5050::FactsheetMessage* factsheetOrNull) const;

    /// Why the request is invalid, as a sentence with what is allowed; nullopt if it is valid. A factsheet is strict: a parameter that it
    /// does not list is invalid, and so is a value of another JSON type.
    [[nodiscard]] std::optional<std::string> FindErrorOrNull(
        const RobotActionRequest& request,
        const VDA5050::FactsheetMessage* factsheetOrNull) const;

private:
    /// The command to use instead of an action that acsd sends itself; empty for others.
    [[nodiscard]] std::string FindReplacement(std::string_view actionType) const;
    [[nodiscard]] std::vector<VDA5050::AgvAction> ListActions(const VDA5050::FactsheetMessage* factsheetOrNull) const;
};

} // namespace ACS::Acsd
