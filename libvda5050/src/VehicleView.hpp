#pragma once

#include "ActionIndex.hpp"
#include <acs/vda5050/MasterAction.hpp>
#include <acs/vda5050/MasterSession.hpp>

#include <cstdint>
#include <optional>
#include <string_view>

namespace ACS::VDA5050
{

/// What a master knows of its vehicle: whether it is connected, its last state, and whether that is recent.
class VehicleView
{
    enum class EFreshness : std::uint8_t
    {
        NoState, ///< None since the vehicle is online.
        Fresh,
        Silent, ///< The next state is overdue.
    };

    bool _bLinkUp = false; ///< The master's own link.
    EVehicleLink _link = EVehicleLink::Unknown;
    EFreshness _freshness = EFreshness::NoState;
    bool _bNumbersKnown = false; ///< A state was received since ONLINE, which restarts the headerIds.
    bool _bStateSinceOnline = false;
    Core::SteadyTime _lastStateTime;
    std::optional<StateMessage> _state;
    std::optional<Header> _connectionHeader; ///< Of the last connection message.

public:
    void OnLinkUp() noexcept;
    void OnLinkDown(MasterActions& out);
    /// The vehicle reported ONLINE, perhaps once more.
    void OnRestartedNumbers() noexcept;
    void SetConnectionHeader(Header header);
    void OnOnline(Core::Duration allowedSilence, Core::Now now, MasterActions& out);
    /// Offline or Broken.
    void OnGone(EVehicleLink link, MasterActions& out);
    /// Returns the state before.
    std::optional<StateMessage> ReplaceStateOrNull(
        StateMessage state,
        Core::Duration allowedSilence,
        Core::Now now,
        MasterActions& out);
    /// The timer is not moved at each state: it checks the age when it ends, and waits for the rest.
    void CheckSilence(Core::Duration allowed, Core::Now now, MasterActions& out);
    /// Reports what differs from the state before. shown has the actions of the present state.
    void ReportDifferences(
        const std::optional<StateMessage>& previousOrNull,
        const ActionIndex& shown,
        MasterActions& out) const;

    [[nodiscard]] bool IsLinkUp() const noexcept;
    [[nodiscard]] EVehicleLink GetLink() const noexcept;
    [[nodiscard]] bool IsOnline() const noexcept;
    /// Whether a live connection message with this header is the first one after a restart of the vehicle. A duplicate has the
    /// header of the message before it, one that is sent periodically a higher headerId.
    [[nodiscard]] bool WasRestarted(const Header& connection) const;
    [[nodiscard]] bool IsReady() const noexcept;
    /// A state was received since the vehicle is online. The next one may be overdue.
    [[nodiscard]] bool HasStateSinceOnline() const noexcept;
    /// Whether the last known mode allows orders and instant actions.
    [[nodiscard]] bool IsUnderMasterControl() const;
    /// Online, and in a mode that takes orders.
    [[nodiscard]] bool CanReceive() const;
    /// Whether the vehicle has nodes or edges left, of any order.
    [[nodiscard]] bool IsBusy() const;
    /// A state that is older than the last one.
    [[nodiscard]] bool IsStale(const StateMessage& state) const;
    [[nodiscard]] bool IsShowingOrder(std::string_view orderID) const;
    [[nodiscard]] const ActionState* FindActionOrNull(std::string_view actionID) const;
    [[nodiscard]] const StateMessage* GetStateOrNull() const noexcept;
};

} // namespace ACS::VDA5050
