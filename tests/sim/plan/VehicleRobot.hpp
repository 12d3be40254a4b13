#pragma once

#include "ChanceModel.hpp"
#include "EMutation.hpp"
#include "ISimulatedRobot.hpp"
#include "MqttBroker.hpp"
#include "TimerBank.hpp"
#include "Trace.hpp"
#include "TrayPortWorld.hpp"
#include "vda-sim/VirtualVehicle.hpp"
#include "WorkChecker.hpp"
#include <acs/plan/EngineOptions.hpp>
#include <acs/plan/SiteMap.hpp>

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Simulation
{

/// The virtual vehicle of vda-sim on the simulated broker. The checks use its pose and the state of its
/// actions.
class VehicleRobot final : public ISimulatedRobot, private VDA5050::IMqttLinkListener
{
public:
    /// What it needs from outside; everything outlives it.
    struct Dependencies
    {
        Timeline& timeline;
        Trace& trace;
        WorkChecker& workChecker;
        MqttBroker& broker;
        const Planning::SiteMap& site;
        bool bBatteries; ///< It starts with a battery that is nearly empty; otherwise full.
        EMutation mutation;
        bool bBadRadio; ///< As in the scenario.
        const Planning::RobotOptions& robot;
        bool bArms; ///< Control robots have one; otherwise the vehicle handles trays itself.
    };

private:
    Dependencies _around;
    ChanceModel _chance;
    std::string _robotID;
    bool _bFaulty;
    double _charge;           ///< Percent, at its start.
    TrayPortWorld _trayPorts; ///< The floor of a vehicle that carries trays.
    std::unique_ptr<VdaSim::VirtualVehicle> _vehicle;
    VdaSim::VirtualActions _actions;
    TimerBank<std::uint64_t> _timers;
    std::optional<MqttBroker::ClientID> _client;
    std::vector<std::string> _place;                       ///< As reported to the WorkChecker.
    VdaSim::Pose _shownPose;                               ///< At that time or shortly after.
    std::map<std::string, VDA5050::EActionStatus> _status; ///< Of its jobs, by commandID.
    bool _bDisturbed = false;
    bool _bLed = false; ///< In manual mode: its order is lost.
    std::uint32_t _handCount = 1000;
    bool _bReachable = true;

public:
    VehicleRobot(
        const Dependencies& around,
        const ChanceSeed& seed,
        std::string robotID,
        const std::string& nodeID,
        bool bFaulty);
    VehicleRobot(const VehicleRobot&) = delete;
    VehicleRobot& operator=(const VehicleRobot&) = delete;
    ~VehicleRobot() override;

    [[nodiscard]] std::unique_ptr<IRobotConnection> MakeConnection(std::uint64_t number, EventHandler handler) override;
    void SetReachable(bool bReachable) override;
    [[nodiscard]] bool IsReachable() const override;
    void Disturb() override;
    void Recover() override;
    [[nodiscard]] bool IsDisturbed() const override;
    void Forget() override;
    void OnFloorChanged() override;
    void Calm() override;
    [[nodiscard]] std::string GetNodeID() const override;
    [[nodiscard]] bool IsAtRest() const override;
    [[nodiscard]] bool IsWorkUnderWay() const override;
    [[nodiscard]] bool IsDriving() const;

private:
    void SwitchOn(const std::string& nodeID);
    void Equip(VdaSim::VirtualVehicleOptions& options);
    template <typename TCall>
    void Call(TCall call);
    void Execute(const VdaSim::VirtualAction& action);
    void Inject(VdaSim::Fault fault);
    void DriveByHand();
    void ShowPlace();
    void ShowJobs();
    void SeeFloor();
    [[nodiscard]] std::vector<std::string> FindPlace() const;
    void OnLinkUp() override;
    void OnLinkDown(std::error_code reason) override;
    void OnMqttMessage(const VDA5050::MqttMessage& message) override;
};

} // namespace ACS::Simulation
