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

/// Observes one arm by MONITOR, which shows one thing at a time: the motor until it is on, then the counters, and in between
/// probes, the effect of a CONTROL, or relays that were written.
class ArmMonitor
{
    enum class ELink : std::uint8_t
    {
        Lost,     ///< No session.
        MotorOff, ///< MONITOR shows the motor, which is being switched on.
        Counting, ///< MONITOR shows the counters; no sample has arrived yet.
        Ready,
    };

    static constexpr std::string_view MOTOR_STATE_URL = "/project/robot/motor_on_state";
    static constexpr std::string_view GENERAL_URL = "/project/rgen";
    /// While a job waits for what is read in place of the counters.
    static constexpr std::chrono::milliseconds LONGEST_READ_PERIOD{100};

    ArmOptions _options;
    RobotOutputs& _outputs;
    ArmControls& _controls;
    ELink _link = ELink::Lost;
    ArmViews::ArmView _view;
    std::uint64_t _requestNumber = 0;             ///< Of the latest MONITOR, as counted by the session.
    bool _bRelaysLate = false;                    ///< Late samples of relays may still arrive in place of the counters.
    bool _bMotorHidden = false;                   ///< The controller does not show the motor to a probe.
    bool _bGeneralHidden = false;                 ///< Likewise its general state.
    std::size_t _unshownEffects = 0;              ///< Number in a row, of CONTROLs after which no state was shown.
    bool _bCounted = false;                       ///< Counters have arrived since the latest probe timer.
    std::chrono::milliseconds _silence{0};        ///< Time without counters while they are shown.
    bool _bMonitorRefused = false;                ///< The latest MONITOR of the motor or the counters was refused.
    std::string _motorRefusal;                    ///< Of the latest CONTROL that switches the motor on; empty: none.
    std::optional<Planning::RobotError> _trouble; ///< Why the arm cannot work although its session is ready.

public:
    /// The outputs and the controls must outlive it.
    ArmMonitor(ArmOptions options, RobotOutputs& outputs, ArmControls& controls);

    /// The session is ready, or the motor was found off: switches the motor on and observes it until it is on.
    void WatchMotor(Planning::AdapterActions& out);
    void OnLost(Planning::AdapterActions& out);
    [[nodiscard]] ArmFact OnSample(const Core::JsonText& json, Planning::AdapterActions& out);
    /// The controller has accepted the MONITOR with this number.
    void OnAccepted(std::uint64_t requestNumber);
    [[nodiscard]] ArmFact OnRefused(const OpenStream::ClientMonitorRefused& refused, Planning::AdapterActions& out);
    void OnMotorSettled(const ArmSettlement& settlement);
    /// A refusal that arrived late. Returns whether it is for the motor.
    [[nodiscard]] bool TryHandleFault(const std::string& reason);
    /// Returns whether the timer belongs to the monitor.
    [[nodiscard]] bool TryRetry(Planning::AdapterActions& out);
    void OnEffectTimer();
    /// Ends a probe that was not answered, and begins the wanted one if nothing else is under way.
    [[nodiscard]] ArmFact OnProbeTimer(std::optional<EArmProbe> wantedOrNull, Planning::AdapterActions& out);

    void ReportMotorOff();
    void WatchCounters();
    void BeginProbe(EArmProbe probe, Planning::AdapterActions& out);
    /// The next counters that are newer than the settled CONTROL arrive with ArmCounted::bVerifies.
    void VerifyCounters();
    /// Likewise, but only after the general state has shown the effect, if the controller shows it: a controller may execute
    /// a CONTROL with a delay and serve the MONITOR meanwhile.
    void VerifyEffect(Planning::AdapterActions& out);
    void EndEffect(Planning::AdapterActions& out);
    /// Reads one range after the other. After ArmRelaysRead the caller reads them again or observes something else.
    void ReadRelays(std::vector<ArmRelayRange> ranges);
    /// Reads all ranges again.
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
    void StartRetryTimer(Planning::AdapterActions& out) const;
    void MonitorRange();
    void SwitchMotorOn();
    void WatchCounters(ArmViews::ArmView view);
    [[nodiscard]] std::size_t GetWordCount() const;
    [[nodiscard]] std::optional<ArmSample> ReadSampleOrNull(const Core::JsonText& json) const;
    [[nodiscard]] std::chrono::milliseconds GetProbeDelay() const;
    void StartProbeTimer(Planning::AdapterActions& out) const;
    [[nodiscard]] bool HasLostCounters();
    [[nodiscard]] ArmFact HandleSample(const Core::JsonText& json, Planning::AdapterActions& out);
    [[nodiscard]] ArmFact HandleProbe(const Core::JsonText& json);
    [[nodiscard]] ArmFact HandleRelays(const Core::JsonText& json);
    [[nodiscard]] ArmFact HandleCounters(const Core::JsonText& json, Planning::AdapterActions& out);
    [[nodiscard]] ArmFact AbandonProbe(bool bHidden);
    [[nodiscard]] static std::string_view GetProbeURL(EArmProbe probe);
};

} // namespace ACS::Acsd
