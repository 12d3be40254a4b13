#pragma once

#include "common/config/Endpoint.hpp"
#include "floor/FloorChecker.hpp"
#include "scenario/Scenario.hpp"
#include "wire/Profile.hpp"
#include "world/IWorld.hpp"
#include <acs/protocol_beast/ServerOptions.hpp>

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ACS::McsSim
{

/// How a run of mcs-sim is served and shown.
struct SimulatorOptions
{
    Apps::Endpoint listen{"127.0.0.1", 0};
    std::string path = "/acs/";
    std::chrono::minutes siteOffset{0}; ///< Of the timestamps that are sent.
    bool bKeep = false;                 ///< Do not end by itself.
    std::size_t columns = 100;          ///< Of the live view and the closing table.
    std::size_t rows = 24;
    std::optional<ProtocolBeast::TlsOptions> tls{}; ///< There: wss.
    ProtocolBeast::WireObserver onWire;             ///< For a trace; may be empty.
    std::vector<Scenario> scenarios; ///< Where there are any, they decide what is sent, and there are no plans.
    std::string date; ///< Eight digits (20261121), for the fresh planIds of scenarios and of the console.
    EProfile profile = EProfile::Spec;
    bool bFreshPlans = false; ///< The plans were made for this run: in the profile nexus they name their robot.
    bool bConsole = false;    ///< Execute is called; the run ends on request.
    Sim::IWorld* worldOrNull =
        nullptr; ///< What the robots have moved, to compare the reports with. Outlives the simulator.
    EStocking stocking = EStocking::Leave; ///< With a world. Carriers get fresh ids only where the floor is restocked.
};

} // namespace ACS::McsSim
