#include "operator/SessionTable.hpp"

#include "Catch.hpp"
#include "ManualClock.hpp"

#include <cstddef>
#include <string>

using namespace ACS; // NOLINT(google-build-using-namespace)
using Acsd::HashToken;
using Acsd::SessionTable;

TEST_CASE("A session leads to its token until it is removed or 12 hours have passed")
{
    Testing::ManualClock clock;
    SessionTable table;
    table.Add(HashToken("secret"), HashToken("token"), clock.GetNow().steady);
    CHECK(table.FindTokenOrNull(HashToken("secret"), clock.GetNow().steady) == HashToken("token"));
    CHECK(table.FindTokenOrNull(HashToken("guess"), clock.GetNow().steady) == std::nullopt);
    table.Add(HashToken("other"), HashToken("token"), clock.GetNow().steady);
    table.Remove(HashToken("other"));
    CHECK(table.FindTokenOrNull(HashToken("other"), clock.GetNow().steady) == std::nullopt);
    clock.Advance(SessionTable::LIFETIME - std::chrono::milliseconds(1));
    CHECK(table.FindTokenOrNull(HashToken("secret"), clock.GetNow().steady).has_value());
    clock.Advance(std::chrono::milliseconds(1));
    CHECK(table.FindTokenOrNull(HashToken("secret"), clock.GetNow().steady) == std::nullopt);
}

TEST_CASE("Sessions are bounded in number; one token cannot push out those of others")
{
    const Core::SteadyTime now = Testing::ManualClock().GetNow().steady;
    SessionTable table;
    table.Add(HashToken("first"), HashToken("kim"), now);
    for (std::size_t number = 0; number <= SessionTable::MOST_PER_TOKEN; ++number)
    {
        table.Add(HashToken("s" + std::to_string(number)), HashToken("grafana"), now);
    }
    CHECK(table.FindTokenOrNull(HashToken("first"), now).has_value());
    CHECK_FALSE(table.FindTokenOrNull(HashToken("s0"), now).has_value());
    CHECK(table.FindTokenOrNull(HashToken("s1"), now).has_value());
    for (std::size_t number = 0; number < SessionTable::MOST_SESSIONS; ++number)
    {
        table.Add(HashToken("t" + std::to_string(number)), HashToken("token" + std::to_string(number)), now);
    }
    CHECK_FALSE(table.FindTokenOrNull(HashToken("first"), now).has_value());
    CHECK(table.FindTokenOrNull(HashToken("t0"), now).has_value());
}
