#pragma once

#include "plans/ControlRequests.hpp"
#include "plans/TrackedPlan.hpp"
#include <acs/protocol/AcsMessage.hpp>

#include <array>
#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace ACS::McsSim
{

/// How many of something are there, and how many of these are Completed.
struct DoneCount
{
    std::size_t done = 0;
    std::size_t all = 0;
};

/// All plans of a run and what the ACS reports about them. Pure: events and the time go in. A function with `out`
/// appends a line for people per change of state. Reports in a wrong order, or about what does not exist, are counted
/// as violations and followed nevertheless as far as that is possible.
class PlanTracker
{
public:
    /// Of more robots of the ACS nothing is kept.
    static constexpr std::size_t MAX_ROBOTS = 1000;

private:
public:
    /// A plan that is not acknowledged is sent again after this time.
    static constexpr std::chrono::milliseconds RESEND_AFTER{5'000};
    /// Maximum number of plans without an Ack.
    static constexpr std::size_t SEND_WINDOW = 32;
    /// Violations beyond this number are only counted.
    static constexpr std::size_t MAX_VIOLATION_TEXTS = 20;

    using Lines = std::vector<std::string>;

private:
    std::vector<TrackedPlan> _plans;
    std::unordered_map<std::string, std::vector<std::size_t>> _byPlanID;
    std::unordered_map<std::string, std::size_t> _byTransaction;
    ControlRequests _controls;
    std::unordered_map<std::string, Protocol::ERobotStatus> _robotStatuses; ///< The latest of MAX_ROBOTS, by robotID.
    /// Plans whose pause was reported as successful before their robot has reported Stopped.
    std::set<std::string> _standstillsDue;
    std::vector<std::string> _violations;
    std::size_t _violationCount = 0;
    std::array<std::size_t, OUTCOME_COUNT> _outcomes{};
    std::size_t _firstWaiting = 0;
    bool _bResending = true;
    bool _bAcsReady = false;

public:
    /// Transaction ids differ; planIds may repeat, which the ACS then refuses. Without resending a plan goes once, also
    /// where it is not acknowledged.
    explicit PlanTracker(std::vector<PlannedPlan> plans, bool bResending = true);

    /// One plan more, by its index; one with the transaction of another is that one.
    std::size_t AddPlan(PlannedPlan plan);

    /// An ACS has registered, on a first or a new connection: what it has not acknowledged is due again.
    void OnRegistered();
    void OnLinkLost();

    /// The plan to send now, by its index: none while no ACS is there or it cannot take work (section 6.21), or while too
    /// many wait for their Ack. Plans before `first` are passed over.
    [[nodiscard]] std::optional<std::size_t> GetNextToSendOrNull(Core::Now now, std::size_t first = 0);
    /// For a plan that was not sent yet: it is not due until it is unblocked.
    void Block(std::size_t index);
    void Unblock(std::size_t index);
    /// Other places than before, in a plan that was not sent yet.
    void ReplacePlan(std::size_t index, const Protocol::ExecutionPlan& plan);
    void OnSent(std::size_t index, Core::Now now, Lines& out);

    /// Any request that was sent to the ACS, those past the tracker included.
    void OnRequestSent(const Protocol::AcsRequest& request);

    void OnAck(const Protocol::AcsAck& ack, Lines& out);
    /// The Ack of this transaction came and was not read, through no fault of the ACS.
    void OnAckLost(const std::string& transactionID);

    /// Any request of the ACS that was not seen before, with its timestamp.
    void OnRequest(const Protocol::AcsPayload& payload, Core::WallTime sentAt, Lines& out);

    /// At the end of the run: what a report stated and none confirmed, and a reported plan without an Ack, are violations.
    void Finish(Lines& out);

    /// Something else is wrong with what came from the ACS.
    void AddViolation(std::string text, Lines& out);

    [[nodiscard]] const std::vector<TrackedPlan>& GetPlans() const noexcept;
    /// Of plans that share their planId the ACS has accepted one: the first that it did not refuse.
    [[nodiscard]] const TrackedPlan* FindPlanOrNull(const std::string& planID) const;
    [[nodiscard]] std::size_t CountOutcome(EOutcome outcome) const noexcept;
    /// Failed, Cancelled, Aborted and refused.
    [[nodiscard]] std::size_t CountFailed() const noexcept;
    [[nodiscard]] DoneCount CountSteps() const noexcept;
    [[nodiscard]] DoneCount CountJobs() const noexcept;
    [[nodiscard]] std::size_t CountResends() const noexcept;
    [[nodiscard]] std::size_t CountViolations() const noexcept;
    [[nodiscard]] const std::vector<std::string>& GetViolations() const noexcept;
    /// Whether every plan has ended, one way or the other.
    [[nodiscard]] bool IsFinished() const noexcept;
    /// Whether every plan is Completed, and no report was wrong.
    [[nodiscard]] bool IsSuccess() const noexcept;

private:
    [[nodiscard]] std::optional<std::size_t> FindIndexOrNull(const std::string& planID) const;
    [[nodiscard]] TrackedPlan* FindTrackedOrNull(const std::string& planID);
    void ChangePlan(TrackedPlan& plan, const std::function<void()>& change);
    [[nodiscard]] TrackedPlan* FindReportedOrNull(std::string_view what, const std::string& planID, Lines& out);
    [[nodiscard]] TrackedStep* FindStepOrNull(
        TrackedPlan& plan,
        std::string_view what,
        std::int32_t stepNo,
        Lines& out);
    /// Whether the last PlanReport confirms or refutes the success that a result report stated.
    void CheckConfirmed(TrackedPlan& plan, Lines& out);
    void AddUnknownJob(
        const TrackedPlan& plan,
        std::string_view what,
        std::int32_t stepNo,
        const std::string& jobID,
        Lines& out);
    /// A pause whose robot never reported standstill is a violation (section 6.7).
    void CheckStandstill(const TrackedPlan& plan, Lines& out);
    void CheckRobot(TrackedPlan& plan, const std::string& robotID, Lines& out);
    void Handle(const Protocol::PlanReport& report, Lines& out);
    void Handle(const Protocol::StepReport& report, Core::WallTime sentAt, Lines& out);
    void Handle(const Protocol::JobReport& report, Core::WallTime sentAt, Lines& out);
    /// An abort ends the running job and begins nothing (section 6.14).
    [[nodiscard]] std::optional<std::string> FindAbortViolationOrNull(
        const TrackedPlan& plan,
        std::string_view begun,
        Core::WallTime sentAt) const;
    template <Protocol::EAcsCommand COMMAND>
    void Handle(const Protocol::ResultReport<COMMAND>& report, Lines& out);
    /// What is wrong with the result of a request to cancel, abort, pause or resume.
    [[nodiscard]] std::optional<std::string> FindResultViolationOrNull(
        Protocol::EAcsCommand result,
        const std::string& planID,
        bool bSuccess);
    void Handle(const Protocol::ErrorReport& report, Lines& out);
    void Handle(const Protocol::RobotStatusUpdate& update, Lines& out);
    /// The plan, step and job that a message of a robot names have to exist.
    template <typename TMessage>
    void CheckNamed(std::string_view what, const TMessage& message, Lines& out);
    void Handle(const Protocol::AcsCommStateUpdate& update, Lines& out);
    static void Handle(const Protocol::TscStateUpdate& update, Lines& out);
};

} // namespace ACS::McsSim
