#pragma once

#include <acs/core/Api.hpp>
#include <acs/vda5050/EParameterCheck.hpp>
#include <acs/vda5050/FactsheetMessage.hpp>
#include <acs/vda5050/OrderMessage.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::VDA5050
{

/// A broken rule, with the error that a vehicle reports for it.
struct OrderViolation
{
    std::string rule;   ///< One sentence.
    VehicleError error; ///< To be reported in the state.

    bool operator==(const OrderViolation&) const = default;
};

/// Maximum degree of a trajectory. A vehicle refuses a higher one with orderError: the time for a point of a curve grows with the square
/// of the degree.
inline constexpr std::uint32_t MAXIMUM_CURVE_DEGREE = 32;

/// A violation as a vehicle reports it: a warning that refers to topic, headerId, orderId and orderUpdateId. For an
/// OrderCheck.
[[nodiscard]] ACS_API OrderViolation
MakeOrderViolation(const OrderMessage& order, std::string_view errorType, std::string rule);

/// Checks an order by itself: counts, sequence ids, base before horizon, neighbours of edges, unique action ids, curve
/// and angle ranges. Empty if the order is valid.
[[nodiscard]] ACS_API std::vector<OrderViolation> ValidateOrder(const OrderMessage& order);

struct OrderContext;

/// An additional check of the vehicle, for example for orders that its control cannot drive. Empty: no violations.
using OrderCheck = std::function<std::vector<OrderViolation>(const OrderMessage&, const OrderContext&)>;

/// State of a vehicle when an order arrives.
struct OrderContext
{
    std::string heldOrderID;             ///< Of the current or last order; empty: none yet.
    std::uint32_t heldOrderUpdateID = 0; ///< Of the last message that was accepted for it.
    bool bExecuting = false;  ///< Nodes left (horizon included), order actions not ended, or a cancel running.
    bool bCancelling = false; ///< Updates are refused while a cancel runs.
    EOperatingMode operatingMode = EOperatingMode::Automatic; ///< Orders are accepted where IsLedByMaster.
    std::string decisionNodeID;                               ///< Last released node; lastNode where no order runs.
    std::uint32_t decisionSequenceID = 0;                     ///< sequenceId of decisionNodeID.
    std::size_t keptNodes = 0;           ///< Released nodes that are not reached yet: an update adds to them.
    std::size_t keptActions = 0;         ///< Order actions that an update keeps, and instant actions.
    std::size_t keptBytes = 0;           ///< Maximum size of the kept nodes, edges and order actions in a state.
    std::string lastNodeID;              ///< The last node that was reached; empty: on none.
    std::optional<AgvPosition> position; ///< Absent: unknown.
    double defaultDeviationXY = 0.5;     ///< Metres, if the first node states none or 0.
    std::vector<std::string> mapIDs;     ///< Maps on the vehicle; empty: not checked.
    bool bMapsKnown = false;             ///< mapIDs is checked even if it is empty.
    std::vector<std::string> zoneSetIDs; ///< Zone sets on the vehicle; empty: not checked.
    const FactsheetMessage* factsheet = nullptr; ///< Supported actions, optional members and sizes; null: all.
    EParameterCheck parameterCheck = EParameterCheck::Tolerant; ///< How unlisted parameters of actions are handled.
    std::size_t payloadBytes = 0; ///< Of the message, compared with the factsheet's msgLen.
    /// The vehicle may have left lastNodeID: the last order was cancelled between two nodes or in MANUAL.
    bool bCleared = false;
    std::vector<std::string> actionIDs;        ///< Reported actions that an update does not remove.
    std::vector<std::string> instantActionIDs; ///< Instant actions that outlive a new order.
    OrderCheck orderCheck;                     ///< Called last; empty: none.
};

/// What a vehicle does with an order message.
enum class EOrderVerdict : std::uint8_t
{
    NewOrder, ///< Accept it in place of the last order, which has ended.
    Update,   ///< Add its nodes and edges to the current order.
    Discard,  ///< An update that the vehicle has already accepted.
    Reject,   ///< Report the violations.
};

/// The verdict of JudgeOrder and its reasons.
struct OrderJudgement
{
    EOrderVerdict verdict = EOrderVerdict::Reject; ///< What the vehicle does with the message.
    std::vector<OrderViolation> violations;        ///< Of a rejected order: at least one.
    bool bUntilMode = false;                       ///< Rejected only because of the operating mode.
};

/// The acceptance rules of 2.x (section 6.6.4) for an order that was decoded.
[[nodiscard]] ACS_API OrderJudgement JudgeOrder(const OrderMessage& order, const OrderContext& context);

} // namespace ACS::VDA5050
