#pragma once

#include <acs/vda5050/MasterSession.hpp>

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
    /// Vehicles beyond this are left out and counted: anybody may write to a broker.
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

/// A MasterSession for each vehicle on a broker, added by its address or discovered by its connection message (retained:
/// all are known at once) or a live state. Vehicles are numbered from 0 as they come, and never leave. Pure like its
/// sessions. Four subscriptions serve all vehicles; a message costs one look-up, however many there are. All calls on one
/// thread; and none while its out is iterated, as calls append to it.
class MasterFleet
{
    FleetOptions _options;
    std::vector<std::unique_ptr<MasterSession>> _sessions;
    std::map<std::string, std::size_t, std::less<>> _numbers; ///< By the topic without its last level.
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
    void Append(std::size_t vehicle, FleetActions& out);

public:
    explicit MasterFleet(FleetOptions options);

    /// state, visualization, connection and factsheet of all vehicles of the interface.
    [[nodiscard]] std::vector<MqttSubscription> GetSubscriptions() const;

    /// Takes a vehicle in before it is heard; its number, also where it is known already. Fails with InvalidTopic.
    [[nodiscard]] Core::Result<std::size_t> Add(const VehicleAddress& address, Core::Now now, FleetActions& out);

    void OnLinkUp(Core::Now now, FleetActions& out);
    void OnLinkDown(Core::Now now, FleetActions& out);
    /// Of a vehicle that is not known yet: takes it in. Its first FleetAction bears a new number.
    void OnMessage(const MqttMessage& message, Core::Now now, FleetActions& out);
    void OnTimer(std::size_t vehicle, EMasterTimer timer, Core::Now now, FleetActions& out);

    [[nodiscard]] std::size_t GetSize() const noexcept;
    /// The session of a vehicle, for orders and questions. What its calls append is of this vehicle. The reference holds
    /// as long as the fleet. vehicle is less than GetSize.
    [[nodiscard]] MasterSession& GetSession(std::size_t vehicle);
    [[nodiscard]] const MasterSession& GetSession(std::size_t vehicle) const;
    [[nodiscard]] std::optional<std::size_t> FindOrNull(const VehicleAddress& address) const;
    /// Messages of vehicles that were not taken in: too many, unreadable, of another vehicle or major version than their
    /// topic says, or not discovered.
    [[nodiscard]] std::uint64_t GetLeftOutCount() const noexcept;
    /// The last of them, for the log; null where there was none.
    [[nodiscard]] const LeftOutMessage* GetLastLeftOutOrNull() const noexcept;
    /// The sum over all vehicles.
    [[nodiscard]] MasterStatistics GetStatistics() const;
};

} // namespace ACS::VDA5050
