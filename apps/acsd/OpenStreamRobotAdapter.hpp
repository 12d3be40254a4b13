#pragma once

#include "AcsdConfig.hpp"
#include "ArmAnswers.hpp"
#include "ArmInput.hpp"
#include "IMqttRobotAdapter.hpp"
#include "RobotOutputs.hpp"
#include "Vda5050RobotAdapter.hpp"
#include <acs/core/Now.hpp>
#include <acs/openstream/ClientSessionActions.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// Joins a control robot to the engine: its base is a VDA5050 vehicle, its arm a Hi6 controller behind Open Stream.
/// Drives go to the base. A job is a program of the arm: CONTROL selects and starts it; it is done when a counter that
/// the program raises in a relay has changed, as MONITOR shows it. A pause stops the program where it is and the base too;
/// the robot shows that it is paused when both stand. Pure, like the adapter of the base inside it.
class OpenStreamRobotAdapter final : public IMqttRobotAdapter
{
    enum class EArmState : std::uint8_t
    {
        Lost,     ///< No session.
        MotorOff, ///< MONITOR watches the motor, which was asked to go on.
        Counting, ///< MONITOR watches the counters, none has come yet.
        Ready,
    };

    enum class EJobPhase : std::uint8_t
    {
        None,
        Selecting, ///< The CONTROL that selects the program is under way.
        Looking,   ///< It was not refused; the first look behind it has not come.
        Selected,  ///< It is started when the pause ends.
        Starting,  ///< The CONTROL that starts it is under way.
        Running,
        Refused, ///< The controller refused one of these CONTROLs; the motor is glanced at.
    };

    /// What is known of a job's program that has begun.
    enum class EProgram : std::uint8_t
    {
        Runs,
        Stopping, ///< The CONTROL that stops it was sent; no look has come behind it.
        Stopped,
        GoingOn,  ///< Likewise of the one that starts it again.
        Doubtful, ///< The connection broke meanwhile: it runs, or stands.
        Refused,  ///< The controller refused to go on with it; what for is looked at.
        Retrying, ///< Likewise; it is asked again as soon as another look has seen that it stands.
    };

    /// A CONTROL is answered by silence, also where it got lost or takes its time. So it is looked for what it has done, then
    /// the MONITOR of the counters is sent again: its first sample is of the time after the CONTROL.
    enum class ELook : std::uint8_t
    {
        None,
        Watched, ///< The controller's general state is to show what the CONTROL has done.
        Asked,   ///< The MONITOR of the counters was sent again.
        Due,     ///< It was taken: the next sample is the look.
    };

    /// What a CONTROL was for; they settle in the order in which they were sent.
    enum class EControl : std::uint8_t
    {
        MotorOn,
        SelectProgram,
        StartProgram,
        StopProgram,  ///< For a pause.
        GoOn,         ///< Starts it again where it was stopped.
        ResetProgram, ///< A job that was stopped is given up.
    };

    /// What MONITOR shows for one sample in place of the counters.
    enum class EGlance : std::uint8_t
    {
        None,
        Motor,
        Playback, ///< Whether the program runs.
    };

    struct Counters
    {
        std::int64_t started = 0;
        std::int64_t finished = 0;
        std::int64_t failed = 0;

        bool operator==(const Counters&) const = default;
    };

    /// The base's session has the numbers of its own timers, which are fewer.
    static constexpr Planning::AdapterTimerID RETRY_TIMER = 100;
    static constexpr Planning::AdapterTimerID START_TIMER = 101;
    static constexpr Planning::AdapterTimerID GLANCE_TIMER = 102;
    static constexpr Planning::AdapterTimerID LOOK_TIMER = 103;
    static constexpr std::string_view GENERAL_URL = "/project/rgen";
    /// For a program to raise its first counter when nobody knows whether its start arrived.
    static constexpr std::chrono::milliseconds START_LIMIT{10'000};

    RobotOutputs& _outputs;
    Vda5050RobotAdapter _base;
    ArmOptions _options;
    JobMethods _methods;
    ArmInputResolver _resolveInputs;
    Planning::AdapterActions _baseActions;

    bool _bBaseOnline = false;
    bool _bOnline = false;
    EArmState _armState = EArmState::Lost;
    std::deque<EControl> _controls; ///< Sent and not settled.
    EJobPhase _phase = EJobPhase::None;
    std::string _jobID;
    bool _bJobStarted = false;
    bool _bPauseWanted = false;
    EProgram _program = EProgram::Runs;
    std::int64_t _armProgram = 0; ///< Of the job.
    std::string _refusal;         ///< Of a CONTROL of the job; what it means is being found out.
    ELook _look = ELook::None;
    EGlance _glance = EGlance::None;
    bool _bGlanceStarted = false;                 ///< The MONITOR of the glance was taken.
    bool _bCountersFresh = false;                 ///< They have come since they were asked for last.
    bool _bMotorHidden = false;                   ///< The controller does not show it to a glance.
    bool _bPlaybackHidden = false;                ///< Likewise.
    std::size_t _standingGlances = 0;             ///< So many in a row saw that the program stands.
    std::size_t _unshownLooks = 0;                ///< So many in a row showed nothing of the CONTROL.
    bool _bMonitorRefused = false;                ///< The one of the motor or the counters, last time.
    std::string _motorRefusal;                    ///< Of the last CONTROL that was to switch it on; empty: none.
    std::optional<Planning::RobotError> _trouble; ///< What keeps the arm from its work, its session being there.
    bool _bStopRefused = false;  ///< The program cannot be stopped; not asked for again before the next pause.
    bool _bGoOnRepeated = false; ///< It may run already: that it does is no refusal.
    bool _bPauseTold = false;    ///< Somebody paused the robot, or had it go on, as far as this adapter knows.
    bool _bFound = false;        ///< The job was found running after a restart: who has stopped it before is not known.
    bool _bSeenStanding = false; ///< One that was refused to go on; counters are to come behind that.
    bool _bGivenUp = false;      ///< The task is reset as soon as the program surely stands.
    bool _bPaused = false;       ///< As it was told last.
    Planning::StateChanged _baseState; ///< The latest that the base told.
    bool _bBaseStateKnown = false;
    std::optional<Planning::StartJob> _recovery; ///< A job of before a restart; the counters have not come yet.
    bool _bRecovered = false;                    ///< The present job is such a one: its end may be that it never began.
    bool _bCounted = false;                      ///< Counters have come.
    Counters _counters;                          ///< The latest.
    Counters _counted;                           ///< Those of the moment when the job was commanded.

    void StartJob(const Planning::StartJob& job, Planning::AdapterActions& out);
    /// What the counters say of a job that was commanded before a restart.
    void FindJob(Planning::AdapterActions& out);
    /// Any of them: as after a restart of the controller.
    [[nodiscard]] static bool HasFallen(const Counters& before, const Counters& after);
    [[nodiscard]] std::string MakeMark() const;
    [[nodiscard]] static std::optional<Counters> ReadMarkOrNull(std::string_view mark);
    [[nodiscard]] Planning::StateChanged MakeState() const;
    [[nodiscard]] static std::string DescribeRefusal(
        int status,
        const std::optional<Core::JsonText>& bodyOrNull,
        const std::string& detail);
    void RefuseJob(std::string reason, Planning::AdapterActions& out);
    void FailJob(const std::string& reason, Planning::AdapterActions& out);
    void HoldJob(std::string reason, Planning::AdapterActions& out);
    void DisownJob(Planning::AdapterActions& out);
    void SendControl(EControl kind, std::string_view url, std::string body);
    [[nodiscard]] static std::string_view GetUrl(EGlance glance);
    void Monitor(std::string_view url, std::chrono::milliseconds period);
    void WatchMotor(Planning::AdapterActions& out);
    void TakeMotor(bool bOn, Planning::AdapterActions& out);
    void Retry(Planning::AdapterActions& out);
    void TellMotorOff(Planning::AdapterActions& out);
    void TakeSettledMotor(const OpenStream::ClientControlSettled& settled, Planning::AdapterActions& out);
    void TakeMonitorRefused(const OpenStream::ClientMonitorRefused& refused, Planning::AdapterActions& out);
    void SetTrouble(std::optional<Planning::RobotError> trouble, Planning::AdapterActions& out);
    [[nodiscard]] bool IsProgramWatched() const;
    void LookAround(Planning::AdapterActions& out);
    void StartGlanceTimer(Planning::AdapterActions& out) const;
    void Glance(EGlance glance, Planning::AdapterActions& out);
    void GiveUpGlance(bool bForGood, Planning::AdapterActions& out);
    [[nodiscard]] bool TryTakeGlance(const Core::JsonText& sample, Planning::AdapterActions& out);
    void TakeMotorGlance(bool bOn, Planning::AdapterActions& out);
    void TakePlaybackGlance(bool bPlaying, Planning::AdapterActions& out);
    void TakeRefusedGoOn(bool bPlaying, Planning::AdapterActions& out);
    void TakeStanding(Planning::AdapterActions& out);
    void CheckHalt(Planning::AdapterActions& out);
    void ForgetHalt(Planning::AdapterActions& out);
    void TakeCounters(const Core::JsonText& result, Planning::AdapterActions& out);
    void FollowJob(Planning::AdapterActions& out);
    void CheckStart(Planning::AdapterActions& out);
    void TakeSettled(const OpenStream::ClientControlSettled& settled, Planning::AdapterActions& out);
    void WatchCounters();
    void LookAgain(Planning::AdapterActions& out);
    void LookAtCounters();
    void EndWatch();
    [[nodiscard]] bool TryTakeEffect(const Core::JsonText& sample, Planning::AdapterActions& out);
    [[nodiscard]] bool IsEffectShown(const GeneralState& state) const;
    void TakeLook(Planning::AdapterActions& out);
    void TakeFault(const OpenStream::ClientControlFault& fault, Planning::AdapterActions& out);
    void TakeLoss(Planning::AdapterActions& out);
    void TakeData(const OpenStream::DataLine& line, Planning::AdapterActions& out);
    void TakeSettledPause(
        EControl kind,
        OpenStream::EControlOutcome outcome,
        const std::string& refusal,
        Planning::AdapterActions& out);
    void DoubtFound();
    void RefuseGoOn(const std::string& refusal, Planning::AdapterActions& out);
    void LookAtRefusedProgram(Planning::AdapterActions& out);
    [[nodiscard]] bool IsGoOnRefused() const;
    [[nodiscard]] bool IsGoOnDue() const;
    void FollowPause(Planning::AdapterActions& out);
    void CancelJob(const std::string& jobID, Planning::AdapterActions& out);
    void EndJob(Planning::AdapterActions& out);
    [[nodiscard]] bool IsJobBefore() const;
    [[nodiscard]] bool IsArmStanding() const;
    [[nodiscard]] bool IsPaused() const;
    void TellPaused(Planning::AdapterActions& out);
    void SetArmState(EArmState state, Planning::AdapterActions& out);

    /// Passes on what the base tells; the robot is online when both its parts are.
    void DrainBase(Planning::AdapterActions& out);
    void TellOnline(Planning::AdapterActions& out);

public:
    /// The outputs must outlive the adapter. An empty resolver: no action has inputs.
    OpenStreamRobotAdapter(
        VDA5050::MasterOptions base,
        ArmOptions arm,
        JobMethods methods,
        ArmInputResolver inputs,
        RobotOutputs& outputs);

    void Handle(const Planning::RobotCommand& command, Core::Now now, Planning::AdapterActions& out) override;
    void OnTimer(Planning::AdapterTimerID timer, Core::Now now, Planning::AdapterActions& out) override;
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(std::string_view action) const override;

    [[nodiscard]] std::vector<VDA5050::MqttSubscription> GetSubscriptions() const override;
    void OnLinkUp(Core::Now now, Planning::AdapterActions& out) override;
    void OnLinkDown(Core::Now now, Planning::AdapterActions& out) override;
    void OnMqttMessage(const VDA5050::MqttMessage& message, Core::Now now, Planning::AdapterActions& out) override;
    [[nodiscard]] const VDA5050::MasterSession& GetSession() const noexcept override;

    void OnArmEvent(const OpenStream::ClientEvent& event, Core::Now now, Planning::AdapterActions& out);
};

} // namespace ACS::Acsd
