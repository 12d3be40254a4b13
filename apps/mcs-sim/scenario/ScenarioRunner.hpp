#pragma once

#include "plans/PlanRefresher.hpp"
#include "scenario/PatternMatch.hpp"
#include "scenario/Placeholders.hpp"
#include "scenario/ScenarioAction.hpp"
#include <acs/core/Now.hpp>
#include <acs/protocol/AcsCodec.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_set>
#include <vector>

namespace ACS::McsSim
{

enum class EVerdict : std::uint8_t
{
    Held,
    Failed,
    NotReached, ///< A step before it failed, or the run was ended.
};

/// What came of a step.
struct StepVerdict
{
    std::size_t number = 0; ///< From 1.
    std::string title;
    EVerdict verdict = EVerdict::NotReached;
    bool bExpectation = false; ///< Otherwise an action, which is reported only if it failed.
    std::string reason;        ///< Of a failure.
    std::chrono::milliseconds duration{0};
};

/// Runs one scenario as a pure state machine: what happened and the time go in, what is to be done comes out. The first
/// step that fails ends it. An expectation checks the messages since the last action, or since the message that
/// fulfilled an expectation after it; what it skips is gone.
class ScenarioRunner
{
public:
    /// Maximum number of messages kept for expectations; then the oldest is dropped.
    static constexpr std::size_t MAX_KEPT = 10'000;
    /// Maximum number of transactions remembered in order to recognise repeated messages.
    static constexpr std::size_t MAX_TRANSACTIONS = 100'000;

private:
    enum class EProgress : std::uint8_t
    {
        Done,
        Waiting,
        Failed,
    };

    struct KeptMessage
    {
        std::string command;
        std::string text;
        bool bRepeated = false; ///< Its transactionId came before.
    };

    Scenario _scenario;
    PlanRefresher& _refresher;
    Core::IRandom& _random;
    Protocol::AcsCodec _codec;
    ScenarioNames _names;
    std::map<std::string, Protocol::EPlanStatus> _planStatus;
    std::deque<KeptMessage> _kept;
    std::unordered_set<std::string> _transactions; ///< Of all messages so far, each with its command.
    std::vector<MessagePattern> _open;             ///< Of the present step: those of a group that have not come yet.
    std::size_t _scanned = 0;                      ///< Number of kept messages that the current step has checked.
    std::vector<StepVerdict> _verdicts;
    std::size_t _index = 0;
    bool _bStarted = false;
    bool _bEntered = false;
    bool _bRegistered = false;
    Core::SteadyTime _entered{};
    Core::SteadyTime _deadline{};
    std::size_t _candidates = 0; ///< Messages of the right command that did not match.
    std::string _mismatch;       ///< Of the last of them.
    std::string _failure;        ///< Of the present step.

public:
    /// Refresher and random source outlive the runner.
    ScenarioRunner(Scenario scenario, PlanRefresher& refresher, Core::IRandom& random);

    /// Everything the other functions may append too: any ScenarioAction.
    void Start(bool bRegistered, Core::Now now, ScenarioActions& out);
    void OnRegistered(Core::Now now, ScenarioActions& out);
    void OnLinkLost();
    /// Any text that came from the ACS.
    void OnMessage(std::string_view text, Core::Now now, ScenarioActions& out);
    void OnTimer(Core::Now now, ScenarioActions& out);
    /// An action could not be carried out, because the link had just gone: the scenario fails.
    void OnSendFailed(Core::Now now, ScenarioActions& out);

    [[nodiscard]] const std::string& GetName() const noexcept;
    [[nodiscard]] bool IsFinished() const noexcept;
    /// Whether the ACS was registered by the last event that the scenario got. After a drop it is not, before the link is gone.
    [[nodiscard]] bool IsRegistered() const noexcept;
    /// One per step.
    [[nodiscard]] const std::vector<StepVerdict>& GetVerdicts() const noexcept;
    /// Whether every expectation held, and everything else could be done.
    [[nodiscard]] bool HasHeld() const;

private:
    void Advance(Core::Now now, ScenarioActions& out);
    void Enter(Core::Now now, ScenarioActions& out);
    void Leave(EProgress progress, Core::Now now, ScenarioActions& out);
    [[nodiscard]] EProgress Try(Core::Now now, ScenarioActions& out);
    [[nodiscard]] EProgress Do(const SendPlanStep& step, Core::Now now, ScenarioActions& out);
    [[nodiscard]] EProgress Do(const SendAgainStep& step, Core::Now now, ScenarioActions& out);
    [[nodiscard]] EProgress Do(const SendRequestStep& step, Core::Now now, ScenarioActions& out);
    [[nodiscard]] EProgress Do(const SendTextStep& step, Core::Now now, ScenarioActions& out);
    [[nodiscard]] EProgress Do(const ExpectStep& step, Core::Now now, ScenarioActions& out);
    [[nodiscard]] EProgress Do(const ExpectNextStep& step, Core::Now now, ScenarioActions& out);
    [[nodiscard]] EProgress Do(const ExpectNothingStep& step, Core::Now now, ScenarioActions& out);
    [[nodiscard]] EProgress Do(const WaitForPlanStep& step, Core::Now now, ScenarioActions& out);
    [[nodiscard]] EProgress Do(const WaitStep& step, Core::Now now, ScenarioActions& out);
    [[nodiscard]] EProgress Do(const AskStep& step, Core::Now now, ScenarioActions& out);
    [[nodiscard]] EProgress Do(const DropStep& step, Core::Now now, ScenarioActions& out);
    [[nodiscard]] EProgress Do(const HoldAcksStep& step, Core::Now now, ScenarioActions& out);
    [[nodiscard]] EProgress Do(const RefuseRegistrationStep& step, Core::Now now, ScenarioActions& out);
    [[nodiscard]] EProgress Fail(std::string reason);
    /// Looks on through what is kept; nullopt where nothing matches so far.
    [[nodiscard]] std::optional<std::size_t> FindMatchOrNull(const MessagePattern& pattern);
    /// Takes what is kept for the group; why it does not fit, where it does not.
    [[nodiscard]] std::optional<std::string> TakeNextOrNull(const ExpectNextStep& step);
    [[nodiscard]] std::optional<std::string> FindMismatchOfOrNull(
        const KeptMessage& message,
        const MessagePattern& pattern) const;
    [[nodiscard]] bool IsAskedFor(const std::string& command) const;
    [[nodiscard]] bool WasSeen(const std::string& command, const FoundMessage& envelope);
    void Forget(std::size_t count);
    [[nodiscard]] PlaceholderReader MakeReader() const;
};

} // namespace ACS::McsSim
