#include "plan/PlanBook.hpp"

#include "Catch.hpp"

#include <chrono>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace std::chrono_literals;

namespace
{

constexpr ACS::Core::WallTime START{1000h};

std::unique_ptr<ActivePlan> MakePlan(
    const std::string& planID,
    std::optional<std::int32_t> priorityOrNull = std::nullopt)
{
    auto plan = std::make_unique<ActivePlan>();
    plan->record.plan.planID = planID;
    plan->record.plan.priority = priorityOrNull;
    plan->record.plan.steps.resize(2);
    plan->record.plan.steps.front().jobs.resize(1);
    return plan;
}

ActivePlan& Accept(PlanBook& book, const std::string& planID, std::optional<std::int32_t> priorityOrNull = std::nullopt)
{
    static_cast<void>(book.Accept(MakePlan(planID, priorityOrNull), START));
    return *book.FindActiveOrNull(planID);
}

std::vector<StoreChange> Cancel(PlanBook& book, const std::string& planID)
{
    ActivePlan& plan = *book.FindActiveOrNull(planID);
    book.Change(plan, EPlanState::Cancelled, {}, START);
    return book.End(plan);
}

std::vector<std::string> ListQueue(const PlanBook& book)
{
    std::vector<std::string> planIDs;
    for (const auto& [key, plan] : book.GetQueue())
    {
        planIDs.push_back(plan->record.plan.planID);
    }
    return planIDs;
}

} // namespace

TEST_CASE("PlanBook: an accepted plan is numbered, pending and queued")
{
    const EngineOptions options;
    PlanBook book(options);
    const std::vector<StoreChange> changes = book.Accept(MakePlan("P1"), START);
    Accept(book, "P2");
    const PlanRecord& record = book.FindActiveOrNull("P1")->record;
    CHECK(changes == std::vector<StoreChange>{PlanAdded{record}});
    CHECK(record.sequence == 1);
    CHECK(record.acceptedAt == START);
    CHECK(record.progress.steps == std::vector<StepProgress>{{EStepState::Pending, {EJobState::Pending}}, {}});
    CHECK(book.FindRecordOrNull("P2")->sequence == 2);
    CHECK(ListQueue(book) == std::vector<std::string>{"P1", "P2"});
    CHECK_FALSE(book.IsAnyRunning());
}

TEST_CASE("PlanBook: the queue is ordered by priority and, within one, by age")
{
    EngineOptions options;
    SECTION("without ageing")
    {
        options.queueAgeing = 0ms;
    }
    SECTION("with ageing, for plans of one time")
    {
        options.queueAgeing = 1min;
    }
    SECTION("with lower numbers for more urgent plans")
    {
        options.bLowerPriorityFirst = true;
    }
    const int urgent = options.bLowerPriorityFirst ? 1 : 9;
    PlanBook book(options);
    Accept(book, "P1", 5);
    Accept(book, "P2", urgent);
    Accept(book, "P3", 5);
    CHECK(ListQueue(book) == std::vector<std::string>{"P2", "P1", "P3"});
    book.Dequeue(*book.FindActiveOrNull("P1"));
    CHECK(ListQueue(book) == std::vector<std::string>{"P2", "P3"});
    book.Enqueue(*book.FindActiveOrNull("P1"));
    CHECK(ListQueue(book) == std::vector<std::string>{"P2", "P1", "P3"});
}

TEST_CASE("PlanBook: only plans of earlier calls are stored")
{
    const EngineOptions options;
    PlanBook book(options);
    book.BeginCall({});
    ActivePlan& plan = Accept(book, "P1");
    CHECK(book.FindNextStoredOrNull(nullptr) == nullptr);
    book.BeginCall({});
    CHECK(book.FindNextStoredOrNull(nullptr) == &plan);
}

TEST_CASE("PlanBook: changes of state are collected once for each plan")
{
    const EngineOptions options;
    PlanBook book(options);
    ActivePlan& plan = Accept(book, "P1");
    CHECK(book.Change(plan, EPlanState::InProgress, "Assigned.", START + 1s) == EPlanState::Pending);
    CHECK(book.ChangeStep(plan, 0, EStepState::Dispatched) == EStepState::Pending);
    CHECK(book.ChangeJob(plan, EJobState::Instructed) == EJobState::Pending);
    CHECK(plan.record.progress.startedAt == START + 1s);
    CHECK(GetJobState(plan) == EJobState::Instructed);
    CHECK(book.IsAnyRunning());
    CHECK(book.CollectProgress() == std::vector<PlanProgressed>{{"P1", plan.record.progress}});
    CHECK(book.CollectProgress().empty());
    CHECK(PlanBook::CanEnd(plan, EPlanState::Completed));
    book.Change(plan, EPlanState::Paused, {}, START + 2s);
    CHECK_FALSE(PlanBook::CanEnd(plan, EPlanState::Completed));
}

TEST_CASE("PlanBook: an ended plan is history and lives to the end of the call")
{
    const EngineOptions options;
    PlanBook book(options);
    const ActivePlan& plan = Accept(book, "P1");
    CHECK(Cancel(book, "P1").empty());
    CHECK(plan.record.progress.endedAt == START);
    CHECK(book.FindActiveOrNull("P1") == nullptr);
    CHECK(book.GetQueue().empty());
    CHECK(book.FindRecordOrNull("P1")->progress.state == EPlanState::Cancelled);
    CHECK(book.CollectProgress().size() == 1);
}

TEST_CASE("PlanBook: the oldest finished plans are dropped after their end is stored")
{
    EngineOptions options;
    options.finishedPlansKept = 1;
    PlanBook book(options);
    Accept(book, "P1");
    Accept(book, "P2");
    Accept(book, "P3");
    CHECK(Cancel(book, "P1").empty());
    CHECK(Cancel(book, "P2").empty()); // the end of P1 is not stored yet
    static_cast<void>(book.CollectProgress());
    CHECK(Cancel(book, "P3") == std::vector<StoreChange>{PlanRemoved{1}, PlanRemoved{2}});
    CHECK(book.FindRecordOrNull("P1") == nullptr);
    CHECK(book.FindFinishedOrNull("P3") != nullptr);
}

TEST_CASE("PlanBook: a plan that cannot be stored leaves the finished plan of its id as it was")
{
    const EngineOptions options;
    PlanBook book(options);
    Accept(book, "P1");
    static_cast<void>(Cancel(book, "P1"));
    book.BeginCall({});
    const std::vector<StoreChange> changes = book.Accept(MakePlan("P1"), START);
    CHECK(changes.front() == StoreChange(PlanRemoved{1}));
    CHECK(book.IsReplaced(1));
    CHECK(book.FindRecordOrNull("P1")->progress.state == EPlanState::Pending);

    book.Withdraw("P1");
    CHECK(book.RestoreReplaced().empty());
    CHECK(book.GetQueue().empty());
    CHECK(book.FindRecordOrNull("P1")->progress.state == EPlanState::Cancelled);
    CHECK_FALSE(book.IsReplaced(1));
}

TEST_CASE("PlanBook: after a restart numbers continue and restored plans are stored")
{
    const EngineOptions options;
    PlanBook book(options);
    PlanRecord finished = MakePlan("P1")->record;
    finished.sequence = 7;
    finished.progress.state = EPlanState::Completed;
    PlanRecord waiting = MakePlan("P2")->record;
    waiting.sequence = 6;
    waiting.progress.steps.resize(2);
    static_cast<void>(book.RestoreFinished(finished));
    ActivePlan& plan = book.RestoreActive(waiting);
    CHECK(book.GetQueue().empty());
    book.Enqueue(plan);
    CHECK(book.FindNextStoredOrNull(nullptr) == &plan);
    CHECK(Accept(book, "P3").record.sequence == 8);
    CHECK(book.FindRecordOrNull("P1")->progress.state == EPlanState::Completed);
}

TEST_CASE("ActivePlan: the position after a restart is the first step and job that are not final")
{
    std::unique_ptr<ActivePlan> plan = MakePlan("P1");
    plan->record.plan.steps.back().jobs = {Job{"J1", {}, {}}, Job{"J2", {}, {}}};
    plan->record.progress.steps = {
        {EStepState::Completed, {EJobState::Completed}},
        {EStepState::InProgress, {EJobState::Completed, EJobState::Instructed}}};
    CHECK(FindOpenStepOrNull(*plan, 0) == 1U);
    FindPosition(*plan);
    CHECK(plan->step == 1);
    CHECK(GetJobID(*plan) == "J2");
    CHECK(GetJobState(*plan) == EJobState::Instructed);
}
