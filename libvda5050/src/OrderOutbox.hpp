#pragma once

#include "ActionIndex.hpp"
#include "MasterTopics.hpp"
#include "OrderNumbers.hpp"
#include <acs/vda5050/MasterAction.hpp>
#include <acs/vda5050/MasterOptions.hpp>
#include <acs/vda5050/OrderMessage.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::VDA5050
{

/// The messages of an order that the vehicle has not shown: at most one in flight, which is resent until the vehicle shows
/// or refuses it, and one update that waits for it. Numbers the updates.
class OrderOutbox
{
public:
    /// Whether the vehicle can show the message in flight.
    enum class EEcho : std::uint8_t
    {
        Impossible, ///< It was never sent.
        Possible,   ///< It was sent, perhaps before a restart of the master.
    };

    /// What a state means for the message in flight.
    enum class EAnswer : std::uint8_t
    {
        None,
        Shown,
        Rejected,
        Unresolved, ///< The vehicle may have executed the order without showing it, and forgotten it by a restart.
    };

    struct Answer
    {
        EAnswer kind = EAnswer::None;
        std::string errorType = {}; ///< Of Rejected.
        std::string reason = {};    ///< Of Rejected.
    };

private:
    struct InFlight
    {
        OrderMessage message;
        EEcho echo = EEcho::Impossible;
        std::uint32_t sendCount = 0;
        std::uint32_t firstHeaderID = 0; ///< Increases with each resend.
        bool bAwaySinceSend = false;     ///< The vehicle was not connected for a time since the message was sent.
        std::vector<VehicleError> errorsBefore; ///< Of before the message was sent, and shown since then; sorted.
        std::string orderIDBefore;              ///< Of the vehicle before the message was sent.
        std::string lastNodeIDBefore;
        std::uint32_t lastNodeSequenceIDBefore = 0;
    };

    const MasterOptions& _options;
    OrderNumbers _numbers;
    std::optional<InFlight> _inFlight;
    std::optional<OrderMessage> _queued;
    bool _bWithdrawn = false; ///< The order is being cancelled: nothing is sent, and only what is shown is an answer.
    std::optional<Core::SteadyTime> _lastOrderTime; ///< Of the last published message of any order.

public:
    /// The options must outlive the outbox.
    explicit OrderOutbox(const MasterOptions& options);

    void BeginOrder(OrderNumbers numbers);
    void EndOrder(MasterActions& out);
    /// False: no number is left for the update. shownID is the number that the vehicle shows for the order, or 0.
    [[nodiscard]] bool TryNumber(OrderMessage& update, bool bContinues, std::uint32_t shownID);
    /// The message is in flight from now on; the state is the vehicle's before it. Publish sends it.
    void Start(OrderMessage message, EEcho echo, const StateMessage& state);
    void Queue(OrderMessage update);
    /// False: nothing waits, or a message is in flight.
    [[nodiscard]] bool TryStartQueued(const StateMessage& state);
    /// Delayed by the minimum interval of orders.
    void Publish(MasterTopics& topics, Core::Duration minimumInterval, Core::Now now, MasterActions& out);
    void OnVehicleOnline();
    /// shown has the actions of the state.
    [[nodiscard]] Answer OnState(const StateMessage& state, const ActionIndex& shown);
    /// Returns the message in flight, which the state shows.
    [[nodiscard]] OrderMessage Accept(const StateMessage& state, MasterActions& out);
    /// The vehicle shows a message of the order that was not sent by this session. updateID is that of the message, also if the
    /// vehicle shows a later one.
    void SetAccepted(std::uint32_t updateID);
    /// Drops the message in flight, and what waits for it: an update on top of a refused one has no place to begin.
    void Reject(const std::string& errorType, const std::string& reason, MasterActions& out);
    /// The order is being cancelled: whether or not the vehicle has seen what is in flight, it must not come again.
    void Withdraw(MasterActions& out);
    /// The cancel failed, and the order continues: what the vehicle has not shown is sent again.
    void Restore(const StateMessage& state, MasterActions& out);

    /// Nothing waits for an answer, or what does is withdrawn.
    [[nodiscard]] bool IsEmpty() const noexcept;
    [[nodiscard]] bool HasQueued() const noexcept;
    /// Whether a vehicle that was away since an order was sent may have executed it without showing it, and forgotten it by a
    /// restart: certainly not if it still shows the order of before.
    [[nodiscard]] static bool CanBeExecuted(const std::string& orderIDBefore, const StateMessage& state);
    /// Whether the vehicle has shown a message of the order.
    [[nodiscard]] bool IsAccepted() const noexcept;
    /// Whether more nodes follow after the accepted message.
    [[nodiscard]] bool IsContinued() const;
    /// The message in flight was resent as often as the options allow.
    [[nodiscard]] bool IsSpent() const noexcept;
    [[nodiscard]] const OrderMessage* GetInFlightOrNull() const noexcept;
    /// The message in flight if the vehicle can show it, also while it is withdrawn.
    [[nodiscard]] const OrderMessage* GetShowableOrNull() const noexcept;
    /// The message in flight if it was sent and may reach the vehicle, also while it is withdrawn.
    [[nodiscard]] const OrderMessage* GetSentOrNull() const noexcept;

private:
    /// Keeps the numbers of what was not sent above the one that the vehicle shows.
    [[nodiscard]] Answer RenumberUnsent(const StateMessage& state);
    [[nodiscard]] bool IsUnresolved(const StateMessage& state) const;
    /// Whether the last node of the vehicle, which shows no order, permits that it has executed the message in flight. Some clear
    /// the orderId of an order that has ended, a state later.
    [[nodiscard]] bool CanHaveDriven(const StateMessage& state) const;
    [[nodiscard]] bool IsRejection(const VehicleError& error, const ActionIndex& shown) const;
    [[nodiscard]] bool IsSentHeader(std::string_view headerID) const;
};

} // namespace ACS::VDA5050
