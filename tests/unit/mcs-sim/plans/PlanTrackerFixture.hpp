#pragma once

#include "ManualClock.hpp"
#include "plans/PlanTracker.hpp"
#include "plans/SamplePlans.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Testing
{

/// A tracker of one or more sample plans P1, P2, … with an ACS at its other end.
class PlanTrackerFixture
{
public:
    ManualClock clock;
    McsSim::PlanTracker tracker;
    McsSim::PlanTracker::Lines lines;

    explicit PlanTrackerFixture(std::size_t count = 1)
        : tracker(MakePlans(count))
    {
    }

    static std::vector<McsSim::PlannedPlan> MakePlans(std::size_t count)
    {
        std::vector<McsSim::PlannedPlan> plans;
        for (std::size_t i = 1; i <= count; ++i)
        {
            plans.push_back(MakeSamplePlan("P" + std::to_string(i), "T" + std::to_string(i)));
        }
        return plans;
    }

    /// Sends the plans that are due. Returns the planIds in order.
    std::string Send()
    {
        std::string sent;
        std::optional<std::size_t> next = tracker.GetNextToSendOrNull(clock.GetNow());
        while (next.has_value())
        {
            sent += (sent.empty() ? "" : " ") + tracker.GetPlans()[*next].planned.plan.planID;
            tracker.OnSent(*next, clock.GetNow(), lines);
            next = tracker.GetNextToSendOrNull(clock.GetNow());
        }
        return sent;
    }

    void Ack(
        std::size_t index,
        Protocol::EAckResult result = Protocol::EAckResult::Success,
        const std::string& message = {})
    {
        tracker.OnAck(MakeAck(tracker.GetPlans()[index].planned, result, message), lines);
    }

    void Report(const std::vector<Protocol::AcsPayload>& reports)
    {
        for (const Protocol::AcsPayload& report : reports)
        {
            tracker.OnRequest(report, clock.GetNow().wall, lines);
        }
    }

    /// The plan is sent and accepted.
    void Begin()
    {
        tracker.OnRegistered();
        Send();
        Ack(0);
    }

    /// Registered, sent, accepted, and the reports of the first step up to its job's end.
    void RunFirstJob()
    {
        Begin();
        Report({MakePlanReport("P1", Protocol::EPlanStatus::InProgress)});
        ReportFirstJob();
    }

    void RunFirstStep()
    {
        ReportFirstJob();
        Report({MakeStepReport("P1", 1, Protocol::EStepStatus::Completed)});
    }

    void ReportFirstJob()
    {
        Report(
            {MakeStepReport("P1", 1, Protocol::EStepStatus::Dispatched),
             MakeStepReport("P1", 1, Protocol::EStepStatus::InProgress),
             MakeJobReport("P1", 1, "J1", Protocol::EJobStatus::Instructed),
             MakeJobReport("P1", 1, "J1", Protocol::EJobStatus::InProgress),
             MakeJobReport("P1", 1, "J1", Protocol::EJobStatus::Completed)});
    }

    void RunSecondStep()
    {
        Report(
            {MakeStepReport("P1", 2, Protocol::EStepStatus::Dispatched),
             MakeStepReport("P1", 2, Protocol::EStepStatus::InProgress)});
        for (const char* const jobID : {"J2", "J3"})
        {
            Report(
                {MakeJobReport("P1", 2, jobID, Protocol::EJobStatus::Instructed),
                 MakeJobReport("P1", 2, jobID, Protocol::EJobStatus::InProgress),
                 MakeJobReport("P1", 2, jobID, Protocol::EJobStatus::Completed)});
        }
        Report({MakeStepReport("P1", 2, Protocol::EStepStatus::Completed)});
    }

    [[nodiscard]] const McsSim::TrackedPlan& GetFirst() const
    {
        return tracker.GetPlans().front();
    }

    /// The only violation; another text if there is none or more than one.
    [[nodiscard]] std::string GetViolation() const
    {
        return tracker.CountViolations() == 1 ? tracker.GetViolations().front()
                                              : std::to_string(tracker.CountViolations()) + " violations";
    }
};

} // namespace ACS::Testing
