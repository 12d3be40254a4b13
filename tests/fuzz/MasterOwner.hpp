#pragma once

#include "Choices.hpp"
#include "VehicleModel.hpp"
#include <acs/vda5050/MasterSession.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Fuzz
{

/// The owner of a MasterSession, the broker and the clock: obeys the session, and checks its rules: one message without an answer
/// at a time, rising numbers, a base that does not change, one outcome per order, message and action, nodes in order, timers
/// in the future and where something waits, bounded output, published messages that can be decoded, complete reservations.
class MasterOwner
{
    static constexpr std::size_t TIMER_COUNT = 3;

    enum class EAnswer : std::uint8_t
    {
        Open,
        Accepted,
        Rejected,
        Withdrawn, ///< By a cancel that runs: not sent, but the vehicle may show it.
    };

    enum class ESent : std::uint8_t
    {
        No,
        Perhaps, ///< By the session before a restart.
        Yes,
    };

    /// A message of an order.
    struct Given
    {
        VDA5050::OrderMessage given;   ///< As given to the session, with the number of the published message.
        VDA5050::OrderMessage message; ///< Likewise, and then as published.
        bool bContinues = false;       ///< Was given with a horizon.
        ESent sent = ESent::No;
        EAnswer answer = EAnswer::Open;
    };

    struct Order
    {
        std::string orderID;
        std::vector<VDA5050::OrderNode> nodes; ///< Of the whole route.
        std::vector<VDA5050::OrderEdge> edges;
        std::vector<Given> messages;
        bool bCancelling = false;
        bool bReappeared = false;
        std::string cancelActionID = {}; ///< Of the last cancelOrder that was sent for it.
        std::string orderIDBefore = {};  ///< Of the vehicle, before the order was sent.
        std::optional<std::uint32_t> acceptedUpdateID;
        std::optional<std::uint32_t> reachedSequenceID;
    };

    enum class EInstant : std::uint8_t
    {
        Pending,
        Shown,
        Rejected,
    };

    /// The call whose actions are executed.
    enum class ECall : std::uint8_t
    {
        Other,
        State, ///< It has reported a state.
        Resume,
    };

    /// An action without an outcome.
    struct OpenAction
    {
        bool bOfOrder = false;
        std::uint32_t sequenceID = 0;
    };

    VDA5050::MasterOptions _options;
    VDA5050::MasterSession _session;
    VDA5050::Vda5050Codec _codec;
    Core::Now _now;
    VDA5050::MasterActions _out;
    VehicleModel _vehicle;
    std::deque<VDA5050::MqttMessage> _underWay; ///< Published, and not at the vehicle.
    std::array<std::optional<Core::SteadyTime>, TIMER_COUNT> _deadlines;
    std::map<std::string, std::uint32_t> _headerIDs;
    std::optional<Order> _order;
    std::optional<Order> _stored;     ///< Of the session before a restart.
    std::set<std::string> _withdrawn; ///< Orders that ended before the vehicle showed them.
    std::map<std::string, EInstant> _instants;
    std::map<std::string, OpenAction> _open;
    std::map<std::string, VDA5050::EActionStatus> _statuses;
    std::set<VDA5050::VehicleError> _errors;
    VDA5050::EVehicleLink _link = VDA5050::EVehicleLink::Unknown;
    std::uint64_t _states = 0;
    std::uint64_t _refused = 0;
    std::uint64_t _sent = 0;
    std::uint32_t _orderCount = 0;
    std::uint32_t _actionCount = 0;
    std::uint32_t _messageCount = 0;
    std::size_t _finishedOrders = 0;
    bool _bLinkUp = false;
    bool _bLed = true; ///< According to the last state.
    bool _bSilent = false;
    ECall _call = ECall::Other;

public:
    explicit MasterOwner(VDA5050::MasterOptions options);

    void PassTime(std::chrono::milliseconds span);
    void ChangeLink(bool bUp);
    void ReportConnection(VDA5050::EConnectionState state);
    [[nodiscard]] VehicleModel& GetVehicle() noexcept;
    /// The vehicle's true state.
    [[nodiscard]] VDA5050::StateMessage MakeState();
    void Receive(VDA5050::ETopic topic, const std::string& payload, bool bRetained);
    /// The oldest message that is under way reaches the vehicle, or is lost.
    void Transport(bool bLost);

    void SendOrder(Choices& choices);
    void SendUpdate(Choices& choices);
    void SendInstant(Choices& choices);
    void Cancel();
    void SetHorizonOmitted(bool bOmitted);
    /// Another session takes its place. It can resume the order.
    void RestartMaster();
    void Resume();

    /// A vehicle that works ends every order, action and cancel, and then executes another order.
    void End();

private:
    [[nodiscard]] static bool IsRequest(std::string_view actionType);
    void Execute(ECall call = ECall::Other);
    void Do(const VDA5050::MasterAction& action);
    void On(const VDA5050::OrderAccepted& event);
    void On(const VDA5050::OrderRejected& event);
    void On(const VDA5050::OrderReappeared& event);
    void On(const VDA5050::NodeReached& event);
    void On(const VDA5050::ActionLost& event);
    void On(const VDA5050::InstantActionRejected& event);
    void On(const VDA5050::VehicleErrorChanged& event);
    void OnState();
    void FinishOrder(const std::string& orderID);
    void EndOrder(const std::string& orderID);
    [[nodiscard]] bool IsLastNodeReached() const;
    void ResolveShown();
    void Track(const VDA5050::OrderMessage& message, bool bFirst);
    void CheckPublished(const VDA5050::MqttMessage& message);
    void CheckOrderMessage(const VDA5050::OrderMessage& message);
    void CheckInstant(const VDA5050::Action& action);
    void CheckState() const;
    void CheckReserved() const;
    void CheckTimers() const;
    void CheckShown() const;
    [[nodiscard]] std::size_t MeasureState() const;
    [[nodiscard]] std::vector<VDA5050::Action> MakeActions(Choices& choices);
    void ExtendRoute(Order& order, std::size_t nodes, Choices& choices);
    [[nodiscard]] VDA5050::OrderMessage Cut(
        const Order& order,
        std::size_t first,
        std::size_t released,
        std::size_t end);
    [[nodiscard]] static std::size_t CountOpen(const Order& order);
    /// The first message that the vehicle may answer.
    [[nodiscard]] std::vector<Given>::iterator FindUnanswered();
    [[nodiscard]] static std::size_t FindDecisionPoint(const Order& order);
    void Work();
};

} // namespace ACS::Fuzz
