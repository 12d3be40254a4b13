#pragma once

#include "Choices.hpp"
#include <acs/vda5050/StateMessage.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>
#include <acs/vda5050/VehicleSession.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Fuzz
{

/// The owner of a VehicleSession: obeys it, and checks its rules: never two orders, rising sequence ids,
/// actions by their blocking types, final statuses, published messages that can be decoded.
class VehicleOwner
{
    struct Running
    {
        VDA5050::StartAction start;
        bool bReported = false; ///< Has been reported as running.
    };

    VDA5050::MaximumArrayLengths _limits; ///< Limits of what it publishes.
    Core::Duration _minimumInterval;
    std::optional<Core::SteadyTime> _stateTime;
    VDA5050::VehicleSession _session;
    VDA5050::Vda5050Codec _codec;
    Core::Now _now;
    VDA5050::VehicleActions _out;
    std::map<std::string, Running> _running;
    std::map<std::string, VDA5050::EActionStatus> _statuses;
    std::map<std::string, std::uint32_t> _headerIDs;
    std::optional<VDA5050::DriveTo> _leg;
    std::optional<std::uint32_t> _outsideEdge; ///< The edge whose corridor it has left.
    std::string _orderID;
    std::uint32_t _lastSequenceID = 0;
    bool _bOrderRuns = false;
    bool _bLinked = true;

public:
    explicit VehicleOwner(VDA5050::VehicleOptions options);

    [[nodiscard]] VDA5050::StateMessage GetState() const;

    void PassTime(std::uint32_t milliseconds);
    void Receive(VDA5050::ETopic topic, std::string_view payload, bool bRetained);
    void SendInstant(std::string_view actionType, const std::string& actionID);
    /// An event of the vehicle itself.
    void Happen(Choices& choices);
    void ReachNode();
    void SetStatus(Choices& choices);
    /// Finishes the order as a vehicle without new input does, then cancels the rest; all must have ended then.
    void End();

private:
    void Obey();
    void Watch(const VDA5050::VehicleAction& action);
    void WatchStart(const VDA5050::StartAction& start);
    void WatchDrive(const VDA5050::DriveTo& drive) const;
    [[nodiscard]] std::uint32_t ReadHeaderID(const VDA5050::MqttMessage& message);
    void WatchPublished(const VDA5050::MqttMessage& message);
    void WatchTaken(const VDA5050::OrderTaken& taken);
    void WatchState();
    void WatchRoute(const VDA5050::StateMessage& state);
    void WatchActions(const VDA5050::StateMessage& state);
    void WatchBounds(const VDA5050::StateMessage& state) const;
    [[nodiscard]] bool IsBlocked() const;
    void ReachWithoutCommand(Choices& choices);
    void LeaveCorridor(bool bOutside);
    void Sense(Choices& choices);
    void Finish();
};

} // namespace ACS::Fuzz
