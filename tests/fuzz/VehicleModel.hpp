#pragma once

#include <acs/core/Now.hpp>
#include <acs/vda5050/InstantActionsMessage.hpp>
#include <acs/vda5050/OrderMessage.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <string_view>

namespace ACS::Fuzz
{

/// A vehicle that follows the orders: as small as possible, and independent of VehicleSession.
class VehicleModel
{
    VDA5050::StateMessage _state;
    std::map<std::string, std::uint32_t> _orderActions; ///< Action ids of the order, with their sequence ids.
    std::set<std::string> _instantActions;              ///< All that were received.

public:
    VehicleModel();

    void Receive(const VDA5050::OrderMessage& order);
    void Receive(const VDA5050::InstantActionsMessage& message);
    /// To the next node of the base.
    void Drive();
    /// The next status of one of the actions that have not ended.
    void AdvanceAction(std::size_t choice, bool bFails);
    /// Forgets everything.
    void Restart();
    void SetMode(VDA5050::EOperatingMode mode);
    void ClearErrors();

    /// Has nodes or actions of the order left.
    [[nodiscard]] bool IsBusy() const;
    /// With the next header.
    [[nodiscard]] VDA5050::StateMessage MakeState(Core::Now now);

private:
    void Begin(const VDA5050::OrderMessage& order);
    void Extend(const VDA5050::OrderMessage& order);
    void Append(const VDA5050::OrderMessage& order, std::size_t firstNode);
    void Cancel(const std::string& actionID);
    void Refuse(std::string_view errorType, const VDA5050::OrderMessage& order);
    void AddError(VDA5050::VehicleError error);
};

} // namespace ACS::Fuzz
