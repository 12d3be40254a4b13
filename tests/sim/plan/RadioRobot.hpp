#pragma once

#include "ISimulatedRobot.hpp"
#include "MemoryRobot.hpp"
#include "RobotRadio.hpp"

#include <cstdint>
#include <memory>
#include <string>

namespace ACS::Simulation
{

/// A robot in memory with a radio.
class RadioRobot final : public ISimulatedRobot
{
public:
    struct Seeds
    {
        ChanceSeed robot;
        ChanceSeed radio;
    };

private:
    Timeline& _timeline;
    MemoryRobot _robot;
    RobotRadio _radio;

public:
    RadioRobot(
        Timeline& timeline,
        Trace& trace,
        WorkChecker& workChecker,
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
};

} // namespace ACS::Simulation
