#pragma once

#include "robots/JobMethods.hpp"
#include <acs/plan/IJobCheck.hpp>
#include <acs/vda5050/Action.hpp>
#include <acs/vda5050/FactsheetMessage.hpp>

#include <tl/expected.hpp>

#include <optional>
#include <string>

namespace ACS::Acsd
{

/// Checks by configuration and factsheet how a vehicle does the jobs of the MCS.
class VehicleJobCheck final : public Planning::IJobCheck
{
    JobMethods _methods;
    std::optional<VDA5050::FactsheetMessage> _factsheet;
    bool _bFactsheetAwaited;

public:
    /// With an awaited factsheet every job is rejected for now.
    VehicleJobCheck(JobMethods methods, const VDA5050::FactsheetMessage* factsheetOrNull, bool bFactsheetAwaited);

    /// Whether the check is based on an equal factsheet; null: on none.
    [[nodiscard]] bool IsFor(const VDA5050::FactsheetMessage* factsheetOrNull) const;

    /// The vehicle's action for the job, according to its factsheet. The error states why it has none.
    [[nodiscard]] tl::expected<VDA5050::Action, std::string> MakeAction(const Planning::StartJob& job) const;

    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const Planning::StartJob& job) const override;
};

} // namespace ACS::Acsd
