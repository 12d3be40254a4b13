#include "standby/LeaderStore.hpp"

#include "Catch.hpp"
#include "ManualClock.hpp"
#include <acs/plan/EPlanningError.hpp>

#include <chrono>
#include <functional>
#include <memory>
#include <utility>

namespace ACS::Acsd::Test
{

namespace
{

using Planning::EPlanningError;

Core::Result<void> Fail(EPlanningError error)
{
    return Core::Fail(make_error_code(error), "db", "a server", "none");
}

/// Answers as the test determines.
class ScriptedStore final : public Planning::IPlanStore
{
    std::function<Core::Result<void>()> _answer;

public:
    explicit ScriptedStore(std::function<Core::Result<void>()> answer)
        : _answer(std::move(answer))
    {
    }

    [[nodiscard]] Core::Result<Planning::StoredState> Load() override
    {
        return Planning::StoredState{};
    }

    [[nodiscard]] Core::Result<void> Append(const Planning::StoreBatch& /*batch*/) override
    {
        return _answer();
    }

    [[nodiscard]] Core::Result<void> Check() override
    {
        return _answer();
    }

    [[nodiscard]] Planning::StoreLog CheckLog() override
    {
        return {};
    }
};

} // namespace

TEST_CASE("A leader stores a batch again until it is stored or the lease has ended")
{
    Testing::ManualClock clock;
    LeaseGuard guard(clock);
    guard.Extend(clock.GetNow().steady + std::chrono::seconds(3));
    int attempts = 0;
    EPlanningError error = EPlanningError::StoreFailed;
    int failures = 2;
    LeaderStore store(
        std::make_unique<ScriptedStore>([&]() -> Core::Result<void> {
            ++attempts;
            if (attempts > failures)
            {
                return {};
            }
            if (failures > 2)
            {
                clock.Advance(std::chrono::seconds(1));
            }
            return Fail(error);
        }),
        guard);
    SECTION("it works again")
    {
        CHECK(store.Append({}).has_value());
        CHECK(attempts == 3);
    }
    SECTION("the lease ends before")
    {
        failures = 100;
        const Core::Result<void> refused = store.Append({});
        REQUIRE_FALSE(refused.has_value());
        CHECK(refused.error().code == EPlanningError::StoreTaken);
        CHECK(attempts == 3);
    }
    SECTION("a failure that does not end is no lost connection: the lead is lost")
    {
        failures = 2;
        error = EPlanningError::StoreCorrupt;
        attempts = -1'000;
        const Core::Result<void> refused = store.Append({});
        REQUIRE_FALSE(refused.has_value());
        CHECK(refused.error().code == EPlanningError::StoreTaken);
        CHECK(attempts == LeaderStore::MOST_ATTEMPTS - 1'000);
    }
    SECTION("another process has taken the store")
    {
        error = EPlanningError::StoreTaken;
        CHECK(store.Append({}).error().code == EPlanningError::StoreTaken);
        CHECK(attempts == 1);
        CHECK(store.Check().error().code == EPlanningError::StoreTaken);
    }
    SECTION("a check that fails is no reason to work without the store")
    {
        CHECK(store.Check().has_value());
    }
}

} // namespace ACS::Acsd::Test
