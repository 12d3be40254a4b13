#pragma once

#include "config/ArmOptions.hpp"
#include "robots/ArmControls.hpp"
#include "robots/ArmInput.hpp"
#include "robots/ArmJobEvidence.hpp"
#include "robots/ArmMonitor.hpp"
#include "robots/ArmProgram.hpp"
#include "robots/IMqttRobotAdapter.hpp"
#include "robots/RobotOutputs.hpp"
#include "robots/Vda5050RobotAdapter.hpp"
#include <acs/core/Now.hpp>
#include <acs/openstream/ClientSessionActions.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// Joins a control robot to the engine: its base is a VDA5050 vehicle, its arm a Hi6 controller with Open Stream.
/// Drives go to the base. A job is a program of the arm: CONTROL selects it, writes its inputs and starts it. It is done when
/// MONITOR shows that the program has raised a counter in a relay. A pause stops the program and the base; the robot is
/// paused when both are stopped. Pure, like the adapter of the base inside it.
///
/// It passes facts between ArmMonitor (what MONITOR shows), ArmProgram (the program of the present job) and ArmJobEvidence
/// (what the counters prove of the job).
class OpenStreamRobotAdapter final : public IMqttRobotAdapter
{
    /// The base repeats actions of its node before the job.
    struct Repetition
    {
        std::string driveID;
        Planning::StartJob job;
        bool bOutdated = false; ///< The robot was offline since, and an operator may have resolved the job.
    };

    /// A job of before a restart; the counters have not arrived yet.
    struct Recovery
    {
        Planning::StartJob job;
        bool bCancelled = false; ///< During a pause. Otherwise the program continues to its end.
        bool bReleased = false;  ///< Cancelled at all.
    };

    Vda5050RobotAdapter _base;
    ArmOptions _options;
    JobMethods _methods;
    ArmInputResolver _resolveInputs;
    ArmControls _controls;
    ArmMonitor _monitor;
    ArmProgram _program;
    ArmJobEvidence _evidence;
    Planning::AdapterActions _baseActions;
    std::optional<Recovery> _recovery;

    std::optional<Repetition> _repetition;
    bool _bJobReleased = false; ///< The engine may no longer wait for the end of the program's job.

    bool _bBaseOnline = false;
    std::optional<Planning::StateChanged> _baseState; ///< The latest since the base is online.
    bool _bOnline = false;                            ///< As it was reported last.
    bool _bPaused = false;                            ///< Likewise.
    bool _bArmOccupied = false;                       ///< Likewise.
    std::optional<Planning::RobotError> _trouble;

public:
    /// The outputs must outlive the adapter. The caller passes each MONITOR in them to SetMonitor of one session, which
    /// receives no other calls of it. With an empty resolver no action has inputs.
    OpenStreamRobotAdapter(
        VDA5050::MasterOptions base,
        ArmOptions arm,
        JobMethods methods,
        ArmInputResolver inputs,
        RobotOutputs& outputs,
        std::shared_ptr<DriveCheck> drives = std::make_shared<DriveCheck>(),
        const std::vector<NeededMap>& maps = {});

    void Handle(const Planning::RobotCommand& command, Core::Now now, Planning::AdapterActions& out) override;
    void OnTimer(Planning::AdapterTimerID timer, Core::Now now, Planning::AdapterActions& out) override;
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(std::string_view action) const override;

    [[nodiscard]] std::vector<VDA5050::MqttSubscription> GetSubscriptions() const override;
    void OnLinkUp(Core::Now now, Planning::AdapterActions& out) override;
    void OnLinkDown(Core::Now now, Planning::AdapterActions& out) override;
    void OnMqttMessage(const VDA5050::MqttMessage& message, Core::Now now, Planning::AdapterActions& out) override;
    [[nodiscard]] tl::expected<std::string, RobotActionRefusal> RequestAction(
        const RobotActionRequest& request,
        Core::Now now,
        Planning::AdapterActions& out) override;
    [[nodiscard]] const VDA5050::MasterSession& GetSession() const noexcept override;

    void OnArmEvent(const OpenStream::ClientEvent& event, Core::Now now, Planning::AdapterActions& out);

private:
    void StartJob(const Planning::StartJob& job, Core::Now now, Planning::AdapterActions& out);
    /// The repetition has ended: its job is started, or rejected because an action has failed. False: the event is another one.
    [[nodiscard]] bool TryEndRepetition(
        const Planning::RobotEvent& event,
        Core::Now now,
        Planning::AdapterActions& out);
    void CancelJob(const std::string& jobID, Core::Now now, Planning::AdapterActions& out);
    [[nodiscard]] tl::expected<ArmJob, std::string> MakeJob(const Planning::StartJob& job) const;
    void RecoverJob(Planning::AdapterActions& out);
    /// The engine does not wait for the end of the job, whose program may run. Reports the robot as occupied.
    void ReleaseJob(Planning::AdapterActions& out);

    void OnSettled(const OpenStream::ClientControlSettled& settled, Planning::AdapterActions& out);
    void OnFault(const OpenStream::ClientControlFault& fault, Planning::AdapterActions& out);
    void OnLost(Planning::AdapterActions& out);
    void OnData(const OpenStream::DataLine& line, Planning::AdapterActions& out);
    void OnFact(const ArmFact& fact, Planning::AdapterActions& out);
    void OnCounted(const ArmCounted& counted, Planning::AdapterActions& out);
    void OnProbed(const ArmProbed& probed, Planning::AdapterActions& out);
    void OnProbeTimer(Planning::AdapterActions& out);

    /// Starts what the program requests of MONITOR.
    void ServeProgram(Planning::AdapterActions& out);
    void Serve(EArmRequest request, Planning::AdapterActions& out);
    /// Call after each input: begins the program's next step and reports changes to the engine.
    void Update(Planning::AdapterActions& out);
    /// No CONTROL or probe is under way.
    [[nodiscard]] bool IsFree() const;
    [[nodiscard]] bool IsProgramWatched() const;

    void DrainBase(Core::Now now, Planning::AdapterActions& out);
    [[nodiscard]] Planning::StateChanged MakeState() const;
    void ReportState(Planning::AdapterActions& out) const;
    void ReportArm(Planning::AdapterActions& out);
    void ReportOnline(Planning::AdapterActions& out);
    /// Reports the state if the robot is paused or its arm occupied, and was not before, or vice versa.
    void ReportActivity(Planning::AdapterActions& out);
    [[nodiscard]] bool IsPaused() const;
    [[nodiscard]] bool IsArmOccupied() const;
};

} // namespace ACS::Acsd
