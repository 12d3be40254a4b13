#pragma once

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

struct FleetOptions
{
    /// For every vehicle. Of its address only the interfaceName counts; its version holds for vehicles that name none.
    MasterOptions vehicle;
    /// Whether vehicles that were not added are taken in when they are heard.
    bool bDiscovery = true;
    /// Asked before an unknown vehicle is taken in; none: all are welcome. Anybody may write to a broker, and what writes to
    /// the topics of enough vehicles that do not exist leaves no room for those that do.
    std::function<bool(const VehicleAddress&)> isWelcome;
    /// Discovered vehicles beyond this are left out and counted. Add is not bound by it.
    std::size_t maxVehicles = 1'000;
};

/// What the session of one vehicle asks for or tells; MasterFleet::GetSession has it by the number.
struct FleetAction
{
    std::size_t vehicle = 0;
    MasterAction action;

    bool operator==(const FleetAction&) const = default;
};

using FleetActions = std::vector<FleetAction>;

/// A message that made no vehicle known, and why.
struct LeftOutMessage
{
    std::string topic;
    Core::Error reason;

    bool operator==(const LeftOutMessage&) const = default;
};

/// What calls of one vehicle's session appended becomes the fleet's: moves the actions behind out and leaves none.
void AppendActions(std::size_t vehicle, MasterActions& actions, FleetActions& out);

/// A MasterSession for each vehicle on a broker, added by its address or discovered by its connection message (retained:
/// all are known at once) or a live state. Vehicles are numbered from 0 as they come; a number is never given twice. Pure
/// like its sessions. Four subscriptions serve all vehicles; a message costs one look-up, however many there are. All
/// calls on one thread; and none while its out is iterated, as calls append to it.
class MasterFleet
{
    FleetOptions _options;
    std::vector<std::unique_ptr<MasterSession>> _sessionsOrNull; ///< By number; null: removed.
    std::map<std::string, std::size_t, std::less<>> _numbers;    ///< By the topic without its last level.
    std::uint64_t _leftOut = 0;
    std::optional<LeftOutMessage> _lastLeftOut;
    Vda5050Codec _codec;
    MasterActions _scratch;
    bool _bLinkUp = false;

    [[nodiscard]] const std::size_t* FindNumberOrNull(std::string_view topic) const;
    void Discover(const MqttMessage& message, Core::Now now, FleetActions& out);
    void LeaveOut(const MqttMessage& message, Core::Error reason);
    /// The version that an unknown vehicle's message names, or why it makes none known.
    [[nodiscard]] Core::Result<EVda5050Version> ReadVersion(const MqttMessage& message);
    [[nodiscard]] std::unique_ptr<MasterSession> MakeSession(const VehicleAddress& address, EVda5050Version version)
        const;
    std::size_t Insert(std::unique_ptr<MasterSession> session);

public:
    /// The interfaceName must be one: see Create.
    explicit MasterFleet(FleetOptions options);

    /// For an interfaceName that comes from outside. Fails with InvalidTopic where it cannot stand in a topic.
    [[nodiscard]] static Core::Result<MasterFleet> Create(FleetOptions options);

    /// state, visualization, connection and factsheet of all vehicles of the interface.
    [[nodiscard]] std::vector<MqttSubscription> GetSubscriptions() const;

    /// Takes a vehicle in before it is heard; its number, also where it is known already. Fails with InvalidTopic.
    [[nodiscard]] Core::Result<std::size_t> Add(const VehicleAddress& address, Core::Now now, FleetActions& out);

    /// Forgets a vehicle with its order, its session and its number; its timers are cancelled, nothing is sent to it. Heard
    /// again, and welcome, it is a new one: a connection message that is retained on the broker is heard at each OnLinkUp.
    /// False where there is none with this number (any more).
    bool TryRemove(std::size_t vehicle, FleetActions& out);

    void OnLinkUp(Core::Now now, FleetActions& out);
    void OnLinkDown(Core::Now now, FleetActions& out);
    /// Of a vehicle that is not known yet: takes it in. Its first FleetAction bears a new number.
    void OnMessage(const MqttMessage& message, Core::Now now, FleetActions& out);
    /// Late ones of a vehicle that was removed do nothing.
    void OnTimer(std::size_t vehicle, EMasterTimer timer, Core::Now now, FleetActions& out);

    /// How many numbers were given: those of removed vehicles count.
    [[nodiscard]] std::size_t GetSize() const noexcept;
    /// Whether there is a vehicle with this number, not removed.
    [[nodiscard]] bool Contains(std::size_t vehicle) const noexcept;
    /// The session of a vehicle, for orders and questions. What its calls append is of this vehicle: see AppendActions.
    /// The reference holds until the vehicle is removed. Contains(vehicle) is true.
    [[nodiscard]] MasterSession& GetSession(std::size_t vehicle);
    [[nodiscard]] const MasterSession& GetSession(std::size_t vehicle) const;
    [[nodiscard]] std::optional<std::size_t> FindOrNull(const VehicleAddress& address) const;
    /// Messages of vehicles that were not taken in: too many, not welcome, unreadable, of another vehicle or major version than their
    /// topic says, or not discovered.
    [[nodiscard]] std::uint64_t GetLeftOutCount() const noexcept;
    /// The last of them, for the log; null where there was none.
    [[nodiscard]] const LeftOutMessage* GetLastLeftOutOrNull() const noexcept;
    /// The sum over all vehicles.
    [[nodiscard]] MasterStatistics GetStatistics() const;
};

} // namespace ACS::VDA5050
