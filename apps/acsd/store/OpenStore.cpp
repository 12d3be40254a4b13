#include "store/OpenStore.hpp"

#include "standby/LeaderStore.hpp"
#include "store/StoreSummary.hpp"
#include <acs/plan_postgres/PostgresPlanStore.hpp>
#include <acs/plan_sqlite/SqlitePlanStore.hpp>

#include <cassert>
#include <utility>

namespace ACS::Acsd
{

namespace
{

/// Reads the store. A new one begins with the TSC state of the configuration. That is stored before anything else, so that a start
/// that was killed before it does not make the store look used.
template <typename TStore>
Core::Result<OpenedStore> Load(std::unique_ptr<TStore> store, const StoreConfig& config)
{
    return store->Load().and_then([&](Planning::StoredState state) {
        Planning::StoreOrigin origin = store->GetOrigin();
        origin.bNew = state == Planning::StoredState();
        Core::Result<void> begun;
        if (origin.bNew)
        {
            state.tscState = config.bNewStorePaused ? Planning::ETscState::Paused : Planning::ETscState::Auto;
            begun = store->Append({{Planning::TscChanged{*state.tscState}}});
        }
        return begun.map([&] {
            std::string summary = MakeStoreSummary(origin, state);
            return OpenedStore{std::move(store), std::move(state), std::move(summary), {}};
        });
    });
}

} // namespace

Core::Result<OpenedStore> OpenDirectoryStore(const StoreConfig& config)
{
    return Planning::SqlitePlanStore::Open(config.directory)
        .and_then(
            [&config](std::unique_ptr<Planning::SqlitePlanStore> store) { return Load(std::move(store), config); });
}

Core::Result<OpenedStore> OpenSharedStore(const StoreConfig& config, std::uint64_t epoch, LeaseGuard& guard)
{
    assert(config.postgres.has_value());
    Planning::PostgresOptions options = *config.postgres;
    options.timeout = config.lease; // a process that waits for longer does not lead any more
    options.shouldStop = [&guard] {
        return !guard.IsHeld();
    };
    return Planning::PostgresPlanStore::Open(std::move(options), epoch)
        .and_then([&config, &guard](std::unique_ptr<Planning::PostgresPlanStore> store) {
            std::string identity = store->GetIdentity();
            return Load(std::move(store), config).map([&](OpenedStore opened) {
                opened.store = std::make_unique<LeaderStore>(std::move(opened.store), guard);
                opened.identity = std::move(identity);
                return opened;
            });
        });
}

} // namespace ACS::Acsd
