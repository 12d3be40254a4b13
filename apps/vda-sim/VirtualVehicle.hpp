#pragma once

#include "vda-sim/ActionRunner.hpp"
#include "vda-sim/VehicleMotion.hpp"
#include "vda-sim/VehicleSpec.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/plan/SiteMap.hpp>
#include <acs/vda5050/VehicleSession.hpp>

#include <cstdint>
#include <optional>
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

/// What a VirtualVehicle asks of its owner.
using VirtualAction = std::variant<VDA5050::PublishMessage, StartVirtualTimer, CancelVirtualTimer>;
using VirtualActions = std::vector<VirtualAction>;

struct VirtualVehicleOptions
{
    VDA5050::VehicleAddress address;
    VDA5050::EVda5050Version version = VDA5050::EVda5050Version::Version200;
    EVehicleType type = EVehicleType::Logistics;
    std::string startNodeID; ///< A node of the site.
    double timeScale = 1.0;  ///< Simulated seconds per second: of driving and handling, not of messages.
    MotionLimits limits;
};

/// A whole vehicle in software: a VehicleSession, the motion that carries out its legs, the actions, a battery.
/// Pure: time comes in, actions are appended to out. The site must outlive it; from it come the start position and,
/// ahead of a node that is passed, the speed for the way that follows.
class VirtualVehicle
{
    VirtualVehicleOptions _options;
    const Planning::SiteMap* _site;
    Core::Logger _logger;
    VDA5050::VehicleSession _session;
    VDA5050::VehicleActions _sessionActions;
    VehicleMotion _motion;
    ActionRunner _hands;
    std::vector<ActionOutcome> _outcomes;
    std::optional<VDA5050::DriveTo> _leg;
    std::optional<Core::SteadyTime> _lastTime;
    std::string _nodeID; ///< Where it stands or was last.
    std::string _mapID;
    double _charge = 100.0; ///< %
    std::size_t _reportedLoads = 0;
    bool _bDriving = false;
    bool _bTicking = false;

public:
    VirtualVehicle(VirtualVehicleOptions options, const Planning::SiteMap& site, Core::Logger logger);

    [[nodiscard]] std::vector<VDA5050::MqttSubscription> GetSubscriptions() const;
    [[nodiscard]] VDA5050::MqttWill MakeWill(Core::Now now);

    void OnLinkUp(Core::Now now, VirtualActions& out);
    void OnLinkDown(Core::Now now, VirtualActions& out);
    void OnMessage(const VDA5050::MqttMessage& message, Core::Now now, VirtualActions& out);
    void OnTimer(std::uint64_t key, Core::Now now, VirtualActions& out);
    /// Publishes OFFLINE, as the last message.
    void Leave(Core::Now now, VirtualActions& out);

    [[nodiscard]] VDA5050::StateMessage GetState() const;
    [[nodiscard]] const Pose& GetPose() const noexcept;
    [[nodiscard]] const std::string& GetName() const noexcept;

private:
    void PassTime(Core::Now now, VirtualActions& out);
    void Live(double seconds, Core::Now now, VirtualActions& out);
    void ReachNode(Core::Now now, VirtualActions& out);
    void EndActions(Core::Now now, VirtualActions& out);
    /// Carries out what the session has asked for, and what that leads to.
    void Pump(Core::Now now, VirtualActions& out);
    void CarryOut(VDA5050::VehicleAction& action, Core::Now now, VirtualActions& out);
    void TellPosition();
    void TellDriving(bool bDriving, Core::Now now);
    void TellBattery(Core::Now now);
    void TellLoads(Core::Now now);
    void KeepTicking(VirtualActions& out);

    void Drive(const VDA5050::DriveTo& drive, Core::Now now);
    [[nodiscard]] MotionLeg MakeLeg(const VDA5050::DriveTo& drive) const;
    [[nodiscard]] double GetExitSpeed(const VDA5050::DriveTo& drive, const MotionLeg& leg) const;
    [[nodiscard]] Pose GetNodePose(const VDA5050::OrderNode& node) const;
    void Start(const VDA5050::StartAction& start, Core::Now now);
    void SetStatus(std::string_view actionID, VDA5050::EActionStatus status, std::string result, Core::Now now);
    void Log(const VDA5050::OrderRefused& refused) const;
    [[nodiscard]] bool IsAtCharger() const;
};

/// The pose of a vehicle that stands on the node, with the heading that the site gives it there.
[[nodiscard]] Pose GetStartPose(const Planning::SiteNode& node);

} // namespace ACS::VdaSim
