#pragma once

#include "faults/FaultSchedule.hpp"
#include "IAcsLink.hpp"
#include "judge/McsJudge.hpp"
#include "model/PlanExecutor.hpp"
#include "NoOutboxStore.hpp"
#include "RecentMap.hpp"
#include <acs/core/IRandom.hpp>
#include <acs/core/Now.hpp>
#include <acs/protocol/DurableOutbox.hpp>
#include <acs/protocol/SessionEvent.hpp>

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ACS::AcsSim
{

/// The ACS of a run: executes the plans of the MCS, and makes the errors of the command line. Pure: it runs on the times that
/// its caller passes.
class SimulatedACS
{
public:
    struct Options
    {
        PlanExecutor::Options executor;
        std::vector<FaultOrder> faults;
        Core::Duration faultInterval = std::chrono::milliseconds(500); ///< Between two faults, while registered.
        Core::Duration faultTime = std::chrono::seconds(3);            ///< Of faults that last.
        std::size_t plans = 0; ///< It is done when this number has ended; 0: never.
    };

    using Printer = std::function<void(const std::string& line)>;

private:
    using KeptReport = std::pair<Protocol::AcsPayload, Core::Timestamp>;

    Options _options;
    IAcsLink& _link;
    McsJudge& _judge;
    Core::IRandom& _random;
    Printer _print;
    PlanExecutor _executor;
    NoOutboxStore _store;
    Protocol::DurableOutbox _outbox;
    FaultSchedule _schedule;
    std::map<EFault, std::size_t> _armed; ///< Faults that wait for their moment.
    std::optional<KeptReport> _kept;      ///< The report that is sent after its successor.
    std::vector<std::pair<Core::SteadyTime, SendAnswer>> _lateAnswers;
    RecentMap<SendAnswer> _answers; ///< By command and transactionID: a request may be repeated after a cut.
    std::optional<Core::SteadyTime> _heldUntil;      ///< Reports are held.
    std::optional<Core::SteadyTime> _connectedAgain; ///< When isConnected becomes true again.
    std::optional<Core::SteadyTime> _nextFault;      ///< While registered.
    std::optional<Core::SteadyTime> _cutAt;
    /// When the wanted number of plans has ended: the transactionIDs of what is not answered yet, in both directions.
    std::optional<std::set<std::string>> _lastWaiting;
    std::size_t _registrations = 0;

public:
    SimulatedACS(Options options, IAcsLink& link, McsJudge& judge, Core::IRandom& random, Printer print);

    /// Sets the states; the link connects after this.
    void Start();
    void OnEvent(const Protocol::SessionEvent& event, Core::Now now);
    void OnTimer(Core::Now now);
    [[nodiscard]] std::optional<Core::SteadyTime> GetNextDueOrNull() const;

    /// The wanted number of plans has ended, all faults have occurred, and all requests up to then are answered.
    [[nodiscard]] bool IsDone() const;
    [[nodiscard]] bool WasRegistered() const;
    [[nodiscard]] std::size_t CountEndedPlans() const;
    /// Those that have found no moment.
    [[nodiscard]] std::vector<EFault> ListArmedFaults() const;

private:
    void Execute(const ExecutorActions& actions, Core::Now now);
    void Report(const Protocol::AcsPayload& payload, Core::Now now);
    void AddReport(const Protocol::AcsPayload& payload, const Core::Timestamp& time, bool bExcused);
    void Answer(const SendAnswer& answer, Core::Now now);
    void SendAnswerNow(const SendAnswer& answer);
    void SendStates();
    void Feed();
    /// The transactionIDs of the requests of both directions that are not answered and can still be in time.
    [[nodiscard]] std::set<std::string> ListWaiting() const;
    void NoteGoal();

    void OnRegistered(Core::Now now);
    void OnAcked(const Protocol::Acked& acked, Core::Now now);
    void OnRequest(const Protocol::AcsRequest& request, Core::Now now);

    void BeginFault(EFault fault, Core::Now now);
    [[nodiscard]] bool TryUse(EFault fault);
    void Cut();
    [[nodiscard]] std::string MakeText(const std::string& command, const std::string& payload, Core::Now now);
};

} // namespace ACS::AcsSim
