#pragma once

#include "ArmRobot.hpp"
#include "IRobotConnection.hpp"
#include "MqttBroker.hpp"
#include "Timeline.hpp"
#include "Trace.hpp"
#include "WorkChecker.hpp"
#include <acs/adapter_test/IAdapterBench.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::Testing
{

/// A simulated control robot: acsd's adapter of a vehicle with an arm over Open Stream. The link is the robot's radio, over
/// which the base or the arm or both are lost.
class ArmBench final : public AdapterTest::IAdapterBench
{
    /// Passes commands to the adapter of a simulated robot, which has its own host, and events back.
    class Forwarder;

    /// The simulation has a time of its own, which follows that of the suite.
    struct World
    {
        Simulation::Timeline timeline;
        Simulation::Trace trace;
        Simulation::WorkChecker workChecker;
        Simulation::MqttBroker broker;
        Simulation::ArmRobot robot;

        World(const Planning::SiteMap& site, const Planning::RobotOptions& options, std::uint64_t seed);
    };

    const std::uint64_t _seed;
    const Planning::SiteMap _site;
    const Planning::RobotOptions _robotOptions;
    AdapterTest::IVirtualTime* _timeOrNull = nullptr;
    std::unique_ptr<World> _world;
    std::unique_ptr<Forwarder> _adapter;
    std::uint64_t _connection = 0;
    mutable std::string _nodeID;             ///< On which the robot was last.
    std::optional<Core::SteadyTime> _wakeAt; ///< When the simulation continues.

public:
    explicit ArmBench(std::uint64_t seed);
    ArmBench(const ArmBench&) = delete;
    ArmBench& operator=(const ArmBench&) = delete;
    ~ArmBench() override;

    [[nodiscard]] AdapterTest::BenchOptions GetOptions() const override;
    [[nodiscard]] Planning::StartJob MakeJob(std::size_t number) const override;
    void MakeRobot(AdapterTest::IVirtualTime& time) override;
    [[nodiscard]] Planning::IRobotAdapter& MakeAdapter(AdapterTest::IAdapterHost& host) override;
    void DestroyAdapter() override;
    void DestroyRobot() override;
    void OnAdapterCalled() override;
    void SetLink(bool bUp) override;
    void SetConduct(AdapterTest::EConduct conduct) override;
    [[nodiscard]] AdapterTest::RobotTruth GetTruth() const override;

private:
    /// Runs what is due in the simulation.
    void Continue();
    void WakeLater();
};

} // namespace ACS::Testing
