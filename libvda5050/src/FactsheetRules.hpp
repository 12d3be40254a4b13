#pragma once

#include "MasterTopics.hpp"
#include <acs/vda5050/FactsheetMessage.hpp>
#include <acs/vda5050/MasterOptions.hpp>
#include <acs/vda5050/OrderMessage.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::VDA5050
{

/// The vehicle's factsheet, and what it demands of the messages and times of a master.
class FactsheetRules
{
    const MasterOptions& _options;
    std::optional<FactsheetMessage> _factsheet; ///< Received, or that of the options.

public:
    /// The options must outlive the rules.
    explicit FactsheetRules(const MasterOptions& options);

    void OnFactsheet(FactsheetMessage factsheet, MasterActions& out);
    /// Changes the order to what the factsheet supports, as far as the standard allows. The state is given for an update of
    /// the order that it shows.
    [[nodiscard]] Core::Result<void> FitOrder(
        OrderMessage& order,
        const StateMessage* stateOrNull,
        const MasterTopics& topics,
        Core::Now now) const;
    [[nodiscard]] Core::Result<void> FitInstantAction(Action& action, const MasterTopics& topics, Core::Now now) const;
    /// An actionId of the master's own, for the count of these ids.
    [[nodiscard]] std::string MakeActionID(std::string_view actionType, std::uint32_t count, Core::Now now) const;

    [[nodiscard]] const FactsheetMessage* GetFactsheetOrNull() const noexcept;
    [[nodiscard]] Core::Duration GetOrderInterval() const;
    [[nodiscard]] Core::Duration GetAllowedSilence() const;
    /// Of one message.
    [[nodiscard]] std::size_t GetMaximumInstantActions() const;

private:
    /// Null without a factsheet, or if it is not obeyed.
    [[nodiscard]] const FactsheetMessage* GetRulesOrNull() const;
};

} // namespace ACS::VDA5050
