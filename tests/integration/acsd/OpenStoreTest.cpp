#include "store/OpenStore.hpp"

#include "ManualClock.hpp"
#include "PostgresPlace.hpp"
#include "StoreFolder.hpp"
#include <acs/plan/IPlanStore.hpp>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

// The first TSC state of a store (tsc.new_store), with both stores.

namespace ACS::Acsd::Test
{

using Planning::ETscState;
using Planning::Test::Contains;

namespace
{

OpenedStore Expect(Core::Result<OpenedStore> opened)
{
    INFO((opened.has_value() ? std::string() : Core::Describe(opened.error())));
    REQUIRE(opened.has_value());
    return std::move(*opened);
}

/// An empty place for a store in SQLite.
class DirectoryPlace
{
    Planning::Test::StoreFolder _folder;

public:
    [[nodiscard]] OpenedStore Open(bool bNewStorePaused) const
    {
        StoreConfig config;
        config.directory = _folder.GetStore();
        config.bNewStorePaused = bNewStorePaused;
        return Expect(OpenDirectoryStore(config));
    }

    /// Creates the tables and nothing else.
    [[nodiscard]] std::unique_ptr<Planning::IPlanStore> OpenEmpty() const
    {
        return Planning::Test::OpenStore(_folder.GetStore());
    }
};

/// An empty database with the lease of this process.
class SharedPlace
{
    Planning::Test::PostgresPlace _place;
    Testing::ManualClock _clock;
    LeaseGuard _guard{_clock};

public:
    [[nodiscard]] OpenedStore Open(bool bNewStorePaused)
    {
        StoreConfig config;
        config.postgres = _place.GetOptions();
        config.bNewStorePaused = bNewStorePaused;
        const std::uint64_t epoch = _place.Take(); // creates the tables, as each process does
        _guard.Extend(_clock.GetNow().steady + std::chrono::hours(1));
        return Expect(OpenSharedStore(config, epoch, _guard));
    }

    [[nodiscard]] std::unique_ptr<Planning::IPlanStore> OpenEmpty() const
    {
        return _place.Open();
    }
};

} // namespace

TEMPLATE_TEST_CASE(
    "A new store begins Paused with new_store paused, also after restarts",
    "",
    DirectoryPlace,
    SharedPlace)
{
    TestType place;
    {
        const OpenedStore first = place.Open(true);
        CHECK(first.state.tscState == ETscState::Paused);
        CHECK(Contains(first.summary, "TSC Paused until an operator resumes it (tsc.new_store)"));
    }
    {
        const OpenedStore second = place.Open(true);
        CHECK(second.state.tscState == ETscState::Paused);
        CHECK(Contains(second.summary, ", TSC Paused"));
        CHECK_FALSE(Contains(second.summary, "new"));
        REQUIRE(second.store->Append({{Planning::TscChanged{ETscState::Auto}}}));
    }
    CHECK(place.Open(true).state.tscState == ETscState::Auto);
}

TEMPLATE_TEST_CASE(
    "A start that was killed before the pause was stored leaves a new store",
    "",
    DirectoryPlace,
    SharedPlace)
{
    TestType place;
    place.OpenEmpty().reset();
    CHECK(place.Open(true).state.tscState == ETscState::Paused);
}

TEMPLATE_TEST_CASE("A store that began with new_store auto is not new any more", "", DirectoryPlace, SharedPlace)
{
    TestType place;
    {
        const OpenedStore first = place.Open(false);
        CHECK(first.state.tscState == ETscState::Auto);
        CHECK(Contains(first.summary, "new, schema"));
        CHECK_FALSE(Contains(first.summary, "Paused"));
    }
    CHECK(place.Open(true).state.tscState == ETscState::Auto);
}

TEMPLATE_TEST_CASE("A store of an earlier version without a TSC state is not new", "", DirectoryPlace, SharedPlace)
{
    TestType place;
    REQUIRE(place.OpenEmpty()->Append({{Planning::MaintenanceChanged{"LR01", true}}}));
    const OpenedStore opened = place.Open(true);
    CHECK_FALSE(opened.state.tscState.has_value());
    CHECK(opened.state.robotsInMaintenance == std::vector<std::string>{"LR01"});
}

} // namespace ACS::Acsd::Test
