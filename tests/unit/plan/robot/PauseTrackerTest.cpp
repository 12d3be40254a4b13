#include "robot/PauseTracker.hpp"

#include "Catch.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ERepeat = PauseTracker::ERepeat;

TEST_CASE("PauseTracker: a resume ends only a pause that was commanded")
{
    PauseTracker tracker;
    CHECK_FALSE(tracker.TryResume());
    tracker.Pause();
    CHECK(tracker.IsPaused());
    CHECK(tracker.TryResume());
    CHECK(tracker.IsResuming());
    CHECK_FALSE(tracker.IsPaused());
    CHECK_FALSE(tracker.TryResume());
    tracker.Reset();
    CHECK_FALSE(tracker.IsResuming());
}

TEST_CASE("PauseTracker: a pause is commanded again after a reconnect, or when the robot has resumed by itself")
{
    PauseTracker tracker;
    tracker.Pause();
    CHECK(tracker.OnState(false, false, true, false) == ERepeat::None); // it has not stopped yet
    CHECK(tracker.OnState(true, false, true, true) == ERepeat::None);
    CHECK(tracker.OnState(false, true, true, false) == ERepeat::Pause);
    CHECK(tracker.OnState(false, false, true, true) == ERepeat::Pause);
    CHECK(tracker.IsPaused());
}

TEST_CASE("PauseTracker: a state from before the pause does not confirm the resume")
{
    PauseTracker tracker;
    tracker.Pause();
    CHECK(tracker.TryResume()); // before the robot has shown the pause
    CHECK(tracker.OnState(false, false, true, false) == ERepeat::None);
    CHECK(tracker.IsResuming());
    SECTION("the robot received the pause only")
    {
        CHECK(tracker.OnState(true, false, true, true) == ERepeat::Resume);
        CHECK(tracker.OnState(false, true, true, false) == ERepeat::None);
    }
    SECTION("a later state shows no pause either")
    {
        CHECK(tracker.OnState(false, false, true, false) == ERepeat::None);
    }
    CHECK_FALSE(tracker.IsResuming());
    CHECK_FALSE(tracker.IsPaused());
}

TEST_CASE("PauseTracker: a resume is pending until the robot shows in automatic mode that it is not paused")
{
    PauseTracker tracker;
    tracker.Resume();
    CHECK(tracker.OnState(true, true, true, false) == ERepeat::None);
    CHECK(tracker.OnState(false, true, false, false) == ERepeat::None);
    CHECK(tracker.IsResuming());
    CHECK(tracker.OnState(true, true, true, true) == ERepeat::Resume);
    CHECK(tracker.OnState(false, true, true, true) == ERepeat::Resume); // it may have missed the command
    CHECK_FALSE(tracker.IsResuming());
    CHECK(tracker.OnState(false, false, true, true) == ERepeat::None);
}
