#pragma once

#include "ReportedActions.hpp"
#include <acs/vda5050/Action.hpp>
#include <acs/vda5050/FactsheetMessage.hpp>
#include <acs/vda5050/OrderValidator.hpp>
#include <acs/vda5050/StateMessage.hpp>
#include <acs/vda5050/VehicleAction.hpp>

#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::VDA5050
{

/// The actions of a vehicle: which are in its state, which of them starts next, and which make room for others.
class ActionBook
{
    struct EvictedAction
    {
        std::string actionID;
        std::string actionType;
    };

    const FactsheetMessage& _factsheet;
    ReportedActions _actions;
    std::deque<std::string> _queue;      ///< Actions of reached nodes and entered edges that are not started.
    std::vector<EvictedAction> _evicted; ///< The latest shown instant actions that were removed for new ones.

public:
    /// The factsheet must outlive the book.
    explicit ActionBook(const FactsheetMessage& factsheet);

    // The order.
    /// Removes all but the instant actions whose end was not shown: master control has to see it.
    void BeginOrder();
    void AddOrderAction(
        const Action& action,
        EActionScope scope,
        const std::string& elementID,
        std::uint32_t sequenceID);
    /// Marks the instant actions that have not ended: the order decides where the vehicle is from now on.
    void MarkOvertaken();
    /// An id that comes back with the update would else have to leave a terminal status.
    void DropFrom(std::uint32_t firstSequenceID);
    void EvictSurplus();
    /// The actions may start: their node was reached, or their edge entered.
    void Enqueue(std::span<const Action> actions);
    /// 6.11: None and Soft run beside each other; Hard waits for all of them and holds up all that follow. Null: none may start.
    [[nodiscard]] ReportedAction* TakeStartableOrNull();
    void ClearQueue();
    /// Waiting actions fail; running ones get StopAction.
    void StopOrder(const std::string& reason, VehicleActions& out);
    void FailOrder(const std::string& reason);
    /// Removes all but the instant actions that have not ended.
    void Forget();

    // Instant actions.
    /// A repeated id is the same action, sent again by a master that has not seen it in a state.
    [[nodiscard]] bool IsRepeated(const Action& action);
    /// Why an action cannot even be shown; empty where it can. A cancel that is not done must not look as if it were.
    [[nodiscard]] std::string FindClash(const Action& action);
    /// False where the state cannot show another action. The factsheet's limit does not keep a vehicle from being stopped.
    [[nodiscard]] bool TryMakeRoomFor(const Action& action);
    ReportedAction& AddInstant(const Action& action, EActionStatus status, std::string_view result = {});

    // All.
    void Start(ReportedAction& action, VehicleActions& out);
    bool TrySetStatus(ReportedAction& action, EActionStatus status, std::string resultDescription = {});
    void SetStatus(const std::vector<std::string>& actionIDs, EActionStatus status, const std::string& result = {});
    void PauseRunning(VehicleActions& out);
    void ResumePaused(VehicleActions& out) const;
    void MarkShown();

    [[nodiscard]] ReportedAction* FindOrNull(std::string_view actionID);
    /// An order action that has not ended.
    [[nodiscard]] bool HasOpen() const noexcept;
    /// An action of this edge, which may not outlive it in the state.
    [[nodiscard]] bool HasOpenOnEdge(std::uint32_t sequenceID) const;
    /// Whether neither a running nor a queued action keeps the vehicle at its place.
    [[nodiscard]] bool CanDrive() const noexcept;
    void Fill(StateMessage& state) const;
    /// baseEnd is the first sequenceId of the horizon.
    void Fill(OrderContext& context, std::uint32_t baseEnd) const;

private:
    /// The oldest instant action that has ended, and was seen to, makes way. False where there is none.
    [[nodiscard]] bool TryEvict();
};

} // namespace ACS::VDA5050
