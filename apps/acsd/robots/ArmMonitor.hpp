#pragma once

#include "config/ArmOptions.hpp"
#include "robots/ArmControls.hpp"
#include "robots/ArmFact.hpp"
#include "robots/ArmRelay.hpp"
#include "robots/ArmView.hpp"
#include "robots/RobotOutputs.hpp"
#include <acs/openstream/ClientSessionActions.hpp>
#include <acs/plan/IRobotAdapter.hpp>
#include <acs/plan/RobotEvent.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// What MONITOR shows of one arm. It reads one thing at a time: the motor until it is on, then the counters, and in between
/// probes, the effect of a CONTROL, or relays that were written.
class ArmMonitor
{
    enum class ELink : std::uint8_t
    {
        Lost,     ///< No session.
        MotorOff, ///< The motor is watched, which was asked to go on.
        Counting, ///< The counters are watched, none has come yet.
        Ready,
    };

    static constexpr std::string_view MOTOR_STATE_URL = "/project/robot/motor_on_state";
    static constexpr std::string_view GENERAL_URL = "/project/rgen";

    ArmOptions _options;
    RobotOutputs& _outputs;
    ArmControls& _controls;
    ELink _link = ELink::Lost;
    ArmViews::ArmView _view;
    std::uint64_t _requestNumber = 0; ///< Of the last MONITOR that was asked for, as the session counts them.
    bool _bRelaysLate = false;        ///< Samples of relays that were read may still come in place of the counters.
    bool _bMotorHidden = false;       ///< The controller does not show it to a probe.
    bool _bGeneralHidden = false;     ///< Likewise its general state.
    std::size_t _unshownEffects = 0;  ///< In a row, of CONTROLs that were not refused.
    bool _bMonitorRefused = false;    ///< The one of the motor or the counters, last time.
    std::string _motorRefusal;        ///< Of the last CONTROL that was to switch it on; empty: none.
    std::optional<Planning::RobotError> _trouble; ///< What keeps the arm from its work, its session being there.

public:
    /// The outputs and the controls must outlive it.
    ArmMonitor(ArmOptions options, RobotOutputs& outputs, ArmControls& controls);

    /// There is a session, or the motor was found off: the motor is asked to go on, and watched until it is.
    void WatchMotor(Planning::AdapterActions& out);
    void OnLost(Planning::AdapterActions& out);
    [[nodiscard]] ArmFact OnSample(const Core::JsonText& json, Planning::AdapterActions& out);
    /// The controller has taken the MONITOR with this number.
    void OnTaken(std::uint64_t requestNumber);
    [[nodiscard]] ArmFact OnRefused(const OpenStream::ClientMonitorRefused& refused, Planning::AdapterActions& out);
    void OnMotorSettled(const ArmSettlement& settlement);
    /// A refusal that came late. Returns whether it is the motor's.
    [[nodiscard]] bool TryTakeFault(const std::string& reason);
    /// Returns whether the timer was the monitor's own.
    [[nodiscard]] bool TryRetry(Planning::AdapterActions& out);
    void OnEffectTimer();
    /// The time for a probe: ends one that was not answered, and begins the one that is wanted if nothing else is under way.
    [[nodiscard]] ArmFact OnProbeTimer(std::optional<EArmProbe> wantedOrNull, Planning::AdapterActions& out);

    void ReportMotorOff();
    void WatchCounters();
    void BeginProbe(EArmProbe probe, Planning::AdapterActions& out);
    /// The counters of after the CONTROL that has just settled come with ArmCounted::bVerifies.
    void VerifyCounters();
    /// The same after the general state has shown its effect, where the controller shows it: a controller may take its time
    /// for a CONTROL, and continue with the MONITOR meanwhile.
    void VerifyEffect(Planning::AdapterActions& out);
    void EndEffect(Planning::AdapterActions& out);
    /// One range after the other. After ArmRelaysRead they are read again, or something else is watched.
    void ReadRelays(std::vector<ArmRelayRange> ranges);
    /// They are still to be read.
    void RepeatRelays();

    [[nodiscard]] bool IsLost() const noexcept;
    [[nodiscard]] bool IsReady() const noexcept;
    /// Ready, and nothing is being verified or read.
    [[nodiscard]] bool IsIdle() const noexcept;
    [[nodiscard]] bool IsProbing() const noexcept;
    [[nodiscard]] bool IsReadingRelays() const noexcept;
    [[nodiscard]] bool IsHidden(EArmProbe probe) const noexcept;
    [[nodiscard]] const std::optional<Planning::RobotError>& GetTroubleOrNull() const noexcept;

private:
    void Monitor(std::string_view url, std::chrono::milliseconds period, std::optional<Core::JsonText> argsOrNull);
    void MonitorMotor();
    void MonitorRange();
    void SwitchMotorOn();
    void WatchCounters(ArmViews::ArmView view);
    [[nodiscard]] std::size_t GetWordCount() const;
    [[nodiscard]] std::optional<ArmSample> ReadSampleOrNull(const Core::JsonText& json) const;
    void StartProbeTimer(Planning::AdapterActions& out) const;
    [[nodiscard]] ArmFact TakeSample(const Core::JsonText& json, Planning::AdapterActions& out);
    [[nodiscard]] ArmFact TakeProbe(const Core::JsonText& json);
    [[nodiscard]] ArmFact TakeRelays(const Core::JsonText& json);
    [[nodiscard]] ArmFact TakeCounters(const Core::JsonText& json, Planning::AdapterActions& out);
    [[nodiscard]] ArmFact AbandonProbe(bool bHidden);
    [[nodiscard]] static std::string_view GetProbeURL(EArmProbe probe);
};

} // namespace ACS::Acsd
