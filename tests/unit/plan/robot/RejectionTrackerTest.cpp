#include "robot/RejectionTracker.hpp"

#include "Catch.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace

TEST_CASE("RejectionTracker: a robot is exhausted by the limit of rejections in a row, then by each further one")
{
    RejectionTracker tracker;
    CHECK(tracker.GetState() == ERejection::None);
    CHECK_FALSE(tracker.TryRetry());
    tracker.Add("no route", 2);
    CHECK(tracker.GetState() == ERejection::Delayed);
    CHECK(tracker.TryRetry());
    tracker.Add("too wide", 2);
    CHECK(tracker.GetState() == ERejection::Exhausted);
    CHECK(tracker.GetCount() == 2);
    CHECK(tracker.GetReason() == "too wide");
    CHECK(tracker.TryRetry());
    CHECK(tracker.GetState() == ERejection::None);
    tracker.Add("too wide", 2);
    CHECK(tracker.GetState() == ERejection::Exhausted);
    CHECK(tracker.GetCount() == 2);
}

TEST_CASE("RejectionTracker: the row ends with the first progress")
{
    RejectionTracker tracker;
    CHECK_FALSE(tracker.TryReset());
    tracker.Add("no route", 2);
    CHECK(tracker.TryReset());
    CHECK_FALSE(tracker.TryReset());
    CHECK(tracker.GetReason().empty());
    tracker.Add("no route", 2);
    CHECK(tracker.GetState() == ERejection::Delayed);
    tracker.Add("no route", 1);
    CHECK(tracker.GetState() == ERejection::Exhausted);
}
