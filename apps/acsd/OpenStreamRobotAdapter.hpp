#pragma once

#include "AcsdConfig.hpp"
#include "IMqttRobotAdapter.hpp"
#include "RobotOutputs.hpp"
#include "Vda5050RobotAdapter.hpp"
#include <acs/core/Now.hpp>
#include <acs/openstream/ClientSessionActions.hpp>

#include <chrono>
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
    };

    /// What is known of a job's program that has begun.
    enum class EProgram : std::uint8_t
    {
        Runs,
        Stopping, ///< The CONTROL that stops it was sent; no look has come behind it.
        Stopped,
        GoingOn,  ///< Likewise of the one that starts it again.
        Doubtful, ///< The connection broke meanwhile: it runs, or stands.
    };

    /// A CONTROL is answered by silence, also where it got lost. So the MONITOR is sent again behind it: its first sample is
    /// of the time after the CONTROL, and whatever the controller refused has come before.
    enum class ELook : std::uint8_t
    {
        None,
        Asked, ///< The MONITOR was sent.
        Due,   ///< It was taken: the next sample is the look.
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

    struct Counters
    {
        std::int64_t started = 0;
        std::int64_t finished = 0;
        std::int64_t failed = 0;

        bool operator==(const Counters&) const = default;
    };

    /// The base's session has the numbers of its own timers, which are fewer.
    static constexpr Planning::AdapterTimerID START_TIMER = 101;
    /// For a program to raise its first counter when nobody knows whether its start arrived.
    static constexpr std::chrono::milliseconds START_LIMIT{10'000};

    RobotOutputs& _outputs;
    Vda5050RobotAdapter _base;
    ArmCounters _options;
    JobMethods _methods;
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
    ELook _look = ELook::None;
    bool _bStopRefused = false;  ///< The program cannot be stopped; not asked for again before the next pause.
    bool _bGoOnRepeated = false; ///< It may run already: that it does is no refusal.
    bool _bPauseTold = false;    ///< Somebody paused the robot, or had it go on, as far as this adapter knows.
    bool _bFound = false;        ///< The job was found running after a restart: who has stopped it before is not known.
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
    void FailJob(const std::string& reason, Planning::AdapterActions& out);
    void DisownJob(Planning::AdapterActions& out);
    void SendControl(EControl kind, std::string_view url, std::string body);
    void WatchMotor(Planning::AdapterActions& out);
    void TakeMotor(const Core::JsonText& result, Planning::AdapterActions& out);
    void TakeCounters(const Core::JsonText& result, Planning::AdapterActions& out);
    void FollowJob(Planning::AdapterActions& out);
    void CheckStart(Planning::AdapterActions& out);
    void TakeSettled(const OpenStream::ClientControlSettled& settled, Planning::AdapterActions& out);
    void WatchCounters();
    void LookAgain();
    void TakeLook(Planning::AdapterActions& out);
    void TakeFault(const OpenStream::ClientControlFault& fault, Planning::AdapterActions& out);
    void TakeLoss(Planning::AdapterActions& out);
    void TakeData(const OpenStream::DataLine& line, Planning::AdapterActions& out);
    void TakeSettledPause(EControl kind, OpenStream::EControlOutcome outcome, Planning::AdapterActions& out);
    void DoubtFound();
    void RefuseGoOn(Planning::AdapterActions& out);
    void FollowPause(Planning::AdapterActions& out);
    void CancelJob(const std::string& jobID, Planning::AdapterActions& out);
    void EndJob();
    [[nodiscard]] bool IsArmStanding() const;
    [[nodiscard]] bool IsPaused() const;
    void TellPaused(Planning::AdapterActions& out);
    void SetArmState(EArmState state, Planning::AdapterActions& out);

    /// Passes on what the base tells; the robot is online when both its parts are.
    void DrainBase(Planning::AdapterActions& out);
    void TellOnline(Planning::AdapterActions& out);

public:
    /// The outputs must outlive the adapter.
    OpenStreamRobotAdapter(
        VDA5050::MasterOptions base,
        ArmCounters counters,
        JobMethods methods,
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
