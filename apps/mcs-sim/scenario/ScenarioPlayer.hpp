#pragma once

#include "common/process/TimerSet.hpp"
#include "plans/PlanSender.hpp"
#include "plans/PlanTracker.hpp"
#include "scenario/ScenarioAction.hpp"
#include "scenario/ScenarioSequence.hpp"
#include "wire/NoteJudge.hpp"
#include "wire/SimulatedMcsSession.hpp"
#include "wire/WireFilter.hpp"
#include <acs/core/IRandom.hpp>
#include <acs/core/Now.hpp>
#include <acs/protocol_beast/McsServer.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::McsSim
{

/// What scenarios act on besides the server. All of it outlives the player.
struct ScenarioStage
{
    const Core::IClock& clock;
    Core::IRandom& random;
    PlanSender& sender;
    NoteJudge& notes;
    PlanTracker::Lines& lines; ///< Gets the lines for people.
};

/// Plays the scenarios of a run over a server: hands them what comes from the registered ACS, in its order, and does what
/// they want done. One thread: the executor's.
class ScenarioPlayer
{
    enum class ETimer : std::uint8_t
    {
        Inbox,    ///< Texts wait for the scenario.
        Scenario, ///< The one that the scenario has asked for.
    };

    ScenarioStage _stage;
    ScenarioSequence _scenarios;
    WireFilter _wireFilter;
    std::deque<std::string> _inbox; ///< What came from the ACS, for the scenarios.
    ProtocolBeast::McsServer* _serverOrNull = nullptr;
    SimulatedMcsSession* _sessionOrNull = nullptr;
    std::function<void()> _onPlayed;
    bool _bEnded = false;
    Apps::TimerSet<ETimer> _timers;

public:
    /// @param onPlayed Called whenever a timer of the player has continued or ended a scenario.
    ScenarioPlayer(
        const boost::asio::any_io_executor& executor,
        const ScenarioStage& stage,
        std::vector<Scenario> scenarios,
        PlanRefresher refresher,
        std::function<void()> onPlayed);

    /// Before all other functions. Server and session must outlive the player's last call.
    void SetServer(ProtocolBeast::McsServer& server, SimulatedMcsSession& session) noexcept;

    void Start();
    void OnRegistered();
    void OnLinkLost();
    /// Every text of the server. Those for the scenarios wait for ReadInbox, which comes by itself too: what a scenario
    /// does must not come between the server and its session.
    void OnWire(ProtocolBeast::EWireDirection direction, Protocol::ConnectionID connection, std::string_view text);
    void ReadInbox();
    /// Nothing is done any more.
    void End();

    /// Also where there are no scenarios.
    [[nodiscard]] bool IsFinished() const noexcept;
    [[nodiscard]] bool IsEmpty() const noexcept;
    [[nodiscard]] bool HasHeld() const;
    [[nodiscard]] std::vector<ScenarioResult> GetResults() const;

private:
    void Play(const std::function<void(Core::Now now, ScenarioActions& out)>& call);
    /// Does it. False where there is no ACS to send to.
    [[nodiscard]] bool CanPerform(const ScenarioAction& action);
    void OnTimer(ETimer timer);
};

} // namespace ACS::McsSim
