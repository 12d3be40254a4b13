#pragma once

#include "common/config/Endpoint.hpp"
#include "common/process/TimerSet.hpp"
#include "console/ConsoleCommand.hpp"
#include "console/RunOutput.hpp"
#include "plans/PlannedPlan.hpp"
#include "plans/PlanRefresher.hpp"
#include "plans/PlanSender.hpp"
#include "RunJudge.hpp"
#include "scenario/ScenarioPlayer.hpp"
#include "SimulatorOptions.hpp"
#include "wire/SimulatedMcsSession.hpp"
#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/protocol_beast/ISessionHandler.hpp>
#include <acs/protocol_beast/McsServer.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::McsSim
{

/// The MCS of a run: serves one ACS at a time, sends it the plans or plays scenarios, shows what it reports, and closes
/// with a table.
/// One thread: the executor's.
class McsSimulator final : private ProtocolBeast::ISessionHandler
{
public:
    /// Called once, after the table was printed: 0 if every plan was completed (with scenarios: every expectation held), no
    /// report was invalid, and no carrier was misplaced.
    using DoneHandler = std::function<void(int exitCode)>;

private:
    enum class ETimer : std::uint8_t
    {
        Tick,   ///< Time to draw, and to see whether an Ack is overdue.
        Linger, ///< All plans have ended: late messages of the ACS are still checked.
        Close,  ///< The ACS does not answer the closing handshake.
        Delay,  ///< A delayed Ack is due.
    };

    enum class EPhase : std::uint8_t
    {
        Waiting,  ///< For Release.
        Released, ///< Plans are sent.
        Ending,   ///< The connection is being closed.
        Done
    };

    const Core::IClock& _clock;
    Core::IRandom& _random;
    Core::Logger _logger;
    SimulatorOptions _options;
    RunOutput _output;
    PlanTracker::Lines& _lines; ///< Of the output.
    DoneHandler _onDone;
    boost::asio::any_io_executor _executor;
    RunJudge _judge;
    PlanTracker& _tracker; ///< Of the judge.
    PlanRefresher _refresher;
    PlanSender _sender;
    ScenarioPlayer _scenarios;
    EPhase _phase = EPhase::Waiting;
    std::unique_ptr<ProtocolBeast::McsServer> _server;
    SimulatedMcsSession* _sessionOrNull = nullptr; ///< Of the server.
    Apps::TimerSet<ETimer> _timers;

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

    /// Listens; returns the address. The error names the address and the remedy.
    [[nodiscard]] Core::Result<Apps::Endpoint> Start();

    /// From now on plans are sent, and the live view is drawn.
    void Release();

    /// A line of the console (GetConsoleHelp); what it does, or why not, goes to the output.
    void Execute(const std::string& line);

    /// Ends the run now, whatever its state. Harmless when it is ending already.
    void Interrupt();

private:
    void Execute(const ConsoleCommand& command);
    void AddPlanOfFile(const std::string& path);
    void SendControl(const Protocol::AcsPayload& payload);
    void OnSessionEvent(const Protocol::SessionEvent& event) override;
    void CheckFinished();
    void OnWire(ProtocolBeast::EWireDirection direction, Protocol::ConnectionID connection, std::string_view text);
    void OnRegistered();
    void OnLinkLost(const Protocol::LinkLost& lost);
    void SendDue();
    [[nodiscard]] bool TrySendPlan(const Protocol::ExecutionPlan& plan, const std::string& transactionID);
    void OnTimer(ETimer timer);
    void OnPlayed();
    void OnFinished();
    void End();
    void FinishRun();
    void PrintSummary();
    void FinishPlans();
    void FinishScenarios();
    void PrintDeliveries();
    void Draw();
};

} // namespace ACS::McsSim
