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

/// How a vehicle does the jobs of the MCS, by its configuration and by the factsheet that it has published.
class VehicleJobCheck final : public Planning::IJobCheck
{
    JobMethods _methods;
    std::optional<VDA5050::FactsheetMessage> _factsheet;
    bool _bFactsheetAwaited;

public:
    /// With an awaited factsheet every job is rejected for now.
    VehicleJobCheck(JobMethods methods, const VDA5050::FactsheetMessage* factsheetOrNull, bool bFactsheetAwaited);

    /// Whether it is by this factsheet, however often that was sent; null: by none.
    [[nodiscard]] bool IsFor(const VDA5050::FactsheetMessage* factsheetOrNull) const;

    /// The vehicle's action for the job, by what is known of its factsheet. The error says why it has none.
    [[nodiscard]] tl::expected<VDA5050::Action, std::string> MakeAction(const Planning::StartJob& job) const;

    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(const Planning::StartJob& job) const override;
};

} // namespace ACS::Acsd
