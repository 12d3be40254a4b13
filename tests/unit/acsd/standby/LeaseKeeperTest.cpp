#include "standby/LeaseKeeper.hpp"

#include "Catch.hpp"
#include "ManualClock.hpp"
#include "RecordingLogSink.hpp"
#include <acs/plan/EPlanningError.hpp>

#include <boost/asio/io_context.hpp>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

/// The row of a store, and whether the store answers. Used by two threads.
class LeaseRow
{
    mutable std::mutex _mutex;
    Planning::LeaseState _state;
    bool _bFails = false;
    bool _bReadOnly = false;
    std::function<void()> _onTaken; ///< Set while no call is under way.

public:
    void SetOnTaken(std::function<void()> onTaken)
    {
        _onTaken = std::move(onTaken);
    }

    void Take(const Planning::LeaseState& state)
    {
        Change([&state](Planning::LeaseState& row) { row = state; });
        if (const std::function<void()> onTaken = _onTaken; onTaken)
        {
            onTaken();
        }
    }

    void Change(const std::function<void(Planning::LeaseState&)>& change)
    {
        const std::lock_guard lock(_mutex);
        change(_state);
    }

    void Fail(bool bFails)
    {
        const std::lock_guard lock(_mutex);
        _bFails = bFails;
    }

    void SetReadOnly(bool bReadOnly)
    {
        const std::lock_guard lock(_mutex);
        _bReadOnly = bReadOnly;
    }

    [[nodiscard]] bool IsReadOnly() const
    {
        const std::lock_guard lock(_mutex);
        return _bReadOnly;
    }

    [[nodiscard]] Core::Result<Planning::LeaseState> Get() const
    {
        const std::lock_guard lock(_mutex);
        if (_bFails)
        {
            return Core::Fail(make_error_code(Planning::EPlanningError::StoreFailed), "db", "a server", "none");
        }
        return _state;
    }
};

class RowLease final : public Planning::ILease
{
    LeaseRow& _row;

public:
    explicit RowLease(LeaseRow& row)
        : _row(row)
    {
    }

    [[nodiscard]] Core::Result<Planning::LeaseState> Read() override
    {
        return _row.Get();
    }

    [[nodiscard]] Core::Result<std::optional<std::uint64_t>> TryTakeOrNull(
        const Planning::LeaseState& seen,
        const Planning::LeaseClaim& claim) override
    {
        if (_row.IsReadOnly())
        {
            return Core::Fail(make_error_code(Planning::EPlanningError::StoreFailed), "db", "writes", "none");
        }
        return _row.Get().map([&](const Planning::LeaseState& state) -> std::optional<std::uint64_t> {
            if (state != seen)
            {
                return std::nullopt;
            }
            _row.Take({seen.epoch + 1, 0, claim.holder, claim.config, claim.duration, false});
            return seen.epoch + 1;
        });
    }

    [[nodiscard]] Core::Result<bool> TryRenew(std::uint64_t epoch) override
    {
        return _row.Get().map([&](const Planning::LeaseState& state) {
            _row.Change([](Planning::LeaseState& row) { ++row.renewal; });
            return state.epoch == epoch;
        });
    }

    [[nodiscard]] Core::Result<void> Release(std::uint64_t /*epoch*/) override
    {
        _row.Change([](Planning::LeaseState& row) { row.bReleased = true; });
        return {};
    }
};

/// The clock of the process is advanced by the test; only the intervals between two calls are real, and short.
struct LeaseKeeperFixture
{
    static constexpr std::chrono::milliseconds DURATION{1'000};

    boost::asio::io_context context;
    Testing::ManualClock clock;
    Testing::RecordingLogSink log;
    LeaseRow row;
    LeaseGuard guard{clock};
    std::vector<std::uint64_t> taken;
    std::vector<std::string> lost;
    std::unique_ptr<LeaseKeeper> keeper;

    LeaseKeeperFixture()
    {
        Make("config");
    }

    void Make(const std::string& config)
    {
        keeper.reset();
        keeper = std::make_unique<LeaseKeeper>(
            LeaseKeeper::Dependencies{context.get_executor(), clock, Core::Logger(log, "lease"), guard},
            [this](const std::function<bool()>& /*shouldStop*/) { return std::make_unique<RowLease>(row); },
            Planning::LeaseClaim{"this one", config, DURATION},
            LeaseKeeper::Handlers{
                [this](std::uint64_t epoch) { taken.push_back(epoch); },
                [this](const std::string& reason) {
                    lost.push_back(reason);
                }});
    }

    void RunUntil(const std::function<bool()>& isReached)
    {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
        while (!isReached() && std::chrono::steady_clock::now() < end)
        {
            context.restart();
            context.run_one_for(std::chrono::milliseconds(50));
        }
        REQUIRE(isReached());
    }
};

} // namespace

TEST_CASE_METHOD(LeaseKeeperFixture, "A lease that is free is taken, renewed and released")
{
    CHECK(keeper->GetWaitReason() == "standby: the store was not read yet");
    CHECK_FALSE(guard.IsHeld());
    keeper->Start();
    RunUntil([&] { return !taken.empty(); });
    CHECK(taken == std::vector<std::uint64_t>{1});
    CHECK(guard.IsHeld());
    RunUntil([&] { return row.Get()->renewal >= 2; });
    bool bReleased = false;
    keeper->ReleaseAsync([&] { bReleased = true; });
    CHECK_FALSE(guard.IsHeld());
    CHECK(keeper->GetWaitReason() == "standby: this process releases its lease");
    CHECK(keeper->GetPublicReason() == keeper->GetWaitReason());
    RunUntil([&] { return bReleased; });
    CHECK(row.Get()->bReleased);
    CHECK(lost.empty());
}

TEST_CASE_METHOD(LeaseKeeperFixture, "A lease of another process is taken when it has not been renewed, by this clock")
{
    row.Change([](Planning::LeaseState& state) { state = {7, 3, "other", "config", DURATION, false}; });
    keeper->Start();
    RunUntil([&] { return keeper->GetWaitReason() == "standby: other leads"; });
    clock.Advance(DURATION);
    RunUntil([&] { return !taken.empty(); });
    CHECK(taken == std::vector<std::uint64_t>{8});
}

TEST_CASE_METHOD(LeaseKeeperFixture, "A standby with another configuration shows that it cannot take over")
{
    Make("other config");
    row.Change([](Planning::LeaseState& state) { state = {7, 3, "acs1", "config", DURATION, false}; });
    keeper->Start();
    RunUntil([&] { return keeper->GetWaitReason().starts_with("standby that cannot take over"); });
    clock.Advance(10 * DURATION);
    row.Change([](Planning::LeaseState& state) { state.bReleased = true; });
    RunUntil([&] { return !taken.empty(); });
}

TEST_CASE_METHOD(
    LeaseKeeperFixture,
    "The lease is lost when another process has taken it, or the store does not answer in time")
{
    keeper->Start();
    RunUntil([&] { return !taken.empty(); });
    SECTION("taken")
    {
        row.Change([](Planning::LeaseState& state) { state.epoch = 2; });
        RunUntil([&] { return !lost.empty(); });
        CHECK_THAT(lost.front(), Catch::Contains("another process has taken the lease"));
    }
    SECTION("no answer")
    {
        row.Fail(true);
        RunUntil([&] { return !lost.empty(); });
        CHECK_THAT(lost.front(), Catch::Contains("could not be renewed") && Catch::Contains("found none"));
        CHECK(log.Contains(Core::ELogLevel::Warning, "cannot be read or renewed"));
    }
    SECTION("the process has stalled: the guard knows before any handler runs")
    {
        CHECK(guard.IsHeld());
        clock.Advance(DURATION);
        CHECK_FALSE(guard.IsHeld());
        RunUntil([&] { return !lost.empty(); });
    }
    CHECK_FALSE(guard.IsHeld());
    CHECK(lost.size() == 1);
}

TEST_CASE_METHOD(LeaseKeeperFixture, "A lease that took too long to be taken is released, and is taken again")
{
    row.SetOnTaken([this] {
        clock.Advance(DURATION);
        row.SetOnTaken({});
    });
    keeper->Start();
    RunUntil([&] { return !taken.empty(); });
    CHECK(taken == std::vector<std::uint64_t>{2});
    CHECK(guard.IsHeld());
    CHECK(lost.empty());
}

TEST_CASE_METHOD(LeaseKeeperFixture, "A lease that is being taken when the process ends is released")
{
    bool bReleased = false;
    keeper->Start();
    RunUntil([&] { return keeper->GetWaitReason() != "standby: the store was not read yet"; });
    keeper->ReleaseAsync([&] { bReleased = true; });
    RunUntil([&] { return bReleased; });
    CHECK(taken.empty());
    CHECK(row.Get()->bReleased);
}

TEST_CASE_METHOD(LeaseKeeperFixture, "A second release replaces the handler of the first, and waits as that did")
{
    bool bFirst = false;
    bool bSecond = false;
    keeper->Start();
    RunUntil([&] { return !taken.empty(); });
    keeper->ReleaseAsync([&] { bFirst = true; });
    keeper->ReleaseAsync([&] {
        bSecond = true;
        CHECK(row.Get()->bReleased);
    });
    RunUntil([&] { return bSecond; });
    CHECK_FALSE(bFirst);
}

TEST_CASE_METHOD(LeaseKeeperFixture, "No handler is called after the end of the keeper")
{
    bool bReleased = false;
    keeper->ReleaseAsync([&] { bReleased = true; });
    keeper.reset();
    context.run();
    CHECK_FALSE(bReleased);
}

TEST_CASE_METHOD(LeaseKeeperFixture, "A store that cannot be read is a reason to wait")
{
    row.Fail(true);
    keeper->Start();
    RunUntil([&] { return keeper->GetWaitReason().starts_with("standby: the store cannot be used: "); });
    CHECK_THAT(keeper->GetPublicReason(), !Catch::Contains("found none"));
    row.Fail(false);
    RunUntil([&] { return !taken.empty(); });
    row.Fail(true); // it is destroyed while a call may be under way
}

TEST_CASE_METHOD(LeaseKeeperFixture, "A lease that can be read and not taken is one reason, logged once")
{
    row.SetReadOnly(true);
    keeper->Start();
    RunUntil([&] { return keeper->GetWaitReason().starts_with("standby: the store cannot be used: "); });
    bool bStays = true;
    const auto end = std::chrono::steady_clock::now() + 3 * (DURATION / 12);
    RunUntil([&] {
        bStays = bStays && keeper->GetWaitReason().starts_with("standby: the store cannot be used: ");
        return std::chrono::steady_clock::now() >= end;
    });
    CHECK(bStays);
    CHECK(log.CountLevel(Core::ELogLevel::Warning) == 1);
    row.SetReadOnly(false);
    RunUntil([&] { return !taken.empty(); });
}

TEST_CASE_METHOD(LeaseKeeperFixture, "A process that could not use the store pauses before it takes the lease again")
{
    keeper->Start(std::chrono::seconds(6), "the table reports is missing");
    CHECK_THAT(keeper->GetWaitReason(), Catch::Contains("cannot be used: the table reports is missing"));
    SECTION("no other process leads")
    {
        const auto end = std::chrono::steady_clock::now() + 3 * (DURATION / 12);
        RunUntil([&] { return std::chrono::steady_clock::now() >= end; });
        CHECK(taken.empty());
        CHECK_THAT(keeper->GetWaitReason(), Catch::Contains("the table reports is missing"));
        CHECK_THAT(keeper->GetPublicReason(), !Catch::Contains("reports"));
        clock.Advance(std::chrono::seconds(6));
        RunUntil([&] { return !taken.empty(); });
    }
    SECTION("another process leads")
    {
        row.Change([](Planning::LeaseState& state) { state = {7, 3, "other", "config", DURATION, false}; });
        RunUntil([&] { return keeper->GetWaitReason() == "standby: other leads"; });
    }
}

TEST_CASE_METHOD(LeaseKeeperFixture, "A lease in the name of this process is not that of another leader")
{
    row.Change([](Planning::LeaseState& state) { state = {7, 3, "this one", "config", DURATION, false}; });
    keeper->Start();
    RunUntil([&] { return keeper->GetWaitReason() != "standby: the store was not read yet"; });
    CHECK_THAT(keeper->GetWaitReason(), Catch::Contains("the same store.instance"));
}

} // namespace ACS::Acsd::Test
