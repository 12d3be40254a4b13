#pragma once

#include "common/log/LogRateLimiter.hpp"
#include "vda-sim/ActionRunner.hpp"
#include "vda-sim/Battery.hpp"
#include "vda-sim/FaultSchedule.hpp"
#include "vda-sim/MessageGate.hpp"
#include "vda-sim/SliceClock.hpp"
#include "vda-sim/VehicleDrive.hpp"
#include "vda-sim/VehicleProfile.hpp"
#include "vda-sim/VehicleSpec.hpp"
#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/plan/SiteMap.hpp>
#include <acs/vda5050/VehicleSession.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace ACS::VdaSim
{

/// To do: call OnTimer with the key after the delay; replaces a running timer of the same key.
struct StartVirtualTimer
{
    std::uint64_t key = 0;
    Core::Duration delay{};
};

struct CancelVirtualTimer
{
    std::uint64_t key = 0;
};

/// To do: end the connection and do not open another until OpenLink. With a will: like a cable that is pulled; else with an
/// MQTT DISCONNECT but without OFFLINE. The vehicle regards it as down already: do not call OnLinkDown.
struct CutLink
{
    bool bWill = true;
};

/// To do: connect again.
struct OpenLink
{
};

/// What the owner of a VirtualVehicle has to do.
using VirtualAction = std::variant<VDA5050::PublishMessage, StartVirtualTimer, CancelVirtualTimer, CutLink, OpenLink>;
using VirtualActions = std::vector<VirtualAction>;

struct VirtualVehicleOptions
{
    VDA5050::VehicleAddress address;
    VDA5050::EVda5050Version version = VDA5050::EVda5050Version::Version200;
    VDA5050::QosTable qos{};
    EVehicleType type = EVehicleType::Logistics;
    std::string startNodeID; ///< A node of the site.
    double timeScale = 1.0;  ///< Simulated seconds per second: of driving and handling, not of messages or faults.
    MotionLimits limits{};
    double charge = 100.0;                                      ///< % at first.
    std::map<std::string, double, std::less<>> actionSeconds{}; ///< Simulated, by actionType.
    LoadHandling handling{};
    VDA5050::EParameterCheck parameterCheck = VDA5050::EParameterCheck::Strict;
    Sim::IWorld* worldOrNull =
        nullptr; ///< The shared floor, which outlives it; null: every pick and drop finds its load.
    std::optional<StartPosition> startPosition{}; ///< Absent: that of the node.
    EVehicleProfile profile = EVehicleProfile::Standard;
};

/// A simulated vehicle: a VehicleSession, the motion, the actions, the battery and the faults. Pure: time is a parameter,
/// actions are appended to out. The site gives the start position and the positions of nodes that an order contains
/// without one. The site and the random source must outlive it.
class VirtualVehicle
{
    static constexpr std::uint64_t KEY_TICK = 100;  ///< Above the keys of the session's own timers.
    static constexpr std::uint64_t KEY_EVENT = 101; ///< A fault or a delayed message is due.

    VirtualVehicleOptions _options;
    const Planning::SiteMap* _site;
    Core::IRandom* _random;
    Core::Logger _logger;
    std::shared_ptr<bool> _lost = std::make_shared<bool>(false); ///< Of the fault; shared with the check of orders.
    /// Maps that orders cannot use, as of the last message; shared with the check of orders.
    std::shared_ptr<std::set<std::string>> _disabledMapIDs = std::make_shared<std::set<std::string>>();
    VDA5050::VehicleSession _session;
    VDA5050::VehicleActions _sessionActions;
    VehicleDrive _drive;
    ActionRunner _actionRunner;
    Battery _battery;
    SliceClock _clock;
    /// As the world has it; empty: not docked; nullopt: not recorded yet, retry at the next tick.
    std::optional<std::string> _dockNodeID;
    bool _bDriving = false; ///< As the session has it.
    FaultSchedule _faults;
    MessageGate _incoming;
    MessageGate _outgoing{EFaultDirection::Out};
    std::vector<VDA5050::VehicleError> _orderErrors; ///< Until an order is accepted.
    std::optional<Core::SteadyTime> _nextEvent;      ///< What the event timer runs for.
    Apps::LogRateLimiter _warnings;                  ///< Those that a peer can trigger.

public:
    VirtualVehicle(
        VirtualVehicleOptions options,
        const Planning::SiteMap& site,
        Core::IRandom& random,
        Core::Logger logger);

    [[nodiscard]] std::vector<VDA5050::MqttSubscription> GetSubscriptions() const;
    [[nodiscard]] VDA5050::MqttWill MakeWill(Core::Now now);

    void OnLinkUp(Core::Now now, VirtualActions& out);
    void OnLinkDown(Core::Now now, VirtualActions& out);
    void OnMessage(const VDA5050::MqttMessage& message, Core::Now now, VirtualActions& out);
    void OnTimer(std::uint64_t key, Core::Now now, VirtualActions& out);
    /// Publishes OFFLINE, as the last message.
    void Leave(Core::Now now, VirtualActions& out);
    /// The world has changed: the loads on board may have changed too.
    void OnWorldChanged(Core::Now now, VirtualActions& out);

    /// The delay of the fault counts from now, or from the first OnLinkUp if that is still to come. False if the vehicle
    /// already has FaultBoard::MAX_FAULTS.
    [[nodiscard]] bool TryInject(const Fault& fault, Core::Now now, VirtualActions& out);
    /// Ends the faults of the kind (absent: all), those that have not begun included. Returns the number of them.
    std::size_t EndFaults(std::optional<EFaultKind> kindOrNull, Core::Now now, VirtualActions& out);
    /// Ends every running waitForTrigger. Returns the number of them.
    std::size_t Trigger(Core::Now now, VirtualActions& out);

    [[nodiscard]] VDA5050::StateMessage GetState() const;
    [[nodiscard]] const Pose& GetPose() const noexcept;

private:
    void PassTime(Core::Now now, VirtualActions& out);
    void AdvanceSlice(Core::Now now, VirtualActions& out);
    void OnNodeReached(const VDA5050::DriveTo& leg, Core::Now now, VirtualActions& out);
    void EndActions(std::vector<ActionOutcome> outcomes, Core::Now now, VirtualActions& out);
    /// Executes the session's actions, and those that result from them.
    void Pump(Core::Now now, VirtualActions& out);
    void CarryOut(VDA5050::VehicleAction& action, Core::Now now, VirtualActions& out);
    void ReportPosition();
    void ReportDriving(bool bDriving, Core::Now now);
    void ReportBattery(Core::Now now);
    void ReportLoads(Core::Now now);
    /// Reports the maps of the site, as those that the vehicle has at first.
    void ReportMaps(Core::Now now);
    void UpdateDisabledMaps();
    /// Records in the world at which stations the vehicle is docked, if that has changed.
    void UpdateDock(Core::Now now);
    void KeepTicking(VirtualActions& out);
    /// Ends each public call: executes the session's actions and sets the timers.
    void Settle(Core::Now now, VirtualActions& out);

    void ApplyFaults(Core::Now now, VirtualActions& out);
    void ApplyFault(const FaultChange& change, Core::Now now, VirtualActions& out);
    void ReportCondition(Core::Now now);
    void UpdateBrake(Core::Now now);
    [[nodiscard]] std::vector<VDA5050::VehicleError> MakeErrors() const;
    void AddOrderError(VDA5050::VehicleError error, Core::Now now);
    [[nodiscard]] bool TryRefuse(const VDA5050::MqttMessage& message, Core::Now now, VirtualActions& out);
    [[nodiscard]] std::optional<VDA5050::VehicleError> UseActionFaultOrNull(
        const VDA5050::Action& action,
        bool bAtStart);
    void Deliver(const VDA5050::MqttMessage& message, Core::Now now, VirtualActions& out);
    void Send(VDA5050::MqttMessage message, Core::Now now, VirtualActions& out);
    void ReleaseMessages(Core::Now now, VirtualActions& out);
    void ScheduleEvents(Core::Now now, VirtualActions& out);

    void Drive(const VDA5050::DriveTo& drive, Core::Now now);
    void Start(const VDA5050::StartAction& start, Core::Now now);
    [[nodiscard]] std::string InitialisePosition(const VDA5050::Action& action, Core::Now now);
    /// Logs why a pick or a drop has failed.
    void LogFailure(const ActionOutcome& outcome, Core::Now now);
    void SetStatus(std::string_view actionID, VDA5050::EActionStatus status, std::string result, Core::Now now);
    /// Logs parameters of the action that the factsheet does not list.
    void LogUnlisted(const std::string& actionID, Core::Now now);
    void LogRefusal(const VDA5050::OrderRefused& refused, Core::Now now);
    void LogIgnored(const VDA5050::MessageIgnored& ignored, Core::Now now);
    /// Logs what of a message is not as the standard has it.
    void LogTolerated(const VDA5050::MqttMessage& message, Core::Now now);
    void LogOverflow(std::size_t lost, Core::Now now);
    /// Rate-limited by message.
    void LogWarning(Core::Now now, std::string_view message, std::initializer_list<Core::LogField> fields);
    [[nodiscard]] bool IsAtCharger() const;
};

} // namespace ACS::VdaSim
