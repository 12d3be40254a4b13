#pragma once

#include "common/config/Endpoint.hpp"
#include "floor/FloorChecker.hpp"
#include "plans/PlannedPlan.hpp"
#include "scenario/Scenario.hpp"
#include "wire/Profile.hpp"
#include "world/IWorld.hpp"
#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/protocol_beast/ServerOptions.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

namespace ACS::McsSim
{

class Screen;

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

/// The MCS of a run: serves one ACS at a time, sends it the plans or plays scenarios, shows what it reports, and closes
/// with a table.
/// One thread: the executor's.
class McsSimulator
{
public:
    /// Called once, after the table was printed: 0 if every plan was completed (with scenarios: every expectation held), no
    /// report was invalid, and no carrier was misplaced.
    using DoneHandler = std::function<void(int exitCode)>;

private:
    class Impl;

    std::unique_ptr<Impl> _impl;

public:
    /// Clock, random source, log sink and output outlive the simulator; so does the screen. Without a screen the output
    /// gets a line per change of state instead.
    McsSimulator(
        const boost::asio::any_io_executor& executor,
        const Core::IClock& clock,
        Core::IRandom& random,
        const Core::Logger& logger,
        const SimulatorOptions& options,
        std::vector<PlannedPlan> plans,
        std::ostream& out,
        Screen* screenOrNull,
        DoneHandler onDone);
    McsSimulator(const McsSimulator&) = delete;
    McsSimulator& operator=(const McsSimulator&) = delete;
    ~McsSimulator();

    /// Listens; returns the address. The error names the address and the remedy.
    [[nodiscard]] Core::Result<Apps::Endpoint> Start();

    /// From now on plans are sent, and the live view is drawn.
    void Release();

    /// A line of the console (GetConsoleHelp); what it does, or why not, goes to the output.
    void Execute(const std::string& line);

    /// Ends the run now, whatever its state. Harmless when it is ending already.
    void Interrupt();
};

} // namespace ACS::McsSim
