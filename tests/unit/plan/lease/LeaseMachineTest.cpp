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

constexpr std::chrono::milliseconds DURATION{3'000};

/// A machine, and the time.
struct LeaseBench
{
    LeaseMachine machine{LeaseClaim{"this one", "config", DURATION}};
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
    LeaseBench bench;
    CHECK(bench.machine.GetWait() == LeaseWait{ELeaseWait::NotRead, {}});
    bench.Lead();
    CHECK(bench.machine.GetWait() == LeaseWait{ELeaseWait::TakesOver, {}});
    bench.now += 500ms;
    const Core::SteadyTime askedAt = bench.now;
    CHECK(bench.Fire(ELeaseTimer::Renew) == LeaseActions{StartLeaseTimer{ELeaseTimer::Renew, 500ms}, RenewLease{1}});
    bench.now += 100ms;
    CHECK(
        bench.Renew(true)
        == LeaseActions{LeaseExtended{askedAt + 2'500ms}, StartLeaseTimer{ELeaseTimer::End, 2'400ms}});
    CHECK(bench.Release() == LeaseActions{ReleaseLease{1}});
    CHECK(bench.machine.GetWait() == LeaseWait{ELeaseWait::Releases, {}});
    CHECK(bench.Release().empty());
    CHECK(bench.EndRelease() == LeaseActions{LeaseEnded{}});
    CHECK(bench.EndRelease().empty());
}

TEST_CASE("LeaseMachine: a lease of another process is taken when it was not renewed for its duration")
{
    LeaseBench bench;
    const LeaseState other{7, 3, "other", "config", 3s, false};
    static_cast<void>(bench.Start());
    CHECK(bench.Read(other) == READ_LATER);
    CHECK(bench.machine.GetWait() == LeaseWait{ELeaseWait::OtherLeads, "other"});
    CHECK(bench.Fire(ELeaseTimer::Read) == LeaseActions{ReadLease{}});
    bench.now += 2'999ms;
    CHECK(bench.Read(other) == READ_LATER);
    bench.now += 1ms;
    CHECK(bench.Read(other) == LeaseActions{TakeLease{other}});
    CHECK(bench.Take(std::nullopt) == READ_LATER); // another standby was faster
}

TEST_CASE("LeaseMachine: the leader's name and configuration are reasons to wait")
{
    LeaseBench bench;
    static_cast<void>(bench.Start());
    CHECK(bench.Read(LeaseState{7, 3, "this one", "config", 3s, false}) == READ_LATER);
    CHECK(bench.machine.GetWait() == LeaseWait{ELeaseWait::OwnName, "this one"});
    CHECK(bench.Read(LeaseState{7, 4, "other", "another", 3s, false}) == READ_LATER);
    CHECK(bench.machine.GetWait() == LeaseWait{ELeaseWait::OtherConfig, "other"});
}

TEST_CASE("LeaseMachine: a request without an answer is not repeated, and the lease ends")
{
    LeaseBench bench;
    bench.Lead();
    bench.now += 500ms;
    CHECK(bench.Fire(ELeaseTimer::Renew).size() == 2);
    bench.now += 500ms;
    CHECK(bench.Fire(ELeaseTimer::Renew) == LeaseActions{StartLeaseTimer{ELeaseTimer::Renew, 500ms}});
    bench.now += 1'490ms;
    CHECK(bench.Fire(ELeaseTimer::End) == LeaseActions{LeaseLost{"the lease could not be renewed: the store is slow"}});
    CHECK(bench.Renew(true).empty());
    CHECK(bench.Fire(ELeaseTimer::Renew).empty());
    CHECK(bench.Fire(ELeaseTimer::End).empty());
    CHECK(bench.Release() == LeaseActions{LeaseEnded{}});
}

TEST_CASE("LeaseMachine: a failed renewal is tried again until the lease ends; each fault is reported once")
{
    LeaseBench bench;
    bench.Lead();
    bench.now += 500ms;
    CHECK(bench.Fire(ELeaseTimer::Renew).size() == 2);
    CHECK(bench.Renew(MakeFault()) == LeaseActions{LeaseFault{FAULT}});
    bench.now += 500ms;
    CHECK(bench.Fire(ELeaseTimer::Renew).size() == 2);
    CHECK(bench.Renew(MakeFault()).empty());
    CHECK(bench.Fire(ELeaseTimer::End) == LeaseActions{LeaseLost{"the lease could not be renewed: " + FAULT}});
}

TEST_CASE("LeaseMachine: a leader that another one has replaced, or that stalled, has lost the lease")
{
    LeaseBench bench;
    bench.Lead();
    SECTION("replaced")
    {
        CHECK(bench.Fire(ELeaseTimer::Renew).size() == 2);
        CHECK(
            bench.Renew(false)
            == LeaseActions{LeaseLost{"another process has taken the lease, or its row was changed"}});
    }
    SECTION("stalled until a timer")
    {
        bench.now += 2'490ms;
        CHECK(
            bench.Fire(ELeaseTimer::Renew)
            == LeaseActions{LeaseLost{"this process has stalled for longer than its lease"}});
    }
    SECTION("stalled until the answer, which does not revive the lease")
    {
        CHECK(bench.Fire(ELeaseTimer::Renew).size() == 2);
        bench.now += 2'490ms;
        CHECK(bench.Renew(true) == LeaseActions{LeaseLost{"this process has stalled for longer than its lease"}});
    }
}

TEST_CASE("LeaseMachine: a lease that took too long to be taken is released and taken again")
{
    LeaseBench bench;
    static_cast<void>(bench.Start());
    CHECK(bench.Read(LeaseState{}) == LeaseActions{TakeLease{}});
    bench.now += 2'500ms;
    CHECK(
        bench.Take(1)
        == LeaseActions{LeaseFault{"it took too long to take the lease"}, ReleaseLease{1}, READ_LATER.front()});
    CHECK(bench.EndRelease().empty());
    const LeaseState released{1, 0, "this one", "config", 3s, true};
    CHECK(bench.Fire(ELeaseTimer::Read) == LeaseActions{ReadLease{}});
    CHECK(bench.Read(released) == LeaseActions{TakeLease{released}});
}

TEST_CASE("LeaseMachine: a process that ends while it takes the lease releases it")
{
    LeaseBench bench;
    static_cast<void>(bench.Start());
    CHECK(bench.Read(LeaseState{}) == LeaseActions{TakeLease{}});
    CHECK(bench.Release().empty());
    SECTION("taken")
    {
        CHECK(bench.Take(1) == LeaseActions{ReleaseLease{1}});
        CHECK(bench.EndRelease() == LeaseActions{LeaseEnded{}});
    }
    SECTION("not taken")
    {
        CHECK(bench.Take(std::nullopt) == LeaseActions{LeaseEnded{}});
    }
    CHECK(bench.Read(LeaseState{}).empty());
    CHECK(bench.Fire(ELeaseTimer::Read).empty());
}

TEST_CASE("LeaseMachine: a standby that ends has nothing to release")
{
    LeaseBench bench;
    static_cast<void>(bench.Start());
    CHECK(bench.Release() == LeaseActions{LeaseEnded{}});
    CHECK(bench.Read(LeaseState{}).empty());
}

TEST_CASE("LeaseMachine: a store that can be read and not written is one fault")
{
    LeaseBench bench;
    static_cast<void>(bench.Start());
    CHECK(bench.Read(LeaseState{}) == LeaseActions{TakeLease{}});
    CHECK(bench.Take(MakeFault()) == LeaseActions{LeaseFault{FAULT}, READ_LATER.front()});
    CHECK(bench.machine.GetWait() == LeaseWait{ELeaseWait::StoreFailed, FAULT});
    CHECK(bench.Read(LeaseState{}) == LeaseActions{TakeLease{}});
    CHECK(bench.Take(MakeFault()) == READ_LATER);
    CHECK(bench.Read(LeaseState{}) == LeaseActions{TakeLease{}});
    CHECK(bench.Take(1).size() == 4);
}

TEST_CASE("LeaseMachine: after a fault of its own, a process pauses before it takes the lease")
{
    LeaseBench bench;
    static_cast<void>(bench.Start(6s, "the table reports is missing"));
    CHECK(bench.machine.GetWait() == LeaseWait{ELeaseWait::StoreFailed, "the table reports is missing"});
    bench.now += 5'999ms;
    CHECK(bench.Read(LeaseState{}) == READ_LATER);
    SECTION("no other process leads")
    {
        CHECK(bench.machine.GetWait() == LeaseWait{ELeaseWait::StoreFailed, "the table reports is missing"});
        bench.now += 1ms;
        CHECK(bench.Read(LeaseState{}) == LeaseActions{TakeLease{}});
    }
    SECTION("another process leads")
    {
        CHECK(bench.Read(LeaseState{7, 3, "other", "config", 3s, false}) == READ_LATER);
        CHECK(bench.machine.GetWait() == LeaseWait{ELeaseWait::OtherLeads, "other"});
    }
}
