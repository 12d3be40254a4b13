#pragma once

#include "config/ArmOptions.hpp"
#include "robots/ArmAnswers.hpp"
#include "robots/ArmControls.hpp"
#include "robots/ArmFact.hpp"
#include "robots/ArmInput.hpp"
#include "robots/ArmInputTransfer.hpp"
#include "robots/ArmJobEvidence.hpp"
#include "robots/ArmProgramControls.hpp"
#include "robots/ArmProgramState.hpp"
#include <acs/plan/IRobotAdapter.hpp>
#include <acs/plan/RobotEvent.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Acsd
{

/// A request of the program of a job to MONITOR.
enum class EArmRequest : std::uint8_t
{
    VerifyEffect,   ///< The general state, then the first counters after the CONTROL that has settled.
    VerifyCounters, ///< Only those counters.
    ReadInputs,
    ProbeMotor,
    ProbePlayback,
};

/// A job of an arm, as it is given to ArmProgram.
struct ArmJob
{
    std::string jobID;
    std::uint32_t program = 0;
    std::vector<ArmInput> inputs;
};

/// Runs the program of one job. It selects the program, writes its inputs, reads them back, verifies that no other program
/// has run meanwhile, and starts it. It stops and resumes the program for a pause, and resets it when the job is cancelled.
/// Each step is verified before the next. What must be observed for that is requested, and arrives as a call of On….
class ArmProgram
{
    /// The job, and what is valid in several of its states.
    struct Work
    {
        std::string jobID;
        std::uint32_t program = 0;
        ArmInputTransfer inputs;
        bool bRewound = false;         ///< The program counter was set for its selection.
        bool bResumeRepeated = false;  ///< Its program may run already, in which case a refused resume is no failure.
        std::size_t stoppedProbes = 0; ///< Probes in a row that found the started program stopped.
        bool bCancelled = false;       ///< Its program is reset as soon as it is known to be stopped.
        /// As it was shown when the program was stopped: this program, or a subprogram of it.
        std::optional<std::int64_t> stoppedProgramOrNull;
        std::optional<std::int64_t> probedProgramOrNull; ///< As the latest check showed it.
    };

    ArmOptions _options;
    ArmProgramControls _controls;
    std::vector<EArmRequest> _requests;
    ArmStates::ArmProgramState _state;
    Work _work;                        ///< Empty without a job.
    std::optional<bool> _bPauseOrNull; ///< As it was commanded since this start of acsd; absent: it was not.
    bool _bPauseShown = false;         ///< The vehicle was last reported paused.
    bool _bPauseKnown = false;         ///< A pause was commanded, ended or reported since this start of acsd.
    std::optional<Planning::RobotError> _trouble;

public:
    /// The controls must outlive it.
    ArmProgram(ArmOptions options, ArmControls& controls);

    void Start(ArmJob job, Planning::AdapterActions& out);
    /// Continues a job of before a restart. bBegun: the counters show that its program has begun. bCancelled: it was cancelled during
    /// a pause, so that its program is reset.
    void Recover(ArmJob job, bool bBegun, bool bCancelled, Planning::AdapterActions& out);
    /// A running program is never aborted, because it may hold material: its end is reported as usual. A program that is
    /// stopped for a pause is reset. False: it does not have the job, or has ended it.
    [[nodiscard]] bool TryCancel(const std::string& jobID, Planning::AdapterActions& out);
    void SetPauseWanted(bool bWanted);
    /// Whether the vehicle was reported paused.
    void OnPauseShown(bool bPaused);

    /// A CONTROL has settled that was not the motor's.
    void OnSettled(const ArmSettlement& settlement, Planning::AdapterActions& out);
    /// A refusal that arrived after the CONTROL had settled.
    void OnFault(const ArmRefusal& refusal, Planning::AdapterActions& out);
    void OnLost(Planning::AdapterActions& out);

    /// What the latest counters prove. Only while IsCounted.
    void OnProof(const ArmProof& proof, const std::string& echo, Planning::AdapterActions& out);
    /// The counters have fallen.
    void OnRestarted(Planning::AdapterActions& out);
    /// The program was certainly not started: the job can be commanded again. For example because the counters have changed
    /// before its start: those of another program could not be distinguished from those of this job's program.
    void ReportNotStarted(Planning::AdapterActions& out);
    /// Counters have come that are newer than the last probe.
    void OnCounted(bool bWatched, Planning::AdapterActions& out);
    /// The first counters of a connection.
    void OnCountersBack(Planning::AdapterActions& out);
    /// The first counters after the CONTROL. bUnchanged: they are equal to those before the job. The state is the latest that
    /// was shown after the CONTROL, if any was.
    void OnVerified(bool bUnchanged, const std::optional<GeneralState>& stateOrNull, Planning::AdapterActions& out);
    [[nodiscard]] bool IsEffectShown(const GeneralState& state) const;
    void OnInputsRead(const std::vector<ArmRelayWords>& ranges, Planning::AdapterActions& out);
    void OnInputsRefused(const std::string& reason, Planning::AdapterActions& out);
    void OnInputTimer(Planning::AdapterActions& out);
    /// bZero: all counters are 0.
    void OnStartTimer(bool bEchoed, bool bZero, Planning::AdapterActions& out);
    /// The motor is on, or the controller does not show it.
    void OnMotorProbed(Planning::AdapterActions& out);
    void OnMotorOff(Planning::AdapterActions& out);
    void OnPlaybackProbed(const ArmProbed& probed, bool bWatched);
    void OnPlaybackHidden(Planning::AdapterActions& out);
    /// Time to resume a program whose resume was refused, or in place of which another one was selected.
    void Retry();
    void ForgetHalt();

    /// Begins the next step, if the last one is verified.
    void Advance(bool bFree, bool bProbing, Planning::AdapterActions& out);

    [[nodiscard]] std::vector<EArmRequest> TakeRequests();
    [[nodiscard]] const std::vector<ArmInput>& GetInputs() const noexcept;
    [[nodiscard]] bool HasJob() const noexcept;
    [[nodiscard]] bool IsPauseWanted() const noexcept;
    /// Its counters may change for this job.
    [[nodiscard]] bool IsCounted() const;
    /// It is selected and not started: a program that changes the counters now is another one.
    [[nodiscard]] bool IsPreparing() const;
    [[nodiscard]] bool IsReadingInputs() const;
    /// It was started, and nothing limits the time until its end or, before that, until it begins.
    [[nodiscard]] bool IsStarted() const;
    /// The result of a probe of the motor decides about the job.
    [[nodiscard]] bool IsMotorDecisive() const;
    /// It must be resumed, and is not verified to run.
    [[nodiscard]] bool IsResumeDue() const;
    [[nodiscard]] bool IsArmStopped() const;
    [[nodiscard]] const std::optional<Planning::RobotError>& GetTroubleOrNull() const noexcept;

private:
    void SetWork(ArmJob job);
    void BeginSelection(Planning::AdapterActions& out);
    void Select(Planning::AdapterActions& out);
    void Rewind();
    [[nodiscard]] bool TryRewind(const ArmRefusal& refusal);
    void WriteInput();
    void ReadInputs(Planning::AdapterActions& out);
    void LeaveStarting();
    void ProbeRefusedProgram();
    void VerifyRecovered();
    void FinishReset(const std::optional<GeneralState>& stateOrNull, Planning::AdapterActions& out);
    void AdvanceStopped(bool bProbing, Planning::AdapterActions& out);
    void OnAccepted(EArmControl kind, Planning::AdapterActions& out);
    void OnUnanswered(EArmControl kind, OpenStream::EControlOutcome outcome, Planning::AdapterActions& out);
    void OnControlRefused(EArmControl kind, const ArmRefusal& refusal, Planning::AdapterActions& out);
    void OnStartRefused(const ArmRefusal& refusal, Planning::AdapterActions& out);
    void Refuse(std::string reason);
    /// Returns the ID of the job that has ended.
    [[nodiscard]] std::string End(Planning::AdapterActions& out);
    void Fail(std::string reason, Planning::AdapterActions& out);
    void ReportUnresolved(std::string reason, Planning::AdapterActions& out);
    void RaiseHalt(std::string message);
};

} // namespace ACS::Acsd
