#pragma once

#include "config/ArmOptions.hpp"
#include "robots/ArmAnswers.hpp"
#include "robots/ArmControls.hpp"
#include "robots/ArmFact.hpp"
#include "robots/ArmInput.hpp"
#include "robots/ArmJobEvidence.hpp"
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

/// What the program of a job needs MONITOR for.
enum class EArmRequest : std::uint8_t
{
    VerifyEffect,   ///< The general state, then the counters of after the CONTROL that has settled.
    VerifyCounters, ///< Those counters alone.
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

/// The program of one job, from its selection to its end: select, write the inputs, read them back, verify that no program
/// has run meanwhile, start; stop and resume it for pauses, reset it where the job is cancelled. Each step is verified before
/// the next. Whatever it needs to see is requested, and comes as an On… call.
class ArmProgram
{
    /// Found out once a connection.
    enum class EResetPath : std::uint8_t
    {
        Unknown,
        RCode,     ///< From version 60.30.
        TaskReset, ///< Before.
    };

    /// The job, and what holds in several of its states.
    struct Work
    {
        ArmJob job;
        bool bRewound = false;        ///< For its selection.
        bool bResumeRepeated = false; ///< Its program may run already: that it does is no refusal.
        bool bCancelled = false;      ///< Its program is reset as soon as it is surely stopped.
    };

    ArmOptions _options;
    ArmControls& _controls;
    std::vector<EArmRequest> _requests;
    ArmStates::ArmProgramState _state;
    Work _work;               ///< Empty without a job.
    bool _bRewindDue = false; ///< A program was started or stopped since the program counter was set.
    bool _bPauseWanted = false;
    bool _bPauseKnown = false; ///< The robot was paused or resumed, as far as is known here.
    EResetPath _resetPath = EResetPath::Unknown;
    std::optional<Planning::RobotError> _trouble;

    template <typename TState>
    [[nodiscard]] bool Is() const noexcept
    {
        return std::holds_alternative<TState>(_state);
    }

    void Select();
    void Rewind();
    void WriteInput(ArmStates::WritingInputs writing);
    void Prepare();
    void OnInputWritten(Planning::AdapterActions& out);
    void ReadInputs(std::size_t attempt, Planning::AdapterActions& out);
    void LeaveStarting();
    void StartProgram();
    void StopProgram();
    void ResumeProgram();
    void ResetProgram(EResetPath path);
    void ProbeRefusedProgram();
    void DoubtFound();
    void OnResetRefused();
    void OnAccepted(EArmControl kind, Planning::AdapterActions& out);
    void OnUnanswered(EArmControl kind, OpenStream::EControlOutcome outcome, Planning::AdapterActions& out);
    void OnControlRefused(EArmControl kind, const ArmRefusal& refusal, Planning::AdapterActions& out);
    void OnStartRefused(const ArmRefusal& refusal, Planning::AdapterActions& out);
    void SelectUnlessCancelled(Planning::AdapterActions& out);
    [[nodiscard]] bool TryRewind(const ArmRefusal& refusal);
    [[nodiscard]] static bool IsOfSelection(const ArmRefusal& refusal);
    void Refuse(std::string reason);
    void Begin(Planning::AdapterActions& out);
    /// The job's ID, which is the program's no longer.
    [[nodiscard]] std::string End(Planning::AdapterActions& out);
    void Finish(Planning::AdapterActions& out);
    void Fail(std::string reason, Planning::AdapterActions& out);
    void Hold(std::string reason, Planning::AdapterActions& out);
    void Disown(Planning::AdapterActions& out);
    void Halt(std::string message);
    [[nodiscard]] bool IsExpected(EArmControl kind) const;
    [[nodiscard]] bool IsBeforeStart() const;

public:
    /// The controls must outlive it.
    ArmProgram(ArmOptions options, ArmControls& controls);

    void Start(ArmJob job);
    /// Its program was found by the counters after a restart.
    void Recover(ArmJob job, bool bBegun, Planning::AdapterActions& out);
    /// A program holds material: one that runs is never aborted, its end is reported as always. One that was stopped for a
    /// pause is reset where it is.
    void Cancel(const std::string& jobID, Planning::AdapterActions& out);
    void SetPauseWanted(bool bWanted);
    /// Its vehicle was seen paused.
    void OnPauseSeen() noexcept;

    /// A CONTROL has settled that was not the motor's.
    void OnSettled(const ArmSettlement& settlement, Planning::AdapterActions& out);
    /// A refusal that came after the silence.
    void OnFault(const ArmRefusal& refusal, Planning::AdapterActions& out);
    void OnLost(Planning::AdapterActions& out);

    /// What the latest counters prove. Only while IsCounted.
    void OnProof(const ArmProof& proof, const std::string& echo, Planning::AdapterActions& out);
    /// The counters have fallen.
    void OnRestarted(Planning::AdapterActions& out);
    /// The counters have changed before the program was started.
    void OnCountedBeforeStart(Planning::AdapterActions& out);
    /// Counters have come that are newer than the last probe.
    void OnCounted(bool bWatched, Planning::AdapterActions& out);
    /// The first counters of a connection.
    void OnCountersBack(Planning::AdapterActions& out);
    /// The counters of after the CONTROL have come; whether they are those of before the job.
    void OnVerified(bool bUnchanged, Planning::AdapterActions& out);
    [[nodiscard]] bool IsEffectShown(const GeneralState& state) const;
    void OnInputsRead(const std::vector<ArmRelayWords>& ranges, Planning::AdapterActions& out);
    void OnInputsRefused(const std::string& reason, Planning::AdapterActions& out);
    void OnInputTimer(Planning::AdapterActions& out);
    void OnStartTimer(bool bEchoed, Planning::AdapterActions& out);
    /// The motor is on, or the controller does not show it.
    void OnMotorProbed(Planning::AdapterActions& out);
    void OnMotorOff(Planning::AdapterActions& out);
    /// Without a value where the controller did not answer.
    void OnPlaybackProbed(std::optional<bool> bPlayingOrNull, bool bWatched);
    void OnPlaybackHidden(Planning::AdapterActions& out);
    /// Time to resume a program whose resuming was refused.
    void Retry();
    void ForgetHalt();

    /// The next step, once it is known what came of the one before.
    void Advance(bool bFree, bool bProbing, Planning::AdapterActions& out);

    [[nodiscard]] std::vector<EArmRequest> TakeRequests();
    [[nodiscard]] const std::vector<ArmInput>& GetInputs() const noexcept;
    [[nodiscard]] bool HasJob() const noexcept;
    /// Its counters may change for this job.
    [[nodiscard]] bool IsCounted() const;
    /// It is selected and not started: a program that changes the counters now is another one.
    [[nodiscard]] bool IsPreparing() const;
    [[nodiscard]] bool IsReadingInputs() const;
    [[nodiscard]] bool IsRunning() const;
    /// The result of a probe of the motor decides about the job.
    [[nodiscard]] bool IsMotorDecisive() const;
    /// It is to resume, and is not known to.
    [[nodiscard]] bool IsResumeDue() const;
    [[nodiscard]] bool IsRetryDue() const;
    [[nodiscard]] bool IsArmStopped() const;
    [[nodiscard]] const std::optional<Planning::RobotError>& GetTroubleOrNull() const noexcept;
};

} // namespace ACS::Acsd
