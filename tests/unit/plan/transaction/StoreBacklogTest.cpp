#include "transaction/StoreBacklog.hpp"

#include "Catch.hpp"

#include <cstdint>
#include <optional>
#include <vector>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace

namespace
{

const std::vector<StoreChange>& GetChanges()
{
    static const std::vector<StoreChange> CHANGES{PlanRemoved{1}, PlanRemoved{2}};
    return CHANGES;
}

SendReport MakeReport(std::uint64_t sequence, std::optional<std::uint64_t> replacedOrNull = std::nullopt)
{
    SendReport report;
    report.entry.sequence = sequence;
    report.replaced = replacedOrNull;
    return report;
}

} // namespace

TEST_CASE("StoreBacklog: while the store works every call stores its changes and no retry is timed")
{
    StoreBacklog backlog;
    CHECK(backlog.IsWorthTrying(GetChanges()));
    CHECK_FALSE(backlog.TryBeginAttempt());
    CHECK_FALSE(backlog.TryRecover());
    CHECK_FALSE(backlog.IsFailing());
}

TEST_CASE("StoreBacklog: after a failure only a new plan and the retry timer make an attempt")
{
    StoreBacklog backlog;
    backlog.OnFailed();
    CHECK(backlog.IsFailing());
    CHECK_FALSE(backlog.IsWorthTrying(GetChanges()));
    CHECK(backlog.IsWorthTrying(std::vector<StoreChange>{PlanAdded{}}));
    CHECK_FALSE(backlog.TryRecover());
    backlog.OnRetryDue();
    CHECK(backlog.IsWorthTrying(GetChanges()));
}

TEST_CASE("StoreBacklog: the store works again once an attempt was not followed by a failure")
{
    StoreBacklog backlog;
    SECTION("after a failure in this run")
    {
        backlog.OnFailed();
        backlog.OnRetryDue();
        CHECK(backlog.TryBeginAttempt());
        backlog.OnFailed();
        CHECK_FALSE(backlog.TryRecover());
        backlog.OnRetryDue();
    }
    SECTION("after a failure before the restart")
    {
        backlog.RestoreFailing();
        CHECK(backlog.IsWorthTrying(GetChanges()));
    }
    CHECK(backlog.TryBeginAttempt());
    CHECK(backlog.IsFailing());
    CHECK(backlog.TryRecover());
    CHECK_FALSE(backlog.IsFailing());
    CHECK_FALSE(backlog.TryRecover());
}

TEST_CASE("StoreBacklog: changes and reports wait in their order")
{
    StoreBacklog backlog;
    backlog.Add({GetChanges().front()});
    backlog.Add({GetChanges().back()});
    CHECK(backlog.CollectChanges() == GetChanges());
    CHECK(backlog.CollectChanges().empty());

    backlog.HoldBack(MakeReport(3));
    backlog.HoldBack(MakeReport(5));
    CHECK(backlog.IsHeldBack(MakeReport(5).entry));
    CHECK_FALSE(backlog.IsHeldBack(MakeReport(4).entry));
    CHECK(backlog.CountHeldBack() == 2);
    CHECK(backlog.CollectReports() == std::vector<SendReport>{MakeReport(3), MakeReport(5)});
    CHECK(backlog.CountHeldBack() == 0);
}

TEST_CASE(
    "StoreBacklog: a report that is replaced before it was sent is dropped, and its successor replaces what it replaced")
{
    StoreBacklog backlog;
    backlog.HoldBack(MakeReport(3, 1));
    backlog.HoldBack(MakeReport(4));
    backlog.HoldBack(MakeReport(5, 3));
    CHECK(backlog.CollectReports() == std::vector<SendReport>{MakeReport(4), MakeReport(5, 1)});
}

TEST_CASE("StoreBacklog: of refusals that are withheld only the latest are kept")
{
    StoreBacklog backlog;
    for (std::uint64_t token = 1; token <= StoreBacklog::MOST_WITHHELD + 2; ++token)
    {
        backlog.Withhold({token, false, "no room"});
    }
    const std::vector<ReplyCommand> refusals = backlog.CollectWithheld();
    REQUIRE(refusals.size() == StoreBacklog::MOST_WITHHELD);
    CHECK(refusals.front().replyToken == 3);
    CHECK_FALSE(backlog.HasWithheld());
}
