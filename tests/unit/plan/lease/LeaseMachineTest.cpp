#include "Catch.hpp"
#include <acs/plan/EPlanningError.hpp>
#include <acs/plan/LeaseMachine.hpp>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS;           // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;

namespace
{

constexpr std::chrono::milliseconds LEASE{3'000};

/// A machine, and the time.
struct LeaseMachineFixture
{
    LeaseMachine machine{LeaseClaim{"this one", "config", LEASE}};
    Core::SteadyTime now{1h};

    [[nodiscard]] LeaseActions Start(Core::Duration pause = {}, const std::string& reason = {})
    {
        LeaseActions out;
        machine.Start(pause, reason, now, out);
        return out;
    }

    [[nodiscard]] LeaseActions Fire(ELeaseTimer timer)
    {
        LeaseActions out;
        machine.OnTimer(timer, now, out);
        return out;
    }

    [[nodiscard]] LeaseActions Read(const Core::Result<LeaseState>& state)
    {
        LeaseActions out;
        machine.OnRead(state, now, out);
        return out;
    }

    [[nodiscard]] LeaseActions Take(const Core::Result<std::optional<std::uint64_t>>& taken)
    {
        LeaseActions out;
        machine.OnTaken(taken, now, out);
        return out;
    }

    [[nodiscard]] LeaseActions Renew(const Core::Result<bool>& renewed)
    {
        LeaseActions out;
        machine.OnRenewed(renewed, now, out);
        return out;
    }

    [[nodiscard]] LeaseActions EndRelease()
    {
        LeaseActions out;
        machine.OnReleased(out);
        return out;
    }

    [[nodiscard]] LeaseActions Release()
    {
        LeaseActions out;
        machine.Release(out);
        return out;
    }

    /// Takes a free lease with epoch 1, in 10 ms.
    void Lead()
    {
        REQUIRE(Start() == LeaseActions{ReadLease{}});
        REQUIRE(Read(LeaseState{}) == LeaseActions{TakeLease{}});
        const Core::SteadyTime askedAt = now;
        now += 10ms;
        REQUIRE(
            Take(1)
            == LeaseActions{
                LeaseExtended{askedAt + 2'500ms},
                StartLeaseTimer{ELeaseTimer::End, 2'490ms},
                StartLeaseTimer{ELeaseTimer::Renew, 500ms},
                LeaseTaken{1}});
    }
};

tl::unexpected<Core::Error> MakeFault()
{
    return Core::Fail(make_error_code(EPlanningError::StoreFailed), "db", "a server", "none");
}

const std::string FAULT = Core::Describe(MakeFault().value());
const LeaseActions READ_LATER{StartLeaseTimer{ELeaseTimer::Read, 250ms}};

} // namespace

TEST_CASE("LeaseMachine: a free lease is taken, renewed at intervals, and released")
{
    LeaseMachineFixture fixture;
    CHECK(fixture.machine.GetWait() == LeaseWait{ELeaseWait::NotRead, {}});
    fixture.Lead();
    CHECK(fixture.machine.GetWait() == LeaseWait{ELeaseWait::TakesOver, {}});
    fixture.now += 500ms;
    const Core::SteadyTime askedAt = fixture.now;
    CHECK(fixture.Fire(ELeaseTimer::Renew) == LeaseActions{StartLeaseTimer{ELeaseTimer::Renew, 500ms}, RenewLease{1}});
    fixture.now += 100ms;
    CHECK(
        fixture.Renew(true)
        == LeaseActions{LeaseExtended{askedAt + 2'500ms}, StartLeaseTimer{ELeaseTimer::End, 2'400ms}});
    CHECK(fixture.Release() == LeaseActions{LeaseRevoked{}, ReleaseLease{1}});
    CHECK(fixture.machine.GetWait() == LeaseWait{ELeaseWait::Releases, {}});
    CHECK(fixture.Release().empty());
    CHECK(fixture.EndRelease() == LeaseActions{LeaseEnded{}});
    CHECK(fixture.EndRelease().empty());
    CHECK(fixture.Release() == LeaseActions{LeaseRevoked{}, LeaseEnded{}});
}

TEST_CASE("LeaseMachine: a lease is released while it is being renewed")
{
    LeaseMachineFixture fixture;
    fixture.Lead();
    CHECK(fixture.Fire(ELeaseTimer::Renew).size() == 2);
    CHECK(fixture.Release() == LeaseActions{LeaseRevoked{}, ReleaseLease{1}});
    CHECK(fixture.Renew(true).empty());
    CHECK(fixture.Release().empty());
    CHECK(fixture.EndRelease() == LeaseActions{LeaseEnded{}});
}

TEST_CASE("LeaseMachine: a lease of another process is taken when it was not renewed for its duration")
{
    LeaseMachineFixture fixture;
    const LeaseState other{7, 3, "other", "config", 3s, false};
    static_cast<void>(fixture.Start());
    CHECK(fixture.Read(other) == READ_LATER);
    CHECK(fixture.machine.GetWait() == LeaseWait{ELeaseWait::OtherLeads, "other"});
    CHECK(fixture.Fire(ELeaseTimer::Read) == LeaseActions{ReadLease{}});
    fixture.now += 2'999ms;
    CHECK(fixture.Read(other) == READ_LATER);
    fixture.now += 1ms;
    CHECK(fixture.Read(other) == LeaseActions{TakeLease{other}});
    CHECK(fixture.Take(std::nullopt) == READ_LATER); // another standby was faster
}

TEST_CASE("LeaseMachine: the leader's name and configuration are reasons to wait")
{
    LeaseMachineFixture fixture;
    static_cast<void>(fixture.Start());
    CHECK(fixture.Read(LeaseState{7, 3, "this one", "config", 3s, false}) == READ_LATER);
    CHECK(fixture.machine.GetWait() == LeaseWait{ELeaseWait::OwnName, "this one"});
    CHECK(fixture.Read(LeaseState{7, 4, "other", "another", 3s, false}) == READ_LATER);
    CHECK(fixture.machine.GetWait() == LeaseWait{ELeaseWait::OtherConfig, "other"});
}

TEST_CASE("LeaseMachine: a request without an answer is not repeated, and the lease ends")
{
    LeaseMachineFixture fixture;
    fixture.Lead();
    fixture.now += 500ms;
    CHECK(fixture.Fire(ELeaseTimer::Renew).size() == 2);
    fixture.now += 500ms;
    CHECK(fixture.Fire(ELeaseTimer::Renew) == LeaseActions{StartLeaseTimer{ELeaseTimer::Renew, 500ms}});
    fixture.now += 1'490ms;
    CHECK(
        fixture.Fire(ELeaseTimer::End)
        == LeaseActions{LeaseRevoked{}, LeaseLost{"the lease could not be renewed: the store is slow"}});
    CHECK(fixture.Renew(true).empty());
    CHECK(fixture.Fire(ELeaseTimer::Renew).empty());
    CHECK(fixture.Fire(ELeaseTimer::End).empty());
    CHECK(fixture.Release() == LeaseActions{LeaseRevoked{}, LeaseEnded{}});
}

TEST_CASE("LeaseMachine: a failed renewal is tried again until the lease ends; each fault is reported once")
{
    LeaseMachineFixture fixture;
    fixture.Lead();
    fixture.now += 500ms;
    CHECK(fixture.Fire(ELeaseTimer::Renew).size() == 2);
    CHECK(fixture.Renew(MakeFault()) == LeaseActions{LeaseFault{FAULT}});
    fixture.now += 500ms;
    CHECK(fixture.Fire(ELeaseTimer::Renew).size() == 2);
    CHECK(fixture.Renew(MakeFault()).empty());
    CHECK(
        fixture.Fire(ELeaseTimer::End)
        == LeaseActions{LeaseRevoked{}, LeaseLost{"the lease could not be renewed: " + FAULT}});
}

TEST_CASE("LeaseMachine: a leader that another one has replaced, or that stalled, has lost the lease")
{
    LeaseMachineFixture fixture;
    fixture.Lead();
    SECTION("replaced")
    {
        CHECK(fixture.Fire(ELeaseTimer::Renew).size() == 2);
        CHECK(
            fixture.Renew(false)
            == LeaseActions{LeaseRevoked{}, LeaseLost{"another process has taken the lease, or its row was changed"}});
    }
    SECTION("stalled until a timer")
    {
        fixture.now += 2'490ms;
        CHECK(
            fixture.Fire(ELeaseTimer::Renew)
            == LeaseActions{LeaseRevoked{}, LeaseLost{"this process has stalled for longer than its lease"}});
    }
    SECTION("stalled until the answer, which does not revive the lease")
    {
        CHECK(fixture.Fire(ELeaseTimer::Renew).size() == 2);
        fixture.now += 2'490ms;
        CHECK(
            fixture.Renew(true)
            == LeaseActions{LeaseRevoked{}, LeaseLost{"this process has stalled for longer than its lease"}});
    }
}

TEST_CASE("LeaseMachine: a lease that took too long to be taken is released and taken again")
{
    LeaseMachineFixture fixture;
    static_cast<void>(fixture.Start());
    CHECK(fixture.Read(LeaseState{}) == LeaseActions{TakeLease{}});
    fixture.now += 2'500ms;
    CHECK(
        fixture.Take(1)
        == LeaseActions{ReleaseLease{1}, LeaseFault{"it took too long to take the lease"}, READ_LATER.front()});
    SECTION("the process ends meanwhile")
    {
        CHECK(fixture.Release() == LeaseActions{LeaseRevoked{}});
        CHECK(fixture.EndRelease() == LeaseActions{LeaseEnded{}});
        return;
    }
    CHECK(fixture.EndRelease().empty());
    const LeaseState released{1, 0, "this one", "config", 3s, true};
    CHECK(fixture.Fire(ELeaseTimer::Read) == LeaseActions{ReadLease{}});
    CHECK(fixture.Read(released) == LeaseActions{TakeLease{released}});
}

TEST_CASE("LeaseMachine: a process that ends while it takes the lease releases it")
{
    LeaseMachineFixture fixture;
    static_cast<void>(fixture.Start());
    CHECK(fixture.Read(LeaseState{}) == LeaseActions{TakeLease{}});
    CHECK(fixture.Release() == LeaseActions{LeaseRevoked{}});
    SECTION("taken")
    {
        CHECK(fixture.Take(1) == LeaseActions{ReleaseLease{1}});
        CHECK(fixture.EndRelease() == LeaseActions{LeaseEnded{}});
    }
    SECTION("not taken")
    {
        CHECK(fixture.Take(std::nullopt) == LeaseActions{LeaseEnded{}});
    }
    CHECK(fixture.Read(LeaseState{}).empty());
    CHECK(fixture.Fire(ELeaseTimer::Read).empty());
}

TEST_CASE("LeaseMachine: a standby that ends has nothing to release")
{
    LeaseMachineFixture fixture;
    static_cast<void>(fixture.Start());
    CHECK(fixture.Release() == LeaseActions{LeaseRevoked{}, LeaseEnded{}});
    CHECK(fixture.Read(LeaseState{}).empty());
}

TEST_CASE("LeaseMachine: a store that can be read and not written is one fault")
{
    LeaseMachineFixture fixture;
    static_cast<void>(fixture.Start());
    CHECK(fixture.Read(LeaseState{}) == LeaseActions{TakeLease{}});
    CHECK(fixture.Take(MakeFault()) == LeaseActions{LeaseFault{FAULT}, READ_LATER.front()});
    CHECK(fixture.machine.GetWait() == LeaseWait{ELeaseWait::StoreFailed, FAULT});
    CHECK(fixture.Read(LeaseState{}) == LeaseActions{TakeLease{}});
    CHECK(fixture.Take(MakeFault()) == READ_LATER);
    CHECK(fixture.Read(LeaseState{}) == LeaseActions{TakeLease{}});
    CHECK(fixture.Take(1).size() == 4);
}

TEST_CASE("LeaseMachine: after a fault of its own, a process pauses before it takes the lease")
{
    LeaseMachineFixture fixture;
    static_cast<void>(fixture.Start(6s, "the table reports is missing"));
    CHECK(fixture.machine.GetWait() == LeaseWait{ELeaseWait::StoreFailed, "the table reports is missing"});
    fixture.now += 5'999ms;
    CHECK(fixture.Read(LeaseState{}) == READ_LATER);
    SECTION("no other process leads")
    {
        CHECK(fixture.machine.GetWait() == LeaseWait{ELeaseWait::StoreFailed, "the table reports is missing"});
        fixture.now += 1ms;
        CHECK(fixture.Read(LeaseState{}) == LeaseActions{TakeLease{}});
    }
    SECTION("another process leads")
    {
        CHECK(fixture.Read(LeaseState{7, 3, "other", "config", 3s, false}) == READ_LATER);
        CHECK(fixture.machine.GetWait() == LeaseWait{ELeaseWait::OtherLeads, "other"});
    }
}
