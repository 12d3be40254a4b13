#pragma once

#include "ChanceModel.hpp"
#include "mcs-sim/wire/SimulatedMcsSession.hpp"
#include "McsJudge.hpp"
#include "Scenario.hpp"
#include "TextNetwork.hpp"
#include "TimerBank.hpp"
#include "Trace.hpp"

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <vector>

namespace ACS::Simulation
{

/// The MCS and its operators: sends plans, controls and queries at any moment, repeats requests without an Ack, delays
/// its own Acks. Passes all that it receives to the judge.
class McsSide final : public ITextPeer
{
    enum class EBehaviour : std::uint8_t
    {
        SendPlan,
        SendControl,
        Ask,
        Misbehave,
        EndMisbehaving,
        Settle,
    };

    enum class EDelay : std::uint8_t
    {
        Ack,
    };

    Timeline& _timeline;
    Trace& _trace;
    TextNetwork& _network;
    McsJudge& _judge;
    WorkChecker& _workChecker;
    const Scenario& _scenario;
    ChanceModel _chance;
    ChanceModel _idChance;
    McsSim::SimulatedMcsSession _session;
    TimerBank<Protocol::ESessionTimer> _sessionTimers;
    TimerBank<EDelay> _delays; ///< Not ended with the faults.
    TimerBank<EBehaviour> _behaviours;
    std::deque<Protocol::SessionAction> _actions;
    bool _bActing = false;
    std::vector<std::string> _planIDs;                       ///< Of all plans that were sent.
    std::map<std::string, Protocol::AcsRequest> _unanswered; ///< By transactionID: to be sent, or sent without an Ack.
    bool _bSettling = false;

public:
    McsSide(
        Timeline& timeline,
        Trace& trace,
        TextNetwork& network,
        McsJudge& judge,
        WorkChecker& workChecker,
        const Scenario& scenario);

    void Begin();

    /// No new plans and faults from now on: what is open is completed, what is paused is resumed.
    void BeginSettling();

    /// Whether no message waits to be sent or for an Ack.
    [[nodiscard]] bool IsSettled() const;

    void OnOpened(Protocol::ConnectionID connection) override;
    void OnText(Protocol::ConnectionID connection, const std::string& text) override;
    void OnClosed(Protocol::ConnectionID connection, const std::string& reason) override;

private:
    template <typename TCall>
    void Run(TCall call);
    void Act(const Protocol::SessionAction& action);
    void Take(const Protocol::SessionEvent& event);
    void OnAck(const Protocol::AcsAck& ack);
    void OnUnanswered(const std::string& transactionID);
    void Send(const Protocol::AcsRequest& request);
    void SendPlan();
    void SendControl(Planning::EPlanControl control, const std::string& planID);
    void SendRandomControl();
    void Ask();
    void Misbehave();
    void Settle();
};

} // namespace ACS::Simulation
