#pragma once

#include "Catch.hpp"
#include "ManualClock.hpp"
#include "robots/OpenStreamRobotAdapter.hpp"
#include <acs/vda5050/Vda5050Codec.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Acsd::Test
{

inline const std::string SELECT =
    R"(CONTROL /project/context/tasks[0]/cur_prog_cnt {"pno":11,"sno":0,"fno":0,"ext_sel":1})";
inline const std::string REWIND = R"(CONTROL /project/context/tasks[0]/set_cur_pc_idx {"idx":1})";
inline const std::string START = "CONTROL /project/robot/start {}";
inline const std::string STOP = "CONTROL /project/robot/stop {}";
inline const std::string RESET = R"(CONTROL /project/service/r_code/execute {"code":1})";
inline const std::string RESET_TASK = "CONTROL /project/context/tasks[0]/reset {}";
inline const std::string MONITOR_COUNTERS = "MONITOR /project/plc/m/val_s32";
inline const std::string MOTOR_ON = "CONTROL /project/robot/motor_on {}";
inline const std::string MONITOR_MOTOR = "MONITOR /project/robot/motor_on_state";
/// What the controller's general state shows.
inline constexpr std::string_view SELECTED = R"({"is_playback":0,"cur_prog_no":11,"cur_step_no":0})";
inline constexpr std::string_view STOPPED_STATE = R"({"is_playback":0,"cur_prog_no":11,"cur_step_no":3})";
inline constexpr std::string_view RUNNING_STATE = R"({"is_playback":1,"cur_prog_no":11,"cur_step_no":3})";
inline constexpr std::string_view MOTOR_ON_SAMPLE = R"({"_type":"JObject","val":0})";
inline constexpr std::string_view MOTOR_OFF_SAMPLE = R"({"_type":"JObject","val":1})";
inline const std::string MONITOR_PLAYBACK = "MONITOR /project/rgen";

/// Of programs that cannot echo the number of their job.
inline ArmOptions MakeArmOptions()
{
    ArmOptions options;
    options.echoIndex.reset();
    return options;
}

inline VDA5050::MasterOptions MakeBaseOptions()
{
    VDA5050::MasterOptions options;
    options.address = {"uagv", "ACS", "CR01"};
    options.bFactsheetRequested = false;
    return options;
}

/// An adapter whose base reports nothing unless a test lets it: the arm is under test.
struct ArmFixture
{
    static constexpr Planning::AdapterTimerID RETRY_TIMER = 100;
    static constexpr Planning::AdapterTimerID START_TIMER = 101;
    static constexpr Planning::AdapterTimerID PROBE_TIMER = 102;
    static constexpr Planning::AdapterTimerID EFFECT_TIMER = 103;
    static constexpr Planning::AdapterTimerID INPUT_TIMER = 104;

    Testing::ManualClock clock;
    RobotOutputs outputs;
    OpenStreamRobotAdapter adapter;
    Planning::AdapterActions actions;
    std::uint32_t headerID = 0;
    std::string lastControl;        ///< Of those that were taken.
    std::uint64_t monitorCount = 0; ///< Likewise.

    ArmFixture()
        : ArmFixture(MakeArmOptions(), {})
    {
    }

    ArmFixture(ArmOptions options, ArmInputResolver inputs, VDA5050::MasterOptions base = MakeBaseOptions())
        : adapter(
            std::move(base),
            std::move(options),
            {{"TrayLoad", {"", 11}}, {"CassetteLoad", {"pick", 0}}},
            std::move(inputs),
            outputs)
    {
    }

    void Deliver(const OpenStream::ClientEvent& event)
    {
        adapter.OnArmEvent(event, clock.GetNow(), actions);
    }

    /// The controller accepts the latest MONITOR, or one that many requests earlier.
    void AcknowledgeMonitor(std::uint64_t before = 0)
    {
        const auto waiting = std::ranges::count_if(outputs.armRequests, [](const ArmRequest& request) {
            return std::holds_alternative<OpenStream::MonitorRequest>(request);
        });
        Deliver(OpenStream::ClientMonitorStarted{monitorCount + static_cast<std::uint64_t>(waiting) - before});
    }

    void DeliverData(std::string_view json)
    {
        OpenStream::DataLine line;
        line.result = Core::JsonText::FromTrusted(std::string(json));
        Deliver(OpenStream::ClientData{line, clock.GetNow()});
    }

    /// Shows what is observed after a CONTROL: its effect, if that is observed, and the counters.
    void ShowVerification(std::string_view counters = "[5,5,0]")
    {
        std::vector<std::string> requests = TakeRequests();
        if (requests == std::vector<std::string>{MONITOR_PLAYBACK})
        {
            ShowEffect(lastControl == STOP ? STOPPED_STATE : lastControl == SELECT ? SELECTED : RUNNING_STATE);
            requests = TakeRequests();
        }
        CHECK(requests == std::vector<std::string>{MONITOR_COUNTERS});
        AcknowledgeMonitor();
        DeliverData(counters);
    }

    /// The CONTROL is accepted, and verified by what MONITOR shows after it.
    void Accept(std::string_view counters = "[5,5,0]")
    {
        static_cast<void>(TakeRequests());
        if (lastControl == REWIND) // before the selection after a start
        {
            Settle(OpenStream::EControlOutcome::Accepted);
            static_cast<void>(TakeRequests());
        }
        Settle(OpenStream::EControlOutcome::Accepted);
        ShowVerification(counters);
    }

    /// The MONITOR after a CONTROL is accepted, and shows the effect.
    void ShowEffect(std::string_view state)
    {
        AcknowledgeMonitor();
        DeliverData(state);
    }

    /// A CONTROL is refused with the controller's own error code.
    void RefuseWith(int status, std::string_view body)
    {
        Deliver(OpenStream::ClientControlSettled{
            0,
            OpenStream::EControlOutcome::Refused,
            status,
            Core::JsonText::FromTrusted(std::string(body)),
            "detail"});
    }

    void Settle(OpenStream::EControlOutcome outcome, int status = 0)
    {
        Deliver(OpenStream::ClientControlSettled{0, outcome, status, std::nullopt, "detail"});
    }

    void Command(const std::string& jobID, const std::string& action = "TrayLoad")
    {
        Planning::StartJob job;
        job.jobID = jobID;
        job.action = action;
        adapter.Handle(job, clock.GetNow(), actions);
    }

    /// The arm is connected, the state of its motor is unknown, and the base has reported its state.
    void ConnectWithBase()
    {
        adapter.OnLinkUp(clock.GetNow(), actions);
        ShowBase(false);
        Deliver(OpenStream::ClientReady{});
    }

    /// The base reports its state as well, so the state of the robot is reported.
    void BringUpWithBase()
    {
        adapter.OnLinkUp(clock.GetNow(), actions);
        BringUp();
        ShowBase(false);
    }

    /// The base shows a state.
    void ShowBase(bool bPaused)
    {
        VDA5050::StateMessage state;
        state.header = {++headerID, clock.GetNow().wall, "2.0.0", "ACS", "CR01"};
        state.lastNodeID = "A";
        state.bPaused = bPaused;
        std::string payload;
        VDA5050::Vda5050Codec().Encode(state, VDA5050::EVda5050Version::Version200, payload);
        adapter.OnMqttMessage({"uagv/v2/ACS/CR01/state", payload, 0, false}, clock.GetNow(), actions);
    }

    /// Whether the robot was reported paused last.
    bool IsReportedPaused()
    {
        const auto states = TakeEvents<Planning::StateChanged>();
        return !states.empty() && states.back().bPaused;
    }

    /// The requests of a probe after some time without events.
    std::vector<std::string> TakeProbe()
    {
        static_cast<void>(TakeRequests());
        Fire(PROBE_TIMER);
        return TakeRequests();
    }

    /// The state that the probe finds which was requested, and the counters after it.
    void ShowProbe(std::string_view state, std::string_view counters)
    {
        CHECK(TakeRequests() == std::vector<std::string>{MONITOR_PLAYBACK});
        AcknowledgeMonitor();
        DeliverData(state);
        ShowVerification(counters);
    }

    /// Likewise, of the probe that is due after some time.
    void ShowTimedProbe(std::string_view state, std::string_view counters)
    {
        static_cast<void>(TakeRequests());
        Fire(PROBE_TIMER);
        ShowProbe(state, counters);
    }

    /// A reset is accepted, and not refused late.
    void AcceptReset(std::string_view counters)
    {
        Settle(OpenStream::EControlOutcome::Accepted);
        CHECK(TakeRequests() == std::vector<std::string>{MONITOR_PLAYBACK});
        ShowEffect(STOPPED_STATE);
        CHECK(TakeEvents<Planning::JobFailed>().empty());
        Fire(EFFECT_TIMER);
        ShowVerification(counters);
    }

    void Fire(Planning::AdapterTimerID timer)
    {
        adapter.OnTimer(timer, clock.GetNow(), actions);
    }

    void RefuseMonitor(std::string url)
    {
        OpenStream::ErrorLine error;
        error.codeText = "invalid_url";
        error.message = "no such thing";
        Deliver(OpenStream::ClientMonitorRefused{error, std::move(url)});
    }

    /// The errors that were reported last; "?" if no state was reported since.
    std::string TakeErrors()
    {
        const auto states = TakeEvents<Planning::StateChanged>();
        actions.clear();
        std::string codes = states.empty() ? "?" : "";
        for (const Planning::RobotError& error :
             states.empty() ? decltype(states.back().errors){} : states.back().errors)
        {
            CHECK(error.level == Planning::EAlarmLevel::Heavy);
            codes += error.errorCode;
        }
        return codes;
    }

    /// Whether the time limit for the begin of a program runs.
    [[nodiscard]] bool IsStartWatched() const
    {
        return std::any_of(actions.begin(), actions.end(), [](const Planning::AdapterAction& action) {
            const auto* const startOrNull = std::get_if<Planning::StartAdapterTimer>(&action);
            return startOrNull != nullptr && startOrNull->timer == START_TIMER;
        });
    }

    /// A job whose program runs.
    void StartRunning()
    {
        BringUpWithBase();
        Command("J");
        Accept();
        Accept("[6,5,0]");
        CHECK(TakeRequests().empty());
    }

    /// Handshake, motor on, first counters.
    void BringUp(std::string_view counters = "[5,5,0]")
    {
        Deliver(OpenStream::ClientReady{});
        Settle(OpenStream::EControlOutcome::Accepted); // motor_on
        DeliverData(R"({"_type":"JObject","val":0})");
        DeliverData(counters);
        static_cast<void>(TakeRequests());
        actions.clear();
    }

    /// After a loss, with a program that has not ended. The resulting requests are not taken yet.
    void ComeBack()
    {
        Deliver(OpenStream::ClientReady{});
        Settle(OpenStream::EControlOutcome::Accepted); // motor_on
        DeliverData(MOTOR_ON_SAMPLE);
        static_cast<void>(TakeRequests());
        DeliverData("[6,5,0]");
    }

    /// "MONITOR url" or "CONTROL url body" of the requests since the last call.
    std::vector<std::string> TakeRequests()
    {
        std::vector<std::string> texts;
        for (const ArmRequest& request : std::exchange(outputs.armRequests, {}))
        {
            if (const auto* monitorOrNull = std::get_if<OpenStream::MonitorRequest>(&request))
            {
                ++monitorCount;
                texts.push_back("MONITOR " + monitorOrNull->url);
            }
            else
            {
                const auto& control = std::get<OpenStream::ControlRequest>(request);
                lastControl = fmt::format("CONTROL {} {}", control.url, control.body->GetText());
                texts.push_back(lastControl);
            }
        }
        return texts;
    }

    template <typename TEvent>
    std::vector<TEvent> TakeEvents()
    {
        std::vector<TEvent> events;
        for (const Planning::AdapterAction& action : actions)
        {
            const auto* raiseOrNull = std::get_if<Planning::RaiseEvent>(&action);
            if (raiseOrNull != nullptr && std::holds_alternative<TEvent>(raiseOrNull->event))
            {
                events.push_back(std::get<TEvent>(raiseOrNull->event));
            }
        }
        return events;
    }
};

} // namespace ACS::Acsd::Test
