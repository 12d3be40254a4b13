#pragma once

#include <acs/core/Api.hpp>
#include <acs/vda5050/MasterSession.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::VDA5050
{

/// Which vehicles a MasterFleet accepts, and the options of their sessions.
struct FleetOptions
{
    /// For every vehicle. Of its address only interfaceName is used; its version applies to vehicles that report none.
    MasterOptions vehicle;
    /// Whether vehicles that were not added are accepted when they send a message.
    bool bDiscovery = true;
    /// Decides whether an unknown vehicle is accepted; empty: all are. Any client of a broker can publish to the topics of
    /// vehicles that do not exist and so use up maxVehicles.
    std::function<bool(const VehicleAddress&)> isAccepted;
    /// Maximum number of vehicles for discovery; more are ignored and counted. Add is not limited.
    std::size_t maxVehicles = 1'000;
};

/// An action of the session of one vehicle, see MasterFleet::GetSession.
struct FleetAction
{
    std::size_t vehicle = 0; ///< Number of the vehicle in the fleet.
    MasterAction action;     ///< Of its session.

    bool operator==(const FleetAction&) const = default;
};

/// To be carried out in order, before the next call.
using FleetActions = std::vector<FleetAction>;

/// A message of an unknown vehicle that was not accepted, and the reason.
struct LeftOutMessage
{
    std::string topic;  ///< As received.
    Core::Error reason; ///< With the values that would have been accepted.

    bool operator==(const LeftOutMessage&) const = default;
};

/// Moves the actions of one vehicle's session to the end of out and clears them.
ACS_API void AppendActions(std::size_t vehicle, MasterActions& actions, FleetActions& out);

/// A MasterSession for each vehicle on a broker, added by its address or discovered by its connection message (which is
/// retained, so that all vehicles are known at once) or by a live state. Vehicles are numbered from 0; a number is never
/// reused. Pure like its sessions. Four subscriptions serve all vehicles; a message costs one look-up, regardless of their
/// number. Not shared between threads. Calls append to out: do not call while iterating over it.
class ACS_API MasterFleet
{
    FleetOptions _options;
    std::vector<std::unique_ptr<MasterSession>> _sessionsOrNull; ///< By number; null: removed.
    std::map<std::string, std::size_t, std::less<>> _numbers;    ///< By the topic without its last level.
    std::uint64_t _leftOut = 0;
    std::optional<LeftOutMessage> _lastLeftOut;
    Vda5050Codec _codec;
    MasterActions _scratch;
    bool _bLinkUp = false;

public:
    /// The interfaceName must be valid: see Create.
    explicit MasterFleet(FleetOptions options);

    /// For an interfaceName from outside. Fails with InvalidTopic if it is not allowed in a topic.
    [[nodiscard]] static Core::Result<MasterFleet> Create(FleetOptions options);

    /// state, visualization, connection and factsheet of all vehicles of the interface.
    [[nodiscard]] std::vector<MqttSubscription> GetSubscriptions() const;

    /// Adds a vehicle before its first message. Returns its number, also if it is known already. Fails with InvalidTopic.
    [[nodiscard]] Core::Result<std::size_t> Add(const VehicleAddress& address, Core::Now now, FleetActions& out);

    /// Removes a vehicle with its order, its session and its number; its timers are cancelled, nothing is sent to it. With
    /// its next message it can be discovered again under a new number: a retained connection message arrives after each
    /// OnLinkUp. False if there is no vehicle with this number.
    bool TryRemove(std::size_t vehicle, FleetActions& out);

    /// The broker is connected and the subscriptions are made. As MasterSession::OnLinkUp, for every vehicle.
    void OnLinkUp(Core::Now now, FleetActions& out);
    /// The own link is down. As MasterSession::OnLinkDown, for every vehicle.
    void OnLinkDown(Core::Now now, FleetActions& out);
    /// Discovers an unknown vehicle. Its first FleetAction has a new number.
    void OnMessage(const MqttMessage& message, Core::Now now, FleetActions& out);
    /// No effect for a vehicle that was removed.
    void OnTimer(std::size_t vehicle, EMasterTimer timer, Core::Now now, FleetActions& out);

    /// Number of vehicles ever known, including removed ones.
    [[nodiscard]] std::size_t GetSize() const noexcept;
    /// Whether there is a vehicle with this number.
    [[nodiscard]] bool Contains(std::size_t vehicle) const noexcept;
    /// The session of a vehicle. Pass the actions of its calls to AppendActions. The reference is valid until the vehicle is
    /// removed. Requires Contains(vehicle).
    [[nodiscard]] MasterSession& GetSession(std::size_t vehicle);
    /// As above, for reading.
    [[nodiscard]] const MasterSession& GetSession(std::size_t vehicle) const;
    /// The number of the vehicle with this address; nullopt if there is none.
    [[nodiscard]] std::optional<std::size_t> FindOrNull(const VehicleAddress& address) const;
    /// Number of messages of vehicles that were not accepted: too many vehicles, rejected by isAccepted, unreadable, another
    /// vehicle or major version than the topic, or no discovery.
    [[nodiscard]] std::uint64_t GetLeftOutCount() const noexcept;
    /// The last of them, for the log; null if there was none.
    [[nodiscard]] const LeftOutMessage* GetLastLeftOutOrNull() const noexcept;
    /// The sum over all vehicles.
    [[nodiscard]] MasterStatistics GetStatistics() const;

private:
    [[nodiscard]] const std::size_t* FindNumberOrNull(std::string_view topic) const;
    void Discover(const MqttMessage& message, Core::Now now, FleetActions& out);
    void Ignore(const MqttMessage& message, Core::Error reason);
    /// The version that the message of a vehicle outside of the fleet names; an error if it names none that is supported.
    [[nodiscard]] Core::Result<EVda5050Version> ReadVersion(const MqttMessage& message);
    [[nodiscard]] std::unique_ptr<MasterSession> MakeSession(const VehicleAddress& address, EVda5050Version version)
        const;
    std::size_t Insert(std::unique_ptr<MasterSession> session);
};

} // namespace ACS::VDA5050
