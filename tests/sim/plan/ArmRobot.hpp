#pragma once

#include "ArmController.hpp"
#include "ChanceModel.hpp"
#include "ISimulatedRobot.hpp"
#include "VehicleRobot.hpp"

#include <memory>
#include <string>

namespace ACS::Simulation
{

/// A control robot: a VDA5050 vehicle with an arm over Open Stream.
class ArmRobot final : public ISimulatedRobot
{
public:
    struct Seeds
    {
        ChanceSeed base;
        ArmController::Seeds arm;
        ChanceSeed trouble; ///< Decides which component has the fault.
    };

private:
    Timeline& _timeline;
    MqttBroker& _broker;
    const Planning::RobotOptions& _robot;
    ChanceModel _chance;
    VehicleRobot _base;
    mutable ArmController _arm; ///< Mutable: a query brings it to the present time.
    bool _bReachable = true;
    bool _bArmDisturbed = false;

public:
    ArmRobot(
        const VehicleRobot::Dependencies& around,
        const Seeds& seeds,
        const std::string& robotID,
        const std::string& nodeID,
        bool bFaulty);

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
    /// A program of the arm runs.
    [[nodiscard]] bool IsPlaying() const;
    [[nodiscard]] bool IsDriving() const;
};

} // namespace ACS::Simulation
